# SPDX-License-Identifier: BSD-3-Clause
"""Decks of collars in a hole, and rows of `tooljoint bha`."""
import csv
import math
import pathlib
import sys

from checks import expect, tooljoint
from screens import expect_screen

SOURCES = pathlib.Path(sys.argv[3])
BORE, OUTER, INNER, YOUNG, DENSITY, GRAVITY = 0.108, 0.08, 0.036, 2.1e11, 7850.0, 9.81
RIGIDITY = YOUNG * math.pi / 4 * (OUTER**4 - INNER**4)
WEIGHT = DENSITY * math.pi * (OUTER**2 - INNER**2) * GRAVITY
CLEARANCE = BORE - OUTER
LENGTH = 60.0


def parameter(name, value):
    kind = "Array(string)" if value.startswith("{") else "string"
    return f'<Parameter name="{name}" type="{kind}" value="{value}"/>'


def listed(name, *content):
    return f'<ParameterList name="{name}">' + "".join(content) + "</ParameterList>"


def piece(length, *extra, elements=None):
    """A collar of the common section without shear, in elements of half a metre."""
    return [
        parameter("Length", f"{length} m"),
        f'<Parameter name="Elements" type="int" value="{elements or max(1, round(2 * length))}"/>',
        parameter("Outer Radius", f"{OUTER} m"),
        parameter("Inner Radius", f"{INNER} m"),
        '<Parameter name="Shear Deformation" type="bool" value="false"/>', *extra
    ]


def gauge(radius, position=0.5, offset=None, direction=None):
    extra = [parameter("Gauge Position", f"{position} m"), parameter("Gauge Radius", f"{radius} m")]
    if offset is not None:
        extra += [
            parameter("Gauge Offset", f"{offset} m"),
            parameter("Gauge Offset Direction", f"{direction} deg")
        ]
    return extra


def bend(angle, position=0.5):
    return [
        listed("Bend", parameter("Angle", f"{angle} deg"), parameter("Position", f"{position} m"))
    ]


def pad(force, direction, position=0.5):
    return [
        listed("Pad", parameter("Force", f"{force} N"), parameter("Position", f"{position} m"),
               parameter("Direction", f"{direction} deg"))
    ]


def deck(name, features, inclination=90.0, azimuth=0.0, gravity=GRAVITY, length=LENGTH, more="",
         loads=""):
    """A uniform collar in a straight hole.
    `features`: {distance from the bit: parameters of a piece of a metre with it in its middle}."""
    pieces, order, top = {}, [], length
    for place in sorted(features, reverse=True):
        pieces[f"collar {place}"] = piece(top - place - 0.5)
        pieces[f"feature {place}"] = piece(1.0, *features[place])
        order += [f"collar {place}", f"feature {place}"]
        top = place - 0.5
    pieces["lowest"] = piece(top)
    order.append("lowest")
    well = listed(
        "Well", parameter("Trajectory", "Vertical"),
        listed("Vertical", parameter("Length", f"{length} m"),
               parameter("Inclination", f"{inclination} deg"),
               parameter("Azimuth", f"{azimuth} deg")), parameter("Bore Radius", f"{BORE} m"))
    string = listed(
        "Drillstring",
        listed("Components", *(listed(one, *content) for one, content in pieces.items())),
        parameter("Assembly", "{" + ", ".join(order) + "}"),
        listed("Material", parameter("Density", f"{DENSITY} kg/m3"),
               parameter("Young Modulus", f"{YOUNG} Pa")))
    text = listed(name, well, string, listed("Contact", parameter("Stiffness", "1e10 N/m")),
                  listed("Loads", parameter("Gravity", f"{gravity} m/s2"), loads), more)
    file = pathlib.Path(f"{name}.xml")
    file.write_text('<?xml version="1.0"?>\n' + text.replace("><", ">\n<"), encoding="utf-8")
    return str(file)


def rows(folder, table):
    with open(pathlib.Path(folder) / table, encoding="utf-8", newline="") as file:
        return [{
            key.split(" [")[0]: float(value) if key not in ("mode", "gauge") and value else value
            for key, value in row.items()
        } for row in csv.DictReader(file)]


def run(file, *settings, folder=None, ranks=1):
    """Rows of bha.csv with their contacts and their profiles."""
    folder = folder or "out_" + pathlib.Path(file).stem
    done = tooljoint("bha", file, "--output", folder,
                     *(part for one in settings for part in ("--set", one)), ranks=ranks)
    expect(f"bha of {file} ends well {settings}", done.returncode == 0, done.stderr)
    expect_screen(done, folder, "bha")
    found = rows(folder, "bha.csv")
    for name in ("contacts", "profile"):
        lines = rows(folder, f"bha_{name}.csv")
        for row in found:
            row[name] = [
                one for one in lines if all(one[key] == row[key]
                                            for key in ("inclination", "weight_on_bit", "mode",
                                                        "tool_face"))
            ]
    for row in found:
        expect("the state balances", row["force_defect"] < 1e-6 and row["moment_defect"] < 2e-3,
               (row["force_defect"], row["moment_defect"]))
    return found


def near(what, value, expected, tolerance, scale=None):
    expect(f"{what}: {value:.6g} against {expected:.6g}",
           abs(value - expected) <= tolerance * (scale if scale is not None else abs(expected)), "")
