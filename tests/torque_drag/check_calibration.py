#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the calibration of `tooljoint torque-drag`: against linear least squares in a straight
hole, against known coefficients by interval, refusals, broomstick.

    check_calibration.py PROGRAM MPIEXEC SOURCES
"""
import csv
import math
import pathlib
import re
import sys

import numpy
from scipy import stats

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from checks import expect, finish, tooljoint  # noqa: E402

SOURCES = pathlib.Path(sys.argv[3])
STRAIGHT = SOURCES / "xml/build_hold_1400m.xml"
REACH = SOURCES / "xml/extended_reach_5000m.xml"
QUIET = ("Torque and Drag/Stiff String=None", "Torque and Drag/Count=1")


def rows(folder, name):
    with open(pathlib.Path(folder) / name, encoding="utf-8", newline="") as file:
        return [{key.split(" [")[0]: value for key, value in row.items()}
                for row in csv.DictReader(file)]


def run(deck, folder, *settings, ranks=1):
    arguments = [part for setting in (*QUIET, *settings) for part in ("--set", setting)]
    return tooljoint("torque-drag", str(deck), "--output", folder, *arguments, ranks=ranks)


def fitted(folder):
    return {
        row["parameter"]:
        {key: float(row[key] or "nan") for key in ("fitted", "lower", "upper", "at_bound", "deck")}
        for row in rows(folder, "torque_drag_calibration.csv")
    }


def straight():
    """In a straight hole hook load and torque are linear in mu and in the block weight: the fit
    agrees with numpy, its intervals with Student's t."""
    survey = pathlib.Path("calibration_straight.csv").resolve()
    survey.write_text("MD [m], Inc [deg], Azi [deg]\n0, 50, 20\n2000, 50, 20\n", encoding="utf-8")
    inclination, joint = math.radians(50), 0.084
    stand = 7850 * 9.81 * math.pi * (9.0 * (0.0635**2 - 0.0543**2) + 0.5 * (0.084**2 - 0.0413**2))
    matrix, right, lines = [], [], [
        "Bit Depth (ft); remark; Operation; Hook Load [t]; Torque [kft-lbf]"
    ]
    noise = numpy.random.default_rng(7)
    for stands in range(30, 151, 10):
        weight = stand * stands
        along, across = weight * math.cos(inclination), weight * math.sin(inclination)
        for operation, drag, turn in (
            ("Trip out", across, None),
            ("Trip in", -across, None),
            ("Rotate off bottom", 0.0, joint * across),
        ):
            hook = along + 0.31 * drag + 180e3 + 4e3 * noise.standard_normal()
            torque = None if turn is None else 0.31 * turn + 200 * noise.standard_normal()
            if operation == "Rotate off bottom" and stands % 20 == 0:
                hook = None  # a gap
            lines.append(f"{9.5 * stands / 0.3048:.9f}; n/a; "
                         f"{operation if stands % 2 else operation.upper()}; "
                         f"{'' if hook is None else repr(hook / (1e3 * 9.80665))}; "
                         f"{'' if torque is None else repr(torque / 1355.8179483314004)}")
            if hook is not None:
                matrix.append((drag / 1e4, 1 / 1e4))
                right.append((hook - along) / 1e4)
            if torque is not None:
                matrix.append((turn / 1e3, 0.0))
                right.append(torque / 1e3)
    measured = pathlib.Path("measured_straight.csv").resolve()
    measured.write_text("\n".join(lines) + "\n", encoding="utf-8")
    done = run(STRAIGHT, "calibrated", "Well/Trajectory=Survey", f"Well/Survey/File={survey}",
               f"Torque and Drag/Measured={measured}")
    expect("the calibration ends well", done.returncode == 0, done.stderr)
    found = fitted("calibrated")
    matrix, right = numpy.array(matrix), numpy.array(right)
    best, rest = numpy.linalg.lstsq(matrix, right, rcond=None)[:2]
    freedom = len(right) - 2
    half = stats.t.ppf(0.975, freedom) * numpy.sqrt(
        numpy.diag(numpy.linalg.inv(matrix.T @ matrix)) * rest[0] / freedom)
    for name, value, width, scale in (
        ("Contact/Friction/Dynamic", best[0], half[0], 1.0),
        ("Torque and Drag/Block Weight", best[1], half[1], 1e5),
    ):
        one = found[name]
        expect(f"{name}: {one['fitted']} is numpy's {value}",
               abs(one["fitted"] - value) < 1e-5 * max(abs(value), scale * 0.1), one)
        expect(f"{name}: its interval is numpy's {width}",
               abs((one["upper"] - one["lower"]) / 2 - width) < 1e-3 * width, one)
        expect(f"{name} is inside its bounds", one["at_bound"] == 0, one)
    expect("the truth is near",
           abs(found["Contact/Friction/Dynamic"]["fitted"] - 0.31) < 0.01, found)
    expect("what to put into a deck is said", "--set \"Contact/Friction/Dynamic=0.3" in done.stdout,
           done.stdout[-800:])
    lower = run(STRAIGHT, "calibrated_lower", "Well/Trajectory=Survey",
                f"Well/Survey/File={survey}", f"Torque and Drag/Measured={measured}",
                "Contact/Friction/Static=0.2", "Contact/Friction/Dynamic=0.2")
    said = re.findall(r'^ *--set "(.*)"$', lower.stdout, re.MULTILINE)
    expect("the static coefficient is raised with the dynamic one",
           any(one.startswith("Contact/Friction/Static=0.3") for one in said), lower.stdout[-800:])
    again = run(STRAIGHT, "calibrated_again", "Well/Trajectory=Survey",
                f"Well/Survey/File={survey}", *said)
    expect("what is said can be run", again.returncode == 0, again.stderr)
    nulls = pathlib.Path("measured_nulls.csv").resolve()
    nulls.write_text(
        "\n".join(re.sub(r"; $", "; -9999", line.replace("; ; ", "; -999.25; "))
                  for line in lines) + "\n", encoding="utf-8")
    done = run(STRAIGHT, "calibrated_nulls", "Well/Trajectory=Survey", f"Well/Survey/File={survey}",
               f"Torque and Drag/Measured={nulls}")
    expect(
        "the nulls of loggers are gaps", done.returncode == 0
        and "-999.25" in nulls.read_text(encoding="utf-8") and fitted("calibrated_nulls") == found,
        done.stderr)
    lines = rows("calibrated", "torque_drag_measured.csv")
    expect("gaps stay gaps",
           any(row["hook_load"] == "" and row["computed_hook_load"] == "" for row in lines),
           lines[:3])
    two = run(STRAIGHT, "calibrated_2", "Well/Trajectory=Survey", f"Well/Survey/File={survey}",
              f"Torque and Drag/Measured={measured}", ranks=2)
    expect("two ranks fit the same", two.returncode == 0 and fitted("calibrated_2") == found,
           two.stderr)


