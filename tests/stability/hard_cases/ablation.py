#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures the benefit of each strategy of an implicit step: hard cases and scenes with one
strategy left out at a time.

    ablation.py PROGRAM --short                     two cases (CTest)
    ablation.py PROGRAM --write docs/strategies.md  all of them; writes the table and draws its
                                                    figure

A strategy is worth keeping if without it a case is refused, changes, or takes 5 % longer. With
--short the exit code is 1 if a strategy that is left out is used, or if no active one is used.
"""
import argparse
import dataclasses
import math
import pathlib
import platform
import shutil
import subprocess
import sys

import numpy as np

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / "tools"))
import impacts
import report
from program import FULL, ROOT, Program
from scenes import HELICAL, LYING, STRESS, alpha, parts_deck, times

OWN = "Transient/Generalized-alpha/"
STRATEGIES = {
    name: {OWN + "Leave Out": [name]}
    for name in ("Relaxation", "Near Solves", "Points Alone", "Point Paths", "Turns",
                 "Resting Impacts", "Newton", "Troubled Points")
}
STRATEGIES |= {
    "Halving": {OWN + "Max Halvings": 0},
    "Impacts resolved": {OWN + "Resolve Impacts": False},
    "Phase correction": {OWN + "Phase Correction": False},
}
WINS = 0.05  # least gain in time of a strategy worth keeping
# largest vibration error of the same motion, absolute and as a multiple of that of a run with half
# the tolerance
SAME, NOISE = 0.01, 3.0
JUDGED_ELSEWHERE = {"Transient/Energy Residual Limit": 1e9,
                    "Transient/Step Error Limit": 1e9}  # limits exceeded without a change, too
HEAD = """# Strategies of a step

A step of `Generalized-alpha` has strategies for hard contact; [theory](theory.md) describes each.
The expert parameter `Leave Out` takes strategies out of a run, and `transient.strategies` of
`summary.json` counts their uses. Table and figure are written by

    cmake --build --preset release --target strategies

![CPU time without each strategy over that with all](figures/strategies.svg)

Numbers are CPU times of the motion relative to those with all strategies, the smaller of {repeats}
runs each. A difference of the motion is stated if it exceeds {same:g} % (vibration error) and three
times the change by half the tolerance of the iterations. *Refused* means that the run had no
result. A dash marks a strategy that the case does not use. The first table omits strategies that no
case uses.

