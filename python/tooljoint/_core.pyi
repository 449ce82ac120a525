# SPDX-License-Identifier: BSD-3-Clause
# Written by tests/python/test_stub.py --update.
from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy
import scipy.sparse
from numpy.typing import ArrayLike

class Connections:
    """Connections of the parts of a deck in addition to equal labels."""


class DeckList:
    """A checked deck list with defaults, in SI."""
    def to_dict(self) -> dict:
        """The values of the list; sublists are dicts."""


class DeckSource:
    """A deck: a file, or a text that replaces it, and changes."""
    def __init__(self, file: str, text: str, overrides: Iterable[str]) -> None: ...


class Model:
    """M q'' + C(t) q' + K(t) q = F(t) + point forces; full, reduced or coupled."""
    def __init__(self, mass: Any, stiffness: Any, nodes: Iterable[int], components: Iterable[int], component_names: Iterable[str]) -> None: ...
    def __len__(self) -> int: ...
    def __repr__(self) -> str: ...
    def add_damping(self, matrix: Any, name: str = 'damping', law: Any = None) -> None:
        """Add law(t) C; without a law C is constant. ModelError."""
    def add_load(self, vector: ArrayLike, name: str = 'load', law: Any = None) -> None:
        """Add law(t) F [N]; without a law F is constant. Equal names mean one law. ModelError."""
    def add_points(self, name: str, law: PointLaw, rows: Any, offset: ArrayLike = ..., nodes: Iterable[int] = []) -> None:
        """Add points with the forces rows^T f(d, d', t), d = offset + rows q [m]. ModelError."""
    def add_stiffness(self, matrix: Any, name: str, law: Any = None) -> None:
        """Add law(t) K; without a law K is constant. ModelError."""
    @property
    def component_names(self) -> list[str]:
        """Names of the components of a node."""
    @property
    def component_units(self) -> list[str]:
        """SI unit of each component of a node."""
    def copy(self) -> Model:
        """An independent model; matrices are shared until one of the models is changed."""
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
    """A part before its reduction: a model with an interface and retained dofs."""
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
        """The model; changes of it change the part."""
    @property
    def name(self) -> str:
        """Name of the part."""
    @property
    def retained(self) -> numpy.ndarray:
        """Positions of further dofs that remain coordinates."""


class PartView:
    """Data of a part for a basis; each is computed once, at its first use."""
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
    """Forces f(t, d, v) of points with a common law."""
    def force(self, t: float, d: ArrayLike, v: ArrayLike) -> numpy.ndarray:
        """Forces [N] at positions d [m] and velocities v [m/s], points x width in one row."""
    @property
    def size(self) -> int:
        """Number of points."""
    @property
    def width(self) -> int:
        """Coordinates of a point."""


class ReadDeck:
    """A deck after reading and checking."""
    @property
    def description(self) -> str:
        """The description of the lists as JSON."""
    def gives(self, path: str) -> bool:
        """Whether the deck or a change gives this value; False for a default."""
    @property
    def name(self) -> str:
        """Name of the root list."""
    @property
    def text(self) -> str:
        """The text of the file without the changes."""
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
        """Frequencies of the kept modes [Hz]; negative if omega^2 is negative."""
    @property
    def interface(self) -> int:
        """Number of interface coordinates, which come first and may be joined."""
    @property
    def method(self) -> str:
        """How the modes were computed."""
    @property
    def model(self) -> Model:
        """The reduced model."""
    @property
    def modes(self) -> int:
        """Number of modal coordinates, which come last."""
    @property
    def name(self) -> str:
        """Name of the part."""
    @property
    def offset(self) -> numpy.ndarray:
        """D at q = 0, dofs of the part [m]."""
    @property
    def remarks(self) -> list[str]:
        """Remarks on the basis for the user."""
    @property
    def retained(self) -> int:
        """Number of retained dofs, which follow the interface."""
    def table(self, all: bool = False) -> str:
        """Every vector: kind, name, frequency, whether it is kept, reason."""


