#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks `tooljoint buckling` through the program: limits, half waves, helices and contact against
closed forms, its tables, refusals, ranks.

    check_buckling.py PROGRAM MPIEXEC SOURCES
"""
import json
import math
import pathlib
import shutil
import sys

import h5py

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from checks import expect, finish, tooljoint  # noqa: E402
from pipes import (AREA, CLEARANCE, GRAVITY, RIGIDITY, WEIGHT, YOUNG, deck, hanging_beam, rows,
                   shape_contact)  # noqa: E402
from screens import expect_screen  # noqa: E402

SOURCES = pathlib.Path(sys.argv[3])


def summary(folder):
    return json.loads(
        (pathlib.Path(folder) / "summary.json").read_text(encoding="utf-8"))["buckling"]


def run(file, *settings, folder=None, ranks=1):
    """Rows of buckling.csv and values of the summary."""
    folder = folder or "out_" + pathlib.Path(file).stem
    done = tooljoint("buckling", file, "--output", folder,
                     *(part for one in settings for part in ("--set", one)), ranks=ranks)
    expect(f"buckling of {file} ends well {settings}", done.returncode == 0, done.stderr)
    expect_screen(done, folder, "buckling")
    found = rows(folder)
    most = max(range(len(found)), key=lambda i: found[i]["weight_on_bit"])
    sense = [b["weight_on_bit"] - a["weight_on_bit"] for a, b in zip(found, found[1:])]
    expect("weights grow, and fall after the last one",
           all(x > 0 for x in sense[:most]) and all(x < 0 for x in sense[most:]))
    return found, summary(folder)


def near(what, value, expected, tolerance):
    expect(f"{what}: {value:.6g} against {expected:.6g}",
           abs(value - expected) <= tolerance * abs(expected), "")


def on_the_wall(what, folder, found, length, inclination=90.0):
    """Contact of buckled states: 0.4 mm of penetration, 1 % of r, and differences of the shape over
    0.5 m, a twentieth of a half wave, stay below 4 %."""
    buckled = [i for i, row in enumerate(found) if row["half_waves"] >= 3]
    apart = max(
        abs(found[i]["contact_force"] / force - 1)
        for i, force in zip(buckled, shape_contact(folder, buckled, length, inclination)))
    expect(
        f"{what}: contact of {len(buckled)} buckled states by the equilibrium of their shapes, "
        f"within {apart:.1e}",
        len(buckled) > 5 and apart < 4e-2)


def euler():
    """A weightless pipe of 20 m: Euler's load, one contact up to 4 times that load (Timoshenko and
    Gere, 1.11), and then deflection out of the plane; in the plane the pipe would lie flat on the
    wall."""
    length = 20.0
    load = RIGIDITY * (math.pi / length)**2
    found, said = run(deck("euler", length, 40, 6 * load, gravity=0.0), "Buckling/Crookedness=0.01",
                      "Buckling/Largest Step=0.02")
    near("Euler's load", said["limit"], load, 1e-3)
    far = tooljoint("buckling", deck("euler_far", length, 40, 30 * load, gravity=0.0), "--output",
                    "euler_far", "--set", "Buckling/Crookedness=0.01")
    near(f"and does not depend on the last weight on bit (exit code {far.returncode})",
         summary("euler_far")["limit"], said["limit"], 5e-5)
    near("as the formula of the summary", said["theory"]["finite_length"], load, 1e-9)
    expect("formulas of a pipe with weight stay out", said["theory"].get("sinusoidal") is None
           and said["theory"]["finite_half_waves"] == 1)
    for row in found:
        ratio = row["weight_on_bit"] / load
        if row["contact_nodes"] == 0:
            expect(f"no contact at {ratio:.3f} of Euler's load", ratio < 1.0)
        elif 1.3 < ratio < 3.0:
            # the deflection r by a force N in the middle, N = 4 u F r/(L (u - tan u)), u = L/2
            # sqrt(F/E I)
            u = length / 2 * math.sqrt(row["weight_on_bit"] / RIGIDITY)
            near(f"contact force at {ratio:.2f} of Euler's load", row["total_contact_force"],
                 4 * u * row["weight_on_bit"] * CLEARANCE / (length * (u - math.tan(u))), 1e-2)
            expect("in a plane, at one node", row["contact_nodes"] == 1
                   and abs(row["turns"]) < 5e-3, row["turns"])
    leaving = next(row["weight_on_bit"] for row in found if abs(row["turns"]) > 2e-2)
    near("out of the plane from 4 Euler loads on", leaving, 4 * load, 5e-2)
    expect("all of it stable", all(row["negative_pivots"] == 0 for row in found))


def helix():
    """A weightless pipe of 60 m winds into a helix: pitch, contact and shortening of Lubinski,
    Althouse and Logan (1962). The influence of the ends reaches less far into the middle half as
    the pitch decreases, at last over a fifth of it."""
    found, _ = run(deck("helix", 60.0, 120, 3e5, gravity=0.0))
    row = found[-1]
    force = row["compression"]
    near("compression", force, 3e5, 1e-6)
    # contact penetration puts the pipe 0.1 to 0.4 mm farther out: 0.8 % of r
    near("contact force r F^2/(4 E I)", row["contact_force"], CLEARANCE * force**2 / (4 * RIGIDITY),
         1e-2)
    near("pitch sqrt(8 pi^2 E I/F)", row["pitch"], math.sqrt(8 * math.pi**2 * RIGIDITY / force),
         1e-2)
    near("shortening r^2 F/(4 E I)", row["strain"], CLEARANCE**2 * force / (4 * RIGIDITY), 1.5e-2)
    for name in ("contact_force", "strain", "pitch"):
        formula = {
            "contact_force": CLEARANCE * force**2 / (4 * RIGIDITY),
            "strain": CLEARANCE**2 * force / (4 * RIGIDITY),
            "pitch": math.sqrt(8 * math.pi**2 * RIGIDITY / force)
        }[name]
        near(f"helical_{name} of the table", row[f"helical_{name}"], formula, 1e-6)
    # the bit moves by F L/(E S) and by the shortening; a step of the table is a small part of the
    # path
    for state in found:
        near("advance of the bit", -state["bit_advance"], state["weight_on_bit"] * 60.0 /
             (YOUNG * AREA) + state["shortening"], 1e-6) if state["weight_on_bit"] else None
    first, second = found[-3], found[-1]
    added = second["weight_on_bit"] - first["weight_on_bit"]
    slope = (first["bit_advance"] - second["bit_advance"]) / added
    near("slope of load and displacement, L/(E S) + r^2 L/(4 E I)", slope,
         60.0 / (YOUNG * AREA) + CLEARANCE**2 * 60.0 / (4 * RIGIDITY), 2e-2)


def horizontal():
    """A pipe of 100 m in a horizontal hole: Dawson and Paslay (1984), the half wave, and the slope
    of the sinusoid of Mitchell (1997)."""
    length, critical = 100.0, 2 * math.sqrt(RIGIDITY * WEIGHT / CLEARANCE)
    found, said = run(deck("horizontal", length, 200, 1.6 * critical, inclination=90.0),
                      "Buckling/Largest Step=0.02")
    near("2 sqrt(E I w/r) in the summary", said["theory"]["sinusoidal"], critical, 1e-6)
    near("2 sqrt(2) sqrt(E I w/r) in the summary", said["theory"]["helical"],
         math.sqrt(2) * critical, 1e-6)
    # the hinges hold the ends on the axis, a clearance above the low side: a tenth of the length
    # is off the wall
    near("first buckling", said["limit"], critical, 2.5e-2)
    # with a torque it buckles into the sinusoid without a negative pivot
    _, twisted = run(deck("twisted", length, 200, 1.2 * critical, inclination=90.0),
                     "Loads/Torque On Bit=10", "Buckling/Crookedness=0")
    near("first buckling under a torque of 10 N m", twisted["limit"], said["limit"], 1e-2)
    buckled = [row for row in found if row["weight_on_bit"] > 1.1 * critical]
    near("half wave pi (E I r/w)^(1/4)", buckled[0]["half_wave_length"],
         math.pi * (RIGIDITY * CLEARANCE / WEIGHT)**0.25, 3e-2)
    before = [row for row in found if row["weight_on_bit"] < 0.7 * critical]
    for row in before:
        near("not buckled, the wall bears the weight", row["contact_force"], WEIGHT, 5e-3)
    expect("and the table calls it so", all(row["half_waves"] == 0 for row in before),
           [row["half_waves"] for row in before])
    # Mitchell (SPE Drilling & Completion 14, 1999, eq. 7): largest slope of the angle 1.1227/sqrt(2
    # E I) F^0.04 (F - F_p)^0.46
    import h5py  # noqa: PLC0415
    with h5py.File("out_horizontal/buckling.h5") as file:
        depth, high, right = file["states/depth"][:], file["states/deflection_high"][-1], file[
            "states/deflection_right"][-1]
    angle = [math.atan2(y, -x) for x, y in zip(high, right)]
    slopes = [
        abs(b - a) / (t - s) for a, b, s, t in zip(angle, angle[1:], depth, depth[1:])
        if 0.25 * length < s < 0.75 * length
    ]
    on_the_wall("horizontal", "out_horizontal", found, length)
    force = found[-1]["compression"]
    near("largest slope of the angle", max(slopes),
         1.1227 / math.sqrt(2 * RIGIDITY) * force**0.04 * (force - critical)**0.46, 6e-2)


def curved():
    """100 m in a hole that builds with a radius of 600 m: the wall bears w + F/R (He and
    Kyllingstad 1995), F^2 = 4 E I/r (w sin + F/R), and without weight F = 4 E I/(r R)."""
    radius = 600.0
    bend = 4 * RIGIDITY / (CLEARANCE * radius)
    for gravity in (0.0, GRAVITY):
        weight = WEIGHT * gravity / GRAVITY
        critical = bend / 2 + math.sqrt(bend**2 / 4 + 4 * RIGIDITY * weight / CLEARANCE)
        _, said = run(
            deck("curved", 100.0, 200, 1.15 * critical, inclination=90.0, gravity=gravity,
                 radius=radius))
        near(f"first buckling in a bend, g = {gravity}", said["limit"], critical, 3e-2)
        near("and by the formula of the summary", said["theory"]["sinusoidal"], critical, 1e-2)


def transition():
    """60 deg, 100 m: under a growing load the pipe stays sinusoidal well beyond the load of a
    helix, to 2.8 times the first buckling (Mitchell 1997), and then jumps."""
    critical = 2 * math.sqrt(RIGIDITY * WEIGHT * math.sin(math.radians(60)) / CLEARANCE)
    found, said = run(deck("transition", 100.0, 200, 3.1e5, inclination=60.0))
    jumps = [one["weight_on_bit"] for one in said.get("jumps", [])]
    expect(f"the string jumps, under {jumps}", bool(jumps) and found[-1]["branch"] == len(jumps))
    last = [row for row in found if row["branch"] == 0][-1]
    # a pipe buckled with half a wave more or less turns over at a load a few per cent smaller or
    # larger
    near("compression of the last sinusoidal state over the first buckling",
         last["compression"] / critical, 2.8, 0.1)
    expect(
        "its half waves are as long as at first", last["half_wave_length"] < 1.2 * math.pi *
        (RIGIDITY * CLEARANCE / (WEIGHT * math.sin(math.radians(60))))**0.25)
    expect(
        "stable up to there and at the end",
        all(row["negative_pivots"] == 0 for row in found if row["branch"] == 0 and row is not last)
        and found[-1]["negative_pivots"] == 0)
    expect("shorter after the jumps", found[-1]["strain"] > last["strain"])
    on_the_wall("60 deg", "out_transition", found, 100.0, 60.0)


def vertical():
    """100 m between hinges, vertical: the least root of the beam E I u_ssss + (F(s) u_s)_s = 0, F =
    W - w (L - s), from a separate model of 200 elements; 1.98 (E I w^2)^(1/3) at the bit, not the
    2.55 of a long string (Wu and Juvkam-Wold 1992), whose ends are supported differently."""
    length, elements, unit = 100.0, 200, (RIGIDITY * WEIGHT**2)**(1 / 3)
    truth = hanging_beam(length, elements)
    _, said = run(deck("vertical", length, elements, 1.05 * truth))
    near("vertical: first negative pivot", said["limit"], truth, 1e-3)
    expect(f"vertical: {said['limit'] / unit:.3f} (E I w^2)^(1/3), below that of the long string",
           1.9 < said["limit"] / unit < 2.0)


def unloaded():
    """60 deg, 60 m: the pipe jumps into a helix at more than 2.8 times the first buckling load, and
    the helix remains as the weight decreases to sqrt(2) times that load (Chen, Lin and Cheatham
    1990). Each hinge lifts half a turn off the wall, so the helix opens at most a tenth earlier."""
    critical = 2 * math.sqrt(RIGIDITY * WEIGHT * math.sin(math.radians(60)) / CLEARANCE)
    found, _ = run(deck("unloaded", 60.0, 120, 4 * critical, inclination=60.0),
                   f"Buckling/Unload To={1.1 * critical} N")
    most = max(range(len(found)), key=lambda i: found[i]["weight_on_bit"])
    near("unloaded: the weight of the last state", found[-1]["weight_on_bit"], 1.1 * critical, 1e-8)
    near("unloaded: it turns at the last weight", found[most]["weight_on_bit"], 4 * critical, 1e-8)
    up = next(row for row in found if row["branch"] > 0)["weight_on_bit"] / critical
    expect(f"unloaded: it jumps at {up:.2f} of the first buckling under a growing weight", up > 2.8)
    way = found[most:]
    lost = [row["strain"] > 0.75 * row["helical_strain"] for row in way].index(False)
    near("unloaded: compression of the last helix over the first buckling",
         way[lost - 1]["compression"] / critical, math.sqrt(2), 0.1)
    expect("unloaded: it takes up less after that jump",
           way[lost]["strain"] < 0.65 * way[lost]["helical_strain"], way[lost])
    expect("unloaded: and is a sinusoid in the end",
           found[-1]["strain"] < 0.2 * found[-1]["helical_strain"])
    again, _ = run("unloaded.xml", f"Buckling/Unload To={1.1 * critical} N")
    expect("unloaded: the same command goes on from the last jump to the same table",
           again == found)
    done = tooljoint("buckling", "unloaded.xml", "--output", "out_refused", "--set",
                     f"Buckling/Unload To={5 * critical} N")
    expect("unloaded: a weight above the last one is refused", done.returncode == 2
           and "Give a smaller one" in done.stderr, done.stderr)


def followed():
    """The path through unstable states with its turning points; and two ranks."""
    file = deck("followed", 60.0, 120, 3.6e5, inclination=60.0)
    settings = ["--set", "Buckling/At A Limit=Follow", "--set", "Buckling/Max Steps=100"]
    for folder, ranks in (("out_followed", 1), ("out_ranks", 2)):
        done = tooljoint("buckling", file, "--output", folder, *settings, ranks=ranks)
        expect("a path that does not reach its end has the exit code 4", done.returncode == 4,
               done.returncode)
        expect("and says where it ended", "were computed up to" in done.stderr, done.stderr)
    one, two, said = rows("out_followed"), rows("out_ranks"), summary("out_followed")
    expect("unstable states are counted", said["unstable_from"] > 0
           and any(row["negative_pivots"] > 0 for row in one))
    expect("the path turns",
           any(b["weight_on_bit"] < a["weight_on_bit"] for a, b in zip(one, one[1:])))
    expect(
        "two ranks: the same path",
        len(one) == len(two) and all(
            abs(a[key] - b[key]) <= 1e-9 * max(abs(a[key]), 1e-3) for a, b in zip(one, two)
            for key in ("weight_on_bit", "bit_advance", "total_contact_force")))


def documented():
    """The table of docs/guide/buckling.md about xml/buckling_100m.xml agrees with the program."""
    root = pathlib.Path(__file__).resolve().parents[2]
    text = (root / "docs/guide/buckling.md").read_text(encoding="utf-8")
    section = text[text.index("`xml/buckling_100m.xml` is a 5 in drill pipe"):]
    section = section[:section.index("[validation.md]")]
    table = [
        line.split("|")[1:-1] for line in section.splitlines()
        if line.startswith("| ") and line[2].isdigit()
    ]
    states, _ = run(str(root / "xml/buckling_100m.xml"), folder="documented")
    expect("the document has six states", len(table) == 6, table)
    expect("and says how many there are", f"Of its {len(states)} states:"
           in " ".join(section.split()), len(states))
    columns = (
        ("weight_on_bit", 1e-3),
        ("bit_advance", 1e3),
        ("half_waves", 1),
        ("contact_force", 1),
        ("helical_contact_force", 1),
        ("strain", 1e6),
        ("helical_strain", 1e6),
    )
    for cells in table:
        shown = [cell.split(",")[0].strip() for cell in cells]
        state = min(
            states,
            key=lambda one, weight=float(shown[0]): abs(1e-3 * one["weight_on_bit"] - weight))
        for (key, scale), text in zip(columns, shown):
            bound = 1.5 * 10**-len(text.partition(".")[2])
            expect(f"docs/guide/buckling.md, {shown[0]} kN: {key} {text}",
                   abs(scale * (state[key] or 0.0) - float(text)) <= bound, state[key])
    slid(root / "xml/buckling_100m.xml",
         next(one for one in states if abs(one["weight_on_bit"] - 392.67e3) < 10))


def slid(file, state):
    """Almost without friction the stiff string of torque-drag slides to the state of the path, at
    2.6 times its first buckling load. The path has a crookedness of 2 % of the clearance; the stiff
    string has none."""
    settings = ("Contact/Friction/Static=1e-4", "Contact/Friction/Dynamic=1e-4",
                f"Loads/Weight On Bit={state['weight_on_bit']}", "Torque and Drag/Count=1",
                "Torque and Drag/Operations={Drill sliding}")
    done = tooljoint("torque-drag", str(file), "--output", "slid",
                     *[part for one in settings for part in ("--set", one)])
    expect(
        "torque-drag of a buckled pipe ends well", done.returncode == 0
        and "1 of 1 states of the stiff string are buckled" in " ".join(done.stdout.split()),
        done.stdout + done.stderr)
    with h5py.File("slid/torque_drag.h5") as file:
        contact = file["profile/Drill sliding/stiff/contact_force"][:]
    near("contact forces of the buckled stiff string", sum(contact), state["total_contact_force"],
         5e-3)


def refused(what, sentence, code, *arguments):
    done = tooljoint("buckling", *arguments)
    expect(f"{what} has the exit code {code}", done.returncode == code, done.returncode)
    expect(f"{what}: \"{sentence}\"", sentence in done.stderr, done.stderr)


def refusals():
    good = deck("good", 20.0, 20, 1e5)
    refused("no wall", "Add the list Contact", 2, deck("no_wall", 20.0, 20, 1e5, contact=False))
    held = deck("held", 20.0, 20, 1e5, bit="u v w")
    refused("a bit that is held", "cannot move the bit", 2, held)
    refused("no last weight", "the last weight on bit is not given", 2,
            deck("no_weight", 20.0, 20, 0))
    refused("steps the wrong way round", "has to lie between Smallest Step", 2, good, "--set",
            "Buckling/First Step=1")
    refused("a string without geometric stiffness", "buckling needs geometric stiffness", 2, good,
            "--set", "Static/Geometric Stiffness=false")
    refused("parts", "buckling needs a string in its well", 2, str(SOURCES / "xml/frame.xml"))
    refused("a path of two steps", "the number allowed", 4, good, "--output", "out_short", "--set",
            "Buckling/Max Steps=2")
    refused("steps that cannot be halved", "does not converge", 4, good, "--output",
            "out_long_steps", "--set", "Loads/Gravity=0", "--set", "Buckling/Smallest Step=0.01",
            "--set", "Buckling/At A Limit=Follow")
    expect("what was found is in the tables",
           len(rows("out_short")) > 1 and summary("out_short")["end"] == "steps")
    done = tooljoint("check", good)
    expect(
        "check says what would be done", done.returncode == 0
        and "buckling: up to 100 kN on the bit" in " ".join(done.stdout.split()),
        done.stdout + done.stderr)
    done = tooljoint("check", good, "--set", "Buckling/Unload To=20 kN")
    expect("and how far the weight falls", "up to 100 kN on the bit, back to 20 kN"
           in " ".join(done.stdout.split()), done.stdout + done.stderr)
    done = tooljoint("check", good, "--set", "Buckling/First Step=1")
    expect("and refuses what buckling would", done.returncode == 2
           and "has to lie between" in done.stderr, done.stderr)


def buckled_runs():
    """A rotating horizontal pipe, loaded beyond its buckling load: the stages of its static state
    do not converge, and it slides to an equilibrium. At a higher load friction drives it round the
    hole; the message of the run says so and gives a remedy."""
    survey = pathlib.Path("horizontal.csv").resolve()
    survey.write_text("MD [m], Inc [deg], Azi [deg]\n0, 90, 0\n2000, 90, 0\n", encoding="utf-8")
    pipe = ('<ParameterList name="pipe"><Parameter name="Length" type="double" value="100"/>'
            '<Parameter name="Elements" type="int" value="100"/><Parameter name="Outer Radius" '
            'type="double" value="0.0635"/><Parameter name="Inner Radius" type="double" '
            'value="0.0543"/></ParameterList>')
    text = (SOURCES / "xml/build_hold_1400m.xml").read_text(encoding="utf-8")
    pathlib.Path("hundred.xml").write_text(
        text.replace('<ParameterList name="Components">',
                     '<ParameterList name="Components">' + pipe), encoding="utf-8")
    folder = pathlib.Path("buckled run")

    def pushed(weight, *settings):
        words = [
            "run", "hundred.xml", "--without", "Reduction", "--without", "Substructures",
            "--output",
            str(folder)
        ]
        for setting in ("Well/Trajectory=Survey", f"Well/Survey/File={survey}",
                        "Drillstring/Assembly={pipe}", "Transient/End Time=0.002 s",
                        "Output/Report=false", f"Loads/Weight On Bit={weight} kN", *settings):
            words += ["--set", setting]
        shutil.rmtree(folder, ignore_errors=True)
        done = tooljoint(*words)
        return done, json.loads((folder / "summary.json").read_text(encoding="utf-8"))["static"]

    for weight, settings in ((220, ()), (350, ("Static/Friction=None",))):
        done, static = pushed(weight, *settings)
        expect(f"{weight} kN {settings}: a state of rest", done.returncode == 0
               and static["residual"] < 1e-8, done.stderr)
        near(f"{weight} kN {settings}: hook load", static["hook_load"], -1e3 * weight, 1e-6)
        expect(f"{weight} kN {settings}: torques balance",
               abs(static["torque_balance_defect"]) < 1e-3 * static["torque_scale"], static)
    done, _ = pushed(350)
    said = " ".join(done.stderr.split())
    expect(
        "350 kN: friction drives it round", done.returncode == 4
        and "friction drives it round the hole: there is no state of rest. " in said
        and said.endswith('Static/Friction "None" gives the state without friction.'), done.stderr)
    done, _ = pushed(350, "Static/Max Iterations=2")
    expect(
        "and may do so where the iterations end before", "It buckles while it turns and does not "
        "come to rest within 12 iterations. Friction may drive it round the hole; if it does not, "
        "raise Static/Max Iterations." in " ".join(done.stderr.split()), done.stderr)


euler()
helix()
horizontal()
curved()
transition()
vertical()
unloaded()
followed()
documented()
refusals()
buckled_runs()
sys.exit(finish())
