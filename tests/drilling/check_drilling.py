#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Laws of bits and top drives in runs of the program, compared with integrations of scipy and
characteristic equations (models.py); figures of merit of motions with closed forms.

    check_drilling.py PROGRAM [NAME ...]           NAME: some of the checks
    check_drilling.py PROGRAM combinations [without-sundials]
                        laws under every integrator (combinations.py)
    check_drilling.py PROGRAM stick_slip_2500m
                        the tables of docs/guide/bit-and-top-drive.md and statements on them
"""
import csv
import math
import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [
    str(HERE.parents[1] / "tests" / "support"),
    str(HERE.parents[1] / "tests/stability/hard_cases")
]
import dragging
import drives
import hoisting
import models
import regeneration
from combinations import combinations
import scene_2500m
from checks import expect, finish
from agreement import near
from models import THETA_Z, W
from program import Program
from inertias import onset, stick_slip, torque_limit
from merits import figures, oscillator, whirl

PIECES = ((models.PIPE, 3), (models.COLLAR, 2))
COLLAR_BIT = {
    "Law": "Stribeck",
    "Stribeck": {"Radius": 0.108, "Viscous Damping": 20.0, "Sticking Speed": 0.1},
}
WEIGHT = 60e3
STRING_BIT = models.Friction(static=WEIGHT * 0.108 * 0.8, dynamic=WEIGHT * 0.108 * 0.5, decay=1.1,
                             viscous=20.0, width=0.1)
SPEED, RISE = 6.0, 0.5


def string(program, name, drive, settings, **lists):
    rotary = {"Law": "Exponential", "Exponential": {"Final Speed": SPEED, "Time Constant": RISE}}
    deck = models.string_deck(
        PIECES, **{
            "Loads": {"Gravity": 9.81, "Weight On Bit": WEIGHT},
            "Rotary Speed": rotary,
            "Damping": {"Mass Coefficient": 0.05},
            "Bit": COLLAR_BIT,
            **lists,
        })
    if drive:
        deck["Top Drive"] = drive
    deck["Transient"] = {
        "Progress": False, "End Time": 12.0, "Sampling Interval": 0.01,
        "Integrator": "Generalized-alpha", "Step": 1e-3
    }
    return program.run(name, program.deck(name, deck), settings)


def strings(program):
    """A string with bit law and speed-controlled drive against scipy; full against reduced; both
    integrators; the ledger."""
    inertia, kp, ki = 1500.0, 2000.0, 1000.0
    drive = {"Control": "Speed", "Inertia": inertia, "Proportional Gain": kp, "Integral Gain": ki}
    times = np.arange(0, 12.0 + 1e-9, 0.01)
    model = models.TorsionalString(PIECES, damping=0.05, inertia=inertia)
    theta, rate = model.integrate(times, lambda t: SPEED * (1 - math.exp(-t / RISE)),
                                  lambda t: SPEED / RISE * math.exp(-t / RISE), STRING_BIT, kp, ki)
    bit = SPEED * (1 - np.exp(-times / RISE)) + rate[:, -1]
    expect("the bit sticks and slips",
           np.mean(np.abs(bit) < STRING_BIT.width) > 0.1 and bit.max() > 1.5 * SPEED,
           f"stuck {np.mean(np.abs(bit) < STRING_BIT.width):.3f}, peak {bit.max():.3f} rad/s")
    full = string(program, "string_full", drive, {})
    rk4 = string(program, "string_rk4", drive,
                 {"Transient/Integrator": "RK4", "Transient/Step": 1e-4})
    reduced = string(program, "string_reduced", drive, {}, Substructures={"Rule": "By component"},
                     Reduction={"Mode Selection": {"Modes": 6}})
    alone = string(program, "string_alone", drive, {"Supports/Dofs": "torsional"})
    for name, run, bound in (
        ("full, generalized-alpha", full, 5e-3),
        ("the same without axial dofs", alone, 5e-3),
        ("full, RK4", rk4, 5e-4),
        ("reduced", reduced, 5e-3),
    ):
        near(f"{name}: largest error of theta_z against scipy",
             np.abs(run.nodes(THETA_Z) - theta).max() / np.abs(theta).max(), 0.0, bound)
        near(f"{name}: the ledger closes", run.motion["energy_residual"], 0.0, 2e-3)
        torque = run.data("transient/torque_on_bit")
        # while the bit sticks, the torque of a step can have any value within the limit of
        # friction, so the mean square is compared
        near(f"{name}: torque on bit",
             np.sqrt(np.mean((torque - STRING_BIT.torque(bit))**2)) / STRING_BIT.static, 0.0,
             4 * bound)
    top = rk4.data("transient/top_drive_torque")
    near("torque of the drive",
         np.abs(top + kp * rate[:, 0] + ki * theta[:, 0]).max() / STRING_BIT.static, 0.0, 5e-3)


def torque_source(program):
    """A constant torque on the inertia of a drive that starts from rest, against scipy."""
    torque, inertia = 5600.0, 1500.0
    times = np.arange(0, 8.0 + 1e-9, 0.01)
    model = models.TorsionalString(PIECES, damping=0.05, inertia=inertia)
    theta, rate = model.integrate(times, lambda t: SPEED * (1 - math.exp(-t / RISE)),
                                  lambda t: SPEED / RISE * math.exp(-t / RISE), STRING_BIT, 0.0,
                                  0.0, torque)
    run = string(program, "torque_source",
                 {"Control": "Torque", "Inertia": inertia, "Torque": torque},
                 {"Transient/End Time": 8.0})
    near("largest error of theta_z",
         np.abs(run.nodes(THETA_Z) - theta).max() / np.abs(theta).max(), 0.0, 1e-3)
    near("torque of the drive",
         np.abs(run.data("transient/top_drive_torque") - torque).max(), 0.0, 1e-9 * torque)
    expect("the bit turns in the end", SPEED + rate[-1, -1] > 1.0, "")


def steady(program):
    """A motion that begins in steady drilling has the static torque and keeps it if steady drilling
    is stable."""
    drive = {"Control": "Impedance Matched", "Inertia": 1500.0, "Tuning Frequency": 0.25}
    rotary = {"Law": "Constant", "Constant": {"Speed": 15.0}}
    run = string(program, "steady", drive, {"Transient/End Time": 5.0}, **{"Rotary Speed": rotary})
    torque = float(STRING_BIT.torque(15.0))
    near("torque of the last element at rest", run.summary["static"]["last_element_torque"],
         -torque, 1e-6 * torque)
    near("torque on bit at the start",
         run.data("transient/torque_on_bit")[0], torque, 1e-9 * torque)
    near("torque of the drive at the start",
         run.data("transient/top_drive_torque")[0], torque, 1e-6 * torque)
    expect(
        "the assessment of the static state sees both laws: that of the bit has no states, and the "
        "integral of the drive is its angle", run.summary["static"]["stability_without"] == [],
        str(run.summary["static"]["stability_without"]))
    near("it stays", np.abs(run.nodes(THETA_Z) - run.nodes(THETA_Z)[0]).max(), 0.0, 1e-6)


def among_bending(program):
    """The torsional growth of a bit law is detected beyond the bending modes of a long string; the
    reference is the Campbell diagram at that speed."""
    deck = HERE.parents[1] / "xml/map_inclined_1000m.xml"
    settings = {
        "Rotary Speed/Law": "Constant", "Rotary Speed/Constant/Speed": "45 rpm",
        "Loads/Weight On Bit": "100 kN"
    }
    lists = ("Rotary Speed/Exponential", "Reduction", "Substructures", "Transient", "Map")
    run = program.run("among_bending", deck, settings, lists)
    window = {
        "Campbell/Lowest Speed": "45 rpm", "Campbell/Highest Speed": "45.1 rpm",
        "Campbell/Points": 2, "Campbell/Lowest Frequency": "0.54 Hz",
        "Campbell/Highest Frequency": "0.62 Hz", "Campbell/Friction": "Sliding"
    }
    diagram = program.run("among_bending_campbell", deck, {**settings, **window}, lists[:-1],
                          command="campbell")
    with open(diagram.folder / "campbell.csv", newline="", encoding="utf-8") as text:
        rows = [{
            name.split(" [")[0]: float(cell) for name, cell in row.items()
            if name.split(" [")[0] in ("frequency", "growth")
        } for row in csv.DictReader(text)]
    truth = max(rows, key=lambda row: row["growth"])
    expect("the first torsional mode of the string grows", truth["growth"] > 0.1, str(truth))
    static = run.summary["static"]
    expect("so does the static state", static["stable"] is False, str(static["stable"]))
    near("growth among bending modes [1/s]", static["growth_rate"], truth["growth"],
         1e-3 * truth["growth"])
    near("its frequency [Hz]", static["growth_hz"], truth["frequency"], 1e-3 * truth["frequency"])


def stuck_with_arkode(program):
    """A bit held by dry friction stays at rest, even if the Newton iteration of a stage meets the
    branch on which it turns."""
    run = program.run("stuck_with_arkode", HERE.parents[1] / "xml/stick_slip_2500m.xml",
                      {"Transient/Integrator": "SUNDIALS ARKODE", "Transient/End Time": 0.44},
                      ("Transient/Step",))
    near("speed of the bit that is held [rad/s]",
         np.abs(run.data("transient/motion")[:, 2]).max(), 0.0, 0.5)


def idle_bits(program):
    """Bits without effect, and drives without a torque or an integral, are refused."""
    cutting = {"Bit/Law": "Cutting", "Bit/Cutting/Radius": 0.1, "Bit/Cutting/Blades": 4}
    feed, steady, backward = (
        {"Top Drive/Block Speed": 1e-3},
        {"Rotary Speed": {"Law": "Constant", "Constant": {"Speed": 10.0}}},
        {
            "Rotary Speed": {"Law": "Constant", "Constant": {"Speed": -10.0}},
        },
    )
    drive = {"Control": "Impedance Matched", "Tuning Frequency": 0.25, "Inertia": 0.0}
    for what, settings, lists, sentence in (
        ("a cutting bit that advances", {**cutting, **feed}, steady, None),
        ("a cutting bit without advance", cutting, steady, "does not advance"),
        ("a cutting bit that turns backward", {**cutting, **feed}, backward, "cuts forward only"),
        ("a torque of the static state from rest", {},
         {"Top Drive": {"Control": "Torque", "Inertia": 1500.0}}, "stands still"),
        ("a tuned drive without inertia", {}, {"Top Drive": drive}, "without Inertia"),
        ("a limit of an integral alone", {}, {
            "Top Drive": {
                "Control": "Speed", "Inertia": 1500.0, "Proportional Gain": 0.0,
                "Integral Gain": 10.0, "Torque Limit": 1e4
            }
        }, "needs a positive Proportional Gain"),
    ):
        own = {} if settings else {
            "Loads": {"Gravity": 9.81, "Weight On Bit": WEIGHT},
            "Bit": COLLAR_BIT,
        }
        rotary = {
            "Rotary Speed": {
                "Law": "Exponential",
                "Exponential": {"Final Speed": SPEED, "Time Constant": RISE},
            }
        }
        deck = models.string_deck(PIECES, **{"Loads": {"Gravity": 9.81}, **own, **rotary, **lists})
        deck["Transient"] = {"End Time": 0.1}
        for path, value in settings.items():
            *names, last = path.split("/")
            at = deck
            for name in names:
                at = at.setdefault(name, {})
            at[last] = value
        run = program.run("idle", program.deck("idle", deck))
        text = " ".join(run.output.split())
        expect(f"{what}: {'accepted' if sentence is None else 'refused'}",
               run.code == (0 if sentence is None else 2) and (sentence or "") in text, text[-300:])


def misfit(t, x, roots):
    """Relative part of x that is not a sum of the modes with these roots."""
    columns = np.column_stack(
        [np.ones(len(t)), *(part(np.exp(s * t)) for s in roots for part in (np.real, np.imag))])
    fit, *_ = np.linalg.lstsq(columns, x, rcond=None)
    return float(np.linalg.norm(x - columns @ fit) / np.linalg.norm(x))


def matched(program):
    """The first torsional mode of a pipe with a free end below a drive: decay against the
    characteristic equation; a drive without inertia at the impedance of the pipe leaves nothing
    after one return of the wave."""
    part = {**models.PIPE, "Length": 1000.0, "Elements": 100}
    zeta, speed = models.impedance(part), math.sqrt(models.SHEAR / models.DENSITY)
    quarter = speed / 4 / 1000.0
    J = 300.0
    cases = {
        "matched": ({"Control": "Impedance Matched", "Inertia": J,
                     "Tuning Frequency": quarter}, zeta, J * (2 * math.pi * quarter)**2, J),
        "half": ({
            "Control": "Impedance Matched", "Inertia": J, "Tuning Frequency": quarter,
            "Impedance Ratio": 0.5
        }, zeta / 2, J * (2 * math.pi * quarter)**2, J),
        "high-pass": ({"Control": "Impedance Matched", "Inertia": J,
                       "High-Pass Frequency": 0.5}, zeta, math.pi * zeta, J),
        "stiff PI": ({
            "Control": "Speed", "Inertia": J, "Proportional Gain": 8 * zeta, "Integral Gain": 0.0
        }, 8 * zeta, 0.0, J),
        "absorbing": ({"Control": "Speed", "Inertia": 0.0,
                       "Proportional Gain": zeta}, zeta, 0.0, 0.0),
    }
    rotary = {"Law": "Constant", "Constant": {"Speed": 10.0}}
    kick = {
        "Forces": {
            "kick": {
                "Node": 101, "Component": "theta_z", "Value": 1000.0, "Frequency": 0.5,
                "Phase": -math.pi / 2, "End Time": 1.0
            }
        }
    }
    for name, (drive, kp, ki, inertia) in cases.items():
        deck = models.string_deck(
            ((part, 1),), **{
                "Loads": kick, "Rotary Speed": rotary, "Top Drive": drive, "Transient": {
                    "End Time": 8.0, "Step": 2e-3, "Sampling Interval": 0.02, "Progress": False
                }
            })
        run = program.run(f"drive_{name.replace(' ', '_')}",
                          program.deck(f"drive_{name.replace(' ', '_')}", deck))
        t, angle, w = run.time(), run.nodes(THETA_Z)[:, -1], run.nodes(THETA_Z, "velocity")[:, -1]
        if name == "absorbing":
            back = 1.0 + 2 * 1000.0 / speed
            near("absorbing: speed after the wave has returned once, over its peak",
                 np.abs(w[t > back + 0.3]).max() / np.abs(w).max(), 0.0, 0.02)
            continue
        roots = {}
        for start in (complex(-a, b) for a in (0.05, 1.0, 4.0) for b in np.linspace(0.3, 80, 400)):
            root = models.drive_root(1000.0, speed, zeta, kp, ki, inertia, start)
            if np.isfinite(root) and -20 < root.real < 0 <= root.imag < 80:
                roots[(round(root.real, 6), round(root.imag, 6))] = root
        slow = min((root for root in roots.values() if root.imag > 0.1), key=lambda root: root.imag)
        later = t > 2.0
        near(
            f"{name}: the motion is that of the modes of the characteristic equation, first s = "
            f"{slow:.4f} 1/s", misfit(t[later], angle[later], roots.values()), 0.0, 5e-3)
        # which nearly removes its first mode by damping
        off = 1.1 if name == "high-pass" else 1.02
        wrong = [root * off if root == slow else root for root in roots.values()]
        expect(f"{name}: a root {100 * (off - 1):.0f} % off would show",
               misfit(t[later], angle[later], wrong) > 0.02, "")


def cutting(program):
    """A cutting bit with coupled axial and torsional loops: static state, and the motion compared
    with a separate integration that solves for the delay; full against reduced; both integrators; a
    free hook."""
    slow, fast, rise, feed = 12.0, 14.0, 0.3, 3e-3
    bit = {"Blades": 4, "Radius": 0.108, "Specific Energy": 1e6, "Inclination": 0.6}
    drive = {
        "Control": "Speed", "Inertia": 1500.0, "Proportional Gain": 2000.0, "Integral Gain": 1000.0,
        "Block Speed": feed
    }
    truth = models.CuttingString(PIECES, 0.5, 1500.0, 4, 0.108, 1e6, 0.6)
    t, found = truth.integrate(
        2.0, 2.5e-4, feed, lambda t: fast + (slow - fast) * math.exp(-t / rise), lambda t:
        (fast - slow) / rise * math.exp(-t / rise), lambda t: fast * t + (slow - fast) * rise *
        (1 - math.exp(-t / rise)), 2000.0, 1000.0)
    every = round(0.01 / (t[1] - t[0]))
    w, theta, depth = found[::every].T
    lists = {
        "Loads": {"Gravity": 9.81},
        "Bit": {"Law": "Cutting", "Cutting": bit},
        "Damping": {"Mass Coefficient": 0.5},
        "Rotary Speed": {
            "Law": "Exponential",
            "Exponential": {"Initial Speed": slow, "Final Speed": fast, "Time Constant": rise},
        },
    }
    short = {"Transient/End Time": 2.0}
    runs = {
        "full, generalized-alpha": string(program, "cutting_full", drive,
                                          {**short, "Transient/Step": 5e-4}, **lists),
        "full, RK4": string(program, "cutting_rk4", drive,
                            {**short, "Transient/Integrator": "RK4", "Transient/Step": 2e-4},
                            **lists),
        "reduced": string(program, "cutting_reduced", drive, {**short, "Transient/Step": 5e-4},
                          **lists, Substructures={"Rule": "By component"},
                          Reduction={"Mode Selection": {"Modes": 6},
                                     "Error Estimate": "Transient"}),
    }
    for name, run in runs.items():
        weight = 4 * 0.108 * 0.6 * 1e6 * depth
        near(f"{name}: weight at rest",
             run.data("transient/weight_on_bit")[0], weight[0], 1e-6 * weight[0])
        near(f"{name}: weight on bit over its change",
             np.abs(run.data("transient/weight_on_bit") - weight).max() / np.ptp(weight), 0.0, 0.01)
        for what, component, exact_ in (("w", W, w), ("theta_z", THETA_Z, theta)):
            moved = run.nodes(component)[:, -1] - run.nodes(component)[0, -1]
            near(f"{name}: {what} of the bit over its change",
                 np.abs(moved - exact_).max() / np.ptp(exact_), 0.0, 0.01)
        near(f"{name}: the ledger closes", run.motion["energy_residual"], 0.0, 2e-3)
    estimate = runs["reduced"].summary["reduction"]["estimate"]["motion_error"]
    expect(
        "reduced: the error of the lateral motion, which there is none of, is estimated beside the "
        "delay", estimate == 0.0, str(estimate))
    for name, run in runs.items():
        without = run.summary["static"]["stability_without"]
        expect(
            f"{name}: the assessment of the static state says that it holds the delay",
            without == ["bit"] and "by the delay of a cutting bit" in " ".join(run.output.split()),
            str(without))
    figures(runs["reduced"], feed)
    hook = string(program, "cutting_hook", {**drive, "Hook": "Constant Load"}, short, **lists)
    near("constant hook load: weight at rest",
         hook.data("transient/weight_on_bit")[0], 4 * 0.108 * 0.6 * 1e6 * depth[0], 1e-3)
    # the hook load and the weight of the string balance the weight on bit of the start
    elements = [(part, part["Length"] / part["Elements"]) for part, count in PIECES
                for _ in range(count * part["Elements"])]
    lumped = np.zeros(len(elements) + 1)
    for e, (part, h) in enumerate(elements):
        lumped[e:e + 2] += models.DENSITY * models.area(part) * h / 2
    samples = hook.data("transient/weight_on_bit")
    times = hook.time()
    change = samples - samples[0]
    drift = np.array([lumped @ v for v in hook.nodes(W, "velocity")])
    # mass damping of 0.5 1/s
    lost = 0.5 * np.concatenate([[0], np.cumsum(0.5 * (drift[1:] + drift[:-1]) * np.diff(times))])
    impulse = -np.concatenate([[0], np.cumsum(0.5 * (change[1:] + change[:-1]) * np.diff(times))])
    near("constant hook load: momentum of the string is the impulse of the weight less damping",
         np.abs(drift + lost - impulse).max() / np.abs(impulse).max(), 0.0, 0.02)


CHECKS = {
    f.__name__: f
    for f in (stick_slip, onset, torque_limit, strings, torque_source, steady, among_bending,
              regeneration.regeneration, stuck_with_arkode, idle_bits, matched, cutting, oscillator,
              whirl, hoisting.tanh_bit, hoisting.penetration_bit, hoisting.autodriller,
              dragging.dragging, drives.drive_limits)
}
ON_REQUEST = {
    "stick_slip_2500m": scene_2500m.stick_slip_2500m,
    "combinations": lambda program: combinations(program, "without-sundials" not in sys.argv)
}


def main():
    program = Program(sys.argv[1], "drilling")
    for name in [name for name in sys.argv[2:] if name != "without-sundials"] or CHECKS:
        {**CHECKS, **ON_REQUEST}[name](program)
    return finish()


if __name__ == "__main__":
    sys.exit(main())
