# SPDX-License-Identifier: BSD-3-Clause
"""Blocks of hexahedra for docs/scale.md: reduced as one part, or cut into substructures and
compared with the modes of the whole block."""
import csv
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

from scale_runs import PROJECT, chapter, measured, seconds, table, times

BLOCK = PROJECT / "examples/12_solid_block"
# Numbers of cubic elements along the edges of a block of 8:2:1.
BLOCKS = (8, 4, 2), (24, 6, 3), (40, 10, 5), (56, 14, 7), (80, 20, 10), (116, 29, 15)
MODES, JOINED = 50, 100
CUT_PARTS, CUT_BLOCKS = 16, ((24, 6, 3), (56, 14, 7), (100, 25, 12), (170, 43, 21))
CUT_RANKS = 1, 2  # the largest block only on two ranks


def solid(options, counts):
    """Reduces a block with JOINED retained nodes at its tip and MODES modes; (dofs, entries,
    row)."""
    name = "block_" + "x".join(map(str, counts))
    folder = pathlib.Path(options.work).resolve() / name
    folder.mkdir(parents=True, exist_ok=True)
    made = folder / "made.txt"
    if not made.exists():
        text = os.popen(f"{sys.executable} {BLOCK}/make_block.py {' '.join(map(str, counts))} "
                        f"--joined {JOINED} --out {folder}/block.h5").read()
        shutil.copy(BLOCK / "deck.xml", folder / "deck.xml")
        made.write_text(text, encoding="utf-8")
    dofs, entries = map(
        int,
        re.search(r"(\d+) dofs, (\d+) entries", made.read_text(encoding="utf-8")).groups())
    row = measured(options, name, [
        "export", "deck.xml", "--set", f"Reduction/Mode Selection/Modes={MODES}", "--output",
        "reduced"
    ])
    return dofs, entries, row


def block_of(options, counts, joined):
    """(folder with block.h5, dofs, entries) of a block with `joined` retained nodes at its tip; -1:
    none."""
    folder = pathlib.Path(options.work).resolve() / ("block_" if joined >= 0 else
                                                     "whole_") / "x".join(map(str, counts))
    folder.mkdir(parents=True, exist_ok=True)
    made = folder / "made.txt"
    if not made.exists():
        text = os.popen(f"{sys.executable} {BLOCK}/make_block.py {' '.join(map(str, counts))} "
                        f"--joined {joined} --out {folder}/block.h5").read()
        made.write_text(text, encoding="utf-8")
    return folder, *map(
        int,
        re.search(r"(\d+) dofs, (\d+) entries", made.read_text(encoding="utf-8")).groups())


def rival(options, folder, count):
    """{hertz, wall_s, memory_mb} of the lowest modes of the whole block by one shift-invert run,
    which is stopped when they are printed."""
    record = folder / f"rival_{count}.json"
    if record.exists():
        return json.loads(record.read_text(encoding="utf-8"))
    begin, hertz, reading = time.monotonic(), [], False
    child = subprocess.Popen(
        [options.program, "modes", "deck.xml", "--without", "Reduction", "--count",
         str(count)], cwd=folder, stdout=subprocess.PIPE, text=True)
    for line in child.stdout:
        reading = reading or "full [Hz]" in line
        found = re.match(r" *(\d+) +(\S+)$", line) if reading else None
        if found:
            hertz.append(float(found.group(2)))
        if len(hertz) == count:
            break
    wall = time.monotonic() - begin
    child.terminate()  # the damped modes are not needed
    _, _, usage = os.wait4(child.pid, 0)
    row = {"hertz": hertz, "wall_s": wall, "memory_mb": usage.ru_maxrss / 1024}
    record.write_text(json.dumps(row), encoding="utf-8")
    return row


