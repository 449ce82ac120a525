#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures long strings, large parts and many rows, and writes docs/scale.md with its figure.

    tools/scale.py --program build/release/tooljoint [--work results/scale] [--mpiexec mpiexec] [--most DOFS] [--rows] [--short]
    tools/scale.py --program build/release/tooljoint --motions
    tools/scale.py --program build/release/tooljoint --statics
    tools/scale.py --program build/release/tooljoint --reduced
    tools/scale.py --program build/release/tooljoint --cut [--most DOFS] [--short]

Every row is a run of its own, with its wall and CPU time and the peak memory of its largest process. Rows that are
in the work folder already are not run again. --short takes the smallest of each and prints the tables only. --motions
measures motions divided among ranks alone, on a machine of two cores without other work, and renews their chapter;
--statics does the same for static states, --reduced compares full and reduced motions of the same error.
--cut measures blocks cut into substructures against one shift-invert run on the whole, and renews their chapter.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import time
from xml.etree import ElementTree

import plots
from same_results import datasets, difference

PROJECT = pathlib.Path(__file__).resolve().parent.parent
os.environ.setdefault("TOOLJOINT_REPORT", "off")
os.environ.setdefault("OMPI_MCA_rmaps_base_oversubscribe", "1")
DOCUMENT = PROJECT / "docs/scale.md"
FIGURE = PROJECT / "docs/figures/scale_solids.svg"
BLOCK = PROJECT / "examples/12_solid_block"
# Elements along a block of 8:2:1 of equal hexahedra.
BLOCKS = (8, 4, 2), (24, 6, 3), (40, 10, 5), (56, 14, 7), (80, 20, 10), (116, 29, 15)
STRINGS = "build_hold_1400m", "vertical_5000m", "extended_reach_5000m", "vertical_10000m"
STATIC_ONLY = ["--without", "Transient", "--without", "Reduction", "--without", "Substructures"]
MODES, JOINED = 50, 100
FULL = ["--without", "Reduction", "--without", "Substructures"]
MOTIONS = [("vertical_5000m", FULL, 0.5), ("vertical_5000m", [], 1), ("extended_reach_5000m", FULL, 0.5), ("extended_reach_5000m", [], 0.5),
           ("vertical_10000m", FULL, 0.3), ("inclined_1000m", FULL, 1), ("stress_170m", FULL, 2)]
COUNTED = 0.02
MESSAGE = 2e-6  # of a few numbers between two ranks of one machine [s]
CUT_PARTS, CUT_BLOCKS = 16, ((24, 6, 3), (56, 14, 7), (100, 25, 12), (170, 43, 21))
CUT_RANKS = 1, 2  # the largest block on two alone
CUT_WHOLE = 200000  # dofs of the largest block that is solved as a whole, too
CUT_CHAPTER = "## Large parts cut into substructures"
CHAPTER = "## Motions divided among ranks"
STATICS_CHAPTER = "## Static states divided among ranks"
REDUCED_CHAPTER = "## Full against reduced, 5 km hanging"
ROWS_CHAPTER = "## Rows over ranks"
REDUCED_DECK = "vertical_5000m"
REDUCED_ERROR = 0.02  # vibration error that is asked for
REDUCED_METHODS = "cut-off", "long parts"  # lists of the study, whose real time factor is measured on two ranks too
STATICS = "stress_170m", "inclined_1000m", "vertical_5000m", "extended_reach_5000m", "vertical_10000m"
# Stages of --verbose: the equilibrium, and what a static state takes beside it.
EQUILIBRIUM = "static equilibrium"
BESIDE = ("path of the string", "equations of the string", "stability of the static state", "Krylov-Schur iteration",
          "inertia counts", "factorisation for modes")
HEAD = """# Scale

What the program takes for long strings, large parts and many rows. Written by

    tools/scale.py --program build/release/tooljoint --most {most}

Machine: {cpu}, {count} cores; {blas}. Times are of one run each; ratios within a table are what lasts. Memory is the
peak of the largest process.{note}

"""


