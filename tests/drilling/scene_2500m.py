# SPDX-License-Identifier: BSD-3-Clause
"""The tables of docs/guide/bit-and-top-drive.md about xml/stick_slip_2500m.xml, and what the document says of them."""
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
    return late_of(program, name, *DRIVES[name])


def late_of(program, name, settings, without):
    t, rpm = bit_speed(program, name, settings, without)
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
    expect("the reduced model sticks as long as the full one", abs(scene[2] - full[2]) < 0.005, f"{scene[2]:.3f}, {full[2]:.3f}")
    expect("and slips as fast", abs(scene[1] / full[1] - 1) < 0.01, f"{scene[1]:.1f}, {full[1]:.1f} rpm")
    for name in ("matched, ratio 1 at 0.2 Hz", "matched, ratio 2"):
        expect(f"{name}: still sticks", found[name][2] > 0.05, str(found[name]))
    expect("the ratio 4 stops it", found["matched, ratio 4"][0] > 40 and found["matched, ratio 4"][2] == 0, str(found["matched, ratio 4"]))
    truth = peaks["full model"]
    for name, error in (("scene", 1e-3), ("reduced collars, 200 Hz", 1e-3), ("reduced collars, 30 Hz", 1e-2)):
        expect(f"{name}: the peak of the full model within {error:.1%}", abs(peaks[name] / truth - 1) < error, f"{peaks[name]:.2f}, {truth:.2f}")
    # damping that rises with the frequency leaves nothing to the step
    shares = [late_of(program, f"steps of {step}", {"Transient/Step": step}, ())[2] for step in ("2 ms", "1 ms", "0.5 ms")]
    expect("the share stuck does not depend on the step", max(shares) - min(shares) < 0.005, str(shares))
