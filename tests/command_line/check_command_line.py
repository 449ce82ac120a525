#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the command line.

    check_command_line.py PROGRAM MPIEXEC DECK PARTS_DECK PLOTTER

Help of every command, unknown commands, the output of `compare` for two runs of DECK, and the
pictures that PLOTTER draws of runs of a string and of PARTS_DECK.
"""
import argparse
import csv
import json
import pathlib
import re
import shutil
import subprocess
import sys

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
import same_results  # noqa: E402
from checks import COLUMNS, expect, finish, tooljoint, wide  # noqa: E402

PROGRAM, MPIEXEC, DECK, PARTS_DECK, PLOTTER = sys.argv[1:6]
HEADINGS = {
    "To begin:": ("doc", "new", "template"),
    "Runs:": ("check", "map", "run", "study"),
    "Analyses:": ("bha", "buckling", "campbell", "modes", "response", "torque-drag"),
    "Results and parts:": ("compare", "export", "paraview", "report"),
}
COMMANDS = [command for commands in HEADINGS.values() for command in commands]
FULL = ["--without", "Reduction", "--without", "Substructures"]


def narrow(what, done):
    """Checks the width of warnings and errors; tooljoint() of checks.py does so in all tests."""
    expect(f"{what}: no printed line has more than {COLUMNS} columns", done.stdout
           and not wide(done.stdout), "\n".join(wide(done.stdout)))


def help_is_our_own():
    for arguments in ([], *([command] for command in COMMANDS)):
        for ranks in (1, 2) if arguments in ([], ["run"]) else (1,):
            for flag in ("--help", "-h") if arguments in ([], ["run"]) else ("--help",):
                done = tooljoint(*arguments, flag, ranks=ranks)
                name = " ".join(["tooljoint", *arguments, flag])
                expect(f"{name}, {ranks} rank(s): exit code 0, nothing on stderr",
                       done.returncode == 0 and done.stderr == "",
                       f"({done.returncode}) {done.stderr}")
                expect(
                    f"{name}, {ranks} rank(s): says once how the command is used",
                    done.stdout.count("Usage: ") == 1
                    and "Usage: " + " ".join(["tooljoint", *arguments]) in done.stdout, done.stdout)
                expect(f"{name}, {ranks} rank(s): nothing of Kokkos", "kokkos"
                       not in (done.stdout + done.stderr).lower(), done.stdout[:300])
        narrow(" ".join(["tooljoint", *arguments, "--help"]), done)
    whole = tooljoint("--help").stdout
    found = re.findall(r"^(?:  ([a-z][a-z-]*) |(\S.*:)$)", whole, re.M)
    wanted = [
        "Options:",
        *(word for heading, commands in HEADINGS.items() for word in (heading, *commands))
    ]
    expect("the program's help names every command below its heading",
           [command or heading for command, heading in found] == wanted, whole)


def unknown_words():
    for arguments, sentence in (
        (["modse"], 'Unknown command "modse". Did you mean "modes"? Available: "doc", "new", '),
        (["modse", "--help"], 'Did you mean "modes"?'),
        (["--help", "modse"], 'Did you mean "modes"?'),
        (["nonsense", "-h"], 'Unknown command "nonsense". Available: "doc", "new", '),
        (["run", "--nonsense", "--help"], "Unknown argument: --nonsense"),
        (["run", "deck.xml", "--sett", "A=1"], "Did you mean --set?"),
        (["--kokkos-help"], "Unknown argument: --kokkos-help"),
        (["template", "nonsense"], 'There is no template "nonsense"'),
    ):
        done = tooljoint(*arguments)
        expect(f"{' '.join(arguments)}: exit code 1, and what is wrong", done.returncode == 1
               and done.stdout == "" and done.stderr.count(sentence) == 1,
               f"({done.returncode}) {done.stdout[:200]} {done.stderr}")


def two_runs():
    """Full and reduced motion of the deck for 0.2 s, and the reduced one for half of it."""
    ends = {}
    for folder, arguments in (
        ("full", [*FULL, "--set", "Transient/End Time=0.2"]),
        ("reduced", ["--set", "Transient/End Time=0.2"]),
        ("brief", ["--set", "Transient/End Time=0.1"]),
    ):
        done = tooljoint("run", DECK, "--output", folder, "--set", "Output/XDMF=false", *arguments)
        expect(f"the run {folder} succeeds", done.returncode == 0, done.stderr[-400:])
        narrow(f"the run {folder}", done)
        with open(pathlib.Path(folder, "motion.csv"), newline="", encoding="utf-8") as text:
            ends[folder] = [float(row[0]) for row in list(csv.reader(text))[1:]]
    return ends


def comparisons(times):
    said = tooljoint("compare", "reduced", "full")
    whole = times["full"]
    expect(
        "compare says the window of the samples, and not the one it looked into",
        said.stdout.startswith(f"window {whole[0]:g} to {whole[-1]:g} s ({len(whole)} samples): "),
        said.stdout)
    asked = tooljoint("compare", "reduced", "full", "--json")
    found = json.loads(asked.stdout)
    expect("compare --json prints JSON and nothing else",
           found["window"] == {"begin": whole[0], "end": whole[-1],
                               "samples": len(whole)}, asked.stdout)
    line = (f"eps_t max {found['eps_t']['max']:.4e} mean {found['eps_t']['mean']:.4e}, eps_n max "
            f"{found['eps_n']['max']:.4e}, vibration error {found['vibration_error']:.4e}")
    expect("with the numbers of the line for people", line in " ".join(said.stdout.split())
           and found["vibration_error"] > 0, f"{line}\n{said.stdout}")
    inner = [t for t in whole if 0.05 - 1e-9 <= t <= 0.12 + 1e-9]
    part = json.loads(
        tooljoint("compare", "reduced", "full", "--from", "0.0499", "--to", "0.1201",
                  "--json").stdout)
    expect("a window between samples is that of the samples in it",
           part["window"] == {"begin": inner[0], "end": inner[-1],
                              "samples": len(inner)}, str(part))
    for factor, code in ((0.99, 4), (1.01, 0)):
        limit = repr(factor * found["vibration_error"])
        done = tooljoint("compare", "reduced", "full", "--fail-above", limit,
                         ranks=2 if code else 1)
        expect(f"--fail-above {factor} vibration errors: exit code {code}", done.returncode == code,
               f"({done.returncode}) {done.stderr}")
        expect(f"--fail-above {factor} vibration errors: the errors are printed all the same",
               done.stdout == said.stdout, done.stdout)
        expect(f"--fail-above {factor} vibration errors: the limit is named {code // 4} times",
               done.stderr.count("of --fail-above") == code // 4, done.stderr)
    shutil.copytree("full", "moved", dirs_exist_ok=True)
    with h5py.File("moved/results.h5", "a") as moved:
        place = moved["/model/position"][:]
        place[-2] += [0.05 * np.abs(place - place[0]).max(), 0.0, 0.0]
        moved["/model/position"][...] = place
    same = json.loads(tooljoint("compare", "full", "full", "--fail-above", "0", "--json").stdout)
    expect("a run is its own equal",
           same["vibration_error"] == same["eps_t"]["max"] == same["eps_n"]["max"] == 0.0,
           str(same))
    for arguments, code, sentence in (
        (["reduced", "full", "--fail-above",
          "-1"], 1, '--fail-above: "-1" was given; expected is a number from 0 on.'),
        (["reduced", "full", "--fail-above", "nan"], 1, '--fail-above: "nan" was given'),
        (["reduced", "full", "--from",
          "7"], 1, f"full holds 0 samples (it ends at {whole[-1]:g} s)"),
        (["reduced", "full", "--from", "0.1", "--to",
          "0.05"], 1, "--to 0.05 is before --from 0.1."),
        (["brief", "full"], 1, f"brief holds {len(times['brief'])} samples from 0 to 0.1 s and "
         f"full holds {len(whole)} samples from 0 to 0.2 s"),
        (["reduced", "nowhere"], 5, "nowhere"),
        (["reduced", "parts"], 1, "hold the motion of different scenes"),
        (["reduced", "moved"], 1, "their nodes stand up to 5 % of their extent apart"),
    ):
        done = tooljoint("compare", *arguments)
        expect(f"compare {' '.join(arguments)}: exit code {code}", done.returncode == code
               and done.stderr.count(sentence) == 1, f"({done.returncode}) {done.stderr}")


def white_share(picture):
    """Share of the picture that is white, and its size."""
    import matplotlib.image
    pixels = matplotlib.image.imread(picture)
    return float((pixels[:, :, :3].min(axis=2) > 0.999).mean()), pixels.shape


def pictures():
    """Pictures of moving parts, of parts at rest, of parts with forces between them, and of a
    string."""
    runs = {
        "parts": (PARTS_DECK, ["--set", "Transient/End Time=0.2"]),
        "resting parts": (PARTS_DECK, ["--without", "Transient"]),
        "full": (DECK, None),
    }
    for folder, (deck, arguments) in runs.items():
        if arguments is not None:
            done = tooljoint("run", deck, "--output", folder, *arguments)
            expect(f"the run {folder} succeeds", done.returncode == 0, done.stderr[-400:])
            narrow(f"the run {folder}", done)
        drawn = subprocess.run([PLOTTER, folder], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               text=True, check=False)
        picture = pathlib.Path(folder, "results.png")
        expect(f"{folder}: a picture is drawn", drawn.returncode == 0
               and drawn.stdout == f"drawn {picture}\n" and picture.is_file(), drawn.stdout[-600:])
        if picture.is_file():
            white, shape = white_share(picture)
            expect(f"{folder}: there is something in it", 0.3 < white < 0.97
                   and min(shape[:2]) > 400, f"({white}, {shape})")


def reports():
    """Output of check, modes and export for a string and for parts."""
    for deck in (DECK, PARTS_DECK):
        for command, arguments in (("check", []), ("modes", ["--count", "6"]),
                                   ("export", ["--output", "exported"])):
            done = tooljoint(command, deck, *arguments)
            expect(f"{command} {pathlib.Path(deck).name} succeeds", done.returncode == 0,
                   done.stderr[-400:])
            narrow(f"{command} {pathlib.Path(deck).name}", done)


def versions():
    """The comparison of two programs and its table, for a program with itself: summaries of the
    runs full and brief."""
    options = argparse.Namespace(static=1e-10, motion=1e-9, steps=0.01)
    (_, _, none), _ = same_results.compare(pathlib.Path("full"), pathlib.Path("full"), options, {})
    (ratio, where, size), count = same_results.compare(pathlib.Path("full"), pathlib.Path("brief"),
                                                       options, {})
    expect("results beside themselves are the same, those of another motion are not", none == 0.0
           and ratio > 1.0 and count > 100, (none, ratio, where, count))
    rows = [
        {"scene": "a", "largest_difference": none, "where": "", "agrees": True},
        {"scene": "b", "largest_difference": size, "where": where, "agrees": False},
        {"scene": "c", "exit": [2, 2]},
    ]
    here = same_results.version(PROGRAM)
    page = same_results.written(
        "before\n" + "\nold\n".join(same_results.MARKS) + "\nafter",
        [{"old": here, "new": here, "scenes": rows}, {"old": "x", "new": "y", "scenes": rows[:1]}])
    expect(
        "the table of scenes has a column for each pair of programs",
        page.startswith("before") and page.endswith("after") and "\nold\n" not in page
        and f"| scene | {here} to {here} | x to y |" in page
        and "| a | bitwise the same | bitwise the same |" in page
        and f"({where}), too large |  |" in page and "| c | refused by both |  |" in page, page)


def main():
    for left in ("full", "reduced", "brief", "parts", "resting parts",
                 "exported"):  # of an earlier run of this test
        shutil.rmtree(left, ignore_errors=True)
    help_is_our_own()
    unknown_words()
    times = two_runs()
    pictures()
    reports()
    comparisons(times)
    versions()
    return finish()


if __name__ == "__main__":
    sys.exit(main())
