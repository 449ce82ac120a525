#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the step error, which decides whether a run is accepted, with the true error, and writes
docs/step-error.md with its figure.

    tools/step_accuracy.py --program build/release/tooljoint [--work results/step_error] [--short]
        [--walls] [--seconds S]

Each run of 3 s has a reference: the same model with steps of 0.125 ms and a tolerance of 1e-8. The
error is the vibration error that `tooljoint compare` prints, less the sensitivity of the reference:
the vibration error of the reference itself when the weight on bit changes by 1e-4. If the
sensitivity is above 5 %, the motion is chaotic. The error is then the difference of two means from
1 s on, the rms lateral speed and the impulse per second, over 16 runs with weights on bit 1e-4
apart, less the half-width of the 95 % interval of the difference. Runs that are already in the work
folder are not repeated. --short takes one scene and few steps, and only prints the table; --walls
takes only walls that are too stiff for the steps, and renews their chapter; --seconds stops after
that many seconds and writes the results so far.
"""
import argparse
import json
import math
import os
import pathlib
import re
import subprocess
import time

import h5py
import numpy as np

import plots

os.environ.setdefault("TOOLJOINT_REPORT", "off")  # reports of these runs are not needed

PROJECT = pathlib.Path(__file__).resolve().parent.parent
DOCUMENT = PROJECT / "docs/step-error.md"
FIGURE = PROJECT / "docs/figures/step_error.svg"
MODELS = {"full": ["--without", "Reduction", "--without", "Substructures"], "reduced": []}
STEPS = ("1e-3", "2e-3", "2.5e-3", "5e-3", "1e-2", "2e-2")
WAYS = {
    "usual": {},
    "r 0.2": {"Spectral Radius": "0.2"},
    "r 1": {"Spectral Radius": "1"},
    "tolerance 1e-3": {"Tolerance": "1e-3"},
    "uncorrected": {"Phase Correction": "false"},
}
ORDINARY = tuple(WAYS)
WAYS["r 0.5"] = {"Spectral Radius": "0.5"}
REFERENCE = ("1.25e-4", {"Tolerance": "1e-8"})
SECONDS, MEANS_FROM = 3.0, 1.0  # length of a run, start of the means [s]
# runs of an ensemble, relative difference of their weights on bit
NEIGHBOURS, DISTURBANCE = 16, 1e-4
CHAOTIC = 0.05  # sensitivity of a reference above which means are compared
BANDS = ((0.0, 0.02), (0.02, 0.2), (0.2, 0.5), (0.5, float("inf")))
REFUSED = re.compile(r"is too large: step error (?:at least )?(\S+) %")
SAID = re.compile(r"The time step \(\S+ s\) is (coarse|too large)|The scheme damps vibration")
STEP_ERROR = re.compile(r"(?:estimated|step\s+error(?:\s+at\s+least)?)\s+(\S+)\s+%(?!:)")  # S
DIFFERENCE = re.compile(r"differs\s+by\s+(\S+)\s+%")
SPEEDS_SAID = re.compile(r"damping,\s+at\s+(\S+)\s+%\s+of\s+its\s+speed")
DISTURBED = re.compile(r"changes\s+that\s+by\s+(\S+)\s+%")


class Case:
    """A deck, its overrides, and the steps and ways it is run with."""
    def __init__(self, name, deck, settings, steps=STEPS, ways=ORDINARY):
        self.name, self.deck, self.settings = name, deck, settings
        self.steps, self.ways = steps, ways


SCENES = [
    Case(deck, deck, {})
    for deck in ("helical_170m", "stress_170m", "vertical_1000m", "inclined_1000m")
]
SPEEDS = [
    Case(f"{deck}, {rpm} rpm", deck, {"Rotary Speed/Exponential/Final Speed": f"{rpm} rpm"},
         ways=("usual", "uncorrected")) for deck in ("helical_170m", "stress_170m")
    for rpm in ("30", "200")
]
STICKING = [
    Case(
        f"{deck}, sticking, {rpm} rpm", deck, {
            "Contact/Friction/Regularisation Velocity": "1e-4",
            "Rotary Speed/Exponential/Final Speed": f"{rpm} rpm"
        }, ("1e-3", "5e-3"), ("usual",)) for deck in ("helical_170m", "stress_170m")
    for rpm in ("0.5", "1")
]


def walls(name, deck, stiffness, **settings):
    return Case(
        f"{deck}, {name}", deck, {
            "Contact/Stiffness": stiffness,
            **{key.replace("__", "/").replace("_", " "): value for key, value in settings.items()}
        }, ("1e-3", "2.5e-3", "5e-3", "1e-2"), ("usual", "r 0.5"))


INCLINED = "inclined_1000m"
WALLS = [
    walls("3e7 N/m", INCLINED, "3e7"),
    walls("1e8 N/m", INCLINED, "1e8"),
    walls("1e9 N/m", INCLINED, "1e9"),
    walls("1e8 N/m, 1 degree", INCLINED, "1e8", Well__Vertical__Inclination="1 deg"),
    walls("1e8 N/m, 10 degrees", INCLINED, "1e8", Well__Vertical__Inclination="10 deg"),
    walls("1e8 N/m, friction 0.25 and 0.2", INCLINED, "1e8", Contact__Friction__Static=0.25,
          Contact__Friction__Dynamic=0.2),
    walls("1e8 N/m, without damping", INCLINED, "1e8", Contact__Damping=0),
    walls("1e9 N/m", "helical_170m", "1e9"),
    walls("1e8 N/m, friction 0.7", "stress_170m", "1e8", Contact__Friction__Static=0.7,
          Contact__Friction__Dynamic=0.7)
]
CHAPTER = "## Walls too stiff for the step"


class Run:
    """A run of a case, the `neighbour`-th of its ensemble; the first has the weight on bit of the
    deck."""
    def __init__(self, options, case, model, step, own, neighbour=0):
        name = "_".join(
            [case.name, model, step, *own.values(), *[f"neighbour {neighbour}"] * (neighbour > 0)])
        self.name = re.sub("[^0-9A-Za-z.+-]+", "_", name)
        self.case, self.model, self.step, self.own = case, model, step, own
        self.folder = pathlib.Path(options.work) / self.name
        log = self.folder.parent / (self.name + ".log")
        if not log.exists():
            settings = {
                "Transient/End Time": SECONDS, "Transient/Step": step,
                "Transient/Sampling Interval": 0.02, "Transient/Progress": "false",
                "Transient/Energy Residual Limit": 1e9, "Output/XDMF": "false",
                **{f"Transient/Generalized-alpha/{key}": value for key, value in own.items()},
                **case.settings
            }
            if neighbour:
                weight = re.search(r'"Weight On Bit"[^>]*value="([0-9.e+]+) kN"',
                                   (PROJECT / f"xml/{case.deck}.xml").read_text())
                settings["Loads/Weight On Bit"] = (
                    f"{float(weight.group(1)) * (1 + DISTURBANCE * neighbour)} kN")
            done = subprocess.run([
                options.program, "run",
                str(PROJECT / f"xml/{case.deck}.xml"), "--output",
                str(self.folder), *MODELS[model],
                *[f"--set={key}={value}" for key, value in settings.items()]
            ], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
            self.folder.parent.mkdir(parents=True, exist_ok=True)
            log.write_text(done.stdout)
        said, summary = " ".join(log.read_text().split()), json.loads(
            (self.folder / "summary.json").read_text())
        refused = REFUSED.search(said)
        self.refused = refused is not None
        self.warned = not self.refused and SAID.search(said) is not None
        self.finished = summary["status"] == "finished" or self.refused
        self.error = None
        known = STEP_ERROR.search(said)
        self.step_error = float(
            refused.group(1)) / 100 if self.refused else summary["transient"]["step_error"] or 0.0
        self.estimate = float(known.group(1)) / 100 if known else self.step_error
        compared = DIFFERENCE.search(said)
        self.difference = float(compared.group(1)) / 100 if compared else None
        speeds, disturbed = SPEEDS_SAID.search(said), DISTURBED.search(said)
        self.speeds = float(speeds.group(1)) / 100 if speeds else None
        self.disturbed = float(disturbed.group(1)) / 100 if disturbed else None

    def verdict(self):
        return "refused" if self.refused else "warned" if self.warned else "silent"

    def kept(self, what, compute):
        """A number of the run, computed once and stored with it."""
        file = self.folder.parent / f"{self.name}.{what}"
        if not file.exists():
            file.write_text(json.dumps(compute()))
        return json.loads(file.read_text())

    def vibration_error(self, options, reference):
        def compare():
            done = subprocess.run([
                options.program, "compare",
                str(self.folder),
                str(reference.folder), "--to",
                str(SECONDS), "--json"
            ], stdout=subprocess.PIPE, text=True, check=True)
            return json.loads(done.stdout)["vibration_error"]

        return self.kept("error", compare)

    def means(self):
        """Root mean square of the lateral speed [m/s], and impulse per second [N]."""
        def compute():
            with h5py.File(self.folder / "results.h5", "r") as file:
                late = file["transient/time"][:] >= MEANS_FROM
                u, v = (file["transient/velocity"][:][late][..., component] for component in (0, 1))
                return [
                    float(np.sqrt(np.mean(u**2 + v**2))),
                    float(file["transient/normal_force"][:][late].sum(axis=1).mean())
                ]

        return self.kept("means", compute)

    def forget(self):
        for file in self.folder.glob("*.h5"):
            file.unlink()


class Truth:
    """The reference of a case, its sensitivity, and an ensemble if the motion is chaotic."""
    def __init__(self, options, case, model):
        self.runs = [Run(options, case, model, *REFERENCE, neighbour) for neighbour in (0, 1)]
        self.finished = all(run.finished for run in self.runs)
        if not self.finished:
            return
        self.sensitivity = self.runs[1].vibration_error(options, self.runs[0])
        self.chaotic = self.sensitivity > CHAOTIC
        if self.chaotic:
            self.runs += [
                Run(options, case, model, *REFERENCE, neighbour)
                for neighbour in range(2, NEIGHBOURS)
            ]
            self.means = np.array([run.means() for run in self.runs if run.finished])

    def error_of(self, options, run):
        if not self.chaotic:
            return max(0.0, run.vibration_error(options, self.runs[0]) - self.sensitivity)
        others = [
            Run(options, run.case, run.model, run.step, run.own, neighbour)
            for neighbour in range(1, NEIGHBOURS)
        ]
        found = np.array([one.means() for one in [run, *others] if one.finished])
        for one in others:
            one.forget()
        scatter = 1.96 * np.sqrt(
            found.var(axis=0, ddof=1) / len(found) +
            self.means.var(axis=0, ddof=1) / len(self.means))
        away = np.abs(found.mean(axis=0) - self.means.mean(axis=0))
        return float((np.maximum(0, away - scatter) / self.means.mean(axis=0)).max())


def measured(options, cases, models):
    """All finished runs with their errors, and the number of runs that did not finish."""
    runs, ended = [], 0
    for way in WAYS:  # the usual way of all cases first
        for case in cases:
            for model in models if way in case.ways else ():
                if time.monotonic() > options.end:
                    return runs, ended
                truth = Truth(options, case, model)
                if not truth.finished:
                    print(f"{truth.runs[0].name}: ended before its time", flush=True)
                    continue
                for step in case.steps:
                    run = Run(options, case, model, step, WAYS[way])
                    if not run.finished:
                        ended += 1
                        print(f"{run.name}: ended before its time", flush=True)
                        continue
                    run.error, run.chaotic = truth.error_of(options, run), truth.chaotic
                    run.forget()
                    runs.append(run)
                    print(
                        f"{run.name}: error {100 * run.error:.3g} %{' of means' * run.chaotic}, "
                        f"step error {100 * run.step_error:.3g} %, S {100 * run.estimate:.3g} %, "
                        f"{run.verdict()}", flush=True)
    return runs, ended


def percent(x):
    return f"{100 * x:.2g}" if x < 0.995 else f"{100 * x:.0f}"


def cases(runs):
    """The decks of the runs, one line each, with their models and overrides."""
    lines = ""
    for deck in sorted({run.case.deck for run in runs}):
        own = [run for run in runs if run.case.deck == deck]
        changes = sorted({run.case.name[len(deck) + 2:] for run in own} - {""})
        lines += (f"- {deck}, {' and '.join(sorted({run.model for run in own}))}: "
                  f"{'; '.join(['as it is', *changes])}\n")
    return lines


def table(runs):
    """Runs by their error: ranges of the step error, of S and D, and the verdicts."""
    lines = [
        "| error | runs | step error | estimate S | compared | difference D | silent | warned | "
        "refused |", "|---|---|---|---|---|---|---|---|---|"
    ]
    for low, high in BANDS:
        band = [run for run in runs if low <= run.error < high]
        if not band:
            continue
        compared = [run.difference for run in band if run.difference is not None]
        ranges = [
            f"{percent(min(found))} to {percent(max(found))} %" if found else ""
            for found in ([run.step_error for run in band], [run.estimate for run in band],
                          compared)
        ]
        counts = [
            sum(run.verdict() == word for run in band) for word in ("silent", "warned", "refused")
        ]
        title = (f"below {percent(high)} %" if low == 0 else f"above {percent(low)} %"
                 if high == float("inf") else f"{percent(low)} to {percent(high)} %")
        lines.append(f"| {title} | {len(band)} | {ranges[0]} | {ranges[1]} | {len(compared)} | "
                     f"{ranges[2]} | {counts[0]} | {counts[1]} | {counts[2]} |")
    return "\n".join(lines) + "\n"


def outliers(runs):
    """Runs with errors above 20 % without a warning, above 50 % that are not refused, or below 2 %
    that are refused."""
    wrong = [
        run for run in runs if (run.error > 0.2 and run.verdict() == "silent") or (
            run.error > 0.5 and not run.refused) or (run.error < 0.02 and run.refused)
    ]
    if not wrong:
        return ("Nothing above 20 % passes silently, nothing above 50 % passes, nothing below 2 % "
                "is refused.\n")
    return "Judged wrongly:\n\n" + "".join(f"- {run.name}: error {percent(run.error)} "
                                           f"%{' of means' * run.chaotic}, step error "
                                           f"{percent(run.step_error)} %, "
                                           f"{run.verdict()}\n" for run in wrong)


def wall_chapter(runs):
    """One row for each run: error, verdict and measurements."""
    rows = "".join(f"| {run.case.name} | {1e3 * float(run.step):g} | "
                   f"{run.own.get('Spectral Radius', '0.8')} | {percent(run.error)} "
                   f"%{' of means' * run.chaotic} | {percent(run.step_error)} % | "
                   f"{percent(run.estimate)} % | "
                   f"{'' if run.difference is None else percent(run.difference) + ' %'} | "
                   f"{'' if run.speeds is None else f'{run.speeds:g}'} | "
                   f"{'' if run.disturbed is None else percent(run.disturbed) + ' %'} | "
                   f"{run.verdict()} |\n" for run in runs)
    return (f"{CHAPTER}\n\nFull models, {SECONDS:g} s, with errors as above; r is the speed over "
            "that in the shorter steps, s what a disturbance of 0.1 % changes\n"
            f"there. Written by `tools/step_accuracy.py --walls`.\n\n{outliers(runs)}\n"
            "| walls | step [ms] | spectral radius | error | step error | S | D | r | s | said |\n"
            "|---|---|---|---|---|---|---|---|---|---|\n" + rows)


def renewed(text, chapter):
    """The document with the chapter at its end."""
    added = "\n" + chapter.rstrip() + "\n" if chapter else ""
    return text.split("\n" + CHAPTER)[0].rstrip() + "\n" + added


def figure(runs, bounds):
    plots.use_style()
    drawing, axes = plots.figure(7, 5)

    for name, colour, marker in zip(sorted({run.case.deck for run in runs}), plots.COLOURS,
                                    plots.MARKERS):
        rows = [run for run in runs if run.case.deck == name]
        for chaotic in (False, True):
            some = [run for run in rows if run.chaotic == chaotic]
            axes.plot([max(run.step_error, 1e-4) for run in some],
                      [max(run.error, 1e-4) for run in some], marker, markersize=3, color=colour,
                      fillstyle="none" if chaotic else "full",
                      label=name + ", means" * chaotic if some else None)
    for bound in bounds:
        axes.axvline(bound, color=plots.GREY, linewidth=1)
    low, high = 1e-4, 10
    axes.plot([low, high], [low, high], "k:", linewidth=1)
    plots.log_log(axes, plots.percent, plots.percent)
    axes.set_xlabel("step error of the run")
    axes.set_ylabel("error")
    plots.legend_above(axes, 3)
    FIGURE.parent.mkdir(exist_ok=True)
    plots.save(drawing, FIGURE)


def defaults(program):
    text = subprocess.run([program, "doc"], stdout=subprocess.PIPE, text=True, check=True).stdout
    return [
        float(re.search(rf"`Step Error {name}`[^\n]*?`([0-9.]+)`", text).group(1))
        for name in ("Warning", "Limit")
    ]


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True)
    parser.add_argument("--work", default="results/step_error")
    parser.add_argument("--short", action="store_true")
    parser.add_argument("--walls", action="store_true")
    parser.add_argument("--seconds", type=float, default=float("inf"))
    options = parser.parse_args()
    options.end = time.monotonic() + options.seconds
    bounds = defaults(options.program)
    if options.short:
        runs, ended = measured(
            options, [Case("helical_170m", "helical_170m", {}, ("2.5e-3", "1e-2"),
                           ("usual",))], ["reduced"])
        print(table(runs) + outliers(runs))
        return
    if options.walls:
        runs, ended = measured(options, WALLS, ["full"])
        runs.sort(key=lambda run: (WALLS.index(run.case), float(run.step), len(run.own)))
        DOCUMENT.write_text(renewed(DOCUMENT.read_text(), wall_chapter(runs)))
        print(table(runs) + outliers(runs))
        return
    runs, ended = measured(options, SCENES + SPEEDS, MODELS)
    more, too = measured(options, STICKING, MODELS)  # the references take an hour
    runs, ended = runs + more, ended + too
    if not runs:
        raise SystemExit("no run has finished")
    text = f"""<!-- written by tools/step_accuracy.py -->