def measured(options, name, words, ranks=1):
    """{code, wall_s, cpu_s, memory_mb, output} of a run of the program, from the work folder or by running it."""
    folder = pathlib.Path(options.work) / name
    record = folder / "row.json"
    if record.exists():
        return json.loads(record.read_text(encoding="utf-8"))
    folder.mkdir(parents=True, exist_ok=True)
    command = [options.program, *words]
    if ranks > 1:
        command = [options.mpiexec, "-n", str(ranks), *command]
    log = folder / "log.txt"
    begin = time.monotonic()
    child = os.fork()
    if child == 0:
        with open(log, "w", encoding="utf-8") as text:
            os.dup2(text.fileno(), 1)
            os.dup2(text.fileno(), 2)
        os.chdir(folder)
        os.execvp(command[0], command)
    _, status, usage = os.wait4(child, 0)
    row = {"code": os.waitstatus_to_exitcode(status), "wall_s": time.monotonic() - begin, "cpu_s": usage.ru_utime + usage.ru_stime,
           "memory_mb": usage.ru_maxrss / 1024, "output": log.read_text(encoding="utf-8")}
    record.write_text(json.dumps(row), encoding="utf-8")
    return row


def solid(options, counts):
    """A block with JOINED retained nodes at its tip, reduced with MODES modes; (dofs, entries, row)."""
    name = "block_" + "x".join(map(str, counts))
    folder = pathlib.Path(options.work).resolve() / name
    folder.mkdir(parents=True, exist_ok=True)
    made = folder / "made.txt"
    if not made.exists():
        text = os.popen(f"{sys.executable} {BLOCK}/make_block.py {' '.join(map(str, counts))} --joined {JOINED} --out {folder}/block.h5").read()
        shutil.copy(BLOCK / "deck.xml", folder / "deck.xml")
        made.write_text(text, encoding="utf-8")
    dofs, entries = map(int, re.search(r"(\d+) dofs, (\d+) entries", made.read_text(encoding="utf-8")).groups())
    row = measured(options, name, ["export", "deck.xml", "--set", f"Reduction/Mode Selection/Modes={MODES}", "--output", "reduced"])
    return dofs, entries, row


def block_of(options, counts, joined):
    """(folder with block.h5, dofs, entries) of a block with so many nodes kept at its tip; -1: none."""
    folder = pathlib.Path(options.work).resolve() / ("block_" if joined >= 0 else "whole_") / "x".join(map(str, counts))
    folder.mkdir(parents=True, exist_ok=True)
    made = folder / "made.txt"
    if not made.exists():
        text = os.popen(f"{sys.executable} {BLOCK}/make_block.py {' '.join(map(str, counts))} --joined {joined} --out {folder}/block.h5").read()
        made.write_text(text, encoding="utf-8")
    return folder, *map(int, re.search(r"(\d+) dofs, (\d+) entries", made.read_text(encoding="utf-8")).groups())


def rival(options, folder, count):
    """{hertz, wall_s, memory_mb} of the lowest modes of the whole by one shift-invert run: until they are printed."""
    record = folder / f"rival_{count}.json"
    if record.exists():
        return json.loads(record.read_text(encoding="utf-8"))
    begin, hertz, reading = time.monotonic(), [], False
    child = subprocess.Popen([options.program, "modes", "deck.xml", "--without", "Reduction", "--count", str(count)], cwd=folder, stdout=subprocess.PIPE, text=True)
    for line in child.stdout:
        reading = reading or "full [Hz]" in line
        found = re.match(r" *(\d+) +(\S+)$", line) if reading else None
        if found:
            hertz.append(float(found.group(2)))
        if len(hertz) == count:
            break
    wall = time.monotonic() - begin
    child.terminate()  # damped modes would follow
    _, _, usage = os.wait4(child.pid, 0)
    row = {"hertz": hertz, "wall_s": wall, "memory_mb": usage.ru_maxrss / 1024}
    record.write_text(json.dumps(row), encoding="utf-8")
    return row