def intervals():
    """The calibration recovers, by interval, the coefficients used to compute the loads of a reach
    well."""
    truth = {"Contact/Friction/Dynamic": 0.33, "Contact/Intervals/casing/Friction/Dynamic": 0.17}
    settings = [f"{name}={value}" for name, value in truth.items()] + [
        "Contact/Friction/Static=0.4", "Torque and Drag/Block Weight=150 kN",
        "Torque and Drag/Depths={1500, 3000, 4200}",
        "Torque and Drag/Operations={Trip out, Trip in, Rotate off bottom}"
    ]
    done = tooljoint("torque-drag", str(REACH), "--output", "reach_truth", "--set", QUIET[0],
                     *[part for setting in settings for part in ("--set", setting)])
    expect("the reach well is computed", done.returncode == 0, done.stderr)
    measured = pathlib.Path("measured_reach.csv").resolve()
    with open(measured, "w", encoding="utf-8") as file:
        file.write("operation,bit depth [m],hook load [N],surface torque [N m]\n")
        for row in rows("reach_truth", "torque_drag.csv"):
            file.write(f"{row['operation']},{row['bit_depth']},{row['hook_load']},"
                       f"{row['surface_torque']}\n")
    done = run(REACH, "reach", f"Torque and Drag/Measured={measured}",
               "Torque and Drag/Broomstick={0.1, 0.3}")
    expect("it is fitted", done.returncode == 0, done.stderr)
    found = fitted("reach")
    for name, value in {**truth, "Torque and Drag/Block Weight": 150e3}.items():
        expect(f"{name}: {found[name]['fitted']} is {value}",
               abs(found[name]["fitted"] - value) < 1e-4 * value, found[name])
    broom = {(row["operation"], float(row["friction"])): float(row["hook_load"])
             for row in rows("reach", "torque_drag_broomstick.csv")}
    expect(
        "friction spreads the broomstick", broom["Trip out", 0.3] > broom["Trip out", 0.1] >
        broom["Rotate off bottom", 0.1] > broom["Trip in", 0.1] > broom["Trip in", 0.3], broom)
    expect(
        "rotating off bottom has no drag",
        abs(broom["Rotate off bottom", 0.1] - broom["Rotate off bottom", 0.3]) <
        1e-6 * broom["Rotate off bottom", 0.1], broom)


