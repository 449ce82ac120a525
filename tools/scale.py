#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures long strings, large parts and studies of many rows, and writes docs/scale.md with its
figures.

    tools/scale.py --program build/release/tooljoint [--work results/scale] [--mpiexec mpiexec]
        [--most DOFS] [--only CHAPTER ...] [--short]

Every row is a separate run with its wall and CPU time and the peak memory of its largest process.
Rows that are already in the work folder are not run again. Without --only all chapters are
measured; this needs a machine with two cores and no other load. With --only the named chapters are
renewed. The figures show the tables of the document (tools/scale_figures.py). --short takes the
smallest case of each and prints the chapters, with their figures in the work folder.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
from xml.etree import ElementTree

import scale_figures
from same_results import datasets, difference
from scale_blocks import cuts, solids
from scale_runs import (FULL, PROJECT, chapter, machine_line, measured, seconds, table, times)

os.environ.setdefault("TOOLJOINT_REPORT", "off")
os.environ.setdefault("OMPI_MCA_rmaps_base_oversubscribe", "1")
DOCUMENT = scale_figures.DOCS / "scale.md"
STATIC_ONLY = ["--without", "Transient", "--without", "Reduction", "--without", "Substructures"]
MOTIONS = [("vertical_5000m", FULL, 0.5), ("vertical_5000m", [], 1),
           ("extended_reach_5000m", FULL, 0.5), ("extended_reach_5000m", [], 0.5),
           ("vertical_10000m", FULL, 0.3), ("inclined_1000m", FULL, 1), ("stress_170m", FULL, 2)]
COUNTED = 0.02
COUNTED_RANKS = 1, 2, 3, 4, 8, 16
MESSAGE = 2e-6  # time to send a few numbers between two ranks of one machine [s]
REDUCED_DECK = PROJECT / "xml/vertical_5000m.xml"
REDUCED_ERROR = 0.02  # largest vibration error allowed
# lists of the study; their real time factor is also measured on two ranks
REDUCED_METHODS = "cut-off", "long parts"
STATICS = ("stress_170m", "inclined_1000m", "vertical_5000m", "extended_reach_5000m",
           "vertical_10000m")
# stages of --verbose: the equilibrium, and the other stages of a static state
EQUILIBRIUM = "static equilibrium"
BESIDE = ("path of the string", "equations of the string", "stability of the static state",
          "Krylov-Schur iteration", "inertia counts", "factorisation for modes")
PLANNED = 100, 300, 1000  # numbers of rows
STUDY = PROJECT / "tests/study/study.xml"
HEAD = """# Scale

What the program takes for long strings, large parts and many rows. Written by

    tools/scale.py --program build/release/tooljoint

Times are of one run each, where nothing else is said; ratios within a table are what lasts. Memory
is the peak of the largest process.
"""


def study_table(name, options):
    """(run, status, vibration error, steps) of the rows of a study, sorted by name."""
    path = pathlib.Path(options.work) / name / "out/study.csv"
    with open(path, encoding="utf-8", newline="") as file:
        found = [{key.split(" [")[0]: value for key, value in row.items()}
                 for row in csv.DictReader(file)]
    return sorted(
        (row["method"], row["status"], row["vibration_error"], row["steps"]) for row in found)


def rows(options):
    """The study of the tests with many steps, on one rank and on two with the rows divided among
    the ranks. The tables must be equal except for times."""
    end, repeats = (0.4, 1) if options.short else (15, 2)
    steps = ", ".join(f"{0.2 + 0.01 * i:.2f} ms"
                      for i in range(1 if options.short else 58)) + ", 1 ms"
    common = [
        "study",
        str(STUDY), "--output", "out", "--set", f"Study/End Time={end}", "--set",
        f"Study/Repeats={repeats}", "--set",
        f"Study/Methods/Generalized-alpha, full/Sweep/step/Values={{{steps}}}"
    ]
    one = measured(options, "rows_1", common)
    two = measured(options, "rows_2", [*common, "--ranks-per-row", "1", "--timing", "shared"],
                   ranks=2)
    for name, row in (("one rank", one), ("two ranks", two)):
        if row["code"] != 0:
            raise SystemExit(f"the study on {name}: exit {row['code']}\n{row['output'][-2000:]}")
    tables = [study_table(name, options) for name in ("rows_1", "rows_2")]
    if tables[0] != tables[1]:
        raise SystemExit(
            f"the tables differ: {[pair for pair in zip(*tables) if pair[0] != pair[1]][:3]}")
    lines = [(ranks, len(tables[0]), *times(row)) for ranks, row in ((1, one), (2, two))]
    return chapter(
        options, "Rows over ranks", f"The study of `tests/study` with more steps over {end} s, "
        f"each timed {('once', 'twice')[repeats - 1]}, `--ranks-per-row 1` on two\n"
        f"ranks: {one['wall_s'] / two['wall_s']:.2f} times the rows per hour of one, and the same "
        "table.\n\n" + table(("ranks", "rows", "wall [s]", "CPU [s]", "memory [MB]"), lines),
        "scale_rows")


