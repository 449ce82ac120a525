# SPDX-License-Identifier: BSD-3-Clause
"""Friction along the hole (Contact/Friction/Axial): drag of steady sliding by formula, a string
with stick-slip on its way down against scipy, its damped modes and response against a separate
matrix, and a string that begins to turn while it slides."""
import csv
import math

import models
import numpy as np
from checks import expect
from agreement import near
from models import W
from program import FULL
from scipy.integrate import solve_ivp

INCLINATION, OMEGA, ALPHA = math.radians(60), 10.0, 1e-3
RK4 = {"Transient/Integrator": "RK4", "Transient/Step": 2.5e-4}
PIPE = {"Length": 40.0, "Elements": 4, "Outer Radius": 0.0635, "Inner Radius": 0.054}
COUNT, GRAVITY, BORE = 5, 9.81, 0.1
STATIC, DYNAMIC, VELOCITY = 0.3, 0.2, 0.1
WEIGHT = models.DENSITY * models.area(PIPE) * GRAVITY * PIPE["Length"] * COUNT


def mu(v):
    """Nguyen et al. 2020, eq. (9)."""
    xi = math.sqrt(1 - DYNAMIC / STATIC)
    q = 1 / (1 + (1 - xi) / (2 * VELOCITY * DYNAMIC) * np.abs(v))
    return v / (2 * VELOCITY) * ((1 - xi) * q + (1 + xi) * q * q)


def deck(program, name, block, **lists):
    survey = program.work / "inclined.csv"
    survey.write_text(
        f"MD [m], Inc [deg], Azi [deg]\n0, {math.degrees(INCLINATION)!r}, 0\n"
        f"300, {math.degrees(INCLINATION)!r}, 0\n", encoding="utf-8")
    return program.deck(
        name, {
            "Well": {"Trajectory": "Survey", "Survey": {"File": str(survey)}, "Bore Radius": BORE},
            "Drillstring": {
                "Assembly": [f"{COUNT}*pipe"], "Components": {"pipe": PIPE},
                "Material": models.STEEL
            },
            "Supports": {"Bit": "none"},
            "Loads": {"Gravity": GRAVITY},
            "Damping": {"Mass Coefficient": 0.5},
            "Contact": {
                "Stiffness": 1e7, "Damping": 1e4, "Friction": {
                    "Static": STATIC, "Dynamic": DYNAMIC, "Regularisation Velocity": VELOCITY,
                    "Axial": True
                }
            },
            "Top Drive": {"Block Speed": block},
            "Transient": {
                "Progress": False, "Integrator": "Generalized-alpha", "Step": ALPHA,
                "End Time": 0.05, "Sampling Interval": 0.005
            },
            **lists,
        })


def turning(speed):
    return {"Rotary Speed": {"Law": "Constant", "Constant": {"Speed": speed}}}


def steady(program):
    """Hook load w L (cos a -+ mu sin a) of a sliding string; if it also turns, the friction term is
    reduced by v_a/v; at rest and in the steady motion."""
    for name, feed, omega in (("up", -0.3, 0.0), ("down and turning back", 0.2, -OMEGA)):
        run = program.run("steady",
                          deck(program, "steady", feed, **(turning(omega) if omega else {})))
        expect(f"{name}: exit code 0", run.done, run.sentence() if not run.done else "")
        v = math.hypot(feed, omega * PIPE["Outer Radius"])
        along, around = mu(v) * feed / v, mu(v) * omega * PIPE["Outer Radius"] / v
        pressed = run.summary["static"]["total_normal_force"]
        # N and friction of the wall carry the weight across the hole; the first node hangs in the
        # support
        across = WEIGHT * math.sin(INCLINATION) * (
            1 - 0.5 / (COUNT * PIPE["Elements"])) / math.sqrt(1 + around**2)
        near(f"{name}: contact forces", pressed, across, 0.01 * across)
        hook = WEIGHT * math.cos(INCLINATION) - along * pressed
        near(f"{name}: hook load at rest", run.summary["static"]["hook_load"], hook, 1e-6 * hook)
        near(f"{name}: hook load in motion",
             np.abs(run.data("transient/hook_load") - hook).max(), 0.0, 1e-5 * hook)
        near(f"{name}: friction on the nodes",
             run.data("static/axial_friction").sum(), -along * pressed, 1e-6 * pressed)
        near(f"{name}: torque", -run.summary["static"]["top_torque"],
             around * pressed * PIPE["Outer Radius"], 1e-5 * pressed * PIPE["Outer Radius"])
        near(f"{name}: the ledger closes", run.motion["energy_residual"], 0.0, 1e-4)


