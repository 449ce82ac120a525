# SPDX-License-Identifier: BSD-3-Clause
"""Joints of parts: released and turned dofs, laws and starts of joined nodes."""
import json
import pathlib

import h5py
import numpy as np
from scipy.linalg import block_diag

from bars import bars
from checks import expect, tooljoint
from frequencies import ROOT
from program import parameter_list


def released():
    """At a released dof results have the motion of the first part; outputs that name the other part
    are refused."""
    good = ROOT / "tests" / "decks" / "parts" / "good"
    imported = "".join(f'<ParameterList name="{name}"><Parameter name="File" type="string" '
                       f'value="{good}"/></ParameterList>' for name in "ab")
    pathlib.Path("released.xml").write_text(
        '<ParameterList name="released"><ParameterList name="Parts"><ParameterList '
        f'name="Imported">{imported}</ParameterList><Parameter name="Joints" type="Array(string)" '
        'value="{a:right = b:left}"/></ParameterList><ParameterList name="Coupling">'
        '<ParameterList name="Releases"><ParameterList name="slide"><Parameter name="Node" '
        'type="string" value="b:1"/><Parameter name="Components" type="string" value="u"/>'
        '</ParameterList></ParameterList></ParameterList><ParameterList name="Transient">'
        '<Parameter name="End Time" type="double" value="0.01"/><Parameter name="Step" '
        'type="double" value="1e-3"/></ParameterList><ParameterList name="Response"><Parameter '
        'name="Highest Frequency" type="double" value="1"/><Parameter name="Points" type="int" '
        'value="2"/><Parameter name="Excitation" type="string" value="Transfer"/><ParameterList '
        'name="Loads"><ParameterList name="f"><Parameter name="Part" type="string" value="a"/>'
        '<Parameter name="Node" type="int" value="2"/><Parameter name="Component" type="string" '
        'value="u"/></ParameterList></ParameterList><ParameterList name="Outputs"><ParameterList '
        'name="x"><Parameter name="Part" type="string" value="b"/><Parameter name="Node" '
        'type="int" value="1"/><Parameter name="Component" type="string" value="u"/>'
        '</ParameterList></ParameterList></ParameterList></ParameterList>', encoding="utf-8")
    nodes = tooljoint("run", "released.xml", "--output", "released", "--set", "Output/Nodes={b:1}")
    expect(
        "a recorded node that is released is refused", nodes.returncode == 2
        and 'names "b:1", of which a component is released' in nodes.stderr, nodes.stderr[-300:])
    other = tooljoint("run", "released.xml", "--output", "released", "--set", "Output/Nodes={b:2}")
    expect("others are recorded", other.returncode == 0, other.stderr[-300:])
    response = tooljoint("response", "released.xml", "--output", "released_response")
    expect(
        "an output that is released is refused", response.returncode == 2
        and "which is released: results have it for part \"a\" only" in response.stderr,
        f"({response.returncode}) {response.stderr[-400:]}")


def laws_on_joints():
    """If forces between parts are coordinates, a force of a law has no residual flexibility. Dual
    Craig-Bampton therefore refuses laws that would be wrong at rest."""
    def spring(stiffness, damping=0.0):
        return {
            "Springs": {
                "s": {
                    "First": "a:11", "Component": "u", "Stiffness": stiffness, "Damping": damping
                }
            }
        }

    def reduced(deck, basis):
        return tooljoint("modes", deck, "--count", "4", "--output", f"law_{basis[:4]}", "--set",
                         f"Reduction/Basis={basis}")

    few = {"Basis": "Rubin", "Mode Selection": {"Modes": 4}}
    for name, law, words in (
        ("stiff", spring(3e6), "times the residual flexibility there"),
        ("damped", spring(1.0, 10.0), "Its damping makes a motion grow"),
    ):
        deck = bars(name, Coupling=law, Reduction=few)
        done = reduced(deck, "Dual Craig-Bampton")
        said = " ".join(done.stderr.split())
        expect(f"a {name} spring on a joint of Dual Craig-Bampton is refused", done.returncode == 3
               and words in said and 'Choose "Rubin"' in said, f"{done.returncode} {said[-400:]}")
        expect(f"and taken by Rubin ({name})", reduced(deck, "Rubin").returncode == 0)
    motor = {
        "Point Laws": {
            "m": {
                "Type": "Speed Control", "First": "a:5", "Component": "u",
                "Speed Control": {"Speed": 0.3, "Proportional Gain": 40.0}
            }
        }
    }
    done = tooljoint(
        "run",
        bars("motor", Coupling=motor,
             Reduction={"Basis": "Dual Craig-Bampton", "Mode Selection": {"All Modes": True}}),
        "--output", "motor")
    expect("a start at rest under a force is in balance to rounding", done.returncode == 0
           and "into balance" not in " ".join(done.stderr.split()), done.stderr[-400:])
    soft = bars("soft", Coupling=spring(1e3), Reduction=few)
    expect(
        "a soft spring is warned of", "act where the forces between parts move the dofs"
        in " ".join(
            tooljoint("run", soft, "--output", "soft", "--set",
                      "Reduction/Basis=Dual Craig-Bampton").stderr.split()))


