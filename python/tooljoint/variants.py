# SPDX-License-Identifier: BSD-3-Clause
"""Bases and point laws written in Python.
They are added to the registries: calls, decks and studies of this process use them by name like
any other."""
from __future__ import annotations

import functools
import inspect
from collections.abc import Callable
from typing import Any

import numpy as np

from . import _core
from .arguments import whole
from .errors import ModelError, UsageError, not_finite
from .lists import checked, title

_written = set()  # names of the variants written in Python


class Parameter:
    """A parameter of a variant: its default (None: it must be given), SI unit and a sentence.
    The default determines the type; without one it is a real number.
    """
    def __init__(self, default: bool | int | float | str | None = None, unit: str = "",
                 doc: str = ""):
        self.default, self.unit, self.doc = default, unit, doc

    def row(self, name: str) -> tuple:
        """The parameter as in the description of a deck list: name, kind, unit, default,
        sentence."""
        kinds = {bool: "boolean", int: "integer", str: "text"}
        return (name, kinds.get(type(self.default), "real"), self.unit, self.default, self.doc
                or f"Parameter {name} of the function.")


def _parameters(function, taken):
    """Rows and names of the keyword parameters of a function after its first `taken` arguments."""
    given = list(inspect.signature(function).parameters.values())[taken:]
    rows, names = [], {}
    for one in given:
        default = None if one.default is inspect.Parameter.empty else one.default
        own = default if isinstance(default, Parameter) else Parameter(default)
        rows.append(own.row(title(one.name)))
        names[title(one.name)] = one.name
    return rows, names


def _sentence(function):
    return (inspect.getdoc(function) or "Written in Python.").strip().splitlines()[0]


def _checked_force(name, force, states):
    """The function of a point law with checked forces: ModelError for None and for a wrong number
    of forces. Forces that are not finite may belong to a trial that the integrator rejects, so they
    are recorded until finite ones follow or a solver fails."""
    who = f'The point law "{name}"'

    @functools.wraps(force)
    def checked_force(t, d, v, *more, **parameters):
        found = force(t, d, v, *more, **parameters)
        paired = states and isinstance(found, tuple) and len(found) == 2
        forces = found[0] if paired else found
        if states and not paired:
            return found
        if forces is None or np.size(forces) != d.size:
            what = "None" if forces is None else f"{np.size(forces)} values"
            raise ModelError(f"{who} returned {what} at t = {t:.6g} s; expected are {d.size} "
                             "forces, as many as there are positions d.")
        wrong = _first_not_finite(found if paired else (found,), len(d))
        if wrong is None:
            not_finite.pop(name, None)
        elif np.isfinite(d).all() and np.isfinite(v).all():
            value, point = wrong
            not_finite[name] = (f"{who} returned {value} at t = {t:.6g} s, where d is "
                                f"{_numbers(d[point])} m and v {_numbers(v[point])} m/s; expected "
                                "are finite numbers.")
        return found

    return checked_force


def _first_not_finite(arrays, points):
    """(value, point) of the first number that is not finite in arrays for this many points; None if
    all are finite, or if they are not numbers."""
    for each in arrays:
        try:
            rows = np.asarray(each, float).reshape(points, -1)
        except (TypeError, ValueError):
            return None
        at = np.argwhere(~np.isfinite(rows))
        if len(at):
            return float(rows[tuple(at[0])]), int(at[0][0])
    return None


def _numbers(values):
    return ", ".join(f"{value:.6g}" for value in np.ravel(values))


def basis(name: str) -> Callable[[Callable], Callable]:
    """Registers a function as a reduction basis: build(part, count, **parameters) returns vectors
    of the interior, interior dofs x any number of columns. The basis consists of the constraint
    modes and the `count` lowest Ritz vectors in their span. part is a PartView. Further arguments
    of the function are parameters of its deck list, described by their default or a Parameter.

    >>> import numpy as np, tooljoint as tj
    >>> @tj.basis("Static Responses")
    ... def static_responses(part, count, steps=2):
    ...     '''Static responses to pushes, made smooth by inverse steps.'''
    ...     vectors = np.eye(len(part.interior))[:, ::2]
    ...     for step in range(steps):
    ...         vectors = part.solve_interior(part.interior_mass @ vectors)
    ...     return vectors
    >>> stiffness = 2 * np.eye(7) - np.eye(7, k=1) - np.eye(7, k=-1)
    >>> chain = tj.part("chain", np.eye(7), stiffness, interface=[0, 6])
    >>> tj.reduce(chain, "Static Responses", modes=2, steps=3)
    <ReducedPart "chain": 4 coordinates, 2 of them modes>
    """
    def register(build):
        rows, names = _parameters(build, 2)
        _core.register_basis(name, _sentence(build), rows, names, build)
        _written.add(name)
        return build

    return register