class RestingCase:
    """The case of a deck at rest."""
    @property
    def displacement(self) -> numpy.ndarray:
        """Displacements at rest, rows of the recovery."""
    def full(self) -> Model:
        """The full model."""
    def parts(self) -> tuple:
        """The parts and their connections."""


class ResultsFile:
    """A file results.h5."""
    def __init__(self, path: str) -> None: ...
    def datasets(self) -> list[str]:
        """Paths of all datasets."""
    def has(self, path: str) -> bool:
        """Whether a dataset or group exists."""
    def long_name(self, path: str) -> str:
        """Description of a dataset in words."""
    def read(self, path: str) -> Any:
        """All values of a dataset. FileError."""
    def unit(self, path: str) -> str:
        """SI unit of a dataset; empty without a unit."""


class Synthesis:
    """Reduced parts and their coupled model."""
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
        """Rounds of the selection of modes by a tolerance: modes and frequency_error."""
    @property
    def unreduced(self) -> list[Part]:
        """The parts before their reduction."""


def abort(code: int) -> None:
    """End all ranks with this exit code."""

def analyse(what: str, deck: DeckSource, output: str, fresh: bool, shared_timing: bool, quiet: bool) -> None:
    """Compute "study", "map", "campbell" or "response" of a deck into a folder."""

def basis_names() -> list[str]:
    """Names of the available bases."""

def check(deck: DeckSource, quiet: bool) -> None:
    """Raise the errors of a run."""

def compare_modes(synthesis: Synthesis, count: int, t: float | None = None, full: Model | None = None) -> list:
    """Modes of the full model, each with the coupled mode of the same shape."""

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
    """The description of a list as JSON, like `tooljoint doc --format json`."""

def modal_assurance(mass: Any, a: ArrayLike, b: ArrayLike) -> numpy.ndarray:
    """M-weighted modal assurance criterion, columns of a x columns of b."""

def parse_list(xml: str, name: str) -> DeckList:
    """Check a list in XML against the description of the list `name`. DeckError."""

def point_law(name: str, parameters: DeckList, points: int, coordinates: int) -> PointLaw:
    """A point law from the registry."""

def point_law_names() -> list[str]:
    """Names of the available laws."""

def rank() -> int:
    """Number of this rank, from 0."""

def ranks() -> int:
    """Number of ranks."""

def read_deck(deck: DeckSource) -> ReadDeck:
    """Read and check a deck. DeckError, FileError."""

def read_part(path: str, name: str, laws: dict = {}) -> Part:
    """Read a part; its interface consists of all its interface sets."""

def reduce(parts: Iterable[Part], reduction: DeckList) -> list[ReducedPart]:
    """Reduce parts separately with the settings of the list Reduction."""

def register_basis(name: str, doc: str, parameters: list, keywords: dict, build: Any) -> None:
    """Register a basis written in Python."""

def register_point_law(name: str, doc: str, parameters: list, keywords: dict, width: int, states: int, force: Any, tangent: Any, power: Any, start: Any) -> None:
    """Register a law written in Python."""

def run(deck: DeckSource, output: str, restart: str, quiet: bool) -> str:
    """Run a deck; returns the folder of its results."""

def solve_static(deck: DeckSource) -> RestingCase:
    """Solve the static state of a deck; returns the case at rest."""

def synthesise(parts: Iterable[Part], reduction: DeckList, coupling: DeckList | Connections | None = None) -> Synthesis:
    """Reduce, couple and estimate."""

def undamped_modes(model: Model, count: int) -> tuple:
    """omega^2, shapes (dofs x modes) and residuals of the lowest undamped modes."""

def version() -> str:
    """Version of the library."""

def warnings() -> list[str]:
    """Warnings of the last long call on this rank."""

def write_part(part: Part, path: str, interfaces: dict[str, Iterable[int]], positions: dict[int, ArrayLike]) -> None:
    """Write a part: a file .h5, or a folder."""
