# SPDX-License-Identifier: BSD-3-Clause
"""Figures of merit of motions with closed forms: a mass on a spring, whirl of two collars."""
import math

import numpy as np

import models
from checks import expect
from agreement import near
from models import RPM, THETA_Z, W
from scenes import parts_deck


def figures(run, feed):
    """Figures of merit of a cutting bit over the second half of the motion: the work of weight and
    torque divided by the removed rock."""
    found = run.motion["figures"]
    window = run.time() > 1.0 - 1e-9
    weight, torque = (run.data(f"transient/{name}_on_bit")[window] for name in ("weight", "torque"))
    speed = run.data("transient/speed")[window] + run.nodes(THETA_Z, "velocity")[window, -1]
    advance = feed + run.nodes(W, "velocity")[window, -1]
    for name, values in (("weight_on_bit", weight), ("torque_on_bit", torque)):
        for key, value in (("mean", values.mean()), ("rms", np.sqrt(np.mean(values**2))),
                           ("min", values.min()), ("max", values.max())):
            near(f"figures: {name}.{key}", found[name][key], value, 1e-9 * abs(value))
    area = math.pi * models.BORE**2
    energy = np.sum(weight * advance + torque * speed) / (area * advance.sum())
    near("figures: rate of penetration", found["rate_of_penetration"], advance.mean(), 1e-12)
    near("figures: mechanical specific energy", found["specific_energy"], energy, 1e-9 * energy)
    # pure cutting: the torque gives the specific energy on the face of the bit, W v is small in
    # comparison
    near("figures: it is that of the bit",
         found["specific_energy"] / 1e6 * (models.BORE / 0.108)**2, 1.0, 0.1)
    near("figures: stick-slip index", found["stick_slip_index"],
         np.ptp(speed) / (2 * speed.mean()), 1e-9)


def oscillator(program):
    """Figures of merit of a mass on a spring: x = X cos(omega t) has the acceleration amplitude
    omega^2 X, and 1/sqrt(2) of it as rms."""
    mass, stiffness, size = 2.0, 800.0, 1e-3
    omega = math.sqrt(stiffness / mass)
    part = program.part("oscillator", ["u"], np.diag([mass, mass]),
                        stiffness * np.array([[1, -1], [-1, 1]]), np.zeros((2, 2)))
    # symmetric: each mass vibrates against the middle of the spring
    swing = math.sqrt(2) * omega
    starts = {
        f"start {n}": {
            "Part": "string", "Node": n, "Component": "u", "Displacement": sign * size,
            "Velocity": 0.0
        } for n, sign in ((1, 1), (2, -1))
    }
    period = 2 * math.pi / swing
    deck = parts_deck(program, "oscillator", {"string": part}, {"Transient/Progress": False},
                      Parts={"Starts": starts})
    run = program.run(
        "oscillator", deck, {
            "Transient/Integrator": "RK4", "Transient/Step": period / 400,
            "Transient/Sampling Interval": period / 100, "Transient/End Time": 12 * period,
            "Output/Figures/Begin": 4.01 * period
        })
    found = run.motion["figures"]
    for name, amplitude in (("displacement", size), ("acceleration", swing**2 * size)):
        near(f"oscillator: peak of the {name}", found[name]["peak"], amplitude, 1e-5 * amplitude)
        near(f"oscillator: rms of the {name}", found[name]["rms"], amplitude / math.sqrt(2),
             1e-5 * amplitude)


def whirl(program):
    """Figures of whirl of two balanced collars on hinges: a force rotating at omega moves every
    node on a circle at omega, in the sense of the force; the mass of an unbalance turns with the
    string."""
    # hinged at 20 m: 5.5 rad/s, so that the free vibration decays within the 4 s before the window
    collar = {**models.COLLAR, "Length": 10.0, "Elements": 4}
    speed, omega, middle = 12.0, 2 * math.pi * 3.0, collar["Elements"] + 1

    def force(sense):
        one = {"Node": middle, "Value": 500.0, "Frequency": omega / (2 * math.pi)}
        return {
            "Forces": {
                "u": {**one, "Component": "u"},
                "v": {**one, "Component": "v", "Phase": -sense * math.pi / 2},
            }
        }

    for name, loads, rate in (
        ("forward", force(1), omega),
        ("backward", force(-1), -omega),
        ("unbalance", {"Unbalance": {"mass": {"Node": middle, "Moment": 1.0}}}, speed),
    ):
        deck = models.string_deck(
            ((collar, 2),), **{
                "Loads": {"Gravity": 0.0, **loads},
                "Rotary Speed": {"Law": "Constant", "Constant": {"Speed": speed}},
                "Damping": {"Mass Coefficient": 8.0},
                "Supports": {"Top": "u v w theta_z", "Bit": "u v"},
                "Transient": {
                    "Progress": False, "End Time": 5.0, "Sampling Interval": 0.01,
                    "Integrator": "Generalized-alpha", "Step": 2e-3
                },
            })
        run = program.run(f"whirl_{name}", program.deck(f"whirl_{name}", deck),
                          {"Output/Figures/Begin": 4.0})
        found = run.motion["figures"]["whirl"]
        rates = run.data("figures/precession")[1:-1]
        near(f"whirl, {name}: precession of the node farthest off",
             rates[np.argmax(np.abs(rates - rate))], rate, 1e-3 * abs(rate))
        # the ends are held, and all other nodes whirl all the time
        share = len(rates) / (len(rates) + 2)
        for key, wanted in (
            ("forward_share", share if rate > 0 else 0.0),
            ("backward_share", 0.0 if rate > 0 else share),
            ("backward_contact_share", 0.0),
        ):
            near(f"whirl, {name}: {key}", found[key], wanted, 1e-12)
        near(f"whirl, {name}: worst precession", found["worst_precession_rpm"] * RPM, rate,
             1e-3 * abs(rate))
        if rate < 0:  # all nodes do so all the time: the node of the widest orbit is named
            moved = run.data("transient/displacement")[run.time() >= 4.0 - 1e-9][:, :, :2]
            widest = int((moved**2).sum(axis=(0, 2)).argmax()) + 1
            expect(f"whirl, {name}: the node of the widest orbit",
                   found["worst_backward_share_node"] == widest,
                   f"{found['worst_backward_share_node']} {widest}")
