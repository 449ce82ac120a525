#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Effects of the numbers of src/transient/Tuned.hpp: short hard cases with one number halved and
doubled.

    constants.py BUILD                builds the program in BUILD from a copy of the sources with
                                      adjustable numbers, and runs all
    constants.py BUILD --only NAME... only these numbers
    constants.py BUILD --built        with the existing program, or the one named

Prints, for each number, value and case: refused, the vibration error against the run with the
values of Tuned.hpp, and the work (iterations, and factorisations at the price of
Tuned::factorPrice) divided by that of this run. docs/step-constants.md has the results.
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys

from ablation import JUDGED_ELSEWHERE, balls, friction, walls
from program import FULL, ROOT, Program
from scenes import HELICAL, STRESS, alpha, times

HEADER = "src/transient/Tuned.hpp"
NUMBER = re.compile(
    r"static constexpr (double|int) (?!colours)(\w+) = ([^;]+);")  # other constants use `colours`
READS = """#pragma once
#include <cstdlib>
inline double variation(const char* name, double usual) {
  const char* given = std::getenv(name);
  return given != nullptr ? std::atof(given) : usual;
}
"""
PRICE = 45  # Tuned::factorPrice
FACTORS = (0.5, 2.0)
SMOOTH, PHASE, FRICTION, STIFF, BALLS = ("helical 1 ms", "helical 2.5 ms", "sharp friction",
                                         "walls of 3e9 N/m", "forty balls")
CASES = {
    "slowestRate": (PHASE, FRICTION), "slowestRelaxation": (FRICTION,), "progress": (FRICTION,),
    "mostIdle": (FRICTION,), "decrease": (FRICTION,), "mostTries": (FRICTION,),
    "counted": (PHASE, FRICTION), "rightEnough": (SMOOTH, PHASE), "mostGrowth": (PHASE, FRICTION),
    "rounding": (SMOOTH, STIFF), "factorPrice": (SMOOTH, PHASE), "dropped": (SMOOTH, FRICTION),
    "positionsPerPoint": (SMOOTH, FRICTION), "pointTolerance": (FRICTION, STIFF),
    "mostPointIterations": (FRICTION,), "mostPathSteps": (FRICTION,), "patience": (FRICTION,),
    "mostTroubled": (FRICTION,), "mostLost": (STIFF, BALLS), "mostMisplaced": (STIFF, BALLS),
    "resolved": (STIFF, BALLS), "calmSteps": (STIFF, BALLS), "lookStride": (STIFF, BALLS),
    "quiet": (STIFF, BALLS), "atATime": (STIFF, BALLS), "mostPhase": (SMOOTH, PHASE),
    "mostTurn": (SMOOTH, STIFF), "lookAhead": (SMOOTH, STIFF)
}


def build(folder):
    """Builds a program that reads its numbers from the environment, from a copy of the sources."""
    copy = folder / "sources"
    listed = subprocess.run(["git", "-C", str(ROOT), "ls-files", "-z"], stdout=subprocess.PIPE,
                            text=True, check=True).stdout
    for name in filter(None, listed.split("\0")):
        target = copy / name
        target.parent.mkdir(parents=True, exist_ok=True)
        if not target.exists() or target.read_bytes() != (ROOT / name).read_bytes():
            shutil.copy2(ROOT / name, target)
    text = NUMBER.sub(r'static inline const \1 \2 = static_cast<\1>(variation("\2", \3));',
                      (ROOT / HEADER).read_text(encoding="utf-8"))
    (copy / HEADER).write_text(text.replace("#pragma once\n", READS), encoding="utf-8")
    subprocess.run([
        "cmake", "-S",
        str(copy), "-B",
        str(folder / "build"), "-G", "Ninja", "-D", "CMAKE_BUILD_TYPE=Release", "-D",
        "BUILD_TESTING=OFF"
    ], check=True)
    subprocess.run(["cmake", "--build",
                    str(folder / "build"), "-j", "2", "--target", "tooljoint"], check=True)
    return folder / "build" / "tooljoint"


def decks(program):
    """{case: (deck, settings, lists left out, end)}"""
    sharp = {**alpha(1e-3), **times(0.3, 0.005)}
    return {
        SMOOTH: (HELICAL, {**alpha(1e-3), **times(0.6, 0.01)}, FULL, 0.6),
        PHASE: (HELICAL, {**alpha(2.5e-3), **times(1.0, 0.01)}, FULL, 1.0),
        FRICTION: (STRESS, {**sharp, **friction(3e-5, 0.5)}, FULL, 0.3),
        STIFF: (STRESS, {**alpha(1e-3, 0.2), **times(0.15, 0.0025), **walls(3e9)}, FULL, 0.15),
        BALLS: (balls(program), {}, (), 0.2),
    }


def work(run):
    return run.motion["newton_iterations"] + PRICE * run.motion["factorisations"]


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("--only", nargs="+", default=[], metavar="NAME")
    parser.add_argument("--built", metavar="PROGRAM", nargs="?", const="")
    options = parser.parse_args()
    folder = pathlib.Path(options.build).resolve()
    program = Program((options.built or folder / "build" / "tooljoint")
                      if options.built is not None else build(folder), folder / "runs")
    cases, usual = decks(program), {}

    def run(name, case):
        deck, settings, without, _ = cases[case]
        return program.run(name, deck, {**JUDGED_ELSEWHERE, **settings}, without, seconds=200)

    values = {
        name: float(value)
        for _, name, value in NUMBER.findall((ROOT / HEADER).read_text(encoding="utf-8"))
    }
    for name, value in values.items():
        if options.only and name not in options.only:
            continue
        for case in CASES[name]:
            if case not in usual:
                usual[case] = run("usual_" + re.sub(r"\W", "_", case), case)
            cells = []
            for factor in FACTORS:
                os.environ[name] = repr(value * factor)
                one = run("varied", case)
                del os.environ[name]
                if not one.done:
                    cells.append(f"{value * factor:g}: refused")
                    continue
                apart = program.vibration_error(one, usual[case], cases[case][3])
                cells.append(f"{value * factor:g}: {100 * apart:.2g} %, work "
                             f"{work(one) / work(usual[case]):.2f}")
            print(f"{name} = {value:g}, {case}: " + "; ".join(cells), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
