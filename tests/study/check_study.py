#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Results of `tooljoint study`: check_study.py PROGRAM MPIEXEC DECK

Runs a study of a few seconds and checks its rows; compares an error with that of two separate runs;
interrupts and continues the study; makes a method, and the reference, fail; changes one method and
checks that the others are not run again; repeats the study on two ranks.
"""
import math
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time

import h5py

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "results"))
import documented

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from checks import COLUMNS, expect, finish, tooljoint, wide  # noqa: E402
from screens import expect_screen  # noqa: E402
from results import known, rows, summary, table

PROGRAM, MPIEXEC, DECK = sys.argv[1:4]


def whole_study():
    done = tooljoint("study", DECK, "--output", "whole")
    expect("a study with a method that fails ends with 0", done.returncode == 0, done.stderr[-300:])
    expect_screen(done, "whole", "study")
    told = done.stdout[done.stdout.index("\nrun  "):done.stdout.index("\nresults ")].splitlines()
    labels = [row["label"] for row in rows("whole").values()]
    expect(
        "its table has a line of at most 100 columns for each run",
        all(len(line) <= 100 for line in told)
        and all(any(line.startswith(label) for line in told) for label in labels), "\n".join(told))
    found, listed = rows("whole"), table("whole")
    expect("every run is a row, of summary.json and of study.csv",
           len(found) == 13 and list(found) == list(listed), f"({len(found)})")
    with h5py.File("whole/study.h5") as file:
        wrong, met = documented.faults(file, documented.rows("## Studies"))
    expect("datasets have the units of docs/file-formats.md", not wrong and len(met) > 15,
           f"({len(met)} kinds) {'; '.join(wrong)}")
    failed = found["RK4, too coarse"]
    expect(
        "the failed run has its reason and no numbers", failed["status"] == "failed"
        and "blew up" in failed["reason"] and failed["cpu_s"] is None)
    expect(
        "its line in study.csv too", listed["RK4, too coarse"]["status"] == "failed"
        and listed["RK4, too coarse"]["vibration_error"] == "")
    methods = [row for row in found.values() if row["kind"] == "method" and row["status"] == "done"]
    whole = all(
        math.isfinite(row[key]) and row[key] > 0 for row in methods
        for key in ("vibration_error", "eps_t_max", "eps_n_max", "cpu_s", "cpu_per_simulated_s",
                    "steps"))
    expect("no speed without its error on the same row", len(methods) == 9 and whole)
    expect("the lateral statistics are there",
           all(row["spectrum_difference_db"] is not None for row in methods))
    reference = summary("whole")["reference"]
    own = reference["self_error"]["vibration_error"]
    expect("the error of the reference is known and below all others",
           0 < own < min(row["vibration_error"] for row in methods), f"({own:.1e})")
    expect("so is its sensitivity", 1e-11 < reference["sensitivity"]["at_end"] < 1e-8,
           f"({reference['sensitivity']['at_end']:.1e})")
    steps = [
        found[f"Generalized-alpha, full, Step {step} ms"]["vibration_error"]
        for step in ("0.2", "0.5", "1")
    ]
    order = math.log(steps[2] / steps[0]) / math.log(5.0)
    expect("errors grow with the step, at an order between one and two", 1.0 < order < 2.2
           and steps[0] < steps[1] < steps[2], f"({order:.2f})")
    for state in ("Keep static", "Least squares"):
        errors = [
            found[f"Craig-Bampton, {state}, Modes {modes}"]["vibration_error"]
            for modes in (0, 2, 8)
        ]
        expect(f"more modes, less error ({state})", errors[0] > errors[1] > errors[2])
    expect(
        "the kept static state is better than the projected one",
        all(found[f"Craig-Bampton, Keep static, Modes {m}"]["vibration_error"] <
            found[f"Craig-Bampton, Least squares, Modes {m}"]["vibration_error"]
            for m in (0, 2, 8)))
    best = found["Generalized-alpha, full, Step 1 ms"]
    expect("the baseline is 1, and so is the best full run at its own error",
           best["speedup_baseline"] == 1 and abs(best["speedup_best_full"] - 1) < 1e-12)


def fitted_reference():
    """Without the lists Reference and Check the program chooses a reference for the runs, and its
    cost is known."""
    fitted = [
        "--without", "Study/Reference", "--without", "Study/Check", "--set", "Study/Repeats=1"
    ]
    done = tooljoint("study", DECK, "--output", "fitted", *fitted)
    expect(
        "the reference takes a quarter of the shortest step, and its cost is told before it runs",
        done.returncode == 0
        and "reference   Generalized-alpha, steps of 0.05 ms, a quarter of the shortest: about"
        in done.stdout, done.stderr[-300:] or done.stdout[:400])
    reference, before, after = summary("fitted")["reference"], rows("whole"), rows("fitted")
    expect(
        "the steps are those", reference["integrator"] == "Generalized-alpha"
        and abs(reference["max_step"] / 5e-5 - 1) < 1e-9, f"({reference['max_step']})")
    ratio = reference["predicted_cpu_s"] / reference["cpu_s"]
    expect("it takes about the time that was told", 1 / 3 < ratio < 3,
           f"({reference['predicted_cpu_s']:.3g} s told, {reference['cpu_s']:.3g} s taken)")
    own = reference["self_error"]["vibration_error"]
    methods = {
        label: row["vibration_error"] for label, row in after.items()
        if row["kind"] == "method" and row["status"] == "done"
    }
    expect("its error is a fraction of that of every run", own < 0.2 * min(methods.values()),
           f"({own:.1e}, {min(methods.values()):.1e})")
    apart = max(abs(value - before[label]["vibration_error"]) for label, value in methods.items())
    # Halving the step at least halves the error of the reference, so the error is at most twice the
    # distance to its check.
    both = 2 * (own + summary("whole")["reference"]["self_error"]["vibration_error"])
    expect("errors are those against a much finer reference, within those of both", apart < both,
           f"({apart:.1e}, {both:.1e})")
    only = [
        argument for name in ("Generalized-alpha, full", "Craig-Bampton")
        for argument in ("--without", f"Study/Methods/{name}")
    ]
    done = tooljoint("check", DECK, *fitted, *only, "--set", "Study/Baseline=RK4, too coarse")
    expect("that of explicit runs is RK4", "3 of the reference (RK4)" in done.stdout,
           done.stdout[-400:] + done.stderr)


def step_limits():
    coarse = [
        "--set", "Study/Repeats=1", "--set",
        "Study/Methods/Craig-Bampton/Set={Transient/Step=1 ms}", "--set",
        "Study/Methods/Craig-Bampton/Sweep/state/Values={Keep static}"
    ]
    for modes, limited in (("{12, 16, 20}", True), ("{0, 12}", False)):
        done = tooljoint("study", DECK, "--output", "limited", *coarse, "--set",
                         f"Study/Methods/Craig-Bampton/Sweep/modes/Values={modes}")
        said, told = summary(
            "limited")["step_limits"], "the step limits them, not the basis" in done.stdout
        expect(
            f"modes {modes}: a study says {'that' if limited else 'nothing where not'} the step "
            "limits all reduced runs", done.returncode == 0 and told == limited
            and len(said) == limited, f"{said}")


def same_as_separate_runs():
    """A row agrees with the results of two runs and `compare`."""
    common = [
        "--without", "Study", "--set", "Transient/End Time=0.15", "--without", "Reduction",
        "--without", "Substructures"
    ]
    for folder, step in (("run_reference", "2e-5"), ("run_method", "1e-3")):
        tooljoint("run", DECK, "--output", folder, *common, "--set", f"Transient/Step={step}")
    said = " ".join(
        tooljoint("compare", "run_method", "run_reference", "--to", "0.15").stdout.split())
    compared = {
        key: float(value)
        for key, value in re.findall(r"(vibration error|max) (\d\.\d+e[+-]\d+)", said)
    }
    row = rows("whole")["Generalized-alpha, full, Step 1 ms"]
    expect("the vibration error is that of `tooljoint compare` of two runs",
           abs(compared["vibration error"] / row["vibration_error"] - 1) < 1e-3,
           f"({compared['vibration error']}, {row['vibration_error']:.4e})")


def goes_on():
    before = rows("whole")
    done = tooljoint("study", DECK, "--output", "whole")
    expect("a study that is repeated runs nothing again", done.returncode == 0 and known(done) == 13
           and "run 1 of" not in done.stdout)
    expect("and has the same rows, times included", rows("whole") == before)
    done = tooljoint("study", DECK, "--output", "whole", "--set",
                     "Study/Methods/Craig-Bampton/Set={Transient/Step=0.5 ms}")
    expect("a changed method alone is run again", done.returncode == 0 and known(done) == 7,
           f"({known(done)} known)")
    done = tooljoint("study", DECK, "--output", "whole", "--set",
                     "Study/Reference/Set={Transient/Step=4e-5}", "--set", "Study/Repeats=1")
    expect("with another reference everything is", done.returncode == 0 and known(done) == 0)
    done = tooljoint("study", DECK, "--output", "whole", "--fresh", "--set", "Study/Repeats=1")
    expect("--fresh forgets all", done.returncode == 0 and known(done) == 0)
    done = tooljoint("study", DECK, "--output", "whole", "--set", "Study/Time Limit=1e-4", "--set",
                     "Study/Repeats=1", "--fresh")
    late = [row for row in rows("whole").values() if row["kind"] == "method"]
    expect("runs beyond the time limit are failed rows, not a failed study", done.returncode == 0
           and all(row["status"] == "failed" for row in late))
    done = tooljoint("study", DECK, "--output", "whole", "--set", "Study/Repeats=1")
    expect(
        "and are run again without it", done.returncode == 0
        and rows("whole")["Craig-Bampton, Keep static, Modes 8"]["status"] == "done")


def interrupted():
    process = subprocess.Popen(
        [PROGRAM, "study", DECK, "--output", "broken", "--set", "Study/Repeats=1000"],
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    while process.poll() is None and len(list(pathlib.Path("broken/cache").glob("row_*.json"))) < 7:
        time.sleep(0.005)
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=60)
    expect("an interrupted study ends with 130 and says where its rows are",
           process.returncode == 130 and "goes on from there" in " ".join(said.split()),
           f"({process.returncode})")
    expect("its summary says interrupted", summary("broken")["status"] == "interrupted")
    kept = {label: row for label, row in rows("broken").items() if row["status"] == "done"}
    expect("the rows that were done are in its files",
           len(kept) >= 6 and len(table("broken")) == 13, f"({len(kept)})")
    done = tooljoint("study", DECK, "--output", "broken", "--set", "Study/Repeats=1")
    after = rows("broken")
    expect("it goes on", done.returncode == 0 and known(done) >= 6, f"({known(done)} known)")
    expect(
        "and ends with all rows, the first ones as they were",
        summary("broken")["status"] == "finished" and len(after) == 13
        and all(after[label]["vibration_error"] == row["vibration_error"]
                and after[label]["cpu_s"] == row["cpu_s"] for label, row in kept.items()))


def failures():
    for ranks in (1, 2):
        done = tooljoint("study", DECK, "--output", f"lost_{ranks}", "--set",
                         "Study/Reference/Set={Transient/Integrator=RK4, Transient/Step=5 ms}",
                         ranks=ranks)
        said = done.stderr.count("The reference run failed")
        expect(f"a reference that fails ends with 4, {ranks} rank(s)", done.returncode == 4
               and said == 1, f"({done.returncode}, {said})")
        expect("and its summary says so", summary(f"lost_{ranks}")["status"] == "failed")
    done = tooljoint("study", DECK, "--without", "Study")
    expect("a deck without a Study list ends with 2", done.returncode == 2
           and "has no Study list" in done.stderr)
    done = tooljoint("study", DECK, "--without", "Transient")
    expect("so does one without a motion", done.returncode == 2
           and "no Transient list" in done.stderr)
    done = tooljoint("run", DECK, "--output", "plain")
    expect("`run` leaves the Study list aside", done.returncode == 0
           and summary("plain")["study"] is None)


def two_ranks():
    done = tooljoint("study", DECK, "--output", "ranks", "--set", "Study/Repeats=1", ranks=2)
    one, two = rows("broken"), rows("ranks")
    same = all(one[label]["status"] == row["status"] and (row["vibration_error"] is None or abs(
        row["vibration_error"] / one[label]["vibration_error"] - 1) < 1e-5)
               for label, row in two.items() if row["kind"] == "method")
    expect("two ranks give the same rows", done.returncode == 0 and len(two) == 13 and same,
           done.stderr[-300:] if done.returncode else "")


def pictures():
    done = tooljoint("study", DECK, "--output", "ranks", "--set", "Study/Repeats=1", "--set",
                     "Study/Pictures=true")
    drawn = sorted(path.name for path in pathlib.Path("ranks").glob("study_*.png"))
    said = "plots were not drawn" in done.stderr and "plot_study.py ranks" in done.stderr
    wanted = {
        "study_speed.png", "study_modes.png", "study_error_over_time.png", "study_bit_speed.png",
        "study_static.png", "study_reference.png"
    }
    expect("pictures are drawn, or a warning says how", done.returncode == 0
           and (wanted <= set(drawn) or said), f"({', '.join(drawn) or 'warning'})")
    expect(f"no line has more than {COLUMNS} columns", not wide(done.stdout),
           "\n".join(wide(done.stdout)))
    expect("one repeat is told as one", ", each timed once; pointwise"
           in " ".join(done.stdout.split()), done.stdout[:300])
    if drawn:
        expect("each as SVG too",
               all(pathlib.Path("ranks", name).with_suffix(".svg").is_file() for name in drawn))


def main():
    for left in ("whole", "fitted", "limited", "run_reference", "run_method", "broken", "lost_1",
                 "lost_2", "plain", "ranks"):  # of an earlier run of this test
        shutil.rmtree(left, ignore_errors=True)
    for check in (whole_study, fitted_reference, step_limits, same_as_separate_runs, goes_on,
                  interrupted, failures, two_ranks, pictures):
        check()
    return finish()


if __name__ == "__main__":
    sys.exit(main())
