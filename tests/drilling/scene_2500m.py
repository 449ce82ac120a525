# SPDX-License-Identifier: BSD-3-Clause
"""The tables of docs/guide/bit-and-top-drive.md about xml/stick_slip_2500m.xml, and the statements
of the page on them."""
import math
import re
import xml.etree.ElementTree

import models
import numpy as np
import torsion
from checks import expect
from program import FULL, ROOT

DECK = ROOT / "xml" / "stick_slip_2500m.xml"
STUCK = 0.02  # [rad/s]
GAINS = ("Top Drive/Proportional Gain", "Top Drive/Integral Gain")
COLLARS = "Substructures/Keep Full Below"
CUT_OFF = "Reduction/Mode Selection/Cut-off Frequency"


def matched(ratio, frequency="0.22 Hz"):
    return {
        "Top Drive/Control": "Impedance Matched", "Top Drive/Tuning Frequency": frequency,
        "Top Drive/Impedance Ratio": ratio
    }


# name: (settings, lists left out) of runs of 60 s, then of the first 15 s
DRIVES = {
    "stiff": ({}, ()),
    "stiff, full model": ({}, FULL),
    "matched, ratio 1 at 0.2 Hz": (matched(1, "0.2 Hz"), GAINS),
    "matched, ratio 2": (matched(2), GAINS),
    "matched, ratio 4": (matched(4), GAINS),
}
MODELS = {
    "full model": ({}, FULL),
    "scene": ({}, ()),
    "reduced collars, 30 Hz": ({CUT_OFF: "30 Hz"}, (COLLARS,)),
    "reduced collars, 200 Hz": ({CUT_OFF: "200 Hz"}, (COLLARS,)),
}

INCH = 0.0254
HIGHEST = 20.0  # [rad/s]
WEIGHT, INERTIA = 80e3, 2500.0
BIT = models.Friction(static=0.8 * WEIGHT * 4.25 * INCH, dynamic=0.5 * WEIGHT * 4.25 * INCH,
                      decay=1.1, viscous=10.0, width=0.01)


def pieces():
    """Length, outer and inner radius of all parts of the string, from the top down, read from the
    library of the deck."""
    library = {
        one.get("name"): one
        for one in xml.etree.ElementTree.parse(ROOT / "xml/components/api_pipes.xml").getroot()
    }

    def metres(text):
        number, _, unit = text.partition(" ")
        return float(number) * (INCH if unit == "in" else 1.0)

    def expand(names):
        for name in names.strip("{}").split(","):
            count, name = re.fullmatch(r"\s*(?:(\d+)\*)?(.+)", name).groups()
            for _ in range(int(count or 1)):
                values = {
                    one.get("name"): one.get("value") for one in library[name]
                    if one.tag == "Parameter"
                }
                if "Parts" in values:
                    yield from expand(values["Parts"])
                else:
                    yield tuple(
                        metres(values[key]) for key in ("Length", "Outer Radius", "Inner Radius"))

    assembly = re.search(r'"Assembly" type="[^"]*" value="([^"]*)"',
                         DECK.read_text(encoding="utf-8"))[1]
    return list(expand(assembly))


LINE = torsion.Line(pieces(), mass=0.05, stiffness=1e-3)


def drive_of(ratio, frequency=0.22):
    """A drive matched to the drill pipe: sqrt(mean rho I_p/mean 1/(G I_p)) of a joint of it; None:
    the stiff drive of the deck."""
    if ratio is None:
        return torsion.Drive(10000.0, 5000.0, INERTIA)
    joint = LINE.pieces[:5]
    length = sum(one[0] for one in joint)
    impedance = math.sqrt(
        models.DENSITY * models.SHEAR * sum(n * p for n, p in joint) / sum(n / p for n, p in joint))
    assert abs(length - 9.45) < 0.01
    return torsion.Drive(ratio * impedance, INERTIA * (2 * math.pi * frequency)**2, INERTIA)


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


def limits(program):
    """Speed below which steady drilling is unstable according to the torsional line, and the
    verdict of the program on the steady state 3 % below and above; prints a table."""
    print("\n| drive | unstable below [rpm] | growth 3 % below, line; program [1/s] | 3 % above |\n"
          "|---|---|---|---|")
    for name, ratio in (("stiff", None), ("matched, `Impedance Ratio` 1", 1),
                        ("matched, `Impedance Ratio` 2", 2), ("matched, `Impedance Ratio` 4", 4)):
        drive = drive_of(ratio)
        slope = LINE.critical_slope(drive, HIGHEST)
        critical = BIT.decay * math.log(
            (BIT.static - BIT.dynamic) / BIT.decay / (BIT.viscous - slope))
        settings, without = ({}, ()) if ratio is None else (matched(ratio), GAINS)
        cells = []
        for factor in (0.97, 1.03):
            roots = LINE.roots(BIT.slope(factor * critical), drive, HIGHEST)
            truth = roots[0]
            run = program.run(
                f"2500m_limit_{ratio}", DECK, {
                    **settings, "Rotary Speed/Law": "Constant",
                    "Rotary Speed/Constant/Speed": factor * critical, "Transient/End Time": 0.02
                }, ("Rotary Speed/Exponential", *FULL, *without))
            static = run.summary["static"]
            expect(f"{name}, {factor:g} of the critical speed: stable is {static['stable']}",
                   static["stable"] == (truth.real < 0), f"{truth}")
            if truth.real > 0:
                nearest = min(roots, key=lambda root: abs(root.imag / (2 * math.pi) - static[
                    "growth_hz"])).real  # the program names one of several growing modes
                expect(f"{name}: growth {static['growth_rate']:.5f}, of the line {nearest:.5f}",
                       abs(static["growth_rate"] / nearest - 1) < 0.02)
                cells.append(f"{nearest:.5f}; {static['growth_rate']:.5f}")
            else:
                cells.append(f"{truth.real:.5f}; stable")
        print(f"| {name} | {critical * 30 / math.pi:.1f} | {' | '.join(cells)} |")
    print()


