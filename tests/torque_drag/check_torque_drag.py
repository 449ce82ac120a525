#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks `tooljoint torque-drag` through the program: closed forms, the stiff string's own static state, tables, refusals, ranks.

    check_torque_drag.py PROGRAM MPIEXEC SOURCES
"""
import csv
import json
import math
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time

import h5py

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
import closed_forms  # noqa: E402
from checks import expect, finish, tooljoint  # noqa: E402
from screens import expect_screen  # noqa: E402

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
    return rows(folder)


def near(what, value, expected, tolerance):
    expect(f"{what}: {value:.6g} against {expected:.6g}", abs(value - expected) <= tolerance * abs(expected))


def straight():
    """An inclined straight hole: weight along the axis, friction by the side force, buckling by Dawson and Paslay."""
    inclination = math.radians(50)
    well = ["Well/Trajectory=Survey", "Well/Survey/File=straight.csv"]
    survey = pathlib.Path("straight.csv").resolve()
    survey.write_text("MD [m], Inc [deg], Azi [deg]\n0, 50, 20\n2000, 50, 20\n", encoding="utf-8")
    well[1] = f"Well/Survey/File={survey}"
    table = run("straight", *well, "Supports/Bit=none", "Torque and Drag/Count=2", "Torque and Drag/Yield Strength=724 MPa", "Torque and Drag/Joint Length=9.5")
    length, density, gravity, mu, joint = 1425.0, 7850.0, 9.81, 0.25, 0.084
    body, tool = (math.pi * (a * a - b * b) for a, b in ((0.0635, 0.0543), (0.084, 0.0413)))
    weight = density * gravity * 150 * (9.0 * body + 0.5 * tool)
    along, across = weight * math.cos(inclination), weight * math.sin(inclination)
    full = {row["operation"]: row for row in table if float(row["bit_depth"]) > 0.99 * length}
    near("trip out", float(full["Trip out"]["hook_load"]), along + mu * across, 1e-6)
    near("trip in", float(full["Trip in"]["hook_load"]), along - mu * across, 1e-6)
    near("drill rotating", float(full["Drill rotating"]["surface_torque"]), 4000 + mu * joint * across, 1e-4)
    near("drill sliding", float(full["Drill sliding"]["hook_load"]), along - mu * across - 5e4, 1e-6)
    # The stiff string lies on its joints. Turning, the wall carries the weight across the hole with N^2 + (mu N)^2 = (w sin)^2. The support at the
    # top carries part of a pipe of it.
    profile = rows("straight", "torque_drag_stiff_profile.csv")
    pressed = {name: sum(float(row["contact_force"]) for row in profile if row["operation"] == name) for name in full}
    stiff = {name: (float(row["stiff_hook_load"]), float(row["stiff_surface_torque"])) for name, row in full.items()}
    pipe = 9.5 / length
    near("stiff: contact forces", pressed["Trip out"], across, pipe)
    near("stiff: contact forces of a string that turns", pressed["Rotate off bottom"], across / math.sqrt(1 + mu * mu), pipe)
    for name, hook in (("Trip out", along + mu * pressed["Trip out"]), ("Trip in", along - mu * pressed["Trip in"]), ("Rotate off bottom", along),
                       ("Drill sliding", along - mu * pressed["Drill sliding"] - 5e4)):
        near(f"stiff: {name}", stiff[name][0], hook, 1e-5)
    near("stiff: torque off bottom", stiff["Rotate off bottom"][1], mu * joint * pressed["Rotate off bottom"], 1e-4)
    ream = math.hypot(0.05, 4 * math.pi * joint)
    near("stiff: drag of reaming", along - stiff["Ream"][0], mu * 0.05 / ream * pressed["Ream"], 1e-3)
    inertia = math.pi / 4 * (0.0635**4 - 0.0543**4)
    limit = 2 * math.sqrt(210e9 * inertia * weight / length * math.sin(inclination) / (0.108 - 0.0635))
    expect("the compression above the bit is that on it, so the margin of the lowest body is the limit over it",
           abs(float(full["Drill rotating"]["sinusoidal_margin"]) / (limit / 5e4) - 1) < 0.05, full["Drill rotating"]["sinusoidal_margin"])
    expect("the stiff string has the same margin within its weight on an element of 9 m", abs(float(full["Drill rotating"]["stiff_sinusoidal_margin"]) / (limit / 5e4) - 1) < 0.06
           and abs(float(full["Drill rotating"]["stiff_helical_margin"]) / float(full["Drill rotating"]["stiff_sinusoidal_margin"]) - math.sqrt(2)) < 1e-9,
           full["Drill rotating"]["stiff_sinusoidal_margin"])
    near("side force of a joint", float(full["Trip out"]["joint_force"]), weight * math.sin(inclination) / 150, 1e-6)
    forces = [(float(row["depth"]), float(row["contact_force"])) for row in profile if row["operation"] == "Trip out"]
    joints = [sum(force for s, force in forces if start <= s < start + 9.5 - 1e-6) for start, _ in forces]
    near("contact force of a joint of the stiff string", float(full["Trip out"]["stiff_joint_force"]), max(joints), 1e-6)
    near("which is the weight of a pipe where its neighbours bear theirs", sorted(joints)[len(joints) // 2], weight * math.sin(inclination) / 150, 0.01)
    # tool joints with half the friction, in both strings and in the static state of a run; bodies that do not touch with ten times as much
    factors = ["Drillstring/Components/joint/Friction Factor=0.5", "Drillstring/Components/body/Friction Factor=10"]
    half = run("joint_friction", *well, *factors, "Supports/Bit=none", "Torque and Drag/Count=1", "Torque and Drag/Operations={Trip out}")[0]
    near("trip out on joints with half the friction", float(half["hook_load"]), along + 0.5 * mu * across, 1e-6)
    near("stiff: drag of joints with half the friction", float(half["stiff_hook_load"]) - along, 0.5 * (stiff["Trip out"][0] - along), 1e-2)
    expect("nothing is compressed off bottom", full["Rotate off bottom"]["helical_margin"] == "")


def numbers(name, settings):
    """Rows of torque_drag.csv by operation, as numbers."""
    return {row["operation"]: {key: float(value) if value else None for key, value in row.items() if key != "operation"} for row in run(f"forms_{name}", *settings)}


def forms():
    """The soft string against closed forms, through the program."""
    for what, truth, found, _, tolerance in closed_forms.soft(numbers):
        near(what, found, truth, tolerance)


def limits():
    """The stiff string of a pipe without joints tends to the soft one. Where its load changes the wall it crosses the hole without contact: with a load that changes by
    q' per length over a way l ~ (T r/q')^(1/3), so that the torque lacks q' l^2 ~ r^(2/3). The stretch by friction moves it along the bend, in proportion to 1/E."""
    found = {(clearance, young): (torque, drag) for clearance, young, torque, drag in closed_forms.stiff(numbers, closed_forms.TESTED)}
    soft = closed_forms.YOUNG / 100
    short = {clearance: 1 - found[clearance, soft][0] / closed_forms.LIMIT for clearance in (1, 6)}
    expect(f"stiff string, clearance 1 mm: torque of the soft one that climbs {short}", 0 < short[1] < 3e-4)
    near("and what it lacks grows with r^(2/3)", short[6] / short[1], 6 ** (2 / 3), 0.2)
    lacks = 1 - found[1, closed_forms.YOUNG][1]
    expect(f"drag of the soft string with Young's modulus of steel {lacks}", abs(lacks) < 6e-4)
    one, ten, hundred = (found[1, closed_forms.YOUNG / divided][1] for divided in (1, 10, 100))
    near("what the stretch takes of the drag, 100 - 10 times that of steel over 10 - 1 times", (ten - hundred) / (one - ten), 10, 0.05)


