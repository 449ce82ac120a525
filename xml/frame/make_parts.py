#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the parts of ../frame.xml: straight members of a steel frame in space, each a folder with
part.json and Matrix Market files.

A member lies along x of its own frame. Euler beam elements of length h, bending stiffness E I_z in
the x-y plane and E I_y in the x-z plane:

    K_b = E I / h^3 [12 6h -12 6h; 6h 4h^2 -6h 2h^2; ...],
    M_b = rho A h / 420 [156 22h 54 -13h; 22h 4h^2 13h -3h^2; ...],

axial and torsional bars with consistent mass. Damping is 0.5 1/s M + 2e-5 s K.

    make_parts.py [FOLDER]      FOLDER: where the members go, by default beside this script
"""
import json
import pathlib
import sys

import numpy as np
from scipy.io import mmwrite
from scipy.sparse import coo_matrix

E, NU, RHO = 2.1e11, 0.3, 7850.0
# a bar of 0.06 m along y and 0.10 m along z
A, IY, IZ = 0.10 * 0.06, 0.06 * 0.10**3 / 12, 0.10 * 0.06**3 / 12
TORSION, POLAR = 1.88e-7 * 24.0, IY + IZ
COMPONENTS = ["u", "v", "w", "theta_x", "theta_y", "theta_z"]


def bending(h, stiffness, mass):
    """Matrices of (deflection, slope) at both ends."""
    k = stiffness / h**3 * np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                                     [-12, -6 * h, 12, -6 * h],
                                     [6 * h, 2 * h * h, -6 * h, 4 * h * h]])
    m = mass * h / 420 * np.array([
        [156, 22 * h, 54, -13 * h],
        [22 * h, 4 * h * h, 13 * h, -3 * h * h],
        [54, 13 * h, 156, -22 * h],
        [-13 * h, -3 * h * h, -22 * h, 4 * h * h],
    ])
    return k, m


def element(h):
    """K and M of one element, 12 x 12, node by node."""
    K, M = np.zeros((12, 12)), np.zeros((12, 12))
    for c, stiffness, mass in ((0, E * A, RHO * A), (3, E / 2 / (1 + NU) * TORSION, RHO * POLAR)):
        at = np.ix_([c, c + 6], [c, c + 6])
        K[at] += stiffness / h * np.array([[1, -1], [-1, 1]])
        M[at] += mass * h / 6 * np.array([[2, 1], [1, 2]])
    for deflection, slope, inertia, sign in ((1, 5, IZ, 1.0), (2, 4, IY, -1.0)):  # dw/dx = -theta_y
        turn = np.diag([1.0, sign, 1.0, sign])
        k, m = bending(h, E * inertia, RHO * A)
        at = np.ix_([deflection, slope, deflection + 6, slope + 6],
                    [deflection, slope, deflection + 6, slope + 6])
        K[at] += turn @ k @ turn
        M[at] += turn @ m @ turn
    return K, M


def member(folder, length, elements, sets, tip_mass=0.0):
    """Writes one member; `sets` are its interface sets as lists of nodes, counted from 1."""
    n = 6 * (elements + 1)
    K, M = np.zeros((n, n)), np.zeros((n, n))
    for e in range(elements):
        ke, me = element(length / elements)
        K[6 * e:6 * e + 12, 6 * e:6 * e + 12] += ke
        M[6 * e:6 * e + 12, 6 * e:6 * e + 12] += me
    for c in range(3):
        M[n - 6 + c, n - 6 + c] += tip_mass
    folder.mkdir(parents=True, exist_ok=True)
    for name, matrix in (("K", K), ("M", M), ("C", 0.5 * M + 2e-5 * K)):
        mmwrite(str(folder / f"{name}.mtx"), coo_matrix(matrix), symmetry="symmetric", precision=16)
    part = {
        "format": "tooljoint part 1", "components": COMPONENTS,
        "dofs": [[node + 1, c] for node in range(elements + 1) for c in COMPONENTS],
        "mass": "M.mtx", "stiffness": "K.mtx", "damping": "C.mtx", "interfaces": sets,
        "positions": [[node + 1, length * node / elements, 0.0, 0.0] for node in range(elements + 1)
                      ]
    }
    (folder / "part.json").write_text(json.dumps(part) + "\n", encoding="utf-8")


if __name__ == "__main__":
    here = pathlib.Path(
        sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent
    member(here / "column", 3.0, 6, {"foot": [1], "middle": [4], "head": [7]})
    member(here / "beam", 4.0, 8, {"left": [1], "right": [9]})
    member(here / "arm", 1.5, 4, {"root": [1]}, tip_mass=40.0)