def cut_row(options, counts, ranks):
    """A row of the table of cut blocks."""
    folder, dofs, _ = block_of(options, counts, -1)
    text = re.sub(r".*\"Retained\".*\n", "", (BLOCK / "deck.xml").read_text(encoding="utf-8"))
    (folder / "deck.xml").write_text(text, encoding="utf-8")
    name = f"cut_{'x'.join(map(str, counts))}_{ranks}"
    row = measured(options, name, [
        "modes",
        str(folder / "deck.xml"), "--coupled", "--count",
        str(MODES), "--output", "out", "--set", f"Reduction/Mode Selection/Modes={MODES}", "--set",
        "Reduction/Basis=Multilevel", "--set", f"Reduction/Multilevel/Parts={CUT_PARTS}", "--set",
        "Reduction/Basis Checks=false"
    ], ranks)
    if row["code"] != 0:
        return (dofs, ranks, *times(row)[:1], "", "", "", "", "", "")
    with open(pathlib.Path(options.work) / name / "out/modes.csv", encoding="utf-8") as file:
        modes = list(csv.DictReader(file))
    estimate = max(float(mode["estimate"]) for mode in modes)
    own = dofs, ranks, seconds(row["wall_s"]), f"{row['memory_mb']:.0f}"
    whole = rival(options, folder, MODES)
    if len(whole["hertz"]) < MODES:
        return (*own, "", f"{estimate:.1e}", "", "")
    hertz = [float(mode["coupled [Hz]"]) for mode in modes]
    error = max(abs(a / b - 1) for a, b in zip(hertz, whole["hertz"]))
    return (*own, f"{error:.1e}", f"{estimate:.1e}", seconds(whole["wall_s"]),
            f"{whole['memory_mb']:.0f}")


def faster_from(lines):
    """Sentence with the sizes from which the parts take less time than the whole; `lines` are rows
    of the table of cut blocks."""
    found = []
    for ranks in CUT_RANKS:
        pairs = sorted((line[0], float(line[2]) < float(line[6])) for line in lines
                       if line[1] == ranks and line[6])
        first = next(
            (dofs for i, (dofs, _) in enumerate(pairs) if all(less for _, less in pairs[i:])), None)
        if pairs:
            found.append(f"on {ranks} rank{'s' * (ranks > 1)} " + (
                f"from {first} dofs on" if first else f"at no size up to {pairs[-1][0]} dofs"))
    return "The parts take less time than the whole " + ", ".join(found) + "."


def cuts(options):
    chosen = [each for each in CUT_BLOCKS if 3 * math.prod(n + 1 for n in each) <= options.most]
    lines = [
        cut_row(options, counts, ranks) for counts in (chosen[:1] if options.short else chosen)
        for ranks in CUT_RANKS if ranks > 1 or counts != CUT_BLOCKS[-1]
    ]
    said = faster_from(lines)
    if not all(line[-1] for line in lines):
        said += " Where its columns are empty, the memory did not\nhold the whole."
    return chapter(
        options, "Large parts cut into substructures", "The same blocks, clamped at one end, "
        f"without kept dofs: {MODES} coupled modes by `Basis` = `Multilevel` with\n"
        f"{CUT_PARTS} parts, estimates included, from the file on (`modes --coupled`, `Basis "
        f"Checks` = `false`), beside\n{MODES} modes of the whole by one shift-invert run. Errors "
        f"are the largest of the {MODES} frequencies;\nmemory is that of one rank. "
        f"{said}\n\n" + table(("dofs", "ranks", "wall [s]", "memory [MB]", "largest error",
                               "largest estimate", "whole: wall [s]", "memory [MB]"), lines))


def solids(options):
    chosen = [each for each in BLOCKS if 3 * math.prod(n + 1 for n in each) <= options.most]
    lines = [(dofs, entries, *times(row))
             for dofs, entries, row in (solid(options, counts)
                                        for counts in (chosen[:1] if options.short else chosen))]
    return chapter(
        options, "Large parts", "Blocks of hexahedra ([example "
        f"12](../examples/12_solid_block/README.md)), clamped at one end, {3 * JOINED}\n"
        "dofs kept at the other (all of that end where it has fewer nodes): constraint modes and "
        f"{MODES}\nfixed-interface modes, with all checks, from the file to the file.\n\n" + table(
            ("dofs", "entries of K", "wall [s]", "CPU [s]", "memory [MB]"), lines), "scale_solids")
