#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reports of folders with a damaged file: check_damage.py PROGRAM

If one of several files is damaged, the report shows the others and begins with a note on it; the
exit code is 5. A full disk is reported as such, and no file is left.
"""
import html
import pathlib
import re
import shutil
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))
from checks import expect, finish, tooljoint  # noqa: E402

DECK = str(ROOT / "tests/effects/scene.xml")
FOLDER, PAGE = pathlib.Path("several"), pathlib.Path("several/report.html")


def words(text):
    """The first row has words for numbers."""
    head, first, rest = text.split(b"\n", 2)
    return b"\n".join((head, b",".join(b"fast" for _ in first.split(b",")), rest))


# file, damage, message, a figure removed by it, one that stays
DAMAGES = (
    ("modes.csv", lambda text: text[:-30], "row 5 has ", "modes-frequencies",
     "damped-modes-frequencies"),
    ("modes.csv", words, 'has "fast" in the column "full [Hz]", expected is a number',
     "modes-frequencies", "hook-load"),
    ("modes.csv", lambda text: b"<html>\n" * 9, 'it has no column "mode"', "modes-frequencies",
     "hook-load"),
    ("modes.csv", lambda text: bytes(range(256)), "it is damaged", "modes-frequencies",
     "hook-load"),
    ("modes.h5", lambda text: text[:len(text) // 2], "it is damaged", "mode-shapes",
     "modes-frequencies"),
    ("torque_drag_profile.csv", lambda text: b"", "it is empty", "buckling-1", "hook-load"),
    ("torque_drag.csv", lambda text: text[:400] + bytes(9) + text[400:], "it holds bytes of zero",
     "hook-load", "modes-frequencies"),
)


def damaged(name, damage, said, gone, kept):
    path = FOLDER / name
    whole = path.read_bytes()
    path.write_bytes(damage(whole))
    PAGE.unlink(missing_ok=True)
    done = tooljoint("report", str(FOLDER))
    path.write_bytes(whole)
    text = PAGE.read_text(encoding="utf-8") if PAGE.is_file() else ""
    figures = set(re.findall(r'<figure id="([^"]+)"', text))
    sentence = f"{path} cannot be read: "
    expect(
        f"{name}, {said}: exit code 5 and a sentence", done.returncode == 5
        and sentence in done.stderr and said in done.stderr and "Error" not in done.stderr,
        f"({done.returncode}) {done.stderr}")
    expect(f"{name}, {said}: the report says so first", f'<ul class="notes"><li>{sentence}' in text
           and said in html.unescape(text))
    expect(f"{name}, {said}: the report has the others", kept in figures and gone not in figures
           and {"section", "axial", "torque"} <= figures, sorted(figures))


shutil.rmtree(FOLDER, ignore_errors=True)
for command, *more in (
    ("run", "--without", "Transient"),
    ("torque-drag", "--set", "Torque and Drag/Depths={40, 42}"),
    ("modes", "--count", "4"),
):
    made = tooljoint(command, DECK, "--output", str(FOLDER), *more)
    expect(f"{command} succeeds", made.returncode == 0, made.stderr[-300:])
for one in DAMAGES:
    damaged(*one)
made = tooljoint("report", str(FOLDER))
expect("whole files: nothing is said", made.returncode == 0 and not made.stderr, made.stderr)
before = PAGE.read_bytes()
part = pathlib.Path(f"{PAGE}.part")
part.symlink_to("/dev/full")
made = tooljoint("report", str(FOLDER))
expect("a full disk: exit code 5 and a sentence", made.returncode == 5
       and f"{PAGE} cannot be written: the disk is full." in made.stderr,
       f"({made.returncode}) {made.stderr}")
expect("a full disk: nothing is left, and the report is that of before", not part.is_symlink()
       and PAGE.read_bytes() == before)
sys.exit(finish())
