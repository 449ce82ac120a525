#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures whether R and D, the two signs by which a run tells that its fixed steps lose the motion, say so where they do, and
rewrites the table of docs/theory.md.

    tools/step_accuracy.py --program build/release/tooljoint [--work results/step_accuracy]

Each run of 2 s stands beside one of the same model with steps of 0.125 ms and a tolerance of 1e-8; the vibration error is what `tooljoint
compare` prints. Runs that are already in the work folder are not repeated; all of them take some
ten minutes.
"""
import argparse
import json
import math
import pathlib
import re
import subprocess

PROJECT = pathlib.Path(__file__).resolve().parent.parent
DOCUMENT = PROJECT / "docs/theory.md"
MODELS = {"full": ["--without", "Reduction", "--without", "Substructures"], "reduced": []}
TOLERANCES = ("1e-4", "1e-5", "1e-6", "1e-7")
REFERENCE = ("1.25e-4", "1e-8")
BANDS = ((0.0, 0.01), (0.01, 0.025), (0.025, 0.1), (0.1, math.inf))
SIGN = re.compile(r"The time step \(\S+ s\) is (coarse|too large)")


class Case:
    """A deck, what is set in it, and the steps it is run with."""

    def __init__(self, name, deck, settings, steps):
        self.name, self.deck, self.settings, self.steps = name, deck, settings, steps


SCENES = [Case(deck, deck, {}, ("1e-3", "2.5e-3", "5e-3", "1e-2")) for deck in ("helical_170m", "stress_170m", "vertical_1000m", "inclined_1000m")]
STICKING = [Case(f"{deck}_sticking_{rpm}_rpm", deck,
                 {"Contact/Friction/Regularisation Velocity": "1e-4", "Rotary Speed/Exponential/Final Speed": f"{rpm} rpm"}, ("1e-3",))
            for deck in ("helical_170m", "stress_170m") for rpm in ("0.5", "1")]


class Run:
    def __init__(self, options, case, model, step, tolerance):
        self.name = f"{case.name}_{model}_{step}_{tolerance}"
        self.folder = pathlib.Path(options.work) / self.name
        log = self.folder.parent / (self.name + ".log")
        if not log.exists():
            settings = {"Transient/End Time": 2, "Transient/Step": step, "Transient/Sampling Interval": 0.01, "Transient/Generalized-alpha/Tolerance": tolerance,
                        "Transient/Generalized-alpha/Accept Coarse Steps": "true", "Output/XDMF": "false", **case.settings}
            print(self.name, flush=True)
            done = subprocess.run([options.program, "run", str(PROJECT / f"xml/{case.deck}.xml"), "--output", str(self.folder), *MODELS[model],
                                   *[f"--set={key}={value}" for key, value in settings.items()]],
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
            self.folder.parent.mkdir(parents=True, exist_ok=True)
            log.write_text(done.stdout)
        summary = self.folder / "summary.json"
        self.finished = summary.exists() and json.loads(summary.read_text())["status"] == "finished"
        sign = SIGN.search(log.read_text())
        self.verdict = {"coarse": "warned", "too large": "refused"}[sign.group(1)] if sign else "silent"
        if self.finished:
            transient = json.loads(summary.read_text())["transient"]
            self.local, self.halving = transient["local_error"] or 0.0, transient["halving_error"] or 0.0

    def vibration_error(self, options, reference):
        done = subprocess.run([options.program, "compare", str(self.folder), str(reference.folder), "--to", "2", "--json"],
                              stdout=subprocess.PIPE, text=True, check=True)
        return json.loads(done.stdout)["vibration_error"]


def measured(options, cases):
    """(vibration error, run) of all runs that finished, and those that did not."""
    rows, ended = [], []
    for case in cases:
        for model in MODELS:
            reference = Run(options, case, model, *REFERENCE)
            for step in case.steps:
                for tolerance in TOLERANCES:
                    run = Run(options, case, model, step, tolerance)
                    if run.finished:
                        rows.append((run.vibration_error(options, reference), run))
                        print(f"{run.name}: vibration error {100 * rows[-1][0]:.3g} %, R {100 * run.local:.3g} %, D {100 * run.halving:.3g} %, {run.verdict}")
                    else:
                        ended.append(run)
                        print(f"{run.name}: ended before its time")
    return rows, ended


def span(values):
    low, high = (f"{100 * x:.2g}" if x < 0.995 else f"{100 * x:.0f}" for x in (min(values), max(values)))
    return f"{low} to {high} %"


def line(title, rows):
    verdicts = [run.verdict for _, run in rows]
    counts = ", ".join(f"{verdicts.count(v)} {v}" for v in ("silent", "warned", "refused") if v in verdicts)
    return (f"| {title} | {len(rows)} | {span([vibration_error for vibration_error, _ in rows])} | {span([run.local for _, run in rows])} | {span([run.halving for _, run in rows])} | "
            f"{counts} |")


def table(options):
    lines = ["| | runs | vibration error | R | D | |", "|---|---|---|---|---|---|"]
    rows, ended = measured(options, SCENES)
    for low, high in BANDS:
        band = [(vibration_error, run) for vibration_error, run in rows if low <= vibration_error < high]
        if band:
            lines.append(line("scenes", band))
    rows, more = measured(options, STICKING)
    if rows:
        lines.append(line("sticking: v_r = 1e-4 m/s, 0.5 and 1 rpm, 1 ms", rows))
    if ended + more:
        lines.append(f"| | {len(ended + more)} | | | | ended before 2 s, with a reason |")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True)
    parser.add_argument("--work", default="results/step_accuracy")
    options = parser.parse_args()
    text = table(options)
    print(text)
    document = DOCUMENT.read_text()
    begin, end = "<!-- table of R and D -->\n", "<!-- end of the table of R and D -->"
    DOCUMENT.write_text(document[:document.index(begin) + len(begin)] + text + document[document.index(end):])


if __name__ == "__main__":
    main()
