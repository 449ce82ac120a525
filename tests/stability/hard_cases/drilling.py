# SPDX-License-Identifier: BSD-3-Clause
"""Bit and rock with a delay: the linear limits of the axial loop and of both loops, and a bit that
leaves the bottom."""
import math
import pathlib
import sys

import numpy as np

from rows import Plot, against, case, judged, statement
from scenes import THETA_Z, alpha, arkode, growth_of_pair, rk4

TESTS = pathlib.Path(__file__).resolve().parents[2]
sys.path += [str(TESTS / "drilling"), str(TESTS / "support")]
import models  # noqa: E402

BLADES, RADIUS, INCLINATION, FEED, DAMPING = 4, 0.108, 0.6, 2e-3, 3.0
PIPE = {**models.PIPE, "Length": 300.0, "Elements": 1}


def axial_loop():
    """One element, held by the block: m = rho A L/3, c = 3 1/s m, k = E A/L."""
    area = models.area(PIPE)
    mass = models.DENSITY * area * PIPE["Length"] / 3
    return models.Chatter(mass, DAMPING * mass, models.YOUNG * area / PIPE["Length"])


TWISTING, FAST = 0.1, 2e-2  # damping [1/s] and block speed [m/s] of the cases governed by torsion


def both_loops(speed):
    """The same element, free to twist below a drive that turns steadily."""
    area, polar, length = models.area(PIPE), models.polar(PIPE), PIPE["Length"]
    axial, inertia = models.DENSITY * area * length / 3, models.DENSITY * polar * length / 3
    return models.CoupledChatter((axial, TWISTING * axial, models.YOUNG * area / length),
                                 (inertia, TWISTING * inertia, models.SHEAR * polar / length),
                                 FAST / speed, RADIUS / (2 * INCLINATION))


def deck(program, name, stiffness, speed, end, wear=0.0, sampling=0.005, feed=FEED, damping=DAMPING,
         held="theta_z"):
    """A bit of cutting stiffness n a zeta eps on that element, disturbed by half a sine of 10 N
    over 0.1 s."""
    bit = {
        "Blades": BLADES, "Radius": RADIUS, "Inclination": INCLINATION,
        "Specific Energy": stiffness / (BLADES * RADIUS * INCLINATION), "Wear Flat": wear
    }
    lists = models.string_deck(
        ((PIPE, 1),), **{
            "Supports": {"Dofs": "axial torsional", "Bit": held},
            "Damping": {"Mass Coefficient": damping},
            "Rotary Speed": {"Law": "Constant", "Constant": {"Speed": speed}},
            "Top Drive": {"Block Speed": feed},
            "Bit": {"Law": "Cutting", "Cutting": bit},
            "Loads": {
                "Forces": {
                    "kick": {
                        "Node": 2, "Component": "w", "Value": 10.0, "Frequency": 5.0,
                        "Phase": -math.pi / 2, "End Time": 0.1
                    }
                }
            },
            "Transient": {"End Time": end, "Sampling Interval": sampling, "Progress": False},
        })
    return program.deck(name, lists)


def torsion(program, ways, speeds, easy):
    """The bit free to twist, governed by the torsional loop: the axial loop alone has limits five
    times as large. The growth rate is 2e-3 1/s, so the motion lasts 40 s."""
    for label, way in ways.items():
        for speed in speeds if label.endswith(" 1 ms") else speeds[:1]:
            delay, loops = 2 * math.pi / (BLADES * speed), both_loops(speed)
            limit, frequency = loops.critical(delay)
            found, what = {}, f"{label}, free to twist, delay {1e3 * delay:.0f} ms"
            for factor in (0.95, 1.05):
                run = program.run(
                    "c30_twist",
                    deck(program, "c30_twist", factor * limit, speed, 40.0, feed=FAST,
                         damping=TWISTING, held="none"), way)
                truth = loops.rightmost(factor * limit, delay).real

                def rate():
                    found[factor] = growth_of_pair(
                        run.time(),
                        run.nodes(THETA_Z)[:, -1] - run.nodes(THETA_Z)[0, -1], 2)
                    return truth, found[factor], abs(found[factor] - truth)

                yield judged(run, what, f"growth rate [1/s] at {factor:g} of the limit", rate, 2e-4,
                             required=True, easy=easy)
            if len(found) == 2:
                at = 0.95 - 0.1 * found[0.95] / (found[1.05] - found[0.95])
                yield statement(what, "limit of the cutting stiffness [N/m]", f"{limit:.5g}",
                                f"{at * limit:.5g}",
                                abs(at - 1) < 0.02,
                                note=f"{100 * (at - 1):+.2f} %; at {frequency:.1f} rad/s")


