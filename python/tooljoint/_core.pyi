# SPDX-License-Identifier: BSD-3-Clause
# Written by tests/python/test_stub.py --update.
from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy
import scipy.sparse
from numpy.typing import ArrayLike

class Connections:
    """What joins the parts of a deck beside equal labels."""


class DeckList:
    """A deck list that has been checked, defaults filled in, in SI."""
    def to_dict(self) -> dict:
        """The values of the list; sublists are dicts."""


class DeckSource:
    """A deck: a file, or a text in its place, and changes of it."""
    def __init__(self, file: str, text: str, overrides: Iterable[str]) -> None: ...


class Model:
    """M q'' + C(t) q' + K(t) q = F(t) + point forces; full, reduced or coupled."""
    def __init__(self, mass: Any, stiffness: Any, nodes: Iterable[int], components: Iterable[int], component_names: Iterable[str]) -> None: ...
    def __len__(self) -> int: ...
    def __repr__(self) -> str: ...
    def add_damping(self, matrix: Any, name: str = 'damping', law: Any = None) -> None:
        """Add law(t) C; without a law C is constant. ModelError."""
    def add_load(self, vector: ArrayLike, name: str = 'load', law: Any = None) -> None:
        """Add law(t) F [N]; without a law F is constant. Laws of one name are one law. ModelError."""
    def add_points(self, name: str, law: PointLaw, rows: Any, offset: ArrayLike = ..., nodes: Iterable[int] = []) -> None:
        """Add points with the forces rows' f(d, d', t), d = offset + rows q [m]. ModelError."""
    def add_stiffness(self, matrix: Any, name: str, law: Any = None) -> None:
        """Add law(t) K; without a law K is constant. ModelError."""
    @property
    def component_names(self) -> list[str]:
        """Names of the components of a node."""
    @property
    def component_units(self) -> list[str]:
        """SI unit of each component of a node."""
    def copy(self) -> Model:
        """A model of its own; matrices are shared until one of them is changed."""
    def damping(self, t: float = 0.0) -> scipy.sparse.csr_matrix:
        """C(t), dofs x dofs [N s/m]."""
    @property
    def damping_terms(self) -> dict:
        """Constant matrices of the damping by name."""
    @property
    def dof_names(self) -> list[str]:
        """"u of node 3", one for each dof."""
    @property
    def dof_units(self) -> list[str]:
        """SI unit of each dof."""
    @property
    def initial_displacement(self) -> numpy.ndarray:
        """q(0) [m], dofs."""
    @property
    def initial_velocity(self) -> numpy.ndarray:
        """q'(0) [m/s], dofs."""
    def load(self, t: float = 0.0) -> numpy.ndarray:
        """F(t), dofs [N]."""
    @property
    def mass(self) -> scipy.sparse.csr_matrix:
        """M, dofs x dofs [kg]."""
    def point_force(self, t: float, q: ArrayLike, v: ArrayLike) -> numpy.ndarray:
        """Forces of the point laws on the dofs at this state [N]."""
    def position(self, node: int, component: str) -> int:
        """Position of a dof of a node. ModelError."""
    @property
    def recovery(self) -> scipy.sparse.csr_matrix:
        """Rows (node, component) x dofs: D = recovery_offset + recovery q."""
    @property
    def recovery_nodes(self) -> numpy.ndarray:
        """Numbers of the recovered nodes."""
    @property
    def recovery_offset(self) -> numpy.ndarray:
        """D at q = 0, rows of the recovery."""
    def set_start(self, displacement: ArrayLike, velocity: ArrayLike) -> None:
        """q(0) [m] and q'(0) [m/s], dofs. ModelError."""
    def stiffness(self, t: float = 0.0) -> scipy.sparse.csr_matrix:
        """K(t), dofs x dofs [N/m]."""
    @property
    def stiffness_terms(self) -> dict:
        """Constant matrices of the stiffness by name."""


class Part:
    """A part before its reduction: a model, and which of its dofs may be joined."""
    def __init__(self, name: str, model: Model, interface: Iterable[int], retained: Iterable[int]) -> None: ...
    def __len__(self) -> int: ...
    def __repr__(self) -> str: ...
    @property
    def interface(self) -> numpy.ndarray:
        """Positions of the dofs that may be joined."""
    @property
    def interior(self) -> numpy.ndarray:
        """Positions of all other dofs."""
    @property
    def model(self) -> Model:
        """Its model; changes of it are changes of the part."""
    @property
    def name(self) -> str:
        """Name of the part."""
    @property
    def retained(self) -> numpy.ndarray:
        """Positions of further dofs that stay as they are."""


