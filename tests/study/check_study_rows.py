#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Rows of a study in parallel: check_study_rows.py PROGRAM MPIEXEC DECK

The rows are divided among groups of ranks, or run as a plan of one command per row by GNU parallel
and collected. Both give the same table as a study that runs its rows one after the other.
"""
import pathlib
import resource
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from checks import TIME_FACTOR, expect, finish, tooljoint  # noqa: E402
from results import known, rows, table

DECK = sys.argv[3]


def one_row_at_a_time():
    done = tooljoint("study", DECK, "--output", "one", "--set", "Study/Repeats=1")
    expect("a study runs row after row", done.returncode == 0 and len(rows("one")) == 13,
           done.stderr[-300:])


def same_errors(one, two):
    """Labels of the rows of `two` whose outcome or error differs from that of `one`."""
    return [
        label for label, row in two.items() if row["status"] != one[label]["status"] or (
            row["kind"] == "method" and row["vibration_error"] is not None
            and abs(row["vibration_error"] / one[label]["vibration_error"] - 1) > 1e-5)
    ]


def groups_of_ranks():
    one = rows("one")
    common = ("--set", "Study/Repeats=2")
    done = tooljoint("study", DECK, "--output", "groups", *common, "--ranks-per-row", "1", ranks=2)
    expect("rows that would share the machine are refused", done.returncode == 1
           and "--timing shared" in done.stderr, done.stderr[-300:])
    done = tooljoint("study", DECK, "--output", "groups", *common, "--ranks-per-row", "3",
                     "--timing", "shared", ranks=2)
    expect("so are ranks that make no whole groups", done.returncode == 1
           and "Groups of 3 ranks" in done.stderr, done.stderr[-300:])
    done = tooljoint("study", DECK, "--output", "groups", *common, "--ranks-per-row", "1",
                     "--timing", "shared", ranks=2)
    found = rows("groups")
    wrong = same_errors(one, found)
    expect("two rows at a time give the table of one", done.returncode == 0 and len(found) == 13
           and not wrong, f"({wrong}) {done.stderr[-300:]}")
    expect(
        "each row was timed twice, beside one other",
        all(row["beside"] == 1
            for row in found.values() if row["kind"] == "method" and row["status"] == "done")
        and all(row["repeats"] in ("2", "")
                for row in table("groups").values() if row["kind"] == "method"))
    done = tooljoint("study", DECK, "--output", "groups", *common, "--ranks-per-row", "1",
                     "--timing", "shared", ranks=2)
    expect("and are known afterwards",
           known(done) == 13 and rows("groups") == found, f"({known(done)})")
    done = tooljoint("study", DECK, "--output", "groups", *common)
    expect(
        "but not to a study that times alone", done.returncode == 0 and known(done) < 6
        and all(row["beside"] == 0 for row in rows("groups").values() if row["status"] == "done"),
        f"({known(done)})")
    done = tooljoint("study", DECK, "--output", "lost_groups", "--set",
                     "Study/Reference/Set={Transient/Integrator=RK4, Transient/Step=5 ms}",
                     "--ranks-per-row", "1", "--timing", "shared", ranks=2)
    expect("a reference that fails ends all groups with 4", done.returncode == 4
           and done.stderr.count("The reference run failed") == 1, f"({done.returncode})")


def planned():
    common = ("--set", "Study/Repeats=1")
    done = tooljoint("study", DECK, "--plan", "plan", *common)
    commands = pathlib.Path("plan/rows.txt").read_text(encoding="utf-8").splitlines()
    first = pathlib.Path("plan/reference.txt").read_text(encoding="utf-8")
    expect("a plan has a command for every row", done.returncode == 0 and len(commands) == 10
           and len(set(commands)) == 10, f"({len(commands)})")
    early = subprocess.run(["bash", "-c", commands[0]], capture_output=True, text=True)
    expect("a row waits for the reference", early.returncode == 5
           and "--row reference" in early.stderr, f"({early.returncode})")
    subprocess.run(["bash", "-c", first], check=True, capture_output=True)
    subprocess.run(["bash", "-c", commands[2]], check=True, capture_output=True)
    done = tooljoint("study", DECK, "--collect", "plan", *common)
    expect("missing rows are named", done.returncode == 0
           and "9 of 13 runs are missing" in done.stderr, done.stderr[-300:])
    before = pathlib.Path("plan/study.csv").read_text(encoding="utf-8").count(",done,")
    commands = pathlib.Path("plan/rows.txt").read_text(encoding="utf-8")
    done = subprocess.run(["parallel", "--jobs", "2"], input=commands, capture_output=True,
                          text=True)
    expect("GNU parallel takes the rows as they are", done.returncode == 0, done.stderr[-300:])
    done = tooljoint("study", DECK, "--collect", "plan", *common)
    wrong = same_errors(rows("one"), rows("plan"))
    expect("and their table is that of the study", done.returncode == 0
           and "missing" not in done.stderr and before == 4 and not wrong, f"({before}; {wrong})")
    for row in ("0", "14", "first"):
        done = tooljoint("study", DECK, "--row", row, "--output", "plan")
        expect(f"there is no row {row}", done.returncode == 1 and "rows 1 to 13" in done.stderr,
               done.stderr[-200:])


def many():
    """A plan of a hundred more rows, and their table, in a tenth of the time allowed for a thousand
    rows, 2 s and 20 s, or in the time of five starts."""
    steps = ", ".join(f"{0.5 + 0.0004 * i:.4f} ms" for i in range(100))
    deck = (DECK, "--set", "Study/Repeats=1", "--set", "Study/End Time=0.02", "--set",
            "Study/Window=0.02", "--set",
            f"Study/Methods/Generalized-alpha, full/Sweep/step/Values={{{steps}, 1 ms}}")
    expect("a study of many rows", tooljoint("study", *deck, "--output", "many").returncode == 0)
    used = [resource.getrusage(resource.RUSAGE_CHILDREN)]
    for step in ("--plan", "--collect"):
        done = tooljoint("study", *deck, step, "many")
        used.append(resource.getrusage(resource.RUSAGE_CHILDREN))
        expect(f"{step} of many rows", done.returncode == 0 and "missing" not in done.stderr,
               done.stderr[-300:])
    cpu = [
        after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        for before, after in zip(used, used[1:])
    ]
    lines = pathlib.Path("many/rows.txt").read_text(encoding="utf-8").count("\n")
    expect("a command and a line of the table for each", (lines, len(rows("many"))) == (108, 111),
           f"({lines}, {len(rows('many'))})")
    expect("in little time", cpu[0] <= 0.7 * TIME_FACTOR and cpu[1] <= 2 * TIME_FACTOR,
           f"({cpu} s)")


def excluded():
    """Options without effect in combination are refused, most importantly --fresh, which would
    delete the rows to collect."""
    before = table("plan")
    for first, second in (
        (("--collect", "plan"), ("--fresh",)),
        (("--plan", "plan"), ("--fresh",)),
        (("--row", "4"), ("--fresh",)),
        (("--row", "4"), ("--ranks-per-row", "1")),
        (("--row", "4"), ("--plan", "plan")),
        (("--row", "4"), ("--collect", "plan")),
        (("--plan", "plan"), ("--collect", "plan")),
        (("--plan", "plan"), ("--output", "one")),
        (("--collect", "plan"), ("--output", "one")),
    ):
        done = tooljoint("study", DECK, *first, *second)
        expect(f"{first[0]} and {second[0]} exclude each other", done.returncode == 1
               and first[0] in done.stderr and second[0] in done.stderr,
               f"({done.returncode}) {done.stderr[-200:]}")
    done = tooljoint("study", DECK, "--collect", "plan", "--set", "Study/Repeats=1")
    expect("and the rows are still there", done.returncode == 0 and table("plan") == before)


def main():
    for left in ("one", "groups", "lost_groups", "plan", "many"):  # of an earlier run of this test
        shutil.rmtree(left, ignore_errors=True)
    for check in (one_row_at_a_time, groups_of_ranks, planned, many, excluded):
        check()
    return finish()


if __name__ == "__main__":
    sys.exit(main())
