#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""`tooljoint study` of a scene of parts: check_frame_study.py PROGRAM MPIEXEC DECK

Compares rows of a study with separate calls of `run`, `compare` and `modes` for the same models.
Repeats the study, also on two ranks, with other frequencies, with a reference that fails, and with
invalid lists.
"""
import csv
import json
import pathlib
import re
import shutil
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from checks import expect, finish, tooljoint  # noqa: E402

PROGRAM, MPIEXEC, DECK = sys.argv[1:4]


def near(value, wanted, tolerance):
    return value is not None and abs(value - wanted) <= tolerance * abs(wanted)


def summary(folder):
    return json.loads(pathlib.Path(folder, "summary.json").read_text(encoding="utf-8"))


def rows(folder):
    return {row["label"]: row for row in summary(folder)["study"]}


def table(path):
    with open(path, newline="", encoding="utf-8") as text:
        return [{name.split(" [")[0]: value for name, value in row.items()}
                for row in csv.DictReader(text)]


def settings(*overrides):
    arguments = ["--without", "Study", "--set", "Transient/End Time=0.4"]
    for text in overrides:
        arguments += ["--without", text[1:]] if text.startswith("!") else ["--set", text]
    return arguments


def whole_study():
    done = tooljoint("study", DECK, "--output", "whole")
    expect("a study of parts ends with 0", done.returncode == 0,
           done.stderr[-300:] if done.returncode else "")
    found = rows("whole")
    expect("every run is a row, of summary.json and of study.csv",
           len(found) == 16 and list(found) == [row["label"] for row in table("whole/study.csv")])
    failed = found["too coarse"]
    expect(
        "a run that fails is a row with its reason", failed["status"] == "failed"
        and "blew up" in failed["reason"] and failed["cpu_s"] is None)
    methods = [row for row in found.values() if row["kind"] == "method" and row["status"] == "done"]
    expect(
        "every other one has errors and times",
        len(methods) == 12
        and all(row[key] > 0 for row in methods
                for key in ("vibration_error", "eps_t_max", "eps_n_max", "cpu_s", "steps")))
    expect(
        "reduced ones have errors of frequencies, full ones none",
        all((row["frequency_error"] is not None) == (row["model"] == "reduced") for row in methods))
    expect(
        "and an estimate of the vibration error where it was asked for",
        all((row["estimated_vibration_error"] is not None) == (
            row["model"] == "reduced" and not re.search("interfaces|dual", row["label"]))
            for row in methods))
    reference = summary("whole")["reference"]
    expect(
        "the error of the reference is known and below all others",
        0 < reference["self_error"]["vibration_error"] < min(row["vibration_error"]
                                                             for row in methods))
    expect("so is its sensitivity", 0 < reference["sensitivity"]["at_end"] < 1e-8)
    for line in ("CMS, Craig-Bampton, Modes {}", "CMS, Rubin, Modes {}"):
        few, many = found[line.format(4)], found[line.format(12)]
        expect(
            f"more modes, less error ({line[:-9]})",
            few["vibration_error"] > 2 * many["vibration_error"]
            and few["frequency_error"] > 10 * many["frequency_error"])
    few, many = found["reduced interfaces, Modes 8"], found["reduced interfaces, Modes 16"]
    expect(
        "more interface modes too", few["frequency_error"] > 10 * many["frequency_error"]
        and few["reduced_dofs"] + 8 == many["reduced_dofs"])
    primal, dual = found["CMS, Craig-Bampton, Modes 12"], found["dual"]
    expect(
        "parts joined by forces move as those joined by their dofs, and are more",
        near(dual["vibration_error"], primal["vibration_error"], 1e-4)
        and dual["reduced_dofs"] > primal["reduced_dofs"],
        f"({dual['vibration_error']:.5e}, {primal['vibration_error']:.5e})")
    expect(
        "own vectors are a basis of the study", found["own vectors"]["basis"] == "User Vectors"
        and found["own vectors"]["reduced_dofs"] == 70)
    expect(
        "nothing is said of a bit", found["full, Step 2 ms"]["bit_speed_difference_rpm"] is None
        and found["full, Step 2 ms"]["lateral_rms_difference"] > 0
        and table("whole/study.csv")[3]["bit_speed_p50"] == "")


def same_as_separate_calls():
    """A row agrees with the results of `run`, `compare` and `modes`."""
    tooljoint("run", DECK, "--output", "alone_reference",
              *settings("!Reduction", "Transient/Step=1e-4"))
    found = rows("whole")
    for label, overrides in (
        ("CMS, Rubin, Modes 4", ("Reduction/Basis=Rubin", "Reduction/Mode Selection/Modes=4")),
        ("reduced interfaces, Modes 8", ("Reduction/Interface Reduction=System",
                                         "Reduction/System/Modes=8", "!Reduction/Error Estimate")),
    ):
        row = found[label]
        ran = tooljoint("run", DECK, "--output", "alone", *settings(*overrides))
        expect(f"{label}: the run succeeds", ran.returncode == 0,
               ran.stderr[-300:] if ran.returncode else "")
        said = " ".join(
            tooljoint("compare", "alone", "alone_reference", "--to", "0.4").stdout.split())
        numbers = {
            name: float(value) for name, value in re.findall(
                r"(eps_t max|mean|eps_n max|vibration error) (\S+?)(?:,|\s|$)", said)
        }
        for name, key in (("vibration error", "vibration_error"), ("eps_t max", "eps_t_max"),
                          ("mean", "eps_t_mean"), ("eps_n max", "eps_n_max")):
            expect(f"{label}: {key} is that of `compare`", near(row[key], numbers[name], 1e-3),
                   f"({row[key]:.4e}, {numbers[name]:.4e})")
        alone = summary("alone")
        expect(
            f"{label}: dofs and modes are those of the run",
            row["reduced_dofs"] == alone["reduction"]["reduced_dofs"]
            and row["modes"] == sum(part["modes"] for part in alone["reduction"]["substructures"]))
        estimate = (alone["reduction"]["estimate"] or {}).get("motion_error")
        expect(f"{label}: there is an estimate of the vibration error where the run has one",
               (row["estimated_vibration_error"] is None) == (estimate is None))
        tooljoint("modes", DECK, "--output", "alone", "--count", "10", *settings(*overrides))
        modes = table("alone/modes.csv")
        worst, mac = max(abs(float(mode["error"])) for mode in modes), min(
            float(mode["mac"]) for mode in modes)
        expect(
            f"{label}: the error of the frequencies is that of `modes`",
            len(modes) == 10 and near(row["frequency_error"], worst, 1e-6)
            and near(row["least_mac"], mac, 1e-6), f"({row['frequency_error']:.4e}, {worst:.4e})")


def again():
    before = rows("whole")
    done = tooljoint("study", DECK, "--output", "whole")
    expect(
        "a study that is repeated runs nothing again", done.returncode == 0
        and "16 of 16 runs are known" in done.stdout and rows("whole") == before)
    done = tooljoint("study", DECK, "--output", "whole", "--set", "Study/Frequencies=3")
    after = rows("whole")
    expect("with other frequencies reduced runs alone are run again", "6 of 16 runs are known"
           in done.stdout, "" if "runs are known" in done.stdout else done.stdout[:300])
    expect(
        "and fewer have a smaller error", after["CMS, Rubin, Modes 4"]["frequency_error"] <
        before["CMS, Rubin, Modes 4"]["frequency_error"])
    done = tooljoint("study", DECK, "--output", "ranks", "--set", "Study/Repeats=1", ranks=2)
    two = rows("ranks")
    same = all(before[label]["status"] == row["status"] and (row["vibration_error"] is None or near(
        row["vibration_error"], before[label]["vibration_error"], 1e-5)) and (
            row["frequency_error"] is None or abs(row["frequency_error"] -
                                                  before[label]["frequency_error"]) < 1e-9)
               for label, row in two.items() if row["kind"] == "method")
    expect("two ranks give the same rows", done.returncode == 0 and len(two) == 16 and same,
           done.stderr[-300:] if done.returncode else "")


def failures():
    done = tooljoint("study", DECK, "--output", "lost", "--set",
                     "Study/Reference/Set={Transient/Integrator=RK4, Transient/Step=5 ms}")
    expect("a reference that fails ends with 4", done.returncode == 4
           and "The reference run failed" in done.stderr, f"({done.returncode})")
    expect("and its summary says so", summary("lost")["status"] == "failed")
    for override, code, sentence in (
        ("Study/Methods/own vectors/Set={Reduction/Mode Selection/Modes=many}", 2,
         "Study/Methods/own vectors/Set says \"Reduction/Mode Selection/Modes=many\""),
        ("Study/Methods/CMS/Set={Parts/Loads/wind/Part=roof}", 2, "Study/Methods/CMS"),
        ("Study/Methods/CMS/Set={Substructures/Rule=All}", 2, "/frame/Substructures is not a list"),
        ("Study/Window=1", 2, "Study/Window reaches to 1 s, but the runs end at 0.6 s"),
    ):
        done = tooljoint("check", DECK, "--set", override)
        expect(f"{override} is refused", done.returncode == code and sentence in done.stderr,
               done.stderr[-300:] if sentence not in done.stderr else "")
    done = tooljoint("study", DECK, "--without", "Transient")
    expect("a study without a motion ends with 2", done.returncode == 2
           and "no Transient list" in done.stderr)
    done = tooljoint("run", DECK, "--output", "plain")
    expect("`run` leaves the Study list aside", done.returncode == 0
           and summary("plain")["study"] is None)


def pictures():
    done = tooljoint("study", DECK, "--output", "ranks", "--set", "Study/Repeats=1", "--set",
                     "Study/Pictures=true")
    drawn = {path.name for path in pathlib.Path("ranks").glob("study_*.png")}
    said = "plots were not drawn" in done.stderr
    expect(
        "pictures are drawn, or a warning says how", done.returncode == 0
        and ({"study_speed.png", "study_bases.png", "study_error_over_time.png"} <= drawn or said),
        f"({', '.join(sorted(drawn)) or 'warning'})")


def main():
    for left in ("whole", "alone", "alone_reference", "ranks", "lost",
                 "plain"):  # of an earlier run of this test
        shutil.rmtree(left, ignore_errors=True)
    for check in (whole_study, same_as_separate_calls, again, failures, pictures):
        check()
    return finish()


if __name__ == "__main__":
    sys.exit(main())
