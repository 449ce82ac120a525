#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Parts from files, tested through the program: check_parts.py PROGRAM MPIEXEC

The scripts of docs/file-formats.md write parts whose coupled frequencies agree with the closed
form; the frame of xml/ has the frequencies of the same frame assembled here; reduced parts are read
from both kinds of files; bad parts give the same error on every rank.
"""
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
from bars import bars  # noqa: E402
from frequencies import ROOT, hertz  # noqa: E402
from joints import (laws_on_joints, massless_nodes_of_dual_assemblies, released, starts_of_joints,
                    starts_that_coordinates_lose, turned_out_of_the_plane)  # noqa: E402
from massless import massless_directions  # noqa: E402
from dynamics import (creeping_dofs, floating_beams, motion_tolerance_of_fast_parts,
                      relaxed_laws_at_rest, responses_beyond_the_linear_range,
                      unstable_equilibria)  # noqa: E402

PROGRAM, MPIEXEC = sys.argv[1:3]


def documented_scripts():
    """Every python block of the part format writes a bar of N springs; two of them in a row are a
    bar of 2 N."""
    text = (ROOT / "docs" / "file-formats.md").read_text(encoding="utf-8")
    section = text[text.index("## Parts"):]
    scripts = re.findall(r"```python\n(.*?)```", section, re.S)
    expect("the documentation has two scripts", len(scripts) == 2, f"(found {len(scripts)})")
    for script in scripts:
        lines = [line for line in script.splitlines() if line.strip()]
        expect("a script has ten lines at most beside its imports",
               sum(not line.startswith(("import", "from")) for line in lines) <= 10)
        pathlib.Path("documented.py").write_text(script, encoding="utf-8")
        subprocess.run([sys.executable, "documented.py"], check=True)
    files = ["bar/part.json", "bar.h5"]
    deck = pathlib.Path("documented.xml")
    part = ('<ParameterList name="{}"><Parameter name="File" type="string" '
            'value="{}"/>{}</ParameterList>')
    fixed = '<Parameter name="Fixed" type="Array(string)" value="{left}"/>'
    deck.write_text(
        '<ParameterList name="bars"><ParameterList name="Parts"><ParameterList name="Imported">' +
        part.format("a", files[0], fixed) + part.format("b", files[1], "") +
        '</ParameterList><Parameter name="Joints" type="Array(string)" value="{a:right = b:left}"/>'
        "</ParameterList></ParameterList>", encoding="utf-8")
    found = hertz(deck, "full [Hz]", count=5)
    # springs k = 1e6 between masses m = 1 (m/2 at both ends of a bar) on a grid of n = 20: omega =
    # 2 sqrt(k/m) sin((2j-1) pi / 4n)
    exact = 2e3 * np.sin((2 * np.arange(1, 6) - 1) * np.pi / 80) / (2 * np.pi)
    expect("documented parts couple to the closed form",
           np.abs(found / exact - 1).max() < 1e-11, f"{np.abs(found / exact - 1).max():.1e}")


def assembled_frame():
    """Frequencies of the frame of xml/frame.xml, assembled member by member without the program."""
    spec = importlib.util.spec_from_file_location("make_parts",
                                                  ROOT / "xml" / "frame" / "make_parts.py")
    make = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(make)
    nodes, K, M = {}, np.zeros((300, 300)), np.zeros((300, 300))

    def member(start, direction, length, elements, across):
        x = np.array(direction, float)
        y = np.array(across, float)
        triad = np.column_stack([x, y, np.cross(x, y)])
        turn = np.kron(np.eye(4), triad)
        for e in range(elements):
            ends = [
                tuple(np.round(np.array(start) + x * length * (e + i) / elements, 9))
                for i in (0, 1)
            ]
            at = np.concatenate(
                [6 * nodes.setdefault(end, len(nodes)) + np.arange(6) for end in ends])
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
    expect("the frame has the frequencies of one piece",
           np.abs(full / exact - 1).max() < 1e-9, f"{np.abs(full / exact - 1).max():.1e}")
    coupled = hertz(deck, "coupled [Hz]")
    expect("its reduced frequencies lie above, within a thousandth",
           ((coupled >= full * (1 - 1e-10)) & (coupled < full * 1.001)).all())
    for ranks in (2, 4):
        other = hertz(deck, "coupled [Hz]", ranks=ranks)
        expect(f"the same on {ranks} ranks",
               np.abs(other / coupled - 1).max() < 1e-10,
               f"{np.abs(other / coupled - 1).max():.1e}")
    made = pathlib.Path("made")
    subprocess.run(
        [sys.executable, str(ROOT / "xml" / "frame" / "make_parts.py"),
         str(made)], check=True)
    for file in sorted(made.glob("*/*")):
        kept = (ROOT / "xml" / "frame" / file.relative_to(made)).read_text(encoding="utf-8")
        expect(f"{file} is what the script writes", kept == file.read_text(encoding="utf-8"))


def exported():
    """Parts written by a run, with loads and damping, give the same motion when they are read
    again."""
    deck = ROOT / "xml" / "frame.xml"
    short = ["--set", "Transient/End Time=0.5"]
    for kind, ending in (("HDF5", ".h5"), ("Matrix Market", "")):
        folder = pathlib.Path("run " + kind)
        done = tooljoint("run", str(deck), "--output", str(folder), "--set",
                         f"Output/Export Parts={kind}", *short)
        expect(f"a run exports {kind}", done.returncode == 0
               and len(list((folder / "parts").iterdir())) == 5,
               done.stderr[-300:] if done.returncode else "")
        # now both are in the files
        overrides = [
            "--without", "Reduction", "--without", "Parts/Loads", "--without", "Parts/Starts"
        ]
        for name in ("left column", "right column", "top beam", "middle beam", "arm"):
            overrides += [
                "--set",
                f"Parts/Imported/{name}/File={(folder / 'parts' / (name + ending)).resolve()}"
            ]
            if name.endswith("column"):
                overrides += ["--without", f"Parts/Imported/{name}/Fixed"]
        again = pathlib.Path("again " + kind)
        done = tooljoint("run", str(deck), "--output", str(again), *overrides, *short)
        expect(f"{kind} runs again", done.returncode == 0,
               done.stderr[-600:] if done.returncode else "")
        if done.returncode != 0:
            continue
        motions = []
        for one in (folder, again):
            with h5py.File(one / "results.h5") as file:
                motions.append(
                    (dict(zip(zip(file["/model/part"][:], file["/model/node"][:]),
                              range(1000))), file["/transient/displacement"][:]))
        (here, a), (there, b) = motions
        rows = [(i, there[key]) for key, i in here.items() if key in there]
        error = max(np.abs(a[:, i] - b[:, j]).max() for i, j in rows) / np.abs(a).max()
        expect(f"{kind}: same motion of {len(rows)} nodes",
               len(rows) >= 30 and error < 1e-9, f"{error:.1e}")
        summary = json.loads((again / "summary.json").read_text(encoding="utf-8"))
        expect(f"{kind}: the reduced parts are what moves", summary["model"]["free_dofs"] == 67,
               str(summary["model"]["free_dofs"]))


def string_part():
    """A reduced part of a string has point laws, which a file cannot contain: it is exported with a
    warning, and read."""
    deck = ROOT / "tests" / "effects" / "scene.xml"
    done = tooljoint("export", str(deck), "--output", "string parts")
    expect("parts of a string are exported", done.returncode == 0,
           done.stderr[-400:] if done.returncode else "")
    expect("point laws that stay behind are named", "point law \"contact\""
           in done.stdout + done.stderr)
    expect("files of all parts", len(list(pathlib.Path("string parts").glob("*.h5"))) >= 2)
    plain = ["--without", "Contact", "--without", "Rotary Speed"]
    tooljoint("export", str(deck), "--output", "plain parts", *plain)
    part = ('<ParameterList name="{}"><Parameter name="File" type="string" value="{}"/>'
            '</ParameterList>')
    law = ('<ParameterList name="{}"><Parameter name="Form" type="string" '
           'value="Constant"/><ParameterList name="Constant"><Parameter '
           'name="Value" type="double" value="1"/>'
           "</ParameterList></ParameterList>")
    files = sorted(pathlib.Path("plain parts").glob("*.h5"))
    laws = set()
    for file in files:
        with h5py.File(file) as content:
            content.visititems(lambda _, item: laws.add(item.attrs["law"])
                               if "law" in item.attrs else None)
    text = "".join(part.format(file.stem, file) for file in files)
    pathlib.Path("string.xml").write_text(
        '<ParameterList name="string"><ParameterList name="Parts"><ParameterList '
        f'name="Imported">{text}</ParameterList><ParameterList name="Laws">' +
        "".join(law.format(name) for name in sorted(laws - {"1"})) +
        "</ParameterList></ParameterList></ParameterList>", encoding="utf-8")
    there, here = hertz("string.xml", "full [Hz]"), hertz(deck, "coupled [Hz]", *plain)
    expect("parts of a string join by their node numbers to its frequencies",
           np.abs(there / here - 1).max() < 1e-12, f"{np.abs(there / here - 1).max():.1e}")


def bad_parts_on_ranks():
    for name, code in (("parts_not_finite", 2), ("parts_truncated_hdf5", 2),
                       ("parts_unsymmetric_mass", 3), ("parts_massless_explicit", 3)):
        said = [
            tooljoint("check", str(ROOT / "tests" / "decks" / (name + ".xml")), ranks=ranks)
            for ranks in (1, 2)
        ]
        expect(f"{name} ends with {code} on 1 and 2 ranks",
               all(one.returncode == code for one in said), str([one.returncode for one in said]))
        expect(f"{name} says the same once", said[0].stderr.strip() != ""
               and said[1].stderr.count(said[0].stderr.strip()) == 1)


def goes_on():
    """An interrupted run of parts continues to the numbers of an uninterrupted one."""
    deck = str(ROOT / "xml" / "frame.xml")
    long = [
        "--set", "Transient/End Time=200", "--set", "Transient/Sampling Interval=0.1", "--set",
        "Transient/Checkpoint Interval=1"
    ]
    whole = tooljoint("run", deck, "--output", "whole", *long)
    run = subprocess.Popen([PROGRAM, "run", deck, "--output", "halted", *long],
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while run.poll() is None and not pathlib.Path("halted/checkpoint.bin").exists():
        time.sleep(0.002)
    run.send_signal(signal.SIGINT)
    run.wait(timeout=60)
    expect("an interrupted run ends with 130", run.returncode == 130, str(run.returncode))
    again = tooljoint("run", deck, "--output", "halted", "--restart", "halted", *long)
    expect("it goes on", whole.returncode == 0 and again.returncode == 0, again.stderr[-300:])
    with h5py.File("whole/results.h5") as a, h5py.File("halted/results.h5") as b:
        same = all(
            np.array_equal(a[name][:], b[name][:])
            for name in ("/transient/time", "/transient/displacement", "/transient/velocity"))
    expect("to the same numbers", same)


def cost_energy_and_remarks():
    """A run of parts prints the same as a run of a string: cost of a step, energy balance, remarks
    of the coupling. A failed run writes a summary."""
    deck = ROOT / "xml" / "frame.xml"
    short = ["--set", "Transient/End Time=0.2"]
    done = tooljoint("run", str(deck), "--output", "said", "--verbose", *short)
    summary = json.loads(pathlib.Path("said", "summary.json").read_text(encoding="utf-8"))
    ratio, energy = summary["reduction"]["cost_ratio"], summary["transient"]["energy_residual"]
    expect("cost of a step of both models",
           f"reduced model {ratio:.2f} of the full model" in done.stdout and 0 < ratio < 2,
           str(ratio))
    expect("energy balance", f"energy balance closes to {energy:.2g} of" in done.stdout
           and 0 < energy < 2e-3, str(energy))
    full = tooljoint("run", str(deck), "--output", "remarked", "--set",
                     "Reduction/Basis=Enhanced Craig-Bampton", *short)
    warned = json.loads(pathlib.Path("remarked",
                                     "summary.json").read_text(encoding="utf-8"))["warnings"]
    expect("remarks of the coupling are warnings",
           any("coupled matrices are full" in line for line in warned), full.stderr[-300:])
    loose = tooljoint("run", str(deck), "--output", "loose", "--set",
                      "Parts/Initial State=Equilibrium", "--set",
                      "Parts/Imported/left column/Fixed={}", "--set",
                      "Parts/Imported/right column/Fixed={}", *short)
    left = json.loads(pathlib.Path("loose", "summary.json").read_text(
        encoding="utf-8")) if pathlib.Path("loose", "summary.json").exists() else {}
    expect("parts that nothing holds end with 3 and a summary", loose.returncode == 3
           and left.get("status") == "failed", f"{loose.returncode} {loose.stderr[-300:]} {left}")


def refused():
    """A study of parts without a Study list is refused with a message;
    tests/study/check_frame_study.py has one that runs."""
    done = tooljoint("study", str(ROOT / "xml" / "frame.xml"))
    expect("a study of parts needs a Study list", done.returncode == 2
           and "has no Study list" in done.stderr)
    done = tooljoint("check", bars("kept"), "--set", "Parts/Imported/a/Retained={left}")
    expect(
        "a set that is retained and fixed is refused", done.returncode == 2
        and 'a/Retained names "left", whose dofs are all in Fixed' in " ".join(done.stderr.split()),
        done.stderr[-300:])


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
    massless_directions()
    floating_beams()
    creeping_dofs()
    unstable_equilibria()
    turned_out_of_the_plane()
    motion_tolerance_of_fast_parts()
    relaxed_laws_at_rest()
    starts_that_coordinates_lose()
    responses_beyond_the_linear_range()
    sys.exit(finish())
