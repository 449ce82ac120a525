# SPDX-License-Identifier: BSD-3-Clause
"""The deck of a run as it was run: its XML with the overrides of the command line, as nested
dicts."""
import math
import re
import xml.etree.ElementTree as xml

RPM = 30 / math.pi
# Conditions in a title: path, words before, unit shown, factor from the SI value of a plain number
# to that unit.
CONDITIONS = (
    ("Loads/Weight On Bit", "WOB ", "kN", 1e-3),
    ("Loads/Torque On Bit", "TOB ", "kN m", 1e-3),
    ("Mud/Density", "mud ", "kg/m3", 1.0),
)
OF_ANALYSES = (  # further ones for analyses
    ("Well/Bore Diameter", "bore ", "mm", 1e3),
    ("Well/Bore Radius", "bore radius ", "mm", 1e3),
    ("Contact/Friction/Static", "static friction ", "", 1.0),
    ("Contact/Friction/Dynamic", "dynamic friction ", "", 1.0),
)
BLOCK = ("Torque and Drag/Block Weight", "block ", "kN", 1e-3)
# final or mean speed of a law: law, parameter, words before and after
SPEEDS = (
    ("Constant", "Speed", "", ""),
    ("Exponential", "Final Speed", "up to ", ""),
    ("Ramp", "Final Speed", "ramp to ", ""),
    ("Harmonic", "Mean Speed", "", " on average"),
)


def nested(element):
    """Lists as dicts, parameters as texts, in the order of the deck."""
    found = {}
    for child in element:
        name = child.get("name", "")
        if child.tag == "ParameterList":
            found[name] = nested(child)
        elif child.tag == "Parameter":
            found[name] = child.get("value", "")
    return found


def override(deck, edit):
    """Applies one override as stored in results.h5: PATH=VALUE, or !LIST."""
    path, _, value = (edit[1:] if edit.startswith("!") else edit).partition("=")
    *lists, name = path.strip().split("/")
    for one in lists:
        deck = deck.setdefault(one, {})
        if not isinstance(deck, dict):
            return
    if edit.startswith("!"):
        deck.pop(name, None)
    else:
        deck[name] = value


def read(text, overrides):
    """Nested dicts of a deck; empty if the text is not a deck."""
    try:
        deck = nested(xml.fromstring(text))
    except xml.ParseError:
        return {}
    for edit in overrides.splitlines():
        if edit:
            override(deck, edit)
    return deck


def value(deck, path):
    for key in path.split("/"):
        deck = deck.get(key) if isinstance(deck, dict) else None
    return deck if isinstance(deck, str) else None


def shown(text, unit, factor):
    """A quantity as written in the deck, or in a unit of the field if it is a plain number."""
    if not re.fullmatch(r"[-+0-9.eE]+", text.strip()):
        return text
    return f"{float(text) * factor:.4g} {unit}".strip()


def rotary_speed(deck, varied=()):
    """"120 rpm", "up to 60 rpm", ... from the law of the rotary speed; "" if the deck has no such
    law or varies it."""
    law = value(deck, "Rotary Speed/Law") or "Constant"
    for name, parameter, before, after in SPEEDS:
        path = f"Rotary Speed/{name}/{parameter}"
        text = value(deck, path) if name == law and path not in varied else None
        if text:
            return before + shown(text, "rpm", RPM) + after
    return "speeds of a table" if law == "Table" else ""


def conditions(deck, varied=(), more=()):
    """"120 rpm, WOB 40 kN, ..." for the title of a page, without paths in `varied`; `more`: further
    conditions."""
    words = [rotary_speed(deck, varied)]
    for path, before, unit, factor in (*CONDITIONS, *more):
        text = value(deck, path) if path not in varied else None
        if text and text not in ("0", "0.0"):
            words.append(before + shown(text, unit, factor))
    return ", ".join(filter(None, words))


def rows(deck, depth=0):
    """(depth, name, value or None) of all lists and parameters; the parameters of a list precede
    its sublists."""
    for name, entry in deck.items():
        if not isinstance(entry, dict):
            yield depth, name, entry
    for name, entry in deck.items():
        if isinstance(entry, dict):
            yield depth, name, None
            yield from rows(entry, depth + 1)