def alone(program):
    """The scene compared with a separate model of masses and springs, integrated with error
    control: speeds of the bit, peak, share stuck, mean period of the last 30 s; prints a table."""
    final = 80 * math.pi / 30
    times = np.arange(0, 60.0 + 1e-9, 0.02)
    truth = torsion.LumpedString(LINE,
                                 5.0).motion(times, lambda t: final * (1 - np.exp(-t)),
                                             lambda t: final * np.exp(-t), BIT, drive_of(None))
    run = program.run("2500m_alone", DECK, {}, ())
    found = run.data("transient/motion")[:, 2]
    late = times >= 30.0
    print("| | lowest [rpm] | highest [rpm] | share stuck | period [s] |\n|---|---|---|---|---|")
    figures = []
    for name, speed in (("masses and springs, LSODA", truth), ("the scene", found)):
        _, _, period = models.cycles(times[late], speed[late], STUCK)
        figures.append((speed[late].max(), np.mean(np.abs(speed[late]) < STUCK), period))
        print(f"| {name} | {speed[late].min() * 30 / math.pi:.2f} | "
              f"{speed[late].max() * 30 / math.pi:.2f} | {figures[-1][1]:.4f} | {period:.4f} |")
    print()
    # a sample of 20 ms at each end of a stop is 5 % of it
    for what, a, b, bound in zip(("highest speed", "share stuck", "period"), *figures,
                                 (1e-2, 5e-2, 5e-3)):
        expect(f"{what}: {b:.5g} beside {a:.5g}", abs(b / a - 1) < bound)
    error = np.abs(found - truth)[times < 5].max() / truth.max()
    expect(f"largest difference of the speeds over their peak in the first 5 s {error:.2e}",
           error < 0.02)


def stick_slip_2500m(program):
    """Prints both tables, in rpm; takes 2 minutes, and is not run with the other checks."""
    found = {name: late(program, name) for name in DRIVES}
    print("\n| drive | lowest | highest | share stuck |\n|---|---|---|---|")
    for name, (low, high, share) in found.items():
        print(f"| {name} | {low:.1f} | {high:.0f} | {share:.2g} |")
    peaks = {
        name: bit_speed(program, name, {**settings, "Transient/End Time": 15.0}, without)[1].max()
        for name, (settings, without) in MODELS.items()
    }
    print("\n| model | peak of the first 15 s |\n|---|---|")
    for name, peak in peaks.items():
        print(f"| {name} | {peak:.1f} |")
    print()
    scene, full = found["stiff"], found["stiff, full model"]
    expect("a stiff drive sticks and slips",
           min(scene[2], full[2]) > 0.1 and scene[1] > 160, f"{scene}, {full}")
    expect("the reduced model sticks as long as the full one",
           abs(scene[2] - full[2]) < 0.005, f"{scene[2]:.3f}, {full[2]:.3f}")
    expect("and slips as fast",
           abs(scene[1] / full[1] - 1) < 0.01, f"{scene[1]:.1f}, {full[1]:.1f} rpm")
    for name in ("matched, ratio 1 at 0.2 Hz", "matched, ratio 2"):
        expect(f"{name}: still sticks", found[name][2] > 0.05, str(found[name]))
    expect("the ratio 4 stops it", found["matched, ratio 4"][0] > 40
           and found["matched, ratio 4"][2] == 0, str(found["matched, ratio 4"]))
    truth = peaks["full model"]
    for name, error in (("scene", 1e-3), ("reduced collars, 200 Hz", 1e-3),
                        ("reduced collars, 30 Hz", 1e-2)):
        expect(f"{name}: the peak of the full model within {error:.1%}",
               abs(peaks[name] / truth - 1) < error, f"{peaks[name]:.2f}, {truth:.2f}")
    limits(program)
    alone(program)
    # with damping that rises with the frequency the step has no effect
    shares = [
        late_of(program, f"steps of {step}", {"Transient/Step": step}, ())[2]
        for step in ("2 ms", "1 ms", "0.5 ms")
    ]
    expect("the share stuck does not depend on the step",
           max(shares) - min(shares) < 0.005, str(shares))
