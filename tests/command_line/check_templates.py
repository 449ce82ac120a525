#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Templates and decks of new folders can be checked and run unchanged.

    check_templates.py PROGRAM MPIEXEC
"""
import csv
import json
import math
import pathlib
import re
import shutil
import sys
import xml.etree.ElementTree as xml

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from checks import COLUMNS, expect, finish, tooljoint, wide  # noqa: E402
from screens import expect_screen  # noqa: E402

FOOT = 0.3048  # m
SHORT = ("--set", "Transient/End Time=0.05")


def printed(file, *words):
    """The template in a file."""
    done = tooljoint("template", *words)
    expect(f"template {' '.join(words)}: exit code 0", done.returncode == 0, done.stderr)
    expect(f"template {' '.join(words)}: at most {COLUMNS} columns", not wide(done.stdout),
           "\n".join(wide(done.stdout)))
    pathlib.Path(file).write_text(done.stdout, encoding="utf-8")
    return done.stdout


def summary(folder):
    return json.loads((pathlib.Path(folder) / "summary.json").read_text(encoding="utf-8"))


def runs(deck, *settings):
    """The deck is accepted without a warning and runs; its summary."""
    checked = tooljoint("check", deck)
    expect(f"{deck}: check accepts it without a warning", checked.returncode == 0
           and checked.stderr == "", checked.stderr[-400:])
    folder = pathlib.Path(deck).stem + "_results"
    done = tooljoint("run", deck, "--output", folder, *settings)
    expect(f"{deck}: runs without a warning", done.returncode == 0 and done.stderr == "",
           done.stderr[-400:])
    return summary(folder) if done.returncode == 0 else {}


def tvd(stations):
    """Vertical depth of the last station by minimum curvature: MD/2 (cos I1 + cos I2) 2/b tan b/2
    for a bend b."""
    depth = 0.0
    rows = [stations[i:i + 3] for i in range(0, len(stations), 3)]
    for (a, i, z), (b, j, y) in zip(rows, rows[1:]):
        i, j, turn = math.radians(i), math.radians(j), math.radians(y - z)
        bend = math.acos(
            min(1.0,
                math.cos(i) * math.cos(j) + math.sin(i) * math.sin(j) * math.cos(turn)))
        ratio = math.tan(bend / 2) / (bend / 2) if bend > 0 else 1.0
        depth += (b - a) / 2 * (math.cos(i) + math.cos(j)) * ratio
    return depth


def wells():
    """`template well` and the deck of `new` describe one well; its hook load equals that of torque
    and drag."""
    text = printed("well.xml", "well")
    expect("template well: a page, of tubulars of the library", "fill*5 in stand" in text
           and len(text.splitlines()) < 70, str(len(text.splitlines())))
    alone = runs("well.xml", "--set", "Transient/End Time=5", "--set", "Transient/Progress=false")
    said = " ".join(tooljoint("check", "well.xml").stdout.split())
    stations = [float(number) for number in re.search(r'"\{([\d.,\s]+)\}"', text)[1].split(",")]
    depth, vertical, length = stations[-3] * FOOT, tvd(
        stations) * FOOT, 8 * 9.45 + 0.35  # collars and bit
    for wanted in (f"bit at MD {depth:.1f} m, TVD {vertical:.1f} m",
                   f"{length:.2f} m of string below the last 5 in stand"):
        expect(f"check of a well: {wanted}", wanted in said, said[:500])
    moved = alone.get("transient", {}).get("figures", {})
    expect("template well: the bit sticks and slips",
           moved.get("stick_slip_index", 0) > 0.5, str(moved.get("stick_slip_index")))
    for folder in ("wells", "my_well"):
        shutil.rmtree(folder, ignore_errors=True)
    for path, ranks in (("my_well", 1), ("wells/b-2/", 2)):
        done = tooljoint("new", path, ranks=ranks)
        name = pathlib.Path(path).name
        made = sorted(file.name for file in pathlib.Path(path).iterdir())
        expect(f"new {path}: deck, survey and README", done.returncode == 0
               and made == sorted([f"{name}.xml", "survey.csv", "README.md"]),
               f"{made} {done.stderr}")
        readme = (pathlib.Path(path) / "README.md").read_text(encoding="utf-8")
        expect(f"new {path}: the README names the deck", f"tooljoint run {name}.xml" in readme
               and "@" not in readme, readme)
        expect(f"new {path}: so does the deck itself",
               xml.parse(pathlib.Path(path) / f"{name}.xml").getroot().get("name") == name)
    folder = runs("my_well/my_well.xml", *SHORT)
    loads = [s["static"]["hook_load"] for s in (alone, folder) if s]
    expect("both wells have one hook load",
           len(loads) == 2 and abs(loads[0] / loads[1] - 1) < 1e-9, str(loads))
    done = tooljoint("torque-drag", "well.xml", "--output", "drag", "--verbose")
    expect("torque-drag --verbose: its wall time", "\nwall time   " in done.stdout,
           done.stdout[-400:])
    with open("drag/torque_drag.csv", encoding="utf-8") as file:
        rows = [{name.split(" [")[0]: value for name, value in row.items()}
                for row in csv.DictReader(file)]
    deepest = max(float(row["bit_depth"]) for row in rows)
    drilling = [
        float(row["hook_load"]) for row in rows
        if float(row["bit_depth"]) == deepest and row["operation"] == "Drill rotating"
    ]
    expect("the hook load is that of torque and drag within 1 %", done.returncode == 0
           and len(drilling) == 1 and abs(loads[0] / drilling[0] - 1) < 0.01, f"{loads} {drilling}")


def components():
    printed("components.xml", "components")


def refusals():
    pathlib.Path("taken").mkdir(exist_ok=True)
    pathlib.Path("taken/mine.txt").write_text("mine", encoding="utf-8")
    pathlib.Path("file").write_text("", encoding="utf-8")
    for words, code, sentence in (
        (("new", "taken"), 5, "taken is there already and not empty"),
        (("new", "file/inside"), 5, "file/inside cannot be made"),
        (("new", "a b"), 1, 'The name "a b" cannot be that of a deck'),
        (("new", ".."), 1, "cannot be that of a deck"),
        (("template", "well", "--all"), 1, '--all belongs to the template "scene"'),
        (("template", "wells"), 1, 'There is no template "wells". Available: "well", "parts"'),
    ):
        done = tooljoint(*words)
        expect(f"{' '.join(words)}: exit code {code}", done.returncode == code
               and sentence in done.stderr, f"({done.returncode}) {done.stderr}")
    expect("what was there is left alone",
           sorted(p.name for p in pathlib.Path("taken").iterdir()) == ["mine.txt"])


def parts():
    """Eight springs in a row: omega_1 = 2 sqrt(k/m) sin(pi / 32)."""
    printed("parts.xml", "parts")
    runs("parts.xml", *SHORT)
    done = tooljoint("modes", "parts.xml", "--count", "3", "--output", "parts_modes")
    expect_screen(done, "parts_modes", "modes")
    with open("parts_modes/modes.csv", encoding="utf-8") as file:
        first = float(next(csv.DictReader(file))["full [Hz]"])
    exact = 2 * math.sqrt(1e6) * math.sin(math.pi / 32) / (2 * math.pi)
    expect("parts: the first frequency is that of eight springs", done.returncode == 0
           and abs(first / exact - 1) < 1e-9, f"{first} {exact}")
    printed("bar.json", "part")
    files = [f"--set=Parts/Imported/{part}/File=bar.json" for part in ("first", "second")]
    named = tooljoint("modes", "parts.xml", "--count", "3", "--output", "file_modes", "--quiet",
                      *files)
    expect("modes --quiet prints nothing", named.stdout == "", named.stdout)
    expect(
        "parts: those of bar.json are the same", named.returncode == 0
        and pathlib.Path("file_modes/modes.csv").read_text()
        == pathlib.Path("parts_modes/modes.csv").read_text(), named.stderr)
    beside = tooljoint(
        "check", "parts.xml", "--set", 'Parts/Imported/first/File={"format": "tooljoint part 1", '
        '"components": ["u"], "dofs": [[1, "u"]], "mass": "M.mtx", "stiffness": [[1]]}')
    expect(
        "parts: a part in the deck has no files beside it", beside.returncode == 2
        and 'names the file "M.mtx", but stands in no folder' in beside.stderr, beside.stderr)
    asked = tooljoint("modes", "parts.xml", "--count", "3", "--bases")
    frequencies, vectors = done.stdout.find("full [Hz]"), asked.stdout.find("|Phi'M Phi - I|")
    expect(
        "parts: frequencies come first, the vectors of the bases behind them where they are asked "
        "for", 0 < frequencies < done.stdout.find("RK4 step")
        and "|Phi'M Phi - I|" not in done.stdout and vectors > asked.stdout.find("full [Hz]") > 0,
        asked.stdout[-600:])


def study():
    printed("study.xml", "study")
    checked = tooljoint("check", "study.xml")
    expect("study.xml: check accepts it", checked.returncode == 0, checked.stderr[-400:])
    done = tooljoint("study", "study.xml", "--output", "study", "--fresh", "--timing", "shared",
                     "--set", "Study/Pictures=false", "--set", "Study/End Time=0.3", "--set",
                     "Study/Window=0.2")
    rows = [row for row in summary("study").get("study", []) if row["kind"] == "method"]
    expect(
        "study.xml: six rows, all done, errors below 5 %", done.returncode == 0 and len(rows) == 6
        and all(row["status"] == "done" and row["vibration_error"] < 0.05 for row in rows),
        f"{[(row['label'], row['status'], row['vibration_error']) for row in rows]} "
        f"{done.stderr[-300:]}")


def scenes():
    basic, whole = printed("scene.xml", "scene"), printed("all.xml", "scene", "--all")
    expect("template scene leaves out what is for experts", "for experts" not in basic
           and "for experts" in whole and len(basic) < len(whole))
    for deck in ("scene.xml", "all.xml"):
        runs(deck)


def first_words():
    done = tooljoint()
    expect(
        "tooljoint alone: exit code 1, and what to type", done.returncode == 1
        and "tooljoint new my_well" in done.stderr and "tooljoint template well" in done.stderr,
        f"({done.returncode}) {done.stderr}")


def main():
    for part in (wells, components, refusals, parts, study, scenes, first_words):
        part()
    return finish()


if __name__ == "__main__":
    sys.exit(main())