class PartView:
    """What a basis needs of a part; each is computed once, at its first use."""
    @property
    def boundary(self) -> numpy.ndarray:
        """Positions of interface and retained dofs."""
    @property
    def constraint_modes(self) -> scipy.sparse.csr_matrix:
        """Static shapes of unit motions of the boundary, dofs x boundary."""
    @property
    def interior(self) -> numpy.ndarray:
        """Positions of the interior dofs."""
    @property
    def interior_mass(self) -> scipy.sparse.csr_matrix:
        """M_II, interior x interior [kg]."""
    @property
    def interior_stiffness(self) -> scipy.sparse.csr_matrix:
        """sym(K)_II, interior x interior [N/m]."""
    @property
    def mass(self) -> scipy.sparse.csr_matrix:
        """M, dofs x dofs [kg]."""
    @property
    def name(self) -> str:
        """Name of the part."""
    def solve_interior(self, loads: ArrayLike) -> numpy.ndarray:
        """sym(K)_II^-1 f for the columns of loads, interior x columns."""
    @property
    def stiffness(self) -> scipy.sparse.csr_matrix:
        """sym(K), dofs x dofs [N/m]."""


class PointLaw:
    """Forces of points f(t, d, v), all of one law."""
    def force(self, t: float, d: ArrayLike, v: ArrayLike) -> numpy.ndarray:
        """Forces [N] at positions d [m] and velocities v [m/s], points x width in one row."""
    @property
    def size(self) -> int:
        """Number of points."""
    @property
    def width(self) -> int:
        """Coordinates of a point."""


class ReadDeck:
    """A deck that has been read and checked."""
    @property
    def description(self) -> str:
        """The description of its lists as JSON."""
    def gives(self, path: str) -> bool:
        """Whether the deck or a change gives this, and not a default."""
    @property
    def name(self) -> str:
        """Name of its root list."""
    @property
    def text(self) -> str:
        """The file as it was read, changes not applied."""
    def to_dict(self) -> Any:
        """All values in SI, defaults included; lists are dicts."""
    def where(self, path: str) -> str:
        """"deck.xml:42: /Scene/Contact/Stiffness"."""


class ReducedPart:
    """A reduced part, D = offset + basis q with q = (interface, retained, modes)."""
    def __len__(self) -> int: ...
    def __repr__(self) -> str: ...
    @property
    def basis(self) -> scipy.sparse.csr_matrix:
        """Phi, dofs of the part x coordinates."""
    @property
    def frequencies_hz(self) -> numpy.ndarray:
        """Frequencies of the kept modes [Hz]; negative where omega^2 is."""
    @property
    def interface(self) -> int:
        """The first so many coordinates may be joined."""
    @property
    def method(self) -> str:
        """How the modes were computed."""
    @property
    def model(self) -> Model:
        """The reduced model."""
    @property
    def modes(self) -> int:
        """The last so many are modal."""
    @property
    def name(self) -> str:
        """Name of the part."""
    @property
    def offset(self) -> numpy.ndarray:
        """D at q = 0, dofs of the part [m]."""
    @property
    def remarks(self) -> list[str]:
        """Sentences on the basis that a user should read."""
    @property
    def retained(self) -> int:
        """The next so many are dofs of the part."""
    def table(self, all: bool = False) -> str:
        """Every vector: kind, name, frequency, kept or dropped and why."""


class RestingCase:
    """The case of a deck at rest."""
    @property
    def displacement(self) -> numpy.ndarray:
        """Displacements at rest, rows of the recovery."""
    def full(self) -> Model:
        """The full model."""
    def parts(self) -> tuple:
        """Its parts, and what joins them."""


class ResultsFile:
    """A file results.h5."""
    def __init__(self, path: str) -> None: ...
    def datasets(self) -> list[str]:
        """Paths of all datasets."""
    def has(self, path: str) -> bool:
        """Whether there is such a dataset or group."""
    def long_name(self, path: str) -> str:
        """What a dataset holds, in words."""
    def read(self, path: str) -> Any:
        """All values of a dataset. FileError."""
    def unit(self, path: str) -> str:
        """SI unit of a dataset; empty when it has none."""