def backward():
    """A string that turns backward under the mirrored torque is the same string. Returns the table of the deck as it is."""
    forward = run("forward", "Torque and Drag/Count=1")
    turned = run("backward", "Torque and Drag/Count=1", "Rotary Speed/Constant/Speed=-120 rpm", "Loads/Torque On Bit=-4 kN m")
    for one, other in zip(forward, turned):
        for column in ("surface_torque", "hook_load", "stiff_surface_torque"):
            expect(f"{one['operation']}: {column} of a string that turns backward", one[column] == other[column], (one[column], other[column]))
    return {row["operation"]: row for row in forward}


def pressure():
    """Margins to yield with the pressure of the mud: von Mises of a thick wall from the loads of the profile, friction losses of the flow, the pump pressure."""
    survey = pathlib.Path("straight.csv").resolve()
    density, flow, friction, hole = 1300.0, 0.03, 0.013, 0.108
    mud = ["Well/Trajectory=Survey", f"Well/Survey/File={survey}", "Supports/Bit=none", f"Mud/Density={density}", f"Mud/Friction Coefficient={friction}",
           "Torque and Drag/Count=1", "Torque and Drag/Yield Strength=724 MPa", "Drillstring/Assembly={150*stand}"]

    def loss(outer, inner):  # of both flows per length
        inside, outside = (flow / (math.pi * area) for area in (inner * inner, hole * hole - outer * outer))
        return friction * density / math.pi * (inside**2 / inner + outside**2 / (hole - outer))

    def drag(outer, inner):  # of the mud in the annulus, per length
        return friction * density * outer * (flow / (math.pi * (hole * hole - outer * outer)))**2

    body, joint = (0.0635, 0.0543), (0.084, 0.0413)
    section = {pipe: math.pi * (pipe[0]**2 - pipe[1]**2) for pipe in (body, joint)}
    for folder, pump, down in (("pressure_flow", None, 1), ("pressure_pump", 3.5e7, 1), ("pressure_reverse", 3.5e7, -1)):  # down the string, or down the annulus
        hanging = 150 * sum(part * ((7850 - density) * 9.81 * math.cos(math.radians(50)) * section[pipe] - down * drag(*pipe)) for part, pipe in ((9.0, body), (0.5, joint)))
        through = down * 150 * (9.0 * loss(*body) + 0.5 * loss(*joint))
        table = run(folder, *mud, f"Mud/Flow Rate={down * flow}", *([f"Torque and Drag/Pump Pressure={pump} Pa"] if pump is not None else []))
        profile = [row for row in rows(folder, "torque_drag_profile.csv") if row["operation"] == "Drill rotating"]
        off_bottom = next(row for row in table if row["operation"] == "Rotate off bottom")
        near(f"{folder}: hook load, buoyed weight less the drag of the mud", float(off_bottom["hook_load"]), hanging, 1e-6)
        near(f"{folder}: the same of the stiff string", float(off_bottom["stiff_hook_load"]), hanging, 1e-5)
        surface = through if pump is None else pump
        bit_side = surface - through
        for row, difference in ((profile[-1], surface), (profile[0], bit_side)):
            tension, torque, depth = (float(row[name]) for name in ("tension", "torque", "depth"))
            candidates = []  # the point is of the body or of the joint
            for outer, inner in (body, joint):
                area, polar = math.pi * (outer**2 - inner**2), math.pi / 2 * (outer**4 - inner**4)
                outside = 1.4e7  # any
                inside = outside + difference
                a = (inside * inner**2 - outside * outer**2) / (outer**2 - inner**2)
                b = difference * (inner * outer)**2 / (outer**2 - inner**2)
                axial = (tension + math.pi * (inside * inner**2 - outside * outer**2)) / area
                stresses = [math.sqrt(0.5 * ((axial - (a - b / r**2))**2 + (2 * b / r**2)**2 + (a + b / r**2 - axial)**2) + 3 * (torque * r / polar)**2) for r in (inner, outer)]
                candidates.append(max(stresses))
            found = float(row["von_mises"])
            nearest = min(candidates, key=lambda value: abs(value - found))
            near(f"{folder}: von Mises at {depth:.0f} m of a thick wall", found, nearest, 1e-6)
        least = min(724e6 / float(row["von_mises"]) for row in profile)
        near(f"{folder}: margin to yield", float(next(row for row in table if row["operation"] == "Drill rotating")["yield_margin"]), least, 1e-6)
        stiff_profile = [row for row in rows(folder, "torque_drag_stiff_profile.csv") if row["operation"] == "Trip out" and row["von_mises"]]
        expect(f"{folder}: the stiff string bears the pressure too", all(float(row["von_mises"]) > 0 for row in stiff_profile))
    still, pumped = ({row["operation"]: float(row["yield_margin"]) for row in rows(folder)} for folder in ("pressure_flow", "pressure_pump"))
    expect("a pump pressure takes of the margin in every operation", all(pumped[name] < still[name] for name in still), (still, pumped))


