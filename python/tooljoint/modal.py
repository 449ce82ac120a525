# SPDX-License-Identifier: BSD-3-Clause
"""Modes of models and their comparison."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from .arguments import model_of, one_of, real, whole
from .errors import UsageError
from .quantity import Quantity

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from .parts import MatrixLike

    HasModel = _core.Model | _core.Part | _core.ReducedPart | _core.Synthesis


class Modes:
    """Modes of a model: `frequency` [Hz] (negative if omega^2 is negative), `shapes` (dofs x
    modes), `residuals` (relative). Damped modes also have `values`, s [1/s], and `damping`, the
    damping ratios; their shapes are complex.
    """
    def __init__(self, frequency: ArrayLike, shapes: np.ndarray, residuals: np.ndarray,
                 values: np.ndarray | None = None):
        self.frequency = Quantity(frequency, "Hz", "Frequency")
        self.shapes, self.residuals = shapes, residuals
        if values is not None:
            size = np.abs(values)
            self.values = Quantity(values, "1/s", "Eigenvalue")
            self.damping = Quantity(
                np.divide(-values.real, size, out=np.zeros(len(size)), where=size > 0), "",
                "Damping ratio")

    def __len__(self) -> int:
        return len(self.frequency)

    def __repr__(self):
        first = ", ".join(f"{one:.6g}" for one in self.frequency[:5])
        return f"<Modes: {len(self)}, {first}{', ...' if len(self) > 5 else ''} Hz>"


def modes(of: HasModel, count: int) -> Modes:
    """The `count` lowest undamped modes of a model, a part, a reduced part or a synthesis, with
    closed contacts linearised. UsageError, ModelError.

    >>> import numpy as np, tooljoint as tj
    >>> mass = tj.part("mass", [[1.0]], [[(2 * np.pi) ** 2]])
    >>> tj.modes(mass, 1)
    <Modes: 1, 1 Hz>
    """
    values, shapes, residuals = _core.undamped_modes(model_of(of, "modes"),
                                                     whole(count, "modes", "count"))
    return Modes(np.sign(values) * np.sqrt(np.abs(values)) / (2 * np.pi), shapes, residuals)


def damped_modes(of: HasModel, count: int, t: float = 0.0) -> Modes:
    """The `count` damped modes of smallest |s|, one of each conjugate pair, with the matrices at
    the time t.

    >>> import numpy as np, tooljoint as tj
    >>> mass = tj.part("mass", [[1.0]], [[100.0]], damping=[[2.0]])
    >>> round(float(tj.damped_modes(mass, 1).damping[0]), 12)
    0.1
    """
    values, shapes, residuals = _core.damped_modes(model_of(of, "damped_modes"),
                                                   whole(count, "damped_modes", "count"),
                                                   real(t, "damped_modes", "t"))
    return Modes(np.abs(values) / (2 * np.pi), shapes, residuals, values)


def mac(a: ArrayLike, b: ArrayLike, mass: MatrixLike) -> np.ndarray:
    """Modal assurance criterion of the columns of two arrays of shapes, weighted with the mass
    matrix: columns of a x columns of b.

    >>> import numpy as np
    >>> mac(np.eye(2), np.array([[1.0, 1.0], [0.0, 1.0]]), np.eye(2)).round(3).tolist()
    [[1.0, 0.5], [0.0, 0.5]]
    """
    try:
        shapes = [np.asarray(each, complex) for each in (a, b)]
    except (TypeError, ValueError):
        shapes = []
    if len(shapes) < 2 or any(each.ndim != 2 for each in shapes):
        raise UsageError("mac(): expected are two arrays of shapes, dofs x modes.")
    if not all(np.isfinite(each).all() for each in shapes):
        raise UsageError("mac(): a shape has an entry that is not finite.")
    return _core.modal_assurance(mass, *shapes)


def compare_modes(synthesis: _core.Synthesis, count: int, full: HasModel | None = None,
                  t: float | None = None) -> list[dict[str, Any]]:
    """Modes of the full model, each with the coupled mode of the same shape: a list of dicts with
    full_hz, coupled_hz, mac, error (relative, of the frequency) and estimate (of the error, without
    the full model; None if the basis has no estimate); the values are None if no coupled mode
    corresponds. full: the model to compare with; by default the unreduced parts, coupled. t:
    compares damped modes at that time instead."""
    call = "compare_modes"
    time = None if t is None else real(t, call, "t")
    return _core.compare_modes(one_of(synthesis, ("Synthesis",), call, "synthesis"),
                               whole(count, call, "count"), time,
                               None if full is None else model_of(full, call))


def estimate_frequencies(synthesis: _core.Synthesis, count: int) -> list[dict[str, Any]]:
    """Estimated relative errors of the lowest coupled frequencies, without the full model: a list
    of dicts with frequency_hz, error, by_part (contribution of the truncated modes of each part)
    and definite (False: modes are missing below this frequency)."""
    call = "estimate_frequencies"
    return _core.estimate_frequencies(one_of(synthesis, ("Synthesis",), call, "synthesis"),
                                      whole(count, call, "count"))
