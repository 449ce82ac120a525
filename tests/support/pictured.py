# SPDX-License-Identifier: BSD-3-Clause
"""Compares the key figures in pictures of reports in the documents with those of a current report.

docs/figures/reports.json has for each picture the command and the deck, the notes at the top of the
page and its cards. The target `docs-pictures` writes it with the pictures; the tests that run the
same decks compare.
"""
import html
import json
import pathlib
import re

from checks import expect

FIGURES = pathlib.Path(__file__).resolve().parents[2] / "docs/figures"
RECORD = FIGURES / "reports.json"
CLOSE = 0.01  # relative difference of numbers; the last digits depend on the machine
ROUNDING = ("Energy balance", "Worst check")  # cards of errors, which differ from run to run


def figures_of(text):
    """Notes and cards of a report."""
    notes = re.search(r'<ul class="notes">(.*?)</ul>', text, re.S)
    cards = dict(re.findall(r'<div class="name">(.*?)</div><div class="value">(.*?)</div>', text))
    return {
        "notes": [
            html.unescape(note) for note in re.findall(r"<li[^>]*>(.*?)</li>",
                                                       notes.group(1) if notes else "", re.S)
        ],
        "figures": {
            html.unescape(name): html.unescape(value) for name, value in cards.items()
            if html.unescape(name) not in ROUNDING
        },
    }


def parted(value):
    """A number and the text after it; (nan, text) if there is no number."""
    found = re.fullmatch(r"(-?[\d.]+(?:e[-+]?\d+)?)(.*)", value)
    return (float(found.group(1)), found.group(2)) if found else (float("nan"), value)


def same(one, other):
    (a, unit), (b, other_unit) = parted(one), parted(other)
    return unit == other_unit and (one == other or abs(a - b) <= CLOSE * max(abs(a), abs(b)))


def compare(picture, text, motion=True):
    """Compares the figures in a picture with those of the report `text`; without `motion` those of
    the state at rest."""
    kept = json.loads(RECORD.read_text(encoding="utf-8"))[picture]
    now = figures_of(text)
    names = [name for name in kept["figures"] if motion or name in now["figures"]]
    wrong = [
        f"{name}: {kept['figures'][name]}, now {now['figures'].get(name)}" for name in names
        if not same(kept["figures"][name], now["figures"].get(name, ""))
    ]
    expect(f"docs/figures/{picture} shows today's figures (else run the target docs-pictures)",
           names and not wrong, "; ".join(wrong) or str(names))
    if motion:
        expect(f"docs/figures/{picture} has today's notes",
               len(kept["notes"]) == len(now["notes"]), f"{kept['notes']}, now {now['notes']}")
