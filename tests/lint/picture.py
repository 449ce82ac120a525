#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws docs/figures/architecture.svg: the folders of rooms.py, each above the folders it includes.

    picture.py PROJECT              exit code 1 if the picture is old
    picture.py PROJECT --update     draws it
"""
import pathlib
import sys
import textwrap
from xml.sax.saxutils import escape

import rooms

# pixels: width of a side, margin, gap between boxes, height of a row, of a heading
WIDTH, MARGIN, GAP, ROW, HEAD = 640, 20, 8, 62, 34
LINE, TEXT = 12, 5.2  # height of a line of small text, width of a letter
SIDES = (
    ("src/", "component mode synthesis, independent of drillstrings", "#dbe9f6", "#3b6694"),
    ("substructures/", "the parts of a drillstring", "#dcf0d8", "#4a7a43"),
    ("python/ and tools/", "the library in Python, plots and reports", "#f6e3cf", "#9a6a33"),
)
# Python has no table of includes: each row is above the rows it imports.
PYTHON = [
    [
        ("tools/report", "report.html of a results folder"),
        ("tools/paraview", "results as polydata"),
        ("tools/*.py", "plots and benchmark documents"),
    ],
    [
        ("python/tooljoint", "parts, decks, results, arguments as deck lists"),
        ("python/tooljoint/plots", "the style of all figures; needs no compiled module"),
    ],
    [("python/core", "the library in Python, a file for each concept")],
]


def layers(includes):
    """Rows of folders from the top, each above all folders it includes."""
    def height(room):
        return 1 + max((height(each) for each in includes[room]), default=-1)

    heights = {room: height(room) for room in includes}
    return [[room for room in includes if heights[room] == level]
            for level in sorted(set(heights.values()), reverse=True)]


def box(x, y, width, name, words, fill, edge):
    lines = textwrap.wrap(words, int((width - 12) / TEXT))
    text = (f'<rect x="{x:g}" y="{y:g}" width="{width:g}" height="{ROW - GAP}" rx="4" '
            f'fill="{fill}" stroke="{edge}"/>\n')
    text += (f'<text x="{x + 7:g}" y="{y + 15:g}" font-size="12" '
             f'font-weight="bold">{escape(name)}</text>\n')
    return text + "".join(f'<text x="{x + 7:g}" y="{y + 15 + LINE * (i + 1):g}" '
                          f'font-size="9.5">{escape(line)}</text>\n'
                          for i, line in enumerate(lines[:3]))


def side(x, y, rows, title):
    """A heading and rows of (name, words)."""
    folder, words, fill, edge = title
    text = (f'<text x="{x}" y="{y + 20}" font-size="13" font-style="italic">{escape(folder)} '
            f'{escape(words)}</text>\n')
    for number, row in enumerate(rows):
        width = (WIDTH - GAP * (len(row) - 1)) / len(row)
        text += "".join(
            box(x + i * (width + GAP), y + HEAD + number * ROW, width, name, what, fill, edge)
            for i, (name, what) in enumerate(row))
    return text


def picture():
    toolkit = layers({room: includes.split() for room, (includes, _) in rooms.TOOLKIT.items()})
    string = layers(
        {room: includes.split() for room, (includes, _, _) in rooms.DRILLSTRING.items()})
    left = [[(f"{room}", rooms.TOOLKIT[room][-1]) for room in row] for row in toolkit]
    right = [[(f"{room}", rooms.DRILLSTRING[room][-1]) for room in row] for row in string]
    height = 2 * MARGIN + HEAD + ROW * len(left)
    other = 2 * MARGIN + WIDTH + 30
    top = MARGIN + HEAD + ROW * len(PYTHON) + 14
    height = max(height, top + HEAD + ROW * len(right) + MARGIN)
    text = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {other + WIDTH + MARGIN} '
            f'{height}" font-family="DejaVu Sans, Verdana, sans-serif" fill="#222222">\n')
    text += ('<title>Folders of the source tree, each above the folders it includes</title>\n'
             '<rect width="100%" height="100%" fill="white"/>\n')
    return text + side(MARGIN, MARGIN, left, SIDES[0]) + side(
        other, MARGIN, PYTHON, SIDES[2]) + side(other, top, right, SIDES[1]) + "</svg>\n"


def main():
    path = pathlib.Path(sys.argv[1]) / "docs/figures/architecture.svg"
    if "--update" in sys.argv:
        path.write_text(picture(), encoding="utf-8")
        return 0
    if path.read_text(encoding="utf-8") == picture():
        return 0
    print(f"{path} is old: run tests/lint/picture.py {sys.argv[1]} --update")
    return 1


if __name__ == "__main__":
    sys.exit(main())