def bounds():
    """Loads of a coefficient of 1.2, beyond the allowed range: the fit ends at 1, without an
    interval, with a message."""
    table = pathlib.Path("measured_bound.csv").resolve()
    done = run(STRAIGHT, "bound_truth", "Contact/Friction/Static=0.4",
               "Contact/Friction/Dynamic=0.4", "Torque and Drag/Depths={400, 800}",
               "Torque and Drag/Operations={Trip out, Trip in, Rotate off bottom}")
    expect("the straight hole is computed", done.returncode == 0, done.stderr)
    loads = {(row["bit_depth"], row["operation"]): float(row["hook_load"])
             for row in rows("bound_truth", "torque_drag.csv")}
    text = "bit depth [m],operation,hook load [N]\n"
    for (depth, operation), load in loads.items():
        free = loads[depth, "Rotate off bottom"]
        text += f"{depth},{operation},{100e3 + free + 3 * (load - free)}\n"
    table.write_text(text, encoding="utf-8")
    done = run(STRAIGHT, "bound", f"Torque and Drag/Measured={table}")
    found = fitted("bound")["Contact/Friction/Dynamic"]
    expect(
        "a coefficient at its bound has no interval", found["at_bound"] == 1
        and found["fitted"] == 1 and math.isnan(found["lower"]) and math.isnan(found["upper"]),
        found)
    expect("and is warned of", "ends at a bound of friction" in " ".join(
        (done.stdout + done.stderr).split()), done.stderr)
    block = fitted("bound")["Torque and Drag/Block Weight"]
    apart = numpy.array([
        float(row["hook_load"]) - float(row["computed_hook_load"])
        for row in rows("bound", "torque_drag_measured.csv")
    ])
    half = stats.t.ppf(0.975,
                       len(apart) - 1) * math.sqrt(apart @ apart / (len(apart) - 1) / len(apart))
    expect(f"the interval of the block weight is that beside a held coefficient, {half}",
           abs((block["upper"] - block["lower"]) / 2 - half) < 1e-3 * half, block)


def refusals():
    table = "bit depth [m],operation,hook load [kN],surface torque [kN m]\n"
    for number, (name, text, words) in enumerate((
        ("no unit", "bit depth,operation,hook load [kN]\n400,Trip in,100\n", "has no unit"),
        ("unit of something else", "bit depth [m],operation,hook load [bar]\n400,Trip in,100\n",
         "\"bar\""),
        ("unknown operation", table + "400,Trip uot,100,\n", "Did you mean \"Trip out\"?"),
        ("unknown operation below a title and gaps",
         "Well A; Rig 7\n" + table + "400,Trip in,NaN,null\n400,Trip uot,1,\n", ".csv:4:"),
        ("no number", table + "400,Trip out,many,\n", "is not a finite number"),
        ("no measured column", "bit depth [m],operation\n400,Trip in\n", "nothing was measured"),
        ("no line", table, "no measurement follows"),
        ("too deep", table + "9400,Trip in,100,\n800,Trip in,120,\n900,Trip in,120,\n",
         "longer string"),
        ("too few", table + "400,Trip in,100,\n", "do not suffice"),
        ("not told apart", table + "1000,Trip out,500,\n1000,Trip out,501,\n1000,Trip out,502,\n",
         "cannot distinguish friction from block weight"),
    )):
        file = pathlib.Path(f"bad_{number}.csv").resolve()
        file.write_text(text, encoding="utf-8")
        done = run(STRAIGHT, f"bad_{number}", f"Torque and Drag/Measured={file}")
        expect(f"refused: {name}", done.returncode == 2 and words in done.stderr
               and file.name in done.stderr, f"{done.returncode} {done.stderr}")
    done = run(STRAIGHT, "bad_missing", "Torque and Drag/Measured=nowhere.csv")
    expect("refused: no file", done.returncode == 2 and "nowhere.csv" in done.stderr,
           f"{done.returncode} {done.stderr}")


straight()
intervals()
bounds()
refusals()
sys.exit(finish())