@case(30, "Bit-rock interaction with delay",
      "cutting stiffness 5 % below and above the limit of the axial loop, and of both loops with a "
      "bit that is free to twist, several delays and integrators; three times the limit; wear "
      "flats", "growth and decay at the rates of the characteristic equation, the limit within 2 "
      "%; a bit off bottom cuts nothing, the weight is never negative and the mean advance is the "
      "feed", "generalized-alpha 1 ms")
def bit_rock(program, short):
    loop = axial_loop()
    ways = {"generalized-alpha 1 ms": alpha(1e-3)}
    if not short:
        ways |= {
            "generalized-alpha 0.25 ms": alpha(2.5e-4), "RK4 1 ms": rk4(1e-3),
            "ARKODE 1e-9": arkode(1e-9)
        }  # 1e-6 of 1 cm is as large as the motion
    speeds = (8.0,) if short else (6.0, 8.0, 10.0, 12.0, 14.0, 18.0)
    series, easy = {}, None
    for label, way in ways.items():
        for speed in speeds if label.endswith(" 1 ms") else speeds[:2]:
            delay = 2 * math.pi / (BLADES * speed)
            limit, _ = loop.critical(delay)
            found = {}
            for factor in (0.95, 1.05):
                run = program.run("c30", deck(program, "c30", factor * limit, speed, 12.0), way)
                easy = easy or run
                truth = loop.rightmost(factor * limit, delay).real

                def rate():
                    found[factor] = growth_of_pair(run.time(),
                                                   run.nodes(2)[:, -1] - run.nodes(2)[0, -1])
                    return truth, found[factor], abs(found[factor] - truth)

                yield judged(run, f"{label}, delay {1e3 * delay:.0f} ms",
                             f"growth rate [1/s] at {factor:g} of the limit", rate, 0.01,
                             required=True, easy=easy)
            if len(found) == 2:
                at = 0.95 - 0.1 * found[0.95] / (found[1.05] - found[0.95])
                series.setdefault(label, []).append((speed, at * limit))
                good = abs(at - 1) < 0.02
                yield statement(f"{label}, delay {1e3 * delay:.0f} ms",
                                "limit of the cutting stiffness [N/m]", f"{limit:.5g}",
                                f"{at * limit:.5g}", good, note=f"{100 * (at - 1):+.2f} %")
    yield from torsion(program, ways, (20.0,) if short else (20.0, 24.0), easy)
    for wear in (0.0,) if short else (0.0, 1e-4):
        limit, _ = loop.critical(2 * math.pi / (BLADES * 8.0))
        run = program.run("c30_off", deck(program, "c30_off", 3 * limit, 8.0, 60.0, wear),
                          alpha(1e-3))
        what = f"three times the limit, wear flat {1e3 * wear:g} mm"

        def bounded():
            # depths of cut of all passes add up to the advance: the error of their mean over 50 s,
            # 100 mm, is the range of U, a few mm
            weight, late = run.data("transient/weight_on_bit"), run.time() > 10
            mean = 3 * limit * FEED * 2 * math.pi / (BLADES * 8.0) + BLADES * RADIUS * wear * 60e6
            off = float(np.mean(weight[late] == 0.0))
            if weight.min() < 0 or (wear == 0.0 and off == 0.0):
                return "0 and off bottom", f"{weight.min():.3g} N, off bottom {off:.2f}", math.inf
            if wear > 0.0:
                return "not negative", f"{weight.min():.3g} N", 0.0
            return against(mean, float(weight[late].mean()))

        yield judged(run, what, "mean weight of the cutting [N], never negative", bounded, 0.05,
                     required=True, easy=easy)
    if not short:
        theory = [
            (x, loop.critical(2 * math.pi / (BLADES * x))[0]) for x in np.linspace(6, 18, 121)
        ]
        yield Plot("bit_rock", "Limit of the axial loop", "rotary speed [rad/s]",
                   "cutting stiffness n a zeta eps [N/m]",
                   {"truth characteristic equation": theory, **series})
