# SPDX-License-Identifier: BSD-3-Clause
"""Loss of stability: buckling with and without a wall, indefinite interiors, flutter, unsymmetric
stiffness."""
import csv
import math

import numpy as np
from scipy.linalg import eig, eigh

from rows import Plot, against, case, judged, refusal, statement
from scenes import (AREA, BUCKLING, COLUMN, DENSITY, INERTIA, INNER, LENGTH, OUTER, U, V, YOUNG,
                    alpha, arkode, growth, growth_of_pair, parts_deck, planar_beam, reduced, rk4,
                    times)

ALONE = ("Contact",)
WAVE = math.pi / LENGTH
MODAL_MASS = DENSITY * (AREA + INERTIA * WAVE**2)  # mass of the half wave per length [kg/m]
PUSH = {
    f"Loads/Forces/push/{key}": value
    for key, value in (("Node", 13), ("Component", "u"), ("Value", 1.0), ("End Time", 0.01),
                       ("Start Time", 0.001))
}


def rate(load):
    """Positive beyond the buckling load: growth rate of the half wave; negative below: frequency
    [rad/s]."""
    square = (load - 1) * BUCKLING * WAVE**2 / MODAL_MASS
    return math.copysign(math.sqrt(abs(square)), square)


def table(run, name):
    with open(run.folder / name, encoding="utf-8") as file:
        return [{
            key.split(" ")[0]: float(value) if value else math.nan for key, value in row.items()
        } for row in csv.DictReader(file)]


def damped(run, which):
    """s [1/s] of the damped modes, of the full or the coupled model."""
    found = table(run, "damped_modes.csv")
    size = 2 * math.pi * np.array([row[which] for row in found])
    imaginary = 2 * math.pi * np.array([row[which + "_im"] for row in found])
    return -np.array([row[which + "_damping"] for row in found]) * size + 1j * imaginary


def rightmost(M, C, K):
    """Eigenvalue of largest real part of s^2 M + s C + K."""
    n = len(M)
    inverse = np.linalg.inv(M)
    return max(
        eig(np.block([[np.zeros((n, n)), np.eye(n)], [-inverse @ K, -inverse @ C]]), right=False),
        key=lambda s: s.real)


def ways(short):
    some = [("generalized-alpha 1 ms, radius 0.8", alpha(1e-3))]
    return some if short else some + [
        ("generalized-alpha 1 ms, radius 0", alpha(1e-3, 0.0)),
        ("generalized-alpha 1 ms, radius 1", alpha(1e-3, 1.0)),
        ("RK4", rk4()),
        ("ARKODE 1e-6", arkode(1e-6)),
    ]


@case(11, "Near the buckling load, without a wall", "weight on bit 0.5 to 3 of the buckling load "
      "of 12 m of pipe; three integrators, full and reduced",
      "omega_1 -> 0 as sqrt(1 - P/P_c); beyond, growth at "
      "sqrt(abs(lambda)), and the static state is said to be unstable", "half of the load")
