# SPDX-License-Identifier: BSD-3-Clause
"""Parts from matrices, and their reduction and coupling."""
from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from . import _core
from .arguments import list_of, real
from .errors import ModelError, UsageError
from .lists import checked, describe, placed

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from scipy.sparse import spmatrix

    MatrixLike = Union[ArrayLike, spmatrix]


def part(
    name: str, mass: MatrixLike, stiffness: MatrixLike, *, interface: Iterable[int] = (),
    retained: Iterable[int] = (), damping: MatrixLike | None = None, load: ArrayLike | None = None,
    nodes: ArrayLike | None = None, components: ArrayLike | None = None,
    component_names: Sequence[str] = ("u",)) -> _core.Part:
    """A part from its matrices.

    mass, stiffness, damping: scipy.sparse matrices or arrays, dofs x dofs [kg, N/m, N s/m]; load: a
    constant load, dofs [N]. nodes: number of the node of each dof, 1 or more; by default the nodes
    1, 2, ... in turn, each with all components. components: for each dof the position of its
    component in `component_names`; by default they repeat node by node. interface: positions of the
    dofs that may be joined with equal ones (node and component) of other parts. retained: positions
    of further dofs that remain coordinates when the part is reduced.

    ModelError for matrices of different sizes, a mass that is not symmetric, and invalid positions.
    Undamped modes are those of the symmetric part of the stiffness; `damped_modes` uses all of it.

    >>> import numpy as np, tooljoint as tj
    >>> stiffness = [[2, -1, 0], [-1, 2, -1], [0, -1, 1]]
    >>> bar = tj.part("bar", np.eye(3), stiffness, interface=[2], nodes=[1, 2, 3])
    >>> bar
    <Part "bar": 3 dofs, 1 of them interface>
    >>> bar.model.dof_names[2]
    'u of node 3'
    """
    if not isinstance(name, str):
        raise UsageError(f"part(): name is {name!r}; expected is a text.")
    size, width = (np.shape(mass) or (0,))[0], len(component_names)
    if width == 0:
        raise UsageError("part(): component_names is empty; expected is a name or more.")
    if nodes is None:
        nodes = np.arange(size) // width + 1
    nodes = _whole(nodes, "nodes")
    if min(nodes, default=1) < 1:
        raise ModelError(f"nodes has {min(nodes)}; nodes are numbered from 1 on.")
    if components is None:
        components = _repeating(nodes, width)
    model = _core.Model(mass, stiffness, nodes, _whole(components, "components"),
                        list(component_names))
    if damping is not None:
        model.add_damping(damping)
    if load is not None:
        model.add_load(load)
    return _core.Part(name, model, sorted(_whole(interface, "interface")),
                      sorted(_whole(retained, "retained")))


def _whole(values: Any, what: str) -> list[int]:
    """Whole numbers of any kind as a list of int. ModelError."""
    values = list(values) if np.iterable(values) else [values]
    for value in values:
        if isinstance(value, (bool, np.bool_)) or not isinstance(
                value,
            (int, float, np.integer, np.floating)) or not float(value).is_integer() or abs(
                float(value)) >= 2**63:
            raise ModelError(f"{what} has {value!r}; expected are whole numbers.")
    return [int(value) for value in values]


def _repeating(nodes, width):
    """0, 1, ... for the dofs of each node in their order."""
    seen = {}
    components = []
    for node in nodes:
        components.append(seen.get(node, 0))
        seen[node] = components[-1] + 1
    return components


def write_part(part: _core.Part, path: str | os.PathLike,
               interfaces: Mapping[str, Iterable[int]] | None = None,
               positions: Mapping[int, ArrayLike] | None = None) -> None:
    """Write a part for `Parts/Imported` of a deck: one file if the path ends with .h5, else a
    folder of Matrix Market files.

    interfaces: positions of dofs by the name of their set, for Parts/Joints; by default the whole
    interface as "interface". positions: coordinates [m] of nodes by their number, for pictures and
    for moved parts. The format has no point laws. A reduced part is refused: make a part of its
    `model` with `part()`.
    """
    if not isinstance(part, _core.Part):
        raise UsageError(f"write_part() takes a Part, not {part!r}. Of a reduced part, write "
                         "part(name, model.mass, model.stiffness(), ...) of its model.")
    sets = {"interface": part.interface} if interfaces is None else interfaces
    _core.write_part(
        part, str(path), {
            name: found
            for name, dofs in sets.items() if (found := _whole(dofs, f'the interface "{name}"'))
        }, dict(positions or {}))


