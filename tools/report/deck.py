# SPDX-License-Identifier: BSD-3-Clause
"""The deck of a run as it was run: its XML with the overrides of the command line, as nested dicts."""
import math
import re
import xml.etree.ElementTree as xml

# What a title says of a scene: path, symbol before, SI unit of a plain number with the factor to the unit that is shown.
SPEED = "Rotary Speed/Constant/Speed"
CONDITIONS = (
    (SPEED, "", "rpm", 30 / math.pi),
    ("Loads/Weight On Bit", "WOB ", "kN", 1e-3),
    ("Loads/Torque On Bit", "TOB ", "kN m", 1e-3),
    ("Mud/Density", "mud ", "kg/m3", 1.0),
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
    """One override as results.h5 keeps it: PATH=VALUE, or !LIST."""
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
    """Nested dicts of a deck; empty where the text is no deck."""
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
    """A quantity as the deck gives it, or in a unit of the field when it is a plain number."""
    if not re.fullmatch(r"[-+0-9.eE]+", text.strip()):
        return text
    return f"{float(text) * factor:.4g} {unit}"


def conditions(deck, varied=()):
    """"120 rpm, WOB 40 kN, ..." for the title of a page, without the paths that are `varied`."""
    words = []
    for path, symbol, unit, factor in CONDITIONS:
        text = value(deck, path) if path not in varied else None
        if text and text not in ("0", "0.0") and (path != SPEED or value(deck, "Rotary Speed/Law") in (None, "Constant")):
            words.append(symbol + shown(text, unit, factor))
    return ", ".join(words)


def rows(deck, depth=0):
    """(depth, name, value or None) of all lists and parameters, parameters of a list before its lists."""
    for name, entry in deck.items():
        if not isinstance(entry, dict):
            yield depth, name, entry
    for name, entry in deck.items():
        if isinstance(entry, dict):
            yield depth, name, None
            yield from rows(entry, depth + 1)