def grades():
    """A hanging string of two grades from the table of drill pipe: its margin to yield is the least of strength over stress of both, by hand."""
    table = run("grades", "Well/Trajectory=Vertical", "Well/Vertical/Length=1300", "Supports/Bit=none", "Torque and Drag/Count=1", "Torque and Drag/Stiff String=None",
                "Torque and Drag/Operations={Trip out}", f"Drillstring/Pipe Table={SOURCES / 'xml/components/api_drill_pipe.csv'}",
                "Drillstring/Assembly={7*5 in 19.50 S-135 NC50 stand, 36*5 in 19.50 E-75 NC50 stand}")
    inch, psi = 0.0254, 4.4482216152605 / 0.0254**2
    def area(outer, inner):
        return math.pi / 4 * (outer**2 - inner**2) * inch**2
    body = area(5, 4.276)

    def joint(inner):  # weight of 9.45 m
        return 7850 * 9.81 * (17 * inch * area(6.625, inner) + 0.3 * area(5.125, inner) + (9.15 - 17 * inch) * body)
    weak, strong = 75000 * psi * body, 135000 * psi * body
    below = 108 * joint(3.75)
    whole = below + 21 * joint(2.75)
    near("the hook carries both grades", float(table[0]["hook_load"]), whole, 1e-6)
    near("the weaker pipe yields first", float(table[0]["yield_margin"]), weak / (below - 9.81 * 7850 * (10 * inch * area(6.625, 3.75) + 0.15 * area(5.125, 3.75))), 1e-3)
    expect("and that is below the margin of the stronger one at the surface", float(table[0]["yield_margin"]) < strong / whole)
    near("where it begins", float(table[0]["yield_margin_depth"]), 21 * 9.45 + 10 * inch + 0.15, 1e-3)


