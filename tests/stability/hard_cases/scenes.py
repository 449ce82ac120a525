# SPDX-License-Identifier: BSD-3-Clause
"""Shared parts of the cases: decks, settings of integrators, a ball, a planar beam, measures of a
motion."""
import math

import numpy as np

from program import FULL, ROOT

COLUMN = ROOT / "tests/stability/equilibrium/column.xml"
LYING = ROOT / "tests/stability/hard_cases/lying.xml"
STRESS = ROOT / "xml/stress_170m.xml"
HELICAL = ROOT / "xml/helical_170m.xml"
GRAVITY = 9.81
U, V, W, THETA_X, THETA_Y, THETA_Z = range(6)

# The pipe of column.xml and lying.xml.
OUTER, INNER, DENSITY, YOUNG, POISSON = 0.0635, 0.054, 7850.0, 2.06e11, 0.3
AREA = math.pi * (OUTER**2 - INNER**2)
INERTIA = math.pi * (OUTER**4 - INNER**4) / 4
SHEAR = YOUNG / (2 * (1 + POISSON))
LENGTH = 12.0
QUANTILES = (5, 25, 50, 75, 95)
RPM = math.pi / 30
EULER = math.pi**2 * YOUNG * INERTIA / LENGTH**2
BUCKLING = EULER / (1 + EULER / (0.9 * SHEAR * AREA))  # Engesser


def alpha(step, radius=0.8, **own):
    """Generalized-alpha with equal steps."""
    chosen = {key.replace("_", " "): value for key, value in own.items()}
    chosen = {"Spectral Radius": float(radius), **chosen}
    return {
        "Transient/Integrator": "Generalized-alpha",
        "Transient/Step": float(step),
        **{f"Transient/Generalized-alpha/{key}": value for key, value in chosen.items()},
    }


def rk4(step=None):
    return {"Transient/Integrator": "RK4", **({"Transient/Step": float(step)} if step else {})}


def rk4_adaptive(tolerance):
    return {
        "Transient/Integrator": "RK4 adaptive",
        "Transient/RK4 adaptive/Tolerance": float(tolerance),
    }


def arkode(tolerance=1e-6):
    return {
        "Transient/Integrator": "SUNDIALS ARKODE",
        "Transient/SUNDIALS ARKODE/Relative Tolerance": float(tolerance),
    }


def times(end, sampling):
    return {"Transient/End Time": float(end), "Transient/Sampling Interval": float(sampling)}


def reduced(modes):
    """Settings of a reduction for decks without one."""
    return {"Reduction/Mode Selection/Modes": int(modes)}


def models(settings):
    """(name, settings, lists left out) of the full and the reduced model of a deck that has a
    reduction."""
    return (("full", settings, FULL), ("reduced", settings, ()))


def transient(settings):
    """Nested lists from settings written as paths, for decks made here."""
    lists = {}
    for path, value in settings.items():
        *names, last = path.split("/")
        at = lists
        for name in names:
            at = at.setdefault(name, {})
        at[last] = value
    return lists


def merged(*trees):
    out = {}
    for tree in trees:
        for key, value in tree.items():
            out[key] = merged(out[key], value) if isinstance(value, dict) and key in out else value
    return out


def parts_deck(program, name, files, settings, **lists):
    """A deck of imported parts {name: file or list}, its lists, and settings written as paths."""
    imported = {
        part: {"File": file} if isinstance(file, str) else file for part, file in files.items()
    }
    return program.deck(name, merged({"Parts": {"Imported": imported}}, lists, transient(settings)))


