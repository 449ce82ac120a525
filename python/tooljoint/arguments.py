# SPDX-License-Identifier: BSD-3-Clause
"""Checks of arguments: an invalid one raises a UsageError that names the call, the argument and the
expected value."""
from __future__ import annotations

import math
import numbers
from typing import Any

from . import _core
from .errors import UsageError

KINDS = {
    "Part": _core.Part, "ReducedPart": _core.ReducedPart, "Synthesis": _core.Synthesis,
    "Model": _core.Model
}


def whole(value: Any, call: str, name: str) -> int:
    """A whole number, also of numpy or a float without a fraction.

    >>> whole(3.0, "modes", "count")
    3
    >>> whole(2.5, "modes", "count")
    Traceback (most recent call last):
    ...
    tooljoint.errors.UsageError: modes(): count is 2.5; expected is a whole number.
    """
    if isinstance(value,
                  bool) or not isinstance(value, numbers.Real) or not float(value).is_integer():
        raise UsageError(f"{call}(): {name} is {value!r}; expected is a whole number.")
    return int(value)


def real(value: Any, call: str, name: str) -> float:
    """A finite real number."""
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise UsageError(f"{call}(): {name} is {value!r}; expected is a number.")
    if not math.isfinite(value):
        raise UsageError(f"{call}(): {name} is {value!r}; expected is a finite number.")
    return float(value)


def one_of(value: Any, kinds: tuple[str, ...], call: str, name: str) -> Any:
    """An object of one of these classes."""
    if not isinstance(value, tuple(KINDS[kind] for kind in kinds)):
        raise UsageError(f"{call}(): {name} is {value!r}; expected is a {' or a '.join(kinds)}.")
    return value


def list_of(values: Any, kinds: tuple[str, ...], call: str, name: str) -> list:
    """A list of objects of these classes."""
    try:
        found = list(values)
    except TypeError:
        raise UsageError(f"{call}(): {name} is {values!r}; expected is a list, each of them a "
                         f"{' or a '.join(kinds)}.") from None
    return [one_of(value, kinds, call, f"{name}[{i}]") for i, value in enumerate(found)]


def model_of(value: Any, call: str) -> _core.Model:
    """The model of an object that has one."""
    one_of(value, tuple(KINDS), call, "of")
    return value if isinstance(value, _core.Model) else value.model