def read_part(path: str | os.PathLike, name: str = "part",
              laws: dict[str, Any] | None = None) -> _core.Part:
    """Read a part: a file .h5 or .json, or a folder with a part.json.
    DeckError for malformed data, ModelError.

    laws: for every law of time named in the file a function of the time [s], or a number:
    `laws={"Omega": 12.5}`. A file cannot contain point laws; a warning names omitted ones.
    """
    functions = {
        law: value if callable(value) else (lambda t, value=real(value, "read_part", law): value)
        for law, value in (laws or {}).items()
    }
    return _core.read_part(str(path), name, functions)


def reduction(method: str = "Craig-Bampton", **parameters: Any) -> _core.DeckList:
    """The deck list Reduction from keyword arguments, checked as in a deck: names in snake_case of
    the list itself, of its list Mode Selection and of the list of the method. A dict is a whole
    list.

    >>> reduction("Craig-Bampton", cut_off_frequency="30 Hz").to_dict()["Mode Selection"]
    {'Cut-off Frequency': 30.0}
    >>> reduction("Craig-Bampton", mods=6)
    Traceback (most recent call last):
    ...
    tooljoint.errors.DeckError: /Reduction/Mode Selection/Mods is not a parameter. Did you mean
    "Modes"? ...
    """
    places = ["Mode Selection", method, parameters.get("interface_reduction")]
    values = placed(describe("Reduction"), {"basis": method, **parameters}, places)
    return checked("Reduction", values)


def reduce(parts: _core.Part | Sequence[_core.Part], method: str = "Craig-Bampton",
           **parameters: Any) -> _core.ReducedPart | list[_core.ReducedPart]:
    """Reduce a part, or each part of a list separately.

    method and parameters: as in `reduction()`, for example modes=6 or cut_off_frequency="30 Hz".
    Collective under MPI. Returns a ReducedPart, or a list of them. DeckError, ModelError,
    ConvergenceError.

    >>> import numpy as np, tooljoint as tj
    >>> stiffness = 2 * np.eye(5) - np.eye(5, k=1) - np.eye(5, k=-1)
    >>> chain = tj.part("chain", np.eye(5), stiffness, interface=[0, 4])
    >>> tj.reduce(chain, modes=2)
    <ReducedPart "chain": 4 coordinates, 2 of them modes>
    """
    if isinstance(parts, _core.Part):
        return _core.reduce([parts], reduction(method, **parameters))[0]
    return _core.reduce(list_of(parts, ("Part",), "reduce", "parts"),
                        reduction(method, **parameters))


def _joining(coupling):
    if coupling is None or isinstance(coupling, _core.Connections):
        return coupling
    if not isinstance(coupling, dict):
        raise UsageError(f"coupling is {coupling!r}; expected is the deck list Coupling as a dict, "
                         "or what joins the parts of Deck.at_rest().")
    return checked("Coupling", coupling)


def couple(parts: Iterable[Any], coupling: dict | _core.Connections | None = None) -> _core.Model:
    """The model of parts joined by equal labels of their interface dofs: the full model for
    unreduced parts, the reduced one for reduced parts. coupling: the deck list Coupling as a dict
    (only for unreduced parts) with springs, hinges, constraints, frames and point laws. ModelError
    names dofs that cannot be joined."""
    parts = list_of(parts, ("Part", "ReducedPart"), "couple", "parts")
    reduced = [isinstance(part, _core.ReducedPart) for part in parts]
    if any(reduced) and not all(reduced):
        raise UsageError(
            "Some of the parts are reduced and some are not. Reduce all of them, or none.")
    if any(reduced):
        if coupling is not None:
            raise UsageError("Reduced parts are joined by their labels alone. Give the coupling to "
                             "synthesise(), which reduces and couples.")
        return _core.couple_reduced(parts)
    return _core.couple(parts, _joining(coupling))


def synthesise(parts: Sequence[_core.Part], method: str = "Craig-Bampton",
               coupling: dict | _core.Connections | None = None,
               **parameters: Any) -> _core.Synthesis:
    """Component mode synthesis: reduce the parts, couple them, augment bases that need the coupled
    model, reduce the interface if requested. parameters: as in `reduction()`; frequency_tolerance
    chooses the modes by the estimated error. Collective under MPI.

    >>> import numpy as np, tooljoint as tj
    >>> K = 2 * np.eye(5) - np.eye(5, k=1) - np.eye(5, k=-1)
    >>> left = tj.part("left", np.eye(5), K, nodes=[1, 2, 3, 4, 5], interface=[4])
    >>> right = tj.part("right", np.eye(5), K, nodes=[5, 6, 7, 8, 9], interface=[0])
    >>> both = tj.synthesise([left, right], modes=2)
    >>> both
    <Synthesis of 2 parts, 5 dofs>
    """
    return _core.synthesise(list_of(parts, ("Part",), "synthesise", "parts"),
                            reduction(method, **parameters), _joining(coupling))
