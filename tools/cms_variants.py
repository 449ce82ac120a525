#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares all bases on the reference scene and on a frame, and rewrites tables and figures of
docs/cms-variants.md and docs/tables/cms_variants_*.csv.

    tools/cms_variants.py --program build/release/tooljoint [--work results/cms_variants] [--only
        helical,frame,estimates,tolerance] [--fresh] [--short]

The Study lists of xml/cms_variants.xml and xml/cms_variants_frame.xml define the bases, their
parameters and mode counts; the numbers come from study.csv and study.h5. Runs that are already in
the work folder are not repeated unless --fresh is given. --set changes the studies, for a quick
look (--set Study/Repeats=1). --short is a test: few runs, no files, exit code 1 if an estimate or a
tolerance fails. Needs h5py, matplotlib and numpy.
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

sys.dont_write_bytecode = True  # no __pycache__ beside the script
import plot_study  # noqa: E402
import plots  # noqa: E402
import redraw_studies  # noqa: E402

os.environ.setdefault("TOOLJOINT_REPORT", "off")  # reports of these runs are not needed

PROJECT = pathlib.Path(__file__).resolve().parent.parent
FREQUENCIES = 20
FACTOR = 3.0  # required: estimate within this factor of the true error
ROUNDING = 1e-9  # smaller true errors of frequencies are rounding
# smaller vibration errors are due to the step tolerance; they remain with all modes kept
STEPS = 5e-5
STUDIES = {"helical": ("reference scene", "cms_variants"), "frame": ("frame", "cms_variants_frame")}
# scene, window [s], overrides of the motion
SCENES = [("helical_170m", 3, []), ("helical_170m_source", 3, []), ("stress_170m", 3, []),
          ("vertical_1000m", 2, []), ("inclined_1000m", 2, []),
          ("frame", 2, ["Transient/Step=2e-4"])]
FREQUENCY_TOLERANCES = ("1e-2", "1e-3", "1e-4")
MOTION_TOLERANCE = "1e-2"


def settings(overrides):
    """Overrides as arguments: "PATH=VALUE" or "!PATH"."""
    arguments = []
    for text in overrides:
        arguments += ["--without", text[1:]] if text.startswith("!") else ["--set", text]
    return arguments


