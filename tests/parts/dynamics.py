# SPDX-License-Identifier: BSD-3-Clause
"""Parts in motion: floating and massless parts, unstable equilibria, modes chosen by the motion."""
import csv
import importlib.util
import json
import pathlib

import h5py
import numpy as np

from bars import bars, springs_in_a_row, write_bar
from checks import expect, tooljoint
from frequencies import ROOT
from program import parameter_list


def floating_beams():
    """Two free beams, the second turned about its axis, whose bending planes are nearly the same:
    six rigid-body modes in spite of rounding."""
    spec = importlib.util.spec_from_file_location("make_parts",
                                                  ROOT / "xml" / "frame" / "make_parts.py")
    make = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(make)
    names, elements = ["u", "v", "w", "theta_x", "theta_y", "theta_z"], 8
    for difference in (0.0, 1e-5, 1e-4, 1e-3, 1e-2):
        K, M = np.zeros((2, 6 * (elements + 1), 6 * (elements + 1)))
        for e in range(elements):
            at = slice(6 * e, 6 * e + 12)
            ke, me = make.element(0.5)
            plane = np.array([c % 6 in (2, 4) for c in range(12)])  # w and theta_y
            ke = np.where(np.outer(plane, plane), (1 + difference) * ke, ke)
            K[at, at] += ke
            M[at, at] += me
        nodes = [[node + 1, name] for node in range(elements + 1) for name in names]
        pathlib.Path("free.json").write_text(
            json.dumps({
                "format": "tooljoint part 1",
                "components": names,
                "dofs": nodes,
                "mass": M.tolist(),
                "stiffness": K.tolist(),
                "damping": (1e-5 * K).tolist(),
                "interfaces": {
                    "left": [[1, c] for c in names],
                    "right": [[elements + 1, c] for c in names],
                },
            }), encoding="utf-8")
        imported = {
            "a": {"File": "free.json"},
            "b": {"File": "free.json", "Rotation Axis": [1.0, 0.0, 0.0], "Rotation Angle": 0.6},
        }
        pathlib.Path("free.xml").write_text(
            parameter_list("free",
                           {"Parts": {"Imported": imported, "Joints": ["a:right = b:left"]}}),
            encoding="utf-8")
        done = tooljoint("modes", "free.xml", "--count", "8", "--output", "free")
        undamped, damped = ([
            float(row[key]) for row in csv.DictReader(open(f"free/{file}.csv", encoding="utf-8"))
        ] for file, key in (("modes", "full [Hz]"), ("damped_modes", "full [Hz]")))
        expect(
            f"planes that differ by {difference:g}: six rigid-body modes, undamped and damped",
            done.returncode == 0 and undamped[:6] == [0.0] * 6 and undamped[6] > 1
            and sum(x == 0.0 for x in damped[:8]) == 6, f"{undamped} {damped}")


def creeping_dofs():
    """Massless interior dofs with dampers, or coupled through an unsymmetric stiffness, are not in
    any basis, and a message says so."""
    deck = bars("creep",
                Reduction={"Basis": "Craig-Bampton", "Mode Selection": {"All Modes": True}})
    part = json.loads(pathlib.Path("bar10.json").read_text(encoding="utf-8"))
    part["mass"][4][4] = 0.0
    damping = np.zeros((11, 11))
    damping[4, 4] = 1e3
    part["damping"] = damping.tolist()
    pathlib.Path("bar10.json").write_text(json.dumps(part), encoding="utf-8")
    words = "1 interior dofs with damping but no mass (first u of node 5"
    said = " ".join(tooljoint("run", deck, "--output", "creep").stderr.split())
    expect("damped dofs without mass in the interior are warned of", words in said, said[-500:])
    part["damping"] = (1e-4 * np.array(part["stiffness"])).tolist()
    pathlib.Path("bar10.json").write_text(json.dumps(part), encoding="utf-8")
    full = tooljoint("run", deck, "--output", "creep_full", "--without", "Reduction")
    done = tooljoint("run", deck, "--output", "creep", "--set", "Parts/Initial State=Equilibrium")
    expect(
        "damping in proportion to the stiffness is none of it", full.returncode == 0
        and done.returncode == 0
        and "with damping but no mass" not in " ".join(done.stderr.split()), done.stderr[-300:])
    expect("no word of a stiffness that is symmetric", "not symmetric" not in done.stderr,
           done.stderr[-300:])
    part["stiffness"][4][5] *= 0.5
    part["damping"] = np.zeros((11, 11)).tolist()
    pathlib.Path("bar10.json").write_text(json.dumps(part), encoding="utf-8")
    words = "1 interior dofs without mass whose stiffness is not symmetric (first u of node 5"
    said = " ".join(tooljoint("run", deck, "--output", "creep").stderr.split())
    expect("dofs without mass that follow through an unsymmetric stiffness are warned of", words
           in said, said[-500:])


