# SPDX-License-Identifier: BSD-3-Clause
"""Growth of steady drilling with a bit that cuts, at the end of a long string that also bends."""
import cmath
import math

import models
from agreement import near
from checks import expect

LENGTH, ELEMENTS, SPEED, FEED = 1000.0, 100, 10.0, 0.01
MASS, STIFFNESS = 0.1, 1e-3  # damping [1/s], [s]
BLADES, RADIUS, ENERGY, ZETA = 5, 0.108, 5e7, 0.6
PIPE = {**models.PIPE, "Length": LENGTH, "Elements": ELEMENTS}


def compliance(s, modulus, section):
    """Of the lower end of a uniform line that is held above: tanh(q L)/(k q) with k = E (1 + b s) A
    and q^2 = rho (s^2 + a s)/(E (1 + b s)); with G and J of a twist."""
    lossy = modulus * (1 + STIFFNESS * s)
    q = cmath.sqrt(models.DENSITY * (s * s + MASS * s) / lossy)
    return cmath.tanh(q * LENGTH) / (lossy * section * q)


def characteristic(s):
    """1 + (1 - exp(-s tau)) (A G_w - V/Omega B G_theta), A, B: slopes of weight and torque."""
    weight = BLADES * RADIUS * ZETA * ENERGY
    torque = BLADES * RADIUS**2 * ENERGY / 2
    delay = 2 * math.pi / (BLADES * SPEED)
    return 1 + (1 - cmath.exp(-s * delay)) * (
        weight * compliance(s, models.YOUNG, models.area(PIPE)) -
        FEED / SPEED * torque * compliance(s, models.SHEAR, models.polar(PIPE)))


def rightmost():
    """The root with the largest real part below 30 rad/s, by Newton's method."""
    found = []
    for start in (complex(re, 0.5 * k) for re in (0.1, 1.0, 4.0) for k in range(61)):
        s = start
        for _ in range(60):
            f, h = characteristic(s), 1e-6
            change = f * h / (characteristic(s + h) - f)
            s -= change
            if abs(change) < 1e-11 or not abs(s) < 100:
                break
        if 1e-3 < abs(s) < 40 and abs(characteristic(s)) < 1e-8:
            found.append(s)
    return max(found, key=lambda s: s.real)


def behind_bending(program):
    """An inclined string on a smooth wall: with the delay held, the turn of a bit takes torque from
    it, and the modes that bend the string hide how it yields along the hole."""
    deck = models.string_deck(
        ((PIPE, 1),), **{
            "Well": {
                "Trajectory": "Vertical",
                "Vertical": {"Length": LENGTH, "Inclination": math.radians(30)}, "Bore Radius": 0.12
            },
            "Supports": {"Dofs": "lateral axial torsional"},
            "Contact": {"Stiffness": 1e7, "Damping": 1e4},
            "Loads": {"Gravity": 9.81},
            "Rotary Speed": {"Law": "Constant", "Constant": {"Speed": SPEED}},
            "Damping": {"Mass Coefficient": MASS, "Stiffness Coefficient": STIFFNESS},
            "Bit": {
                "Law": "Cutting", "Cutting": {
                    "Blades": BLADES, "Radius": RADIUS, "Specific Energy": ENERGY,
                    "Inclination": ZETA
                }
            },
            "Top Drive": {"Block Speed": FEED},
            "Transient": {"Progress": False, "End Time": 0.01, "Sampling Interval": 0.005},
        })
    static = program.run("behind_bending", program.deck("behind_bending", deck)).summary["static"]
    truth = rightmost()
    expect("steady drilling is unstable", truth.real > 0.05 and not static["stable"], str(truth))
    near("growth of the regenerative loop [1/s]", static["growth_rate"], truth.real,
         0.02 * truth.real)
    near("its frequency [Hz]", static["growth_hz"], truth.imag / (2 * math.pi),
         2e-3 * truth.imag / (2 * math.pi))
