#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reports of runs, studies, maps and tables, opened in a browser.

    check_report.py PROGRAM MPIEXEC pages|folders

Each page has its figures, causes no error on the console, needs no network, fits into 400 px, is
below 5 MB, and its 3-D view is drawn and moves with its slider. Its numbers are those of the
results. Folders without usable results give a message and exit code 5. "pages" are those of a
string, of parts, of a study, of a map and of each analysis; without Chromium they are only read.
"folders" are those of runs with fewer outputs, of failed, interrupted and damaged runs, and the
report at the end of a run.
"""
import contextlib
import csv
import json
import math
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time

import h5py
import numpy as np

import browser

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from checks import TIME_FACTOR, expect, finish, tooljoint  # noqa: E402
from opened import look  # noqa: E402
from pictured import compare  # noqa: E402
from written import (FRAME, MAP, ROOT, RUN, SECONDS, STRESS, STRING, STUDY, WITHOUT_MOTION, figures,
                     near, numbers, page, run, scene_of)  # noqa: E402
from analyses import analyses, card  # noqa: E402


def string_numbers(folder, text):
    """The view agrees with the results: positions, frames, displacements, fields; the headline
    figures agree with the summary."""
    scene = scene_of(text)
    summary = json.loads(pathlib.Path(folder, "summary.json").read_text(encoding="utf-8"))
    with h5py.File(pathlib.Path(folder, "results.h5")) as file:
        data = {
            name: file[name][:]
            for name in ("/model/position", "/model/frame", "/model/s", "/static/displacement",
                         "/static/normal_force", "/transient/displacement", "/transient/time",
                         "/model/clearance")
        }
    north, east, down = data["/model/position"].T
    near("string: nodes stand east, up, south", numbers(scene["position"]),
         np.stack([east, -down, -north], 1), 1e-4)
    frame = numbers(scene["frames"])  # node, axis, component
    near("string: frames are turned likewise", frame[:, :, 1], -data["/model/frame"][:, 2, :], 1e-6)
    expect("string: frames stay right-handed", np.all(np.linalg.det(frame) > 0.999))
    # 0.109 m to 10 m, 0.108 m below; a node at the boundary touches the narrower one
    near("string: the bore", numbers(scene["bore"]), np.where(data["/model/s"] < 10, 0.109, 0.108),
         1e-7)
    near("string: what touches",
         numbers(scene["bore"]) - numbers(scene["radius"]), data["/model/clearance"], 1e-7)
    at = np.searchsorted(data["/transient/time"], numbers(scene["time"]) - 1e-4)
    moved = data["/transient/displacement"][at][:, :, :3]
    near("string: displacements of the samples that are shown", numbers(scene["motion"]), moved,
         0.51 * np.abs(moved).max() / 32767)
    fields = {field["name"]: field for field in scene["fields"]}
    near("string: contact forces at rest", numbers(fields["force"]["rest"]),
         data["/static/normal_force"] / 1e3, 1e-3)
    expect("string: stresses are those of bending in an arc of 150 m, at least",
           numbers(fields["stress"]["rest"]).max() > 206e3 * 0.0635 / 150)
    for what, value in (
        ("hook load", f"{summary['static']['hook_load'] / 1e3:.1f} kN"),
        ("surface torque", f"{summary['static']['surface_torque'] / 1e3:.2f} kN m"),
        ("side force", f"{summary['static']['max_normal_force'] / 1e3:.2f} kN"),
        ("bit speed", f"{summary['transient']['bit_speed_rpm']['mean']:.1f} rpm"),
    ):
        expect(f"string: the {what} is that of the summary", f'<div class="value">{value}</div>'
               in text, value)
    node = summary["static"]["max_normal_force_node"]
    names = "pipe" if data["/model/s"][node - 1] <= 18 else "collar" if data["/model/s"][
        node - 1] <= 42 else "bit"
    place = (f"at {data['/model/s'][node - 1]:.1f} m ({data['/model/s'][node - 1] / 0.3048:.0f} "
             f"ft), {names}")
    expect("string: the largest side force has its depth and component", place in text, place)


def strings(chromium):
    """Runs of a string: 20 s of motion with the tables of other commands in the same folder, and at
    rest."""
    run("string", STRING, "--set", "Transient/End Time=20", "--set",
        "Transient/Sampling Interval=0.005", "--set", "Torque and Drag/Depths={40, 42}", "--set",
        "Torque and Drag/After Run=true")
    tooljoint("modes", STRING, "--output", "string", "--count", "6")
    path, text = page("string", "string",
                      RUN | {"hook-load", "surface-torque", "buckling-1", "mode-errors"})
    string_numbers("string", text)
    expect("string: the static torque has the sign of the surface torque",
           "Static torque, positive against the rotation." in text)
    expect("string: with torque and drag it names no command for it", "tooljoint torque-drag"
           not in text)
    expect("string: the deck has its overrides",
           re.search(r"<td[^>]*>End Time</td><td>20</td>", text) is not None)
    if chromium:
        look("string", path, chromium)
    run("rest", STRESS, "--without", "Transient")
    path, text = page("string at rest", "rest", WITHOUT_MOTION)
    expect("string at rest: no motion is made up", "orbit-1" not in figures(text)
           and "time" not in scene_of(text))
    compare("report_motion.png", text, motion=False)
    command = f"tooljoint torque-drag {STRESS} --output rest --without Transient"
    expect("string at rest: it says what adds torque and drag", f"<code>{command}</code>" in text,
           re.findall("tooljoint torque-drag.{60}", text))
    if chromium:
        look("string at rest", path, chromium, moves=False)


def lesser_strings():
    """Runs without optional contents of a deck; other tests damage "full"."""
    for name, arguments in {
            "bare": ["--set", "Output/Fields={}"],
            "free": ["--without", "Contact", "--without", "Mud"],
            "full": ["--without", "Reduction", "--without", "Substructures"],
    }.items():
        run(name, STRING, *arguments)
        text = page(f"string, {name}", name, WITHOUT_MOTION - {"side"})[1]
        merits = json.loads(pathlib.Path(
            name, "summary.json").read_text(encoding="utf-8"))["transient"]["figures"]
        row = ("<th>Lateral acceleration</th>"
               f"<td>{merits['lateral_acceleration']['worst_rms']:.3g} m/s2 rms</td>")
        expect(
            f"string, {name}: figures of the summary, with their time", row in text
            and f"<caption>Figures of {merits['begin']:g} to {merits['end']:g} s (" in text, row)
    run("measured", str(ROOT / "tests/effects/log.xml"))
    text = page("string with a measured log", "measured",
                {f"measured-{kind}{number}" for kind in ("", "spectrum-") for number in (1, 2)})[1]
    expect("string with a measured log: differences stand above the figures",
           "Computed less measured over the common window" in text)


def old_results():
    """Results without contents that other programs may omit: the report shows the others."""
    for gone in (
        [
            "/model/young_modulus", "/model/component_names", "/model/outer_radius",
            "/transient/normal_force", "/transient/motion"
        ],
        ["/transient"],
    ):
        shutil.rmtree("old", ignore_errors=True)
        shutil.copytree("full", "old")
        with h5py.File("old/results.h5", "r+") as file:
            for name in gone:
                del file[name]
        page(f"results without {gone[-1]}", "old", {"section", "axial"})


def parts(chromium):
    run("parts", FRAME)
    path, text = page("parts", "parts", {"nodes-1", "mover-1", "spectrum-m"})
    compare("report_parts.png", text)
    scene = scene_of(text)
    links, position = numbers(scene["links"]).astype(int), numbers(scene["position"])
    lengths = np.linalg.norm(position[links[:, 0]] - position[links[:, 1]], axis=1)
    known = {0.375, 0.5}  # of the arm, of beams and columns
    expect("parts: edges have the lengths of their parts",
           set(lengths.round(4)) == known, sorted(set(lengths.round(4))))
    expect("parts: no node stands alone, not even a held one",
           len(np.unique(links)) == len(position), len(np.unique(links)))
    expect("parts: the loop of the frame closes",
           len(position) == len(np.unique(position.round(4), axis=0)))
    if chromium:
        look("parts", path, chromium)
    run("resting parts", FRAME, "--without", "Transient")
    page("parts at rest", "resting parts", set())


def studies(chromium):
    shutil.rmtree("study", ignore_errors=True)
    done = tooljoint("study", STUDY, "--output", "study", "--set", "Study/Repeats=1", "--set",
                     "Study/Pictures=false")
    expect("the study succeeds", done.returncode == 0, done.stderr[-300:])
    path, text = page(
        "study", "study", {
            "study-speed", "study-modes", "study-error-over-time", "study-bit-speed",
            "study-static", "study-reference"
        }, 3 * SECONDS)
    expect(
        "study: every run has its row",
        all(row["label"] in text
            for row in json.loads(pathlib.Path("study/summary.json").read_text(
                encoding="utf-8"))["study"]))
    if chromium:
        look("study", path, chromium, view=False)


def map_numbers(text):
    """The extremes, the safe points, the unsafe ones and the failed ones are those of map.csv."""
    with open("map/map.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    done = [row for row in rows if row["status"] == "done"]
    expect("map: half of the points fail", len(rows) == 18 and len(done) == 9, len(done))
    for name, unit, limit, words in (
        ("stick-slip index", "", 0.5, ("best", "worst")),
        ("lateral acceleration", " m/s2", 6.5, ("best", "worst")),
        ("backward whirl", "", math.inf, ("least", "largest")),
    ):
        for word, pick in zip(words, (min, max)):
            row = pick(done, key=lambda row, name=name: float(row[name]))
            bad = " bad" if float(row[name]) > limit else ""
            card = (f'<div class="card{bad}"><div class="name">{name}, {word}</div><div '
                    f'class="value">{float(row[name]):.4g}{unit}</div><div class="field">speed '
                    f'{row["speed [rpm]"]} rpm, weight on bit {row["weight on bit [kN]"]} kN, '
                    f'iterations {row["iterations"]}</div>')
            expect(f"map: {name}, {word}", card in text, card)
    safe = sum(
        float(row["stick-slip index"]) <= 0.5 and float(row["lateral acceleration"]) <= 6.5
        for row in done)
    expect(
        "map: points that are safe, and points that are not",
        f'<div class="value">{safe}</div><div class="field">of 18</div>' in text and 0 < safe < 9,
        safe)
    expect(
        "map: every point has its row",
        all(f'<tr><td class="number">{row["point"]}</td><td '
            f'class="number">{row["speed [rpm]"]}</td>' in text for row in rows))
    lost = [row for row in rows if row["status"] == "failed"]
    expect(
        "map: failed points have their reason in the table",
        text.count("<td>failed</td>") == len(lost) ==
        text.count("</td><td>The static equilibrium did not converge"))
    expect(
        "map: the warnings name the first and count the others",
        f"Point {lost[0]['point']} (" in text
        and f"({len(lost) - 1} further points likewise)" in text, len(lost))
    expect(
        "map: the unsafe region is hatched, with the limit",
        text.count("url(#map-stick-slip-index-1-h") >= 2 and ">unsafe</text>" in text
        and "stroke: #d55e00; stroke-width: 1.8" in text)
    expect("map: the title leaves out what varies", "mud 1200 kg/m3" in text
           and "WOB 10 kN" not in text)


def maps(chromium):
    """A map with a third axis, at whose second point runs fail; tables sorted by a click; an
    unfinished map."""
    shutil.rmtree("map", ignore_errors=True)
    third = ('<ParameterList name="iterations"><Parameter name="Parameter" type="string" '
             'value="Static/Max Iterations"/><Parameter name="Values" type="Array(string)" '
             'value="{200, 1}"/></ParameterList>')
    scene = pathlib.Path(MAP).read_text(encoding="utf-8").replace(
        '"components/', f'"{pathlib.Path(MAP).parent}/components/')
    pathlib.Path("map.xml").write_text(
        re.sub(r'</ParameterList>\s*<ParameterList name="Values">', third + r"\g<0>", scene),
        encoding="utf-8")
    done = tooljoint("map", "map.xml", "--output", "map", "--set", "Transient/End Time=0.06",
                     "--set", "Map/Grid/speed/Count=3", "--set", "Map/Pictures=false")
    expect("the map succeeds", done.returncode == 0, done.stderr[-300:])
    path, text = page(
        "map", "map", {
            f"map-{name}-{point}"
            for name in ("stick-slip-index", "lateral-acceleration", "backward-whirl")
            for point in (1, 2)
        })
    map_numbers(text)
    if chromium:
        look("map", path, chromium, view=False)
        column = ('[...document.querySelectorAll("table.sortable tbody tr")].map((row) => '
                  'parseFloat(row.cells[4].textContent))')
        click = 'document.querySelectorAll("table.sortable th button")[4].click()'
        for order in ("up", "down"):
            chromium.value(click)
            shown = chromium.value(column)
            expect(f"map: a click sorts the points {order}, those without a value last",
                   shown == sorted(shown[:9], reverse=order == "down") + 9 * [None], shown)
    for what, text in (
        ("a map that has not ended", '{"status": "interrupted", "map": {"axes": null}}'),
        ("a map with the summary of a run", '{"status": "finished"}'),
    ):
        pathlib.Path("map/summary.json").write_text(text, encoding="utf-8")
        refuse(what, "map", "map/summary.json is not that of a map that has ended")


def end_of_run():
    """A run writes its report unless told not to, and does not fail without python3."""
    os.environ.pop("TOOLJOINT_REPORT")
    path = pathlib.Path("ended/report.html")
    done = run("ended", STRING)
    expect("a run ends with a report",
           path.is_file() and "report      ended/report.html" in done.stdout, done.stdout[-300:])
    done = tooljoint("run", STRING, "--output", "ended", "--set", "Output/Report=false")
    expect("told not to, it leaves none, and takes that of the run before away",
           done.returncode == 0 and not path.exists())
    for command, deck, settings in (
        ("torque-drag", STRING, ("Torque and Drag/Depths={40}",)),
        ("map", str(ROOT / "tests/study/map.xml"), ("Map/Pictures=false",)),
        ("study", STUDY, ("Study/End Time=0.06", "Study/Window=0.03", "Study/Repeats=1")),
    ):
        done = tooljoint(command, deck, "--output", f"ended_{command}",
                         *[part for one in settings for part in ("--set", one)])
        expect(f"{command} ends with a report", done.returncode == 0
               and pathlib.Path(f"ended_{command}/report.html").is_file(), done.stderr)
    os.environ["PYTHONHOME"] = "/nowhere"  # no python3 starts
    done = tooljoint("run", STRING, "--output", "ended")
    line = [text for text in done.stderr.splitlines() if "The report was not written" in text]
    expect(
        "without python3 a run succeeds and says in a line how to write it later",
        done.returncode == 0 and len(line) == 1 and "tooljoint report ended" in line[0]
        and not path.exists(), f"({done.returncode}) {done.stderr[-300:]}")
    refuse("report without python3", "ended", "python3 with h5py, numpy and matplotlib")
    del os.environ["PYTHONHOME"]
    os.environ["TOOLJOINT_REPORT"] = "off"
    run("ended", STRING)
    expect("TOOLJOINT_REPORT=off: no report", not path.exists())
    done = tooljoint("report", "full", "--output", "two.html", ranks=2)
    expect(
        "two ranks write one report", done.returncode == 0 and pathlib.Path("two.html").is_file()
        and done.stdout.count("report  ") == 1, done.stderr)
    done = tooljoint("report", "nowhere", ranks=2)
    expect("and end alike", done.returncode == 5 and done.stderr.count("is no folder") == 1,
           f"({done.returncode}) {done.stderr}")


def refuse(what, folder, sentence, *arguments):
    done = tooljoint("report", folder, *arguments)
    expect(
        f"{what}: exit code 5 and a sentence", done.returncode == 5
        and done.stderr.count(sentence) == 1 and "Traceback" not in done.stderr
        and len(done.stderr.splitlines()) == 1, f"({done.returncode}) {done.stderr}")


def refusals():
    shutil.rmtree("damaged", ignore_errors=True)
    shutil.copytree("full", "damaged")
    whole = pathlib.Path("damaged/results.h5").read_bytes()
    refuse("no folder", "nowhere", "\"nowhere\" is no folder")
    pathlib.Path("empty").mkdir(exist_ok=True)
    refuse("a folder without results", "empty", "empty holds no results.h5")
    for what, content in (
        ("half a file", whole[:len(whole) // 2]),
        ("another file", b"<html>" * 100),
        ("an empty file", b""),
    ):
        pathlib.Path("damaged/results.h5").write_bytes(content)
        refuse(what, "damaged", "damaged/results.h5 cannot be read")
    pathlib.Path("damaged/results.h5").write_bytes(whole)
    with h5py.File("damaged/results.h5", "r+") as file:
        del file["/model/frame"]
    refuse("a dataset that is missing", "damaged", "has no /model/frame")
    pathlib.Path("damaged/results.h5").write_bytes(whole)
    for what, text in (("half a summary", '{"status": "fini'), ("another summary", "[1, 2]")):
        pathlib.Path("damaged/summary.json").write_text(text, encoding="utf-8")
        refuse(what, "damaged", "damaged/summary.json")
    pathlib.Path("damaged/summary.json").unlink()
    refuse("no summary", "damaged", "damaged/summary.json cannot be read")
    pathlib.Path("damaged/results.h5").rename("damaged/results.h5.part")
    refuse("a run that has not ended", "damaged", "results of a run that has not ended")
    refuse("a file that cannot be written", "full", "cannot be written", "--output",
           "nowhere/page.html")
    done = tooljoint("report")
    expect("no folder named: exit code 1", done.returncode == 1 and "DIR" in done.stderr,
           done.stderr)


def failed():
    """Runs that did not converge, before and after the state at rest: a page of the existing
    results that begins with the reason."""
    for folder, setting, wanted, reason in (
        ("no motion", "Transient/Step=0.1", WITHOUT_MOTION, "The time step (0.1 s) is too large"),
        ("no rest", "Static/Max Iterations=1", set(), "The static equilibrium did not converge"),
    ):
        shutil.rmtree(folder, ignore_errors=True)
        done = tooljoint("run", STRING, "--output", folder, "--set", "Transient/End Time=5",
                         "--set", setting)
        expect(f"{folder}: the run fails", done.returncode == 4,
               f"({done.returncode}) {done.stderr[-300:]}")
        _, text = page(folder, folder, wanted)
        expect(f"{folder}: the page says so first",
               f'<ul class="notes"><li>The run failed: {reason}' in text)


def interrupted():
    """The results of an interrupted run are reported, with a note on top."""
    shutil.rmtree("interrupted", ignore_errors=True)
    process = subprocess.Popen(
        [sys.argv[1], "run", STRING, "--output", "interrupted", "--set", "Transient/End Time=2000"],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    until = time.monotonic() + 60 * TIME_FACTOR
    while not pathlib.Path("interrupted/checkpoint.bin").exists() and time.monotonic() < until:
        time.sleep(0.1)
    process.send_signal(signal.SIGTERM)
    expect("the run is interrupted", process.wait(timeout=60 * TIME_FACTOR) == 130)
    _, text = page("an interrupted run", "interrupted", WITHOUT_MOTION)
    expect(
        "an interrupted run: the page says so first",
        re.search(r'<ul class="notes"><li>The run was interrupted: Interrupted at [0-9.]+ s', text)
        is not None)


def pages():
    if browser.program() is None:
        print("Chromium is not installed: the pages are read, not opened.")
        chromium = contextlib.nullcontext()
    else:
        chromium = browser.Browser(120 * TIME_FACTOR)
    with chromium as opened:
        for part in (strings, parts, studies, maps, analyses):
            part(opened)


def main():
    os.environ["TOOLJOINT_REPORT"] = "off"
    for part in [pages] if sys.argv[3] == "pages" else [
            lesser_strings, old_results, end_of_run, refusals, failed, interrupted
    ]:
        part()
    return finish()


if __name__ == "__main__":
    sys.exit(main())