def seconds(x):
    return f"{x:.3g}" if x < 1000 else f"{x:.0f}"


def cut_row(options, counts, ranks):
    """A line of the table of cut blocks."""
    folder, dofs, _ = block_of(options, counts, -1)
    text = re.sub(r".*\"Retained\".*\n", "", (BLOCK / "deck.xml").read_text(encoding="utf-8"))
    (folder / "deck.xml").write_text(text, encoding="utf-8")
    name = f"cut_{'x'.join(map(str, counts))}_{ranks}"
    row = measured(options, name, ["modes", str(folder / "deck.xml"), "--coupled", "--count", str(MODES), "--output", "out",
                                   "--set", f"Reduction/Mode Selection/Modes={MODES}", "--set", "Reduction/Basis=Multilevel",
                                   "--set", f"Reduction/Multilevel/Parts={CUT_PARTS}", "--set", "Reduction/Basis Checks=false"], ranks)
    if row["code"] != 0:
        return (dofs, ranks, *times(row)[:1], "", "", "", "", "", "")
    with open(pathlib.Path(options.work) / name / "out/modes.csv", encoding="utf-8") as file:
        modes = list(csv.DictReader(file))
    estimate = max(float(mode["estimate"]) for mode in modes)
    own = dofs, ranks, seconds(row["wall_s"]), f"{row['memory_mb']:.0f}"
    if dofs > CUT_WHOLE:
        return (*own, "", f"{estimate:.1e}", "", "")
    whole = rival(options, folder, MODES)
    hertz = [float(mode["coupled [Hz]"]) for mode in modes]
    error = max(abs(a / b - 1) for a, b in zip(hertz, whole["hertz"]))
    return (*own, f"{error:.1e}", f"{estimate:.1e}", seconds(whole["wall_s"]), f"{whole['memory_mb']:.0f}")


def cuts(options):
    chosen = [each for each in CUT_BLOCKS if 3 * math.prod(n + 1 for n in each) <= options.most]
    lines = [cut_row(options, counts, ranks) for counts in (chosen[:1] if options.short else chosen) for ranks in CUT_RANKS if ranks > 1 or counts != CUT_BLOCKS[-1]]
    return (f"{CUT_CHAPTER}\n\nThe same blocks, clamped at one end, without kept dofs: {MODES} coupled modes by `Basis` = `Multilevel` with {CUT_PARTS} parts, estimates included,\n"
            f"from the file on (`modes --coupled`, `Basis Checks` = `false`), beside {MODES} modes of the whole by one shift-invert run. Errors are the largest of the {MODES}\n"
            f"frequencies; memory is that of one rank. The whole of more than {CUT_WHOLE} dofs is not solved. Times of `tools/scale.py --cut --most 600000`\n"
            f"on a machine of its own: {machine()}, {os.cpu_count()} cores.\n\n" +
            table(("dofs", "ranks", "wall [s]", "memory [MB]", "largest error", "largest estimate", "whole: wall [s]", "memory [MB]"), lines))


def table(head, lines):
    return "\n".join(["| " + " | ".join(head) + " |", "|" + "---|" * len(head)] + ["| " + " | ".join(map(str, line)) + " |" for line in lines]) + "\n"


def times(row):
    if row["code"] != 0:
        last = [line for line in row["output"].splitlines() if line.strip()]
        return f"exit code {row['code']}: {last[-1] if last else ''}", "", ""
    return seconds(row["wall_s"]), seconds(row["cpu_s"]), f"{row['memory_mb']:.0f}"


def solids(options, chosen):
    found = [solid(options, counts) for counts in chosen]
    lines = [(dofs, entries, *times(row)) for dofs, entries, row in found]
    text = (f"## Large parts\n\nBlocks of hexahedra ([example 12](../examples/12_solid_block/README.md)), clamped at one end, {3 * JOINED} dofs kept at the other\n"
            f"(all of that end where it has fewer nodes): constraint modes and {MODES} fixed-interface modes, with all checks, from the file to the file.\n\n")
    return text + table(("dofs", "entries of K", "wall [s]", "CPU [s]", "memory [MB]"), lines), found


