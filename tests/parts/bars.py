# SPDX-License-Identifier: BSD-3-Clause
"""Bars of springs and masses in a row, as parts of a deck."""
import json
import pathlib

import numpy as np
from program import parameter_list


def springs_in_a_row(count, stiffness):
    """Mass [kg] and stiffness [N/m] of so many nodes with springs between them."""
    K = np.zeros((count, count))
    for i in range(count - 1):
        K[i:i + 2, i:i + 2] += stiffness * np.array([[1.0, -1.0], [-1.0, 1.0]])
    return np.diag([0.5, *[1.0] * (count - 2), 0.5]), K


def write_bar(file, M, K, **more):
    """A bar of springs in a row as a part with sets of both ends; `more` matrices by name."""
    count = len(M)
    pathlib.Path(file).write_text(
        json.dumps({
            "format": "tooljoint part 1",
            "components": ["u"],
            "dofs": [[i + 1, "u"] for i in range(count)],
            "mass": M.tolist(),
            "stiffness": K.tolist(),
            **{key: matrix.tolist() for key, matrix in more.items()},
            "interfaces": {"left": [[1, "u"]], "right": [[count, "u"]]},
        }), encoding="utf-8")


def bars(name, parts=None, **lists):
    """Two bars of 10 springs of 1e6 N/m in a row, held on the left; the second one's free end is
    retained."""
    write_bar("bar10.json", *springs_in_a_row(11, 1e6))
    imported = {
        "a": {"File": "bar10.json", "Fixed": ["left"]},
        "b": {"File": "bar10.json", "Retained": ["right"]},
    }
    whole = {
        "Parts": {"Imported": imported, "Joints": ["a:right = b:left"], **(parts or {})},
        "Transient": {"End Time": 0.02, "Step": 1e-4, "Sampling Interval": 1e-3},
        **lists,
    }
    pathlib.Path(f"{name}.xml").write_text(parameter_list(name, whole), encoding="utf-8")
    return f"{name}.xml"