def buckling(program, short):
    series = {"truth": [(x, abs(rate(x))) for x in np.linspace(0.5, 3, 200)]}
    for load in (0.99,) if short else (0.5, 0.9, 0.99, 0.999):
        for model, more in (("full", {}),) if short else (("full", {}), ("reduced", reduced(6))):
            run = program.run("c11_modes", COLUMN,
                              {"Loads/Weight On Bit": load * BUCKLING, **more, **times(1.0, 0.1)},
                              ALONE, command="modes", extra=("--count", "4"))

            def first():
                found = 2 * math.pi * abs(table(run, "modes.csv")[0]["coupled" if more else "full"])
                series.setdefault(f"omega_1, {model}", []).append((load, found))
                return against(abs(rate(load)), found)

            yield judged(run, f"modes, {model}: omega_1 [rad/s]", f"P/P_c {load:g}", first, 0.01,
                         required=True)
    for load in (1.05,) if short else (1.01, 1.1, 1.5, 3.0):
        exact = rate(load)
        easy = None
        for label, way in ways(short):
            for model, more in (("full", {}),) if short else (
                ("full", {}),
                ("reduced", reduced(6)),
            ):
                end = min(12.0 / exact, 8.0)
                settings = {
                    **PUSH, **times(end, 0.002), **way,
                    **more, "Loads/Weight On Bit": load * BUCKLING
                }
                run = program.run("c11", COLUMN, settings, ALONE)
                easy = easy or run
                if run.done:
                    static = run.summary["static"]
                    yield statement(
                        f"static state, {label}, {model}", f"P/P_c {load:g}",
                        f"unstable, {exact:.4g} 1/s",
                        f"stable {static['stable']}, {static['growth_rate']:.4g} 1/s",
                        not static["stable"] and abs(static["growth_rate"] - exact) < 0.01 * exact
                        and any("unstable" in w for w in run.summary["warnings"]))

                def grows():
                    x = run.nodes(U)[:, 12]
                    found = growth(run.time(), x, 0.02 * np.abs(x).max(), np.abs(x).max())
                    series.setdefault(f"growth, {label}, {model}", []).append((load, found))
                    return against(exact, float(found))

                yield judged(run, f"growth [1/s], {label}, {model}", f"P/P_c {load:g}", grows, 0.01,
                             easy=easy, required=(label, model) != ("RK4", "reduced"),
                             note="unstable as it must be")
    if not short:
        yield Plot("buckling", "Frequency and growth rate beside the buckling load", "P / P_c",
                   "[1/s]", series)


@case(12, "Buckled in a bore",
      "1.01 to 9 times the buckling load; walls 1e6 to 1e10 N/m; clearance 5 to 44 mm",
      "rest on the wall is found and is stable, and the check is printed; a motion from the "
      "straight state ends there", "below the buckling load")
def in_a_bore(program, short):
    easy = program.run("c12_easy", COLUMN,
                       {"Loads/Weight On Bit": 0.9 * BUCKLING, "Static/Unstable State": "Perturb"})
    for clearance in (0.0445,) if short else (0.005, 0.0445):
        for wall in (1e8,) if short else (1e6, 1e8, 1e10):
            for load in (1.5,) if short else (1.01, 1.5, 2.5, 4.0, 9.0):
                settings = {
                    "Well/Bore Radius": OUTER + clearance, "Contact/Stiffness": wall,
                    "Loads/Weight On Bit": load * BUCKLING
                }
                run = program.run("c12", COLUMN, {**settings, "Static/Unstable State": "Perturb"})

                def rest():
                    static = run.summary["static"]
                    good = (static["stable"] and static["negative_pivots"] == 0
                            and static["contact_nodes"] > 0 and static["perturbations"] > 0
                            and static["residual"] < 1e-9 and "stable" in run.output)
                    return (
                        "stable, on the wall, printed",
                        f"stable {static['stable']}, {static['negative_pivots']} negative pivots, "
                        f"{static['contact_nodes']} contacts", 0.0 if good else math.inf)

                yield judged(run, f"clearance {1e3 * clearance:g} mm, wall {wall:.0e} N/m",
                             f"P/P_c {load:g}", rest, 0.0, easy=easy, required=load <= 4.0)
                if load > 1.5 or wall != 1e8 or not run.done:
                    continue  # beyond this load several states are stable
                moved = program.run(
                    "c12_motion", COLUMN, {
                        **settings, **PUSH, "Loads/Forces/push/Value": 100.0,
                        "Damping/Mass Coefficient": 8.0, **times(45.0 if load < 1.2 else 5.0, 0.05),
                        **alpha(2.5e-4)
                    })

                def ends():
                    u, v = (moved.nodes(c)[-1] for c in (U, V))
                    at = run.data("static/displacement")
                    true = np.hypot(at[:, U], at[:, V])
                    return float(true.max()), float(np.hypot(u, v).max()), float(
                        np.abs(np.hypot(u, v) - true).max() / true.max())

                yield judged(moved,
                             f"motion, clearance {1e3 * clearance:g} mm: largest deflection [m]",
                             f"P/P_c {load:g}", ends, 0.01, required=True)


def thrust_beam(thrust, elements=8, length=2.0):
    """K, M of a beam of unit stiffness and mass per length under a thrust."""
    return planar_beam(elements, length, 1.0, 1.0, thrust)