def strings(options, chosen):
    lines = []
    for name in chosen:
        deck = PROJECT / f"xml/{name}.xml"
        row = measured(options, f"static_{name}", ["run", str(deck), *STATIC_ONLY, "--output", "out", "--set", "Output/XDMF=false"])
        summary = pathlib.Path(options.work) / f"static_{name}" / "out/summary.json"
        static = json.loads(summary.read_text(encoding="utf-8"))["static"] if summary.exists() else {}
        nodes = re.search(r"(\d+) nodes.* (\d+) free dofs", row["output"])
        lines.append((name, nodes.group(2) if nodes else "", static.get("iterations", ""), *times(row)))
    return ("## Static states of long strings\n\nWell path, static state, check of its stability and results, on one rank.\n\n" +
            table(("scene", "dofs", "iterations", "wall [s]", "CPU [s]", "memory [MB]"), lines))


def study_table(name, options):
    """(run, vibration error, steps) of the rows of a study, by their names."""
    path = pathlib.Path(options.work) / name / "out/study.csv"
    with open(path, encoding="utf-8", newline="") as file:
        found = [{key.split(" [")[0]: value for key, value in row.items()} for row in csv.DictReader(file)]
    return sorted((row["method"], row["status"], row["vibration_error"], row["steps"]) for row in found)


def rows(options):
    """The study of the tests with many steps, on one rank and, rows over ranks, on two. The tables have to be the same but for times."""
    end = 3 if options.short else 15
    steps = ", ".join(f"{0.2 + 0.01 * i:.2f} ms" for i in range(8 if options.short else 58)) + ", 1 ms"
    deck = PROJECT / "tests/study/study.xml"
    common = ["study", str(deck), "--output", "out", "--set", f"Study/End Time={end}", "--set", "Study/Repeats=2",
              "--set", f"Study/Methods/Generalized-alpha, full/Sweep/step/Values={{{steps}}}"]
    one = measured(options, "rows_1", common)
    two = measured(options, "rows_2", [*common, "--ranks-per-row", "1", "--timing", "shared"], ranks=2)
    for name, row in (("one rank", one), ("two ranks", two)):
        if row["code"] != 0:
            raise SystemExit(f"the study on {name}: exit {row['code']}\n{row['output'][-2000:]}")
    tables = [study_table(name, options) for name in ("rows_1", "rows_2")]
    if tables[0] != tables[1]:
        raise SystemExit(f"the tables differ: {[pair for pair in zip(*tables) if pair[0] != pair[1]][:3]}")
    lines = [(ranks, len(tables[0]), *times(row)) for ranks, row in ((1, one), (2, two))]
    return (f"{ROWS_CHAPTER}\n\nThe study of `tests/study` with more steps over {end} s, each timed twice, `--ranks-per-row 1` on two\nranks: {one['wall_s'] / two['wall_s']:.2f} times the rows per hour of one, and the same table.\n\n" +
            table(("ranks", "rows", "wall [s]", "CPU [s]", "memory [MB]"), lines))


def static(options, deck, ranks, repeat):
    """(seconds of the equilibrium, of path, equations, equilibrium and check of stability, static datasets) of a run."""
    name = f"divided_{deck}_{ranks}_{repeat}"
    row = measured(options, name, ["run", str(PROJECT / f"xml/{deck}.xml"), *STATIC_ONLY, "--output", "out", "--set", "Output/XDMF=false", "--verbose"], ranks)
    if row["code"] != 0:
        raise SystemExit(f"{name}: exit {row['code']}\n{row['output'][-2000:]}")
    text = " ".join(row["output"].split())
    times = {stage: float(found.group(1)) if (found := re.search(rf"{stage} ([0-9.]+) s", text)) else 0.0 for stage in (EQUILIBRIUM, *BESIDE)}
    values = {key: value for key, value in datasets(pathlib.Path(options.work) / name / "out/results.h5").items() if key.startswith("static")}
    return times[EQUILIBRIUM], sum(times.values()), values