class Rod:
    """Axial elements below a block that moves down at U, with friction of given normal forces."""
    def __init__(self, normal):
        n = len(normal)
        h = PIPE["Length"] / PIPE["Elements"]
        mass, k = models.DENSITY * models.area(PIPE) * h / 6, models.YOUNG * models.area(PIPE) / h
        M, K = np.zeros((n, n)), np.zeros((n, n))
        for e in range(n - 1):
            at = slice(e, e + 2)
            M[at, at] += mass * np.array([[2.0, 1.0], [1.0, 2.0]])
            K[at, at] += k * np.array([[1.0, -1.0], [-1.0, 1.0]])
        self.M, self.K, self.normal = M[1:, 1:], K[1:, 1:], normal[1:]
        self.C = 0.5 * self.M

    def motion(self, times, feed):
        inverse, n = np.linalg.inv(self.M), len(self.K)

        def rates(_, y):
            w, v = y[:n], y[n:]
            return np.concatenate(
                [v, inverse @ (-self.K @ w - self.C @ v - mu(feed + v) * self.normal)])

        return solve_ivp(rates, (0.0, times[-1]), np.zeros(2 * n), method="DOP853", rtol=1e-9,
                         atol=1e-12, t_eval=times, max_step=1e-3).y[:n].T

    def damping(self, feed):
        """C + mu'(U) N"""
        h = 1e-6
        return self.C + np.diag((mu(feed + h) - mu(feed - h)) / (2 * h) * self.normal)

    def swing(self, omega, feed, force):
        """Complex amplitude of the end under a force there."""
        load = np.zeros(len(self.K))
        load[-1] = force
        return np.linalg.solve(self.K - omega**2 * self.M + 1j * omega * self.damping(feed),
                               load)[-1]

    def roots(self, feed):
        """Roots of s^2 M + s (C + mu'(U) N) + K = 0 with a positive imaginary part."""
        n, inverse = len(self.K), np.linalg.inv(self.M)
        A = np.block([
            [np.zeros((n, n)), np.eye(n)],
            [-inverse @ self.K, -inverse @ self.damping(feed)],
        ])
        s = np.linalg.eigvals(A)
        return s[s.imag > 0]


# parts without retained nodes: friction acts on the modes
PARTS = {
    "Substructures": {"Rule": "By component", "Retained Nodes": "None"},
    "Reduction": {"Mode Selection": {"Modes": 24}},
}


def slipping(program):
    """The static state has no friction but the motion has: the string slows almost to rest and
    moves on. The normal forces do not change."""
    feed, end = 0.03, 0.2
    settings = {
        "Transient/End Time": end, "Transient/Sampling Interval": 0.002, "Static/Friction": "None"
    }
    times = np.arange(0, end + 1e-9, 0.002)
    truth = None
    path = deck(program, "slipping", feed, **PARTS)
    for name, own, without, bound in (
        ("full, RK4", RK4, FULL, 1e-6),
        ("reduced, generalized-alpha", {}, (), 1e-3),
    ):
        run = program.run(f"slipping_{name}", path, {**settings, **own}, without)
        expect(f"slipping, {name}: exit code 0", run.done, run.sentence() if not run.done else "")
        if truth is None:
            truth = Rod(run.data("static/normal_force")).motion(times, feed)
            speeds = np.diff(truth[:, -1]) / 0.002 + feed
            expect("slipping: the end of the string stops and goes on",
                   speeds.min() < 0.1 * feed and speeds.max() > feed,
                   f"{speeds.min():.3g} to {speeds.max():.3g} m/s")
        moved = run.nodes(W)[:, 1:] - run.nodes(W)[0, 1:]
        near(f"slipping, {name}: w over its largest change",
             np.abs(moved - truth).max() / np.abs(truth).max(), 0.0, bound)
        near(f"slipping, {name}: the ledger closes", run.motion["energy_residual"], 0.0, 1e-4)


