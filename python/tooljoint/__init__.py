# SPDX-License-Identifier: BSD-3-Clause
"""Tooljoint: component mode synthesis, and the drillstring simulator built on it.

Parts come from scipy matrices (`part`), are reduced by any method of the deck (`reduce`), joined
(`couple`, `synthesise`), compared (`modes`, `mac`, `compare_modes`, `estimate_frequencies`) and
integrated in time (`integrate`). Decks are read, changed and run in this process (`Deck`, `run`,
`study`, `read`). Bases and point laws may be written in Python (`basis`, `point_law`).

The import initialises MPI, the end of the interpreter finalises it; under mpirun every rank makes
the same calls. Errors are exceptions of the class `Error` with the message of the program.
"""
import sys as _sys

from . import _core
from ._core import Model, Part, PartView, PointLaw, ReducedPart, Synthesis, rank, ranks, warnings
from .decks import Deck, run, study
from .errors import ConvergenceError, DeckError, Error, FileError, ModelError, UsageError
from .lists import describe
from .modal import Modes, compare_modes, damped_modes, estimate_frequencies, mac, modes
from .motion import Motion, integrate
from .parts import couple, part, read_part, reduce, reduction, synthesise, write_part
from .quantity import Quantity
from .results import Results, read
from .variants import Parameter, basis, law, point_law

__version__ = _core.version()
__all__ = [
    name for name in dir()
    if not name.startswith("_") and name not in ("arguments", "decks", "errors", "lists", "modal",
                                                 "motion", "parts", "quantity", "results",
                                                 "variants")
]


def bases():
    """Names of the available reduction bases."""
    return _core.basis_names()


def point_laws():
    """Names of the available point laws."""
    return _core.point_law_names()


__all__ += ["bases", "point_laws"]

if ranks() > 1:
    # If one rank fails alone, the others must not wait for it in the next collective call.
    def _abort(kind, error, trace, _before=_sys.excepthook):
        _before(kind, error, trace)
        _sys.stderr.flush()
        _core.abort(130 if issubclass(kind, KeyboardInterrupt) else getattr(error, "code", 1))

    _sys.excepthook = _abort
