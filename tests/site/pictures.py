#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of reports for the documents (target `docs-pictures`): pictures.py PROGRAM WORK FIGURES

Runs scenes and takes pictures of the tops of their reports, and of sections of reports of analyses,
in a headless Chromium. The key figures of the reports are written into reports.json beside the
pictures; tests compare their own runs with it.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

from PIL import Image

sys.path[:0] = [
    str(pathlib.Path(__file__).resolve().parents[1] / name) for name in ("report", "support")
]
from browser import Browser  # noqa: E402
from pictured import RECORD, figures_of  # noqa: E402

PROGRAM, WORK, FIGURES = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
XML = pathlib.Path(__file__).resolve().parents[2] / "xml"
TALL, WIDE = (900, 1100), (1280, 1130)  # pixels: readable on the page, and small
# Folder -> (command, deck beside the work folder or of the project)
SCENES = {
    "string": ("run", "first/first.xml"),
    "parts": ("run", "parts.xml"),
    "frame": ("run", XML / "frame.xml"),
    "stress": ("run", XML / "stress_170m.xml"),
    "bha_motor_1500m": ("bha", XML / "bha_motor_1500m.xml"),
}
# Picture -> (folder, size of the window, sections; None: the top of the page)
REPORTS = {
    "tutorial_report.png": ("string", TALL, None),
    "tutorial_parts.png": ("parts", TALL, None),
    "report_string.png": ("string", WIDE, None),
    "report_parts.png": ("frame", WIDE, None),
    "report_motion.png": ("stress", WIDE, "#orbits, #spectra"),
    "report_bha.png": ("bha_motor_1500m", WIDE, None),
}
# Picture drilling_NAME.png -> (section of a report with the plots, folder, command, deck,
# overrides)
FRICTIONS = "Torque and Drag/Broomstick={0.1, 0.2, 0.3, 0.4}"
SECTIONS = {
    "torque_drag": ("torque-drag", "extended_reach", "torque-drag",
                    XML / "extended_reach_5000m.xml",
                    [FRICTIONS, "Torque and Drag/Operations={Trip out, Trip in, Drill rotating}"]),
    "buckling": ("buckling", "buckling", "buckling", XML / "buckling_100m.xml", []),
    "bha": ("bha", "bha_motor_1500m", "bha", XML / "bha_motor_1500m.xml", []),
    "campbell": ("campbell", "campbell", "campbell", XML / "helical_170m.xml",
                 ["Campbell/Highest Speed=120 rpm", "Campbell/Points=5", "Campbell/Modes=8"]),
    "response": ("response", "response", "response", "response.xml", []),
    "stick_slip": ("motion", "stick_slip", "run", XML / "stick_slip_2500m.xml", []),
    "measured_log": ("measured", "measured", "run", "measured.xml", []),
}
COLOURS = 256
SCRIPTS = ("choose_a_basis", "frame_of_parts", "my_finite_elements", "string_from_survey_to_map"
           )  # examples/python, on docs/python-figures.md


def run(*arguments):
    subprocess.run([PROGRAM, *arguments], cwd=WORK, check=True, stdout=subprocess.DEVNULL,
                   env={**os.environ, "TOOLJOINT_REPORT": "off"})


def small(path):
    """The picture with a palette: half the size, and line colours remain distinct."""
    with Image.open(path) as shot:
        shot.convert("RGB").quantize(COLOURS).save(path, optimize=True)


def template(name, file):
    text = subprocess.run([PROGRAM, "template", name], check=True, stdout=subprocess.PIPE).stdout
    (WORK / file).write_bytes(text)


def with_response(scene, file):
    """The scene with the list Response of docs/guide/critical-speeds.md."""
    text = (FIGURES.parent / "guide/critical-speeds.md").read_text(encoding="utf-8")
    shown = next(block for block in re.findall(r"```xml\n(.*?)```", text, re.DOTALL)
                 if 'name="Response"' in block)
    head, end, _ = (XML / scene).read_text(encoding="utf-8").rpartition("</ParameterList>")
    (WORK / file).write_text((head + shown + end).replace('"components/', f'"{XML}/components/'),
                             encoding="utf-8")


def scripts():
    """The figures of the scripts of examples/python, with full settings."""
    folder = pathlib.Path(__file__).resolve().parents[2] / "examples/python"
    for name in SCRIPTS:
        subprocess.run([sys.executable, folder / f"{name}.py", "--output", WORK / "python"],
                       cwd=WORK, check=True, stdout=subprocess.DEVNULL,
                       env={**os.environ, "PYTHONPATH": str(PROGRAM.parent / "python")})
        picture = FIGURES / f"python_{name}.png"
        shutil.copyfile(WORK / f"python/{name}.png", picture)
        small(picture)
        print(f"{picture}: {picture.stat().st_size} bytes")


def with_log(scene, weight, file):
    """The scene with the bit speed of a rig: that of the same string, full model, under another
    weight on bit."""
    run("run", str(XML / scene), "--output", "rig", "--without", "Reduction", "--without",
        "Substructures", "--set", f"Loads/Weight On Bit={weight}")
    head, end, _ = (XML / scene).read_text(encoding="utf-8").rpartition("</ParameterList>")
    log = """<ParameterList name="Measured Log">
      <Parameter name="File" type="string" value="rig/motion.csv"/>
      <Parameter name="Begin" type="double" value="10"/>
      <ParameterList name="Columns"><ParameterList name="bit speed">
        <Parameter name="Column" type="string" value="bit_speed"/>
        <Parameter name="Quantity" type="string" value="Bit speed"/>
      </ParameterList></ParameterList></ParameterList>"""
    (WORK / file).write_text((head + log + end).replace('"components/', f'"{XML}/components/'),
                             encoding="utf-8")


def main():
    WORK.mkdir(parents=True, exist_ok=True)
    shutil.rmtree(WORK / "first", ignore_errors=True)
    run("new", "first")
    template("parts", "parts.xml")
    template("part", "bar.json")
    with_response("helical_170m.xml", "response.xml")
    with_log("stick_slip_2500m.xml", "85 kN", "measured.xml")
    for folder, (command, deck) in SCENES.items():
        run(command, str(deck), "--output", folder)
        run("report", folder)
    record = {}
    with Browser() as browser:
        for picture, (folder, size, sections) in REPORTS.items():
            page = WORK / folder / "report.html"
            browser.open(page, *size).picture(FIGURES / picture, element=sections)
            small(FIGURES / picture)
            command, deck = SCENES[folder]
            record[picture] = {
                "command": command,
                "deck": str(deck).replace(f"{XML.parent}/", ""),
                **figures_of(page.read_text(encoding="utf-8")),
            }
            print(f"{FIGURES / picture}: {(FIGURES / picture).stat().st_size} bytes")
        RECORD.write_text(json.dumps(record, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
        for name, (section, folder, command, deck, overrides) in SECTIONS.items():
            run(command, str(deck), "--output", folder, *[f"--set={one}" for one in overrides])
            run("report", folder)
            picture = FIGURES / f"drilling_{name}.png"
            browser.open(WORK / folder / "report.html",
                         *WIDE).picture(picture, element=f"#{section} .plots")
            small(picture)
            print(f"{picture}: {picture.stat().st_size} bytes")


if __name__ == "__main__":
    main()
    scripts()
