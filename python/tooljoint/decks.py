# SPDX-License-Identifier: BSD-3-Clause
"""Decks: read, changed, written, run."""
from __future__ import annotations

import copy
import json
import os
import pathlib
import re
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterable, Mapping
from typing import Any

from . import _core
from .errors import DeckError, FileError
from .lists import text_of, write
from .results import Results
from .variants import any_written

_NOTHING = object()  # marks a missing value


class Deck:
    """A deck.
    `deck["Transient/End Time"]` is the value in SI, default or given. Setting it changes the deck
    like `--set`; values that the program would refuse raise an error. `del deck["Mud"]` removes a
    list. Relative names of files are relative to the folder of the deck.

    >>> import tooljoint as tj
    >>> deck = tj.Deck(example_deck)
    >>> deck["Transient/End Time"] = "500 ms"
    >>> deck["Transient/End Time"], deck["Transient/Integrator"]
    (0.5, 'Generalized-alpha')
    >>> deck["Transient/End Tim"] = 1
    Traceback (most recent call last):
    ...
    tooljoint.errors.DeckError: --set Transient/End Tim=1: /frame/Transient/End Tim is not a
    parameter. Did you mean "End Time"? ...
    >>> deck["Transient/End Tim"]
    Traceback (most recent call last):
    ...
    tooljoint.errors.DeckError: /frame/Transient/End Tim is not a parameter. Did you mean
    "End Time"? ...
    """
    def __init__(self, file: str | os.PathLike, set: Mapping[str, Any] | None = None,
                 without: Iterable[str] = ()):
        self.file = str(file)
        self._folder = os.getcwd()
        self._text = ""
        self.overrides = ["!" + path for path in without
                          ] + [f"{path}={text_of(value)}" for path, value in (set or {}).items()]
        self._read = _core.read_deck(self._source())

    def _source(self, text=None, overrides=None):
        """The deck for the toolkit; valid also after a change of the working folder."""
        file = self.file if os.getcwd() == self._folder else os.path.join(self._folder, self.file)
        return _core.DeckSource(file, self._text if text is None else text,
                                self.overrides if overrides is None else overrides)

    def _change(self, override):
        self._read = _core.read_deck(self._source(overrides=[*self.overrides, override]))
        self.overrides.append(override)

    def __getitem__(self, path: str) -> Any:
        value = self._value(path)
        if value is _NOTHING:
            raise DeckError(self._absence(path))
        return value

    def _value(self, path):
        """The value at a path, given or default, or _NOTHING."""
        value = self._read.to_dict()
        for name in _pieces(path):
            if not isinstance(value, dict) or name not in value:
                return _NOTHING
            value = value[name]
        return value

    def _absence(self, path):
        """The reason why a path has no value; for a wrong name the message of the program."""
        try:
            _core.read_deck(self._source(overrides=[*self.overrides, f"{path}=0"]))
        except DeckError as error:
            sentence = str(error).removeprefix(f"--set {path}=0: ")
            if " is not a parameter. " in sentence or " is not a list. " in sentence:
                return sentence
        return f"The deck does not give {path}, which has no default."

    def __setitem__(self, path: str, value: Any) -> None:
        self._change(f"{path}={text_of(value)}")

    def __delitem__(self, path: str) -> None:
        self._change("!" + path)

    def __contains__(self, path: str) -> bool:
        return self._value(path) is not _NOTHING

    def add(self, path: str, values: Mapping[str, Any]) -> None:
        """Add a list with a name of your own, such as "Coupling/Point Laws/guy"; `--set` takes only
        existing names. values: a dict, with dicts for its sublists."""
        *outer, name = _pieces(path)
        root, description = self._tree()
        element = root
        for each in outer:
            inner = _find(element, "ParameterList", each)
            element = ElementTree.SubElement(element, "ParameterList",
                                             name=each) if inner is None else inner
            description = _described(description, each)
        overrides = list(self.overrides)
        if f"!{path}" in overrides:  # a deleted list is replaced, with the values set in it
            deleted = overrides.index(f"!{path}")
            overrides = [
                one for i, one in enumerate(overrides)
                if i > deleted or (i < deleted and not one.startswith(f"{path}/"))
            ]
            old = _find(element, "ParameterList", name)
            if old is not None:
                element.remove(old)
        element.append(ElementTree.fromstring(write(name, values, _described(description, name))))
        text = self._whole(root)
        self._read = _core.read_deck(self._source(text, overrides))
        self.overrides = overrides
        self._text = text

    def _tree(self):
        parser = ElementTree.XMLParser(target=ElementTree.TreeBuilder(insert_comments=True))
        return ElementTree.fromstring(self._read.text,
                                      parser), json.loads(self._read.description)[0]

    def _whole(self, root):
        """The text of a tree, with the comments before its root."""
        prolog = re.match(r"(\s|<!--.*?-->|<\?.*?\?>)*", self._read.text, re.DOTALL).group()
        ElementTree.indent(root)
        return "\n".join([
            *re.findall(r"<!--.*?-->", prolog, re.DOTALL),
            ElementTree.tostring(root, encoding="unicode"), ""
        ])

    def gives(self, path: str) -> bool:
        """Whether the deck or a change gives this value; False for a default."""
        return self._read.gives(path)

    @property
    def name(self) -> str:
        """Name of the root list."""
        return self._read.name

    def to_dict(self) -> dict[str, Any]:
        """All values in SI, defaults included; lists are dicts."""
        return self._read.to_dict()

    def write(self, file: str | os.PathLike) -> None:
        """Write the deck with its changes and its comments. Relative names of files in it are
        relative to the new folder: make them absolute before. FileError."""
        root, description = self._tree()
        for override in self.overrides:
            if override.startswith("!"):
                _remove(root, _pieces(override[1:]))
            else:
                path, value = override.split("=", 1)
                _place(root, _pieces(path), value, description)
        try:
            pathlib.Path(file).write_text(self._whole(root), encoding="utf-8")
        except OSError as error:
            raise FileError(f"The deck {file} cannot be written: {error.strerror}.") from error

    def check(self, quiet: bool = True) -> None:
        """Raise the errors of a run; with quiet=False print a summary of the model, like `tooljoint
        check`."""
        _core.check(self._source(), quiet)

    def run(self, output: str | os.PathLike = "", restart: str | os.PathLike = "",
            quiet: bool = True) -> Results:
        """Run the deck in this process, like `tooljoint run`; its Results. Collective under MPI."""
        return Results(_core.run(self._source(), str(output), str(restart), quiet))

    def at_rest(self) -> _core.RestingCase:
        """The case at rest: `full()` is its full model, `parts()` its parts and their connections
        (for `synthesise`), `displacement` its displacements at rest. ConvergenceError,
        ModelError."""
        return _core.solve_static(self._source())

    def study(self, output: str | os.PathLike = "", fresh: bool | None = None,
              shared_timing: bool = False, quiet: bool = True) -> list[dict[str, Any]]:
        """Run the list Study in this process, like `tooljoint study`: the rows of study.csv, a list
        of dicts. Rows known from an earlier study in the folder are reused, except with `fresh`, or
        if a variant written in Python takes part (it may have changed).
        """
        return self._analyse("study", output, fresh, shared_timing, quiet)

    def map(self, output: str | os.PathLike = "", fresh: bool | None = None,
            quiet: bool = True) -> list[dict[str, Any]]:
        """Compute the list Map, like `tooljoint map`: the rows of map.csv. fresh: as in study()."""
        return self._analyse("map", output, fresh, False, quiet)

    def campbell(self, output: str | os.PathLike = "", fresh: bool | None = None,
                 quiet: bool = True) -> list[dict[str, Any]]:
        """Damped modes against the rotary speed (list Campbell), like `tooljoint campbell`: the
        rows of campbell.csv. fresh: as in study()."""
        return self._analyse("campbell", output, fresh, False, quiet)

    def response(self, output: str | os.PathLike = "", fresh: bool | None = None,
                 quiet: bool = True) -> list[dict[str, Any]]:
        """Harmonic responses (list Response), like `tooljoint response`: the rows of response.csv;
        fresh as in study()."""
        return self._analyse("response", output, fresh, False, quiet)

    def _analyse(self, what, output, fresh, shared_timing, quiet):
        folder = str(output) or f"results/{pathlib.Path(self.file).stem}_{what}"
        _core.analyse(what, self._source(), folder,
                      any_written() if fresh is None else fresh, shared_timing, quiet)
        return Results(folder).table(f"{what}.csv")

    def __repr__(self):
        changes = f" with {len(self.overrides)} changes" if self.overrides else ""
        return f"<Deck {self.file}{changes}>"


