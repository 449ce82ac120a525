#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Computes the maps of docs/guide/maps.md with the commands of that page and writes
docs/figures/map_*.svg.

    tools/maps.py --program build/release/tooljoint [--work results/maps] [--only
        map_helical_170m,map_inclined_1000m] [--figures DIR] [--set PATH=VALUE ...]

Points that are already in the work folder are not computed again. --set changes the maps, for a
quick look (a test).
"""
import argparse
import pathlib
import re
import shlex
import shutil
import subprocess

PROJECT = pathlib.Path(__file__).resolve().parent.parent
# deck of the map: value shown on the page
SHOWN = {"map_helical_170m": "lateral_acceleration", "map_inclined_1000m": "stick_slip_index"}


def settings(deck):
    """Options of the command on the page that computes the most points of a deck."""
    page = (PROJECT / "docs/guide/maps.md").read_text(encoding="utf-8").replace("\\\n", " ")
    commands = [
        shlex.split(line) for line in re.findall(rf"^tooljoint map xml/{deck}\.xml .*", page, re.M)
    ]
    words = next(words for words in commands if "--set" in words)
    return [
        part for option, value in zip(words, words[1:]) if option == "--set"
        for part in (option, value)
    ]


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True, type=pathlib.Path, help="the tooljoint program")
    parser.add_argument("--work", default="results/maps", type=pathlib.Path,
                        help="folder for the maps")
    parser.add_argument("--only", default=",".join(SHOWN), help="decks, separated by commas")
    parser.add_argument("--figures", default=PROJECT / "docs/figures", type=pathlib.Path,
                        help="folder of the pictures")
    parser.add_argument("--set", action="append", default=[], metavar="PATH=VALUE",
                        help="an override of the maps")
    options = parser.parse_args()
    for deck in options.only.split(","):
        folder = options.work / deck
        more = [part for one in options.set for part in ("--set", one)]
        subprocess.run([
            options.program, "map", PROJECT / f"xml/{deck}.xml", "--output", folder,
            *settings(deck), *more
        ], check=True)
        shutil.copyfile(folder / f"map_{SHOWN[deck]}.svg", options.figures / f"{deck}.svg")
        print(f"drawn {options.figures / deck}.svg", flush=True)


if __name__ == "__main__":
    main()
