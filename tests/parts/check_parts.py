#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Parts from files, looked at from outside: check_parts.py PROGRAM MPIEXEC

The scripts of docs/file-formats.md write parts that couple to the frequencies of the closed form; the frame of xml/ has the frequencies of the same
frame assembled here; reduced parts come back from both kinds of files; bad parts end alike on every rank.
"""
import csv
import importlib.util
import json
import pathlib
import re
import signal
import subprocess
import sys
import time

import h5py
import numpy as np
from scipy.linalg import eigh

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from checks import expect, finish, tooljoint  # noqa: E402
sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "stability/hard_cases"))
from bars import bars, springs_in_a_row  # noqa: E402
from program import parameter_list  # noqa: E402

PROGRAM, MPIEXEC = sys.argv[1:3]
ROOT = pathlib.Path(__file__).resolve().parents[2]


def hertz(deck, key, *arguments, ranks=1, count=12):
    folder = f"modes_{len(list(pathlib.Path().glob('modes_*')))}"
    done = tooljoint("modes", str(deck), "--count", str(count), "--output", folder, *arguments, ranks=ranks)
    if done.returncode != 0:
        expect(f"modes of {deck}", False, done.stderr)
        return np.zeros(count)
    return np.sort([float(row[key]) for row in csv.DictReader(open(f"{folder}/modes.csv", encoding="utf-8"))])


def documented_scripts():
    """Every python block of the part format writes a bar of N springs; two of them in a row are a bar of 2 N."""
    text = (ROOT / "docs" / "file-formats.md").read_text(encoding="utf-8")
    section = text[text.index("## Parts"):]
    scripts = re.findall(r"```python\n(.*?)```", section, re.S)
    expect("the documentation has two scripts", len(scripts) == 2, f"(found {len(scripts)})")
    for script in scripts:
        lines = [line for line in script.splitlines() if line.strip()]
        expect("a script has ten lines at most beside its imports", sum(not line.startswith(("import", "from")) for line in lines) <= 10)
        pathlib.Path("documented.py").write_text(script, encoding="utf-8")
        subprocess.run([sys.executable, "documented.py"], check=True)
    files = ["bar/part.json", "bar.h5"]
    deck = pathlib.Path("documented.xml")
    part = '<ParameterList name="{}"><Parameter name="File" type="string" value="{}"/>{}</ParameterList>'
    fixed = '<Parameter name="Fixed" type="Array(string)" value="{left}"/>'
    deck.write_text('<ParameterList name="bars"><ParameterList name="Parts"><ParameterList name="Imported">' + part.format("a", files[0], fixed) +
                    part.format("b", files[1], "") + '</ParameterList><Parameter name="Joints" type="Array(string)" value="{a:right = b:left}"/>'
                    "</ParameterList></ParameterList>", encoding="utf-8")
    found = hertz(deck, "full [Hz]", count=5)
    # springs k = 1e6 between masses m = 1 (m/2 at both ends of a bar) on a grid of n = 20: omega = 2 sqrt(k/m) sin((2j-1) pi / 4n)
    exact = 2e3 * np.sin((2 * np.arange(1, 6) - 1) * np.pi / 80) / (2 * np.pi)
    expect("documented parts couple to the closed form", np.abs(found / exact - 1).max() < 1e-11, f"{np.abs(found / exact - 1).max():.1e}")


def assembled_frame():
    """Frequencies of the frame of xml/frame.xml, assembled member by member without the program."""
    spec = importlib.util.spec_from_file_location("make_parts", ROOT / "xml" / "frame" / "make_parts.py")
    make = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(make)
    nodes, K, M = {}, np.zeros((300, 300)), np.zeros((300, 300))

    def member(start, direction, length, elements, across):
        x = np.array(direction, float)
        y = np.array(across, float)
        triad = np.column_stack([x, y, np.cross(x, y)])
        turn = np.kron(np.eye(4), triad)
        for e in range(elements):
            ends = [tuple(np.round(np.array(start) + x * length * (e + i) / elements, 9)) for i in (0, 1)]
            at = np.concatenate([6 * nodes.setdefault(end, len(nodes)) + np.arange(6) for end in ends])
            ke, me = make.element(length / elements)
            K[np.ix_(at, at)] += turn @ ke @ turn.T
            M[np.ix_(at, at)] += turn @ me @ turn.T

    for x in (0.0, 4.0):
        member((x, 0, 0), (0, 0, 1), 3.0, 6, (0, 1, 0))
    for z in (1.5, 3.0):
        member((0, 0, z), (1, 0, 0), 4.0, 8, (0, 1, 0))
    member((4, 0, 3), (0, 1, 0), 1.5, 4, (-1, 0, 0))
    tip = 6 * nodes[(4.0, 1.5, 3.0)]
    for c in range(3):
        M[tip + c, tip + c] += 40.0
    free = [6 * i + c for node, i in nodes.items() for c in range(6) if node[2] > 0]
    at = np.ix_(free, free)
    return np.sqrt(eigh(K[at], M[at], eigvals_only=True)[:12]) / (2 * np.pi)


def frame():
    deck = ROOT / "xml" / "frame.xml"
    exact = assembled_frame()
    full = hertz(deck, "full [Hz]")
    expect("the frame has the frequencies of one piece", np.abs(full / exact - 1).max() < 1e-9, f"{np.abs(full / exact - 1).max():.1e}")
    coupled = hertz(deck, "coupled [Hz]")
    expect("its reduced frequencies lie above, within a thousandth", ((coupled >= full * (1 - 1e-10)) & (coupled < full * 1.001)).all())
    for ranks in (2, 4):
        other = hertz(deck, "coupled [Hz]", ranks=ranks)
        expect(f"the same on {ranks} ranks", np.abs(other / coupled - 1).max() < 1e-10, f"{np.abs(other / coupled - 1).max():.1e}")
    made = pathlib.Path("made")
    subprocess.run([sys.executable, str(ROOT / "xml" / "frame" / "make_parts.py"), str(made)], check=True)
    for file in sorted(made.glob("*/*")):
        kept = (ROOT / "xml" / "frame" / file.relative_to(made)).read_text(encoding="utf-8")
        expect(f"{file} is what the script writes", kept == file.read_text(encoding="utf-8"))


def exported():
    """Parts written by a run, with loads and damping, give the same motion when they are read again."""
    deck = ROOT / "xml" / "frame.xml"
    short = ["--set", "Transient/End Time=0.5"]
    for kind, ending in (("HDF5", ".h5"), ("Matrix Market", "")):
        folder = pathlib.Path("run " + kind)
        done = tooljoint("run", str(deck), "--output", str(folder), "--set", f"Output/Export Parts={kind}", *short)
        expect(f"a run exports {kind}", done.returncode == 0 and len(list((folder / "parts").iterdir())) == 5, done.stderr[-300:] if done.returncode else "")
        overrides = ["--without", "Reduction", "--without", "Parts/Loads", "--without", "Parts/Starts"]  # both are in the files now
        for name in ("left column", "right column", "top beam", "middle beam", "arm"):
            overrides += ["--set", f"Parts/Imported/{name}/File={(folder / 'parts' / (name + ending)).resolve()}"]
            if name.endswith("column"):
                overrides += ["--without", f"Parts/Imported/{name}/Fixed"]
        again = pathlib.Path("again " + kind)
        done = tooljoint("run", str(deck), "--output", str(again), *overrides, *short)
        expect(f"{kind} runs again", done.returncode == 0, done.stderr[-600:] if done.returncode else "")
        if done.returncode != 0:
            continue
        motions = []
        for one in (folder, again):
            with h5py.File(one / "results.h5") as file:
                motions.append((dict(zip(zip(file["/model/part"][:], file["/model/node"][:]), range(1000))), file["/transient/displacement"][:]))
        (here, a), (there, b) = motions
        rows = [(i, there[key]) for key, i in here.items() if key in there]
        error = max(np.abs(a[:, i] - b[:, j]).max() for i, j in rows) / np.abs(a).max()
        expect(f"{kind}: same motion of {len(rows)} nodes", len(rows) >= 30 and error < 1e-9, f"{error:.1e}")
        summary = json.loads((again / "summary.json").read_text(encoding="utf-8"))
        expect(f"{kind}: the reduced parts are what moves", summary["model"]["free_dofs"] == 67, str(summary["model"]["free_dofs"]))


def string_part():
    """A reduced part of a string has point laws that a file cannot hold: exported with a warning, and read."""
    deck = ROOT / "tests" / "effects" / "scene.xml"
    done = tooljoint("export", str(deck), "--output", "string parts")
    expect("parts of a string are exported", done.returncode == 0, done.stderr[-400:] if done.returncode else "")
    expect("point laws that stay behind are named", "point law \"contact\"" in done.stdout + done.stderr)
    expect("files of all parts", len(list(pathlib.Path("string parts").glob("*.h5"))) >= 2)
    plain = ["--without", "Contact", "--without", "Rotary Speed"]
    tooljoint("export", str(deck), "--output", "plain parts", *plain)
    part = '<ParameterList name="{}"><Parameter name="File" type="string" value="{}"/></ParameterList>'
    law = '<ParameterList name="{}"><Parameter name="Form" type="string" value="Constant"/><ParameterList name="Constant"><Parameter name="Value" type="double" value="1"/>' \
          "</ParameterList></ParameterList>"
    files = sorted(pathlib.Path("plain parts").glob("*.h5"))
    laws = set()
    for file in files:
        with h5py.File(file) as content:
            content.visititems(lambda _, item: laws.add(item.attrs["law"]) if "law" in item.attrs else None)
    text = "".join(part.format(file.stem, file) for file in files)
    pathlib.Path("string.xml").write_text(
        f'<ParameterList name="string"><ParameterList name="Parts"><ParameterList name="Imported">{text}</ParameterList><ParameterList name="Laws">' +
        "".join(law.format(name) for name in sorted(laws - {"1"})) + "</ParameterList></ParameterList></ParameterList>", encoding="utf-8")
    there, here = hertz("string.xml", "full [Hz]"), hertz(deck, "coupled [Hz]", *plain)
    expect("parts of a string join by their node numbers to its frequencies", np.abs(there / here - 1).max() < 1e-12, f"{np.abs(there / here - 1).max():.1e}")


def bad_parts_on_ranks():
    for name, code in (("parts_not_finite", 2), ("parts_truncated_hdf5", 2), ("parts_unsymmetric_mass", 3), ("parts_massless_explicit", 3)):
        said = [tooljoint("check", str(ROOT / "tests" / "decks" / (name + ".xml")), ranks=ranks) for ranks in (1, 2)]
        expect(f"{name} ends with {code} on 1 and 2 ranks", all(one.returncode == code for one in said), str([one.returncode for one in said]))
        expect(f"{name} says the same once", said[0].stderr.strip() != "" and said[1].stderr.count(said[0].stderr.strip()) == 1)


def goes_on():
    """An interrupted run of parts goes on to the numbers of one that was not."""
    deck = str(ROOT / "xml" / "frame.xml")
    long = ["--set", "Transient/End Time=200", "--set", "Transient/Sampling Interval=0.1", "--set", "Transient/Checkpoint Interval=1"]
    whole = tooljoint("run", deck, "--output", "whole", *long)
    run = subprocess.Popen([PROGRAM, "run", deck, "--output", "halted", *long], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while run.poll() is None and not pathlib.Path("halted/checkpoint.bin").exists():
        time.sleep(0.002)
    run.send_signal(signal.SIGINT)
    run.wait(timeout=60)
    expect("an interrupted run ends with 130", run.returncode == 130, str(run.returncode))
    again = tooljoint("run", deck, "--output", "halted", "--restart", "halted", *long)
    expect("it goes on", whole.returncode == 0 and again.returncode == 0, again.stderr[-300:])
    with h5py.File("whole/results.h5") as a, h5py.File("halted/results.h5") as b:
        same = all(np.array_equal(a[name][:], b[name][:]) for name in ("/transient/time", "/transient/displacement", "/transient/velocity"))
    expect("to the same numbers", same)


def cost_energy_and_remarks():
    """A run of parts says what a run of a string says: cost of a step, energy balance, remarks of the coupling; a failed one leaves a summary."""
    deck = ROOT / "xml" / "frame.xml"
    short = ["--set", "Transient/End Time=0.2"]
    done = tooljoint("run", str(deck), "--output", "said", "--verbose", *short)
    summary = json.loads(pathlib.Path("said", "summary.json").read_text(encoding="utf-8"))
    ratio, energy = summary["reduction"]["cost_ratio"], summary["transient"]["energy_residual"]
    expect("cost of a step of both models", f"reduced model {ratio:.2f} of the full model" in done.stdout and 0 < ratio < 2, str(ratio))
    expect("energy balance", f"energy balance closes to {energy:.2g} of" in done.stdout and 0 < energy < 2e-3, str(energy))
    full = tooljoint("run", str(deck), "--output", "remarked", "--set", "Reduction/Basis=Enhanced Craig-Bampton", *short)
    warned = json.loads(pathlib.Path("remarked", "summary.json").read_text(encoding="utf-8"))["warnings"]
    expect("remarks of the coupling are warnings", any("coupled matrices are full" in line for line in warned), full.stderr[-300:])
    loose = tooljoint("run", str(deck), "--output", "loose", "--set", "Parts/Initial State=Equilibrium", "--set", "Parts/Imported/left column/Fixed={}",
                      "--set", "Parts/Imported/right column/Fixed={}", *short)
    left = json.loads(pathlib.Path("loose", "summary.json").read_text(encoding="utf-8")) if pathlib.Path("loose", "summary.json").exists() else {}
    expect("parts that nothing holds end with 3 and a summary", loose.returncode == 3 and left.get("status") == "failed", f"{loose.returncode} {loose.stderr[-300:]} {left}")


def refused():
    """A study of parts without a Study list is refused with a sentence; tests/study/check_frame_study.py has one that runs."""
    done = tooljoint("study", str(ROOT / "xml" / "frame.xml"))
    expect("a study of parts needs a Study list", done.returncode == 2 and "has no Study list" in done.stderr)
    done = tooljoint("check", bars("kept"), "--set", "Parts/Imported/a/Retained={left}")
    expect("a set that is retained and fixed is refused", done.returncode == 2 and 'a/Retained names "left", whose dofs are all in Fixed' in " ".join(done.stderr.split()), done.stderr[-300:])


def released():
    """At a released dof results have the motion of the first part: those that name the other one are refused."""
    good = ROOT / "tests" / "decks" / "parts" / "good"
    imported = "".join(f'<ParameterList name="{name}"><Parameter name="File" type="string" value="{good}"/></ParameterList>' for name in "ab")
    pathlib.Path("released.xml").write_text(
        f'<ParameterList name="released"><ParameterList name="Parts"><ParameterList name="Imported">{imported}</ParameterList>'
        '<Parameter name="Joints" type="Array(string)" value="{a:right = b:left}"/></ParameterList>'
        '<ParameterList name="Coupling"><ParameterList name="Releases"><ParameterList name="slide"><Parameter name="Node" type="string" value="b:1"/>'
        '<Parameter name="Components" type="string" value="u"/></ParameterList></ParameterList></ParameterList>'
        '<ParameterList name="Transient"><Parameter name="End Time" type="double" value="0.01"/><Parameter name="Step" type="double" value="1e-3"/></ParameterList>'
        '<ParameterList name="Response"><Parameter name="Highest Frequency" type="double" value="1"/><Parameter name="Points" type="int" value="2"/>'
        '<Parameter name="Excitation" type="string" value="Transfer"/><ParameterList name="Loads"><ParameterList name="f"><Parameter name="Part" type="string" value="a"/>'
        '<Parameter name="Node" type="int" value="2"/><Parameter name="Component" type="string" value="u"/></ParameterList></ParameterList>'
        '<ParameterList name="Outputs"><ParameterList name="x"><Parameter name="Part" type="string" value="b"/><Parameter name="Node" type="int" value="1"/>'
        '<Parameter name="Component" type="string" value="u"/></ParameterList></ParameterList></ParameterList></ParameterList>', encoding="utf-8")
    nodes = tooljoint("run", "released.xml", "--output", "released", "--set", "Output/Nodes={b:1}")
    expect("a recorded node that is released is refused", nodes.returncode == 2 and 'names "b:1", of which a component is released' in nodes.stderr, nodes.stderr[-300:])
    other = tooljoint("run", "released.xml", "--output", "released", "--set", "Output/Nodes={b:2}")
    expect("others are recorded", other.returncode == 0, other.stderr[-300:])
    response = tooljoint("response", "released.xml", "--output", "released_response")
    expect("an output that is released is refused", response.returncode == 2 and "which is released: results have it for part \"a\" only" in response.stderr,
           f"({response.returncode}) {response.stderr[-400:]}")


def laws_on_joints():
    """Forces between parts as coordinates have no residual flexibility for the force of a law: of Dual Craig-Bampton such laws are refused where they are wrong at rest."""
    def spring(stiffness, damping=0.0):
        return {"Springs": {"s": {"First": "a:11", "Component": "u", "Stiffness": stiffness, "Damping": damping}}}

    def reduced(deck, basis):
        return tooljoint("modes", deck, "--count", "4", "--output", f"law_{basis[:4]}", "--set", f"Reduction/Basis={basis}")

    few = {"Basis": "Rubin", "Mode Selection": {"Modes": 4}}
    for name, law, words in (("stiff", spring(3e6), "times the residual flexibility there"), ("damped", spring(1.0, 10.0), "Its damping makes a motion grow")):
        deck = bars(name, Coupling=law, Reduction=few)
        done = reduced(deck, "Dual Craig-Bampton")
        said = " ".join(done.stderr.split())
        expect(f"a {name} spring on a joint of Dual Craig-Bampton is refused", done.returncode == 3 and words in said and 'Choose "Rubin"' in said, f"{done.returncode} {said[-400:]}")
        expect(f"and taken by Rubin ({name})", reduced(deck, "Rubin").returncode == 0)
    soft = bars("soft", Coupling=spring(1e3), Reduction=few)
    expect("a soft spring is warned of", "act where the forces between parts move the dofs" in " ".join(tooljoint("run", soft, "--output", "soft", "--set", "Reduction/Basis=Dual Craig-Bampton").stderr.split()))


def starts_of_joints():
    """A joined node starts once, under whichever name; a constraint with a value holds from the start."""
    def started(*places):
        return {"Starts": {f"s{i}": {"Part": part, "Node": node, "Component": "u", "Displacement": x} for i, (part, node, x) in enumerate(places)}}

    done = tooljoint("run", bars("twice", started(("a", 11, 1e-3), ("b", 1, 1e-3))), "--output", "twice")
    expect("two starts of one joined node are refused", done.returncode == 2 and "they are joined. Leave one of the two out" in " ".join(done.stderr.split()), done.stderr[-400:])
    held = {"Constraints": {"c": {"Terms": ["b:11:u"], "Factors": [1.0], "Value": 1e-3}}}
    for x, code in ((1e-3, 0), (2e-3, 2)):
        done = tooljoint("run", bars("started", started(("b", 11, x)), Coupling=held), "--output", "started")
        expect(f"a start of {x} m where a constraint holds 1 mm ends with {code}", done.returncode == code and (code == 0 or "that a constraint holds at 0.001. Leave it out" in " ".join(done.stderr.split())), done.stderr[-400:])
    done = tooljoint("run", bars("held", {"Initial State": "Equilibrium"}, Coupling=held), "--output", "held")
    expect("a constraint with a value and Equilibrium run", done.returncode == 0, done.stderr[-400:])
    if done.returncode == 0:
        with h5py.File("held/results.h5") as results:
            moved = results["/transient/displacement"][:, :, 0]
        # 20 equal springs between 0 and 1 mm
        exact = 1e-3 * np.arange(21) / 20
        expect("it rests stretched by it", np.abs(np.sort(moved, axis=1) - exact[1:] if moved.shape[1] == 20 else np.sort(moved, axis=1) - exact).max() < 1e-12, np.abs(moved[0]))


def floating_beams():
    """Two free beams, the second turned about its axis, whose planes of bending are nearly the same: six rigid-body modes, whatever rounding leaves of them."""
    spec = importlib.util.spec_from_file_location("make_parts", ROOT / "xml" / "frame" / "make_parts.py")
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
        pathlib.Path("free.json").write_text(json.dumps({"format": "tooljoint part 1", "components": names, "dofs": nodes, "mass": M.tolist(), "stiffness": K.tolist(), "damping": (1e-5 * K).tolist(),
                                                         "interfaces": {"left": [[1, c] for c in names], "right": [[elements + 1, c] for c in names]}}), encoding="utf-8")
        imported = {"a": {"File": "free.json"}, "b": {"File": "free.json", "Rotation Axis": [1.0, 0.0, 0.0], "Rotation Angle": 0.6}}
        pathlib.Path("free.xml").write_text(parameter_list("free", {"Parts": {"Imported": imported, "Joints": ["a:right = b:left"]}}), encoding="utf-8")
        done = tooljoint("modes", "free.xml", "--count", "8", "--output", "free")
        undamped, damped = ([float(row[key]) for row in csv.DictReader(open(f"free/{file}.csv", encoding="utf-8"))] for file, key in (("modes", "full [Hz]"), ("damped_modes", "full [Hz]")))
        expect(f"planes that differ by {difference:g}: six rigid-body modes, undamped and damped", done.returncode == 0 and undamped[:6] == [0.0] * 6 and undamped[6] > 1 and sum(x == 0.0 for x in damped[:8]) == 6,
               f"{undamped} {damped}")


def creeping_dofs():
    """Massless interior dofs with dampers are in no basis, and that is said."""
    deck = bars("creep", Reduction={"Basis": "Craig-Bampton", "Mode Selection": {"All Modes": True}})
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
    expect("damping in proportion to the stiffness is none of it", full.returncode == 0 and done.returncode == 0 and "with damping but no mass" not in " ".join(done.stderr.split()), done.stderr[-300:])


def unstable_equilibria():
    """An equilibrium that the parts leave is told, with the growth rate of the matrices; so is one that a negative damper drives."""
    deck = bars("leaves", {"Initial State": "Equilibrium"})
    bar = json.loads(pathlib.Path("bar10.json").read_text(encoding="utf-8"))
    count = len(bar["dofs"])

    def rest(name, share, damping):
        """What a run says of these bars in a row, held on the left, with this damping; `share` of the stiffness of both is taken off the free end."""
        weak = dict(bar)
        K = np.array(bar["stiffness"])
        K[-1, -1] -= share * 1e6 / (count - 1) / 2
        weak["stiffness"], weak["damping"] = K.tolist(), (damping * np.eye(count)).tolist()
        pathlib.Path("weak.json").write_text(json.dumps(weak), encoding="utf-8")
        done = tooljoint("run", deck, "--output", name, "--set", "Parts/Imported/b/File=weak.json", "--set", "Transient/End Time=2e-3")
        size = 2 * count - 1
        whole = {key: np.zeros((size, size)) for key in ("mass", "stiffness", "damping")}
        for at, part in ((0, bar), (count - 1, weak)):
            for key, matrix in whole.items():
                if key in part:
                    matrix[at:at + count, at:at + count] += np.array(part[key])
        M, C, K = (whole[key][1:, 1:] for key in ("mass", "damping", "stiffness"))
        inverse = np.linalg.inv(M)
        growth = np.linalg.eigvals(np.block([[np.zeros_like(M), np.eye(size - 1)], [-inverse @ K, -inverse @ C]])).real.max()
        with open(f"{name}/summary.json", encoding="utf-8") as file:
            summary = json.load(file)["static"]
        return " ".join(done.stderr.split()), summary, growth

    said, summary, growth = rest("leaves", 2.0, 0.0)
    expect("an equilibrium that the parts leave is warned of", "The equilibrium of the parts is unstable: the parts leave it" in said and "u of node b:11" in said, said[-500:])
    expect("its growth rate is that of the matrices", summary["stable"] is False and abs(summary["growth_rate"] / growth - 1) < 1e-6 and summary["unstable_node"] == "b:11",
           f"{summary['growth_rate']} of {growth}")
    said, summary, _ = rest("stays", 0.5, 0.1)
    expect("one that they stay in is stable", "unstable" not in said and summary["stable"] is True and summary["negative_pivots"] == 0, said[-300:])
    said, summary, growth = rest("driven", 0.5, -0.1)
    expect("negative damping makes a vibration grow", "a vibration of" in said and abs(summary["growth_rate"] / growth - 1) < 1e-6, f"{summary.get('growth_rate')} of {growth}: {said[-400:]}")


def turned_out_of_the_plane():
    """A part that moves in u and v, turned about its x axis, moves along w in the common frame; the results have it."""
    pathlib.Path("plane.json").write_text(json.dumps({"format": "tooljoint part 1", "components": ["u", "v"], "dofs": [[1, "u"], [1, "v"]], "mass": [[1, 0], [0, 1]],
                                                      "stiffness": [[1e4, 0], [0, 4e4]], "initial_displacement": [0, 1e-3]}), encoding="utf-8")
    turned = {"File": "plane.json", "Rotation Axis": [1.0, 0.0, 0.0], "Rotation Angle": "30 deg"}
    deck = pathlib.Path("plane.xml")
    deck.write_text(parameter_list("plane", {"Parts": {"Imported": {"a": turned}}, "Transient": {"End Time": 0.02, "Step": 1e-4, "Sampling Interval": 1e-3}}), encoding="utf-8")
    done = tooljoint("run", str(deck), "--output", "plane")
    expect("a part of u and v turned about x runs", done.returncode == 0, done.stderr[-400:])
    with h5py.File("plane/results.h5") as results:
        names = [name.decode() for name in results["/model/components"][:]]
        motion = results["/transient/displacement"][:].reshape(-1, len(names))
    exact = 1e-3 * np.cos(200.0 * 1e-3 * np.arange(len(motion)))
    expect("its motion along w is in the results", names == ["u", "v", "w"] and np.abs(motion[:, 1] - np.cos(np.pi / 6) * exact).max() < 1e-6 and
           np.abs(motion[:, 2] - np.sin(np.pi / 6) * exact).max() < 1e-6, f"{names} {motion[-1]}")
    lists = {"Parts": {"Imported": {"a": turned}}, "Coupling": {"Frames": {"all": {"Part": "a", "Axis 1": [0.0, 1.0, 0.0], "Axis 2": [-1.0, 0.0, 0.0]}}}}
    deck.write_text(parameter_list("plane", lists), encoding="utf-8")
    done = tooljoint("check", str(deck))
    expect("a rotation beside a frame of the whole part is refused", done.returncode == 2 and "Rotation Angle has no effect" in " ".join(done.stderr.split()), done.stderr[-300:])


def motion_tolerance_of_fast_parts():
    """Modes chosen by the motion keep their tolerance where the samples of the results are far apart: here 5 ms, for vibrations of up to 1 kHz."""
    count = 31
    M, K = springs_in_a_row(count, 1e7)
    pathlib.Path("fast.json").write_text(json.dumps({"format": "tooljoint part 1", "components": ["u"], "dofs": [[i + 1, "u"] for i in range(count)], "mass": M.tolist(),
                                                     "damping": (2e-6 * K + 2 * M).tolist(), "stiffness": K.tolist(),
                                                     "interfaces": {"left": [[1, "u"]], "right": [[count, "u"]]}}), encoding="utf-8")
    parts = {"Imported": {"a": {"File": "fast.json", "Fixed": ["left"]}, "b": {"File": "fast.json"}}, "Joints": ["a:right = b:left"]}
    ramp = {"Laws": {"rise": {"Form": "Ramp", "Ramp": {"Duration": 1e-3}}}, "Loads": {"pull": {"Part": "b", "Node": 31, "Component": "u", "Value": 1e3, "Law": "rise"}}}
    kick = {"Starts": {"end": {"Part": "b", "Node": 31, "Component": "u", "Displacement": 1e-3}}}
    for name, moved in (("ramp", ramp), ("kick", kick)):
        pathlib.Path(f"{name}.xml").write_text(parameter_list(name, {"Parts": {**parts, **moved}, "Transient": {"End Time": 0.2, "Step": 2e-5},
                                                                     "Reduction": {"Basis": "Rubin", "Mode Selection": {"Motion Tolerance": 1e-3}}}), encoding="utf-8")
        motions = []
        for folder, switch in (("reduced", ()), ("full", ("--without", "Reduction"))):
            done = tooljoint("run", f"{name}.xml", "--output", f"{name}_{folder}", *switch)
            expect(f"{name}: the {folder} model runs without a warning", done.returncode == 0 and "faster than its samples" not in done.stderr, done.stderr[-300:])
            with h5py.File(f"{name}_{folder}/results.h5") as results:
                motions.append(results["/transient/displacement"][:])
        error = np.linalg.norm(motions[0] - motions[1]) / np.linalg.norm(motions[1])
        expect(f"{name}: the motion keeps its tolerance", error < 1e-3, f"{error:.1e}")


def relaxed_laws_at_rest():
    """A law whose state is relaxed at rest has no force there, however stiff it is beside the parts: 100 N on 20 springs in a row, 2 mm."""
    for law, values in (("Maxwell", {"Stiffness": 1e7, "Damping": 40.0}), ("Elastic-Plastic", {"Stiffness": 1e7, "Yield Force": 1e3})):
        deck = bars("relaxed", {"Initial State": "Equilibrium", "Loads": {"pull": {"Part": "b", "Node": 11, "Component": "u", "Value": 100.0}}},
                    Coupling={"Point Laws": {"beside": {"First": "b:11", "Component": "u", "Type": law, law: values}}})
        done = tooljoint("run", deck, "--output", "relaxed")
        expect(f"an equilibrium beside {law} is found", done.returncode == 0, done.stderr[-300:])
        with h5py.File("relaxed/results.h5") as results:
            end = np.abs(results["/transient/displacement"][0]).max()
        expect(f"the parts rest as without it ({law})", abs(end / 2e-3 - 1) < 1e-9, end)


def starts_that_coordinates_lose():
    """Coordinates that depend on others, and modes of interfaces, lose of a start what the bases have: the warning counts that too."""
    start = {"Starts": {f"s{i}": {"Part": part, "Node": node, "Component": "u", "Velocity": v} for i, (part, node, v) in enumerate((("a", 5, 1.0), ("b", 4, -2.0), ("b", 9, 0.5)))}}
    deck = bars("tied", start, Reduction={"Basis": "Enhanced Craig-Bampton", "Mode Selection": {"Modes": 8}})
    told = {}
    for name in ("Free", "Tied"):
        done = tooljoint("run", deck, "--output", f"tied_{name}", "--set", f"Reduction/Enhanced Craig-Bampton/Residual Coordinates={name}")
        expect(f"a start of Enhanced Craig-Bampton runs ({name})", done.returncode == 0, done.stderr[-300:])
        with open(f"tied_{name}/summary.json", encoding="utf-8") as file:
            misfit = json.load(file)["reduction"]["start_misfit"]
        told[name] = (misfit, "does not represent the initial state" in " ".join(done.stderr.split()))
    expect("free coordinates have the start", told["Free"][0] < 1e-9 and not told["Free"][1], told["Free"])
    expect("tied ones lose a part of it, which is told", told["Tied"][0] > 0.05 and told["Tied"][1], told["Tied"])


def responses_beyond_the_linear_range():
    """A linear response that meets a stop, or that negative damping makes none, is warned of; one that stays clear is not."""
    def warnings(name, force, damping, stop):
        pathlib.Path("one.json").write_text(json.dumps({"format": "tooljoint part 1", "components": ["u"], "dofs": [[1, "u"]], "mass": [[1.0]], "stiffness": [[4e3]],
                                                        "damping": [[damping]]}), encoding="utf-8")
        at = {"Part": "p", "Node": 1, "Component": "u"}
        lists = {"Parts": {"Imported": {"p": {"File": "one.json"}}},
                 "Response": {"Excitation": "Harmonic", "Highest Frequency": 20.0, "Points": 41, "Loads": {"l": {**at, "Value": force}}, "Outputs": {"o": at}}}
        if stop:
            lists["Coupling"] = {"Stops": {"s": {"First": "p:1", "Component": "u", "Gap": 1e-3, "Stiffness": 1e6}}}
        pathlib.Path(f"{name}.xml").write_text(parameter_list(name, lists), encoding="utf-8")
        done = tooljoint("response", f"{name}.xml", "--output", name, "--fresh")
        expect(f"the response {name} ends with 0", done.returncode == 0, done.stderr[-300:])
        return " ".join(done.stderr.split())

    far = 'The linear response is not that of the scene: at 10.0'
    # at resonance the amplitude is F / (c omega): 1 mm for F = c omega 1e-3
    limit = 5.0 * 4e3**0.5 * 1e-3
    said = warnings("beyond", 1.5 * limit, 5.0, True)
    expect("a stop that the response meets is warned of", far in said and 'the forces of "s" leave their tangents' in said, said)
    said = warnings("within", 0.9 * limit, 5.0, True)
    expect("one that it does not meet is not", "not that of the scene" not in said, said)
    said = warnings("growing", limit, -5.0, False)
    expect("a state that negative damping leaves is warned of", "The state of the parts is unstable: a vibration of 10.0" in said, said)


def massless_nodes_of_dual_assemblies():
    """A node without mass starts in balance with the others, also where a multiplier joins it: q2 = q1/2 beside q3, whatever it is given."""
    for part, m, k, ends in (("a", [1.0, 0.0, 1.0], [[2e4, -1e4, 0], [-1e4, 2e4, -1e4], [0, -1e4, 1e4]], {"r": [3]}), ("b", [1.0, 1.0], [[1e4, -1e4], [-1e4, 1e4]], {"l": [1]})):
        pathlib.Path(f"{part}.json").write_text(json.dumps({"format": "tooljoint part 1", "components": ["u"], "dofs": [[i + 1, "u"] for i in range(len(m))],
                                                            "mass": np.diag(m).tolist(), "stiffness": k, "interfaces": ends}), encoding="utf-8")
    lists = {"Parts": {"Imported": {part: {"File": f"{part}.json"} for part in "ab"}, "Joints": ["a:r = b:l"], "Starts": {"s": {"Part": "a", "Node": 1, "Component": "u", "Displacement": 1e-3}}}, "Transient": {"End Time": 0.2, "Sampling Interval": 1e-3, "Step": 1e-3, "Generalized-alpha": {"Spectral Radius": 1.0}}}
    motions = {}
    for assembly, basis in (("Primal", "Craig-Bampton"), ("Dual", "Guyan")):
        lists.update({"Coupling": {"Assembly": assembly}, "Reduction": {"Basis": basis, "Mode Selection": {"All Modes": True}}})
        pathlib.Path("massless.xml").write_text(parameter_list("massless", lists), encoding="utf-8")
        done = tooljoint("run", "massless.xml", "--output", "massless")
        expect(f"a massless node runs in a {assembly} assembly, all modes kept", done.returncode == 0 and "kinetic energy" not in done.stderr, done.stderr[-300:])
        motions[assembly] = h5py.File("massless/results.h5")["/transient/velocity"][:, :, 0]
    expect("its motion is the same in both", np.abs(motions["Dual"] - motions["Primal"]).max() < 1e-9 * np.abs(motions["Primal"]).max() < 1e-9, np.abs(motions["Dual"]).max())


if __name__ == "__main__":
    documented_scripts()
    frame()
    exported()
    string_part()
    bad_parts_on_ranks()
    goes_on()
    cost_energy_and_remarks()
    refused()
    released()
    laws_on_joints()
    starts_of_joints()
    massless_nodes_of_dual_assemblies()
    floating_beams()
    creeping_dofs()
    unstable_equilibria()
    turned_out_of_the_plane()
    motion_tolerance_of_fast_parts()
    relaxed_laws_at_rest()
    starts_that_coordinates_lose()
    responses_beyond_the_linear_range()
    sys.exit(finish())
