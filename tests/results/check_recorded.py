#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Recording of chosen depths and nodes, and compression: check_recorded.py PROGRAM MPIEXEC

Records of chosen nodes are bitwise equal to those of a run that records all nodes, on one rank, on
two and after a restart. Reports, comparisons and pictures use them or state why not. A depth or
name without a node is refused. Compression does not change numbers.
"""
import pathlib
import shutil
import subprocess
import sys

import h5py
import numpy as np

import documented

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from checks import expect, finish, tooljoint  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
STRING, FRAME = str(ROOT / "tests/effects/scene.xml"), str(ROOT / "xml/frame.xml")
PLOT = str(ROOT / "tools/plot_results.py")
FIELDS = ("displacement", "velocity", "acceleration", "normal_force")
SHORT = ("--set", "Transient/End Time=0.2", "--set",
         "Output/Fields={displacement, velocity, acceleration, normal_force}")


def run(folder, deck, *arguments, ranks=1):
    shutil.rmtree(folder, ignore_errors=True)
    done = tooljoint("run", deck, "--output", folder, *SHORT, *arguments, ranks=ranks)
    expect(f"{folder}: the run ends with 0", done.returncode == 0, done.stderr[-300:])
    return folder


def same(title, whole, chosen, wanted, heading, components):
    """The motion of the chosen nodes equals that of the full record; all other data are equal."""
    with h5py.File(f"{whole}/results.h5") as one, h5py.File(f"{chosen}/results.h5") as other:
        rows = other["/transient/node"][:] - 1
        expect(f"{title}: the nodes are those that were asked for",
               list(rows) == wanted, list(rows))
        fields = [name for name in FIELDS if f"/transient/{name}" in one]
        alike = all(
            np.array_equal(one[f"/transient/{name}"][:][:, rows], other[f"/transient/{name}"][:])
            for name in fields)
        expect(f"{title}: their motion is that of a run that records all", alike
               and len(fields) >= 3, fields)
        expect(
            f"{title}: so are state at rest and rows of motion.csv",
            all(
                np.array_equal(one[name][:], other[name][:])
                for name in ("/static/displacement", "/transient/motion")))
        nodes = one["/static/displacement"].shape[0]
        sizes = {
            "n": nodes, "r": len(rows), "e": nodes - 1, "m": len(other["/transient/time"]),
            "c": components
        }
        wrong, met = documented.faults(other, documented.rows(heading), sizes)
        expect(f"{title}: datasets have the units and shapes of docs/file-formats.md", not wrong
               and "/transient/node" in met, "; ".join(wrong))
    expect(f"{title}: summary figures are the same", figures(whole) == figures(chosen))


def figures(folder):
    """summary.json without times and memory."""
    lines = pathlib.Path(folder, "summary.json").read_text(encoding="utf-8").splitlines()
    return [
        line for line in lines if not any(word in line
                                          for word in ("_s\"", "memory", "real_time", "files",
                                                       ".csv", "results", "sha256"))
    ]


def report(title, folder, wanted, absent):
    done = tooljoint("report", folder)
    text = pathlib.Path(folder, "report.html").read_text(
        encoding="utf-8") if done.returncode == 0 else ""
    expect(
        f"{title}: the report has figures of the recorded nodes and says that the view rests",
        all(f'id="{name}"' in text for name in wanted)
        and not any(f'id="{name}"' in text for name in absent)
        and "chosen nodes is recorded" in text, done.stderr
        or [name for name in wanted if f'id="{name}"' not in text])


def strings():
    whole = run("all", STRING)
    with h5py.File("all/results.h5") as file:
        s = file["/model/s"][:]
        touches = int(np.argmax(file["/transient/normal_force"][:].max(axis=0)))
        depths = [float(s[touches]), float(s[7]) + 0.3 * float(s[8] - s[7]), float(s[-1])]
    chosen = ("--set", f"Output/Depths={{{', '.join(map(str, depths))}}}")
    wanted = sorted({touches, 7, len(s) - 1})
    same("string", whole, run("some", STRING, *chosen), wanted, "## results.h5", 6)
    same("string, two ranks", run("all_two", STRING, ranks=2),
         run("some_two", STRING, *chosen, ranks=2), wanted, "## results.h5", 6)
    report("string", "some", ("rms", "duty", "bit-speed", "orbit-1"), ("contact",))
    said = tooljoint("compare", "some", "all")
    expect("a run of chosen nodes is compared at those", said.returncode == 0
           and said.stdout.count("0.0000e+00") >= 3, said.stdout + said.stderr)
    run("other", STRING, "--set", f"Output/Depths={{{float(s[4])}}}")
    said = tooljoint("compare", "some", "other")
    expect("runs of different nodes are not", said.returncode == 1
           and "recorded the motion of different nodes" in said.stderr, said.stderr)
    said = tooljoint("paraview", "some")
    expect("ParaView needs all nodes", said.returncode == 5 and "chosen nodes" in said.stderr,
           said.stderr)
    drawn = subprocess.run([sys.executable, PLOT, "some"], capture_output=True, text=True,
                           check=False)
    expect("a picture is drawn", drawn.returncode == 0
           and pathlib.Path("some/results.png").stat().st_size > 20_000, drawn.stderr[-300:])
    for setting, sentence in (
        ("Depths={1e6}", "but the string ends at"),
        ("Depths={-1}", "out of range"),
        ("Nodes={pipe:1}", "Those of a string are chosen by Output/Depths"),
    ):
        said = tooljoint("check", STRING, "--set", f"Output/{setting}")
        expect(f"Output/{setting} is refused", said.returncode == 2 and sentence in said.stderr,
               said.stderr)
    said = tooljoint("check", STRING, *chosen)
    every = tooljoint("check", STRING)
    megabytes = [
        int(text.split("about ")[-1].split(" MB")[0]) for text in (every.stdout, said.stdout)
    ]
    expect("check counts the recorded nodes", megabytes[1] < megabytes[0] or megabytes == [1, 1],
           megabytes)


def parts():
    whole = run("frame_all", FRAME)
    chosen = ("--set", "Output/Nodes={arm:4, top beam:5}")
    with h5py.File("frame_all/results.h5") as file:
        names = [name.decode() for name in file["/model/part_names"][:]]
        at = {(names[part - 1], node): row
              for row, (part,
                        node) in enumerate(zip(file["/model/part"][:], file["/model/node"][:]))}
        components = len(file["/model/components"])
    same("parts", whole, run("frame_some", FRAME, *chosen), sorted(
        (at["arm", 4], at["top beam", 5])), "**Results of a scene of parts.**", components)
    report("parts", "frame_some", ("nodes-1", "mover-1", "spectrum-m"), ())
    drawn = subprocess.run([sys.executable, PLOT, "frame_some"], capture_output=True, text=True,
                           check=False)
    expect("a picture of parts is drawn", drawn.returncode == 0, drawn.stderr[-300:])
    for setting, sentence in (
        ("Nodes={arn:1}", 'Did you mean the part "arm"?'),
        ("Nodes={arm:99}", "a node its part does not have"),
        ("Depths={1}", "Nodes of parts are chosen by Output/Nodes"),
    ):
        said = tooljoint("check", FRAME, "--set", f"Output/{setting}")
        expect(f"parts: Output/{setting} is refused", said.returncode == 2
               and sentence in said.stderr, said.stderr)


def compression():
    """Compression is on by default; without it the numbers are the same."""
    plain = run("plain", STRING, "--set", "Output/Compression=0")
    with h5py.File("all/results.h5") as packed, h5py.File(f"{plain}/results.h5") as other:
        expect(
            "compression changes no number",
            all(
                np.array_equal(packed[f"/transient/{name}"][:], other[f"/transient/{name}"][:])
                for name in FIELDS))
        stored = [file["/transient/displacement"].id.get_storage_size() for file in (packed, other)]
        filters = packed["/transient/displacement"]
        expect(
            "and makes series smaller", filters.compression == "gzip" and filters.shuffle
            and other["/transient/displacement"].compression is None
            and stored[0] < 0.95 * stored[1], stored)


def main():
    for check in (strings, parts, compression):
        check()
    return finish()


if __name__ == "__main__":
    sys.exit(main())