def starts(displacement, elements):
    """Lists that displace two joined beams; dofs (v, theta_z) node by node; the joined node has its
    name on the left."""
    lists = {}
    for i, x in enumerate(displacement):
        node, component = i // 2, ("v", "theta_z")[i % 2]
        part, first = ("left", 0) if node <= elements else ("right", elements)
        if x != 0.0:
            lists[f"{part} {node} {component}"] = {
                "Part": part, "Node": node - first + 1, "Component": component,
                "Displacement": float(x)
            }
    return lists


@case(13, "Indefinite interior of a part", "thrust 0.5 to 4 of the critical load of the interior "
      "of each of two joined beams; 2 to 8 modes",
      "negative pivots are counted; modes of negative omega^2 are kept, or "
      "the part is refused; the growth rate is that of the whole beam", "half of the critical load")
def indefinite_interior(program, short):
    critical = 20.19 / 2.0**2  # one half: pinned, and clamped at the interface
    elements = 8
    for share in (1.5,) if short else (0.5, 0.99, 1.01, 1.5, 4.0):
        K, M = thrust_beam(share * critical)
        half = lambda held: program.part(
            f"half_{'left' if held else 'right'}", ["v", "theta_z"], M, K, sets={
                "middle": [elements + 1 if held else 1],
                "end": [1 if held else elements + 1],
            })
        parts = {
            "left": {"File": half(True), "Fixed": ["end v"]},
            "right": {"File": half(False), "Fixed": ["end v"]},
        }
        n = len(M)
        K2, M2 = (np.zeros((2 * n - 2, 2 * n - 2)) for _ in range(2))
        for A, B in ((K2, K), (M2, M)):
            A[:n, :n] += B
            A[n - 2:, n - 2:] += B
        keep = [i for i in range(2 * n - 2) if i not in (0, 2 * n - 4)]
        K2, M2 = K2[np.ix_(keep, keep)], M2[np.ix_(keep, keep)]
        truth = rightmost(M2, 0 * M2, K2).real
        start = np.zeros(2 * n - 2)
        start[keep] = eigh(K2, M2, subset_by_index=(0, 0))[1][:, 0]
        start *= 1e-3 / np.abs(start[0::2]).max()
        joints = {"Joints": ["left:middle = right:middle"], "Starts": starts(start, elements)}
        inner = int(np.sum(np.linalg.eigvalsh(K[np.ix_(range(1, n - 2), range(1, n - 2))]) < 0))
        ways = [(modes, f"{modes} modes", alpha(0.005 / truth))
                for modes in ((4,) if short else (2, 4, 8))]
        if not short:
            ways += [(4, "4 modes, RK4", rk4()), (4, "4 modes, ARKODE 1e-6", arkode(1e-6))]
        for modes, label, way in ways:
            settings = {**times(12.0 / truth, 0.05 / truth), **way}
            deck = parts_deck(program, "c13", parts, {**settings, **reduced(modes)}, Parts=joints)
            run = program.run("c13", deck)
            listed = program.run("c13_modes", deck, command="modes", extra=("--count", "6"))

            def grows():
                x = run.nodes(0)[:, int(np.abs(start[0::2]).argmax())]  # not a node of the mode
                return against(
                    float(truth),
                    float(growth(run.time(), x, 0.02 * np.abs(x).max(),
                                 np.abs(x).max())))

            yield judged(run, f"growth of the motion [1/s], {label}",
                         f"thrust {share:g} of the interior's critical load", grows, 0.01,
                         required=True, note="unstable as it must be")

            def pivots():
                lowest = table(listed, "modes.csv")
                found = [row["coupled"] for row in lowest if row["coupled"] < 0]
                true = [row["full"] for row in lowest if row["full"] < 0]
                return (f"{len(true)} negative, interior {inner}", f"{len(found)} negative",
                        max([abs(a / b - 1) for a, b in zip(sorted(found), sorted(true))],
                            default=0.0) if len(found) == len(true) else math.inf)

            yield judged(listed, f"modes of omega^2 < 0, {label}", f"thrust {share:g}", pivots,
                         0.01 if modes > 2 else 0.05, required=True)


