# SPDX-License-Identifier: BSD-3-Clause
"""Bits with smooth torque curves or with a penetration law, and the autodriller, against closed
forms and separate integrations."""
import csv
import math

import models
import numpy as np
from checks import expect
from agreement import near
from models import THETA_Z, W

ALPHA = {"Transient/Integrator": "Generalized-alpha", "Transient/Step": 1e-3}
RK4 = {"Transient/Integrator": "RK4", "Transient/Step": 1e-4}
PARTS = {"Substructures": {"Rule": "By component"}, "Reduction": {"Mode Selection": {"Modes": 6}}}
PIECES = ((models.PIPE, 3), (models.COLLAR, 2))


def string(program, name, settings, end, lists):
    deck = models.string_deck(
        PIECES, **{"Loads": {"Gravity": 9.81}, "Damping": {"Mass Coefficient": 0.05}, **lists})
    deck["Transient"] = {"Progress": False, "End Time": end, "Sampling Interval": 0.01}
    run = program.run(name, program.deck(name, deck), settings)
    expect(f"{name}: exit code 0", run.done, run.sentence() if not run.done else "")
    return run


def tanh_bit(program):
    """A string from rest below a PI drive, with a smooth torque curve at the bit: scipy, both
    models and integrators, the ledger."""
    weight, speed, rise, inertia, kp, ki = 244.2e3, 8.0, 0.5, 1500.0, 2000.0, 1000.0
    times = np.arange(0, 10.0 + 1e-9, 0.01)
    bit = models.TanhBit(weight)
    theta, rate = models.TorsionalString(PIECES, 0.05, inertia).integrate(
        times, lambda t: speed * (1 - math.exp(-t / rise)),
        lambda t: speed / rise * math.exp(-t / rise), bit, kp, ki)
    w = speed * (1 - np.exp(-times / rise)) + rate[:, -1]
    lists = {
        "Loads": {"Gravity": 9.81, "Weight On Bit": weight},
        "Bit": {"Law": "Tanh"},
        "Top Drive": {
            "Control": "Speed", "Inertia": inertia, "Proportional Gain": kp, "Integral Gain": ki
        },
        "Rotary Speed": {
            "Law": "Exponential",
            "Exponential": {"Final Speed": speed, "Time Constant": rise},
        },
    }
    half = {**ALPHA, "Transient/Step": 5e-4}
    for name, own, more, bound in (("full", half, {}, 2e-3), ("rk4", RK4, {}, 2e-4),
                                   ("reduced", half, PARTS, 2e-3)):
        run = string(program, f"tanh_{name}", own, 10.0, {**lists, **more})
        near(f"tanh, {name}: largest error of theta_z",
             np.abs(run.nodes(THETA_Z) - theta).max() / np.abs(theta).max(), 0.0, bound)
        # at low speed the curve is steep, and a release a few ms early is a large error of the
        # torque, so the mean square is compared
        near(
            f"tanh, {name}: torque on bit",
            np.sqrt(np.mean(
                (run.data("transient/torque_on_bit") - bit.torque(w))**2)) / bit.torque(w).max(),
            0.0, 10 * bound)
        near(f"tanh, {name}: the ledger closes", run.motion["energy_residual"], 0.0, 2e-3)


def penetration_bit(program):
    """Weight and torque of steady drilling by the formula; a motion with a ramp of the speed
    against scipy."""
    slow, fast, rise, feed, kp, ki, inertia = 10.0, 7.0, 0.4, 5e-3, 2000.0, 1000.0, 1500.0
    bit = models.PenetrationBit()
    times = np.arange(0, 6.0 + 1e-9, 0.01)
    advance, rate, _ = models.PenetratingString(PIECES, 0.05, inertia).integrate(
        times, feed, lambda t: fast + (slow - fast) * math.exp(-t / rise), lambda t:
        (fast - slow) / rise * math.exp(-t / rise), kp, ki, bit)
    v, w = feed + advance, fast + (slow - fast) * np.exp(-times / rise) + rate
    weight, torque = bit.weight(v, w), bit.torque(v, w)
    lists = {
        "Bit": {"Law": "Tucker-Wang"},
        "Top Drive": {
            "Control": "Speed", "Inertia": inertia, "Proportional Gain": kp, "Integral Gain": ki,
            "Block Speed": feed
        },
        "Rotary Speed": {
            "Law": "Exponential",
            "Exponential": {"Initial Speed": slow, "Final Speed": fast, "Time Constant": rise},
        },
    }
    for name, own, more, bound in (("full", ALPHA, {}, 5e-3), ("rk4", RK4, {}, 5e-4),
                                   ("reduced", ALPHA, PARTS, 5e-3)):
        run = string(program, f"penetration_{name}", own, 6.0, {**lists, **more})
        near(f"penetration, {name}: weight at rest",
             run.data("transient/weight_on_bit")[0], bit.weight(feed, slow), 1e-6 * weight[0])
        near(f"penetration, {name}: torque of the last element at rest",
             run.summary["static"]["last_element_torque"], -bit.torque(feed, slow),
             1e-6 * torque[0])
        near(f"penetration, {name}: weight over its change",
             np.abs(run.data("transient/weight_on_bit") - weight).max() / np.ptp(weight), 0.0,
             bound)
        near(f"penetration, {name}: torque over its change",
             np.abs(run.data("transient/torque_on_bit") - torque).max() / np.ptp(torque), 0.0,
             bound)
        near(f"penetration, {name}: the ledger closes", run.motion["energy_residual"], 0.0, 2e-3)
    low = string(program, "penetration_low", ALPHA, 0.5,
                 {**lists, "Top Drive": {**lists["Top Drive"], "Block Speed": 2e-3}})
    expect(
        "penetration: a weight outside of the calibration is said, at rest and in motion",
        f"of the static state is {bit.weight(2e-3, slow) / 1e3:.1f} kN, outside of the 100.0 to "
        "250.0 kN" in " ".join(low.output.split())
        and any("of the motion" in one for one in low.summary["warnings"]),
        str(low.summary["warnings"]))