def plans(options):
    """Plans of many rows and their tables. The rows come from one run of the study, because a plan
    skips rows that are already in its folder."""
    lines = []
    for count in (20,) if options.short else PLANNED:
        steps = ", ".join(f"{0.5 + 0.0004 * i:.4f} ms" for i in range(count - 9))
        words = [
            "--set", "Study/Repeats=1", "--set", "Study/End Time=0.02", "--set",
            "Study/Window=0.02", "--set",
            f"Study/Methods/Generalized-alpha, full/Sweep/step/Values={{{steps}, 1 ms}}"
        ]
        folder = str((pathlib.Path(options.work) / f"plan_{count}").resolve())
        found = [
            measured(options, f"{step.strip('-')}_{count}",
                     ["study", str(STUDY), step, folder, *words])
            for step in ("--output", "--plan", "--collect")
        ]
        failed = [row["output"][-1000:] for row in found if row["code"] != 0]
        if failed:
            raise SystemExit(f"a plan of {count} rows: {failed[0]}")
        lines.append(
            (count, *(seconds(row[key]) for row in found[1:] for key in ("wall_s", "cpu_s")),
             f"{found[2]['memory_mb']:.0f}"))
    return chapter(
        options, "Plans of many rows", "`study --plan` writes a command for each row, `study "
        "--collect` the table of the rows that are there:\nthose of the study of `tests/study` "
        "with more steps over 0.02 s.\n\n" + table(
            ("rows", "plan: wall [s]", "plan: CPU [s]", "collect: wall [s]", "collect: CPU [s]",
             "memory [MB]"), lines))


def static(options, deck, ranks, repeat):
    """(time of the equilibrium [s], time of path, equations, equilibrium and stability check [s],
    static datasets, dofs, iterations, memory) of a run."""
    name = f"divided_{deck}_{ranks}_{repeat}"
    row = measured(options, name, [
        "run",
        str(PROJECT / f"xml/{deck}.xml"), *STATIC_ONLY, "--output", "out", "--set",
        "Output/XDMF=false", "--verbose"
    ], ranks)
    if row["code"] != 0:
        raise SystemExit(f"{name}: exit {row['code']}\n{row['output'][-2000:]}")
    text = " ".join(row["output"].split())
    times = {
        stage: float(found.group(1)) if (found := re.search(rf"{stage} ([0-9.]+) s", text)) else 0.0
        for stage in (EQUILIBRIUM, *BESIDE)
    }
    values = {
        key: value
        for key, value in datasets(pathlib.Path(options.work) / name / "out/results.h5").items()
        if key.startswith("static")
    }
    iterations = json.loads((pathlib.Path(options.work) / name / "out/summary.json").read_text(
        encoding="utf-8"))["static"]["iterations"]
    return times[EQUILIBRIUM], sum(times.values()), values, re.search(
        r"(\d+) free dofs", text).group(1), iterations, row["memory_mb"]


def statics(options):
    """One rank and two in alternation, the best of several runs."""
    lines = []
    for deck in STATICS[:1] if options.short else STATICS:
        runs = [[static(options, deck, ranks, repeat) for ranks in (1, 2)]
                for repeat in range(1 if options.short else 3)]
        one, two = ([min(each[i][part] for each in runs) for part in (0, 1)] for i in (0, 1))
        apart = max(
            difference(value, runs[0][1][2][key]) for key, value in runs[0][0][2].items()
            if value.dtype.kind == "f")
        ratios = [f"{a / b:.2f}" if b > 0 else "" for a, b in zip(one, two)]
        lines.append(
            (deck, *runs[0][0][3:5], f"{one[0]:.2f}", f"{two[0]:.2f}", ratios[0], f"{one[1]:.2f}",
             f"{two[1]:.2f}", ratios[1], f"{apart:.1e}", *(f"{runs[0][i][5]:.0f}" for i in (0, 1))))
    return chapter(
        options, "Static states of strings", "Wall time of the equilibrium alone, and of the "
        "whole: path, equations, equilibrium and check of\nstability; the best of three runs in "
        "turns. The largest difference is that of a recorded value, relative\n"
        "to the largest of its kind. Short strings are not divided.\n\n" + table(
            ("scene", "dofs", "iterations", "equilibrium: 1 rank [s]", "2 ranks [s]",
             "times as fast", "whole: 1 rank [s]", "2 ranks [s]", "times as fast",
             "largest difference", "memory: 1 rank [MB]", "2 ranks [MB]"), lines), "scale_strings")


