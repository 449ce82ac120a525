# SPDX-License-Identifier: BSD-3-Clause
"""Meshes and parts: massless dofs, uneven elements, repeated modes, empty, single and floating
parts."""
import math

import numpy as np
from scipy.linalg import eigh

from buckling import MODAL_MASS, WAVE, table
from program import FULL, ROOT
from rows import Plot, against, case, judged, refusal, statement
from scenes import (AREA, BUCKLING, COLUMN, DENSITY, INERTIA, INNER, LENGTH, OUTER, SHEAR, STRESS,
                    U, YOUNG, alpha, arkode, parts_deck, planar_beam, reduced, relative_error, rk4,
                    times)

FRAME = ROOT / "xml/frame.xml"


def modal_motion(M, K, x0, times_):
    """x(t) of M x'' + K x = 0 from rest at x0, M regular."""
    squares, shapes = eigh(K, M)
    amplitude = shapes.T @ M @ x0
    return (shapes * amplitude) @ np.cos(np.sqrt(np.maximum(squares, 0.0))[:, None] * times_)


@case(15, "Massless and nearly massless rotations", "rotary mass 1e-2 to 1e-10 of a lumped "
      "element's, and none; beam of 6 elements, full and reduced, three integrators",
      "generalized-alpha condenses a massless rotation; RK4 and ARKODE refuse it; "
      "nearly massless ones keep the motion", "rotary mass 1e-2")