def beside():
    """The stiff string of a build and hold well beside the soft one, at a depth where it is cut and for a string of that length."""
    whole = {row["operation"]: row for row in run("beside", "Torque and Drag/Depths={950}", "Torque and Drag/Yield Strength=931 MPa")}
    for operation, hook, torque in (("Trip out", 0.005, None), ("Trip in", 0.005, None), ("Rotate off bottom", 0.002, 0.07), ("Drill rotating", 0.002, 0.03)):
        row = whole[operation]
        near(f"{operation}: hook load, stiff beside soft", float(row["stiff_hook_load"]), float(row["hook_load"]), hook)
        if torque:
            near(f"{operation}: torque, stiff beside soft", float(row["stiff_surface_torque"]), float(row["surface_torque"]), torque)
            near(f"{operation}: twist, stiff beside soft", float(row["stiff_twist"]), float(row["twist"]), torque)
        near(f"{operation}: stretch, stiff beside soft", float(row["stiff_stretch"]), float(row["stretch"]), 0.01)
    short = {row["operation"]: row for row in run("short", "Torque and Drag/Depths={950}", "Torque and Drag/Yield Strength=931 MPa", "Drillstring/Assembly={100*stand}")}
    expect("a string cut at the surface is one that ends there", short == whole, (short["Trip out"], whole["Trip out"]))
    cut = {row["operation"]: row for row in run("cut", "Torque and Drag/Depths={943.2}")}
    for operation, row in cut.items():
        near(f"{operation}: hook load of a string cut inside a pipe, stiff beside soft", float(row["stiff_hook_load"]), float(row["hook_load"]), 0.006)
    profile = [row for row in rows("beside", "torque_drag_stiff_profile.csv") if row["operation"] == "Trip out"]
    held = sum(float(row["contact_force"]) for row in profile)
    expect("drag is friction times the contact forces: the profile adds up",
           abs(float(whole["Trip out"]["stiff_hook_load"]) - float(whole["Rotate off bottom"]["stiff_hook_load"]) - 0.25 * held) < 0.002 * 0.25 * held, held)


def documented(table):
    """The table of docs/guide/torque-drag.md is what the program prints."""
    lines = [line.split("|")[1:-1] for line in (SOURCES / "docs/guide/torque-drag.md").read_text(encoding="utf-8").splitlines() if line.startswith("| ") and line.count("|") == 6]
    found = {cells[0].strip(): cells[1:] for cells in lines if cells[0].strip() in table}
    expect("the document has a line for each operation", set(found) == set(table), sorted(found))
    for operation, cells in found.items():
        row = table[operation]
        for cell, name in zip(cells, ("hook_load", "stiff_hook_load", "surface_torque", "stiff_surface_torque")):
            computed = float(row[name]) / 1e3
            digits = 1 if "hook" in name else 2
            expect(f"docs/guide/torque-drag.md, {operation}, {name}: {cell.strip()} is {computed:.{digits}f}", abs(float(cell) - computed) <= 1.5 * 10**-digits)


def in_motion(table):
    """Friction along the hole in a run: static state and motion at the speeds of an operation have the loads of the stiff string in torque-drag."""
    for operation, speed, ranks, turns in (("Trip out", -0.3, 1, ("--without", "Rotary Speed")), ("Back-ream", -0.05, 2, ())):
        # from 1 um/s on the coefficient is that of fast sliding
        settings = ("Contact/Friction/Axial=true", "Contact/Friction/Regularisation Velocity=1e-6", "Static/Reference=Hanging", f"Top Drive/Block Speed={speed}",
                    "Transient/End Time=0.05")
        done = tooljoint("run", DECK, "--output", "in_motion", "--without", "Loads/Weight On Bit", "--without", "Loads/Torque On Bit", *turns,
                         *[part for setting in settings for part in ("--set", setting)], ranks=ranks)
        expect(f"{operation}: the motion runs", done.returncode == 0, done.stderr)
        row, static = table[operation], json.loads(pathlib.Path("in_motion/summary.json").read_text(encoding="utf-8"))["static"]
        with h5py.File("in_motion/results.h5") as file:
            hook, torque = file["transient/hook_load"][:], file["transient/surface_torque"][:]
        for what, values, stiff in (("hook load", [static["hook_load"], *hook], "stiff_hook_load"), ("torque", [static["surface_torque"], *torque], "stiff_surface_torque")):
            true = float(row[stiff])
            worst = max(abs(value - true) for value in values)
            expect(f"{operation}: {what} of a run is {true:.6g}, off by {worst:.2g}", worst <= 1e-5 * max(abs(true), 1e3))


def static_state(name, ranks=1, *settings):
    """The list `static` of summary.json of the scene at rest, and its warnings."""
    deck = SOURCES / f"xml/{name}.xml"
    folder = f"stiff_{name}_{ranks}"
    lists = [part for one in ("Transient", "Reduction", "Substructures", "Study") for part in ("--without", one) if f'"{one}"' in deck.read_text(encoding="utf-8")]
    done = tooljoint("run", str(deck), "--output", folder, *lists, *[part for setting in settings for part in ("--set", setting)], ranks=ranks)
    expect(f"the static state of {name} is found", done.returncode == 0, done.stderr)
    whole = json.loads(pathlib.Path(f"{folder}/summary.json").read_text(encoding="utf-8"))
    return {**whole["static"], "warnings": whole["warnings"]}