def starts_of_joints():
    """A joined node has one start, under either name; a constraint with a value holds from the
    start."""
    def started(*places):
        return {
            "Starts": {
                f"s{i}": {"Part": part, "Node": node, "Component": "u", "Displacement": x}
                for i, (part, node, x) in enumerate(places)
            }
        }

    done = tooljoint("run", bars("twice", started(("a", 11, 1e-3), ("b", 1, 1e-3))), "--output",
                     "twice")
    expect(
        "two starts of one joined node are refused", done.returncode == 2
        and "they are joined. Leave one of the two out" in " ".join(done.stderr.split()),
        done.stderr[-400:])
    held = {"Constraints": {"c": {"Terms": ["b:11:u"], "Factors": [1.0], "Value": 1e-3}}}
    for x, code in ((1e-3, 0), (2e-3, 2)):
        done = tooljoint("run", bars("started", started(("b", 11, x)), Coupling=held), "--output",
                         "started")
        expect(
            f"a start of {x} m where a constraint holds 1 mm ends with {code}",
            done.returncode == code and
            (code == 0
             or "that a constraint holds at 0.001. Leave it out" in " ".join(done.stderr.split())),
            done.stderr[-400:])
    done = tooljoint("run", bars("held", {"Initial State": "Equilibrium"}, Coupling=held),
                     "--output", "held")
    expect("a constraint with a value and Equilibrium run", done.returncode == 0,
           done.stderr[-400:])
    if done.returncode == 0:
        with h5py.File("held/results.h5") as results:
            moved = results["/transient/displacement"][:, :, 0]
        # 20 equal springs between 0 and 1 mm
        exact = 1e-3 * np.arange(21) / 20
        expect(
            "it rests stretched by it",
            np.abs(
                np.sort(moved, axis=1) -
                exact[1:] if moved.shape[1] == 20 else np.sort(moved, axis=1) - exact).max() <
            1e-12, np.abs(moved[0]))


def turned_out_of_the_plane():
    """A part that moves in u and v, turned about its x axis, moves along w in the common frame; the
    results have it."""
    pathlib.Path("plane.json").write_text(
        json.dumps({
            "format": "tooljoint part 1",
            "components": ["u", "v"],
            "dofs": [[1, "u"], [1, "v"]],
            "mass": [[1, 0], [0, 1]],
            "stiffness": [[1e4, 0], [0, 4e4]],
            "initial_displacement": [0, 1e-3],
        }), encoding="utf-8")
    turned = {"File": "plane.json", "Rotation Axis": [1.0, 0.0, 0.0], "Rotation Angle": "30 deg"}
    deck = pathlib.Path("plane.xml")
    deck.write_text(
        parameter_list(
            "plane", {
                "Parts": {"Imported": {"a": turned}},
                "Transient": {"End Time": 0.02, "Step": 1e-4, "Sampling Interval": 1e-3},
            }), encoding="utf-8")
    done = tooljoint("run", str(deck), "--output", "plane")
    expect("a part of u and v turned about x runs", done.returncode == 0, done.stderr[-400:])
    with h5py.File("plane/results.h5") as results:
        names = [name.decode() for name in results["/model/components"][:]]
        motion = results["/transient/displacement"][:].reshape(-1, len(names))
    exact = 1e-3 * np.cos(200.0 * 1e-3 * np.arange(len(motion)))
    expect(
        "its motion along w is in the results", names == ["u", "v", "w"]
        and np.abs(motion[:, 1] - np.cos(np.pi / 6) * exact).max() < 1e-6
        and np.abs(motion[:, 2] - np.sin(np.pi / 6) * exact).max() < 1e-6, f"{names} {motion[-1]}")
    lists = {
        "Parts": {"Imported": {"a": turned}},
        "Coupling": {
            "Frames": {"all": {"Part": "a", "Axis 1": [0.0, 1.0, 0.0], "Axis 2": [-1.0, 0.0, 0.0]}}
        },
    }
    deck.write_text(parameter_list("plane", lists), encoding="utf-8")
    done = tooljoint("check", str(deck))
    expect("a rotation beside a frame of the whole part is refused", done.returncode == 2
           and "Rotation Angle has no effect" in " ".join(done.stderr.split()), done.stderr[-300:])