def run(deck: str | os.PathLike | Deck, set: Mapping[str, Any] | None = None,
        without: Iterable[str] = (), output: str | os.PathLike = "",
        restart: str | os.PathLike = "", quiet: bool = True) -> Results:
    """Run a deck (a file or a Deck) in this process; its Results. set: {"Transient/End Time":
    "2 s"}; without: lists to remove. The errors have the messages of the program. Collective under
    MPI."""
    return _with(deck, set, without).run(output, restart, quiet)


def study(deck: str | os.PathLike | Deck, set: Mapping[str, Any] | None = None,
          without: Iterable[str] = (), output: str | os.PathLike = "", fresh: bool | None = None,
          shared_timing: bool = False, quiet: bool = True) -> list[dict[str, Any]]:
    """Run the study of a deck (a file or a Deck) in this process: see Deck.study."""
    return _with(deck, set, without).study(output, fresh, shared_timing, quiet)


def _with(deck, set, without):
    if not isinstance(deck, Deck):
        return Deck(deck, set, without)
    changed = copy.copy(deck)
    changed.overrides = list(deck.overrides)
    for path in without:
        del changed[path]
    for path, value in (set or {}).items():
        changed[path] = value
    return changed


def _pieces(path):
    return [piece for piece in path.split("/") if piece]