# Step error against vibration error

The [step error](theory.md) that decides on {len(runs)} runs of {SECONDS:g} s, and the error each of
them has against steps of 0.125 ms with a tolerance of 1e-8. The error is the vibration error less
the sensitivity of the reference, its own vibration error when the weight on bit changes by 1e-4.
Where that is above {percent(CHAOTIC)} % ({sum(run.chaotic for run in runs)} runs), the error is
that of the rms lateral speed and of the impulse per second from {MEANS_FROM:g} s on, the larger
one: means of {NEIGHBOURS} runs with weights on bit 1e-4 apart, less the half-width of the 95 %
interval of the difference. Steps of {min(float(run.step) for run in runs):g} to
{max(float(run.step) for run in runs):g} s; spectral radii of 0.2, 0.8 and 1, tolerances of 1e-5 and
1e-3, with and without phase correction. {ended} more ended early, with a reason. S is the estimate
that every run has, D the difference from half the step of those that are compared. Lines in the
figure: `Step Error Warning` ({percent(bounds[0])} %) and `Step Error Limit` ({percent(bounds[1])}
%). `tools/step_accuracy.py` goes on where it stopped; all of its cases are {sum(len(case.steps) *
len(case.ways) for case in SCENES + SPEEDS + STICKING) * len(MODELS)} runs.

{cases(runs)}
![Step error and error of runs](figures/step_error.svg)

{table(runs)}
{outliers(runs)}
"""
    known = DOCUMENT.read_text().split("\n" + CHAPTER) if DOCUMENT.exists() else []
    DOCUMENT.write_text(renewed(text, CHAPTER + known[1] if len(known) > 1 else ""))
    figure(runs, bounds)
    print(text)


if __name__ == "__main__":
    main()
