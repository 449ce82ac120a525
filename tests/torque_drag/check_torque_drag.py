#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks `tooljoint torque-drag` through the program: closed forms, the static state of the stiff
string, tables, refusals, ranks.

    check_torque_drag.py PROGRAM MPIEXEC SOURCES
"""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
import closed_forms  # noqa: E402
from checks import expect, finish, tooljoint  # noqa: E402
from runs import DECK, SOURCES, near, numbers, rows, run, static_state  # noqa: E402
from margins import bends, grades, neutral_point, pressure  # noqa: E402
from against_statics import (  # noqa: E402
    beside, buckled, in_motion, level, stiff, weight_on_bit, wound)
from tables import announced, files, resumed, tables_and_refusals  # noqa: E402


def straight():
    """An inclined straight hole: weight along the axis, friction by the side force, buckling by
    Dawson and Paslay."""
    inclination = math.radians(50)
    well = ["Well/Trajectory=Survey", "Well/Survey/File=straight.csv"]
    survey = pathlib.Path("straight.csv").resolve()
    survey.write_text("MD [m], Inc [deg], Azi [deg]\n0, 50, 20\n2000, 50, 20\n", encoding="utf-8")
    well[1] = f"Well/Survey/File={survey}"
    table = run("straight", *well, "Supports/Bit=none", "Torque and Drag/Count=2",
                "Torque and Drag/Yield Strength=724 MPa", "Torque and Drag/Joint Length=9.5")
    length, density, gravity, mu, joint = 1425.0, 7850.0, 9.81, 0.25, 0.084
    body, tool = (math.pi * (a * a - b * b) for a, b in ((0.0635, 0.0543), (0.084, 0.0413)))
    weight = density * gravity * 150 * (9.0 * body + 0.5 * tool)
    along, across = weight * math.cos(inclination), weight * math.sin(inclination)
    full = {row["operation"]: row for row in table if float(row["bit_depth"]) > 0.99 * length}
    near("trip out", float(full["Trip out"]["hook_load"]), along + mu * across, 1e-6)
    near("trip in", float(full["Trip in"]["hook_load"]), along - mu * across, 1e-6)
    near("drill rotating", float(full["Drill rotating"]["surface_torque"]),
         4000 + mu * joint * across, 1e-4)
    near("drill sliding", float(full["Drill sliding"]["hook_load"]), along - mu * across - 5e4,
         1e-6)
    # The stiff string lies on its joints. During rotation the wall carries the weight across the
    # hole with N^2 + (mu N)^2 = (w sin)^2. The support at the top carries the weight of part of a
    # pipe.
    profile = rows("straight", "torque_drag_stiff_profile.csv")
    pressed = {
        name: sum(float(row["contact_force"]) for row in profile if row["operation"] == name)
        for name in full
    }
    stiff = {
        name: (float(row["stiff_hook_load"]), float(row["stiff_surface_torque"]))
        for name, row in full.items()
    }
    pipe = 9.5 / length
    near("stiff: contact forces", pressed["Trip out"], across, pipe)
    near("stiff: contact forces of a string that turns", pressed["Rotate off bottom"],
         across / math.sqrt(1 + mu * mu), pipe)
    for name, hook in (
        ("Trip out", along + mu * pressed["Trip out"]),
        ("Trip in", along - mu * pressed["Trip in"]),
        ("Rotate off bottom", along),
        ("Drill sliding", along - mu * pressed["Drill sliding"] - 5e4),
    ):
        near(f"stiff: {name}", stiff[name][0], hook, 1e-5)
    near("stiff: torque off bottom", stiff["Rotate off bottom"][1],
         mu * joint * pressed["Rotate off bottom"], 1e-4)
    ream = math.hypot(0.05, 4 * math.pi * joint)
    near("stiff: drag of reaming", along - stiff["Ream"][0], mu * 0.05 / ream * pressed["Ream"],
         1e-3)
    inertia = math.pi / 4 * (0.0635**4 - 0.0543**4)
    limit = 2 * math.sqrt(210e9 * inertia * weight / length * math.sin(inclination) /
                          (0.108 - 0.0635))
    expect(
        "the compression above the bit is that on it, so the margin of the lowest body is the "
        "limit over it",
        abs(float(full["Drill rotating"]["sinusoidal_margin"]) / (limit / 5e4) - 1) < 0.05,
        full["Drill rotating"]["sinusoidal_margin"])
    expect(
        "the stiff string has the same margin within its weight on an element of 9 m",
        abs(float(full["Drill rotating"]["stiff_sinusoidal_margin"]) / (limit / 5e4) - 1) < 0.06
        and abs(
            float(full["Drill rotating"]["stiff_helical_margin"]) /
            float(full["Drill rotating"]["stiff_sinusoidal_margin"]) - math.sqrt(2)) < 1e-9,
        full["Drill rotating"]["stiff_sinusoidal_margin"])
    near("side force of a joint", float(full["Trip out"]["joint_force"]),
         weight * math.sin(inclination) / 150, 1e-6)
    forces = [(float(row["depth"]), float(row["contact_force"])) for row in profile
              if row["operation"] == "Trip out"]
    joints = [
        sum(force for s, force in forces if start <= s < start + 9.5 - 1e-6) for start, _ in forces
    ]
    near("contact force of a joint of the stiff string",
         float(full["Trip out"]["stiff_joint_force"]), max(joints), 1e-6)
    near("which is the weight of a pipe where its neighbours bear theirs",
         sorted(joints)[len(joints) // 2],
         weight * math.sin(inclination) / 150, 0.01)
    # half the friction at tool joints, in both strings and in the static state of a run; ten times
    # the friction at bodies, which do not touch
    factors = [
        "Drillstring/Components/joint/Friction Factor=0.5",
        "Drillstring/Components/body/Friction Factor=10"
    ]
    half = run("joint_friction", *well, *factors, "Supports/Bit=none", "Torque and Drag/Count=1",
               "Torque and Drag/Operations={Trip out}")[0]
    near("trip out on joints with half the friction", float(half["hook_load"]),
         along + 0.5 * mu * across, 1e-6)
    near("stiff: drag of joints with half the friction",
         float(half["stiff_hook_load"]) - along, 0.5 * (stiff["Trip out"][0] - along), 1e-2)
    expect("nothing is compressed off bottom", full["Rotate off bottom"]["helical_margin"] == "")


def forms():
    """The soft string against closed forms, through the program."""
    for what, truth, found, _, tolerance in closed_forms.soft(numbers):
        near(what, found, truth, tolerance)


def limits():
    """The stiff string of a pipe without joints tends to the soft one. Where its load changes the
    wall, it crosses the hole without contact: for a load that changes by q' per length the crossing
    has a length l ~ (T r/q')^(1/3), so the torque lacks q' l^2 ~ r^(2/3). The stretch by friction
    moves this place along the bend, in proportion to 1/E."""
    found = {(clearance, young): (torque, drag)
             for clearance, young, torque, drag in closed_forms.stiff(numbers, closed_forms.TESTED)}
    soft = closed_forms.YOUNG / 100
    short = {clearance: 1 - found[clearance, soft][0] / closed_forms.LIMIT for clearance in (1, 6)}
    expect(f"stiff string, clearance 1 mm: torque of the soft one that climbs {short}",
           0 < short[1] < 3e-4)
    near("and what it lacks grows with r^(2/3)", short[6] / short[1], 6**(2 / 3), 0.2)
    lacks = 1 - found[1, closed_forms.YOUNG][1]
    expect(f"drag of the soft string with Young's modulus of steel {lacks}", abs(lacks) < 6e-4)
    one, ten, hundred = (found[1, closed_forms.YOUNG / divided][1] for divided in (1, 10, 100))
    near("what the stretch takes of the drag, 100 - 10 times that of steel over 10 - 1 times",
         (ten - hundred) / (one - ten), 10, 0.05)


def backward():
    """A string that turns backward under the mirrored torque gives the same results. Returns the
    table of the unchanged deck."""
    forward = run("forward", "Torque and Drag/Count=1")
    turned = run("backward", "Torque and Drag/Count=1", "Rotary Speed/Constant/Speed=-120 rpm",
                 "Loads/Torque On Bit=-4 kN m")
    for one, other in zip(forward, turned):
        for column in ("surface_torque", "hook_load", "stiff_surface_torque"):
            expect(f"{one['operation']}: {column} of a string that turns backward",
                   one[column] == other[column], (one[column], other[column]))
    return {row["operation"]: row for row in forward}


def documented(table):
    """The table of docs/guide/torque-drag.md agrees with the output of the program."""
    lines = [
        line.split("|")[1:-1] for line in (SOURCES / "docs/guide/torque-drag.md").read_text(
            encoding="utf-8").splitlines() if line.startswith("| ") and line.count("|") == 6
    ]
    found = {cells[0].strip(): cells[1:] for cells in lines if cells[0].strip() in table}
    expect("the document has a line for each operation", set(found) == set(table), sorted(found))
    for operation, cells in found.items():
        row = table[operation]
        for cell, name in zip(
                cells, ("hook_load", "stiff_hook_load", "surface_torque", "stiff_surface_torque")):
            computed = float(row[name]) / 1e3
            digits = 1 if "hook" in name else 2
            expect(
                f"docs/guide/torque-drag.md, {operation}, {name}: {cell.strip()} is "
                f"{computed:.{digits}f}",
                abs(float(cell) - computed) <= 1.5 * 10**-digits)


def pulled():
    """Torque and drag ignores a force of the deck and prints a message."""
    force = ('<ParameterList name="Loads"><ParameterList name="Forces"><ParameterList name="pull">'
             '<Parameter name="Node" type="int" value="20"/><Parameter name="Component" '
             'type="string" value="w"/><Parameter name="Value" type="double" value="-3e4"/>'
             '</ParameterList></ParameterList>')
    text = (SOURCES / "xml/vertical_1000m.xml").read_text(encoding="utf-8").replace(
        "components/", f"{SOURCES}/xml/components/")
    pathlib.Path("pulled.xml").write_text(text.replace('<ParameterList name="Loads">', force),
                                          encoding="utf-8")
    done = tooljoint("torque-drag", "pulled.xml", "--output", "pulled", "--without",
                     "Torque and Drag", "--set", "Torque and Drag/Count=1", "--set",
                     "Torque and Drag/Stiff String=None")
    expect(
        "forces of the deck are warned of", done.returncode == 0
        and "Loads/Forces is not part of torque and drag" in " ".join(done.stderr.split()),
        done.stderr)


def grouped():
    """A group of stands with a stabiliser in one of them equals a string of the single stands: only
    that stand touches with the stabiliser."""
    gauge = ('<ParameterList name="wide"><Parameter name="Length" type="double" value="2"/>'
             '<Parameter name="Elements" type="int" value="2"/><Parameter name="Outer Radius" '
             'type="double" value="0.0635"/><Parameter name="Inner Radius" type="double" '
             'value="0.0413"/><Parameter name="Gauge Position" type="double" value="1"/><Parameter '
             'name="Gauge Radius" type="double" value="0.107"/></ParameterList>')
    group = ('<ParameterList name="group"><Parameter name="Parts" type="Array(string)" '
             'value="{149*stand, wide, joint}"/></ParameterList>')
    text = pathlib.Path(DECK).read_text(encoding="utf-8").replace(
        '<ParameterList name="Components">', '<ParameterList name="Components">' + gauge + group)
    pathlib.Path("grouped.xml").write_text(text, encoding="utf-8")
    found = [
        run("grouped", "Torque and Drag/Count=1", "Torque and Drag/Stiff String=None",
            f"Drillstring/Assembly={assembly}", deck="grouped.xml")
        for assembly in ("{149*stand, wide, joint}", "{group}")
    ]
    for one, other in zip(*found):
        near(f"{one['operation']}: torque of a group of stands", float(other["surface_torque"]),
             float(one["surface_torque"]), 1e-12)
    joints = {
        row["operation"]: float(row["surface_torque"])
        for row in run("stands", "Torque and Drag/Count=1", "Torque and Drag/Stiff String=None",
                       "Torque and Drag/Yield Strength=1e14")
    }["Rotate off bottom"]
    turned = {row["operation"]: float(row["surface_torque"]) for row in found[1]
              }["Rotate off bottom"]
    near("one stabiliser in 1425 m hardly adds to the torque", turned, joints, 0.01)


def locked():
    """A string pushed so hard that it locks up has no loads at the surface, and its profile ends
    below the lock-up. A string with bending stiffness locks up too, if its elements resolve the
    waves; otherwise a message says so."""
    survey = pathlib.Path("horizontal.csv").resolve()
    survey.write_text("MD [m], Inc [deg], Azi [deg]\n0, 90, 0\n2000, 90, 0\n", encoding="utf-8")
    words = ["torque-drag", DECK]
    for setting in ("Well/Trajectory=Survey", f"Well/Survey/File={survey}",
                    "Torque and Drag/Count=1", "Torque and Drag/Operations={Drill sliding}"):
        words += ["--set", setting]
    pipe = ('<ParameterList name="pipe"><Parameter name="Length" type="double" value="300"/>'
            '<Parameter name="Elements" type="int" value="300"/><Parameter name="Outer Radius" '
            'type="double" value="0.0635"/><Parameter name="Inner Radius" type="double" '
            'value="0.0543"/></ParameterList>')
    text = pathlib.Path(DECK).read_text(encoding="utf-8").replace(
        '<ParameterList name="Components">', '<ParameterList name="Components">' + pipe)
    pathlib.Path("fine.xml").write_text(text, encoding="utf-8")
    for weight, deck, reason in (
        ("900 kN", "fine.xml", "are larger than these. It buckles and does not come to rest within "
         "60 iterations."),
        ("600 kN", DECK, "has no result. The soft string locks up. It buckles, and its elements of "
         "9 m are too long for the half waves of a helix"),
        ("200 kN", DECK,
         "times the helical limit (soft string). It buckles, and its elements of 9 m are too long"),
        ("1200 kN", "fine.xml", "the stiff string locks up."),
    ):
        fine = [
            "--set", "Drillstring/Assembly={pipe}", "--set", "Contact/Friction/Static=0.5", "--set",
            "Contact/Friction/Dynamic=0.5"
        ] if deck != DECK else []
        if weight == "900 kN":
            fine += ["--set", "Static/Max Iterations=10"]
        done = tooljoint(words[0], deck, *words[2:], *fine, "--output", "locked " + weight, "--set",
                         f"Loads/Weight On Bit={weight}")
        expect(f"{weight}: why the stiff string has no result", done.returncode == 0
               and reason in " ".join(done.stderr.split()), done.stderr)
        if weight == "900 kN":
            expect("more iterations are not advised where the soft string locks up", "Raise"
                   not in done.stderr, done.stderr)
        if weight == "600 kN":
            expect("its last screen counts one row that is locked up",
                   "\nlocked up           1 row  " in done.stdout, done.stdout[-600:])
    expect(
        "the table says that it locks up",
        float(rows("locked 1200 kN")[0]["stiff_locked_up"]) == 1
        and float(rows("locked 600 kN")[0]["stiff_locked_up"]) == 0)
    row = rows("locked 600 kN", "torque_drag.csv")[0]
    expect("it locks up", row["lock_up_depth"] != "" and 0 < float(row["lock_up_depth"]) < 1425,
           row)
    expect("no loads at the surface",
           all(row[key] == "" for key in ("hook_load", "surface_torque", "twist", "stretch")), row)
    depths = [float(line["depth"]) for line in rows("locked 600 kN", "torque_drag_profile.csv")]
    expect("the profile ends where it locks up",
           0 < depths[-1] - float(row["lock_up_depth"]) <= 3.0, depths[-1])


straight()
forms()
limits()
as_it_is = backward()
level()
buckled()
wound()
pulled()
pressure()
bends()
neutral_point()
grades()
stiff("build_hold_1400m", 0.01, 0.03)
stiff("extended_reach_5000m", 0.01, 0.05)
# A vertical string hardly touches the wall: the torque beyond that of the bit is small.
alone = stiff("vertical_5000m", 0.005, 0.01)
together = static_state("vertical_5000m", ranks=2)
for key in ("hook_load", "top_torque_equilibrium"):
    near(f"vertical_5000m: {key} on two ranks", together[key], alone[key], 1e-10)
long = stiff("vertical_10000m", 0.005, 0.01)
near("5 and 10 km have the same lower end: contact forces", long["total_normal_force"],
     alone["total_normal_force"], 0.01)
expect("neither moves along a well that turns",
       not any("along the well" in w for w in alone["warnings"] + long["warnings"]),
       alone["warnings"] + long["warnings"])
# With the nodes of the unloaded string as reference it touches with too large forces: the program
# gives a warning.
unloaded = static_state("vertical_5000m", 1, "Static/Reference=Unloaded")
expect("vertical_5000m from unloaded nodes: contact forces are too large",
       unloaded["total_normal_force"] > 1.1 * alone["total_normal_force"],
       unloaded["total_normal_force"])
expect(
    "vertical_5000m from unloaded nodes: it is said that the string moves along a well that turns",
    any("Set Static/Reference" in w for w in unloaded["warnings"]), unloaded["warnings"])
beside()
documented(as_it_is)
in_motion(as_it_is)
weight_on_bit()
grouped()
locked()
resumed()
files()
announced()
tables_and_refusals()
sys.exit(finish())
