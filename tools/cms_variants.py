#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares all bases on the reference scene and on the frame, and rewrites tables and figures of docs/cms-variants.md.

    tools/cms_variants.py --program build/release/tooljoint [--work results/cms_variants] [--only helical,frame,estimates,tolerance] [--fresh] [--short]

The bases, what they are given and their mode counts are the methods of the Study list in xml/cms_variants.xml. Runs that are already in the work folder are
not repeated unless --fresh is given. --short (a test) takes few runs, writes nothing and ends with 1 when an estimate or a tolerance fails.
Needs h5py, matplotlib and numpy.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import platform
import re
import subprocess
import sys
import time
import xml.etree.ElementTree as xml

PROJECT = pathlib.Path(__file__).resolve().parent.parent
STUDY = PROJECT / "xml/cms_variants.xml"
FREQUENCIES = 20
FACTOR = 3.0          # an estimate is to lie within this factor of the true error
ROUNDING = 1e-9       # true errors of frequencies below this are rounding
STEPS = 5e-5          # dyn below this is what the tolerance of the steps leaves, with all modes kept too
FRAME_STEP = "2e-4"
# scene, window [s], what the motion is run with, how many modes the deck asks for
SCENES = [("helical_170m", 3, [], "Cut-off Frequency"), ("helical_170m_source", 3, [], "Modes"), ("stress_170m", 3, [], "Cut-off Frequency"),
          ("vertical_1000m", 2, [], "Cut-off Frequency"), ("inclined_1000m", 2, [], "Cut-off Frequency"), ("frame", 2, [f"Transient/Step={FRAME_STEP}"], "Cut-off Frequency")]
FREQUENCY_TOLERANCES = ("1e-2", "1e-3", "1e-4")
MOTION_TOLERANCE = "1e-2"


def settings(overrides):
    """Overrides as arguments: "PATH=VALUE" or "!PATH"."""
    arguments = []
    for text in overrides:
        arguments += ["--without", text[1:]] if text.startswith("!") else ["--set", text]
    return arguments


class Method:
    """A line of the plots."""

    def __init__(self, label, overrides, parameter, values):
        self.label, self.overrides, self.parameter, self.values = label, overrides, parameter, values

    def runs(self, values=None):
        for value in self.values if values is None else values:
            yield f"{self.label}, {self.parameter.split('/')[-1]} {value}", [*self.overrides, f"{self.parameter}={value}"]


def methods():
    """The reduced methods of the study."""
    found = []
    root = xml.parse(STUDY).getroot()
    lists = {item.get("name"): item for item in root.iter("ParameterList")}
    for item in lists["Methods"]:
        values = {p.get("name"): p.get("value") for p in item.findall("Parameter")}
        if values["Model"] == "Full":
            continue
        sweep = {p.get("name"): p.get("value") for p in item.find("ParameterList").find("ParameterList")}
        entries = [text.strip() for text in values.get("Set", "{}").strip("{}").split(",") if text.strip()]
        found.append(Method(item.get("name"), entries, sweep["Parameter"], [text.strip() for text in sweep["Values"].strip("{}").split(",")]))
    return found