@case(14, "Flutter, Greenhill's torque, flowing mud", "skew stiffness 0.5 to 5 of the flutter "
      "threshold; torque 0.9 to 2 of Greenhill's; mud speed 0.9 to 1.5 of the divergence speed; "
      "spectral radii 0 to 1, three integrators",
      "the growth rate is that of the complex eigenvalue within 1 %; the integrator does "
      "not damp it away; below the threshold nothing grows", "below the threshold")
def flutter(program, short):
    yield from circulatory(program, short)
    yield from greenhill(program, short)
    yield from mud(program, short)


def circulatory(program, short):
    """Two coordinates with the stiffness [k_1 s; -s k_2]: flutter beyond s = (k_1 - k_2) / 2."""
    k1, k2 = (2 * math.pi * 5)**2, (2 * math.pi * 4)**2
    threshold = 0.5 * (k1 - k2)
    series = {"truth": []}
    for share in (1.5,) if short else (0.9, 1.05, 1.5, 5.0):
        K = np.array([[k1, share * threshold], [-share * threshold, k2]])
        truth = rightmost(np.eye(2), np.zeros((2, 2)), K)
        series["truth"].append((share, max(0.0, truth.real)))
        file = program.part("flutter", ["u", "v"], np.eye(2), K)
        kick = {
            "Starts": {
                "kick": {"Part": "rotor", "Node": 1, "Component": "u", "Displacement": 1e-3}
            }
        }
        easy = None
        for label, way in ways(short):
            end = 10.0 / truth.real if truth.real > 0.5 else 3.0
            run = program.run(
                "c14",
                parts_deck(program, "c14", {"rotor": file}, {**times(end, 0.002), **way},
                           Parts=kick))
            easy = easy or run

            def grows():
                x = run.nodes(0)[:, 0]
                if truth.real < 1e-6:
                    return "bounded", f"largest {np.abs(x).max():.3g} m", 0.0 if np.abs(
                        x).max() < 0.02 else math.inf
                found = growth_of_pair(run.time(), x)
                series.setdefault(label, []).append((share, found))
                return against(float(truth.real), float(found))

            yield judged(run, f"skew stiffness, {label}: growth [1/s]",
                         f"{share:g} of the threshold", grows, 0.01, required=label != "RK4",
                         easy=easy, note="grows as it must" if truth.real > 0 else "")
    if not short:
        yield Plot("flutter", "Growth rate of flutter", "skew stiffness / threshold",
                   "growth rate [1/s]", series)


def greenhill(program, short):
    torque = 2 * math.pi * YOUNG * INERTIA / LENGTH
    for share in (1.3,) if short else (0.9, 1.05, 1.3, 2.0):
        loads = {"Loads/Weight On Bit": 0.0, "Loads/Torque On Bit": share * torque}
        static = program.run("c14_static", COLUMN, loads, ALONE)
        if not static.done:
            yield judged(static, "Greenhill, static state", f"{share:g} of the torque", None, 0.0,
                         required=True)
            continue
        truth = static.summary["static"]["growth_rate"] or 0.0
        yield statement("Greenhill, static state: stable", f"{share:g} of the torque",
                        str(share < 1), str(static.summary["static"]["stable"]),
                        static.summary["static"]["stable"] == (share < 1))
        listed = program.run("c14_modes", COLUMN, loads, ALONE, command="modes",
                             extra=("--count", "8"))
        yield judged(
            listed, "Greenhill, modes: growth [1/s]", f"{share:g} of the torque", lambda:
            (truth, float(max(damped(listed, "full").real)),
             abs(max(0.0, max(damped(listed, "full").real)) - truth) / max(truth, 1.0)), 0.01)
        for label, way in ways(short):
            for model, more in (("full", {}),) if short or "alpha" not in label else (
                ("full", {}),
                ("reduced", reduced(16)),
            ):
                end = 10.0 / truth if truth > 0.5 else 3.0
                run = program.run("c14", COLUMN,
                                  {**loads, **PUSH, **times(end, 0.002), **way, **more}, ALONE)

                def grows():
                    x = run.nodes(U)[:, 12]
                    if share < 1:
                        return "bounded", f"largest {np.abs(x).max():.3g} m", 0.0 if np.abs(
                            x).max() < 1e-3 else math.inf
                    return against(float(truth), growth_of_pair(run.time(), x))

                yield judged(run, f"Greenhill, {label}, {model}: growth [1/s]",
                             f"{share:g} of the torque", grows, 0.01, required=model == "full"
                             and share > 1, note="grows as it must" if share > 1 else "")


