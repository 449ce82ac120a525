# SPDX-License-Identifier: BSD-3-Clause
"""Tables of docs/validation.md on buckling pipes.

    tools/validation.py --only buckling,vertical
"""
import json
import math
import os
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tests/buckling"))
import pipes  # noqa: E402

HELIX = 0.75  # share of the shortening of a helix above which a pipe counts as helical
CASES = ((60, 100, 0.005), (60, 100, 0.02), (60, 100, 0.1), (60, 60, 0.02), (90, 100, 0.005),
         (90, 100, 0.02), (90, 100, 0.1), (90, 60, 0.02))
LOADS = (4, 5, 6)
LENGTHS = (50, 100, 300, 1000)


def run(bench, name, deck, *settings):
    """Rows and summary of a pipe, computed if they are missing."""
    folder = (bench.work / name).resolve()
    if not (folder / "buckling.csv").exists():
        folder.mkdir(parents=True, exist_ok=True)
        print(f"buckling of {name}", flush=True)
        here = os.getcwd()
        os.chdir(folder)
        try:
            file = deck()
        finally:
            os.chdir(here)
        subprocess.run([
            bench.program, "buckling",
            str(folder / file), "--output",
            str(folder), *(part for one in settings for part in ("--set", one))
        ], stdout=subprocess.DEVNULL, check=True)
    return pipes.rows(folder), json.loads(
        (folder / "summary.json").read_text(encoding="utf-8"))["buckling"]


def buckling_table(bench):
    """Transitions and contact of pipes with weight, by inclination, length and crookedness, divided
    by the first buckling load F_c."""
    heads = [f"contact over r F^2/(4 E I), at {load} F_c: found; by shape" for load in LOADS]
    rows = [
        "| inclination, length, crookedness | first jump, F/F_c | last state before a helix, "
        f"F/F_c | {' | '.join(heads)} | last helix under falling weight, F/F_c |",
        "|" + "---|" * (4 + len(LOADS))
    ]
    for inclination, length, crookedness in CASES:
        across = pipes.WEIGHT * math.sin(math.radians(inclination))
        critical = 2 * math.sqrt(pipes.RIGIDITY * across / pipes.CLEARANCE)
        name = f"buckling_{inclination}_{length}_{crookedness}"
        found, _ = run(
            bench, name, lambda: pipes.deck("pipe", float(length), 2 * length, 6.3 * critical,
                                            inclination=float(inclination)),
            f"Buckling/Crookedness={crookedness}", f"Buckling/Unload To={critical} N")
        most = max(range(len(found)), key=lambda i: found[i]["weight_on_bit"])
        up, down = found[:most + 1], found[most:]
        jump = next(row for row in up if row["branch"] > 0)["compression"]
        loaded = [i for i, row in enumerate(up) if row["compression"] > 1.1 * critical]
        sinusoid = next(
            (up[i - 1] for i in loaded if up[i]["strain"] > HELIX * up[i]["helical_strain"]),
            up[-1])["compression"]
        cells = []
        for load in LOADS:
            i = min(range(len(up)), key=lambda i: abs(up[i]["compression"] - load * critical))
            shape, = pipes.shape_contact(bench.work / name, [i], float(length), float(inclination))
            cells.append(f"{up[i]['contact_force'] / up[i]['helical_contact_force']:.3f}; "
                         f"{shape / up[i]['helical_contact_force']:.3f}")
        last = [row for row in down if row["strain"] > HELIX * row["helical_strain"]][-1]
        rows.append(f"| {inclination} deg, {length} m, {crookedness:g} | {jump / critical:.2f} | "
                    f"{sinusoid / critical:.2f} | {' | '.join(cells)} | "
                    f"{last['compression'] / critical:.2f} |")
    return bench.by("buckling") + "\n" + "\n".join(rows) + "\n"


def vertical_table(bench):
    """Load of the first negative pivot of vertical pipes between hinges, divided by (E I
    w^2)^(1/3), compared with a separate beam model."""
    unit = (pipes.RIGIDITY * pipes.WEIGHT**2)**(1 / 3)
    rows = [
        "| length [m] | in units of (E I/w)^(1/3) | first negative pivot, over (E I w^2)^(1/3) | "
        "beam elements |", "|---|---|---|---|"
    ]
    for length in LENGTHS:
        truth = pipes.hanging_beam(float(length), 2 * length)
        _, said = run(bench, f"buckling_vertical_{length}",
                      lambda: pipes.deck("pipe", float(length), 2 * length, 1.05 * truth))
        rows.append(f"| {length} | {length / (pipes.RIGIDITY / pipes.WEIGHT) ** (1 / 3):.2f} | "
                    f"{said['limit'] / unit:.4f} | {truth / unit:.4f} |")
    return bench.by("vertical") + "\n" + "\n".join(rows) + "\n"