PIPE = {**models.PIPE, "Length": 1000.0, "Elements": 1}
SPEED, LINE, KP, KI, BLOCK = 10.0, 8e6, 1e-7, 1e-8, 20e3


def driller(program, name, top, end=60.0, settings=None, **lists):
    """One element between lines and bit; the bit turns with the drive."""
    deck = models.string_deck(
        ((PIPE, 1),), **{
            "Loads": {"Gravity": 9.81},
            "Supports": {"Dofs": "axial torsional", "Bit": "theta_z"},
            "Bit": {"Law": "Tucker-Wang"},
            "Rotary Speed": {"Law": "Constant", "Constant": {"Speed": SPEED}},
            "Top Drive": top,
            "Transient": {"Progress": False, "End Time": end, "Sampling Interval": 0.05},
            **lists,
        })
    return program.run(name, program.deck(name, deck),
                       {**ALPHA, "Transient/Step": 5e-3, **(settings or {})})


def ahead(program, own):
    """In torque and drag, a string with an autodriller drills ahead with the set weight and with
    the torque of the bit at the speed of the operation."""
    bit = models.PenetrationBit()
    for name, rotary in (
        ("constant", {"Law": "Constant", "Constant": {"Speed": SPEED}}),
        ("from rest", {
            "Law": "Exponential",
            "Exponential": {"Final Speed": SPEED, "Time Constant": 1.0},
        }),
    ):
        deck = models.string_deck(
            ((PIPE, 1),), **{
                "Loads": {"Gravity": 9.81},
                "Supports": {"Bit": "theta_z"},
                "Bit": {"Law": "Tucker-Wang"},
                "Rotary Speed": rotary,
                "Top Drive": {"Autodriller": own},
                "Contact": {
                    "Stiffness": 1e7, "Damping": 1e4, "Friction": {"Static": 1e-6, "Dynamic": 1e-6}
                },
                "Torque and Drag": {"Count": 1, "Stiff String": "None"},
                "Transient": {"End Time": 1.0},
            })
        for speed, settings in ((SPEED, {}), (6.0, {"Torque and Drag/Rotary Speed": 6.0})):
            run = program.run("ahead", program.deck("ahead", deck), settings, command="torque-drag")
            with open(run.folder / "torque_drag.csv", newline="", encoding="utf-8") as text:
                rows = {
                    row["operation"]: {key.split(" [")[0]: cell for key, cell in row.items()
                                       } for row in csv.DictReader(text)
                }
            off, on = (rows[operation] for operation in ("Rotate off bottom", "Drill rotating"))
            weight = float(off["hook_load"]) - float(on["hook_load"])
            near(f"autodriller, {name}, {speed:g} rad/s: drills ahead with its weight", weight,
                 own["Weight On Bit"], 1e-3 * own["Weight On Bit"])
            advance = (weight - float(bit.weight(0.0, speed))) / float(bit.factor(speed))
            near(f"autodriller, {name}, {speed:g} rad/s: torque of the bit",
                 float(on["surface_torque"]) - float(off["surface_torque"]),
                 float(bit.torque(advance, speed)), 10.0)