def starts_that_coordinates_lose():
    """Dependent coordinates and interface modes may not represent an initial state that the bases
    contain: the warning includes this loss."""
    start = {
        "Starts": {
            f"s{i}": {"Part": part, "Node": node, "Component": "u", "Velocity": v}
            for i, (part, node, v) in enumerate((("a", 5, 1.0), ("b", 4, -2.0), ("b", 9, 0.5)))
        }
    }
    deck = bars("tied", start,
                Reduction={"Basis": "Enhanced Craig-Bampton", "Mode Selection": {"Modes": 8}})
    told = {}
    for name in ("Free", "Tied"):
        done = tooljoint("run", deck, "--output", f"tied_{name}", "--set",
                         f"Reduction/Enhanced Craig-Bampton/Residual Coordinates={name}")
        expect(f"a start of Enhanced Craig-Bampton runs ({name})", done.returncode == 0,
               done.stderr[-300:])
        with open(f"tied_{name}/summary.json", encoding="utf-8") as file:
            misfit = json.load(file)["reduction"]["start_misfit"]
        told[name] = (misfit, "does not represent the initial state"
                      in " ".join(done.stderr.split()))
    expect("free coordinates have the start", told["Free"][0] < 1e-9 and not told["Free"][1],
           told["Free"])
    expect("tied ones lose a part of it, which is told", told["Tied"][0] > 0.05 and told["Tied"][1],
           told["Tied"])


def massless_nodes_of_dual_assemblies():
    """A node without mass starts in equilibrium with the others, also if a multiplier joins it: q2
    = q1/2 + q3/2 for any given start. The parts are turned, so that no dof alone is without mass in
    the common frame; nothing moves across their axis."""
    for part, m, k, ends in (
        ("a", [1.0, 0.0, 1.0], [[2e4, -1e4, 0], [-1e4, 2e4, -1e4], [0, -1e4, 1e4]], {"r": [3]}),
        ("b", [1.0, 1.0], [[1e4, -1e4], [-1e4, 1e4]], {"l": [1]}),
    ):
        pathlib.Path(f"{part}.json").write_text(
            json.dumps({
                "format": "tooljoint part 1", "components": ["u", "v"],
                "dofs": [[i + 1, c] for c in "uv" for i in range(len(m))],
                "mass": np.diag(m + [1.0] * len(m)).tolist(),
                "stiffness": block_diag(k, 1e4 * np.eye(len(m))).tolist(), "interfaces": ends
            }), encoding="utf-8")
    lists = {
        "Parts": {
            "Imported": {
                part: {"File": f"{part}.json", "Rotation Angle": "30 deg"} for part in "ab"
            },
            "Joints": ["a:r = b:l"],
            "Starts": {"s": {"Part": "a", "Node": 1, "Component": "u", "Displacement": 1e-3}},
        },
        "Transient": {
            "End Time": 0.2, "Sampling Interval": 1e-3, "Step": 1e-3,
            "Generalized-alpha": {"Spectral Radius": 1.0}
        },
    }
    motions = {}
    for assembly, basis in (("Primal", "Craig-Bampton"), ("Dual", "Guyan")):
        lists.update({
            "Coupling": {"Assembly": assembly},
            "Reduction": {"Basis": basis, "Mode Selection": {"All Modes": True}},
        })
        pathlib.Path("massless.xml").write_text(parameter_list("massless", lists), encoding="utf-8")
        done = tooljoint("run", "massless.xml", "--output", "massless")
        expect(f"a massless node runs in a {assembly} assembly, all modes kept",
               done.returncode == 0 and "kinetic energy" not in done.stderr, done.stderr[-300:])
        motions[assembly] = h5py.File("massless/results.h5")["/transient/velocity"][:, :, :2]
    expect("their motion is along their axis",
           np.abs(motions["Primal"] @ [-0.5, 0.75**0.5]).max() < 1e-12)
    expect(
        "its motion is the same in both",
        np.abs(motions["Dual"] - motions["Primal"]).max() < 1e-9 * np.abs(motions["Primal"]).max() <
        1e-9,
        np.abs(motions["Dual"]).max())
