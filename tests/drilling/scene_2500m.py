# SPDX-License-Identifier: BSD-3-Clause
"""The tables of docs/drilling.md about xml/stick_slip_2500m.xml, and what the document says of them."""
import math

import numpy as np
from checks import expect
from program import FULL, ROOT

DECK = ROOT / "xml" / "stick_slip_2500m.xml"
STUCK = 0.02  # [rad/s]
GAINS = ("Top Drive/Proportional Gain", "Top Drive/Integral Gain")
COLLARS = "Substructures/Keep Full Below"
CUT_OFF = "Reduction/Mode Selection/Cut-off Frequency"


def matched(ratio, frequency="0.22 Hz"):
    return {"Top Drive/Control": "Impedance Matched", "Top Drive/Tuning Frequency": frequency, "Top Drive/Impedance Ratio": ratio}


# name: (settings, lists left out) of 60 s, then of the first 15 s
DRIVES = {"stiff": ({}, ()), "stiff, full model": ({}, FULL), "matched, ratio 1 at 0.2 Hz": (matched(1, "0.2 Hz"), GAINS),
          "matched, ratio 2": (matched(2), GAINS), "matched, ratio 4": (matched(4), GAINS)}
MODELS = {"full model": ({}, FULL), "scene": ({}, ()), "reduced collars, 30 Hz": ({CUT_OFF: "30 Hz"}, (COLLARS,)),
          "reduced collars, 200 Hz": ({CUT_OFF: "200 Hz"}, (COLLARS,))}


def bit_speed(program, name, settings, without):
    """Times [s] and speeds of the bit [rpm]."""
    run = program.run(f"2500m_{name.replace(' ', '_').replace(',', '')}", DECK, settings, without)
    expect(f"{name}: exit code 0", run.done, run.sentence())
    return run.time(), run.data("transient/motion")[:, 2] * 30 / math.pi


def late(program, name):
    """Lowest and highest speed [rpm] and share stuck over the last 30 of 60 s."""
    t, rpm = bit_speed(program, name, *DRIVES[name])
    rpm = rpm[t >= 30.0]
    return rpm.min(), rpm.max(), np.mean(np.abs(rpm) < STUCK * 30 / math.pi)


def stick_slip_2500m(program):
    """Prints both tables, in rpm; not among the checks that run by themselves: 2 minutes."""
    found = {name: late(program, name) for name in DRIVES}
    print("\n| drive | lowest | highest | share stuck |\n|---|---|---|---|")
    for name, (low, high, share) in found.items():
        print(f"| {name} | {low:.1f} | {high:.0f} | {share:.2g} |")
    peaks = {name: bit_speed(program, name, {**settings, "Transient/End Time": 15.0}, without)[1].max()
             for name, (settings, without) in MODELS.items()}
    print("\n| model | peak of the first 15 s |\n|---|---|")
    for name, peak in peaks.items():
        print(f"| {name} | {peak:.1f} |")
    print()
    scene, full = found["stiff"], found["stiff, full model"]
    expect("a stiff drive sticks and slips", min(scene[2], full[2]) > 0.1 and scene[1] > 160, f"{scene}, {full}")
    expect("the reduced model sticks as long as the full one", abs(scene[2] - full[2]) < 0.02, f"{scene[2]:.3f}, {full[2]:.3f}")
    expect("and slips about as fast", abs(scene[1] / full[1] - 1) < 0.1, f"{scene[1]:.0f}, {full[1]:.0f} rpm")
    expect("the ratio 1 at 0.2 Hz still sticks", found["matched, ratio 1 at 0.2 Hz"][2] > 0.05, str(found["matched, ratio 1 at 0.2 Hz"]))
    expect("the ratio 2 just touches a standstill", found["matched, ratio 2"][0] < 5 and found["matched, ratio 2"][2] < 0.01,
           str(found["matched, ratio 2"]))
    expect("the ratio 4 stops it", found["matched, ratio 4"][0] > 40 and found["matched, ratio 4"][2] == 0, str(found["matched, ratio 4"]))
    truth = peaks["full model"]
    for name in ("scene", "reduced collars, 200 Hz"):
        expect(f"{name}: the peak of the full model within 0.5 %", abs(peaks[name] / truth - 1) < 5e-3, f"{peaks[name]:.2f}, {truth:.2f}")
    expect("reduced collars with modes up to 30 Hz are 50 % off at least", peaks["reduced collars, 30 Hz"] > 1.5 * truth,
           f"{peaks['reduced collars, 30 Hz']:.1f}")
