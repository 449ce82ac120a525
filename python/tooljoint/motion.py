# SPDX-License-Identifier: BSD-3-Clause
"""Motions."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from .arguments import model_of
from .errors import ModelError, UsageError
from .lists import checked, describe, placed
from .quantity import Quantity

if TYPE_CHECKING:
    from .modal import HasModel


class Motion:
    """A motion: `time` [s], and `displacement`, `velocity` and `acceleration` (samples x
    coordinates of the model), with the units of the coordinates in `model.dof_units`; `report` has
    counts, times and energies of the integration. `at()` gives the motion of nodes.
    """
    def __init__(self, model: _core.Model, time: np.ndarray, displacement: np.ndarray,
                 velocity: np.ndarray, acceleration: np.ndarray, report: dict[str, Any]):
        self.model, self.report = model, report
        self.time = Quantity(time, "s", "Time")
        unit = ", ".join(dict.fromkeys(model.dof_units))
        self.displacement = Quantity(displacement, unit, "Displacement")
        self.velocity = Quantity(velocity, _rate(unit, 1), "Velocity")
        self.acceleration = Quantity(acceleration, _rate(unit, 2), "Acceleration")

    def at(self, node: int, component: str, what: str = "displacement") -> Quantity:
        """Time history of a component of a node, recovered from the coordinates; also for interior
        nodes of reduced parts. what: "displacement", "velocity" or "acceleration". ModelError for a
        node that the model does not recover.
        """
        orders = ("displacement", "velocity", "acceleration")
        if what not in orders:
            raise UsageError(f"at(): what is {what!r}; expected is one of {', '.join(orders)}.")
        numbers, names = self.model.recovery_nodes, self.model.component_names
        place = np.flatnonzero(numbers == node)
        if not len(place) or component not in names:
            raise ModelError(f"The model recovers no {component} of node {node}.")
        row = place[0] * len(names) + names.index(component)
        history = getattr(self, what)
        values = np.asarray(history) @ self.model.recovery[row].toarray().ravel()
        if what == "displacement":
            values = values + self.model.recovery_offset[row]
        order = orders.index(what)
        unit = _rate(self.model.component_units[names.index(component)], order)
        return Quantity(values, unit, f"{history.long_name} {component} of node {node}")

    def __repr__(self):
        return (f"<Motion of {self.displacement.shape[1]} coordinates, {len(self.time)} samples to "
                f"{self.time[-1]:g} s>")


def _rate(units: str, order: int) -> str:
    """Units of a derivative: "m, rad" becomes "m/s, rad/s".

    >>> _rate("m, rad", 2), _rate("m", 0)
    ('m/s2, rad/s2', 'm')
    """
    return ", ".join(unit + ("", "/s", "/s2")[order] for unit in units.split(", "))


def integrate(of: HasModel, end_time: float | str, *, integrator: str = "Generalized-alpha",
              **parameters: Any) -> Motion:
    """Integrate the motion of a model, a part or a synthesis from its start.
    The arguments are those of the deck list Transient in snake_case, of the list itself or of the
    list of the integrator (sampling_interval, step, spectral_radius ...). Collective under MPI.

    DeckError, ModelError, ConvergenceError (an unstable or too coarse integration is refused);
    KeyboardInterrupt.

    >>> import numpy as np, tooljoint as tj
    >>> mass = tj.part("mass", [[1.0]], [[(2 * np.pi) ** 2]])
    >>> mass.model.set_start([1.0], [0.0])
    >>> motion = tj.integrate(mass, 0.5, integrator="RK4", step="1 ms", sampling_interval=0.25)
    >>> motion.displacement.round(3).ravel().tolist(), motion.displacement.unit
    ([1.0, 0.0, -1.0], 'm')
    """
    values = placed(
        describe("Transient"),
        {"integrator": integrator, "end_time": end_time, "progress": False, **parameters},
        [integrator])
    model = model_of(of, "integrate")
    return Motion(model, *_core.integrate(model, checked("Transient", values)))