def unstable_equilibria():
    """An unstable equilibrium is reported with the growth rate of the matrices, also if it is
    unstable because of a negative damper."""
    deck = bars("leaves", {"Initial State": "Equilibrium"})
    bar = json.loads(pathlib.Path("bar10.json").read_text(encoding="utf-8"))
    count = len(bar["dofs"])

    def rest(name, share, damping):
        """Message of a run on these bars in a row, held on the left, with this damping; the free
        end loses `share` of the stiffness of both."""
        weak = dict(bar)
        K = np.array(bar["stiffness"])
        K[-1, -1] -= share * 1e6 / (count - 1) / 2
        weak["stiffness"], weak["damping"] = K.tolist(), (damping * np.eye(count)).tolist()
        pathlib.Path("weak.json").write_text(json.dumps(weak), encoding="utf-8")
        done = tooljoint("run", deck, "--output", name, "--set", "Parts/Imported/b/File=weak.json",
                         "--set", "Transient/End Time=2e-3")
        size = 2 * count - 1
        whole = {key: np.zeros((size, size)) for key in ("mass", "stiffness", "damping")}
        for at, part in ((0, bar), (count - 1, weak)):
            for key, matrix in whole.items():
                if key in part:
                    matrix[at:at + count, at:at + count] += np.array(part[key])
        M, C, K = (whole[key][1:, 1:] for key in ("mass", "damping", "stiffness"))
        inverse = np.linalg.inv(M)
        growth = np.linalg.eigvals(
            np.block([
                [np.zeros_like(M), np.eye(size - 1)],
                [-inverse @ K, -inverse @ C],
            ])).real.max()
        with open(f"{name}/summary.json", encoding="utf-8") as file:
            summary = json.load(file)["static"]
        return " ".join(done.stderr.split()), summary, growth

    said, summary, growth = rest("leaves", 2.0, 0.0)
    expect(
        "an equilibrium that the parts leave is warned of",
        "The equilibrium of the parts is unstable: the parts leave it" in said
        and "u of node b:11" in said, said[-500:])
    expect(
        "its growth rate is that of the matrices", summary["stable"] is False
        and abs(summary["growth_rate"] / growth - 1) < 1e-6 and summary["unstable_node"] == "b:11",
        f"{summary['growth_rate']} of {growth}")
    said, summary, _ = rest("stays", 0.5, 0.1)
    expect("one that they stay in is stable", "unstable" not in said and summary["stable"] is True
           and summary["negative_pivots"] == 0, said[-300:])
    said, summary, growth = rest("driven", 0.5, -0.1)
    expect("negative damping makes a vibration grow", "a vibration of" in said
           and abs(summary["growth_rate"] / growth - 1) < 1e-6,
           f"{summary.get('growth_rate')} of {growth}: {said[-400:]}")


