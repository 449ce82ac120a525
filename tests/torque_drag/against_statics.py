# SPDX-License-Identifier: BSD-3-Clause
"""The stiff string of torque and drag compared with the static state and motion of the program."""
import json
import pathlib
import re

import h5py

from checks import expect, tooljoint
from runs import DECK, SOURCES, near, rows, run, static_state


def beside():
    """Stiff and soft string in a build-and-hold well, at a depth where the string is cut and for a
    string of that length."""
    whole = {
        row["operation"]: row for row in run("beside", "Torque and Drag/Depths={950}",
                                             "Torque and Drag/Yield Strength=931 MPa")
    }
    for operation, hook, torque in (
        ("Trip out", 0.005, None),
        ("Trip in", 0.005, None),
        ("Rotate off bottom", 0.002, 0.07),
        ("Drill rotating", 0.002, 0.03),
    ):
        row = whole[operation]
        near(f"{operation}: hook load, stiff beside soft", float(row["stiff_hook_load"]),
             float(row["hook_load"]), hook)
        if torque:
            near(f"{operation}: torque, stiff beside soft", float(row["stiff_surface_torque"]),
                 float(row["surface_torque"]), torque)
            near(f"{operation}: twist, stiff beside soft", float(row["stiff_twist"]),
                 float(row["twist"]), torque)
        near(f"{operation}: stretch, stiff beside soft", float(row["stiff_stretch"]),
             float(row["stretch"]), 0.01)
    short = {
        row["operation"]: row
        for row in run("short", "Torque and Drag/Depths={950}",
                       "Torque and Drag/Yield Strength=931 MPa", "Drillstring/Assembly={100*stand}")
    }
    expect("a string cut at the surface is one that ends there", short == whole,
           (short["Trip out"], whole["Trip out"]))
    cut = {row["operation"]: row for row in run("cut", "Torque and Drag/Depths={943.2}")}
    for operation, row in cut.items():
        near(f"{operation}: hook load of a string cut inside a pipe, stiff beside soft",
             float(row["stiff_hook_load"]), float(row["hook_load"]), 0.006)
    profile = [
        row for row in rows("beside", "torque_drag_stiff_profile.csv")
        if row["operation"] == "Trip out"
    ]
    held = sum(float(row["contact_force"]) for row in profile)
    expect(
        "drag is friction times the contact forces: the profile adds up",
        abs(
            float(whole["Trip out"]["stiff_hook_load"]) -
            float(whole["Rotate off bottom"]["stiff_hook_load"]) - 0.25 * held) <
        0.002 * 0.25 * held, held)


def in_motion(table):
    """Friction along the hole in a run: static state and motion at the speeds of an operation have
    the loads of the stiff string of torque-drag."""
    for operation, speed, ranks, turns in (
        ("Trip out", -0.3, 1, ("--without", "Rotary Speed")),
        ("Back-ream", -0.05, 2, ()),
    ):
        # above 1 um/s the coefficient is that of fast sliding
        settings = ("Contact/Friction/Axial=true", "Contact/Friction/Regularisation Velocity=1e-6",
                    "Static/Reference=Hanging", f"Top Drive/Block Speed={speed}",
                    "Transient/End Time=0.05")
        done = tooljoint("run", DECK, "--output", "in_motion", "--without", "Loads/Weight On Bit",
                         "--without", "Loads/Torque On Bit", *turns,
                         *[part for setting in settings for part in ("--set", setting)],
                         ranks=ranks)
        expect(f"{operation}: the motion runs", done.returncode == 0, done.stderr)
        row, static = table[operation], json.loads(
            pathlib.Path("in_motion/summary.json").read_text(encoding="utf-8"))["static"]
        with h5py.File("in_motion/results.h5") as file:
            hook, torque = file["transient/hook_load"][:], file["transient/surface_torque"][:]
        for what, values, stiff in (
            ("hook load", [static["hook_load"], *hook], "stiff_hook_load"),
            ("torque", [static["surface_torque"], *torque], "stiff_surface_torque"),
        ):
            true = float(row[stiff])
            worst = max(abs(value - true) for value in values)
            expect(f"{operation}: {what} of a run is {true:.6g}, off by {worst:.2g}",
                   worst <= 1e-5 * max(abs(true), 1e3))


def stiff(name, tension, torque):
    """Axial force and torque at the top against the static state of the same scene, turning on
    bottom."""
    deck = str(SOURCES / f"xml/{name}.xml")
    soft = {
        row["operation"]: row for row in run(f"soft_{name}", "Torque and Drag/Count=1",
                                             "Torque and Drag/Stiff String=None", deck=deck)
    }["Drill rotating"]
    static = static_state(name)
    expect(f"{name}: the torque balances",
           abs(static["torque_balance_defect"]) < 5e-3 * static["torque_scale"],
           static["torque_balance_defect"])
    # Drilling adds the drag of its axial speed, 5 mm/s compared with a circumferential speed of one
    # metre per second. The stiff string bridges the waves of a survey.
    near(f"{name}: tension at the top, soft against stiff", float(soft["hook_load"]),
         static["hook_load"], tension)
    near(f"{name}: torque at the top, soft against stiff", float(soft["surface_torque"]),
         -static["top_torque_equilibrium"], torque)
    return static


