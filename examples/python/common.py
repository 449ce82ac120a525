# SPDX-License-Identifier: BSD-3-Clause
"""Common parts of the examples: options, figures, and plane beam elements."""
import argparse
import pathlib
import sys

import numpy as np
import scipy.sparse as sparse
from tooljoint import plots


def options(text):
    """--short: a coarse model and few runs; --output: folder of the figures."""
    parser = argparse.ArgumentParser(description=text,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--short", action="store_true", help="a coarse model and few runs: seconds")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("results/python"),
                        help="folder of figures and results (default: results/python)")
    given = parser.parse_args(
        [] if "ipykernel" in sys.modules else None)  # ignores the arguments of a notebook kernel
    given.output.mkdir(parents=True, exist_ok=True)
    return given


def figure(columns):
    """A figure in the style of the project, with so many axes side by side."""
    plots.use_style()
    return plots.plt.subplots(1, columns, figsize=(5 * columns, 4), constrained_layout=True)


def save(made, given, name):
    plots.save(made, given.output / f"{name}.png")
    print(f"{given.output / name}.png")


def line(begin, end):
    """Length and direction cosines."""
    x, y = np.subtract(end, begin)
    length = np.hypot(x, y)
    return length, (x / length, y / length)


def beam(length, elements, EA, EI, mass, c=1.0, s=0.0):
    """K and M of plane Euler-Bernoulli elements (u, v, theta) in axes in which the beam has the
    direction cosines (c, s)."""
    l = length / elements
    K, M = np.zeros((6, 6)), np.zeros((6, 6))
    axial, bending = np.ix_([0, 3], [0, 3]), np.ix_([1, 2, 4, 5], [1, 2, 4, 5])
    K[axial] = EA / l * np.array([[1, -1], [-1, 1]])
    M[axial] = mass * l / 6 * np.array([[2, 1], [1, 2]])
    K[bending] = EI / l**3 * np.array([
        [12, 6 * l, -12, 6 * l],
        [6 * l, 4 * l * l, -6 * l, 2 * l * l],
        [-12, -6 * l, 12, -6 * l],
        [6 * l, 2 * l * l, -6 * l, 4 * l * l],
    ])
    M[bending] = mass * l / 420 * np.array([
        [156, 22 * l, 54, -13 * l],
        [22 * l, 4 * l * l, 13 * l, -3 * l * l],
        [54, 13 * l, 156, -22 * l],
        [-13 * l, -3 * l * l, -22 * l, 4 * l * l],
    ])
    turn = np.kron(np.eye(2), [[c, s, 0], [-s, c, 0], [0, 0, 1]])
    return tuple(
        assemble([(turn.T @ each @ turn, np.arange(3 * e, 3 * e + 6))
                  for e in range(elements)], 3 * (elements + 1)) for each in (K, M))


def assemble(elements, size):
    """The sum of element matrices (matrix, dofs) as a sparse matrix."""
    rows = np.concatenate([np.repeat(dofs, len(dofs)) for _, dofs in elements])
    columns = np.concatenate([np.tile(dofs, len(dofs)) for _, dofs in elements])
    return sparse.csr_matrix(
        (np.concatenate([matrix.ravel() for matrix, _ in elements]), (rows, columns)),
        shape=(size, size))