def _described(description, name):
    """The description of a list inside another one: by its name, else that of lists with free
    names, else an empty one."""
    lists = [one for one in description["lists"] if one["name"] == name]
    return lists[0] if lists else description["named_lists"] or {
        "lists": [], "parameters": [], "named_lists": None
    }


def _find(element, tag, name):
    return next((one for one in element if one.tag == tag and one.get("name") == name), None)


def _remove(root, pieces):
    for name in pieces[:-1]:
        root = _find(root, "ParameterList", name)
        if root is None:
            return
    for tag in ("ParameterList", "Parameter"):
        one = _find(root, tag, pieces[-1])
        if one is not None:
            root.remove(one)


def _place(root, pieces, text, description):
    """Puts a value into the tree, with the type from the description; missing lists are added."""
    for name in pieces[:-1]:
        inner = _find(root, "ParameterList", name)
        root = ElementTree.SubElement(root, "ParameterList", name=name) if inner is None else inner
        description = _described(description, name)
    known = next((one for one in description["parameters"] if one["name"] == pieces[-1]), None)
    one = _find(root, "Parameter", pieces[-1])
    if one is None:
        one = ElementTree.SubElement(root, "Parameter", name=pieces[-1])
    one.set("type", _type(text, known, one.get("type")))
    one.set("value", text)


def _type(text, known, before):
    """Text for a quantity with a unit; otherwise the type from the description, or the previous
    type."""
    declared = known["type"] if known else before or "string"
    plain = re.fullmatch(r"\{?[-+0-9.eE, ]*\}?", text) is not None
    if "double" in declared and not plain:
        return declared.replace("double", "string")
    return declared
