#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Printed results in field units: check_units.py PROGRAM MPIEXEC SOURCES

Commands run twice, with and without --units field. Both outputs have the same words and quantities:
each number, times the exact value of its unit, agrees within the printed digits. Files are bitwise
equal.
"""
import csv
import json
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from checks import expect, finish, tooljoint  # noqa: E402

SOURCES = pathlib.Path(sys.argv[3])
SCENE = str(SOURCES / "tests/effects/scene.xml")
# exact (NIST SP 811, appendix B.8)
FOOT, INCH, POUND, GRAVITY = 0.3048, 0.0254, 0.45359237, 9.80665
POUND_FORCE = POUND * GRAVITY  # 4.4482216152605 N
SI = {
    "kN m": 1e3, "N m": 1.0, "kN/m": 1e3, "N/m": 1.0, "kN": 1e3, "N": 1.0, "m/s2": 1.0, "m/s": 1.0,
    "mm": 1e-3, "m": 1.0, "MPa": 1e6, "deg/30 m": 1 / 30, "kg m2": 1.0, "N m s/rad": 1.0,
    "N m/rad": 1.0, "m/N": 1.0, "rad/N": 1.0
}
FIELD = {
    "kN m": ("kft-lbf", 1e3 * FOOT * POUND_FORCE),
    "N m": ("ft-lbf", FOOT * POUND_FORCE),
    "kN/m": ("lbf/ft", POUND_FORCE / FOOT),
    "N/m": ("lbf/ft", POUND_FORCE / FOOT),
    "kN": ("klbf", 1e3 * POUND_FORCE),
    "N": ("lbf", POUND_FORCE),
    "m/s2": ("ft/s2", FOOT),
    "m/s": ("ft/s", FOOT),
    "mm": ("in", INCH),
    "m": ("ft", FOOT),
    "MPa": ("psi", POUND_FORCE / INCH**2),
    "deg/30 m": ("deg/100 ft", 1 / (100 * FOOT)),
    "kg m2": ("lbm ft2", POUND * FOOT**2),
    "N m s/rad": ("ft-lbf s/rad", FOOT * POUND_FORCE),
    "N m/rad": ("ft-lbf/rad", FOOT * POUND_FORCE),
    "m/N": ("ft/lbf", FOOT / POUND_FORCE),
    "rad/N": ("rad/lbf", 1 / POUND_FORCE),
}
NUMBER = r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?"


def quantities(text, units):
    """(number as printed, unit) of a text, and its words without numbers; the program wraps lines
    at 100 columns."""
    pattern = re.compile(
        f"({NUMBER}) ({'|'.join(map(re.escape, sorted(units, key=len, reverse=True)))})(?![\\w/]| "
        "the list)")
    text = " ".join(" ".join(
        line for line in text.splitlines()
        if not line.startswith("time")).split())  # without the seconds of this machine
    return pattern.findall(text), re.sub(NUMBER, "#", pattern.sub("#", text))


def half_digit(text):
    """Half of the last digit of a printed number."""
    mantissa, _, exponent = text.partition("e")
    return 0.5 * 10.0**(int(exponent or 0) - len(mantissa.partition(".")[2]))


def agree(usual, other, factor, other_factor):
    # a trailing zero may be left out: an integer of four digits can stand for as many decimals
    return abs(float(usual) * factor - float(other) * other_factor) <= 1.001 * (
        half_digit(usual) * factor + half_digit(other) * other_factor)


def same_words(what, usual, field, at_least):
    """Compares both outputs: words, and quantities one by one."""
    found, words = quantities(usual, SI)
    converted, others = quantities(field, {name for name, _ in FIELD.values()})
    at = next((i for i, (one, other) in enumerate(zip(words, others)) if one != other),
              min(len(words), len(others)))
    expect(f"{what}: the same words", words == others,
           f"{words[max(0, at - 60):at + 60]} | {others[max(0, at - 60):at + 60]}")
    faults = [
        f"{number} {unit} is not {other} {name}"
        for (number, unit), (other, name) in zip(found, converted)
        if FIELD[unit][0] != name or not agree(number, other, SI[unit], FIELD[unit][1])
    ]
    expect(f"{what}: {len(found)} quantities, each with the exact factor", not faults
           and len(found) == len(converted) and len(found) >= at_least, "; ".join(faults[:4]))


def both(command, deck, *arguments, at_least, files=(), begin="", end=None):
    """Runs the command in both systems of units, with results in the folders usual and field;
    compares its output from `begin` up to `end`, and its files."""
    out = [
        tooljoint(command, deck, *arguments,
                  *(["--output", folder] if command not in ("check", "modes") else []), *units)
        for folder, units in (("usual", []), ("field", ["--units", "field"]))
    ]
    what = " ".join([command, pathlib.Path(deck).stem, *arguments[1::2]])
    expect(f"{what}: both end well", all(one.returncode == 0 for one in out),
           out[0].stderr[-300:] + out[1].stderr[-300:])
    note = "units       of the field in print; files hold SI units\n"
    expect(f"{what}: says in which units it prints", note in out[1].stdout
           and note not in out[0].stdout, out[1].stdout[-200:])
    texts = [
        text[text.index(begin):text.index(end) if end else None]
        for text in (out[0].stdout.replace("usual", "field"), out[1].stdout.replace(note, ""))
    ]
    same_words(what, *texts, at_least)
    same_words(f"{what}, warnings", out[0].stderr.replace("usual", "field"), out[1].stderr, 0)
    for name in files:
        expect(f"{what}: {name} is the same file",
               pathlib.Path("usual", name).read_bytes() == pathlib.Path("field", name).read_bytes())
    return [one.stdout for one in out]


def rows(name):
    with open(name, encoding="utf-8", newline="") as text:
        return [
            {key.split(" [")[0]: cell for key, cell in row.items()} for row in csv.DictReader(text)
        ]


def figures(folder):
    found = json.loads(pathlib.Path(folder, "summary.json").read_text(encoding="utf-8"))
    return found["model"], found["static"], found["transient"]["figures"]


def of_strings():
    both("check", SCENE, at_least=8)
    both("check", SCENE, "--set", "Top Drive/Control=Speed", "--set", "Top Drive/Inertia=2000",
         "--set", "Top Drive/Proportional Gain=500", "--set", "Top Drive/Integral Gain=100",
         "--set", "Top Drive/Torque Limit=40 kN m", "--set", "Supports/Top=u v w", at_least=12)
    both("run", SCENE, "--set", "Transient/End Time=0.1", at_least=20,
         files=["motion.csv", "static_nodes.csv", "static_elements.csv", "figures_nodes.csv"])
    expect("run: the numbers of summary.json stay SI", figures("usual") == figures("field"))
    both("run", str(SOURCES / "tests/effects/log.xml"), at_least=4,
         files=["measured.csv", "measured_peaks.csv"], begin="measured    ", end="results ")
    both("buckling", str(SOURCES / "tests/effects/buckling.xml"), at_least=4,
         files=["buckling.csv", "buckling_profile.csv"], begin="crookedness ", end="contact force")
    both("modes", SCENE, "--set", "Reduction/Mode Selection/Modes=2", "--count", "3", at_least=10)
    # the heading of the table, and numbers that are in SI in a file
    out = both("torque-drag", str(SOURCES / "xml/build_hold_1400m.xml"), "--set",
               "Torque and Drag/Count=1", "--set", "Torque and Drag/Stiff String=None", at_least=10,
               files=["torque_drag.csv", "torque_drag_profile.csv"])
    for row in rows("field/torque_drag.csv"):
        line = next(line for line in out[1].splitlines() if line.startswith(row["operation"] + " "))
        for key, unit in (
            ("hook_load", "klbf"),
            ("surface_torque", "kft-lbf"),
            ("side_force", "lbf/ft"),
        ):
            shown = re.findall(f"({NUMBER}) {unit}(?![\\w-])", line)
            factor = next(value for name, value in FIELD.values() if name == unit)
            expect(f"{row['operation']}: {shown} {unit} is {key} of the table",
                   len(shown) == 1 and agree(shown[0], row[key], factor, 1.0), line)


def of_bottom_hole():
    both("bha", str(SOURCES / "tests/effects/bottom_hole.xml"), "--set",
         "Bottom-Hole Assembly/Weight On Bit={0 kN, 50 kN}", at_least=5,
         files=["bha.csv", "bha_profile.csv"], end="side force of the bit on the rock")
    out = tooljoint("bha", str(SOURCES / "tests/effects/bottom_hole.xml"), "--units", "field",
                    "--output", "field").stdout.splitlines()
    heading = next(i for i, line in enumerate(out) if line.split()[:2] == ["deg", "klbf"])
    expect(
        "the heading of bha has units of the field", out[heading].split() == [
            "deg", "klbf", "deg", "klbf", "deg", "deg", "ft", "kft-lbf", "at", "ft", "psi"
        ], out[heading])
    for line, row in zip(out[heading + 1:], rows("field/bha.csv")):
        numbers = re.findall(NUMBER, line.replace("rotating", "0"))
        expected = [
            ("weight_on_bit", 1, 1e3 * POUND_FORCE),
            ("side_force_high", 3, 1e3 * POUND_FORCE),
            ("side_force_right", 4, 1e3 * POUND_FORCE),
            ("largest_moment", -3, 1e3 * FOOT * POUND_FORCE),
            ("largest_moment_from_bit", -2, FOOT),
            ("largest_von_mises", -1, POUND_FORCE / INCH**2),
        ]
        wrong = [(key, numbers[place], row[key]) for key, place, factor in expected
                 if not agree(numbers[place], row[key], factor, 1.0)]
        expect("a row of bha in print is the one of the table", not wrong, f"{wrong} {line}")


def of_other_commands():
    rotor = str(SOURCES / "tests/effects/rotor.xml")
    both("response", rotor, at_least=1, files=["response.csv", "peaks.csv"])
    both("response", str(SOURCES / "tests/effects/rotor_loads.xml"), "--set",
         "Response/Excitation=Transfer", at_least=1, files=["response.csv"])
    both("campbell", rotor, at_least=0, files=["campbell.csv", "crossings.csv"])
    both("map", str(SOURCES / "tests/study/map.xml"), "--set", "Transient/End Time=0.05", "--set",
         "Map/Pictures=false", "--set", "Map/Grid/weight/Values={4000, 8000}", at_least=4)
    both("study", str(SOURCES / "tests/study/study.xml"), "--timing", "shared", "--set",
         "Study/End Time=0.04", "--set", "Study/Window=0.02", "--set", "Study/Repeats=1",
         "--without", "Study/Methods/Craig-Bampton", "--without", "Study/Methods/too coarse",
         at_least=3, begin="reference   own error")


def of_the_option():
    for word, meant in (("feild", "field"), ("SI", "si"), ("metric", None)):
        done = tooljoint("check", SCENE, "--units", word)
        sentence = f'--units "{word}" is no system of units.' + (
            f' Did you mean "{meant}"?' if meant else "") + ' Available: "si", "field".'
        expect(f"--units {word}: exit code 1 and the sentence", done.returncode == 1
               and sentence in done.stderr and done.stdout == "",
               f"({done.returncode}) {done.stderr}")
    for command in ("run", "check", "modes", "torque-drag", "bha", "buckling", "campbell",
                    "response", "study", "map", "export"):
        shown = tooljoint(command, "--help").stdout
        expect(f"{command} has the option", "--units {si,field}" in shown)
    listed = tooljoint("doc", "units").stdout
    for name, factor in FIELD.values():
        shown = re.search(r"\| " + re.escape(name) + r" \| (\S+) ", listed)
        if name == "deg/100 ft":
            factor *= 3.141592653589793 / 180
        expect(f"doc units has {name}", shown is not None
               and abs(float(shown[1]) / factor - 1) < 1e-14, shown)


of_the_option()
of_strings()
of_bottom_hole()
of_other_commands()
sys.exit(finish())
