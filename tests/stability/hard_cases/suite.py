#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Hard cases of the statics, the reduction and the integration, each with its own reference.

    suite.py PROGRAM --short                    a few points of every case (CTest)
    suite.py PROGRAM --write docs/hard-cases.md all of them; writes the table and its figures

Cases whose rows are in the work folder are not run again unless --fresh is given. Exit code 1 if a
row is wrong without a warning, or if a row that must be met is refused.
"""
import argparse
import dataclasses
import json
import pathlib
import sys
import time

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / "tools"))  # structures
import program as tooljoint
import report
import rows as table

import basis  # noqa: F401  (registers its cases)
import buckling  # noqa: F401
import contact  # noqa: F401
import drilling  # noqa: F401
import friction  # noqa: F401
import impacts  # noqa: F401
import motion  # noqa: F401
import parts  # noqa: F401
import records  # noqa: F401

NUMBERS = range(1, 32)


def show(row):
    mark = "FAILED" if row.failed else "ok    "
    print(
        f"  {mark} {row.verdict:8}{row.variant}, {row.parameter}: found {row.found}, true "
        f"{row.truth}, deviation {row.deviation:.2g} of {row.bound:.2g} "
        f"{row.note[:160]}", flush=True)


def stored(path):
    """Rows and plots in a file, and whether the case is complete."""
    content = json.loads(path.read_text(encoding="utf-8"))
    return ([table.Row(**row) for row in content["rows"]],
            [table.Plot(**plot) for plot in content["plots"]], content["complete"])


def store(path, found, complete):
    """Writes the rows of a case so far, so that an interrupted case keeps them."""
    kinds = {
        name: [dataclasses.asdict(item) for item in found if isinstance(item, kind)
               ] for name, kind in (("rows", table.Row), ("plots", table.Plot))
    }
    path.write_text(json.dumps({**kinds, "complete": complete}), encoding="utf-8")


def results(case, options, program):
    """Rows and plots of a case, from the work folder or by running it, and their extent: "",
    "short" or "stopped"."""
    paths = {
        short: program.work / f"case_{case.number:02d}{'_short' if short else ''}.json"
        for short in (False, True)
    }
    path = paths[options.short]
    if path.exists() and not options.fresh:
        rows, plots, complete = stored(path)
        if complete or options.no_run:
            return rows, plots, ("short" if options.short else "") if complete else "stopped"
    if options.no_run:
        return *(stored(paths[True])[:2] if paths[True].exists() else ([], [])), "short"
    print(f"case {case.number}: {case.title}", flush=True)
    begin, found = time.monotonic(), []
    for item in case.function(program, options.short):
        found.append(item)
        store(path, found, complete=False)
        if isinstance(item, table.Row):
            show(item)
    store(path, found, complete=True)
    print(f"case {case.number}: {time.monotonic() - begin:.1f} s", flush=True)
    return *stored(path)[:2], "short" if options.short else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--work", default="hard_cases",
                        help="folder of the runs and of finished cases")
    parser.add_argument("--mpiexec", default="mpiexec")
    parser.add_argument("--only", default="", help="numbers of cases, separated by commas")
    parser.add_argument("--short", action="store_true")
    parser.add_argument("--fresh", action="store_true",
                        help="repeat cases that are in the work folder")
    parser.add_argument(
        "--no-run", action="store_true", help=
        "run nothing: take the results of the work folder, short rows if the whole case is missing")
    parser.add_argument(
        "--write", help="file of the table, renewed for the chosen cases; figures go into figures/ "
        "in its folder")
    options = parser.parse_args()
    missing = sorted(set(NUMBERS) - set(table.CASES))
    if missing:
        sys.exit(f"cases without a program: {missing}")
    chosen = [int(n) for n in options.only.split(",")] if options.only else list(NUMBERS)
    program = tooljoint.Program(options.program, options.work, options.mpiexec)
    found = {n: results(table.CASES[n], options, program) for n in chosen}
    if options.write:
        report.write(pathlib.Path(options.write), found)
    everything = [(n, row) for n, (rows, _, _) in found.items() for row in rows]
    faults = [(n, row) for n, row in everything if row.failed]
    faults += [(n, None) for n, (rows, _, _) in found.items() if not rows]
    print(f"\n{len(everything)} rows, {len(faults)} failed")
    for n, row in faults:
        print(f"  case {n}: " + ("no rows" if row is None else
                                 f"{row.variant}, {row.parameter}: {row.verdict} {row.note[:200]}"))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