def statics(options):
    """One rank and two, in turns, the best of some."""
    lines = []
    for deck in STATICS[:1] if options.short else STATICS:
        runs = [[static(options, deck, ranks, repeat) for ranks in (1, 2)] for repeat in range(1 if options.short else 3)]
        one, two = ([min(each[i][part] for each in runs) for part in (0, 1)] for i in (0, 1))
        apart = max(difference(value, runs[0][1][2][key]) for key, value in runs[0][0][2].items() if value.dtype.kind == "f")
        ratios = [f"{a / b:.2f}" if b > 0 else "" for a, b in zip(one, two)]
        lines.append((deck, f"{one[0]:.2f}", f"{two[0]:.2f}", ratios[0], f"{one[1]:.2f}", f"{two[1]:.2f}", ratios[1], f"{apart:.1e}"))
    return (f"{STATICS_CHAPTER}\n\nWall time of the equilibrium alone, and of the whole: path, equations, equilibrium and check of stability; the best of three\n"
            "runs in turns. The last column is the largest difference of a recorded value, relative to the largest of its kind. Short\n"
            "strings are not divided.\n\n" +
            table(("scene", "equilibrium: 1 rank [s]", "2 ranks [s]", "times as fast", "whole: 1 rank [s]", "2 ranks [s]", "times as fast", "largest difference"), lines))


def motion(options, deck, words, end, ranks, repeat):
    """(transient of summary.json, datasets of the motion, peak memory [MB]) of a run; ranks divide the motion."""
    name = f"motion_{deck}_{'full' if words else 'reduced'}_{ranks}_{repeat}"
    division = ["--set", f"Transient/Ranks={'Divide' if ranks > 1 else 'Alike'}"]
    row = measured(options, name, ["run", str(PROJECT / f"xml/{deck}.xml"), *words, *division, "--output", "out", "--set", f"Transient/End Time={end}",
                                   "--set", "Output/XDMF=false"], ranks)
    if row["code"] != 0:
        raise SystemExit(f"{name}: exit {row['code']}\n{row['output'][-2000:]}")
    folder = pathlib.Path(options.work) / name / "out"
    values = {key: value for key, value in datasets(folder / "results.h5").items() if key.startswith("transient")}
    return json.loads((folder / "summary.json").read_text(encoding="utf-8"))["transient"], values, row["memory_mb"]


def walls(options):
    """One rank and two, in turns, the best of some."""
    lines = []
    for deck, words, end in MOTIONS[:1] if options.short else MOTIONS:
        repeats = range(1 if options.short else 3)
        runs = [[motion(options, deck, words, end, ranks, repeat) for ranks in (1, 2)] for repeat in repeats]
        one, two = (min(each[i][0]["wall_s"] for each in runs) for i in (0, 1))
        apart = max(difference(value, runs[0][1][1][key]) for key, value in runs[0][0][1].items() if value.dtype.kind == "f")
        steps = runs[0][0][0]["steps"]
        lines.append((deck, "full" if words else "reduced", steps, f"{1e6 * one / steps:.0f}", f"{1e6 * two / steps:.0f}", f"{one / two:.2f}", f"{apart:.1e}"))
    return table(("scene", "model", "steps", "1 rank [us per step]", "2 ranks [us per step]", "times as fast", "largest difference"), lines)


def counts(options):
    """What a rank has to do, of ranks that may share cores; the messages of a step are those of two ranks, whose steps are the same."""
    deck, words, end = MOTIONS[0]
    alone, two = (motion(options, deck, words, end, ranks, 0)[0] for ranks in (1, 2))
    step, messages, dofs = alone["wall_s"] / alone["steps"], two["messages"] / two["steps"], 2 * two["dofs_of_rank"] - 6
    lines = []
    for ranks in (2,) if options.short else (2, 4, 8, 16):
        found, _, memory = motion(options, deck, words, COUNTED, ranks, "counted")
        efficiency = step / ranks / (found["dofs_of_rank"] / dofs * step + messages * MESSAGE * math.log2(ranks))
        lines.append((ranks, found["dofs_of_rank"], f"{messages:.1f}", f"{100 * efficiency:.0f} %", f"{memory:.0f}"))
    return table(("ranks", "dofs of a rank", "messages per step", "predicted efficiency", "memory of a rank [MB]"), lines)


