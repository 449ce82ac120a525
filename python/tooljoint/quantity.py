# SPDX-License-Identifier: BSD-3-Clause
"""Arrays with a unit."""
from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


class Quantity(np.ndarray):
    """A numpy array with `unit`, an SI unit as text, and `long_name`, a sentence; both may be
    empty.

    Slices keep the unit; results of computations are plain arrays or numbers without a unit.

    >>> length = Quantity([1.0, 2.0], "m", "Length")
    >>> length.unit, length[1:].unit
    ('m', 'm')
    >>> type(length * length).__name__, float(length.sum())
    ('ndarray', 3.0)
    >>> import pickle
    >>> pickle.loads(pickle.dumps(length)).label
    'Length [m]'
    """
    def __new__(cls, values: ArrayLike, unit: str = "", long_name: str = "") -> Quantity:
        array = np.asarray(values).view(cls)
        array.unit, array.long_name = unit, long_name
        return array

    def __array_finalize__(self, source):
        self.unit = getattr(source, "unit", "")
        self.long_name = getattr(source, "long_name", "")

    def __reduce__(self):
        rebuild, arguments, state = super().__reduce__()
        return rebuild, arguments, (*state, self.unit, self.long_name)

    def __setstate__(self, state):
        super().__setstate__(state[:-2])
        self.unit, self.long_name = state[-2:]

    def __array_ufunc__(self, ufunc, method, *inputs, **options):
        plain = [np.asarray(each) if isinstance(each, Quantity) else each for each in inputs]
        if "out" in options:
            options["out"] = tuple(
                np.asarray(each) if isinstance(each, Quantity) else each for each in options["out"])
        return getattr(ufunc, method)(*plain, **options)

    def __array_function__(self, function, types, arguments, options):
        plain = lambda each: np.asarray(each) if isinstance(each, Quantity) else type(each)(map(
            plain, each)) if type(each) in (list, tuple) else each
        return function(*map(plain, arguments),
                        **{name: plain(each) for name, each in options.items()})

    @property
    def label(self) -> str:
        """Label for the axis of a figure: "Length [m]"."""
        return f"{self.long_name} [{self.unit}]" if self.unit else self.long_name
