# SPDX-License-Identifier: BSD-3-Clause
"""Parts without mass in directions other than the axes of their dofs."""
import csv
import json
import pathlib

import h5py
import numpy as np
from scipy.linalg import eigh

from checks import expect, tooljoint
from program import parameter_list


def definite(numbers, size, low, high):
    """A symmetric matrix with eigenvalues in a range, in axes of any direction."""
    axes = np.linalg.qr(numbers.standard_normal((size, size)))[0]
    return axes @ np.diag(numbers.uniform(low, high, size)) @ axes.T


def write_part(name, mass, stiffness, components, interfaces):
    """The file of a part whose nodes have all components."""
    nodes = len(mass) // len(components)
    pathlib.Path(f"{name}.json").write_text(
        json.dumps({
            "format": "tooljoint part 1", "components": components,
            "dofs": [[node + 1, c] for node in range(nodes) for c in components],
            "mass": np.asarray(mass).tolist(), "stiffness": np.asarray(stiffness).tolist(),
            "interfaces": interfaces
        }), encoding="utf-8")


def run(command, lists):
    """The command with a deck of these lists; results are in the folder massless."""
    pathlib.Path("massless.xml").write_text(parameter_list("massless", lists), encoding="utf-8")
    return tooljoint(command, "massless.xml", "--output", "massless")


def displacement():
    """Displacements of the last run, samples x nodes x components."""
    with h5py.File("massless/results.h5") as file:
        return file["/transient/displacement"][()]


def imported(name, axis, angle, **more):
    """The deck entry of a turned part."""
    return {name: {"File": f"{name}.json", "Rotation Axis": axis, "Rotation Angle": angle, **more}}


def node_turned_a_little():
    """1 kg along u on springs, no mass along v, turned by an angle: M_vv is 1e-10 kg, but no
    frequency is high. q_u = 0.1 cos(sqrt(150) t), q_v = q_u/2 in the axes of the part."""
    write_part("a", [[1.0, 0.0], [0.0, 0.0]], [[200.0, -100.0], [-100.0, 200.0]], ["u", "v"], {})
    for angle in (1e-5, 1.5708):
        done = run(
            "run", {
                "Parts": {
                    "Imported": imported("a", [0.0, 0.0, 1.0], angle),
                    "Starts": {
                        "s": {"Part": "a", "Node": 1, "Component": "u", "Displacement": 0.1}
                    },
                },
                "Transient": {"End Time": 0.5, "Step": 1e-3},
            })
        expect(f"a node without mass along an axis turned by {angle} rad starts in balance",
               done.returncode == 0 and "could not" not in done.stderr, done.stderr[-300:])
        turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
        q = displacement()[:, 0, :2] @ turn.T
        exact = 0.1 * np.cos(np.sqrt(150) * 5e-3 * np.arange(len(q)))
        error = max(np.abs(q[:, 0] - exact).max(), np.abs(q[:, 1] - exact / 2).max())
        expect("it moves as the closed form", error < 1e-6, error)


def directions_that_meet():
    """Each side of a joint has no mass in a plane of its own; along the intersection of the planes
    the joint has no mass, and a dual assembly starts like the primal one."""
    numbers = np.random.default_rng(1)
    for part, bare, ends in (("a", [4, 5], {"r": [2]}), ("b", [0, 2], {"l": [1]})):
        mass = definite(numbers, 6, 1, 2)
        mass[bare], mass[:, bare] = 0, 0
        write_part(part, mass, definite(numbers, 6, 1e3, 4e3), ["u", "v", "w"], ends)
    same_in_both_assemblies(
        "a joint without mass in a direction", {
            "Imported": {
                **imported("a", [0.5, 0.2, 1.0], 1.0), **imported("b", [1.0, -0.3, 0.4], 2.0)
            },
            "Joints": ["a:r = b:l"],
            "Loads": {"push": {"Part": "b", "Node": 2, "Component": "u", "Value": 10.0}},
        })


def rounding_of_masses():
    """Rounding errors of zero masses after turning, projection and coupling do not count as mass:
    the motions of both assemblies are equal."""
    numbers = np.random.default_rng(14)
    parts = {}
    for part in ("p0", "p1", "p2"):
        stiffness, mass = definite(numbers, 12, 200, 4000), definite(numbers, 12, 0.5, 2)
        bare = numbers.uniform(size=12) < 0.25
        mass[bare], mass[:, bare] = 0, 0
        write_part(part, mass, stiffness, ["u", "v", "w"], {"l": [1], "r": [4]})
        parts.update(
            imported(part,
                     numbers.standard_normal(3).tolist(), float(numbers.uniform(0, 6))))
    parts["p0"]["Fixed"] = ["l"]
    same_in_both_assemblies(
        "a chain of parts without mass in directions of their own", {
            "Imported": parts,
            "Joints": ["p0:r = p1:l", "p1:r = p2:l"],
            "Loads": {"push": {"Part": "p2", "Node": 4, "Component": "v", "Value": 30.0}},
        })


def same_in_both_assemblies(what, parts):
    """The motion of parts with all modes, primal and dual."""
    motions = {}
    for assembly in ("Primal", "Dual"):
        done = run(
            "run", {
                "Parts": parts,
                "Coupling": {"Assembly": assembly},
                "Reduction": {"Mode Selection": {"All Modes": True}},
                "Transient": {"End Time": 0.1, "Step": 1e-3},
            })
        expect(f"{what} runs in a {assembly} assembly", done.returncode == 0
               and "without mass" not in done.stderr, done.stderr[-300:])
        if done.returncode == 0:
            motions[assembly] = displacement()
    difference = np.abs(motions["Dual"] - motions["Primal"]).max() if len(motions) == 2 else np.inf
    expect("its motion is the same in both", difference < 1e-9 * np.abs(motions["Primal"]).max(),
           difference)


def light_beside_massless():
    """One dof of 1e-14 kg, whose frequency is seven decades above the others, and one dof without
    mass: the frequencies are those of the condensed matrices."""
    stiffness = definite(np.random.default_rng(3), 5, 200, 4000)
    masses = np.array([1.0, 1.5, 0.8, 1e-14, 0.0])
    write_part("a", np.diag(masses), stiffness, ["u"], {})
    run("modes", {"Parts": {"Imported": {"a": {"File": "a.json"}}}})
    condensed = (stiffness[:4, :4] - np.outer(stiffness[:4, 4], stiffness[4, :4]) / stiffness[4, 4])
    heavy = (condensed[:3, :3] - np.outer(condensed[:3, 3], condensed[3, :3]) / condensed[3, 3])
    exact = np.sqrt(eigh(heavy, np.diag(masses[:3]), eigvals_only=True)) / (2 * np.pi)
    with open("massless/modes.csv", encoding="utf-8") as file:
        found = [float(row["full [Hz]"]) for row in csv.DictReader(file)]
    error = np.abs(np.array(found[:3]) / exact - 1).max()
    expect("frequencies below that of a very light dof are right beside one without mass",
           len(found) == 4 and error < 1e-9, error)
    high = np.sqrt(condensed[3, 3] / masses[3]) / (2 * np.pi)
    expect("so is its own", abs(found[-1] / high - 1) < 1e-9, found[-1] / high - 1)


def massless_directions():
    """All of these."""
    node_turned_a_little()
    directions_that_meet()
    rounding_of_masses()
    light_beside_massless()