def weight_on_bit():
    """Weight on bit is that of the deck, in spite of other loads on the bit: xml/first_run.xml also
    has bit bounce."""
    scene = str(SOURCES / "xml/first_run.xml")
    found = run("first_run", "Torque and Drag/Count=1", deck=scene)
    table = {row["operation"]: row for row in found}
    off, on = table["Rotate off bottom"], table["Drill rotating"]
    near("weight on bit of first_run", float(off["hook_load"]) - float(on["hook_load"]), 40e3, 0.01)
    said = " ".join(
        json.loads(pathlib.Path("first_run/summary.json").read_text(encoding="utf-8"))["warnings"])
    # pipe, stabilisers and bit have no grade; collars and heavy-weight pipe have one
    bare = 53 * 28.35 + 2 * 1.8 + 1.2 + 0.35
    expect("what has no margin to yield is said",
           f"{bare:.0f} m of the string's 1593 m have no yield strength" in said, said)


def level():
    """A string on the axis of a long level hole, the start of the stages of the static state, has
    only its bending stiffness."""
    survey = pathlib.Path("level.csv").resolve()
    stations = "".join(f"{depth}, {min(90.0, max(0.0, (depth - 900) / 12)):.2f}, 45\n"
                       for depth in range(0, 4501, 30))
    survey.write_text("MD [m], Inc [deg], Azi [deg]\n" + stations, encoding="utf-8")
    string = ("28*5 in HWDP stand, 120*5 in stand, 2*5 in HWDP stand, 2*6.5 in collar, 8.5 in PDC "
              "bit")
    row = run("level", f"Well/Survey/File={survey}", f"Drillstring/Assembly={{{string}}}",
              "Loads/Unbalance/collar/Node=100", "Torque and Drag/Count=1",
              "Torque and Drag/Operations={Rotate off bottom}",
              deck=str(SOURCES / "xml/extended_reach_5000m.xml"))[0]
    near("hook load in a level hole, stiff against soft", float(row["stiff_hook_load"]),
         float(row["hook_load"]), 0.01)
    near("torque in a level hole, stiff against soft", float(row["stiff_surface_torque"]),
         float(row["surface_torque"]), 0.05)


def buckled():
    """If the weight on bit buckles it, the stiff string slides to a stable state on the wall."""
    for weight, buckles, most in (("60 kN", False, 150), ("200 kN", True, 900)):
        done = tooljoint("torque-drag", str(SOURCES / "xml/vertical_1000m.xml"), "--output",
                         "buckled", "--without", "Torque and Drag", "--set",
                         "Torque and Drag/Count=1", "--set",
                         "Torque and Drag/Operations={Drill sliding}", "--set",
                         f"Loads/Weight On Bit={weight}", "--fresh")
        said = " ".join((done.stdout + done.stderr).split())
        expect(f"{weight}: the state of the stiff string is {'' if buckles else 'not '}buckled",
               ("1 of 1 states of the stiff string are buckled" in said) == buckles, said[-800:])
        expect(f"{weight}: and stable", "of the stiff string are unstable" not in said, said[-800:])
        iterations = int(re.search(r": [0-9.e+-]+ s, ([0-9]+) iterations", said).group(1))
        expect(
            f"{weight}: from the largest share at which it does not buckle, in {iterations} "
            "iterations", iterations <= most, said[-800:])
        expect(f"{weight}: the table has it",
               float(rows("buckled")[0]["stiff_buckled"]) == buckles,
               rows("buckled")[0])


def wound():
    """A state that winds into a helix without a search for a buckled one is marked as well: the
    pipe above a bend of short radius, under the friction of the pipe below."""
    pipe = "Drillstring/Components/body/"
    for operation, buckles in (("Drill sliding", True), ("Trip out", False)):
        done = tooljoint("torque-drag", DECK, "--output", "wound", "--without",
                         "Well/Arc/Build Rate", "--set", "Well/Arc/Kick-off Depth=200", "--set",
                         "Well/Arc/Radius=40", "--set", "Well/Arc/End Inclination=90 deg", "--set",
                         "Well/Arc/Tangent Length=150", "--set", "Well/Bore Radius=0.0762", "--set",
                         pipe + "Length=10", "--set", pipe + "Elements=10", "--set",
                         pipe + "Outer Radius=0.0365", "--set", pipe + "Inner Radius=0.0273",
                         "--set", "Drillstring/Assembly={fill*body}", "--set",
                         "Loads/Weight On Bit=5 kN", "--set", "Loads/Torque On Bit=800 N m",
                         "--set", "Torque and Drag/Count=1", "--set",
                         f"Torque and Drag/Operations={{{operation}}}", "--fresh")
        expect(f"a bend of short radius, {operation}", done.returncode == 0, done.stderr)
        row = rows("wound")[0]
        expect(f"{operation}: beyond the helical limit above the bend is {buckles}",
               (float(row["stiff_helical_margin"] or 9.0) < 1.0) == buckles, row)
        expect(f"{operation}: marked as buckled is {buckles}",
               float(row["stiff_buckled"]) == buckles, row)
        expect(f"{operation}: and said", ("states of the stiff string are buckled"
                                          in done.stdout) == buckles, done.stdout)