def two_sensors(program, top):
    """Measured weight and hook load for an accelerated block: W = W_0 - (H - H_0) + m_b w_1'', and
    the inertia of the first element."""
    own = {**top["Autodriller"], "Proportional Gain": 1e-6, "Integral Gain": 1e-7}
    run = driller(program, "driller_sensors", {**top, "Autodriller": own}, 5.0,
                  {"Output/Fields": "{displacement, acceleration}"})
    weight, hook, steps = run.data("transient/measured_weight"), run.data(
        "transient/hook_load"), run.nodes(W, "acceleration")
    pipe = models.DENSITY * models.area(PIPE) * PIPE["Length"]
    between = weight - weight[0] + hook - hook[0]
    inertia = own["Block Mass"] * steps[:, 0] + pipe * (steps[:, 0] / 3 + steps[:, 1] / 6)
    expect("autodriller: the block jerks", np.abs(between).max() > 1e3, np.abs(between).max())
    near("autodriller: hook load and measured weight differ by the inertia between them",
         np.abs(between - inertia).max() / np.abs(between).max(), 0.0, 5e-3)


def autodriller(program):
    """The loop of block, lines, pipe and bit: linear motion and closed-loop poles; initial block
    speed; limits."""
    bit = models.PenetrationBit()
    slope, begin, lack = float(bit.factor(SPEED)), 120e3, 60e3
    feed = (begin - float(bit.weight(0.0, SPEED))) / slope
    own = {
        "Weight On Bit": begin + lack, "Proportional Gain": KP, "Integral Gain": KI,
        "Line Stiffness": LINE, "Block Mass": BLOCK
    }
    loop = models.DrillerLoop(PIPE, LINE, slope, KP, KI, BLOCK)
    times = np.arange(0, 60.0 + 1e-9, 0.05)
    more, rate = loop.motion(times, lack)
    for name, settings, lists, bound in (
        ("full", {}, {}, 2e-3),
        ("rk4", {**RK4, "Transient/End Time": 10.0}, {}, 2e-5),
        ("reduced", {}, {
            "Substructures": {"Rule": "By component"},
            "Reduction": {"Mode Selection": {"Modes": 2}},
        }, 2e-3),
    ):
        run = driller(program, f"driller_{name}", {"Block Speed": feed, "Autodriller": own},
                      settings=settings, **lists)
        count = len(run.time())
        near(f"autodriller, {name}: measured weight over its change",
             np.abs(run.data("transient/measured_weight") - begin - more[:count]).max() / lack, 0.0,
             bound)
        near(f"autodriller, {name}: speed of the block over its change",
             np.abs(run.data("transient/block_speed") - feed - rate[:count]).max() / np.ptp(rate),
             0.0, bound)
        near(f"autodriller, {name}: the ledger closes", run.motion["energy_residual"], 0.0, 2e-3)
    poles = loop.poles(KI)
    slow = np.sort_complex(np.linalg.eigvals(loop.A))
    for pole in poles:  # masses shift them only slightly
        near(f"autodriller: a pole of the loop is s = {pole:.4f} 1/s, without masses; off by",
             np.abs(slow - pole).min() / abs(pole), 0.0, 0.02)
    run = driller(program, "driller_found", {"Autodriller": {**own, "Weight On Bit": begin + lack}},
                  5.0)
    settled = feed + lack / slope
    near("autodriller: the block speed of its weight",
         run.data("transient/block_speed")[0], settled, 1e-9)
    near("autodriller: stays there",
         np.abs(run.data("transient/measured_weight") - begin - lack).max(), 0.0, 1.0)
    full = driller(program, "driller_end", {"Block Speed": feed, "Autodriller": own}, 200.0,
                   {"Transient/Step": 0.02})
    near("autodriller: the weight on bit in the end",
         full.data("transient/weight_on_bit")[-1], begin + lack, 1e-3 * lack)
    near("autodriller: the speed of the block in the end",
         full.data("transient/block_speed")[-1], settled, 1e-3 * settled)
    two_sensors(program, {"Block Speed": feed, "Autodriller": own})
    ahead(program, own)
    limit = feed + 0.5 * lack / slope
    run = driller(program, "driller_limit",
                  {"Block Speed": feed, "Autodriller": {**own, "Largest Block Speed": limit}},
                  200.0, {"Transient/Step": 0.02})
    speeds = run.data("transient/block_speed")
    near("autodriller: its limit holds", speeds.max(), limit, 1e-12)
    near("autodriller: the weight of the limit",
         run.data("transient/weight_on_bit")[-1], begin + 0.5 * lack, 1e-3 * lack)
    run = driller(program, "driller_slow", {
        "Block Speed": feed,
        "Autodriller": {**own, "Weight On Bit": 10e3, "Proportional Gain": 1e-6},
    }, 10.0)
    near("autodriller: the block stands and does not go up",
         run.data("transient/block_speed").min(), 0.0, 1e-12)