class Bench:
    """Runs of the program, kept in the work folder."""
    def __init__(self, options):
        self.program, self.work, self.limit = options.program, pathlib.Path(
            options.work).resolve(), options.limit
        self.changes, self.fresh = settings(options.set), options.fresh
        self.studies = {}
        if self.fresh:
            for kept in self.work.glob("*/done.json"):
                kept.unlink()
        self.work.mkdir(parents=True, exist_ok=True)

    def call(self, command, name, deck, arguments):
        """(folder, output, reason of a failure or "")."""
        folder = self.work / re.sub(r"[^A-Za-z0-9.]+", "_", name)
        kept = folder / "done.json"
        if kept.exists():
            done = json.loads(kept.read_text())
            if done["arguments"] == arguments:
                return folder, done["printed"], done["reason"]
        folder.mkdir(parents=True, exist_ok=True)
        begin = time.time()
        try:
            run = subprocess.run(
                [self.program, command,
                 str(deck), "--output",
                 str(folder), *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                text=True, check=False, timeout=self.limit)
        except subprocess.TimeoutExpired:
            print(f"{time.time() - begin:6.1f} s  {command} {name}: given up", flush=True)
            return folder, "", f"given up after {self.limit:g} s"
        said = re.sub(r"\n {2,}", " ", run.stderr.strip()).splitlines()  # joins wrapped lines
        reason = "" if run.returncode == 0 else (
            said or [f"ended with {run.returncode}"])[-1].removeprefix("tooljoint: ")
        print(
            f"{time.time() - begin:6.1f} s  {command} {name}" +
            (f": {reason[:120]}" if reason else ""), flush=True)
        kept.write_text(
            json.dumps({"arguments": arguments, "printed": run.stdout, "reason": reason}))
        return folder, run.stdout, reason

    def study(self, name):
        """The study of a scene, as plot_study reads it. It keeps its own runs."""
        if name not in self.studies:
            folder, begin = self.work / f"study_{name}", time.time()
            deck = PROJECT / f"xml/{STUDIES[name][1]}.xml"
            command = [
                self.program, "study",
                str(deck), "--output",
                str(folder), "--set", "Study/Pictures=false", *self.changes,
                *(["--fresh"] if self.fresh else [])
            ]
            code = subprocess.run(command, check=False).returncode
            if code:
                sys.exit(f"The study of {deck.name} ended with {code}.")
            print(f"{time.time() - begin:6.1f} s  study {deck.name}", flush=True)
            self.studies[name] = plot_study.Study(folder)
        return self.studies[name]


def outside(ratio):
    return not 1 / FACTOR <= abs(ratio) <= FACTOR


def machine():
    with open("/proc/cpuinfo", encoding="utf-8") as text:
        names = [line.split(":")[1].strip() for line in text if line.startswith("model name")]
    return f"{names[0] if names else platform.processor()}, {os.cpu_count()} cores, one rank"


def reduced_runs(study):
    return [run for run in study.all if run.kind == "method" and run.reduced]


def cell(value, form="{:.1e}"):
    return "-" if value is None else form.format(value)


def shown(run, column, form="{:.1e}"):
    return form.format(float(run.row[column])) if run.row[column] else ""


TABLE = ("run", "dofs", "frequency_error", "least_mac", "vibration_error",
         "cpu_per_simulated_s [s]", "setup_cpu [s]")


def write_csv(name, rows):
    with open(PROJECT / f"docs/tables/{name}.csv", "w", newline="", encoding="utf-8") as out:
        csv.writer(out, lineterminator="\n").writerows(rows)


def table(study):
    """One row of TABLE for each run, the reference first."""
    rows = []
    for run in study.all:
        if run.kind not in ("check", "sensitivity"):
            label = "full model, the reference" if run.kind == "reference" else run.label
            rows.append((label, run.row["reduced_dofs"], shown(run, "frequency_error"),
                         shown(run, "least_mac", "{:.2f}"), shown(run, "vibration_error"),
                         shown(run, "cpu_per_simulated_s",
                               "{:.3g}"), shown(run, "setup_cpu", "{:.2g}") if run.reduced else ""))
    return rows


def overview(rows):
    """Table with the run of smallest vibration error of each basis; `rows` are those of TABLE."""
    best = {}
    for row in rows[1:]:
        line = redraw_studies.line_of(row[0])
        if row[4] and (line not in best or float(row[4]) < float(best[line][4])):
            best[line] = row
    lines = [
        "| run with the smallest vibration error | dofs | largest error of 20 frequencies | "
        "vibration error | CPU [s] per simulated s | reduction [s] |", "|---|---|---|---|---|---|"
    ]
    lines += [
        "| " + " | ".join(cell or "-" for cell in (row[0], row[1], row[2], *row[4:])) + " |"
        for row in best.values()
    ]
    return "\n".join(lines) + "\n"


def tabulated(rows, name):
    """Writes all rows of a study to a CSV file and returns the overview with a link to it."""
    write_csv(name, [TABLE, *rows])
    return f"All {len(rows)} runs: [{name}.csv](tables/{name}.csv).\n\n" + overview(rows)


def failures(study):
    """Every run that failed, or could not be compared, with its reason."""
    failed = [(run.label, run.row["reason"]) for run in study.all if run.row["reason"]]
    if not failed:
        return "No run failed.\n"
    return "\n".join([
        "| failed | reason |", "|---|---|", *(f"| {label} | {reason.replace('|', '/')} |"
                                              for label, reason in failed)
    ]) + "\n"


def figure(study, name):
    plots.use_style()
    redraw_studies.save_small(plot_study.draw_bases(study), PROJECT / f"docs/figures/{name}.png")


def frequency_ratios(run):
    """(number of the mode, MAC, true error, estimate, complete, estimate / true error) of the modes
    whose true error is more than rounding."""
    curves = [run.curve(f"mode_{name}") for name in ("mac", "error", "estimate", "definite")]
    for i, (mac, error, estimate, definite) in enumerate(zip(*curves)):
        if abs(error) > ROUNDING:
            yield i + 1, mac, error, estimate, definite > 0, estimate / error


def motion_ratio(run):
    """estimate / vibration error; None without an estimate, or if the vibration error is below
    STEPS."""
    return run.number("estimated_vibration_error") / run.number("vibration_error") if run.row[
        "estimated_vibration_error"] and run.number("vibration_error") > STEPS else None


def estimate_rows(study, scene):
    """Counts for each line, and every exception."""
    counts, exceptions = {}, []
    for run in reduced_runs(study):
        if "interfaces" in run.line:  # estimates do not contain the error of an interface reduction
            continue
        count = counts.setdefault(run.line, [0, 0, [], 0, 0, []])
        for number, mac, error, estimate, complete, ratio in frequency_ratios(run):
            count[0] += 1
            count[2].append(abs(ratio))
            if outside(ratio):
                count[1] += 1
                exceptions.append(
                    (scene, run.label, f"frequency {number}, MAC {mac:.2f}", f"{error:.1e}",
                     f"{estimate:.1e}", f"{ratio:.3g}", "no" if complete else "yes"))
        ratio = motion_ratio(run)
        if ratio is not None:
            count[3] += 1
            count[5].append(ratio)
            if outside(ratio):
                count[4] += 1
                exceptions.append(
                    (scene, run.label, "vibration error", f"{run.number('vibration_error'):.1e}",
                     f"{run.number('estimated_vibration_error'):.1e}", f"{ratio:.3g}", ""))
    span = lambda values: f"{min(values):.2g} to {max(values):.2g}" if values else "-"
    rows = [
        f"| {scene} | {line} | {c[0]} | {c[1]} | {span(c[2])} | {c[3]} | {c[4]} | {span(c[5])} |"
        for line, c in counts.items() if c[0] + c[3] > 0
    ]
    return rows, exceptions


def tolerance_frequency(bench, scene, tolerance):
    """(row, met)."""
    folder, printed, reason = bench.call(
        "modes", f"tolerance {scene} {tolerance}", PROJECT / f"xml/{scene}.xml", [
            "--count",
            str(FREQUENCIES), "--without", "Reduction/Mode Selection", "--set",
            f"Reduction/Mode Selection/Frequency Tolerance={tolerance}"
        ])
    if reason:
        return f"| {scene} | {tolerance} | failed: {reason} | | | no |", False
    full, dofs = re.search(r"reduced +(\d+) dofs to (\d+)", printed).groups()
    with open(folder / "modes.csv", newline="", encoding="utf-8") as text:
        rows = list(csv.DictReader(text))
    error, estimated = (max(abs(float(row[name])) for row in rows)
                        for name in ("error", "estimate"))
    met = error <= float(tolerance)
    return (f"| {scene} | {tolerance} | {dofs} of {full} | {estimated:.1e} | {error:.1e} | "
            f"{'yes' if met else '**no**'} |"), met


def vibration_error_between(bench, folder, reference, end):
    done = subprocess.run(
        [bench.program, "compare",
         str(folder),
         str(reference), "--to",
         str(end), "--json"], stdout=subprocess.PIPE, text=True, check=True)
    return json.loads(done.stdout)["vibration_error"]


def tolerance_motion(bench, scene, end, more, tolerance):
    """(row, met): the transient of the chosen modes against the full one with the same steps."""
    deck = PROJECT / f"xml/{scene}.xml"
    common = [*settings([*more, f"Transient/End Time={end}"])
              ] + (["--set", "Output/XDMF=false"] if scene != "frame" else [])
    substructures = [] if scene == "frame" else ["--without", "Substructures"]
    full, _, reason = bench.call("run", f"motion full {scene} {end}", deck,
                                 [*common, "--without", "Reduction", *substructures])
    if reason:
        return (f"| {scene} | 0 to {end} s | {tolerance} | the full model failed: {reason} | | | "
                "no |"), False
    folder, _, reason = bench.call("run", f"motion {scene} {end} {tolerance}", deck, [
        *common, "--without", "Reduction/Mode Selection", "--set",
        f"Reduction/Mode Selection/Motion Tolerance={tolerance}"
    ])
    if reason:
        return f"| {scene} | 0 to {end} s | {tolerance} | failed: {reason} | | | no |", False
    summary = json.loads((folder / "summary.json").read_text())
    vibration_error, estimate = vibration_error_between(
        bench, folder, full, end), summary["reduction"]["estimate"]["motion_error"]
    met = vibration_error <= float(tolerance)
    return (f"| {scene} | 0 to {end} s | {tolerance} | {summary['reduction']['reduced_dofs']} of "
            f"{summary['model']['free_dofs']} | {cell(estimate)} | {vibration_error:.1e} | "
            f"{'yes' if met else '**no**'} |", met)


def scene_section(name, steps):
    def write(bench):
        study = bench.study(name)
        figure(study, f"cms_variants_{name}")
        own, timed = study.companion("check"), study.companion("reference")
        cost = (f"The steps alone ({steps}) cost a vibration error of "
                f"{own.number('vibration_error'):.1e} against RK4."
                ) if own else "The check of the reference failed."
        return (f"Machine: {machine()}; the reference took {timed.number('cpu'):.3g} s. {cost}\n\n"
                f"![errors](figures/cms_variants_{name}.png)\n\n" +
                tabulated(table(study), f"cms_variants_{name}") + "\n" + failures(study))

    return write


def estimates_section(bench):
    rows = [
        "| scene | basis | frequencies | outside | ratios | motions | outside | ratios |",
        "|---|---|---|---|---|---|---|---|"
    ]
    exceptions = [("scene", "run", "of", "true error", "estimate", "ratio", "said to lack a mode")]
    for name, (scene, _) in STUDIES.items():
        counts, found = estimate_rows(bench.study(name), scene)
        rows += counts
        exceptions += found
    write_csv("cms_variants_estimates", exceptions)
    return "\n".join(rows) + (f"\n\nThe {len(exceptions) - 1} exceptions: "
                              "[cms_variants_estimates.csv](tables/cms_variants_estimates.csv).\n")


def tolerance_section(bench):
    rows = [
        "| scene | tolerance | dofs | largest estimate | largest true error | met |",
        "|---|---|---|---|---|---|"
    ]
    for scene, _, _ in SCENES:
        rows += [
            tolerance_frequency(bench, scene, tolerance)[0] for tolerance in FREQUENCY_TOLERANCES
        ]
    motions = [
        "| scene | window | tolerance | dofs | estimated vibration error | vibration error | met |",
        "|---|---|---|---|---|---|---|"
    ]
    for scene, end, more in SCENES:
        motions.append(tolerance_motion(bench, scene, end, more, MOTION_TOLERANCE)[0])
    return f"The lowest {FREQUENCIES} coupled frequencies:\n\n" + "\n".join(
        rows) + "\n\nThe motion:\n\n" + "\n".join(motions) + "\n"


SECTIONS = {
    "helical": scene_section("helical", "0.25 ms"),
    "frame": scene_section("frame", "0.2 ms"),
    "estimates": estimates_section,
    "tolerance": tolerance_section,
}


def short_test(bench):
    """Few bases on the frame, tolerances there and on 0.05 s of the reference scene."""
    faults = []
    chosen = ("Craig-Bampton", "MacNeal", "Rubin", "Dual Craig-Bampton", "Enhanced, free")
    deck = (PROJECT / f"xml/{STUDIES['frame'][1]}.xml").read_text(encoding="utf-8")
    every = re.findall(r'^      <ParameterList name="(.*)">',
                       deck[deck.index('<ParameterList name="Methods">'):], re.M)
    bench.changes += settings([
        "Study/Repeats=1", "Study/End Time=0.5", "Study/Check/Set={Transient/Step=0.1 ms}",
        *(f"!Study/Methods/{name}" for name in every if name not in chosen),
        *(f"Study/Methods/{name}/Sweep/modes/Values={{8, 12}}" for name in chosen)
    ])
    study = bench.study("frame")
    full = study.companion("reference").number("reduced_dofs")
    for run in reduced_runs(study):
        if run.row["reason"]:
            faults.append(f"{run.label}: {run.row['reason']}")
            continue
        if not run.number("reduced_dofs") <= full + (60 if run.line.startswith("Dual") else 0):
            faults.append(f"{run.label}: {run.row['reduced_dofs']} dofs")
        if run.line not in ("MacNeal", "Dual Craig-Bampton"):  # these have no estimates
            wrong = [ratio for *_, ratio in frequency_ratios(run) if outside(ratio)]
            if wrong:
                faults.append(f"{run.label}: estimates of frequencies off by the factors "
                              f"{', '.join(f'{ratio:.2g}' for ratio in wrong)}")
            if not run.row["estimated_vibration_error"] or outside(motion_ratio(run) or 1.0):
                faults.append(f"{run.label}: vibration error {run.row['vibration_error']}, "
                              f"estimate {run.row['estimated_vibration_error']}")
    for line in chosen:
        mine = [run.number("frequency_error") for run in reduced_runs(study) if run.line == line]
        if len(mine) != 2 or not mine[1] < mine[0]:
            faults.append(f"{line}: twelve modes are not better than eight")
    for row, met in (
            tolerance_frequency(bench, "frame", "1e-3"),
            tolerance_frequency(bench, "helical_170m", "1e-3"),
            tolerance_motion(bench, "frame", 0.5, ["Transient/Step=2e-4"], "1e-2"),
            tolerance_motion(bench, "helical_170m", 0.05, [], "1e-2"),
    ):
        print(row)
        if not met:
            faults.append(row)
    print("\n".join(["", f"{len(faults)} failed", *faults]))
    return 1 if faults else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True, help="the tooljoint program")
    parser.add_argument("--work", default="results/cms_variants", help="folder for the runs")
    parser.add_argument("--only", default=",".join(SECTIONS), help="sections to write")
    parser.add_argument("--set", action="append", default=[], metavar="PATH=VALUE",
                        help="an override of both studies; \"!PATH\" removes an entry")
    parser.add_argument("--fresh", action="store_true", help="repeat the runs in that folder")
    parser.add_argument("--limit", type=float, default=90.0,
                        help="time limit [s] of a run of the tolerances")
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
        page.write_text(
            marked.sub(lambda match: match.group(1) + "\n" + section + "\n" + match.group(2), text),
            encoding="utf-8")
    subprocess.run(
        [sys.executable, str(PROJECT / "tests/lint/wrap.py"), "--update",
         str(page)], check=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
