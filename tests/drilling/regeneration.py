# SPDX-License-Identifier: BSD-3-Clause
"""Growth of steady drilling with a bit that cuts, at the end of a long string: the static state
beside characteristic equations."""
import cmath
import math

import models
from agreement import near
from checks import expect

LENGTH, ELEMENTS, SPEED = 1000.0, 100, 10.0
MASS, STIFFNESS = 0.1, 1e-3  # damping [1/s], [s]
BLADES, RADIUS, ZETA = 5, 0.108, 0.6
DELAY = 2 * math.pi / (BLADES * SPEED)
LINES = 1e7  # [N/m]
PIPE = {**models.PIPE, "Length": LENGTH, "Elements": ELEMENTS}


def compliance(s, modulus, section, top=math.inf):
    """Of the lower end of a uniform line below the stiffness `top`:

        (c + k s)/(E' A q (s + k c)),   c, s = cosh, sinh q L,   k = top/(E' A q),

    E' = E (1 + b s), q^2 = rho (s^2 + a s)/E'; with G and J of a twist."""
    lossy = modulus * (1 + STIFFNESS * s)
    q = cmath.sqrt(models.DENSITY * (s * s + MASS * s) / lossy)
    hold = lossy * section * q / top  # 1/k
    c, h = cmath.cosh(q * LENGTH), cmath.sinh(q * LENGTH)
    return (hold * c + h) / (lossy * section * q * (hold * h + c))


class Drilling:
    """1 + (1 - exp(-s tau)) (A G_w - V/Omega B G_theta), A, B: slopes of weight and torque.
    The lines of an autodriller have the stiffness k s/(s + k (k_p + k_i/s))."""
    def __init__(self, energy, weight, gains=None):
        self.slope = BLADES * RADIUS * ZETA * energy
        self.torque = BLADES * RADIUS**2 * energy / 2
        self.feed = weight / self.slope / DELAY
        self.gains = gains

    def top(self, s):
        if self.gains is None:
            return math.inf
        return LINES * s / (s + LINES * (self.gains[0] + self.gains[1] / s))

    def characteristic(self, s):
        return 1 + (1 - cmath.exp(-s * DELAY)) * (
            self.slope * compliance(s, models.YOUNG, models.area(PIPE), self.top(s)) -
            self.feed / SPEED * self.torque * compliance(s, models.SHEAR, models.polar(PIPE)))

    def rightmost(self):
        """The root with the largest real part below 50 rad/s, by Newton's method."""
        found = []
        for start in (complex(re, 0.5 * k) for re in (0.1, 1.0, 4.0) for k in range(1, 91)):
            s, h = start, 1e-6
            for _ in range(60):
                f = self.characteristic(s)
                change = f * h / (self.characteristic(s + h) - f)
                s -= change
                if abs(change) < 1e-11 or not abs(s) < 100:
                    break
            if 1e-3 < abs(s) < 50 and abs(self.characteristic(s)) < 1e-7:
                found.append(s)
        return max(found, key=lambda s: s.real)


def beside(program, name, truth, energy, lists):
    """The static state of the string beside the characteristic equation."""
    deck = models.string_deck(
        ((PIPE, 1),), **{
            "Well": {
                "Trajectory": "Vertical",
                "Vertical": {"Length": LENGTH, "Inclination": math.radians(30)}, "Bore Radius": 0.12
            }, "Loads": {"Gravity": 9.81},
            "Rotary Speed": {"Law": "Constant", "Constant": {"Speed": SPEED}},
            "Damping": {"Mass Coefficient": MASS, "Stiffness Coefficient": STIFFNESS}, "Bit": {
                "Law": "Cutting", "Cutting": {
                    "Blades": BLADES, "Radius": RADIUS, "Specific Energy": energy,
                    "Inclination": ZETA
                }
            }, "Transient": {"Progress": False, "End Time": 0.01,
                             "Sampling Interval": 0.005}, **lists
        })
    static = program.run(name, program.deck(name, deck)).summary["static"]
    s = truth.rightmost()
    expect(f"{name}: steady drilling is unstable", s.real > 0.05 and not static["stable"], str(s))
    near(f"{name}: growth [1/s]", static["growth_rate"], s.real, 0.02 * s.real)
    near(f"{name}: frequency [Hz]", static["growth_hz"], s.imag / (2 * math.pi),
         2e-3 * s.imag / (2 * math.pi))


def regeneration(program):
    """A string on a smooth wall: with the delay held, the turn of a bit takes torque from it, and
    modes that bend the string hide how it yields along the hole. A bit below an autodriller, of
    whose modes not the least damped one with held states is the one that grows fastest."""
    drilling = Drilling(5e7, 20e3)
    beside(
        program, "behind_bending", drilling, 5e7, {
            "Supports": {"Dofs": "lateral axial torsional"}, "Contact": {
                "Stiffness": 1e7, "Damping": 1e4
            }, "Top Drive": {"Block Speed": drilling.feed}
        })
    gains = 1e-6, 2e-7
    beside(
        program, "below_autodriller", Drilling(1e7, 5e3, gains), 1e7, {
            "Top Drive": {
                "Autodriller": {
                    "Weight On Bit": 5e3, "Proportional Gain": gains[0], "Integral Gain": gains[1]
                }
            }
        })