def stiff(name, tension, torque):
    """Axial force and torque at the top against the program's own static state of the same scene, turning on bottom."""
    deck = str(SOURCES / f"xml/{name}.xml")
    soft = {row["operation"]: row for row in run(f"soft_{name}", "Torque and Drag/Count=1", "Torque and Drag/Stiff String=None", deck=deck)}["Drill rotating"]
    static = static_state(name)
    expect(f"{name}: the torque balances", abs(static["torque_balance_defect"]) < 5e-3 * static["torque_scale"], static["torque_balance_defect"])
    # Drilling adds the drag of its axial speed, 5 mm/s against a metre per second around. The stiff string bridges the waves of a survey.
    near(f"{name}: tension at the top, soft against stiff", float(soft["hook_load"]), static["hook_load"], tension)
    near(f"{name}: torque at the top, soft against stiff", float(soft["surface_torque"]), -static["top_torque_equilibrium"], torque)
    return static


def weight_on_bit():
    """Weight on bit is that of the deck, whatever else acts on the bit: xml/first_run.xml has bit bounce too."""
    table = {row["operation"]: row for row in run("first_run", "Torque and Drag/Count=1", deck=str(SOURCES / "xml/first_run.xml"))}
    off, on = table["Rotate off bottom"], table["Drill rotating"]
    near("weight on bit of first_run", float(off["hook_load"]) - float(on["hook_load"]), 40e3, 0.01)
    said = " ".join(json.loads(pathlib.Path("first_run/summary.json").read_text(encoding="utf-8"))["warnings"])
    bare = 53 * 28.35 + 2 * 1.8 + 1.2 + 0.35  # pipe, stabilisers and bit have no grade, collars and heavy-weight pipe have
    expect("what has no margin to yield is said", f"{bare:.0f} m of the string's 1593 m have no yield strength" in said, said)


def level():
    """Nothing but bending resists a string on the axis of a long level hole, where the stages of the static state begin."""
    survey = pathlib.Path("level.csv").resolve()
    stations = "".join(f"{depth}, {min(90.0, max(0.0, (depth - 900) / 12)):.2f}, 45\n" for depth in range(0, 4501, 30))
    survey.write_text("MD [m], Inc [deg], Azi [deg]\n" + stations, encoding="utf-8")
    string = "28*5 in HWDP stand, 120*5 in stand, 2*5 in HWDP stand, 2*6.5 in collar, 8.5 in PDC bit"
    row = run("level", f"Well/Survey/File={survey}", f"Drillstring/Assembly={{{string}}}", "Loads/Unbalance/collar/Node=100", "Torque and Drag/Count=1",
              "Torque and Drag/Operations={Rotate off bottom}", deck=str(SOURCES / "xml/extended_reach_5000m.xml"))[0]
    near("hook load in a level hole, stiff against soft", float(row["stiff_hook_load"]), float(row["hook_load"]), 0.01)
    near("torque in a level hole, stiff against soft", float(row["stiff_surface_torque"]), float(row["surface_torque"]), 0.05)


def buckled():
    """Where its weight on bit buckles it, the stiff string slides to a stable state on the wall."""
    for weight, buckles, most in (("60 kN", False, 150), ("200 kN", True, 900)):
        done = tooljoint("torque-drag", str(SOURCES / "xml/vertical_1000m.xml"), "--output", "buckled", "--without", "Torque and Drag", "--set", "Torque and Drag/Count=1", "--set", "Torque and Drag/Operations={Drill sliding}",
                         "--set", f"Loads/Weight On Bit={weight}", "--fresh")
        said = " ".join((done.stdout + done.stderr).split())
        expect(f"{weight}: the state of the stiff string is {'' if buckles else 'not '}buckled", ("1 of 1 states of the stiff string are buckled" in said) == buckles, said[-800:])
        expect(f"{weight}: and stable", "of the stiff string are unstable" not in said, said[-800:])
        iterations = int(re.search(r": [0-9.e+-]+ s, ([0-9]+) iterations", said).group(1))
        expect(f"{weight}: from the largest share at which it does not buckle, in {iterations} iterations", iterations <= most, said[-800:])
        expect(f"{weight}: the table has it", float(rows("buckled")[0]["stiff_buckled"]) == buckles, rows("buckled")[0])


def pulled():
    """A force of the deck has no part in torque and drag, and that is said."""
    force = '<ParameterList name="Loads"><ParameterList name="Forces"><ParameterList name="pull"><Parameter name="Node" type="int" value="20"/>' \
        '<Parameter name="Component" type="string" value="w"/><Parameter name="Value" type="double" value="-3e4"/></ParameterList></ParameterList>'
    text = (SOURCES / "xml/vertical_1000m.xml").read_text(encoding="utf-8").replace("components/", f"{SOURCES}/xml/components/")
    pathlib.Path("pulled.xml").write_text(text.replace('<ParameterList name="Loads">', force), encoding="utf-8")
    done = tooljoint("torque-drag", "pulled.xml", "--output", "pulled", "--without", "Torque and Drag", "--set", "Torque and Drag/Count=1", "--set", "Torque and Drag/Stiff String=None")
    expect("forces of the deck are warned of", done.returncode == 0 and "Loads/Forces has no part in torque and drag" in " ".join(done.stderr.split()), done.stderr)


