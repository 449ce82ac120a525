#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the shipped decks with two versions of the program and compares all their results.

    same_results.py OLD NEW [--end 0.2] [--only PATTERN] [--names names.json] [--json table.json]
    same_results.py --write PAGE table.json ...   writes the tables of such files into the page,
                                                  between its marks

OLD and NEW are programs (tooljoint). Each runs in its own source tree (--old-tree, --new-tree;
default: this one) because decks and their parameters may have been renamed between them. Every deck
of xml/ and examples/ and every gold of tests/regression/ is run up to --end seconds of motion with
its own fixed settings. All datasets of results.h5 and all numbers of summary.json are compared,
except times and memory. One line per scene gives the largest difference, relative to the largest
entry of its dataset.

Bounds: 1e-10 for the static state, 1e-9 for the motion, 1 % of the counts of steps (--static,
--motion, --steps). A deck that both programs refuse as bad input (exit code 2, for example because
it needs a method of its own example) is not compared; any other failure counts as a difference,
even if both fail alike. --names gives a JSON object {old dotted key or dataset: new one}. Exit code
0: every scene agrees; 1: a scene differs or fails.
"""
import argparse
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET

import h5py
import numpy as np

os.environ.setdefault("TOOLJOINT_REPORT", "off")  # reports of these runs are not needed

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Not compared: values that differ between two runs of one program, and texts.
VOLATILE = ("wall_s", "cpu_s", "real_time_factor", "memory", "program.", "deck.", "date",
            "status_at", "host", "cost_ratio", "warnings")
BAD_INPUT = 2
MARKS = ("<!-- same_results.py: begin -->", "<!-- same_results.py: end -->")
COUNTS = ("steps", "rejected", "newton_iterations", "factorisations", "evaluations", "iterations",
          "solves")


def scenes(tree):
    """(name, deck below the tree, overrides) of every scene that ships."""
    for deck in sorted([*tree.glob("xml/*.xml"), *tree.glob("examples/*/*.xml")]):
        lists = {child.get("name") for child in ET.parse(deck).getroot()}
        if lists & {"Drillstring", "Parts"}:
            yield str(deck.relative_to(tree)), deck.relative_to(tree), []
    for gold in sorted(tree.glob("tests/regression/*.json")):
        content = json.loads(gold.read_text())
        yield f"gold {gold.stem}", pathlib.Path(content["deck"]), content.get("set", [])


def run(program, tree, deck, overrides, end, folder):
    command = [program, "run", str(tree / deck), "--output", folder]
    moves = any(child.get("name") == "Transient" for child in ET.parse(tree / deck).getroot())
    for override in overrides + ([f"Transient/End Time={end}"] if moves else []):
        command += ["--set", override]
    # Without this a program of another tree built at the same path would load the libraries of
    # this one.
    own = {**os.environ, "LD_LIBRARY_PATH": str(pathlib.Path(program).resolve().parent)}
    done = subprocess.run(command, cwd=tree, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, check=False, env=own)
    return done.returncode, done.stdout


def flatten(value, path=""):
    if isinstance(value, dict):
        for key, entry in value.items():
            yield from flatten(entry, f"{path}.{key}" if path else key)
    elif isinstance(value, list):
        for i, entry in enumerate(value):
            yield from flatten(entry, f"{path}.{i}")
    else:
        yield path, value


def difference(a, b):
    """Largest difference relative to the largest entry; infinite if shape or type differ."""
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        if a.shape != b.shape:
            return math.inf
        if a.dtype.kind not in "fiu":
            return 0.0 if np.array_equal(a, b) else math.inf
        if a.size == 0 or np.array_equal(a, b, equal_nan=a.dtype.kind == "f"):
            return 0.0
        if not (np.isfinite(a).all() and np.isfinite(b).all()):
            return math.inf
        return float(np.max(np.abs(a - b)) / max(np.max(np.abs(a)), np.finfo(float).tiny))
    if isinstance(a, bool) or isinstance(
            b, bool) or not isinstance(a, (int, float)) or not isinstance(b, (int, float)):
        return 0.0 if a == b else math.inf
    return 0.0 if a == b else abs(a - b) / max(abs(a), abs(b))


def datasets(file):
    found = {}
    with h5py.File(file, "r") as h5:
        h5.visititems(
            lambda name, item: found.update({name: item[()] if item.shape == () else item[...]})
            if isinstance(item, h5py.Dataset) else None)
    return {
        name: value if isinstance(value, np.ndarray) else np.asarray(value)
        for name, value in found.items()
    }


def bound(name, options):
    if name.split(".")[-1] in COUNTS:
        return options.steps
    return options.motion if name.startswith(
        ("transient", "xdmf", "reduction", "bases", "modes")) else options.static


def compare(old, new, options, names):
    """(largest ratio of a difference to its bound, name, difference), and the number of values
    compared."""
    worst, count = (0.0, "", 0.0), 0
    values = []
    summaries = [json.loads((folder / "summary.json").read_text()) for folder in (old, new)]
    flat = dict(flatten(summaries[1]))
    for key, value in flatten(summaries[0]):
        if not any(word in key for word in VOLATILE):
            values.append((key, value, flat.get(names.get(key, key))))
    if (old / "results.h5").exists() or (new / "results.h5").exists():
        one, two = datasets(old / "results.h5"), datasets(new / "results.h5")
        for name, value in one.items():
            if not name.startswith(("input", "deck", "run")):
                values.append((name, value, two.get(names.get(name, name))))
    for name, a, b in values:
        count += 1
        d = difference(a, b)
        ratio = d / bound(name, options)
        if ratio > worst[0]:
            worst = (ratio, name, d)
    return worst, count


def version(program):
    """The commit that a program prints."""
    own = {**os.environ, "LD_LIBRARY_PATH": str(pathlib.Path(program).resolve().parent)}
    printed = subprocess.run([program, "--version"], stdout=subprocess.PIPE, text=True, check=True,
                             env=own).stdout
    return re.search(r"\b[0-9a-f]{7,40}\b", printed).group(0)[:8]


def cell(row):
    """Cell of a table for a scene."""
    if row is None:
        return ""
    if "exit" in row:
        return "refused by both" if row["exit"] == [
            BAD_INPUT, BAD_INPUT
        ] else f"exit {row['exit'][0]} / {row['exit'][1]}"
    if row["largest_difference"] == 0.0:
        return "bitwise the same"
    size = row["largest_difference"]
    return f"{size if isinstance(size, str) else f'{size:.1e}'} ({row['where']})" + (
        "" if row["agrees"] else ", too large")


def written(page, tables):
    """The page with the tables between its marks: a row for each scene, a column for each pair of
    programs."""
    before, rest = page.split(MARKS[0])
    _, after = rest.split(MARKS[1])
    names = list(dict.fromkeys(row["scene"] for table in tables for row in table["scenes"]))
    found = [{row["scene"]: row for row in table["scenes"]} for table in tables]
    lines = [
        "| scene | " + " | ".join(f"{table['old']} to {table['new']}" for table in tables) + " |",
        "|---|" + "---|" * len(tables)
    ]
    lines += [
        f"| {name} | " + " | ".join(cell(rows.get(name)) for rows in found) + " |" for name in names
    ]
    return before + MARKS[0] + "\n\n" + "\n".join(lines) + "\n\n" + MARKS[1] + after


def main():
    if sys.argv[1:2] == ["--write"]:
        page = pathlib.Path(sys.argv[2])
        page.write_text(
            written(page.read_text(encoding="utf-8"),
                    [json.loads(pathlib.Path(name).read_text()) for name in sys.argv[3:]]),
            encoding="utf-8")
        return 0
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--old-tree", type=pathlib.Path, default=ROOT)
    parser.add_argument("--new-tree", type=pathlib.Path, default=ROOT)
    parser.add_argument("--end", type=float, default=0.2, help="end of the motion [s]")
    parser.add_argument("--only", default="", help="only scenes whose name contains this")
    parser.add_argument("--names", type=pathlib.Path, help="JSON object of old and new names")
    parser.add_argument("--json", type=pathlib.Path, help="file for the table")
    parser.add_argument("--static", type=float, default=1e-10)
    parser.add_argument("--motion", type=float, default=1e-9)
    parser.add_argument("--steps", type=float, default=0.01)
    options = parser.parse_args()
    names = json.loads(options.names.read_text()) if options.names else {}
    news = {name: (deck, overrides) for name, deck, overrides in scenes(options.new_tree.resolve())}
    table, agree = [], True
    print(f"{'scene':45} {'values':>7} {'largest difference':>19}  where")
    for name, deck, overrides in scenes(options.old_tree.resolve()):
        if options.only not in name:
            continue
        if name not in news:
            print(f"{name:45} {'':>7} {'missing':>19}")
            agree = False
            continue
        with tempfile.TemporaryDirectory() as folder:
            folders = [pathlib.Path(folder) / "old", pathlib.Path(folder) / "new"]
            codes = [
                run(options.old, options.old_tree.resolve(), deck, overrides, options.end,
                    str(folders[0])),
                run(options.new, options.new_tree.resolve(), *news[name], options.end,
                    str(folders[1]))
            ]
            if codes[0][0] != codes[1][0] or codes[0][0] != 0:
                refused = codes[0][0] == codes[1][0] == BAD_INPUT
                agree = agree and refused
                last = (codes[1][1].strip().splitlines() or [""])[-1]
                verdict = "not compared" if refused else f"exit {codes[0][0]} / {codes[1][0]}"
                print(f"{name:45} {'':>7} {verdict:>19}  {last[:100]}", flush=True)
                table.append({"scene": name, "exit": [codes[0][0], codes[1][0]]})
                continue
            (ratio, where, d), count = compare(*folders, options, names)
        fits = ratio <= 1.0
        agree = agree and fits
        print(
            f"{name:45} {count:>7} {'bitwise the same' if d == 0.0 else f'{d:.1e}':>19}  "
            f"{where}{'' if fits else '  TOO LARGE'}", flush=True)
        table.append({
            "scene": name, "values": count,
            "largest_difference": d if math.isfinite(d) else "missing", "where": where,
            "agrees": fits
        })
    if not table:
        print("No scene was compared.")
        return 1
    if options.json:
        whole = {
            "old": version(options.old), "new": version(options.new), "end": options.end,
            "scenes": table
        }
        options.json.write_text(json.dumps(whole, indent=1) + "\n")
    return 0 if agree else 1


if __name__ == "__main__":
    sys.exit(main())