def massless(program, short):
    elements, end = 6, 0.5
    K, consistent = planar_beam(elements, 1.0, 10.0, 1.0)
    n = len(K)
    keep = [i for i in range(n) if i not in (0, n - 2)]  # v of both ends held
    translations = [i for i in keep if i % 2 == 0]
    lumped = np.zeros((n, n))
    lumped[0::2, 0::2] = np.diag([0.5 if i in (0, elements) else 1.0
                                  for i in range(elements + 1)]) / elements
    for share in (0.0,) if short else (1e-2, 1e-4, 1e-7, 1e-10, 0.0):
        M = lumped.copy()
        M[1::2, 1::2] += share / elements**3 * np.eye(elements + 1)
        file = program.part("thin", ["v", "theta_z"], M, K, sets={"ends": [1, elements + 1]})
        x0 = np.zeros(n)
        x0[translations] = [1e-3 * math.sin(math.pi * i / 2 / elements) for i in translations]
        rest = [i for i in keep if i % 2]
        x0[rest] = -np.linalg.solve(K[np.ix_(rest, rest)],
                                    K[np.ix_(rest, translations)] @ x0[translations])
        starts = {
            "Starts": {
                f"s{i}": {
                    "Part": "beam", "Node": i // 2 + 1, "Component": ("v", "theta_z")[i % 2],
                    "Displacement": float(x0[i])
                } for i in keep
            }
        }
        all_ways = [
            ("generalized-alpha", alpha(1e-3), "both"),
            ("RK4", rk4(), "full"),
            ("ARKODE 1e-6", arkode(1e-6), "full"),
        ]
        for label, way, which in all_ways:
            if label == "RK4" and 0 < share < 1e-4:
                continue  # its step decreases with the square root of the mass
            for model, more in (
                ("full", {}),
                ("reduced", reduced(4)),
            ) if which == "both" else (("full", {}),):
                settings = {**times(end, 0.01), **way, **more}
                run = program.run(
                    "c15",
                    parts_deck(program, "c15",
                               {"beam": {"File": file, "Fixed": ["1 v", f"{elements + 1} v"]}},
                               settings, Parts=starts))
                variant = f"{label}, {model}"
                if share == 0.0 and label != "generalized-alpha":
                    yield refusal(run, variant, "no rotary mass", ("mass",))
                    continue

                def motion():
                    if share > 0:
                        exact = modal_motion(M[np.ix_(keep, keep)], K[np.ix_(keep, keep)], x0[keep],
                                             run.time())
                        exact = exact[[keep.index(i) for i in translations]]
                    else:
                        condensed = (K[np.ix_(translations, translations)] -
                                     K[np.ix_(translations, rest)] @ np.linalg.solve(
                                         K[np.ix_(rest, rest)], K[np.ix_(rest, translations)]))
                        exact = modal_motion(M[np.ix_(translations, translations)], condensed,
                                             x0[translations], run.time())
                    found = run.nodes(0)[:, [i // 2 for i in translations]]
                    return "0", "error", relative_error(found, exact.T)

                yield judged(run, variant, f"rotary mass {share:g}" if share else "no rotary mass",
                             motion, 0.02, required=model == "full")


def uneven(ratio):
    """Settings: a short piece as one element in the middle of the column, between long elements."""
    size = 1.0
    short = size / ratio
    half = (LENGTH - short) / 2
    pieces = {}
    for name, length, elements in (("a", half, 6), ("b", short, 1), ("c", half, 6)):
        pieces.update({
            f"Drillstring/Components/{name}/Length": length,
            f"Drillstring/Components/{name}/Elements": elements,
            f"Drillstring/Components/{name}/Outer Radius": OUTER,
            f"Drillstring/Components/{name}/Inner Radius": INNER
        })
    return {**pieces, "Drillstring/Assembly": "{a, b, c}"}


def square_of(waves, load=0.5):
    """omega^2 of the mode of the column with this number of half waves under this share of its
    buckling load, with shear and rotary inertia."""
    q = waves * WAVE
    euler = YOUNG * INERTIA * q**2
    stiffness = euler / (1 + euler / (0.9 * SHEAR * AREA)) - load * BUCKLING
    return stiffness * q**2 / (DENSITY * (AREA + INERTIA * q**2))


@case(16, "Neighbouring elements of very different length",
      "ratio 1:1 to 1:20000 in the middle of 12 m of pipe; three integrators, full and reduced",
      "the implicit error does not change; the explicit step falls as the shortest element; lost "
      "conditioning is reported", "ratio 1:1")
def uneven_elements(program, short):
    end, load = 0.3, {"Loads/Weight On Bit": 0.5 * BUCKLING}
    push = {
        f"Loads/Forces/push/{key}": value
        for key, value in (("Node", 7), ("Component", "u"), ("Value", 1000.0), ("Start Time", 0.01))
    }
    exact = math.sqrt(square_of(1))
    steps, easy = [], {}
    for ratio in (100,) if short else (1, 9, 100, 1000, 5000, 20000):
        listed = program.run("c16_modes", COLUMN, {**uneven(ratio), **load}, ("Contact",),
                             command="modes", extra=("--count", "4"))
        yield judged(listed, "omega_1 [rad/s]", f"1:{ratio}",
                     lambda: against(exact, 2 * math.pi * table(listed, "modes.csv")[0]["full"]),
                     0.01)
        for label, way in ((("generalized-alpha 1 ms", alpha(1e-3)),) if short else
                           (("generalized-alpha 1 ms", alpha(1e-3)), ("ARKODE 1e-6", arkode(1e-6)),
                            ("RK4", rk4()))):
            if label == "RK4" and ratio > 100:
                continue
            for model, more in (
                ("full", {}),
                ("reduced", reduced(6)),
            ) if label != "RK4" else (("full", {}),):
                run = program.run(
                    "c16", COLUMN,
                    {**uneven(ratio), **load, **push, **way, **more, **times(end, 0.005)},
                    ("Contact",))
                easy.setdefault(label, run)
                if not short and label == "RK4" and run.done:
                    steps.append((1.0 / ratio, run.motion["max_step"]))

                def deflection():
                    late = np.maximum(0.0, run.time() - 0.01)
                    exact_motion = sum(2000.0 / (LENGTH * MODAL_MASS * square) *
                                       (1 - np.cos(math.sqrt(square) * late))
                                       for k in (1, 3, 5, 7, 9) for square in [square_of(k)])
                    found = run.nodes(U)[:, 6]
                    return float(exact_motion.max()), float(found.max()), relative_error(
                        found, exact_motion)

                yield judged(run, f"motion, {label}, {model}", f"1:{ratio}", deflection, 0.05,
                             easy=easy[label], motion=True)
    if steps:
        yield Plot("elements", "Step of RK4 beside the shortest element", "shortest element [m]",
                   "step [s]", {"RK4": steps}, "xy")
        # a short spring between the masses of long elements: omega ~ length^-1/2
        shortest, first = min(steps), max(steps)
        yield statement("RK4: default step", f"elements of {first[0]:g} to {shortest[0]:g} m",
                        "falls as the root of the length at least, to the power 0.4",
                        f"{first[1]:.2g} s to {shortest[1]:.2g} s",
                        shortest[1] < first[1] * (shortest[0] / first[0])**0.4)


def round_beam(elements, difference, length=2.0):
    """Beam bending in two planes, stiffness 100 and 100 (1 + difference); components u, theta_y, v,
    theta_x."""
    K1, M1 = planar_beam(elements, length, 100.0, 1.0)
    n = len(K1)
    K, M = np.zeros((2 * n, 2 * n)), np.zeros((2 * n, 2 * n))
    order = np.arange(n)
    first, second = 4 * (order // 2) + order % 2, 4 * (order // 2) + 2 + order % 2
    sign = np.where(order % 2, -1.0, 1.0)  # v' = -theta_x
    K[np.ix_(first, first)], M[np.ix_(first, first)] = K1, M1
    K[np.ix_(second, second)], M[np.ix_(
        second, second)] = (1 + difference) * sign[:, None] * K1 * sign, sign[:, None] * M1 * sign
    return K, M


@case(18, "Repeated and nearly repeated modes", "stiffness of the two planes equal to 0 ... 1e-2; "
      "3 to 7 modes asked for; parts turned by 0 to 90 degrees",
      "no cut through a cluster; frequencies those of the full model; "
      "the motion does not change when a pair is turned", "not turned")
def repeated(program, short):
    elements, end = 8, 0.6
    components = ["u", "theta_y", "v", "theta_x"]
    for difference in (0.0,) if short else (0.0, 1e-12, 1e-8, 1e-5, 1e-2):
        K, M = round_beam(elements, difference)
        file = program.part("round", components, M, K, sets={"near": [1], "far": [elements + 1]})
        for modes in (3,) if short else (3, 5, 7):
            for angle in (0.0, 37.0) if short else (0.0, 37.0, 90.0):
                turned = {
                    "File": file, "Rotation Axis": [0.0, 0.0, 1.0], "Rotation Angle": f"{angle} deg"
                }
                direction = math.radians(angle)
                kick = {
                    "Starts": {
                        f"kick {c}":
                        {"Part": "left", "Node": elements + 1, "Component": c, "Velocity": x}
                        for c, x in (
                            ("u", 0.1 * math.cos(0.3 - direction)),
                            ("v", 0.1 * math.sin(0.3 - direction)),
                        )
                    },
                    "Joints": ["left:far = right:near"],
                }
                files = {
                    "left": {**turned, "Fixed": ["near"]},
                    "right": {**turned, "Fixed": ["far"]},
                }
                settings = {**times(end, 0.005), **alpha(1e-3), **reduced(modes)}
                deck = parts_deck(program, "c18", files, settings, Parts=kick)
                run = program.run("c18", deck)
                if not run.done:
                    yield judged(run, f"planes differ by {difference:g}",
                                 f"{modes} modes asked for", None, 0.0, required=True)
                    continue
                at = np.stack([run.nodes(c)[:, elements] for c in (0, 2)])  # common frame
                if angle == 0.0:
                    first = at
                    kept = [part["modes"] for part in run.summary["reduction"]["substructures"]]
                    paired = all(k % 2 == 0 for k in kept) if difference <= 1e-5 else True
                    yield statement(f"planes differ by {difference:g}",
                                    f"{modes} modes asked for: kept", "pairs", str(kept), paired)
                    listed = program.run("c18_modes", deck, command="modes", extra=("--count", "4"))
                    yield judged(
                        listed, f"planes differ by {difference:g}",
                        f"{modes} modes: four lowest frequencies", lambda:
                        ("0", "largest error",
                         max(abs(row["error"]) for row in table(listed, "modes.csv"))), 0.01,
                        required=True)
                elif difference == 0.0:
                    yield judged(
                        run, "planes equal", f"{modes} modes, turned by {angle:g} deg", lambda:
                        ("0", "change of the motion",
                         float(np.linalg.norm(at - first) / np.linalg.norm(first))), 1e-6,
                        required=True)


@case(19, "No modes, all modes, empty and single parts", "modes 0 and all; a part without "
      "interior; a part of one node; frame of five parts and stress_170m",
      "no modes are Guyan's condensation; all modes and parts "
      "without interior equal the full model to 1e-9 (1e-4 with friction, whose iteration ends at "
      "1e-5); a single node passes through", "the full model")
def extremes(program, short):
    settings = {**times(0.2, 0.005), **alpha(1e-3)}
    scenes = [("frame", FRAME, ("Reduction",), {})]
    if not short:
        scenes += [("stress_170m", STRESS, FULL, {})]
    for name, deck, without, more in scenes:
        full = program.run("c19_full", deck, {**settings, **more}, without)
        clear = ("Reduction/Mode Selection",)
        every = program.run("c19", deck,
                            {**settings, **more, "Reduction/Mode Selection/All Modes": True}, clear)
        yield judged(every, name, "all modes", lambda:
                     ("0", "vibration error", difference(every, full)),
                     1e-9 if name == "frame" else 1e-4, required=True, easy=full)
        none = program.run("c19_none", deck,
                           {**settings, **more, "Reduction/Mode Selection/Modes": 0}, clear)
        guyan = program.run(
            "c19_guyan", deck,
            {**settings, **more, "Reduction/Mode Selection/Modes": 0, "Reduction/Basis": "Guyan"},
            clear)
        yield judged(none, name, "no modes, against Guyan", lambda:
                     ("0", "difference", difference(none, guyan)),
                     1e-9 if name == "frame" else 1e-6, required=True, easy=full)
        if name != "frame":
            whole = program.run("c19_whole", deck,
                                {**settings, **more, "Substructures/Retained Nodes": "All"})
            yield judged(whole, name, "parts without interior", lambda:
                         ("0", "vibration error", difference(whole, full)), 1e-4, required=True,
                         easy=full)
    K, M = planar_beam(4, 1.0, 100.0, 1.0)
    beam = program.part("c19_beam", ["v", "theta_z"], M, K, sets={"root": [1], "tip": [5]})
    node = program.part("c19_node", ["v", "theta_z"], np.diag([2.0, 0.1]), np.zeros((2, 2)),
                        sets={"here": [1]})
    lists = {
        "Joints": ["beam:tip = weight:here"],
        "Starts": {"kick": {"Part": "beam", "Node": 5, "Component": "v", "Velocity": 0.1}},
    }
    files = {"beam": {"File": beam, "Fixed": ["root"]}, "weight": node}
    full = program.run("c19_full", parts_deck(program, "c19", files, settings, Parts=lists))
    every = {"Reduction/Mode Selection/All Modes": True}
    run = program.run("c19", parts_deck(program, "c19", files, {**settings, **every}, Parts=lists))
    yield judged(run, "beam with a part of one node", "all modes", lambda:
                 ("0", "difference", difference(run, full)), 1e-9, required=True, easy=full)


def difference(run, reference):
    """Norm of the difference of all displacements divided by that of the motion about its start."""
    a, b = (one.data("transient/displacement") for one in (run, reference))
    return relative_error(a, b)


@case(20, "Floating parts, floating strings, mechanisms", "free beam in space of two parts; a "
      "string with w, theta_z or nothing held; an interior node on no spring",
      "rigid modes are found and counted and move as a rigid "
      "body, or the model is refused with the dof named")
def floating(program, short):
    import structures
    beam = structures.beam(6, length=2.0)
    beam.write(program.work / "free_half.h5", {"near": [1], "far": [7]})
    files = {"left": "free_half.h5", "right": {"File": "free_half.h5"}}
    lists = {
        "Joints": ["left:far = right:near"],
        "Loads": {"push": {"Part": "left", "Node": 7, "Component": "u", "Value": 100.0}},
    }
    for modes in (4,) if short else (0, 4, 12):
        settings = {**times(0.5, 0.01), **alpha(1e-3), **reduced(modes)}
        deck = parts_deck(program, "c20", files, settings, Parts=lists)
        listed = program.run("c20_modes", deck, command="modes", extra=("--count", "8"))
        yield judged(
            listed, "free beam, rigid-body modes", f"{modes} modes", lambda:
            ("6", str(sum(row["coupled"] == 0 for row in table(listed, "modes.csv"))),
             abs(6.0 - sum(row["coupled"] == 0 for row in table(listed, "modes.csv")))), 0.0,
            required=True)
        run = program.run("c20", deck)

        def centre():
            mass = 2 * 2.0 * math.pi * 0.05**2 * 7850.0
            one = np.zeros(42)
            one[0::6] = 1.0
            weights = np.asarray(beam.M @ one)[0::6]
            weights = np.concatenate([weights[:-1], [weights[-1] + weights[0]], weights[1:]])
            u = run.nodes(0)[-1]
            found = float(weights @ u / weights.sum())
            return against(0.5 * 100.0 / mass * 0.5**2, found)

        yield judged(run, "free beam, path of the centre of mass [m]", f"{modes} modes", centre,
                     1e-3, required=True)
    held_dofs = {"u v w": "theta_z", "u v theta_z": "w"}
    for held, dof in list(held_dofs.items())[:1 if short else 2]:
        run = program.run("c20_string", COLUMN, {"Supports/Top": held, "Supports/Bit": "u v"},
                          ("Contact",))
        yield refusal(run, "string, top holds " + held, f"{dof} held nowhere", ("floats", dof))
    for which in ("stiffness",) if short else ("stiffness", "stiffness and mass"):
        K, M = (np.pad(A, (0, 2)) for A in planar_beam(4, 1.0, 100.0, 1.0))
        M[10:, 10:] = np.eye(2) * (1.0 if which == "stiffness" else 0.0)
        file = program.part("c20_mechanism", ["v", "theta_z"], M, K, sets={"root": [1], "tip": [5]})
        pushed = {"Loads": {"push": {"Part": "beam", "Node": 6, "Component": "v", "Value": 1.0}}}
        deck = lambda more: parts_deck(program, "c20", {"beam": {"File": file, "Fixed": ["root"]}},
                                       {**times(0.2, 0.01), **alpha(1e-3), **more}, Parts=pushed)
        run = program.run("c20", deck(reduced(4)))
        if which == "stiffness":
            yield judged(run, "interior node on no spring", "with mass: path of the node [m]",
                         lambda: against(0.5 * 0.2**2, float(run.nodes(0)[-1, 5])), 1e-3)
        else:
            yield refusal(run, "interior node on no spring", "without mass", ("node 6",), (2, 3, 4))