def mud(program, short):
    """Divergence at m_i U_i^2 + m_o U_o^2 = P_c."""
    bore, density = 0.108, 1500.0
    inside, outside = math.pi * INNER**2, math.pi * OUTER**2
    ratio = OUTER / bore
    added = density * outside * (1 + ratio**2) / (1 - ratio**2)
    annulus = math.pi * (bore**2 - OUTER**2)
    flow = math.sqrt(BUCKLING / (density * inside / inside**2 + added / annulus**2))
    for share in (0.9, 1.2) if short else (0.9, 0.98, 1.02, 1.2, 1.5):
        settings = {
            "Mud/Density": density, "Mud/Flow Rate": share * flow, "Mud/Friction Coefficient": 0.0,
            "Mud/Kinematic Viscosity": 1e-6, "Mud/Coriolis": False, "Mud/Axial Drag": False,
            "Loads/Weight On Bit": 0.0
        }
        run = program.run("c14_mud", COLUMN, settings, ALONE)

        def verdict():
            static = run.summary["static"]
            mass = MODAL_MASS + density * inside + added
            exact = math.sqrt(max(0.0, (share**2 - 1) * BUCKLING * WAVE**2 / mass))
            found = static["growth_rate"] if not static["stable"] else 0.0
            return exact, found or 0.0, abs((found or 0.0) - exact) / max(
                exact, 1e-3 if share < 1 else exact)

        yield judged(run, "mud, static state: growth [1/s]",
                     f"flow {share:g} of the divergence flow", verdict, 0.01, required=True,
                     note="unstable as it must be" if share > 1 else "")


@case(23, "Skew stiffness as large as the symmetric one",
      "skew stiffness 0.1 to 1 of the springs of a chain of 12 masses; 6 to all modes",
      "modes of the symmetric part are said to be so; the full matrix is projected: the motion "
      "grows as the rightmost eigenvalue of the full model")
def skew(program, short):
    n, stiffness = 12, 1e4
    S = stiffness * (2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1))
    M = np.eye(2 * n)
    for share in (0.5,) if short else (0.1, 0.3, 1.0):
        skew = np.kron(np.eye(n), np.array([[0.0, 1.0], [-1.0, 0.0]]))
        K = np.kron(S, np.eye(2)) + share * stiffness * skew
        truth = rightmost(M, 0 * M, K).real
        file = program.part("chain", ["u", "v"], M, K, sets={"end": [n]})
        imported = {"chain": {"File": file, "Retained": ["6"]}}
        kick = {
            "Starts": {"kick": {"Part": "chain", "Node": 6, "Component": "u", "Velocity": 1e-3}}
        }
        for modes in (22,) if short else (6, 12, 22):
            settings = {
                **times(20.0 / truth, 0.05 / truth), **alpha(0.01 / truth), **reduced(modes)
            }
            deck = parts_deck(program, "c23", imported, settings, Parts=kick)
            run = program.run("c23", deck)
            listed = program.run("c23_modes", deck, command="modes", extra=("--count", "8"))
            yield judged(
                run, f"growth of the motion [1/s], {modes} modes", f"skew part {share:g}",
                lambda: against(float(truth), growth_of_pair(run.time(),
                                                             run.nodes(0)[:, 5])),
                0.01 if modes == 22 else 0.05, required=True, note="grows as it must")
            yield statement(
                "modes", f"skew part {share:g}, {modes} modes: said to be of the symmetric part",
                "a sentence",
                "said" if "symmetric part" in " ".join(listed.output.split()) else "no word",
                listed.done and "symmetric part" in " ".join(listed.output.split()))