def grouped():
    """A group of stands with a stabiliser in one of them is the string of its stands: only that one touches with the stabiliser."""
    gauge = '<ParameterList name="wide"><Parameter name="Length" type="double" value="2"/><Parameter name="Elements" type="int" value="2"/><Parameter name="Outer Radius" type="double" value="0.0635"/>' \
        '<Parameter name="Inner Radius" type="double" value="0.0413"/><Parameter name="Gauge Position" type="double" value="1"/><Parameter name="Gauge Radius" type="double" value="0.107"/></ParameterList>'
    group = '<ParameterList name="group"><Parameter name="Parts" type="Array(string)" value="{149*stand, wide, joint}"/></ParameterList>'
    text = pathlib.Path(DECK).read_text(encoding="utf-8").replace('<ParameterList name="Components">', '<ParameterList name="Components">' + gauge + group)
    pathlib.Path("grouped.xml").write_text(text, encoding="utf-8")
    found = [run("grouped", "Torque and Drag/Count=1", "Torque and Drag/Stiff String=None", f"Drillstring/Assembly={assembly}", deck="grouped.xml")
             for assembly in ("{149*stand, wide, joint}", "{group}")]
    for one, other in zip(*found):
        near(f"{one['operation']}: torque of a group of stands", float(other["surface_torque"]), float(one["surface_torque"]), 1e-12)
    joints = {row["operation"]: float(row["surface_torque"]) for row in run("stands", "Torque and Drag/Count=1", "Torque and Drag/Stiff String=None")}["Rotate off bottom"]
    turned = {row["operation"]: float(row["surface_torque"]) for row in found[1]}["Rotate off bottom"]
    near("one stabiliser in 1425 m hardly adds to the torque", turned, joints, 0.01)


def locked():
    """Pushed so hard that it locks up, a string has no loads at the surface, and its profile ends below the lock-up. With bending stiffness it
    locks up, too, where its elements resolve the waves; else that is said."""
    survey = pathlib.Path("horizontal.csv").resolve()
    survey.write_text("MD [m], Inc [deg], Azi [deg]\n0, 90, 0\n2000, 90, 0\n", encoding="utf-8")
    words = ["torque-drag", DECK]
    for setting in ("Well/Trajectory=Survey", f"Well/Survey/File={survey}", "Torque and Drag/Count=1", "Torque and Drag/Operations={Drill sliding}"):
        words += ["--set", setting]
    pipe = '<ParameterList name="pipe"><Parameter name="Length" type="double" value="300"/><Parameter name="Elements" type="int" value="300"/>' \
        '<Parameter name="Outer Radius" type="double" value="0.0635"/><Parameter name="Inner Radius" type="double" value="0.0543"/></ParameterList>'
    text = pathlib.Path(DECK).read_text(encoding="utf-8").replace('<ParameterList name="Components">', '<ParameterList name="Components">' + pipe)
    pathlib.Path("fine.xml").write_text(text, encoding="utf-8")
    for weight, deck, reason in (("600 kN", DECK, "has no result. The soft string locks up. It buckles, and its elements of 9 m are too long for the half waves of a helix"),
                                 ("200 kN", DECK, "times the helical limit (soft string). It buckles, and its elements of 9 m are too long"),
                                 ("1200 kN", "fine.xml", "the stiff string locks up.")):
        fine = ["--set", "Drillstring/Assembly={pipe}", "--set", "Contact/Friction/Static=0.5", "--set", "Contact/Friction/Dynamic=0.5"] if deck != DECK else []
        done = tooljoint(words[0], deck, *words[2:], *fine, "--output", "locked " + weight, "--set", f"Loads/Weight On Bit={weight}")
        expect(f"{weight}: why the stiff string has no result", done.returncode == 0 and reason in " ".join(done.stderr.split()), done.stderr)
        if weight == "600 kN":
            expect("its last screen counts one row that is locked up", "\nlocked up           1 row  " in done.stdout, done.stdout[-600:])
    expect("the table says that it locks up", float(rows("locked 1200 kN")[0]["stiff_locked_up"]) == 1 and float(rows("locked 600 kN")[0]["stiff_locked_up"]) == 0)
    row = rows("locked 600 kN", "torque_drag.csv")[0]
    expect("it locks up", row["lock_up_depth"] != "" and 0 < float(row["lock_up_depth"]) < 1425, row)
    expect("no loads at the surface", all(row[key] == "" for key in ("hook_load", "surface_torque", "twist", "stretch")), row)
    depths = [float(line["depth"]) for line in rows("locked 600 kN", "torque_drag_profile.csv")]
    expect("the profile ends where it locks up", 0 < depths[-1] - float(row["lock_up_depth"]) <= 3.0, depths[-1])