def motion_tolerance_of_fast_parts():
    """Modes chosen by the motion keep their tolerance if the samples of the results are far apart:
    here 5 ms, for vibrations of up to 1 kHz."""
    M, K = springs_in_a_row(31, 1e7)
    write_bar("fast.json", M, K, damping=2e-6 * K + 2 * M)
    parts = {
        "Imported": {"a": {"File": "fast.json", "Fixed": ["left"]}, "b": {"File": "fast.json"}},
        "Joints": ["a:right = b:left"],
    }
    ramp = {
        "Laws": {"rise": {"Form": "Ramp", "Ramp": {"Duration": 1e-3}}},
        "Loads": {"pull": {"Part": "b", "Node": 31, "Component": "u", "Value": 1e3, "Law": "rise"}},
    }
    kick = {"Starts": {"end": {"Part": "b", "Node": 31, "Component": "u", "Displacement": 1e-3}}}
    for name, moved in (("ramp", ramp), ("kick", kick)):
        pathlib.Path(f"{name}.xml").write_text(
            parameter_list(
                name, {
                    "Parts": {**parts, **moved},
                    "Transient": {"End Time": 0.2, "Step": 2e-5},
                    "Reduction": {"Basis": "Rubin", "Mode Selection": {"Motion Tolerance": 1e-3}},
                }), encoding="utf-8")
        motions = []
        for folder, switch in (("reduced", ()), ("full", ("--without", "Reduction"))):
            done = tooljoint("run", f"{name}.xml", "--output", f"{name}_{folder}", *switch)
            expect(f"{name}: the {folder} model runs without a warning", done.returncode == 0
                   and "faster than its samples" not in done.stderr, done.stderr[-300:])
            with h5py.File(f"{name}_{folder}/results.h5") as results:
                motions.append(results["/transient/displacement"][:])
        error = np.linalg.norm(motions[0] - motions[1]) / np.linalg.norm(motions[1])
        expect(f"{name}: the motion keeps its tolerance", error < 1e-3, f"{error:.1e}")


def relaxed_laws_at_rest():
    """A law with a relaxed state at rest has no force there, for any ratio of its stiffness to that
    of the parts: 100 N on 20 springs in a row, 2 mm."""
    for law, values in (
        ("Maxwell", {"Stiffness": 1e7, "Damping": 40.0}),
        ("Elastic-Plastic", {"Stiffness": 1e7, "Yield Force": 1e3}),
    ):
        deck = bars(
            "relaxed", {
                "Initial State": "Equilibrium",
                "Loads": {"pull": {"Part": "b", "Node": 11, "Component": "u", "Value": 100.0}},
            }, Coupling={
                "Point Laws": {
                    "beside": {"First": "b:11", "Component": "u", "Type": law, law: values}
                }
            })
        done = tooljoint("run", deck, "--output", "relaxed")
        expect(f"an equilibrium beside {law} is found", done.returncode == 0, done.stderr[-300:])
        with h5py.File("relaxed/results.h5") as results:
            end = np.abs(results["/transient/displacement"][0]).max()
        expect(f"the parts rest as without it ({law})", abs(end / 2e-3 - 1) < 1e-9, end)


def responses_beyond_the_linear_range():
    """A linear response gives a warning if it reaches a stop, or if negative damping makes it
    meaningless, and no warning if it stays clear."""
    def warnings(name, force, damping, stop):
        pathlib.Path("one.json").write_text(
            json.dumps({
                "format": "tooljoint part 1", "components": ["u"], "dofs": [[1, "u"]],
                "mass": [[1.0]], "stiffness": [[4e3]], "damping": [[damping]]
            }), encoding="utf-8")
        at = {"Part": "p", "Node": 1, "Component": "u"}
        lists = {
            "Parts": {"Imported": {"p": {"File": "one.json"}}},
            "Response": {
                "Excitation": "Harmonic", "Highest Frequency": 20.0, "Points": 41,
                "Loads": {"l": {**at, "Value": force}}, "Outputs": {"o": at}
            },
        }
        if stop:
            lists["Coupling"] = {
                "Stops": {"s": {"First": "p:1", "Component": "u", "Gap": 1e-3, "Stiffness": 1e6}}
            }
        pathlib.Path(f"{name}.xml").write_text(parameter_list(name, lists), encoding="utf-8")
        done = tooljoint("response", f"{name}.xml", "--output", name, "--fresh")
        expect(f"the response {name} ends with 0", done.returncode == 0, done.stderr[-300:])
        return " ".join(done.stderr.split())

    far = 'The linear response is not that of the scene: at 10.0'
    # at resonance the amplitude is F / (c omega): 1 mm for F = c omega 1e-3
    limit = 5.0 * 4e3**0.5 * 1e-3
    said = warnings("beyond", 1.5 * limit, 5.0, True)
    expect("a stop that the response meets is warned of", far in said
           and 'the forces of "s" leave their tangents' in said, said)
    said = warnings("within", 0.9 * limit, 5.0, True)
    expect("one that it does not meet is not", "not that of the scene" not in said, said)
    said = warnings("growing", limit, -5.0, False)
    expect("a state that negative damping leaves is warned of",
           "The state of the parts is unstable: a vibration of 10.0" in said, said)
