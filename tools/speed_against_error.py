#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reruns the studies of speed against error and the benchmarks, and rewrites
docs/speed-against-error.md with its figures.

    tools/speed_against_error.py --program build/release/tooljoint --benchmarks
        build/release/benchmarks [--work results/speed]
                                 [--only helical,stress,vertical,inclined] [--no-run]

Studies continue where they stopped: rows that are already in the work folder are not run again
(delete it to start again). The machine must have no other load. The document is written from the
work folder; studies missing there are listed as missing. Text between the markers for notes is
kept.
"""
import argparse
import csv
import json
import math
import pathlib
import platform
import shutil
import statistics
import subprocess
import sys

PROJECT = pathlib.Path(__file__).resolve().parent.parent
DOCUMENT = PROJECT / "docs/speed-against-error.md"
FIGURES = PROJECT / "docs/figures"
TABLES = PROJECT / "docs/tables"
COLUMNS = [
    "run", "dofs", "vibration_error", "eps_n_max", "cpu_per_simulated_s [s]", "cpu_spread",
    "speedup_baseline", "speedup_best_full", "steps", "remarks"
]
STUDIES = {
    "helical": ("study_helical_170m", "Reference scene: 170 m in a helical well"),
    "stress": ("stress_170m", "Stress scene: the same string with lively whirl and impacts"),
    "vertical": ("vertical_1000m", "A kilometre hanging, collars inclined by 3 degrees"),
    "inclined": ("inclined_1000m", "A kilometre inclined by 3 degrees, every joint on the wall"),
}
BASELINE = "RK4 adaptive, Tolerance 1e-2"


class Study:
    def __init__(self, folder):
        self.summary = json.loads((folder / "summary.json").read_text())
        with open(folder / "study.csv", newline="") as table:
            self.rows = list(csv.DictReader(table))
        self.reference = self.summary["reference"]

    def done(self, *lines, model=None):
        return [
            row for row in self.rows
            if row["kind"] == "method" and row["status"] == "done" and row["vibration_error"] and (
                not lines or row["line"] in lines) and (model is None or row["model"] == model)
        ]

    def baseline(self):
        return next((row for row in self.done() if row["label"] == BASELINE), None)

    def fastest(self, rows, error):
        fit = [row for row in rows if float(row["vibration_error"]) <= error]
        return min(fit, key=lambda row: float(row["cpu [s]"]), default=None)


def cpu(row):
    return float(row["cpu [s]"])


def percent(value):
    value = 100 * float(value)
    return (f"{value:.2g} %"
            if value < 0.0995 else f"{value:.2f} %" if value < 10 else f"{value:.0f} %")


def table(head, lines):
    return "\n".join(["| " + " | ".join(head) + " |", "|" + "---|" * len(head)] +
                     ["| " + " | ".join(line) + " |" for line in lines]) + "\n"


def against(study, rows, others, error, what):
    """Fastest of `rows` within the error against the fastest of `others` within it."""
    mine, other = study.fastest(rows, error), study.fastest(others, error)
    if mine is None or other is None:
        return (f"{what}: no run of {'ours' if mine is None else 'the other method'} is within "
                f"{percent(error)}")
    return (f"{what}: **{cpu(other) / cpu(mine):.3g}x** ({mine['label']}, {cpu(mine):.3g} s, "
            f"vibration error {percent(mine['vibration_error'])}; {other['label']}, "
            f"{cpu(other):.3g} s, vibration error {percent(other['vibration_error'])})")


def time_at(rows, error):
    """CPU time at an error, interpolated log-log between the runs on either side of it; None
    without such runs."""
    points = sorted((float(row["vibration_error"]), cpu(row)) for row in rows)
    for (low, slow), (high, fast) in zip(points, points[1:]):
        if low <= error <= high:
            part = math.log(error / low) / math.log(high / low)
            return math.exp((1 - part) * math.log(slow) + part * math.log(fast))
    return None


def against_at(curves, others, error):
    """Times of two methods at the same error; `curves` are ours, and the fastest counts."""
    times = [time for time in (time_at(rows, error) for rows in curves) if time is not None]
    mine, other = min(times, default=None), time_at(others, error)
    if mine is None or other is None:
        return (f"no runs of {'ours' if mine is None else 'the other method'} on both sides of "
                f"{percent(error)}")
    return (f"**{other / mine:.3g}x** ({mine:.3g} s against {other:.3g} s, both between the two "
            "runs nearest in error)")


def implicit_lines(study):
    """Our implicit runs of the full model by line: one line for each choice of steps and of the
    stopping criterion."""
    lines = {}
    for row in study.done(model="full"):
        if row["integrator"] == "Generalized-alpha":
            lines.setdefault(row["line"], []).append(row)
    return list(lines.values())


def implicit(study):
    return [row for line in implicit_lines(study) for row in line]


def speed_targets(studies):
    lines = []
    if "helical" in studies:
        study = studies["helical"]
        base = [study.baseline()]
        for error, target in ((1e-2, "40 [100]"), (2.5e-3, "20 [50]")):
            lines.append((f"full model, reference scene, vibration error <= {percent(error)}, "
                          "against RK4 adaptive", target,
                          against(study, implicit(study), base, error, "CPU time")))
    if "stress" in studies:
        study = studies["stress"]
        lines.append(("stress scene, vibration error <= 0.5 %, against RK4 adaptive", "20 [60]",
                      against(study, implicit(study), [study.baseline()], 5e-3, "CPU time")))
        for name, line, target in (
            ("ARKODE ESDIRK4", "SUNDIALS ARKODE ESDIRK4, full", "5 [20]"),
            ("CVODE BDF of orders 1 and 2", "SUNDIALS CVODE BDF2, full", "50 [200]"),
        ):
            lines.append((f"stress scene, vibration error = 1 %, against {name}", target,
                          against_at(implicit_lines(study), study.done(line), 1e-2)))
        lines.append(
            ("stress scene, vibration error <= 1 %, against CVODE BDF as it comes (orders 1 to 5)",
             "50 [200]",
             against(study, implicit(study), study.done("SUNDIALS CVODE BDF5, full"), 1e-2,
                     "CPU time")))
    if "helical" in studies:
        study = studies["helical"]
        row = study.fastest(implicit(study), 1e-2)
        if row is not None:
            lines.append((f"reference scene, vibration error <= 1 %, {study.reference['end']:g} s",
                          "10 [25]", f"**{1 / float(row['cpu_per_simulated_s']):.3g}x** real time "
                          f"on one core ({row['label']}, vibration error "
                          f"{percent(row['vibration_error'])})"))
        lines += basis_target(study)
    for name, target in (
        ("helical", "0.9 [1.2]"),
        ("vertical", "3 [5]"),
        ("inclined", "1.5 [2.5]"),
    ):
        if name in studies:
            lines.append(("reduced against the best full-model implicit run of the same vibration "
                          f"error, {name} scene", target, reduced_target(studies[name])))
    return lines


def basis_target(study):
    rows = {(row["sweep"].split("Initial State=")[-1].split(";")[0]): row for row in study.done()
            if row["line"].startswith("Basis of Nguyen et al. 2020") and row["modes"] == "180"}
    if "Least squares" not in rows or "Keep static" not in rows:
        return []
    poor, good = rows["Least squares"], rows["Keep static"]
    return [("static state kept against least squares, eta = 180", "20 [40]", "vibration error "
             f"**{float(poor['vibration_error']) / float(good['vibration_error']):.3g}x** smaller "
             f"({percent(good['vibration_error'])} against {percent(poor['vibration_error'])}) at "
             f"{cpu(good) / cpu(poor):.2f} of the cost")]


def reduced_target(study):
    """Ratio of the time of the full-model curve, interpolated at the vibration error of the reduced
    run, to that of the reduced run: the best within 2 %, and within 5 % if better."""
    rows = [
        row for row in study.done(model="reduced") if row["integrator"] == "Generalized-alpha"
        and row["speedup_best_full"] and "Nguyen" not in row["line"]
    ]
    factor = lambda row: float(row["speedup_best_full"])
    best = [
        max((row
             for row in rows if float(row["vibration_error"]) <= error), key=factor, default=None)
        for error in (2e-2, 5e-2)
    ]
    if best[1] is None:
        return f"no reduced run within {percent(5e-2)} has a full run of the same vibration error"
    shown = [row for i, row in enumerate(best) if row is not None and row not in best[:i]]
    return "; ".join(f"**{factor(row):.2f}x** ({row['label']}, {row['reduced_dofs']} dofs, "
                     f"{cpu(row):.3g} s, vibration error "
                     f"{percent(row['vibration_error'])})" for row in shown)


def cost(results, name):
    """Median over the repetitions [ns per step and dof]."""
    values = [
        run["ns/step/dof"] for run in results
        if run.get("run_type", "iteration") == "iteration" and run["name"].startswith(name + "/")
    ]
    return statistics.median(values) if values else None


def benchmark_targets(results):
    times = {}
    for run in results:
        if run.get("run_type", "iteration") == "iteration" or run.get("aggregate_name") == "min":
            unit = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}[run["time_unit"]]
            name = run.get("run_name", run["name"]).replace("/manual_time", "")
            times[name] = min(
                times.get(name, 1e9),
                (run["real_time"] if "manual_time" in run["name"] else run["cpu_time"]) * unit)
    lines = []
    for window, what in enumerate(
        ("falling from the centre line, to the first contacts", "in contact")):
        per = {n: cost(results, f"longString/{n}/{window}") for n in (162, 1620, 16200)}
        if all(per.values()):
            nano = ", ".join(f"{per[n]:.3g}" for n in per)
            lines.append((f"cost per step and dof, 1e4 to 1e5 dofs, {what}", "within 1.5",
                          f"**{per[16200] / per[1620]:.2f}** ({nano} ns at 1e3, 1e4, 1e5)"))
            lines.append((f"cost per step and dof, 1e3 to 1e5 dofs, {what}", "within 2.5",
                          f"**{per[16200] / per[162]:.2f}**"))
    if "rightHandSide/0" in times:
        lines.append(
            ("right-hand side of the full reference model, steady and varying speed", "30 [12] us",
             " and ".join(f"**{1e6 * times[f'rightHandSide/{n}']:.3g} us**" for n in (1, 0))))
    steps = [(name, 1e6 * value) for name, value in times.items()
             if name.startswith("generalizedAlphaStep")]
    if steps:
        # 0.25 s of motion in steps of 1 ms
        lines.append(
            ("a generalized-alpha step of 1 ms (steady or varying speed, without or with ledger)",
             "100 [40] us", ", ".join(
                 f"{name.split('/', 1)[1]}: **{value / 250:.3g} us**" for name, value in steps)))
    return lines


def study_section(name, study, folder):
    """Pictures, then the runs, and a file with all runs."""
    deck, title = STUDIES[name]
    reference = study.reference
    text = [f"## {title}\n"]
    for figure, abscissa in (("speed", "CPU time"), ("modes", "the number of modes")):
        source = folder / f"study_{figure}.svg"
        if source.exists():
            FIGURES.mkdir(exist_ok=True)
            shutil.copyfile(source, FIGURES / f"{figure}_{name}.svg")
            text.append(f"![Error against {abscissa}](figures/{figure}_{name}.svg)\n")
    text.append(f"`tooljoint study xml/{deck}.xml`. Reference: {reference['integrator']} with "
                f"steps of {1e6 * reference['max_step']:.3g} us ({reference['cpu_s']:.3g} s CPU); "
                "another method at a tight step differs from it by a vibration error of "
                f"{reference['self_error']['vibration_error']:.2g} over "
                f"{reference['window_begin']:g} to {reference['window_end']:g} s, and a start "
                f"moved by {reference['sensitivity']['perturbation']:g} m changes it by a "
                f"vibration error of {reference['sensitivity']['vibration_error']:.2g} there and "
                f"by {reference['sensitivity']['at_end']:.2g} m at {reference['end']:g} s.\n")
    rows = list(map(table_row, (row for row in study.rows if row["kind"] == "method")))
    TABLES.mkdir(exist_ok=True)
    with open(TABLES / f"speed_{name}.csv", "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([COLUMNS, *rows])
    text.append(f"All {len(rows)} runs: [tables/speed_{name}.csv](tables/speed_{name}.csv).\n")
    return "\n".join(text)


def table_row(row):
    """A run as a row of its table; for a failed run the reason is in the last column."""
    if row["status"] != "done":
        return [row["label"], row["reduced_dofs"], *[""] * 7, f"{row['status']}: {row['reason']}"]
    troubles = [
        f"{row[key]} {key.split('_')[0]}"
        for key in ("halved", "rejected", "unconverged_steps", "missed_nodes")
        if row[key] not in ("", "0")
    ]
    numbers = [
        f"{float(row[key]):.3g}" if row[key] else ""
        for key in ("vibration_error", "eps_n_max", "cpu_per_simulated_s", "cpu_spread",
                    "speedup_baseline", "speedup_best_full")
    ]
    return [row["label"], row["reduced_dofs"], *numbers, row["steps"], "; ".join(troubles)]


def machine():
    lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    model = next((line.split(":")[1].strip() for line in lines if line.startswith("model name")),
                 platform.processor())
    processors = sum(line.startswith("processor") for line in lines)
    return f"{model}, {processors} processors, {platform.system()} {platform.release()}"


def document(studies, work, results):
    lines = [[what, target, measured]
             for what, target, measured in speed_targets(studies) + benchmark_targets(results)]
    missing = [STUDIES[name][0] for name in STUDIES if name not in studies]
    text = [
        "# Speed against error\n", "Written by `tools/speed_against_error.py`, which reruns all "
        "of it. Every time stands beside its error; a run that failed stays in its table with the "
        "reason. The vibration error is the largest error of the lateral displacements over the "
        "stated window, relative to how far the string moved ([file formats](file-formats.md)); "
        "beyond the window, where neighbouring motions part, the studies compare statistics. "
        "Times are CPU seconds of the time integration on one core, the shortest of interleaved "
        f"repeats; \"spread\" is how much longer the longest was. The baseline is `{BASELINE}` on "
        "the full model, which is as block-tridiagonal, and whose matrices and contact kernels "
        "are as fast, as those of the implicit runs.\n", f"Machine: {machine()}.\n"
    ]
    if missing:
        text.append("Missing here (not run): " + ", ".join(missing) + ".\n")
    text += [study_section(name, study, work / name) for name, study in studies.items()]
    text += [
        "## Against what was aimed at\n",
        "First figure: aim, in brackets: what would be excellent.\n",
        table(["what", "aim", "measured"], lines)
    ]
    text.append(notes())
    DOCUMENT.write_text("\n".join(text))
    subprocess.run([sys.executable,
                    str(PROJECT / "tests/lint/wrap.py"), "--update",
                    str(DOCUMENT)], check=True)


def notes():
    """Handwritten text between the two markers, which is kept."""
    old = DOCUMENT.read_text() if DOCUMENT.exists() else ""
    if "<!-- notes -->" not in old:
        return "<!-- notes -->\n<!-- end of notes -->\n"
    return old[old.index("<!-- notes -->"):old.index("<!-- end of notes -->"
                                                     )] + "<!-- end of notes -->\n"


def run_studies(options):
    for name in options.only:
        folder = options.work / name
        command = [
            options.program, "study",
            str(PROJECT / f"xml/{STUDIES[name][0]}.xml"), "--output",
            str(folder)
        ]
        print(" ".join(command), flush=True)
        done = subprocess.run(command, check=False)
        if done.returncode != 0:
            sys.exit(f"The study of {STUDIES[name][0]} ended with {done.returncode}.")
        subprocess.run(
            [sys.executable, str(PROJECT / "tools/plot_study.py"),
             str(folder)], check=True)


def run_benchmarks(options):
    output = options.work / "kernels.json"
    subprocess.run([
        str(pathlib.Path(options.benchmarks) / "benchmark_TransientKernels"),
        "--benchmark_repetitions=3",
        "--benchmark_filter=rightHandSide/|generalizedAlphaStep|longString",
        f"--benchmark_out={output}", "--benchmark_out_format=json"
    ], check=True, stdout=subprocess.DEVNULL)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/release/tooljoint")
    parser.add_argument("--benchmarks", default="build/release/benchmarks",
                        help="folder of the benchmark programs")
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("results/speed"))
    parser.add_argument("--only", type=lambda text: text.split(","), default=list(STUDIES),
                        help="studies to run, separated by commas")
    parser.add_argument("--no-run", action="store_true", help="only rewrite the document")
    options = parser.parse_args()
    for name in options.only:
        if name not in STUDIES:
            parser.error(f"no study \"{name}\": there are {', '.join(STUDIES)}")
    options.work.mkdir(parents=True, exist_ok=True)
    if not options.no_run:
        run_studies(options)
        run_benchmarks(options)
    studies = {
        name: Study(options.work / name) for name in STUDIES
        if (options.work / name / "study.csv").exists()
    }
    kernels = options.work / "kernels.json"
    document(studies, options.work,
             json.loads(kernels.read_text())["benchmarks"] if kernels.exists() else [])


if __name__ == "__main__":
    main()