def slopes(program):
    """Damped modes about sliding: the slope of the friction coefficient acts as damping of the
    axial ones; it is negative here."""
    feed = 0.3
    run = program.run("slopes", deck(program, "slopes", feed), {}, ("Transient",), command="modes",
                      extra=("--count", "80"))
    expect("slopes: exit code 0", run.done, run.sentence() if not run.done else "")
    with open(run.folder / "damped_modes.csv", newline="", encoding="utf-8") as table:
        modes = [
            (float(row["full [Hz]"]), float(row["full_damping"])) for row in csv.DictReader(table)
        ]
    pressed = WEIGHT * math.sin(INCLINATION) / (COUNT * PIPE["Elements"])
    rod = Rod(np.array([pressed] * (COUNT * PIPE["Elements"]) + [0.5 * pressed]))
    root = min(rod.roots(feed), key=abs)
    size = abs(root) / (2 * math.pi)
    expect("slopes: friction feeds the first axial mode", root.real > -0.25,
           f"{root:.4f} 1/s, -0.25 without friction")
    found = min(modes, key=lambda mode: abs(mode[0] - size) + abs(mode[1] + root.real / abs(root)))
    near("slopes: first axial mode [Hz]", found[0], size, 1e-4 * size)
    near("slopes: its growth [1/s]", -found[1] * 2 * math.pi * found[0], root.real,
         0.02 * abs(root.real + 0.25))
    # a force along the string at its end
    end = {"Node": COUNT * PIPE["Elements"] + 1, "Component": "w"}
    sweep = {
        "Excitation": "Harmonic", "Friction": "Sliding", "Lowest Frequency": 5.0,
        "Highest Frequency": 10.0, "Points": 11, "Loads": {"push": {**end, "Value": 100.0}},
        "Outputs": {"end": end}
    }
    run = program.run("sweep", deck(program, "sweep", feed, Response=sweep), {}, ("Transient",),
                      command="response")
    expect("sweep: exit code 0", run.done, run.sentence() if not run.done else "")
    with open(run.folder / "response.csv", newline="", encoding="utf-8") as table:
        rows = [[float(cell) for cell in row[1:4]] for row in list(csv.reader(table))[1:]]
    found = np.array([amplitude * np.exp(1j * phase) for _, amplitude, phase in rows])
    true = np.array([rod.swing(2 * math.pi * frequency, feed, 100.0) for frequency, _, _ in rows])
    near("sweep: response at the end of the string",
         min(np.abs(one - true).max() for one in (found, found.conj())) / np.abs(true).max(), 0.0,
         2e-3)


def spun_up(program):
    """A sliding string begins to turn: torque replaces drag, in both models and with two
    integrators. If only translations are retained, the torque of friction acts on the four modes of
    a part."""
    lists = {
        "Rotary Speed": {
            "Law": "Exponential",
            "Exponential": {"Final Speed": OMEGA, "Time Constant": 0.05},
        }
    }
    settings = {"Transient/End Time": 0.2, "Transient/Step": 5e-4}
    path = deck(program, "spun_up", 0.1, **lists, **PARTS)
    true = None
    few = {
        "Substructures/Retained Nodes": "Gap", "Substructures/Retained Dofs": "Translations",
        "Reduction/Mode Selection/Modes": 4
    }
    for name, own, without, bound in (
        ("full, RK4", RK4, FULL, 0),
        ("reduced, generalized-alpha", {}, (), 1e-3),
        ("reduced, four modes", few, (), 4e-2),
    ):
        run = program.run(f"spun_up_{name}", path, {**settings, **own}, without)
        expect(f"spun up, {name}: exit code 0", run.done, run.sentence() if not run.done else "")
        hook = run.data("transient/hook_load")
        warned = any("may leave to the modes" in warning for warning in run.summary["warnings"])
        expect(f"spun up, {name}: nodes that are not retained are warned of",
               warned == (name == "reduced, generalized-alpha"), run.summary["warnings"])
        near(f"spun up, {name}: the ledger closes", run.motion["energy_residual"], 0.0, 1e-4)
        if true is None:
            true = hook
            expect("spun up: drag gives way",
                   hook.max() - hook[0] > 0.8 * (WEIGHT * math.cos(INCLINATION) - hook[0]),
                   f"{hook[0]:.0f} to {hook.max():.0f} N")
            continue
        near(f"spun up, {name}: hook load over its change",
             np.abs(hook - true).max() / np.ptp(true), 0.0, bound)


def dragging(program):
    steady(program)
    slipping(program)
    slopes(program)
    spun_up(program)