def motions(options):
    return (f"{CHAPTER}\n\nThe motion alone, wall time of the best of three runs in turns; `Transient/Ranks` = `Divide`. The last column is the largest difference of\n"
            "a recorded value, relative to the largest of its kind; contact amplifies rounding, so that it grows with time.\n\n" + walls(options) +
            f"\nWork and messages of {MOTIONS[0][0]}, full model, counted over {COUNTED} s. The efficiency is predicted from them, for a step of one rank\n"
            f"as measured here and {1e6 * MESSAGE:.0f} us log2(ranks) for a message, with a core for each rank.\n\n" + counts(options))


def study_of(options, name, words, ranks):
    """The rows of methods of a study of the deck that are done."""
    row = measured(options, name, ["study", str(PROJECT / f"xml/{REDUCED_DECK}.xml"), "--output", "out", *words], ranks)
    if row["code"] != 0:
        raise SystemExit(f"{name}: exit {row['code']}\n{row['output'][-2000:]}")
    with open(pathlib.Path(options.work) / name / "out/study.csv", encoding="utf-8") as text:
        return [each for each in csv.DictReader(text) if each["kind"] == "method" and each["status"] == "done"]


def reduced(options):
    """The study of the deck, and its row of REDUCED_METHOD on one rank and two."""
    runs = study_of(options, "study_reduced", [], 1)
    right = [each for each in runs if float(each["vibration_error"]) <= REDUCED_ERROR]
    best = {model: min((each for each in right if each["model"] == model), key=lambda each: float(each["cpu [s]"])) for model in ("full", "reduced")}
    lines = [(model, each["label"], each["reduced_dofs"], f"{float(each['cpu [s]']):.3f}", f"{100 * float(each['vibration_error']):.2f} %")
             for model, each in best.items()]
    ratio = float(best["full"]["cpu [s]"]) / float(best["reduced"]["cpu [s]"])
    methods = ElementTree.parse(PROJECT / f"xml/{REDUCED_DECK}.xml").getroot().findall("ParameterList[@name='Study']/ParameterList[@name='Methods']/ParameterList")
    others = [word for each in methods if each.get("name") not in REDUCED_METHODS for word in ("--without", f"Study/Methods/{each.get('name')}")]
    two = study_of(options, "study_reduced_2", ["--set", "Transient/Ranks=Divide", "--without", "Study/Baseline", *others], 2)
    factors = [(each["label"], ranks, f"{float(each['real_time_factor']):.1f}", f"{100 * float(each['vibration_error']):.2f} %")
               for ranks, found in ((1, runs), (2, two)) for each in found if each["method"] in {row["method"] for row in two}]
    return (f"{REDUCED_CHAPTER}\n\nThe study of `xml/{REDUCED_DECK}.xml`: of the runs with a vibration error of at most {100 * REDUCED_ERROR:.0f} %, those with the least CPU time of the\n"
            f"motion on one rank. The reduced model is {ratio:.1f} times as fast.\n\n" +
            table(("model", "run", "dofs", "CPU of the motion [s]", "vibration error"), lines) +
            "\nThe motion alone, without records and figures:\n\n" +
            table(("run", "ranks", "simulated seconds per second", "vibration error"), factors))


def renew(chapter):
    """This chapter in the document, at its place or at the end."""
    head = chapter.splitlines()[0]
    chapters = re.split(r"\n(?=## )", DOCUMENT.read_text(encoding="utf-8").rstrip())
    others = [each.rstrip() for each in chapters]
    place = next((i for i, each in enumerate(others) if each.startswith(head)), len(others))
    others[place:place + 1] = [chapter.rstrip()]
    DOCUMENT.write_text("\n\n".join(others) + "\n", encoding="utf-8")