class Bench:
    """Runs of the program, kept in the work folder."""

    def __init__(self, options):
        self.program, self.work, self.short = options.program, pathlib.Path(options.work).resolve(), options.short
        self.limit = options.limit
        if options.fresh:
            for kept in self.work.glob("*/done.json"):
                kept.unlink()
        self.work.mkdir(parents=True, exist_ok=True)

    def call(self, command, name, deck, arguments):
        """(folder, what was printed, reason of a failure or "")."""
        folder = self.work / re.sub(r"[^A-Za-z0-9.]+", "_", name)
        kept = folder / "done.json"
        if kept.exists():
            done = json.loads(kept.read_text())
            if done["arguments"] == arguments:
                return folder, done["printed"], done["reason"]
        folder.mkdir(parents=True, exist_ok=True)
        begin = time.time()
        try:
            run = subprocess.run([self.program, command, str(deck), "--output", str(folder), *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                 check=False, timeout=self.limit)
        except subprocess.TimeoutExpired:
            print(f"{time.time() - begin:6.1f} s  {command} {name}: given up", flush=True)
            return folder, "", f"given up after {self.limit:g} s"
        reason = "" if run.returncode == 0 else (run.stderr.strip().splitlines() or [f"ended with {run.returncode}"])[-1].removeprefix("tooljoint: ")
        print(f"{time.time() - begin:6.1f} s  {command} {name}" + (f": {reason[:120]}" if reason else ""), flush=True)
        kept.write_text(json.dumps({"arguments": arguments, "printed": run.stdout, "reason": reason}))
        return folder, run.stdout, reason


class Modes:
    """What `tooljoint modes` says of one reduced model."""

    def __init__(self, bench, name, deck, arguments):
        folder, printed, self.reason = bench.call("modes", name, deck, ["--count", str(FREQUENCIES), *arguments])
        self.rows, self.dofs = [], None
        if self.reason:
            return
        match = re.search(r"reduced +(\d+) dofs to (\d+)", printed)
        self.full, self.dofs = int(match.group(1)), int(match.group(2))
        rounds = re.findall(r"^ *\d+ +(\d+) .*$", printed.split("round")[-1], re.M) if "round" in printed else []
        self.rounds = len(rounds)
        with open(folder / "modes.csv", newline="", encoding="utf-8") as text:
            self.rows = list(csv.DictReader(text))

    def error(self):
        """Largest |f / f_full - 1|."""
        return max(abs(float(row["error"])) for row in self.rows)

    def ratios(self):
        """(row, estimate / true error) where both mean something."""
        return [(row, float(row["estimate"]) / float(row["error"])) for row in self.rows
                if row["estimate"] and abs(float(row["error"])) > ROUNDING]


def outside(ratio):
    return not 1 / FACTOR <= abs(ratio) <= FACTOR


def machine():
    with open("/proc/cpuinfo", encoding="utf-8") as text:
        names = [line.split(":")[1].strip() for line in text if line.startswith("model name")]
    return f"{names[0] if names else platform.processor()}, {os.cpu_count()} cores, one rank"


def move(folder):
    """Translations over time, samples x rows, and the state at rest."""
    import h5py
    with h5py.File(folder / "results.h5") as file:
        x = file["/transient/displacement"][:, :, :3]
        rest = file["/static/displacement"][:][:, :3]
    return x.reshape(len(x), -1), rest.reshape(-1)


def frame_error(folder, reference):
    """dyn over all translations."""
    import numpy as np
    (x, _), (exact, rest) = move(folder), move(reference)
    return float(np.linalg.norm(x - exact) / np.linalg.norm(exact - rest))


class Point:
    """One reduced model: its size, what it costs, how wrong it is, how wrong it is said to be."""

    def __init__(self, label, line):
        self.label, self.line = label, line
        self.dofs = self.setup = self.cpu = self.dyn = self.estimate = self.modes = None
        self.reason = ""


def helical_points(bench):
    """From the study, and modes of every run."""
    folder, _, reason = bench.call("study", "study", STUDY, [])
    if reason:
        sys.exit(f"The study failed: {reason}")
    with open(folder / "study.csv", newline="", encoding="utf-8") as text:
        rows = [{key.split(" [")[0]: value for key, value in row.items()} for row in csv.DictReader(text)]
    by_label = {row["label"]: row for row in rows}
    points = []
    for method in methods():
        for label, overrides in method.runs():
            point, row = Point(label, method.label), by_label[label]
            point.modes = Modes(bench, f"helical {label}", STUDY, ["--without", "Study", *settings(overrides)])
            point.dofs, point.reason = point.modes.dofs, row["reason"] or point.modes.reason
            if row["status"] == "done":
                point.dofs, point.setup = int(row["reduced_dofs"]), float(row["setup_cpu"])
                point.cpu, point.dyn = float(row["cpu_per_simulated_s"]), float(row["dyn"])
                point.estimate = float(row["estimated_dyn"]) if row["estimated_dyn"] else None
            points.append(point)
    full = by_label["reference"]
    return points, {"dofs": int(full["reduced_dofs"]), "cpu": float(full["cpu_per_simulated_s"]), "own": float(by_label["reference, check"]["dyn"])}


def frame_arguments(overrides):
    """The frame without its kick: free-interface bases spread a jump of velocity over the interfaces, dual ones refuse that."""
    own = [text for text in overrides if text != "!Reduction/Error Estimate"]
    return ["--without", "Parts/Starts", "--without", "Reduction/Cut-off Frequency", "--set", "Reduction/Modes=4", *settings(own)]


def frame_run(bench, name, arguments, end=2):
    folder, _, reason = bench.call("run", name, PROJECT / "xml/frame.xml", [*arguments, "--set", f"Transient/End Time={end}", "--set", f"Transient/Step={FRAME_STEP}"])
    return folder, (None if reason else json.loads((folder / "summary.json").read_text())), reason


def frame_points(bench, chosen=None, values=("0", "2", "4", "6", "8", "12", "16")):
    end = 0.5 if bench.short else 2
    full, summary, reason = frame_run(bench, "frame full", ["--without", "Parts/Starts", "--without", "Reduction"], end)
    if reason:
        sys.exit(f"The frame failed: {reason}")
    points = []
    for method in methods():
        if chosen is not None and method.label not in chosen:
            continue
        for label, overrides in method.runs(("4", "8", "12", "16") if "System" in method.parameter else values):
            point, arguments = Point(label, method.label), frame_arguments(overrides)
            point.modes = Modes(bench, f"frame modes {label}", PROJECT / "xml/frame.xml", arguments)
            folder, run, point.reason = frame_run(bench, f"frame {label}", arguments, end)
            point.dofs, point.reason = point.modes.dofs, point.reason or point.modes.reason
            if run is not None:
                point.dofs, point.setup, point.cpu = run["reduction"]["reduced_dofs"], run["reduction"]["wall_s"], run["transient"]["cpu_s"] / end
                point.dyn = frame_error(folder, full)
                if "!Reduction/Error Estimate" not in method.overrides:
                    _, run, reason = frame_run(bench, f"frame estimate {label}", [*arguments, "--set", "Reduction/Error Estimate=Transient"], end)
                    point.reason = point.reason or reason
                    point.estimate = run and run["reduction"]["estimate"]["motion_error"]
            points.append(point)
    return points, {"dofs": summary["model"]["free_dofs"], "cpu": summary["transient"]["cpu_s"] / end, "own": None}


def cell(value, form="{:.1e}"):
    return "-" if value is None else form.format(value)


def table(points, full):
    """One row for each reduced model."""
    rows = ["| run | dofs | largest error of 20 frequencies | least MAC | dyn | CPU [s] per simulated s | reduction [s] |", "|---|---|---|---|---|---|---|",
            f"| full model | {full['dofs']} | | | | {full['cpu']:.3g} | |"]
    for p in points:
        error, mac = (p.modes.error(), min(float(row["mac"]) for row in p.modes.rows)) if p.modes.rows else (None, None)
        rows.append(f"| {p.label} | {cell(p.dofs, '{}')} | {cell(error)} | {cell(mac, '{:.2f}')} | {cell(p.dyn)} | {cell(p.cpu, '{:.3g}')} | {cell(p.setup, '{:.2g}')} |")
    return "\n".join(rows) + "\n"


def failures(points):
    """Every run that failed, with its reason."""
    failed = [(p.label, p.reason) for p in points if p.reason]
    if not failed:
        return "No run failed.\n"
    return "\n".join(["| failed | reason |", "|---|---|", *(f"| {label} | {reason.replace('|', '/')} |" for label, reason in failed)]) + "\n"


COLOURS = ["#0072B2", "#D55E00", "#009E73", "#B8860B", "#CC4C99", "#3F9BD4", "#7A3E9D", "#4D4D4D", "#8C2D04", "#5C7A00", "#E69F00", "#117733", "#882255"]
MARKERS = "osD^vPX*hp<>d"


def figure(name, title, points, full):
    """Errors against size and against time, one line for each basis."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    plt.rcParams.update({"font.size": 8, "axes.grid": True, "grid.color": "#e6e6e6", "axes.spines.top": False, "axes.spines.right": False, "svg.fonttype": "none",
                         "svg.hashsalt": "cms"})
    lines = list(dict.fromkeys(p.line for p in points))
    figure_, axes = plt.subplots(2, 2, figsize=(10, 8), constrained_layout=True)
    frequency = lambda p: max(p.modes.error(), 1e-12) if p.modes.rows else None
    for ax, x, y, labels in ((axes[0, 0], lambda p: p.dofs, frequency, ("reduced dofs", "largest error of 20 frequencies")),
                             (axes[0, 1], lambda p: p.setup, frequency, ("time of the reduction [s]", "largest error of 20 frequencies")),
                             (axes[1, 0], lambda p: p.dofs, lambda p: p.dyn, ("reduced dofs", "dyn of the transient")),
                             (axes[1, 1], lambda p: p.cpu, lambda p: p.dyn, ("CPU time per simulated second [s]", "dyn of the transient"))):
        for i, line in enumerate(lines):
            pairs = [(x(p), y(p)) for p in points if p.line == line and x(p) is not None and y(p) is not None and y(p) > 0]
            if pairs:
                ax.plot(*zip(*pairs), marker=MARKERS[i % len(MARKERS)], color=COLOURS[i % len(COLOURS)], label=line, linewidth=1.2, markersize=4)
        ax.set_yscale("log")
        ax.set_xscale("linear" if "dofs" in labels[0] else "log")
        ax.set_xlabel(labels[0]), ax.set_ylabel(labels[1])
    axes[1, 1].axvline(full["cpu"], color="#8a8a8a", linewidth=1, linestyle=":", label="full model")
    if full["own"]:
        for ax in axes[1]:
            ax.axhline(full["own"], color="#8a8a8a", linewidth=1, linestyle="--", label="error of the time steps")
    found = {}
    for ax in axes.flat:
        for handle, label in zip(*ax.get_legend_handles_labels()):
            found.setdefault(label, handle)
    figure_.legend(found.values(), found.keys(), loc="outside lower center" if hasattr(figure_, "get_layout_engine") and matplotlib.__version_info__ >= (3, 7) else "lower center",
                   ncol=5, frameon=False, bbox_to_anchor=(0.5, -0.08))
    figure_.suptitle(title, fontweight="bold")
    figure_.savefig(PROJECT / f"docs/figures/{name}.png", dpi=110, bbox_inches="tight")
    plt.close(figure_)


def estimate_rows(points, scene):
    """Counts for each line, and every exception."""
    counts, exceptions = {}, []
    for p in points:
        if p.line == "Craig-Bampton, interfaces":  # estimates do not see what an interface reduction leaves out
            continue
        count = counts.setdefault(p.line, [0, 0, [], 0, 0, []])
        for row, ratio in p.modes.ratios():
            count[0] += 1
            count[2].append(abs(ratio))
            if outside(ratio):
                count[1] += 1
                exceptions.append(f"| {scene} | {p.label} | frequency {row['mode']}, MAC {float(row['mac']):.2f} | {float(row['error']):.1e} | {float(row['estimate']):.1e} "
                                  f"| {ratio:.3g} | {'yes' if row['definite'] == '0' else 'no'} |")
        if p.estimate is not None and p.dyn and p.dyn > STEPS:
            ratio = p.estimate / p.dyn
            count[3] += 1
            count[5].append(ratio)
            if outside(ratio):
                count[4] += 1
                exceptions.append(f"| {scene} | {p.label} | dyn | {p.dyn:.1e} | {p.estimate:.1e} | {ratio:.3g} | |")
    span = lambda values: f"{min(values):.2g} to {max(values):.2g}" if values else "-"
    rows = [f"| {scene} | {line} | {c[0]} | {c[1]} | {span(c[2])} | {c[3]} | {c[4]} | {span(c[5])} |" for line, c in counts.items() if c[0] + c[3] > 0]
    return rows, exceptions


def tolerance_frequency(bench, scene, count, tolerance):
    """(row, met)."""
    name = f"tolerance {scene} {tolerance}"
    found = Modes(bench, name, PROJECT / f"xml/{scene}.xml", ["--without", f"Reduction/{count}", "--set", f"Reduction/Frequency Tolerance={tolerance}"])
    if found.reason:
        return f"| {scene} | {tolerance} | failed: {found.reason} | | | no |", False
    met = found.error() <= float(tolerance)
    estimated = max(abs(float(row["estimate"])) for row in found.rows)
    return f"| {scene} | {tolerance} | {found.dofs} of {found.full} | {estimated:.1e} | {found.error():.1e} | {'yes' if met else '**no**'} |", met


def dyn_between(bench, scene, folder, reference, end):
    if scene == "frame":
        return frame_error(folder, reference)
    done = subprocess.run([bench.program, "compare", str(folder), str(reference), "--to", str(end)], stdout=subprocess.PIPE, text=True, check=True)
    return float(re.search(r"dyn (\S+)", done.stdout).group(1))


def tolerance_motion(bench, scene, end, more, count, tolerance):
    """(row, met): the transient of the chosen modes against the full one with the same steps."""
    deck = PROJECT / f"xml/{scene}.xml"
    common = [*settings([*more, f"Transient/End Time={end}"])] + (["--set", "Output/XDMF=false"] if scene != "frame" else [])
    substructures = [] if scene == "frame" else ["--without", "Substructures"]
    full, _, reason = bench.call("run", f"motion full {scene} {end}", deck, [*common, "--without", "Reduction", *substructures])
    if reason:
        return f"| {scene} | 0 to {end} s | {tolerance} | the full model failed: {reason} | | | no |", False
    folder, _, reason = bench.call("run", f"motion {scene} {end} {tolerance}", deck, [*common, "--without", f"Reduction/{count}", "--set", f"Reduction/Motion Tolerance={tolerance}"])
    if reason:
        return f"| {scene} | 0 to {end} s | {tolerance} | failed: {reason} | | | no |", False
    summary = json.loads((folder / "summary.json").read_text())
    dyn, estimate = dyn_between(bench, scene, folder, full, end), summary["reduction"]["estimate"]["motion_error"]
    met = dyn <= float(tolerance)
    return (f"| {scene} | 0 to {end} s | {tolerance} | {summary['reduction']['reduced_dofs']} of {summary['model']['free_dofs']} | {cell(estimate)} | {dyn:.1e} "
            f"| {'yes' if met else '**no**'} |", met)


def helical_section(bench):
    points, full = helical_points(bench)
    figure("cms_variants_helical", "Reference scene, 0 to 0.5 s", points, full)
    return (f"Machine: {machine()}. The steps alone (0.25 ms) cost a dyn of {full['own']:.1e} against RK4.\n\n![errors](figures/cms_variants_helical.png)\n\n"
            + table(points, full) + "\n" + failures(points))


def frame_section(bench):
    points, full = frame_points(bench)
    figure("cms_variants_frame", "Frame of five parts, 0 to 2 s", points, full)
    return f"Machine: {machine()}.\n\n![errors](figures/cms_variants_frame.png)\n\n" + table(points, full) + "\n" + failures(points)


def estimates_section(bench):
    rows = ["| scene | basis | frequencies | outside | ratios | motions | outside | ratios |", "|---|---|---|---|---|---|---|---|"]
    exceptions = ["| scene | run | of | true error | estimate | ratio | said to lack a mode |", "|---|---|---|---|---|---|---|"]
    for scene, points in (("reference scene", helical_points(bench)[0]), ("frame", frame_points(bench)[0])):
        counts, found = estimate_rows(points, scene)
        rows += counts
        exceptions += found
    return "\n".join(rows) + f"\n\nEvery exception ({len(exceptions) - 2}):\n\n" + "\n".join(exceptions) + "\n"


def tolerance_section(bench):
    rows = ["| scene | tolerance | dofs | largest estimate | largest true error | met |", "|---|---|---|---|---|---|"]
    for scene, _, _, count in SCENES:
        rows += [tolerance_frequency(bench, scene, count, tolerance)[0] for tolerance in FREQUENCY_TOLERANCES]
    motions = ["| scene | window | tolerance | dofs | estimated dyn | dyn | met |", "|---|---|---|---|---|---|---|"]
    for scene, end, more, count in SCENES:
        motions.append(tolerance_motion(bench, scene, end, more, count, MOTION_TOLERANCE)[0])
    return f"The lowest {FREQUENCIES} coupled frequencies:\n\n" + "\n".join(rows) + "\n\nThe motion:\n\n" + "\n".join(motions) + "\n"


SECTIONS = {"helical": helical_section, "frame": frame_section, "estimates": estimates_section, "tolerance": tolerance_section}


def short_test(bench):
    """Few bases on the frame, tolerances there and on 0.05 s of the reference scene."""
    faults = []
    chosen = ("Craig-Bampton", "MacNeal", "Rubin", "Dual Craig-Bampton", "Enhanced, free")
    points, full = frame_points(bench, chosen, ("8", "12"))
    for p in points:
        if p.reason:
            faults.append(f"{p.label}: {p.reason}")
            continue
        if not p.dofs <= full["dofs"] + (60 if p.line.startswith("Dual") else 0):
            faults.append(f"{p.label}: {p.dofs} dofs")
        judged = p.modes.ratios()
        if p.line not in ("MacNeal", "Dual Craig-Bampton"):  # which have no estimates
            if any(outside(ratio) for _, ratio in judged):
                faults.append(f"{p.label}: estimates of frequencies off by {max(abs(math.log(abs(r))) for _, r in judged):.2f} (log)")
            if p.estimate is None or (p.dyn > STEPS and outside(p.estimate / p.dyn)):
                faults.append(f"{p.label}: dyn {p.dyn:.2e}, estimate {p.estimate}")
    for line in chosen:
        mine = [p for p in points if p.line == line]
        if len(mine) != 2 or not mine[1].modes.rows or not mine[1].modes.error() < mine[0].modes.error():
            faults.append(f"{line}: twelve modes are not better than eight")
    for row, met in (tolerance_frequency(bench, "frame", "Cut-off Frequency", "1e-3"), tolerance_frequency(bench, "helical_170m", "Cut-off Frequency", "1e-3"),
                     tolerance_motion(bench, "frame", 0.5, [f"Transient/Step={FRAME_STEP}"], "Cut-off Frequency", "1e-2"),
                     tolerance_motion(bench, "helical_170m", 0.05, [], "Cut-off Frequency", "1e-2")):
        print(row)
        if not met:
            faults.append(row)
    print("\n".join(["", f"{len(faults)} failed", *faults]))
    return 1 if faults else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True, help="the tooljoint program")
    parser.add_argument("--work", default="results/cms_variants", help="folder for the runs")
    parser.add_argument("--only", default=",".join(SECTIONS), help="sections to write")
    parser.add_argument("--fresh", action="store_true", help="forget the runs in that folder")
    parser.add_argument("--limit", type=float, default=900.0, help="seconds after which a run is given up")
    parser.add_argument("--short", action="store_true", help="a quick check instead")
    options = parser.parse_args()
    bench = Bench(options)
    if options.short:
        return short_test(bench)
    page = PROJECT / "docs/cms-variants.md"
    for name in options.only.split(","):
        section = SECTIONS[name](bench)
        text = page.read_text(encoding="utf-8")
        marked = re.compile(rf"(<!-- {name} -->\n).*?(<!-- end -->)", re.S)
        if not marked.search(text):
            sys.exit(f"{page} has no place for the section \"{name}\".")
        page.write_text(marked.sub(lambda match: match.group(1) + "\n" + section + "\n" + match.group(2), text), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