"""


@dataclasses.dataclass
class Case:
    name: str
    deck: object
    settings: dict
    without: tuple = FULL


def friction(slip, speed, share=(0.55, 0.45)):
    return {
        "Contact/Friction/Static": share[0], "Contact/Friction/Dynamic": share[1],
        "Contact/Friction/Regularisation Velocity": slip,
        "Rotary Speed/Exponential/Final Speed": f"{speed} rpm"
    }


def walls(stiffness):
    return {"Contact/Law": "Clamped", "Contact/Stiffness": stiffness, "Contact/Damping": 0.0}


def balls(program):
    """The deck of forty linked balls on stops."""
    count, height = 40, impacts.DROP
    K = 1e4 * (2 * np.eye(count) - np.eye(count, k=1) - np.eye(count, k=-1))
    K[0, 0] = K[-1, -1] = 1e4
    file = program.part("balls", ["v"], impacts.BALL * np.eye(count), K,
                        loads=[-impacts.BALL * impacts.GRAVITY] * count)
    starts = {
        f"drop {i}": {"Part": "ball", "Node": i, "Component": "v", "Displacement": height}
        for i in range(1, count + 1)
    }
    stops = {
        f"floor {i}": {"First": f"ball:{i}", "Component": "v", "Stiffness": 1e7, "Damping": 0.0}
        for i in range(1, count + 1)
    }
    return parts_deck(program, "balls", {"ball": file}, {**alpha(1e-3), **times(0.2, 1e-3)},
                      Parts={"Starts": starts}, Coupling={"Stops": stops})


def cases(program, short):
    reverse = {
        "Rotary Speed/Law": "Table", "Rotary Speed/Table/Interpolation": "Linear",
        "Rotary Speed/Table/Times": [0.0, 0.3, 0.5, 1.0, 1.2],
        "Rotary Speed/Table/Speeds": [6.28, 6.28, 0.0, 0.0, -6.28],
        "Contact/Friction/Regularisation Velocity": 1e-3, "Damping/Mass Coefficient": 2.0
    }
    sharp = {**alpha(1e-3), **times(0.3, 0.005), **friction(3e-5, 0.5)}
    if short:
        return [
            Case("sharp friction, stress_170m, 0.5 rpm", STRESS, {**sharp, **times(0.05, 0.005)}),
            Case("walls of 3e9 N/m, stress_170m", STRESS,
                 {**alpha(1e-3), **times(0.05, 0.0025), **walls(3e9)})
        ]
    return [
        Case("helical_170m, 1 ms", HELICAL, {**alpha(1e-3), **times(2.0, 0.01)}),
        Case("helical_170m, 2.5 ms", HELICAL, {**alpha(2.5e-3), **times(3.0, 0.01)}),
        Case("helical_170m, reduced, 1 ms", HELICAL, {**alpha(1e-3), **times(2.0, 0.01)}, ()),
        Case("stress_170m, 1 ms", STRESS, {**alpha(1e-3), **times(2.0, 0.01)}),
        Case("stress_170m, 5 ms", STRESS, {**alpha(5e-3), **times(3.0, 0.01)}),
        Case("inclined_1000m, 2.5 ms", ROOT / "xml/inclined_1000m.xml",
             {**alpha(2.5e-3), **times(1.0, 0.01)}),
        Case("inclined_1000m, reduced, 2.5 ms", ROOT / "xml/inclined_1000m.xml",
             {**alpha(2.5e-3), **times(1.0, 0.01)}, ()),
        Case("vertical_1000m, 5 ms", ROOT / "xml/vertical_1000m.xml",
             {**alpha(5e-3), **times(3.0, 0.01)}),
        Case("sharp friction, stress_170m, 0.5 rpm", STRESS, sharp),
        Case("sharp friction, stress_170m, 2 rpm, reduced", STRESS, {**sharp, **friction(1e-5, 2)},
             ()),
        Case("sharp friction, helical_170m, 1 rpm", HELICAL,
             {**sharp, **times(0.6, 0.005), **friction(3e-5, 1)}),
        Case("sharp friction, helical_170m, 0.2 rpm", HELICAL,
             {**sharp, **times(0.6, 0.005), **friction(1e-5, 0.2)}),
        Case("sharp friction, helical_170m, 2 rpm", HELICAL, {**sharp, **friction(3e-5, 2)}),
        Case("walls of 1e8 N/m, stress_170m", STRESS,
             {**alpha(1e-3), **times(0.3, 0.0025), **walls(1e8)}),
        Case("walls of 3e9 N/m, stress_170m", STRESS,
             {**alpha(1e-3), **times(0.15, 0.0025), **walls(3e9)}),
        Case("walls of 3e9 N/m, stress_170m, reduced", STRESS,
             {**alpha(1e-3, 0.2), **times(0.15, 0.0025), **walls(3e9)}, ()),
        Case("forty balls", balls(program), {}, ()),
        Case("reversal, lying string", LYING, {**alpha(1e-3), **times(1.5, 0.005), **reverse},
             (*FULL, "Rotary Speed/Constant")),
    ]


def run(program, case, more):
    return program.run("ablation", case.deck, {**JUDGED_ELSEWHERE, **case.settings, **more},
                       case.without, seconds=300)


def noise(program, case, whole):
    """Vibration error of a run whose iterations use half the tolerance."""
    return program.vibration_error(run(program, case, {OWN + "Tolerance": 5e-6}), whole, end(case))


def end(case):
    return case.settings.get("Transient/End Time", 0.2)


def used(one, strategy):
    """Number of uses of a strategy in a run; infinite if it is not counted."""
    if strategy in ("Impacts resolved", "Halving"):
        return one.motion.get("rejected" if strategy ==
                              "Impacts resolved" else "halved") or 0  # a refused run has no summary
    return (one.motion.get("strategies") or {}).get(strategy.lower().replace(" ", "_"), math.inf)


def least(program, case, more, repeats):
    """The run, with the least CPU time of all repeats; its folder is kept until the next run of
    that name."""
    found = [run(program, case, more) for _ in range(repeats)]
    return found[-1], min(one.work() for one in found)


def set_aside(one):
    """Moves the results of a run, so that the next run does not overwrite them."""
    aside = one.folder.with_name("ablation_whole")
    shutil.rmtree(aside, ignore_errors=True)
    one.folder = one.folder.rename(aside)


def compared(program, case, strategy, whole, cost, same, repeats):
    """Cell of the table, gain in time from the strategy (infinite if the motion needs it), and the
    run."""
    if used(whole, strategy) == 0:
        return "-", 0.0, None
    one, own = least(program, case, STRATEGIES[strategy], repeats)
    if not one.done:
        return "refused", math.inf, one
    apart = program.vibration_error(one, whole, end(case))
    if apart > same:
        return f"{own / cost:.2f}, differs by {100 * apart:.2g} %", math.inf, one
    return f"{own / cost:.2f}", own / cost - 1, one


def table(program, chosen, repeats):
    """Lines of the table, {strategy: [(gain, case)]}, and faults."""
    lines, wins, broken = [], {name: [] for name in STRATEGIES}, []
    for case in chosen:
        whole, cost = least(program, case, {}, repeats)
        if not whole.done:
            lines.append((case.name, f"refused: {whole.sentence()[:80]}", *[""] * len(STRATEGIES)))
            continue
        set_aside(whole)
        same = max(SAME, NOISE * noise(program, case, whole))
        cells = []
        for name in STRATEGIES:
            cell, gain, one = compared(program, case, name, whole, cost, same, repeats)
            if one is not None:
                wins[name].append((gain, case.name))
                if used(one, name) not in (0, math.inf):
                    broken.append(
                        f"{case.name}: {name} is left out and used {used(one, name)} times")
            cells.append(cell)
            print(f"{case.name}: without {name} {cell}", flush=True)
        lines.append((case.name, f"{1e6 * cost / whole.motion['steps']:.0f}", *cells))
    return lines, wins, broken


def verdicts(wins):
    for name, found in wins.items():
        needed = [case for gain, case in found if math.isinf(gain)]
        faster = [(gain, case) for gain, case in found if WINS <= gain < math.inf]
        slower = [(gain, case) for gain, case in found if gain <= -WINS]
        yield (name, "; ".join(needed),
               "; ".join(f"{case} ({100 * gain:.0f} %)" for gain, case in faster),
               "; ".join(f"{case} ({-100 * gain:.0f} %)" for gain, case in slower),
               "earned" if needed or faster else "not used" if not found else "not earned")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--work", default="ablation", help="folder of the runs")
    parser.add_argument("--repeats", type=int, default=2)
    parser.add_argument("--short", action="store_true")
    parser.add_argument("--only", default="", help="cases whose name contains this text")
    parser.add_argument("--write", help="file of the table")
    options = parser.parse_args()
    program = Program(options.program, options.work)
    chosen = [case for case in cases(program, options.short) if options.only in case.name]
    repeats = 1 if options.short else options.repeats
    lines, wins, broken = table(program, chosen, repeats)
    if options.write:
        text = HEAD.format(repeats=repeats, same=100 *
                           SAME) + f"Machine: {platform.machine()}, {platform.system()}.\n\n"
        text += report.table(("left out", "needed by", "time won by", "time lost by", "verdict"),
                             verdicts(wins))
        text += "\n## Case by case\n\n" + report.table(("case", "step [us]", *STRATEGIES), lines)
        pathlib.Path(options.write).write_text(text, encoding="utf-8")
        subprocess.run([sys.executable, str(ROOT / "tools/strategies_figure.py")],
                       check=True)  # of the page
    tried = [name for name, found in wins.items() if found]
    print(f"{len(chosen)} cases, {len(tried)} strategies left out: {', '.join(tried)}")
    for fault in broken:
        print(f"FAILED {fault}")
    return 1 if broken or len(tried) < 4 else 0


if __name__ == "__main__":
    sys.exit(main())