def motion(options, deck, words, end, ranks, repeat):
    """(transient of summary.json, datasets of the motion, peak memory [MB]) of a run whose motion
    is divided among the ranks."""
    name = f"motion_{deck}_{'full' if words else 'reduced'}_{ranks}_{repeat}"
    division = ["--set", f"Transient/Ranks={'Divide' if ranks > 1 else 'Alike'}"]
    row = measured(options, name, [
        "run",
        str(PROJECT / f"xml/{deck}.xml"), *words, *division, "--output", "out", "--set",
        f"Transient/End Time={end}", "--set", "Output/XDMF=false"
    ], ranks)
    if row["code"] != 0:
        raise SystemExit(f"{name}: exit {row['code']}\n{row['output'][-2000:]}")
    folder = pathlib.Path(options.work) / name / "out"
    values = {
        key: value for key, value in datasets(folder / "results.h5").items()
        if key.startswith("transient")
    }
    return json.loads((folder / "summary.json").read_text(
        encoding="utf-8"))["transient"], values, row["memory_mb"]


def walls(options):
    """One rank and two in alternation, the best of several runs."""
    lines = []
    for deck, words, end in [(*MOTIONS[-1][:2], COUNTED)] if options.short else MOTIONS:
        repeats = range(1 if options.short else 3)
        runs = [[motion(options, deck, words, end, ranks, repeat) for ranks in (1, 2)]
                for repeat in repeats]
        one, two = (min(each[i][0]["wall_s"] for each in runs) for i in (0, 1))
        apart = max(
            difference(value, runs[0][1][1][key]) for key, value in runs[0][0][1].items()
            if value.dtype.kind == "f")
        steps = runs[0][0][0]["steps"]
        lines.append((deck, "full" if words else "reduced", steps, f"{1e6 * one / steps:.0f}",
                      f"{1e6 * two / steps:.0f}", f"{one / two:.2f}", f"{apart:.1e}"))
    return table(("scene", "model", "steps", "1 rank [us per step]", "2 ranks [us per step]",
                  "times as fast", "largest difference"), lines)


def counts(options):
    """Work and messages of each rank; ranks may share cores. The messages of a step are those of
    two ranks, for which the steps are the same."""
    deck, words, end = (*MOTIONS[-1][:2], COUNTED) if options.short else MOTIONS[0]
    alone, two = (motion(options, deck, words, end, ranks, 0)[0] for ranks in (1, 2))
    step, messages, dofs = alone["wall_s"] / alone["steps"], two["messages"] / two[
        "steps"], 2 * two["dofs_of_rank"] - 6
    lines = []
    for ranks in (2,) if options.short else COUNTED_RANKS:
        found, _, memory = motion(options, deck, words, COUNTED, ranks, "counted")
        own, sent = (dofs, 0) if ranks == 1 else (found["dofs_of_rank"], messages)
        efficiency = step / ranks / (own / dofs * step + sent * MESSAGE * math.log2(ranks))
        lines.append((ranks, own, f"{sent:.1f}", f"{100 * efficiency:.0f} %", f"{memory:.0f}"))
    return table(("ranks", "dofs of a rank", "messages per step", "predicted efficiency",
                  "memory of a rank [MB]"), lines)


def motions(options):
    return chapter(
        options, "Motions divided among ranks", "The motion alone, wall time of the best of three "
        "runs in turns; `Transient/Ranks` = `Divide`. The\nlast column is the largest difference "
        "of a recorded value, relative to the largest of its kind;\ncontact amplifies rounding, so "
        "that it grows with time. The target `ranks` bounds it over 0.2 s.\n\n" + walls(options) +
        f"\nWork and messages of {MOTIONS[0][0]}, full model, counted "
        f"over {COUNTED} s. The efficiency is predicted\nfrom them, for a step of one rank as "
        f"measured here and {1e6 * MESSAGE:.0f} us log2(ranks) for a message, with a core\n"
        "for each rank.\n\n" + counts(options), "scale_ranks")