def kept(head):
    """A chapter of the document as it is, or nothing."""
    for each in re.split(r"\n(?=## )", DOCUMENT.read_text(encoding="utf-8")):
        if each.startswith(head):
            return each.rstrip() + "\n"
    return ""


def draw(found):
    done = [(dofs, row["cpu_s"], row["memory_mb"]) for dofs, _, row in found if row["code"] == 0]
    dofs, cpu, memory = zip(*done)
    plots.use_style()
    figure, (time, space) = plots.plt.subplots(1, 2, figsize=(7.4, 3.2), constrained_layout=True)
    for axes, values, text, colour in ((time, cpu, plots.label("CPU time", "s"), plots.COLOURS[0]), (space, memory, plots.label("peak memory", "MB"), plots.COLOURS[1])):
        axes.plot(dofs, values, "o-", color=colour)
        plots.log_log(axes)
        axes.set(xlabel="dofs of the block", ylabel=text)
    plots.headline(figure, "Reduction of a solid part", f"{MODES} fixed-interface modes, {3 * JOINED} kept dofs; {machine()}")
    plots.save(figure, FIGURE)


def machine():
    text = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8")
    name = re.search(r"model name\s*: (.*)", text)
    return name.group(1) if name else platform.machine()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True)
    parser.add_argument("--work", default="results/scale")
    parser.add_argument("--mpiexec", default="mpiexec")
    parser.add_argument("--most", type=int, default=200000, help="dofs of the largest block")
    parser.add_argument("--rows", action="store_true", help="a study of 68 rows on one and two ranks alone; renews its chapter of the document")
    parser.add_argument("--note", default="", help="a sentence about the circumstances, for the head of the document")
    parser.add_argument("--short", action="store_true")
    parser.add_argument("--cut", action="store_true", help="blocks cut into substructures alone; renews their chapter of the document")
    parser.add_argument("--motions", action="store_true", help="motions divided among ranks alone; renews their chapter of the document")
    parser.add_argument("--statics", action="store_true", help="static states divided among ranks alone; renews their chapter of the document")
    parser.add_argument("--reduced", action="store_true", help="full and reduced motions of the same error alone; renews their chapter of the document")
    options = parser.parse_args()
    options.program = str(pathlib.Path(options.program).resolve())
    alone = [write for chosen, write in ((options.motions, motions), (options.cut, cuts), (options.statics, statics), (options.reduced, reduced), (options.rows, rows)) if chosen]
    if alone:
        chapter = alone[0](options)
        print(chapter)
        if not options.short:
            renew(chapter)
        return 0
    chosen = [each for each in BLOCKS if 3 * math.prod(n + 1 for n in each) <= options.most]
    blocks, found = solids(options, chosen[:2] if options.short else chosen)
    text = blocks + "\n" + strings(options, STRINGS[:1] if options.short else STRINGS)
    text += "\n" + statics(options) + "\n" + motions(options)
    for head in (CUT_CHAPTER, REDUCED_CHAPTER, ROWS_CHAPTER):
        if not options.short and kept(head):
            text += "\n" + kept(head)
    print(text)
    if not options.short:
        blas = os.popen(f"{options.program} --version").read()
        blas = re.search(r"BLAS +(\S+)", blas)
        draw(found)
        head = HEAD.format(most=options.most, note=f" {options.note}" if options.note else "", cpu=machine(), count=os.cpu_count(), blas=f"BLAS {blas.group(1)}" if blas else "BLAS unknown")
        figure = f"![Reduction of a solid part](figures/{FIGURE.name})\n\n"
        at = text.index("\n| dofs") + 1
        DOCUMENT.write_text(head + text[:at] + figure + text[at:], encoding="utf-8")
    failed = [row for _, _, row in found if row["code"] != 0]
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
