# SPDX-License-Identifier: BSD-3-Clause
"""Results of a run."""
from __future__ import annotations

import csv
import json
import os
import pathlib
from collections.abc import Iterator
from typing import Any

from . import _core
from .errors import FileError
from .quantity import Quantity

FILES = ("study.h5", "results.h5", "map.h5", "campbell.h5", "response.h5", "torque_drag.h5",
         "bha.h5", "buckling.h5", "modes.h5")  # one per folder, or the first and others


class Results:
    """The folder of a run or of an analysis.
    `results["transient/displacement"]` is a dataset of its HDF5 file (results.h5, campbell.h5), an
    array with unit and long_name; `summary` is summary.json as a dict; `table("motion.csv")`
    returns the rows of a table.

    FileError for a folder without results, or for a missing dataset.
    """
    def __init__(self, folder: str | os.PathLike):
        self.folder = pathlib.Path(folder)
        file = self.folder / "summary.json"
        try:
            self.summary = json.loads(file.read_text(encoding="utf-8"))
        except OSError as error:
            raise FileError(f"The results folder {folder} cannot be read: {error.strerror}: "
                            f"{file}. Give the folder of a finished run.") from error
        except ValueError as error:
            raise FileError(f"{file} is no summary of a run: {error}.") from error

    def _open(self) -> _core.ResultsFile:
        name = next((name for name in FILES if (self.folder / name).exists()), FILES[0])
        return _core.ResultsFile(str(self.folder / name))

    def __iter__(self) -> Iterator[str]:
        return iter(self.datasets())

    def datasets(self) -> list[str]:
        """Paths of all datasets, without the leading slash."""
        return [path.lstrip("/") for path in self._open().datasets()]

    def __contains__(self, path: str) -> bool:
        return "/" + path.lstrip("/") in self._open().datasets()

    def __getitem__(self, path: str) -> Quantity:
        file, path = self._open(), "/" + path.lstrip("/")
        return Quantity(file.read(path), file.unit(path), file.long_name(path))

    def table(self, name: str) -> list[dict[str, Any]]:
        """Rows of a table of the folder as dicts; numbers are converted."""
        try:
            with open(self.folder / name, newline="", encoding="utf-8") as file:
                return [{key: _value(text) for key, text in row.items()} for row in csv.DictReader(
                    line for line in file if not line.startswith("#"))]
        except OSError as error:
            raise FileError(
                f"The table {self.folder / name} cannot be read: {error.strerror}.") from error

    @property
    def warnings(self) -> list[str]:
        """Warnings of the run."""
        return self.summary["warnings"]

    def __repr__(self):
        return f"<Results {self.folder}: {self.summary['status']}>"


def read(folder: str | os.PathLike) -> Results:
    """The Results in the folder of a run. FileError."""
    return Results(folder)


def _value(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text
