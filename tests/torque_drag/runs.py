# SPDX-License-Identifier: BSD-3-Clause
"""Runs of `tooljoint torque-drag` and of scenes at rest, and their output."""
import csv
import json
import pathlib
import re
import sys

from checks import expect, tooljoint
from screens import expect_screen

SOURCES = pathlib.Path(sys.argv[3])
DECK = str(SOURCES / "xml/build_hold_1400m.xml")


def rows(folder, name="torque_drag.csv"):
    with open(pathlib.Path(folder) / name, encoding="utf-8", newline="") as file:
        table = list(csv.DictReader(file))
    return [{key.split(" [")[0]: value for key, value in row.items()} for row in table]


def run(folder, *settings, ranks=1, deck=DECK):
    arguments = [part for setting in settings for part in ("--set", setting)]
    done = tooljoint("torque-drag", deck, "--output", folder, *arguments, ranks=ranks)
    expect(f"torque-drag ends well {settings}", done.returncode == 0, done.stderr)
    expect_screen(done, folder, "torque_drag")
    margins = [
        line.split()[-3:] for line in done.stdout.partition("soft string")[2].splitlines()
        if line.startswith(("Trip ", "Rotate ", "Drill ", "Back-ream ", "Ream "))
    ]
    expect(f"{folder}: three margins end a line of the table", margins
           and all(re.fullmatch(r"-|>999|\d{1,3}\.\d\d", one) for one in margins[0]), margins)
    return rows(folder)


def near(what, value, expected, tolerance):
    expect(f"{what}: {value:.6g} against {expected:.6g}",
           abs(value - expected) <= tolerance * abs(expected))


def numbers(name, settings):
    """Rows of torque_drag.csv by operation, as numbers."""
    return {
        row["operation"]:
        {key: float(value) if value else None for key, value in row.items() if key != "operation"}
        for row in run(f"forms_{name}", *settings)
    }


def static_state(name, ranks=1, *settings):
    """The list `static` of summary.json of the scene at rest, and its warnings."""
    deck = SOURCES / f"xml/{name}.xml"
    folder = f"stiff_{name}_{ranks}"
    lists = [
        part for one in ("Transient", "Reduction", "Substructures", "Study")
        for part in ("--without", one) if f'"{one}"' in deck.read_text(encoding="utf-8")
    ]
    done = tooljoint("run", str(deck), "--output", folder, *lists,
                     *[part for setting in settings for part in ("--set", setting)], ranks=ranks)
    expect(f"the static state of {name} is found", done.returncode == 0, done.stderr)
    whole = json.loads(pathlib.Path(f"{folder}/summary.json").read_text(encoding="utf-8"))
    return {**whole["static"], "warnings": whole["warnings"]}