class Synthesis:
    """Reduced parts and the model they are coupled to."""
    def __repr__(self) -> str: ...
    def map(self, part: int) -> scipy.sparse.csr_matrix:
        """Coordinates of a part x coordinates of the coupled model."""
    @property
    def model(self) -> Model:
        """The coupled reduced model."""
    @property
    def parts(self) -> list[ReducedPart]:
        """The reduced parts."""
    @property
    def remarks(self) -> list[str]:
        """Remarks of the coupling: redundant constraints, for example."""
    @property
    def rounds(self) -> list:
        """Rounds of the choice of modes by a tolerance: modes and frequency_error."""
    @property
    def unreduced(self) -> list[Part]:
        """The parts as they were reduced."""


def abort(code: int) -> None:
    """End all ranks with this exit code."""

def analyse(what: str, deck: DeckSource, output: str, fresh: bool, shared_timing: bool, quiet: bool) -> None:
    """Compute "study", "map", "campbell" or "response" of a deck into a folder."""

def basis_names() -> list[str]:
    """Names of the bases there are."""

def check(deck: DeckSource, quiet: bool) -> None:
    """Refuse what a run would refuse."""

def compare_modes(synthesis: Synthesis, count: int, t: float | None = None, full: Model | None = None) -> list:
    """Modes of the full model, each with the coupled mode of its shape."""

def couple(parts: Iterable[Part], coupling: DeckList | Connections | None = None) -> Model:
    """Couple unreduced parts: the full model."""

def couple_reduced(parts: Iterable[ReducedPart]) -> Model:
    """Couple reduced parts."""

def damped_modes(model: Model, count: int, t: float) -> tuple:
    """s, shapes (dofs x modes) and residuals of the damped modes of smallest |s|."""

def estimate_frequencies(synthesis: Synthesis, count: int) -> list:
    """Estimated errors of the lowest coupled frequencies, without the full model."""

def integrate(model: Model, transient: DeckList) -> tuple:
    """Time, displacement, velocity and acceleration (samples x dofs), and a report."""

def list_description(name: str) -> str:
    """The description of a list as JSON, as `tooljoint doc --format json`."""

def modal_assurance(mass: Any, a: ArrayLike, b: ArrayLike) -> numpy.ndarray:
    """M-weighted modal assurance criterion, columns of a x columns of b."""

def parse_list(xml: str, name: str) -> DeckList:
    """Check a list given as XML against the description of that name. DeckError."""

def point_law(name: str, parameters: DeckList, points: int, coordinates: int) -> PointLaw:
    """A law of the registry."""

def point_law_names() -> list[str]:
    """Names of the laws there are."""

def rank() -> int:
    """Number of this rank, from 0."""

def ranks() -> int:
    """Number of ranks."""

def read_deck(deck: DeckSource) -> ReadDeck:
    """Read and check a deck. DeckError, FileError."""

def read_part(path: str, name: str, laws: dict = {}) -> Part:
    """Read a part; its interface are all its interface sets."""

def reduce(parts: Iterable[Part], reduction: DeckList) -> list[ReducedPart]:
    """Reduce parts, each by itself, as the list Reduction says."""

def register_basis(name: str, doc: str, parameters: list, keywords: dict, build: Any) -> None:
    """Register a basis written in Python."""

def register_point_law(name: str, doc: str, parameters: list, keywords: dict, width: int, states: int, force: Any, tangent: Any, power: Any, start: Any) -> None:
    """Register a law written in Python."""

def run(deck: DeckSource, output: str, restart: str, quiet: bool) -> str:
    """Run a deck; the folder of its results."""

def solve_static(deck: DeckSource) -> RestingCase:
    """The case of a deck, brought to rest."""

def synthesise(parts: Iterable[Part], reduction: DeckList, coupling: DeckList | Connections | None = None) -> Synthesis:
    """Reduce, couple and estimate."""

def undamped_modes(model: Model, count: int) -> tuple:
    """omega^2, shapes (dofs x modes) and residuals of the lowest undamped modes."""

def version() -> str:
    """Version of the library."""

def warnings() -> list[str]:
    """Sentences the last long call has warned with, on this rank."""

def write_part(part: Part, path: str, interfaces: dict[str, Iterable[int]], positions: dict[int, ArrayLike]) -> None:
    """Write a part: a file .h5, or a folder."""
