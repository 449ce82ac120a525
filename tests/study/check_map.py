#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Maps over a grid of parameters: check_map.py PROGRAM MPIEXEC DECK

DECK is xml/map_helical_170m.xml, here with half of its string, a short motion and a few points. A
value of a map equals that of a run with the overrides of its point, on any number of ranks; a
killed map can be continued; a failed point is a missing cell; a plan of commands gives the same
table.
"""
import csv
import json
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from checks import expect, finish, of_ranks, tooljoint  # noqa: E402
from screens import expect_screen  # noqa: E402

XML = pathlib.Path(sys.argv[3]).resolve()
DECK = "shorter.xml"
SHORT = [
    "--set", "Transient/End Time=0.06", "--set", "Map/Grid/speed/Count=2", "--set",
    "Map/Grid/weight on bit/Values={5 kN, 20 kN}", "--set", "Map/Pictures=false"
]
KEYS = {
    "stick-slip index": "transient.figures.stick_slip_index",
    "lateral acceleration": "transient.figures.lateral_acceleration.worst_rms",
    "backward whirl": "transient.figures.whirl.worst_backward_contact_share"
}
POINTS = [("60 rpm", "5 kN"), ("60 rpm", "20 kN"), ("180 rpm", "5 kN"), ("180 rpm", "20 kN")]


def table(folder):
    with open(pathlib.Path(folder, "map.csv"), newline="", encoding="utf-8") as text:
        return [{re.sub(r" \[.*\]", "", name): cell for name, cell in row.items()}
                for row in csv.DictReader(text)]


def values(folder):
    return np.array([[float(row[name] or "nan") for name in KEYS] for row in table(folder)])


def summary(folder):
    return json.loads(pathlib.Path(folder, "summary.json").read_text(encoding="utf-8"))


def known(done):
    match = re.search(r"(\d+) of (\d+) points are known", done.stdout)
    return int(match.group(1)) if match else 0


def number(folder, key):
    value = summary(folder)
    for step in key.split("."):
        value = value[step]
    return value


def shorter():
    """The deck with half of its pipes and collars."""
    text = XML.read_text(encoding="utf-8").replace('value="components/',
                                                   f'value="{XML.parent}/components/')
    half = "{pipe, last pipe, collar, stabiliser, 2*collar, stabiliser, collar, bit}"
    pathlib.Path(DECK).write_text(re.sub('("Assembly".*value=)"[^"]*"', f'\\1"{half}"', text),
                                  encoding="utf-8")


def against_runs():
    checked = tooljoint("check", DECK, *SHORT)
    expect("check says what a map will do", checked.returncode == 0
           and "4 points: speed (2) x weight on bit (2);" in checked.stdout, checked.stdout[-400:])
    done = tooljoint("map", DECK, "--output", "one", *SHORT)
    expect_screen(done, "one", "map")
    rows = table("one")
    expect("a map ends with 0 and has a row per point", done.returncode == 0 and len(rows) == 4,
           done.stderr[-400:])
    points = [(row["speed"], row["weight on bit"]) for row in rows]
    expect("the last axis varies first",
           points == [(speed, weight) for speed in ("60", "180") for weight in ("5", "20")], points)
    expect("the time per point is told", "s wall" in done.stdout
           and number("one", "map.wall_per_point_s") > 0)
    for i in (0, 3):
        speed, weight = POINTS[i]
        folder = f"run_{i}"
        run = tooljoint("run", DECK, "--output", folder, *SHORT[:2], "--set",
                        f"Rotary Speed/Exponential/Final Speed={speed}", "--set",
                        f"Loads/Weight On Bit={weight}")
        wanted = [number(folder, key) for key in KEYS.values()]
        expect(f"point {i + 1} is a run with its overrides", run.returncode == 0
               and list(values("one")[i]) == wanted, f"{values('one')[i]} {wanted}")
    expect("points differ", len({tuple(row) for row in values("one")}) == 4)
    with h5py.File("one/map.h5") as file:
        expect(
            "map.h5 holds the grid",
            np.array_equal(file["/values/lateral acceleration"][:].ravel(),
                           values("one")[:, 1])
            and file["/values/lateral acceleration"].shape == (2, 2)
            and list(file["/axes/speed"][:]) == [60, 180]
            and np.all(file["/known/lateral acceleration"][:] == 1))
    again = tooljoint("map", DECK, "--output", "one", *SHORT, "--set",
                      "Map/Values/lateral acceleration/Unsafe Above=0")
    expect(
        "known points are not computed again, other limits need none",
        known(again) == 4 and "; 4 of 4 points unsafe" in again.stdout
        and summary("one")["map"]["values"][1]["unsafe"] == 4, again.stdout[-600:])
    before = values("one")
    other = tooljoint("map", DECK, "--output", "one", *SHORT, "--set", "Output/Figures/Begin=0.02")
    expect("another window is another map",
           known(other) == 0 and np.all(values("one")[:, 1] != before[:, 1]))


def many_ranks():
    tooljoint("map", DECK, "--output", "np1", *SHORT)
    done = tooljoint("map", DECK, "--output", "np2_groups", *SHORT, "--ranks-per-row", "1", ranks=2)
    expect("two ranks with a point each give the same table", done.returncode == 0
           and np.array_equal(values("np1"), values("np2_groups")), done.stderr[-400:])
    more = [*SHORT[:3], "Map/Grid/speed/Count=3", *SHORT[4:]]
    done = tooljoint("map", DECK, "--output", "np2_groups", *more, "--ranks-per-row", "1", ranks=2)
    expect(
        "and go on with a finer grid", done.returncode == 0 and known(done) == 4
        and [row["status"] for row in table("np2_groups")] == ["done"] * 6
        and np.array_equal(values("np2_groups")[[0, 1, 4, 5]], values("np1")), done.stdout[-400:])
    done = tooljoint("map", DECK, "--output", "np2_together", *SHORT, ranks=2)
    difference = np.abs(values("np2_together") - values("np1")).max() / np.abs(values("np1")).max()
    expect("so do two ranks on every point", done.returncode == 0 and difference < 1e-8,
           f"({difference:.1e}) {done.stderr[-400:]}")


def killed():
    command = [sys.argv[1], "map", DECK, "--output", "killed", *SHORT]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                          env=of_ranks(1)) as process:
        for line in process.stdout:
            if line.startswith("point 2 of 4") or "point 2 of 4" in line:
                process.send_signal(signal.SIGKILL)
                break
        process.wait()
    time.sleep(0.1)
    done = tooljoint("map", DECK, "--output", "killed", *SHORT)
    expect("a map that was killed goes on", done.returncode == 0 and known(done) >= 2
           and "point 1 of 4" not in done.stdout, done.stdout[-400:])
    expect("and ends with the same table", np.array_equal(values("killed"), values("np1")))


def failures():
    steps = [
        "--set", "Map/Grid/weight on bit/Parameter=Static/Max Iterations", "--set",
        "Map/Grid/weight on bit/Values={200, 1}"
    ]
    done = tooljoint("map", DECK, "--output", "failed", *SHORT[:4], *SHORT[6:], *steps)
    rows = table("failed")
    expect(
        "a point that fails is a missing cell", done.returncode == 0
        and [row["status"] for row in rows] == ["done", "failed"] * 2
        and all(row["lateral acceleration"] == "" and row["reason"] for row in rows[1::2])
        and all(row["lateral acceleration"] for row in rows[::2]),
        f"({done.returncode}) {[row['status'] for row in rows]} {done.stderr[-300:]}")
    expect(
        "and is named with its reason", "Point 2 (" in done.stderr and "failed: " in done.stderr
        and "(1 further point likewise)" in done.stderr and summary("failed")["map"]["failed"] == 2,
        done.stderr[-300:])
    with h5py.File("failed/map.h5") as file:
        expect("map.h5 says what is known",
               file["/known/lateral acceleration"][:].ravel().tolist() == [1, 0, 1, 0])
    longer = ["--set", "Transient/End Time=0.3", *SHORT[2:]]
    limit = tooljoint("map", DECK, "--output", "limited", *longer, "--set", "Map/Time Limit=1e-4")
    expect("a point over its time limit is given up",
           summary("limited")["map"]["failed"] == 4, limit.stderr[-300:])
    expect(
        "a map without a point ends with 4 and the first reason", limit.returncode == 4
        and "No point of the map could be computed" in limit.stderr
        and "It was given up" in limit.stderr.split("No point of the map")[1]
        and [row["status"] for row in table("limited")] == ["failed"] * 4,
        f"({limit.returncode}) {limit.stderr[-400:]}")
    both = tooljoint("map", DECK, "--output", "limited_2", *longer, "--set", "Map/Time Limit=1e-4",
                     ranks=2)
    expect("on two ranks likewise", both.returncode == 4
           and "No point of the map could be computed" in both.stderr,
           f"({both.returncode}) {both.stderr[-400:]}")
    more = tooljoint("map", DECK, "--output", "limited", *longer)
    expect("and computed when the limit is gone", more.returncode == 0 and known(more) == 0
           and summary("limited")["map"]["done"] == 4)
    for what, arguments, sentence in [
        ("no list", ["--without", "Map"], "has no Map list"),
        ("no such row", ["--row", "5", "--output", "x"], "the map has the rows 1 to 4"),
    ]:
        refused = tooljoint("map", DECK, *SHORT, *arguments) if what != "no list" else tooljoint(
            "map", DECK, *arguments)
        expect(f"{what} is refused", refused.returncode in (1, 2) and sentence in refused.stderr,
               refused.stderr)


def refusals():
    """A refusal at every speed of the grid is printed once, with a count."""
    driller = {
        "Bit/Law": "Cutting", "Bit/Cutting/Radius": "0.1", "Bit/Cutting/Blades": "3",
        "Top Drive/Autodriller/Weight On Bit": "10 kN",
        "Top Drive/Autodriller/Proportional Gain": "1e-7",
        "Top Drive/Autodriller/Integral Gain": "1e-8", "Supports/Top": "u v theta_z",
        "Rotary Speed/Law": "Constant", "Rotary Speed/Constant/Speed": "60 rpm",
        "Contact/Friction/Axial": "true", "Map/Grid/speed/Parameter": "Rotary Speed/Constant/Speed",
        "Map/Grid/weight on bit/Parameter": "Top Drive/Autodriller/Weight On Bit",
        "Map/Grid/weight on bit/Values": "{50000 MN, 90000 MN}"
    }
    arguments = [word for name, value in driller.items() for word in ("--set", f"{name}={value}")]
    done = tooljoint("map", DECK, "--output", "refused", "--without", "Loads/Weight On Bit",
                     "--without", "Loads/Torque On Bit", *arguments)
    lines = [line for line in done.stderr.splitlines() if "is not reached" in line]
    expect(
        "a weight that no speed reaches is told once, with a count", done.returncode == 2
        and len(lines) == 2 and all("(3 further runs likewise)" in line for line in lines),
        f"({done.returncode}) {done.stderr[-900:]}")


def parts():
    """A map of imported parts whose axes are files and a text; a part without a model gives a
    missing cell."""
    root = pathlib.Path(__file__).resolve().parents[1] / "decks" / "parts"
    imported = "".join(f'<ParameterList name="{name}"><Parameter name="File" type="string" '
                       f'value="{root}/good"/></ParameterList>' for name in "ab")
    axes = ('<ParameterList name="part"><Parameter name="Parameter" type="string" '
            'value="Parts/Imported/a/File"/><Parameter name="Values" type="Array(string)" '
            f'value="{{{root}/good, {root}/indefinite_mass}}"/></ParameterList><ParameterList '
            'name="end"><Parameter name="Parameter" type="string" value="Transient/End Time"/>'
            '<Parameter name="Values" type="Array(string)" value="{0.1, 0.2}"/></ParameterList>')
    pathlib.Path("parts.xml").write_text(
        '<ParameterList name="parts"><ParameterList name="Parts"><ParameterList '
        f'name="Imported">{imported}</ParameterList><Parameter name="Joints" type="Array(string)" '
        'value="{a:right = b:left}"/><ParameterList name="Starts"><ParameterList name="pull">'
        '<Parameter name="Part" type="string" value="a"/><Parameter name="Node" type="int" '
        'value="1"/><Parameter name="Component" type="string" value="u"/><Parameter '
        'name="Velocity" type="double" value="1"/></ParameterList></ParameterList></ParameterList>'
        '<ParameterList name="Transient"><Parameter name="Integrator" type="string" '
        'value="Generalized-alpha"/><Parameter name="Step" type="double" value="1e-4"/><Parameter '
        'name="End Time" type="double" value="0.1"/></ParameterList><ParameterList name="Map">'
        f'<ParameterList name="Grid">{axes}</ParameterList><ParameterList name="Values">'
        '<ParameterList name="acceleration"><Parameter name="Key" type="string" '
        'value="transient.figures.acceleration.rms"/></ParameterList></ParameterList>'
        '</ParameterList></ParameterList>', encoding="utf-8")
    done = tooljoint("map", "parts.xml", "--output", "parts", "--set", "Map/Pictures=false")
    rows = table("parts") if done.returncode == 0 else []
    expect("a model that cannot be built is a missing cell",
           [row["status"] for row in rows] == ["done", "done", "failed", "failed"]
           and all("mass is indefinite" in row["reason"] and row["acceleration"] == ""
                   for row in rows[2:]), f"({done.returncode}) {done.stderr[-400:]}")
    expect("the others have their value", all(float(row["acceleration"]) > 0 for row in rows[:2]))


def planned():
    done = tooljoint("map", DECK, "--plan", "plan", *SHORT)
    commands = pathlib.Path("plan/rows.txt").read_text(encoding="utf-8").splitlines()
    expect("a plan has a command per point", done.returncode == 0 and len(commands) == 4,
           done.stderr[-300:])
    for command in commands[:3]:
        subprocess.run(command, shell=True, check=True, stdout=subprocess.DEVNULL, env=of_ranks(1))
    done = tooljoint("map", DECK, "--collect", "plan", *SHORT)
    expect("what is not there yet is named", done.returncode == 0 and "Point 4 (" in done.stderr
           and "is not there" in done.stderr, done.stderr[-300:])
    subprocess.run(commands[3], shell=True, check=True, stdout=subprocess.DEVNULL, env=of_ranks(1))
    tooljoint("map", DECK, "--collect", "plan", *SHORT)
    same = np.array_equal(values("plan"), values("np1"))
    expect("and the collected table is that of a map", same)


def pictures():
    drawn = ["map_stick_slip_index", "map_lateral_acceleration", "map_backward_whirl"]
    done = tooljoint("map", DECK, "--output", "np1", *SHORT[:-2])
    there = all(
        pathlib.Path("np1", f"{name}.{kind}").stat().st_size > 1000 for name in drawn
        for kind in ("png", "svg")) if "not drawn" not in done.stderr else False
    expect("every value has its picture", done.returncode == 0
           and (there or "needs python3 with" in done.stderr), done.stderr[-300:])


def inclined():
    """The map of the inclined string with a third of its pipes and a short motion: the steps are
    fine enough, and points of the reduced model are those of runs."""
    deck = str(XML.with_name("map_inclined_1000m.xml"))
    pipes = "{30*pipe, last pipe, 3*collar, stabiliser, 3*collar, stabiliser, 2*collar, bit}"
    short = [
        "--set", "Transient/End Time=0.2", "--set", f"Drillstring/Assembly={pipes}", "--set",
        "Map/Grid/speed/Count=2", "--set", "Map/Grid/weight on bit/Values={20 kN, 60 kN}", "--set",
        "Map/Pictures=false"
    ]
    done = tooljoint("map", deck, "--output", "inclined", *short)
    rows = table("inclined") if done.returncode == 0 else []
    expect("inclined string: four points", [row["status"] for row in rows] == ["done"] * 4,
           done.stderr[-400:])
    expect("inclined string: step errors below 5 %",
           all(0 < float(row["step error"]) < 0.05 for row in rows), rows)
    run = tooljoint("run", deck, "--output", "inclined_run", *short[:4], "--set",
                    "Rotary Speed/Exponential/Final Speed=180 rpm", "--set",
                    "Loads/Weight On Bit=60 kN", "--without", "Map")
    expect(
        "inclined string: the last point is a run with its overrides", run.returncode == 0
        and number("inclined_run", "transient.model") == "reduced"
        and float(rows[-1]["stick-slip index"]) == number(
            "inclined_run", "transient.figures.stick_slip_index"), run.stderr[-300:])


def unsettled():
    """A point with growing stick-slip is safe by its index; the map marks it as not settled."""
    deck = pathlib.Path(__file__).resolve().parent / "unsettled.xml"
    done = tooljoint("map", deck, "--output", "unsettled")
    growth = []
    for speed in ("60 rpm", "180 rpm"):
        ran = tooljoint("run", deck, "--output", "unsettled_run", "--set",
                        f"Rotary Speed/Constant/Speed={speed}")
        expect(f"{speed}: runs", ran.returncode == 0, ran.stderr)
        growth.append(number("unsettled_run", "transient.figures.bit_speed_growth")
                      or 0.0)  # null without vibration
    expect("under 45 klb the vibration grows at 60 rpm alone", growth[0] > 5 > growth[1], growth)
    found = summary("unsettled")["map"]["unsettled"]
    expect("the map counts that point", found == 1, found)
    said = " ".join(done.stderr.split())
    expect("and names it", "has not settled at 1 of 4 points (Speed 60 rpm, Weight On Bit 45 klb)"
           in said, said)
    before = summary("unsettled")["warnings"]
    expect("points warn", len(before) > 1, before)
    again = tooljoint("map", deck, "--output", "unsettled")
    expect("points known from before warn as they did",
           known(again) == 4 and sorted(summary("unsettled")["warnings"]) == sorted(before),
           f"{known(again)} {before} {summary('unsettled')['warnings']}")


def main():
    # points known from an earlier test would not be computed
    for folder in ("one", "np1", "np2_groups", "np2_together", "killed", "failed", "limited",
                   "limited_2", "parts", "plan", "inclined", "unsettled", "unsettled_run"):
        shutil.rmtree(folder, ignore_errors=True)
    shorter()
    against_runs()
    many_ranks()
    killed()
    failures()
    refusals()
    parts()
    planned()
    pictures()
    inclined()
    unsettled()
    return finish()


if __name__ == "__main__":
    sys.exit(main())