def announced():
    """`tooljoint check` says what torque-drag will do."""
    done = tooljoint("check", DECK, "--set", "Torque and Drag/Depths={400, 800}", "--set", "Torque and Drag/Operations={Trip in}", "--set", "Torque and Drag/Stiff String=All Depths")
    plain = " ".join(tooljoint("check", DECK).stdout.split())
    for text in ("torque and drag by default: 20 depths, 7 operations, the stiff string at the deepest (tooljoint torque-drag)",
                 "bottom-hole assembly by default: 1 hole, 1 weight on bit, 1 tool face (tooljoint bha)",
                 "buckling by default: up to 50 kN on the bit, crookedness 0.02 of the clearance, jumps where states become unstable (tooljoint buckling)",
                 "no campbell no Campbell list: give its Highest Speed", "no response no Response list: give its Highest Speed or Highest Frequency, and Outputs",
                 "no map no Map list: give its Grid and Values"):
        expect(f"check of a deck without their lists: {text}", text in plain, plain[-800:])
    expect("check: depths, operations and the stiff string", "2 depths, 1 operation, the stiff string at all of them" in " ".join(done.stdout.split()), done.stdout[-600:] + done.stderr)


def tables_and_refusals():
    depths = run("some", "Torque and Drag/Depths={400, 800}", "Torque and Drag/Operations={Trip in}", "Torque and Drag/Block Weight=100 kN")
    expect("a row for each depth and operation", [float(row["bit_depth"]) for row in depths] == [400, 800], depths)
    bare = run("bare", "Torque and Drag/Depths={400, 800}", "Torque and Drag/Operations={Trip in}")
    near("the block hangs on the hook", float(depths[0]["hook_load"]) - float(bare[0]["hook_load"]), 1e5, 1e-9)
    profile = rows("some", "torque_drag_profile.csv")
    expect("the profile is that of the deepest bit", float(profile[0]["depth"]) == 800 and float(profile[-1]["depth"]) == 0, profile[0])
    two = run("ranks", "Torque and Drag/Depths={400, 800}", "Torque and Drag/Operations={Trip in}", ranks=2)
    expect("two ranks give the same table", two == bare)
    for name, words, arguments in (
        ("frame", "string in its well", ["torque-drag", str(SOURCES / "xml/frame.xml")]),
        ("no friction", "Add the list Contact", ["torque-drag", DECK, "--without", "Contact"]),
        ("no weight", "Add the list Loads", ["torque-drag", DECK, "--without", "Loads"]),
        ("too deep", "longer string", ["torque-drag", DECK, "--set", "Torque and Drag/Depths={9000}"]),
        ("a depth twice", "holds 500 m twice", ["torque-drag", DECK, "--set", "Torque and Drag/Depths={500, 500}"]),
        ("an operation twice", 'holds "Trip in" twice', ["torque-drag", DECK, "--set", "Torque and Drag/Operations={Trip in, Trip in}"]),
    ):
        done = tooljoint(*arguments)
        expect(f"refused: {name}", done.returncode == 2 and words in done.stderr, f"{done.returncode} {done.stderr}")