def planar_beam(elements, length, stiffness, mass, thrust=0.0, rotary=0.0):
    """K, M of an Euler-Bernoulli beam in (v, theta_z) node by node; `thrust` compresses it."""
    h = length / elements
    k = stiffness / h**3 * np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                                     [-12, -6 * h, 12, -6 * h],
                                     [6 * h, 2 * h * h, -6 * h, 4 * h * h]])
    g = thrust / (30 * h) * np.array([[36, 3 * h, -36, 3 * h], [3 * h, 4 * h * h, -3 * h, -h * h],
                                      [-36, -3 * h, 36, -3 * h], [3 * h, -h * h, -3 * h, 4 * h * h]
                                      ])
    m = mass * h / 420 * np.array([
        [156, 22 * h, 54, -13 * h],
        [22 * h, 4 * h * h, 13 * h, -3 * h * h],
        [54, 13 * h, 156, -22 * h],
        [-13 * h, -3 * h * h, -22 * h, 4 * h * h],
    ])
    n = 2 * (elements + 1)
    K, M = np.zeros((n, n)), np.zeros((n, n))
    for e in range(elements):
        at = slice(2 * e, 2 * e + 4)
        K[at, at] += k - g
        M[at, at] += m
    M[1::2, 1::2] += rotary * np.eye(elements + 1)
    return K, M


def growth(t, x, floor, ceiling):
    """Rate [1/s] of the exponential growth of the envelope |x| between two sizes."""
    size = np.maximum.accumulate(np.abs(x))
    inside = (size > floor) & (size < ceiling)
    peaks = inside & (np.abs(x) >= size)
    if peaks.sum() < 3:
        return math.nan
    return np.polyfit(t[peaks], np.log(size[peaks]), 1)[0]


def growth_of_pair(t, x, pairs=1):
    """Rate [1/s] of the fastest-growing pairs remaining at the end of equal samples, by linear
    prediction: x_{k+1} = a x_k + b x_{k-1} ..., whose roots are exp(s dt) (Prony)."""
    late, order = x[len(x) // 2:], 2 * pairs
    prediction = np.linalg.lstsq(
        np.column_stack([late[order - 1 - k:len(late) - 1 - k] for k in range(order)]),
        late[order:], rcond=None)[0]
    return float(np.log(np.abs(np.roots([1.0, *-prediction])).max()) / (t[1] - t[0]))


def relative_error(found, truth):
    """Norm of the difference divided by the norm of the truth about its start."""
    return float(np.linalg.norm(found - truth) / np.linalg.norm(truth - truth[0]))


def lateral_speed(run, begin):
    """Root mean square of the lateral speed over nodes and samples from `begin` [m/s]."""
    late = run.time() >= begin
    u, v = run.nodes(U, "velocity")[late], run.nodes(V, "velocity")[late]
    return float(np.sqrt(np.mean(u**2 + v**2)))


def impulse_rate(run, begin):
    """Mean over time of the sum of all normal forces: impulse per second [N]."""
    late = run.time() >= begin
    return float(run.data("transient/normal_force")[late].sum(axis=1).mean())


def bit_speed(run, begin):
    """Rotary speed of the last node at the samples from `begin` [rad/s]."""
    late = run.time() >= begin
    return run.data("transient/speed")[late] + run.nodes(THETA_Z, "velocity")[late][:, -1]


def bit_quantiles(run, begin):
    """QUANTILES of the rotary speed of the last node [rpm]."""
    return np.percentile(bit_speed(run, begin), QUANTILES) / RPM


def mean_and_error(values):
    """Mean of runs and the half width of its 95 % interval."""
    values = np.asarray(values, float)
    return values.mean(axis=0), 2.1 * values.std(axis=0, ddof=1) / math.sqrt(len(values))


def ensemble(program, name, settings, without, runs, measure, seconds=900):
    """Runs of stress_170m whose weights on bit are 10 N apart: measure(run) of the completed ones
    in rows, and the refused ones. It ends at the second refusal if no run has completed, since the
    others would be refused too."""
    found, refused, last = [], [], None
    for i in range(runs):
        last = program.run(name, STRESS, {**settings, "Loads/Weight On Bit": 1e4 + 10.0 * i},
                           without, seconds=seconds)
        if last.done:
            found.append(measure(last))
        else:
            refused.append(last)
            if len(refused) == min(2, runs) and not found:
                break
    return np.array(found), refused, last
