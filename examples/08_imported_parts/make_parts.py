# SPDX-License-Identifier: BSD-3-Clause
"""Writes two halves of a clamped-free rod: one as a folder of Matrix Market files, one as an HDF5
file."""
import json
import pathlib

import h5py
import numpy as np
from scipy.io import mmwrite

# stiffness E A [N], mass per length [kg/m], length of an element [m], elements of each half
EA, MASS, H, N = 2.1e8, 7.85, 0.5, 100
K = EA / H * (np.diag([1.0] + [2.0] *
                      (N - 1) + [1.0]) - np.diag([1.0] * N, 1) - np.diag([1.0] * N, -1))
M = MASS * H / 6 * (np.diag([2.0] + [4.0] *
                            (N - 1) + [2.0]) + np.diag([1.0] * N, 1) + np.diag([1.0] * N, -1))

folder = pathlib.Path("upper")
folder.mkdir(exist_ok=True)
mmwrite(folder / "K.mtx", K, symmetry="symmetric", precision=16)
mmwrite(folder / "M.mtx", M, symmetry="symmetric", precision=16)
part = {
    "format": "tooljoint part 1", "components": ["u"],
    "dofs": [[node, "u"] for node in range(1, N + 2)], "mass": "M.mtx", "stiffness": "K.mtx",
    "interfaces": {"top": [1], "bottom": [N + 1]}
}
(folder / "part.json").write_text(json.dumps(part), encoding="utf-8")

with h5py.File("lower.h5", "w") as file:
    file.attrs["format"] = "tooljoint part 1"
    file["components"] = ["u"]
    file["dofs"] = [[node, 1] for node in range(1, N + 2)]
    file["mass"], file["stiffness"] = M, K
    file["interfaces/top"], file["interfaces/bottom"] = [1], [N + 1]
