# SPDX-License-Identifier: BSD-3-Clause
"""Growth of steady drilling with a cutting bit at the end of a long string: the static state
compared with characteristic equations."""
import cmath
import math
import pathlib

import models
from agreement import near
from checks import expect

SCENE = pathlib.Path(__file__).resolve().parents[2] / "xml" / "drilling_1000m.xml"
LENGTH, SPEED, DAMPING = 1000.0, 10.0, (0.1, 1e-3)
BLADES, RADIUS, ZETA = 5, 0.108, 0.6
LINES, HELD = 1e7, 1e30  # [N/m]
PIPE = {**models.PIPE, "Length": LENGTH, "Elements": 100}
INCH = 0.0254


def stiffness(s, pieces, modulus, section, top):
    """Dynamic stiffness at the lower end of uniform pieces below the stiffness `top`: for each
    piece Z (T + Z t)/(Z + T t), where T is the stiffness of the pieces above, Z = E (1 + b s) A q,
    t = tanh q L and q^2 = rho (s^2 + a s)/(E (1 + b s)); for torsion with G and J."""
    below = top
    a, b = pieces[0]["Damping"]
    for piece in pieces:
        lossy = modulus * (1 + b * s)
        q = cmath.sqrt(models.DENSITY * (s * s + a * s) / lossy)
        z, t = lossy * section(piece) * q, cmath.tanh(q * piece["Length"])
        below = z * (below + z * t) / (z + below * t)
    return below


class Drilling:
    """1 + (1 - exp(-s tau)) (A/K_w - V/Omega B/K_theta) with the slopes A, B of weight and torque
    and the stiffnesses K of the string. The lines of an autodriller have k s/(s + k (k_p + k_i/s)),
    a drive with a controller J s^2 + k_p s + k_i."""
    def __init__(self, bit, pieces, speed, gains=None, drive=None):
        """`bit`: blades, radius, specific energy; `gains`: k_p, k_i; `drive`: J, k_p, k_i."""
        blades, radius, energy = bit
        self.slope, self.torque = blades * radius * ZETA * energy, blades * radius**2 * energy / 2
        self.delay, self.speed = 2 * math.pi / (blades * speed), speed
        self.pieces, self.gains, self.drive = pieces, gains, drive
        self.feed = 0.0

    def under(self, weight):
        """Sharp blades with this weight on bit."""
        self.feed = weight / self.slope / self.delay
        return self

    def characteristic(self, s):
        hook = drive = HELD
        if self.gains:
            hook = LINES * s / (s + LINES * (self.gains[0] + self.gains[1] / s))
        if self.drive:
            drive = (self.drive[0] * s + self.drive[1]) * s + self.drive[2]
        along = stiffness(s, self.pieces, models.YOUNG, models.area, hook)
        around = stiffness(s, self.pieces, models.SHEAR, models.polar, drive)
        return 1 + (1 - cmath.exp(-s * self.delay)) * (
            self.slope / along - self.feed / self.speed * self.torque / around)

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


def beside(name, run, drilling):
    """The static state of the run compared with the characteristic equation."""
    static, s = run.summary["static"], drilling.rightmost()
    expect(f"{name}: steady drilling is unstable", s.real > 0.05 and not static["stable"], str(s))
    near(f"{name}: growth [1/s]", static["growth_rate"], s.real, 0.02 * s.real)
    near(f"{name}: frequency [Hz]", static["growth_hz"], s.imag / (2 * math.pi),
         2e-3 * s.imag / (2 * math.pi))


def uniform(program, name, energy, lists):
    """An inclined kilometre of pipe."""
    deck = models.string_deck(
        ((PIPE, 1),), **{
            "Well": {
                "Trajectory": "Vertical",
                "Vertical": {"Length": LENGTH, "Inclination": math.radians(30)}, "Bore Radius": 0.12
            }, "Loads": {"Gravity": 9.81},
            "Rotary Speed": {"Law": "Constant", "Constant": {"Speed": SPEED}},
            "Damping": dict(zip(("Mass Coefficient", "Stiffness Coefficient"), DAMPING)), "Bit": {
                "Law": "Cutting", "Cutting": {
                    "Blades": BLADES, "Radius": RADIUS, "Specific Energy": energy,
                    "Inclination": ZETA
                }
            }, "Transient": {"Progress": False, "End Time": 0.01,
                             "Sampling Interval": 0.005}, **lists
        })
    return program.run(name, program.deck(name, deck))


def regeneration(program):
    """Three scenes. A string on a smooth wall: with the delay held, the rotation of the bit reduces
    its torque, and bending modes mask the compliance along the hole. A bit below an autodriller:
    the mode that grows fastest is not the least damped one with held states. A scene with collars:
    its growing mode is close to another one."""
    pipe = [{**PIPE, "Damping": DAMPING}]
    drilling = Drilling((BLADES, RADIUS, 5e7), pipe, SPEED).under(20e3)
    beside(
        "behind bending",
        uniform(
            program, "behind_bending", 5e7, {
                "Supports": {"Dofs": "lateral axial torsional"}, "Contact": {
                    "Stiffness": 1e7, "Damping": 1e4
                }, "Top Drive": {"Block Speed": drilling.feed}
            }), drilling)
    driller = {"Weight On Bit": 5e3, "Proportional Gain": 1e-6, "Integral Gain": 2e-7}
    beside("below an autodriller",
           uniform(program, "below_autodriller", 1e7, {"Top Drive": {"Autodriller": driller}}),
           Drilling((BLADES, RADIUS, 1e7), pipe, SPEED, gains=(1e-6, 2e-7)).under(5e3))
    pieces = [{
        "Length": length, "Outer Radius": outer * INCH / 2, "Inner Radius": inner * INCH / 2,
        "Damping": (0.1, 0.5e-3)
    } for length, outer, inner in ((805.5, 5, 4.276), (144, 6.75, 2.8125), (0.5, 6, 2.5))]
    drilling = Drilling((4, 4.25 * INCH, 60e6), pieces, 4 * math.pi, gains=(1e-8, 1e-8),
                        drive=(2500, 1000, 500))
    drilling.feed = 15 / 3600
    beside(
        SCENE.stem,
        program.run("drilling_1000m", SCENE, {"Transient/End Time": "0.02 s"}, ("Measured Log",)),
        drilling)
