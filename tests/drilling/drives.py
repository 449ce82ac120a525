# SPDX-License-Identifier: BSD-3-Clause
"""Stability of steady drilling for several drives: simulations on both sides of the limits of the
torsional line."""
import math

import models
import torsion
from checks import expect
from scenes import growth_of_pair

THETA_Z = 5
HIGHEST = 40.0  # [rad/s]: friction excites the first modes
WEIGHT, INERTIA, MASS, STIFFNESS = 60e3, 1500.0, 0.05, 1e-3
PIPE, COLLAR = {**models.PIPE, "Elements": 30}, {**models.COLLAR, "Elements": 10}
BIT = models.Friction(static=WEIGHT * 0.108 * 0.8, dynamic=WEIGHT * 0.108 * 0.5, decay=1.1,
                      viscous=20.0, width=0.01)
LINE = torsion.Line([
    (900.0, models.PIPE["Outer Radius"], models.PIPE["Inner Radius"]),
    (200.0, models.COLLAR["Outer Radius"], models.COLLAR["Inner Radius"]),
], MASS, STIFFNESS)
TUNED = 0.49  # [Hz], near the first mode of the string below a stiff drive


def matched(ratio):
    return torsion.Drive(ratio * models.impedance(models.PIPE),
                         INERTIA * (2 * math.pi * TUNED)**2, INERTIA)


DRIVES = {"stiff": torsion.Drive(20000.0, 10000.0, INERTIA), "matched, ratio 4": matched(4)}


def critical_speed(drive):
    """Rotary speed below which steady drilling is unstable [rad/s]."""
    slope = LINE.critical_slope(drive, HIGHEST)
    return BIT.decay * math.log((BIT.static - BIT.dynamic) / BIT.decay / (BIT.viscous - slope))


def growth(program, name, drive, speed):
    """Simulated growth of a small disturbance of steady drilling [1/s]."""
    deck = models.string_deck(
        ((PIPE, 3), (COLLAR, 2)), **{
            "Loads": {
                "Gravity": 9.81, "Weight On Bit": WEIGHT, "Forces": {
                    "kick": {
                        "Node": 111, "Component": "theta_z", "Value": 1e-2, "Frequency": 0.5,
                        "Phase": -math.pi / 2, "End Time": 1.0
                    }
                }
            },
            "Rotary Speed": {"Law": "Constant", "Constant": {"Speed": speed}},
            "Damping": {"Mass Coefficient": MASS, "Stiffness Coefficient": STIFFNESS},
            "Bit": {
                "Law": "Stribeck",
                "Stribeck": {
                    "Radius": 0.108, "Viscous Damping": BIT.viscous, "Sticking Speed": BIT.width
                },
            },
            "Top Drive": {
                "Control": "Speed", "Inertia": drive.inertia, "Proportional Gain": drive.kp,
                "Integral Gain": drive.ki
            },
            "Supports": {"Dofs": "torsional"},
            "Transient": {
                "Progress": False, "End Time": 30.0, "Sampling Interval": 0.05,
                "Integrator": "Generalized-alpha", "Step": 1e-2
            },
        })
    run = program.run(name, program.deck(name, deck))
    return run, growth_of_pair(run.time(), run.nodes(THETA_Z, "velocity")[:, -1], 4)


def drive_limits(program):
    """The critical speeds of a stiff drive and of matched ones agree with those of the torsional
    line: growth below, decay above. Between them the motion with the stiff drive grows and with the
    tuned one decays."""
    speeds = {name: critical_speed(drive) for name, drive in DRIVES.items()}
    between = 0.5 * (speeds["stiff"] + speeds["matched, ratio 4"])
    expect("the tuned drive is stable at lower speeds",
           speeds["matched, ratio 4"] < 0.85 * speeds["stiff"], str(speeds))
    for name, speed in (("stiff", 0.97 * speeds["stiff"]), ("stiff", 1.03 * speeds["stiff"]),
                        ("stiff", between), ("matched, ratio 4", between)):
        truth = LINE.rightmost(BIT.slope(speed), DRIVES[name], HIGHEST).real
        run, found = growth(program, f"limits_{name.replace(' ', '_').replace(',', '')}",
                            DRIVES[name], speed)
        expect(f"{name}, {speed:.3f} rad/s: growth {found:+.5f} 1/s of the line's {truth:+.5f}",
               abs(found - truth) < 1e-3 + 0.02 * abs(truth))
        expect(
            f"{name}, {speed:.3f} rad/s: the static state says {run.summary['static']['stable']}",
            run.summary["static"]["stable"] == (truth < 0))