def point_law(name: str, *, width: int = 1, states: int = 0, tangent: Callable | None = None,
              power: Callable | None = None,
              start: Callable | None = None) -> Callable[[Callable], Callable]:
    """Registers a function as a point law: force(t, d, v, **parameters) for positions d [m] and
    velocities v [m/s] of all points at once, arrays of (points,), or of (points, width) if width >
    1; it returns the forces [N] in the same shape. The first coordinate is a separation: a positive
    force pushes apart.

    tangent: arguments as for force, returns (df/dd, df/dv), each points x width x width; without it
    they are differences (exact to 1e-10 for smooth laws, one more call). power: arguments as for
    force, returns (stored energy [J], power lost in damping, in friction, supplied [W]) summed over
    the points, for the energy balance; without it the force at rest is assumed to have a potential
    (found by integration), and the part that depends on velocities is damping. The functions run
    with the GIL held: for trials, not for long motions.

    >>> import tooljoint as tj
    >>> @tj.point_law("Hardening")
    ... def hardening(t, d, v, stiffness=tj.Parameter(unit="N/m"), cubic=tj.Parameter(0.0, "N/m3")):
    ...     '''A spring that hardens.'''
    ...     return -stiffness * d - cubic * d**3
    >>> tj.law("Hardening", stiffness="2 kN/m").force(0.0, [0.1], [0.0]).tolist()
    [-200.0]

    states: numbers x of each point that change with the motion, such as the creep of a link:
    force(t, d, v, x, **parameters) then returns (forces, rates dx/dt); x and the rates are arrays
    of (points,), or of (points, states). They are part of the state of the integration and of
    checkpoints. start(t, d, v, **parameters) returns their initial values; without it they are 0.
    power(t, d, v, x, rates, **parameters) is as above; without it no energy is stored, and all work
    of the forces is damping. Tangents are always differences.

    >>> def relaxed(t, d, v, stiffness, damping):
    ...     return d
    >>> @tj.point_law("Creeping Link", states=1, start=relaxed)
    ... def creeping(t, d, v, x, stiffness=tj.Parameter(unit="N/m"),
    ...              damping=tj.Parameter(unit="N s/m")):
    ...     '''A spring and a dashpot in series; x is the stretch of the dashpot.'''
    ...     force = -stiffness * (d - x)
    ...     return force, -force / damping
    """
    if width < 1 or states < 0:
        raise UsageError(f'The point law "{name}" has width {width} and {states} states: a point '
                         'has at least 1 coordinate and 0 states.')
    if states > 0 and tangent is not None:
        raise UsageError(
            f'The point law "{name}" has states: its slopes are differences, leave tangent out.')
    if states == 0 and start is not None:
        raise UsageError(
            f'The point law "{name}" has no states to start: give states, or leave start out.')

    def register(force):
        rows, names = _parameters(force, 4 if states > 0 else 3)
        _core.register_point_law(name, _sentence(force), rows, names, width, states,
                                 _checked_force(name, force, states), tangent, power, start)
        _written.add(name)
        return force

    return register


def law(name: str, *, points: int = 1, coordinates: int = 3, **parameters: Any) -> _core.PointLaw:
    """A point law by its name in the deck, with its parameters (snake_case), for
    `model.add_points`: all points have these parameters. coordinates: largest number of coordinates
    of a point. DeckError as in a deck.

    >>> import tooljoint as tj
    >>> spring = tj.law("Spring", stiffness="3 kN/m", damping=10.0)
    >>> spring.force(0.0, [0.1], [2.0]).tolist()
    [-320.0]
    """
    return _core.point_law(name, checked(name, parameters), whole(points, "law", "points"),
                           whole(coordinates, "law", "coordinates"))


def any_written() -> bool:
    """Whether variants written in Python take part: a later process cannot know whether they have
    changed."""
    return bool(_written)
