#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks `tooljoint bha` through the program: beam theory, turned holes and tool faces, balance
of forces, tables, refusals, ranks.

    check_bottom_hole.py PROGRAM MPIEXEC SOURCES

Distances of reference solutions are positive towards the low side, results of the program towards
the high side.
"""
import json
import math
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from beam_theory import Beam  # noqa: E402
from checks import expect, finish, tooljoint  # noqa: E402
from collars import (BORE, CLEARANCE, DENSITY, LENGTH, OUTER, RIGIDITY, SOURCES, WEIGHT, YOUNG,
                     bend, deck, gauge, listed, near, pad, parameter, rows, run)  # noqa: E402


def slick():
    """Pendulum of a slick collar (Lubinski 1950) in a horizontal hole, where P is the weight on bit
    all along: without it L^4 = 24 E I c/w and F = w L/2."""
    found = run(deck("slick", {}), "Bottom-Hole Assembly/Weight On Bit={0 kN, 100 kN}")
    tangency = (24 * RIGIDITY * CLEARANCE / WEIGHT)**0.25
    # the tangency point changes less than the force, and lies between two nodes half a metre
    # apart
    near("side force without weight on bit", -found[0]["side_force_high"], WEIGHT * tangency / 2,
         2e-3)
    expect(f"tangency point {found[0]['tangency']} against {tangency:.2f}",
           0 <= found[0]["tangency"] - tangency + 0.5 <= 1.0)
    # E I v'(0) = w L^3/12 towards the low side, so the bit, which points down the hole, is tilted
    # to the high side
    near("tilt without weight on bit", found[0]["tilt_high"], WEIGHT * tangency**3 / 12 / RIGIDITY,
         5e-3)
    beam = Beam(RIGIDITY, lambda x: WEIGHT, lambda x: 1e5)
    loaded = beam.slick([], CLEARANCE)
    near("moments about the tangency point, F = w L/2 - P c/L", -loaded["bit"],
         WEIGHT * loaded["length"] / 2 - 1e5 * CLEARANCE / loaded["length"], 1e-6)
    near("side force under weight on bit", found[1]["side_force_high"], loaded["bit"], 2e-3)
    near("tilt under weight on bit", found[1]["tilt_high"], loaded["tilt"], 5e-3)


def inclined():
    """The same at 20 deg, where P decreases along the hole because of the weight, with a refined
    mesh."""
    inclination = math.radians(20.0)
    along, across = WEIGHT * math.cos(inclination), WEIGHT * math.sin(inclination)
    beam = Beam(RIGIDITY, lambda x: across, lambda x: 5e4 - along * x)
    expected = beam.slick([], CLEARANCE)
    errors = []
    for size in (2.0, 1.0, 0.5):
        file = deck("inclined", {}, inclination=20.0)
        text = pathlib.Path(file).read_text(encoding="utf-8").replace(
            f'value="{2 * round(LENGTH)}"', 'value="30"')
        pathlib.Path(file).write_text(text, encoding="utf-8")
        found = run(file, "Bottom-Hole Assembly/Weight On Bit={50 kN}",
                    f"Bottom-Hole Assembly/Element Length={size}")
        errors.append(abs(found[0]["side_force_high"] / expected["bit"] - 1))
    expect(f"errors of the side force {errors} fall with the mesh", errors[-1] < 2e-3
           and errors[-1] < 0.5 * errors[0])


def stabiliser():
    """One stabiliser as a fulcrum or as a pendulum, on the low side."""
    for place, radius in ((1.5, 0.1075), (12.0, 0.1075)):
        found = run(deck("stabiliser", {place: gauge(radius)}),
                    "Bottom-Hole Assembly/Weight On Bit={100 kN}")[0]
        beam = Beam(RIGIDITY, lambda x: WEIGHT, lambda x: 1e5)
        expected = beam.slick([(place, "support", BORE - radius)], CLEARANCE)
        contact = found["contacts"][0]
        near(f"side force of the bit, stabiliser at {place} m", found["side_force_high"],
             expected["bit"], 5e-3)
        near("force of the wall on the stabiliser", contact["force_high"],
             -expected["reactions"][0], 5e-3)
        near("tilt", found["tilt_high"], expected["tilt"], 5e-3)
        expect("a fulcrum near the bit builds, far from it drops",
               (found["side_force_high"] > 0) == (place < 5), found["side_force_high"])


def bent():
    """A bend between bit, stabiliser and top: M = 3 E I b (c - d)/(c (a + c)) at the stabiliser, d
    from it to the bend, c to the top. Little weight: it would add a beam-column."""
    a, d, length, angle = 6.0, 4.0, 30.0, math.radians(0.5)
    c = length - a
    features = {a: gauge(BORE), a + d: bend(0.5)}
    moment = 3 * RIGIDITY * angle * (c - d) / (c * (a + c))
    file = deck("bent", features, inclination=0.0, gravity=0.01, length=length)
    found = run(file, "Bottom-Hole Assembly/Tool Face={0 deg, 90 deg, 205 deg}")
    for row, face in zip(found, (0.0, 90.0, 205.0)):
        # the lower part points to the tool face; the rock holds the bit back, so it pushes there
        near(
            f"side force to the tool face {face}",
            row["side_force_high"] * math.cos(math.radians(face)) +
            row["side_force_right"] * math.sin(math.radians(face)), moment / a, 2e-3)
        near(
            "and nothing across", row["side_force_right"] * math.cos(math.radians(face)) -
            row["side_force_high"] * math.sin(math.radians(face)), 0.0, 1e-4, moment / a)
        near("moment at the stabiliser", row["largest_moment"], moment, 2e-3)
        near("tilt of the bit to the tool face", math.hypot(row["tilt_high"], row["tilt_right"]),
             moment * a / (6 * RIGIDITY), 2e-3)
        near("stress of bending", row["largest_von_mises"], moment * OUTER / (RIGIDITY / YOUNG),
             2e-3)
    turning = found[3]
    expect(
        "turning, the bend pushes to all sides alike", turning["mode"] == "rotating"
        and math.hypot(turning["side_force_high"], turning["side_force_right"]) < 1e-6 * moment / a)
    # in a hole with weight and weight on bit, against the beam-column
    features = {1.0: gauge(0.1075), 2.5: bend(0.5), 9.0: gauge(0.107)}
    found = run(deck("motor", features), "Bottom-Hole Assembly/Weight On Bit={80 kN}",
                "Bottom-Hole Assembly/Tool Face={0 deg}")[0]
    beam = Beam(RIGIDITY, lambda x: WEIGHT, lambda x: 8e4)
    # +1: it leans on the low side
    lower, upper = (math.copysign(1.0, contact["force_high"]) for contact in found["contacts"])
    events = [
        (1.0, "support", lower * 5e-4),
        (2.5, "kink", -math.radians(0.5)),
        (9.0, "support", upper * 1e-3),
    ]
    expected = beam.slick(events, CLEARANCE)
    near("side force of a motor", found["side_force_high"], expected["bit"], 5e-3)
    for contact, reaction in zip(found["contacts"], expected["reactions"]):
        near(f"force on the stabiliser at {contact['from_bit']} m", contact["force_high"],
             -reaction, 1e-2)


def eccentric():
    """The offset of an eccentric gauge increases or reduces its lean on the wall; with the offset
    across, it turns the results of a vertical hole."""
    place, radius, offset = 6.0, 0.104, 0.003
    beam = Beam(RIGIDITY, lambda x: WEIGHT, lambda x: 5e4)
    for direction, side in ((0.0, 1.0), (180.0, -1.0)):
        found = run(deck("eccentric", {place: gauge(radius, offset=offset, direction=direction)}),
                    "Bottom-Hole Assembly/Weight On Bit={50 kN}")
        # an offset to the high side lowers the string, an offset to the low side lifts it
        expected = beam.slick([(place, "support", BORE - radius + side * offset)], CLEARANCE)
        near(f"side force, offset towards {direction} deg", found[0]["side_force_high"],
             expected["bit"], 5e-3)
        near("force on the gauge", found[0]["contacts"][0]["force_high"], -expected["reactions"][0],
             5e-3)
        expect("an eccentric gauge turns with the string", found[1]["mode"] == "rotating")
    a, length = 6.0, 30.0
    file = deck("kick", {a: gauge(BORE, offset=0.002, direction=30.0)}, inclination=0.0,
                gravity=0.01, length=length)
    found = run(file, "Bottom-Hole Assembly/Tool Face={60 deg}")[0]
    # the centre of the string is held y = 2 mm from the axis, away from the offset at 60 + 30 deg:
    # M = 3 E I y (1/a + 1/c)/(a + c)
    c = length - a
    moment = 3 * RIGIDITY * 0.002 * (1 / a + 1 / c) / (a + c)
    near("side force of a string pushed aside by a gauge", found["side_force_right"], -moment / a,
         2e-3)
    near("and nothing across", found["side_force_high"], 0.0, 1e-4, moment / a)


def pads():
    """A pad pushes the string away from its own side."""
    place, force = 3.0, 1e4
    for direction, side in ((180.0, -1.0), (0.0, 1.0)):
        found = run(deck("pad", {place: pad(force, direction)}),
                    "Bottom-Hole Assembly/Weight On Bit={50 kN}")
        beam = Beam(RIGIDITY, lambda x: WEIGHT, lambda x: 5e4)
        expected = beam.slick([(place, "force", side * force)], CLEARANCE)
        near(f"side force, pad towards {direction} deg", found[0]["side_force_high"],
             expected["bit"], 5e-3)
        expect("a pad stands while the string turns", [row["mode"] for row in found] == ["sliding"])


def curved():
    """Bit, stabiliser and top on a circle: M = 3/2 E I kappa at the stabiliser (three-moment
    equation), whatever the azimuth, and E I kappa less elsewhere."""
    a, length, kappa = 6.0, 30.0, math.radians(0.3) / 30.0
    file = deck("curved", {a: gauge(BORE)}, inclination=0.0, gravity=1e-4, length=length)
    settings = [
        "Bottom-Hole Assembly/Inclination={30 deg, 90 deg}", "Bottom-Hole Assembly/Length=30 m"
    ]
    for rate, side in (
        ("Build Rate=0.3 deg/30m", (1.0, 0.0)),
        ("Build Rate=-0.3 deg/30m", (-1.0, 0.0)),
        ("Turn Rate=0.3 deg/30m", (0.0, 1.0)),
    ):
        for row in run(file, *settings, f"Bottom-Hole Assembly/{rate}"):
            size = kappa * (1.0 if side[0] else math.sin(row["inclination"]))
            # the bent string is straighter than the hole, so the bit pushes to the outer side
            near(f"{rate}: side force to the high side", row["side_force_high"],
                 -side[0] * 1.5 * RIGIDITY * size / a, 5e-3, RIGIDITY * kappa / a)
            near(f"{rate}: side force to the right", row["side_force_right"],
                 -side[1] * 1.5 * RIGIDITY * size / a, 5e-3, RIGIDITY * kappa / a)
            near("moment at the stabiliser", row["largest_moment"], 1.5 * RIGIDITY * size, 5e-3)
            below = [one for one in row["profile"] if one["from_bit"] <= a]
            worst = max(
                abs(one["moment_high"] * side[0] + one["moment_right"] * side[1] -
                    1.5 * RIGIDITY * size * one["from_bit"] / a) for one in below)
            expect("below it the moment falls linearly to nothing at the bit",
                   worst < 5e-3 * RIGIDITY * kappa, worst)
            # relative to the chord between bit and stabiliser the hole turns by kappa a/2, the
            # string by M a/(6 E I)
            near("tilt", row["tilt_high"] * side[0] + row["tilt_right"] * side[1],
                 1.5 * size * a / 6 - size * a / 2, 5e-3, size * a / 4)
    torque = 4000.0
    row = run(
        deck("torque", {a: gauge(BORE)}, inclination=0.0, gravity=1e-4, length=length,
             loads=parameter("Torque On Bit", f"{torque} N m")), *settings,
        "Bottom-Hole Assembly/Build Rate=0.3 deg/30m")[0]
    expect(
        "a twist bends nothing: across the plane there is but the torque that turns with the hole",
        max(abs(one["moment_right"]) for one in row["profile"]) < torque * kappa * length,
        max(abs(one["moment_right"]) for one in row["profile"]))
    # with weight, against the beam-column in the hole y = -kappa x^2/2 (up: the hole builds), whose
    # load turns with it
    file = deck("building", {6.0: gauge(0.1075)})
    found = run(file, "Bottom-Hole Assembly/Inclination={60 deg}",
                "Bottom-Hole Assembly/Build Rate=3 deg/30m",
                "Bottom-Hole Assembly/Weight On Bit={50 kN}")[0]
    bit, kappa = math.radians(60.0), math.radians(3.0) / 30.0
    beam = Beam(RIGIDITY, lambda x: WEIGHT * math.sin(bit - kappa * x),
                lambda x: 5e4 - WEIGHT * x * math.cos(bit - kappa * x / 2),
                lambda x: -kappa * x * x / 2)
    expected = beam.slick([(6.0, "support", 5e-4)], CLEARANCE)
    # the load is q across the hole; across the axis at the bit the difference is the cosine of the
    # turn, 1e-3
    near("side force in a hole that builds", found["side_force_high"], expected["bit"], 1e-2,
         abs(expected["reactions"][0]))


def slid():
    """A string on the low side of a building hole has the longer path, so it slides along the hole,
    which turns; a longer string slides more. Forces, tilt and sag relative to the hole at bit and
    tool do not change."""
    file = deck("slid", {6.0: gauge(0.1075)}, length=160.0)
    short, long = (run(file, "Bottom-Hole Assembly/Inclination={75 deg}",
                       "Bottom-Hole Assembly/Build Rate=6 deg/30m",
                       "Bottom-Hole Assembly/Survey Tool=12 m",
                       f"Bottom-Hole Assembly/Length={length} m")[0] for length in (50, 150))
    for key, scale in (("side_force_high", 6e3), ("tilt_high", 6e-3), ("sag_high", 2e-3)):
        near(f"{key} of 50 and 150 m of string", short[key], long[key], 5e-4, scale)


def turned():
    """The same hole in another azimuth, and a vertical hole with another tool face, give the same
    numbers."""
    features = {1.0: gauge(0.1075), 2.5: bend(0.7), 9.0: gauge(0.107)}
    settings = ("Bottom-Hole Assembly/Weight On Bit={60 kN}",
                "Bottom-Hole Assembly/Tool Face={75 deg}", "Bottom-Hole Assembly/Survey Tool=15 m")
    north = run(deck("north", features, inclination=40.0), *settings)[0]
    west = run(deck("west", features, inclination=40.0, azimuth=283.0), *settings)[0]
    for key in ("side_force_high", "side_force_right", "tilt_high", "tilt_right", "largest_moment",
                "sag_high", "sag_right"):
        near(
            f"{key} in another azimuth", west[key], north[key], 1e-6,
            max(abs(north["side_force_high"]), abs(north["side_force_right"]))
            if "force" in key else None)
    file = deck("vertical", features, inclination=0.0)
    faces = run(file, *settings[:1], "Bottom-Hole Assembly/Tool Face={0 deg, 90 deg}")
    scale = abs(faces[0]["side_force_high"])
    near("tool face 90 deg in a vertical hole, high to right", faces[1]["side_force_right"],
         faces[0]["side_force_high"], 1e-6)
    near("right to low", faces[1]["side_force_high"], -faces[0]["side_force_right"], 1e-6, scale)
    mirror = run(deck("mirror", features, inclination=40.0), settings[0],
                 "Bottom-Hole Assembly/Tool Face={-75 deg}", settings[2])[0]
    near("the other side mirrors the right side", mirror["side_force_right"],
         -north["side_force_right"], 1e-6)


def example():
    """The steerable motor of xml/: results do not depend on the modelled length or the number of
    ranks; tables, summary and report agree."""
    motor = str(SOURCES / "xml/bha_motor_1500m.xml")
    setting = [
        f"Bottom-Hole Assembly/{what}"
        for what in ("Tool Face={30 deg}", "Rotating Tool Faces=3", "Element Length=1")
    ]
    found = run(motor, *setting, folder="motor")
    whole = json.loads(pathlib.Path("motor/summary.json").read_text(encoding="utf-8"))["bha"]
    expect(
        "a length is found and checked", 30 <= whole["length"] < 200
        and whole["checked_length"] < whole["length"] and whole["length_change"] < 0.01,
        whole["length"])
    longer = run(motor, *setting, "Bottom-Hole Assembly/Length=90 m", folder="longer")
    for row, other, summary in zip(found, longer, whole["rows"]):
        near(f"side force with 90 m, twice as much, {row['mode']}", other["side_force_high"],
             row["side_force_high"], 0.01, max(abs(row["side_force_high"]), 1e3))
        expect(
            "the summary has the row",
            all(
                abs(summary[key] - row[key]) < 1e-8 * max(1.0, abs(row[key]))
                for key in ("weight_on_bit", "side_force_high", "tilt_right", "sag_high")), summary)
        expect("moments and stresses are the largest of the profile",
               row["largest_von_mises"] == max(one["von_mises"] for one in row["profile"]))
        # and the weight of half an element
        near("WOB is the compression at the bit", row["profile"][0]["axial_force"],
             -row["weight_on_bit"], 1.0, 500.0)
    drawn = subprocess.run(
        [sys.executable, str(SOURCES / "tools/plot_bha.py"), "motor"], stdout=subprocess.PIPE,
        stderr=subprocess.PIPE, text=True, check=False)
    expect("the picture is drawn", drawn.returncode == 0
           and pathlib.Path("motor/bha.png").stat().st_size > 20000, drawn.stderr)
    expect("four weights, sliding and rotating",
           [row["mode"] for row in found] == ["sliding", "rotating"] * 4,
           [row["mode"] for row in found])
    faces = run(motor, "Bottom-Hole Assembly/Tool Face={0 deg, 120 deg, 240 deg}",
                "Bottom-Hole Assembly/Rotating Tool Faces=3",
                "Bottom-Hole Assembly/Weight On Bit={40 kN}", folder="faces")
    for key in ("side_force_high", "side_force_right", "tilt_high", "sag_high"):
        near(f"rotating is the average over tool faces, {key}", faces[3][key],
             sum(row[key] for row in faces[:3]) / 3, 1e-6, max(abs(row[key]) for row in faces))
    expect("of stresses it has the largest",
           faces[3]["largest_von_mises"] == max(row["largest_von_mises"] for row in faces[:3]))
    run(motor, *setting, folder="two_ranks", ranks=2)
    for table in ("bha.csv", "bha_contacts.csv", "bha_profile.csv"):
        expect(
            f"two ranks write the same {table}",
            pathlib.Path("two_ranks", table).read_text(encoding="utf-8") == pathlib.Path(
                "motor", table).read_text(encoding="utf-8"))


def lying():
    """A string on the wall of a horizontal hole: walls and bit carry its whole buoyed weight except
    near the cut."""
    file = deck("lying", {}, more=listed("Mud", parameter("Density", "1200 kg/m3")))
    row = run(file)[0]
    weight = WEIGHT * (1 - 1200 / DENSITY)
    walls = sum(one["wall_force_high"] for one in row["profile"])
    length = row["profile"][-1]["from_bit"]
    tangency = (24 * RIGIDITY * CLEARANCE / weight)**0.25
    # the cut is held on the axis, which lifts the string over about the length to the tangency
    # point: the cut carries w L/2 less the weight lifted off the wall
    bearing = walls - row["side_force_high"]
    near("walls and bit bear the buoyed weight less that at the cut", bearing,
         weight * length - weight * tangency / 2, 1e-2)
    middle = sum(one["wall_force_high"] for one in row["profile"] if 12.0 < one["from_bit"] <= 20.0)
    near("in the middle a metre bears its own buoyed weight", middle, 8 * weight, 5e-3)


def missing():
    """A weight without an equilibrium gives a warning; the rows of the other weights are kept."""
    scene = str(SOURCES / "tests/effects/bottom_hole.xml")
    settings = ("--set", "Bottom-Hole Assembly/Weight On Bit={10 kN, 20000 kN}", "--set",
                "Static/Max Iterations=10")
    done = tooljoint("bha", scene, "--output", "missing", *settings)
    expect("bha ends well without one of its rows", done.returncode == 0, done.stderr)
    found = rows("missing", "bha.csv")
    expect("the rows of 10 kN are there", {row["weight_on_bit"] for row in found} == {1e4}
           and len(found) == 2, found)
    expect(
        "those of 20000 kN are told",
        done.stderr.count(
            "No equilibrium was found, so no table has this state: 20000.0 kN on the bit") == 2,
        done.stderr)
    with open("missing/summary.json", encoding="utf-8") as file:
        expect("and counted", json.load(file)["bha"]["missing"] == 2)
    done = tooljoint("bha", scene, "--output", "missing_all", *settings[2:], "--set",
                     "Bottom-Hole Assembly/Weight On Bit={20000 kN}")
    expect("bha without any row does not converge", done.returncode == 4
           and "did not converge" in done.stderr, f"{done.returncode} {done.stderr}")


def refused():
    """Decks without a solution, each with a message."""
    good = deck("good", {2.0: gauge(0.107), 4.0: bend(0.5)})
    survey = "Bottom-Hole Assembly/Survey Tool"
    for wanted, settings, without in (
        ("needs contact with the wall of the hole. Add the list Contact", [], ["Contact"]),
        ("needs its weight. Add the list Loads", [], ["Loads"]),
        ("Loads/Gravity is 0, but a bottom-hole assembly needs its weight", ["Loads/Gravity=0"],
         []),
        ("the string is 60 m long. Give a distance on the string", [f"{survey}=70 m"], []),
        ("beyond the Length of 30 m", [f"{survey}=40 m", "Bottom-Hole Assembly/Length=30 m"], []),
        (
            "applies to the holes of Inclination, which is not given",
            ["Bottom-Hole Assembly/Build Rate=1 deg/30m"],
            [],
        ),
        ("leaves out dofs that a bottom-hole assembly needs", ["Supports/Dofs=lateral"], []),
        (
            "modelled at rest alone. Leave Transient out, or a bend",
            [
                "Transient/End Time=1", "Transient/Step=0.01", "Transient/Sampling Interval=0.1",
                "Transient/Integrator=Generalized-alpha"
            ],
            [],
        ),
        (
            "turns by 200 deg over the 30 m",
            [
                "Bottom-Hole Assembly/Inclination={40 deg}",
                "Bottom-Hole Assembly/Build Rate=200 deg/30m"
            ],
            [],
        ),
        (
            "elements; at most 10000 are possible. Give a longer one",
            ["Bottom-Hole Assembly/Element Length=1e-9"],
            [],
        ),
        ("out of range: it must be > 0", ["Bottom-Hole Assembly/Length=-3 m"], []),
    ):
        arguments = [part for one in settings for part in ("--set", one)
                     ] + [part for one in without for part in ("--without", one)]
        done = tooljoint("bha", good, "--output", "refused", *arguments)
        expect(f"refused with: {wanted}", done.returncode == 2
               and wanted in " ".join(done.stderr.split()), (done.returncode, done.stderr))
    force = listed(
        "Forces",
        listed("push", '<Parameter name="Node" type="int" value="5"/>', parameter("Component", "u"),
               parameter("Value", "10 N")))
    support = listed(
        "Supports",
        listed("packer", '<Parameter name="Node" type="int" value="7"/>', parameter("Dofs", "u v")))
    for wanted, file in (
        ("acts at numbered nodes, and `tooljoint bha` renumbers the nodes",
         deck("forces", {}, loads=force)),
        ("holds node 7, which `tooljoint bha` does not support", deck("packer", {}, more=support)),
    ):
        done = tooljoint("bha", file, "--output", "refused")
        expect(f"refused with: {wanted}", done.returncode == 2
               and wanted in " ".join(done.stderr.split()), (done.returncode, done.stderr))
    done = tooljoint("bha", str(SOURCES / "xml/frame.xml"), "--output", "refused")
    expect("a scene of parts has no bottom-hole assembly", done.returncode == 2
           and "needs a string in its well" in done.stderr, done.stderr)


def documented():
    """The table of docs/guide/bottom-hole-assembly.md about xml/bha_motor_1500m.xml agrees with the
    program."""
    text = (SOURCES / "docs/guide/bottom-hole-assembly.md").read_text(encoding="utf-8")
    table = text[text.index("| `Build Rate` [deg/30 m] | tool face |"):].split(
        "\n\n")[0].splitlines()[2:]
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in table]
    expect("the document has rows for three rates of build",
           [line[0] for line in cells] == ["0"] * 3 + ["3"] * 3 + ["6"] * 3, cells)
    for rate in ("0", "3", "6"):
        found = run(str(SOURCES / "xml/bha_motor_1500m.xml"),
                    "Bottom-Hole Assembly/Inclination={45 deg}",
                    f"Bottom-Hole Assembly/Build Rate={rate} deg/30m",
                    "Bottom-Hole Assembly/Weight On Bit={80 kN}",
                    "Bottom-Hole Assembly/Tool Face={0 deg, 180 deg}", folder=f"documented_{rate}")
        for row, (_, face, force, tilt, moment,
                  stress) in zip(found, [line for line in cells if line[0] == rate]):
            expect(
                f"docs/guide/bottom-hole-assembly.md, {rate} deg/30 m: the row of tool face {face}",
                row["mode"] == ("rotating" if face == "rotating" else "sliding"), row["mode"])
            size, place = moment.split(",")
            for what, said, computed in (
                ("side force", force, row["side_force_high"] / 1e3),
                ("tilt", tilt, math.degrees(row["tilt_high"])),
                ("moment", size, row["largest_moment"] / 1e3),
                ("its place", place, row["largest_moment_from_bit"]),
                ("stress", stress, row["largest_von_mises"] / 1e6),
            ):
                digits = len(said.strip().partition(".")[2])
                expect(
                    f"docs/guide/bottom-hole-assembly.md, {rate} deg/30 m, {face}, {what}: "
                    f"{said.strip()} is {computed:.{digits}f}",
                    abs(float(said) - computed) <= 0.51 * 10**-digits)


def main():
    for check in (slick, inclined, stabiliser, bent, eccentric, pads, curved, slid, turned, example,
                  lying, missing, refused, documented):
        check()
    return finish()


if __name__ == "__main__":
    sys.exit(main())
