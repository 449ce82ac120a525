#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures the time of each stage of a reduction for several sizes of a part.

reduction_cost.py [--program build/release/tooljoint] [--dofs 3000 9000 27900] [--basis
Craig-Bampton] [--modes 20] [--limit 900] [--work reduction_cost]

A bar of eight-node hexahedra with a square section is written as a part (scipy, h5py). One end is
fixed; the other end is an interface with a second, short bar. `tooljoint modes` prints the time of
every stage on its last line; this tool collects them in a table. A run that exceeds the time limit
is stopped and marked.
"""
import argparse
import pathlib
import re
import subprocess
import time

import structures


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/release/tooljoint")
    parser.add_argument("--dofs", type=int, nargs="+", default=[3000, 9000, 27900])
    parser.add_argument("--basis", default="Craig-Bampton")
    parser.add_argument("--modes", type=int, default=20)
    parser.add_argument("--limit", type=float, default=900, help="seconds")
    parser.add_argument("--work", default="reduction_cost")
    options = parser.parse_args()
    work = pathlib.Path(options.work)
    work.mkdir(parents=True, exist_ok=True)
    across = 9  # elements
    layer = (across + 1)**2
    for dofs in options.dofs:
        along = max(2, round(dofs / 3 / layer) - 1)
        bar = structures.solid(across, across, along, (0.5, 0.5, 0.5 / across * along))
        end = list(range(layer * along + 1, layer * (along + 1) + 1))
        held = bar.held([(node, c) for node in range(1, layer + 1) for c in (1, 2, 3)])
        held.write(work / "bar.h5", {"end": end})
        structures.solid(across, across, 2,
                         (0.5, 0.5, 1.0 / across)).write(work / "cap.h5",
                                                         {"end": list(range(1, layer + 1))})
        structures.deck(
            work / "bar.xml", {"bar": "bar.h5", "cap": "cap.h5"}, ["bar:end = cap:end"],
            f'<Parameter name="Basis" type="string" value="{options.basis}"/><ParameterList '
            f'name="Mode Selection"><Parameter name="Modes" type="int" value="{options.modes}"/>'
            '</ParameterList>')
        start = time.monotonic()
        try:
            done = subprocess.run(
                [options.program, "modes",
                 str(work / "bar.xml"), "--count", "12"], stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT, text=True, check=False, timeout=options.limit)
        except subprocess.TimeoutExpired as late:
            text = late.stdout.decode() if isinstance(late.stdout, bytes) else late.stdout or ""
            print(f"{held.M.shape[0]} dofs: not done in {options.limit:.0f} s; "
                  f"{text.strip().splitlines()[-1:] or ''}")
            continue
        wall = time.monotonic() - start
        if done.returncode != 0:
            print(f"{held.M.shape[0]} dofs: exit code {done.returncode}: "
                  f"{done.stdout.strip().splitlines()[-1]}")
            continue
        print(f"{held.M.shape[0]} dofs, {3 * layer} of them interface, {options.basis}, "
              f"{options.modes} modes: {wall:.1f} s")
        line = [
            text for text in re.sub(r"\n {12}", " ", done.stdout).splitlines()
            if text.startswith("times")
        ]
        for name, seconds in re.findall(r"([A-Za-z][A-Za-z \-]*?) ([0-9.]+) s",
                                        line[0].split(None, 1)[1] if line else ""):
            print(f"    {name:32s} {float(seconds):10.2f} s")


if __name__ == "__main__":
    main()
