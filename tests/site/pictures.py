#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of the tutorials (target `docs-pictures`): pictures.py PROGRAM WORK FIGURES

Runs the decks of the tutorials and photographs their reports in a headless Chromium.
"""
import os
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "report"))
from browser import Browser  # noqa: E402

PROGRAM, WORK, FIGURES = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
WIDTH, HEIGHT = 900, 1100  # pixels: readable on the page, and small


def run(*arguments):
    subprocess.run([PROGRAM, *arguments], cwd=WORK, check=True, stdout=subprocess.DEVNULL, env={**os.environ, "TOOLJOINT_REPORT": "off"})


def template(name, file):
    text = subprocess.run([PROGRAM, "template", name], check=True, stdout=subprocess.PIPE).stdout
    (WORK / file).write_bytes(text)


def main():
    WORK.mkdir(parents=True, exist_ok=True)
    if not (WORK / "first").exists():
        run("new", "first")
    run("run", "first/first.xml", "--output", "string")
    template("parts", "parts.xml")
    template("part", "bar.json")
    run("run", "parts.xml", "--output", "parts")
    with Browser() as browser:
        for folder, picture in (("string", "tutorial_report.png"), ("parts", "tutorial_parts.png")):
            run("report", folder)
            browser.open(WORK / folder / "report.html", WIDTH, HEIGHT).picture(FIGURES / picture)
            print(f"{FIGURES / picture}: {(FIGURES / picture).stat().st_size} bytes")


if __name__ == "__main__":
    main()
