#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes somebody's own vectors for the basis "User Vectors" of ../cms_variants.xml and
../cms_variants_frame.xml: half waves along a member of length l,

    sin(k pi x / l),   k = 1, 2, ...,

each as a deflection in both directions (with its slope as rotation), a twist and a stretch. A row
for each dof of the part, node by node.

    make_vectors.py [FOLDER]      FOLDER: where the files go, by default beside this script
"""
import pathlib
import sys

import numpy as np

COMPONENTS = ["u", "v", "w", "theta_x", "theta_y", "theta_z"]
# a motion along the axis, and what the rotations of a deflection are: (deflection, rotation, sign)
# of rotation = sign * slope
ALONG_X = ("u", "theta_x", [("v", "theta_z", 1.0), ("w", "theta_y", -1.0)])  # members of the frame
ALONG_Z = ("w", "theta_z", [("u", "theta_y", 1.0), ("v", "theta_x", -1.0)])  # strings


def half_waves(file, positions, axes, waves=5):
    """Writes the vectors of a part with nodes at these positions; None stands for a node that is
    held and has no rows."""
    stretch, twist, deflections = axes
    length = positions[-1]
    columns = []
    for k in range(1, waves + 1):
        for shapes in ([{c: 0, turn: sign}
                        for c, turn, sign in deflections] + [{twist: 0}, {stretch: 0}]):
            column = []
            for x in positions:
                if x is None:
                    continue
                wave, slope = np.sin(
                    k * np.pi * x / length), k * np.pi / length * np.cos(k * np.pi * x / length)
                column += [
                    0.0 if c not in shapes else (shapes[c] * slope if shapes[c] else wave)
                    for c in COMPONENTS
                ]
            columns.append(column)
    numbers = [
        f"{value:.9g}" if abs(value) > 1e-12 else "0" for column in columns for value in column
    ]
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(
        f"%%MatrixMarket matrix array real general\n{len(columns[0])} {len(columns)}\n" +
        "\n".join(numbers) + "\n", encoding="utf-8")


if __name__ == "__main__":
    here = pathlib.Path(
        sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent
    for name in ("left column", "right column"):
        half_waves(here / f"{name}.mtx", [None, *np.linspace(0.5, 3, 6)], ALONG_X)
    for name in ("top beam", "middle beam"):
        half_waves(here / f"{name}.mtx", np.linspace(0, 4, 9), ALONG_X)
    half_waves(here / "arm.mtx", np.linspace(0, 1.5, 5), ALONG_X)
    half_waves(here / "pipe.mtx", np.cumsum([0, *5 * [1.8], 0.2, 0.3, 0.3, 0.2]), ALONG_Z)