def study_of(options, name, words, ranks):
    """The completed rows of methods of a study of the deck."""
    row = measured(
        options, name,
        ["study", str(STUDY if options.short else REDUCED_DECK), "--output", "out", *words], ranks)
    if row["code"] != 0:
        raise SystemExit(f"{name}: exit {row['code']}\n{row['output'][-2000:]}")
    with open(pathlib.Path(options.work) / name / "out/study.csv", encoding="utf-8") as text:
        return [
            each for each in csv.DictReader(text)
            if each["kind"] == "method" and each["status"] == "done"
        ]


def reduced(options):
    """The study of the deck, and its rows of REDUCED_METHODS on one rank and two."""
    runs = study_of(options, "study_reduced", [], 1)
    right = [each for each in runs if float(each["vibration_error"]) <= REDUCED_ERROR]
    best = {
        model: min((each for each in right if each["model"] == model),
                   key=lambda each: float(each["cpu [s]"])) for model in ("full", "reduced")
    }
    lines = [(model, each["label"], each["reduced_dofs"], f"{float(each['cpu [s]']):.3f}",
              f"{100 * float(each['vibration_error']):.2f} %") for model, each in best.items()]
    ratio = float(best["full"]["cpu [s]"]) / float(best["reduced"]["cpu [s]"])
    methods = ElementTree.parse(STUDY if options.short else REDUCED_DECK).getroot().findall(
        "ParameterList[@name='Study']/ParameterList[@name='Methods']/ParameterList")
    kept = ("Craig-Bampton",) if options.short else REDUCED_METHODS
    others = [
        word for each in methods if each.get("name") not in kept
        for word in ("--without", f"Study/Methods/{each.get('name')}")
    ]
    two = study_of(options, "study_reduced_2", [
        "--set", f"Transient/Ranks={'Alike' if options.short else 'Divide'}", "--without",
        "Study/Baseline", *others
    ], 2)
    factors = [(each["label"], ranks, f"{float(each['real_time_factor']):.1f}",
                f"{100 * float(each['vibration_error']):.2f} %")
               for ranks, found in ((1, runs), (2, two)) for each in found
               if each["method"] in {row["method"] for row in two}]
    return chapter(
        options, "Full against reduced, 5 km hanging", f"The study of `xml/{REDUCED_DECK.name}`: "
        f"of the runs with a vibration error of at most {100 * REDUCED_ERROR:.0f} %, those with\n"
        f"the least CPU time of the motion on one rank. The reduced model is {ratio:.1f} times as "
        "fast.\n\n" + table(
            ("model", "run", "dofs", "CPU of the motion [s]", "vibration error"), lines) +
        "\nThe motion alone, without records and figures:\n\n" + table(
            ("run", "ranks", "simulated seconds per second", "vibration error"), factors))


CHAPTERS = {
    "solids": solids, "cut": cuts, "statics": statics, "motions": motions, "reduced": reduced,
    "rows": rows, "plans": plans
}


def renewed(text, own):
    """The document with this chapter in place of the old one, or at the end."""
    head = own.splitlines()[0]
    chapters = [each.rstrip() for each in re.split(r"\n(?=## )", text.rstrip())]
    place = next((i for i, each in enumerate(chapters) if each.splitlines()[0] == head),
                 len(chapters))
    chapters[place:place + 1] = [own.rstrip()]
    return "\n\n".join(chapters) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True)
    parser.add_argument("--work", default="results/scale")
    parser.add_argument("--mpiexec", default="mpiexec")
    parser.add_argument("--most", type=int, default=600000, help="dofs of the largest block")
    parser.add_argument("--only", nargs="+", choices=CHAPTERS, default=list(CHAPTERS),
                        metavar="CHAPTER", help=f"chapters to renew: {', '.join(CHAPTERS)}")
    parser.add_argument(
        "--short", action="store_true",
        help="take the smallest of each; print the chapters, do not change the document")
    options = parser.parse_args()
    options.program = str(pathlib.Path(options.program).resolve())
    options.machine = machine_line(options)
    if options.short:  # measure again
        options.work = str(pathlib.Path(options.work) / "short")
        shutil.rmtree(options.work, ignore_errors=True)
    everything = options.only == list(CHAPTERS)
    text = HEAD if everything or options.short else DOCUMENT.read_text(encoding="utf-8")
    for name in options.only:
        text = renewed(text, CHAPTERS[name](options))
    if options.short:
        print(text)
        scale_figures.draw(text, pathlib.Path(options.work))
    else:
        DOCUMENT.write_text(text, encoding="utf-8")
        subprocess.run(
            [sys.executable,
             str(PROJECT / "tests/lint/wrap.py"), "--update",
             str(DOCUMENT)], check=True)
        scale_figures.draw(text, scale_figures.DOCS / "figures")
    return 0


if __name__ == "__main__":
    sys.exit(main())