def stopped(folder, how, settings):
    """Stops a command by a signal after two depths; returns its exit code and how many depths it has left."""
    arguments = [part for setting in settings for part in ("--set", setting)]
    command = subprocess.Popen([sys.argv[1], "torque-drag", DECK, "--output", folder, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    kept = pathlib.Path(folder, "cache")
    while command.poll() is None and (not kept.is_dir() or len(list(kept.glob("depths_*.json"))) < 2):
        time.sleep(0.02)
    command.send_signal(how)
    return command.wait(), len(list(kept.glob("depths_*.json")))


def resumed():
    """A command that was stopped goes on: the depths it had are not computed again, and the tables are those of one that was not."""
    settings = ("Torque and Drag/Count=6", "Torque and Drag/Stiff String=All Depths", "Torque and Drag/Operations={Trip out, Drill rotating}")
    whole = run("whole", *settings)
    arguments = [part for setting in settings for part in ("--set", setting)]
    for how in (signal.SIGTERM, signal.SIGKILL):
        folder = f"stopped_{how.name}"
        shutil.rmtree(folder, ignore_errors=True)  # what a test that was cut off has left
        code, left = stopped(folder, how, settings)
        expect(f"{how.name}: it stops with some depths done", code == (130 if how == signal.SIGTERM else -9) and 2 <= left < 6, f"{code} {left}")
        done = tooljoint("torque-drag", DECK, "--output", folder, *arguments)
        expect(f"{how.name}: they are known", f"{left} of 6 depths are known from before" in done.stdout and done.stdout.count("stiff string, bit at") == 6 - left, done.stdout[-800:])
        expect(f"{how.name}: the same table", rows(folder) == whole)
    done = tooljoint("torque-drag", DECK, "--output", "stopped_SIGKILL", *arguments, ranks=2)
    expect("all are known to two ranks", "6 of 6 depths" in done.stdout and rows("stopped_SIGKILL") == whole, done.stdout[-800:])
    done = tooljoint("torque-drag", DECK, "--output", "stopped_SIGKILL", *arguments, "--set", "Loads/Weight On Bit=60 kN")
    expect("another deck: all depths are computed, and that is said", "depths of another deck" in " ".join(done.stdout.split()) and done.stdout.count("stiff string, bit at") == 6, done.stdout[-800:])
    done = tooljoint("torque-drag", DECK, "--output", "stopped_SIGTERM", *arguments, "--fresh")
    expect("--fresh forgets them", "known" not in done.stdout and done.stdout.count("stiff string, bit at") == 6, done.stdout[-800:])


def files():
    """torque_drag.h5 and summary.json have the numbers of the tables, and stand beside the results of a run."""
    done = tooljoint("run", DECK, "--output", "files", "--without", "Transient")
    expect("the static state is found", done.returncode == 0, done.stderr)
    run_summary = json.loads(pathlib.Path("files/summary.json").read_text(encoding="utf-8"))
    expect("the figures of a run are null in torque_drag", run_summary["torque_drag"]["rows"] is None)
    table = run("files", "Torque and Drag/Count=2", "Torque and Drag/Yield Strength=931 MPa")
    summary = json.loads(pathlib.Path("files/summary.json").read_text(encoding="utf-8"))
    expect("the figures of the run stay", summary["static"] == run_summary["static"] and pathlib.Path("files/results.h5").is_file())
    expect("its files and these are listed", {"results.h5", "torque_drag.h5", "torque_drag.csv"} <= set(summary["files"]), summary["files"])
    own = summary["torque_drag"]
    deepest = [row for row in table if float(row["bit_depth"]) == own["bit_depth"]]
    expect("two depths", own["depths"] == 2 and own["missing"] == 0 and own["locked_up"] == 0, {key: own[key] for key in ("depths", "missing", "locked_up")})
    wrong = [(row["operation"], name) for row, found in zip(deepest, own["rows"]) for name in row if name not in ("bit_depth", "operation")
             and (found[name] is not None if row[name] == "" else found[name] is None or abs(found[name] - float(row[name])) > 1e-8 * abs(float(row[name])))]
    expect("rows of the summary are those of the table", len(own["rows"]) == len(deepest) == 7 and not wrong, wrong[:5])
    with h5py.File("files/torque_drag.h5") as file:
        names = [name for name in table[0] if name != "operation"]
        expect("a dataset for each column, with its unit", all(file[f"/rows/{name}"].attrs["units"] and file[f"/rows/{name}"].attrs["long_name"] for name in names))
        for name in names:
            known = [True] * len(table) if name == "bit_depth" else file[f"/known/{name}"][()] == 1
            same = all((row[name] != "") == bool(k) and abs(float(row[name] or 0) - value) <= 1e-8 * abs(value) for row, k, value in zip(table, known, file[f"/rows/{name}"][()]))
            expect(f"torque_drag.h5, {name}", same)
        tension = file["/profile/Trip out/tension"][()]
        line = [row for row in rows("files", "torque_drag_profile.csv") if row["operation"] == "Trip out"]
        expect("the profile is that of the table", len(tension) == len(line) and abs(tension[-1] - float(line[-1]["tension"])) < 1e-6 * abs(tension[-1]))
        expect("and that of the stiff string", len(file["/profile/Trip out/stiff/contact_force"]) == len(file["/profile/Trip out/stiff/tension"]) + 1)
    again = tooljoint("run", DECK, "--output", "files", "--without", "Transient")
    expect("a run that comes after takes the folder for itself", again.returncode == 0 and not pathlib.Path("files/torque_drag.csv").exists(), again.stderr)


straight()
forms()
limits()
as_it_is = backward()
level()
buckled()
pulled()
pressure()
grades()
stiff("build_hold_1400m", 0.01, 0.03)
stiff("extended_reach_5000m", 0.01, 0.05)
# A vertical string hardly touches: what torque the bit does not ask for is small.
alone = stiff("vertical_5000m", 0.005, 0.01)
together = static_state("vertical_5000m", ranks=2)
for key in ("hook_load", "top_torque_equilibrium"):
    near(f"vertical_5000m: {key} on two ranks", together[key], alone[key], 1e-10)
long = stiff("vertical_10000m", 0.005, 0.01)
near("5 and 10 km have the same lower end: contact forces", long["total_normal_force"], alone["total_normal_force"], 0.01)
expect("neither moves along a well that turns", not any("along the well" in w for w in alone["warnings"] + long["warnings"]), alone["warnings"] + long["warnings"])
# From the nodes of the unloaded string it does, and presses on the wall too hard: the program says so.
unloaded = static_state("vertical_5000m", 1, "Static/Reference=Unloaded")
expect("vertical_5000m from unloaded nodes: contact forces are too large", unloaded["total_normal_force"] > 1.1 * alone["total_normal_force"], unloaded["total_normal_force"])
expect("vertical_5000m from unloaded nodes: it is said that the string moves along a well that turns", any("Set Static/Reference" in w for w in unloaded["warnings"]), unloaded["warnings"])
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
