# SPDX-License-Identifier: BSD-3-Clause
"""Keyword arguments as deck lists: the names are those of the deck in snake_case, and the reader of
decks checks them."""
from __future__ import annotations

import difflib
import json
import numbers
import re
import xml.sax.saxutils
from collections.abc import Mapping, Sequence
from typing import Any

from . import _core
from .errors import DeckError, UsageError


def keyword(name: str) -> str:
    """A name of the deck in snake_case.

    >>> keyword("Cut-off Frequency"), keyword("Transient")
    ('cut_off_frequency', 'transient')
    """
    return re.sub(r"[^0-9a-z]+", "_", name.lower()).strip("_")


def title(name: str) -> str:
    """snake_case as a name of the deck, for keywords that are in no list.

    >>> title("spectral_radius")
    'Spectral Radius'
    """
    return name if " " in name or name[:1].isupper() else name.replace("_", " ").title()


def describe(name: str) -> dict[str, Any]:
    """The description of the list "Reduction", "Transient" or "Coupling", or of a point law, as
    `tooljoint doc --format json` prints it.

    >>> describe("Transient")["parameters"][0]["name"]
    'Integrator'
    """
    return json.loads(_core.list_description(name))[0]


def write(name: str, values: Mapping[str, Any], description: Mapping[str, Any]) -> str:
    """XML of the list `name` with these values, a dict.
    Lists are dicts, arrays are lists; numbers may be texts with a unit."""
    known = {keyword(each["name"]): each for each in description["lists"]}
    parameters = {keyword(each["name"]): each for each in description["parameters"]}
    free = description["named_lists"]
    lines = []
    for given, value in values.items():
        if isinstance(value, dict):
            own = known.get(keyword(given)) or ({**free, "name": given} if free else {
                "name": title(given), "lists": [], "parameters": [], "named_lists": None
            })
            lines.append(write(own["name"], value, own))
        elif value is not None:
            lines.append(_parameter(given, value, parameters.get(keyword(given))))
    return f"<ParameterList name={_quote(name)}>{''.join(lines)}</ParameterList>"


def placed(description: Mapping[str, Any], values: Mapping[str, Any],
           places: Sequence[str | None]) -> dict[str, Any]:
    """Sorts values by keyword into their lists: the described list, else the first of its lists
    `places` that has the keyword. An unknown keyword goes to the list with the most similar name,
    so that the reader can suggest that name.

    >>> values = {"modes": 6, "basis_checks": False, "mods": 6}
    >>> placed(describe("Reduction"), values, ["Mode Selection"])
    {'basis_checks': False, 'Mode Selection': {'modes': 6, 'mods': 6}}
    """
    lists = {each["name"]: each for each in description["lists"]}
    known: list[tuple[str, str]] = [("", name) for name in map(keyword, _names(description))]
    known += [(place, name) for place in places if place and place in lists
              for name in map(keyword, _names(lists[place]))]
    out: dict[str, Any] = {}
    inner: dict[str, dict[str, Any]] = {}
    for name, value in values.items():
        similar = difflib.get_close_matches(keyword(name), [one for _, one in known], 1)
        place = next((place for place, one in known if one == (similar[0] if similar else name)),
                     "")
        if place and not isinstance(value, dict):
            inner.setdefault(place, {})[name] = value
        else:
            out[name] = value
    return {**out, **inner}


def _names(description):
    return [each["name"] for each in description["parameters"] + description["lists"]]


def checked(name: str, values: Mapping[str, Any]) -> _core.DeckList:
    """The list `name` with these values, checked. DeckError with the message of the program."""
    try:
        return _core.parse_list(write(name, values, describe(name)), name)
    except DeckError as error:
        # The text is generated; its line numbers are of no use to a user.
        raise DeckError(re.sub(rf"(?m)^{re.escape(name)}(:\d+)?: ", "", str(error))) from None


def text_of(value: Any) -> str:
    """A value as written in a deck and in `--set`.

    >>> text_of(True), text_of(0.005), text_of(["a", "b"]), text_of("120 rpm")
    ('true', '0.005', '{a, b}', '120 rpm')
    """
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return value
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    try:
        values = list(value)
    except TypeError:
        raise UsageError(f"{value!r} is no value of a deck; expected is a number, a text, a "
                         "boolean or a list of them.") from None
    return "{" + ", ".join(map(text_of, values)) + "}"


def type_of(value: Any, kind: str = "") -> str:
    """The type attribute of a value; for whole numbers and texts it depends on the `kind` of the
    parameter (empty if unknown)."""
    if isinstance(value, bool):
        return "bool"
    if isinstance(value, str):
        return "string"
    if isinstance(value, numbers.Real):
        return "int" if isinstance(value,
                                   numbers.Integral) and not kind.startswith("real") else "double"
    inner = {type_of(each, kind) for each in value} or {"string"}
    return f"Array({'double' if inner == {'int', 'double'} else inner.pop()})"


def _parameter(given, value, description):
    name = description["name"] if description else title(given)
    kind = description["kind"] if description else ""
    text = text_of(value)
    return (f"<Parameter name={_quote(name)} type={_quote(type_of(value, kind))} "
            f"value={_quote(text)}/>")


def _quote(text):
    return xml.sax.saxutils.quoteattr(text)
