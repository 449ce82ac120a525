# SPDX-License-Identifier: BSD-3-Clause
"""Pipes between hinges for `tooljoint buckling`, and theoretical wall forces, for check_buckling.py
and docs/validation.md."""
import csv
import math
import pathlib

import h5py
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import eigsh

BORE, OUTER, INNER, YOUNG, DENSITY, GRAVITY = 0.1, 0.05, 0.04, 2.1e11, 7850.0, 9.81
AREA = math.pi * (OUTER**2 - INNER**2)
RIGIDITY = YOUNG * math.pi / 4 * (OUTER**4 - INNER**4)
WEIGHT = DENSITY * AREA * GRAVITY
CLEARANCE = BORE - OUTER


def parameter(name, value, kind="string"):
    return f'<Parameter name="{name}" type="{kind}" value="{value}"/>'


def listed(name, *content):
    return f'<ParameterList name="{name}">' + "".join(content) + "</ParameterList>"


def deck(name, length, elements, last, inclination=0.0, gravity=GRAVITY, bit="u v", contact=True,
         radius=None):
    """A uniform pipe between hinges in a straight hole, or in one that builds with this radius up
    to this inclination at the bit."""
    shape = listed("Vertical", parameter("Length", f"{length} m"),
                   parameter("Inclination", f"{inclination} deg"))
    if radius:
        shape = listed(
            "Arc", parameter("Radius", f"{radius} m"),
            parameter("Start Inclination", f"{inclination - math.degrees(length / radius)} deg"),
            parameter("End Inclination", f"{inclination} deg"), parameter("Tangent Length", "1 m"))
    well = listed("Well", parameter("Trajectory", "Arc" if radius else "Vertical"), shape,
                  parameter("Bore Radius", f"{BORE} m"))
    pipe = listed("pipe", parameter("Length", f"{length} m"),
                  parameter("Elements", elements, "int"), parameter("Outer Radius", f"{OUTER} m"),
                  parameter("Inner Radius", f"{INNER} m"),
                  parameter("Shear Deformation", "false", "bool"))
    string = listed(
        "Drillstring", listed("Components", pipe), parameter("Assembly", "{pipe}", "Array(string)"),
        listed("Material", parameter("Density", f"{DENSITY} kg/m3"),
               parameter("Young Modulus", f"{YOUNG} Pa")))
    supports = listed("Supports", parameter("Top", "u v w theta_z"), parameter("Bit", bit))
    text = listed(name, well, string, supports,
                  listed("Contact", parameter("Stiffness", "1e7 N/m")) if contact else "",
                  listed("Loads", parameter("Gravity", f"{gravity} m/s2")),
                  listed("Buckling", parameter("Last Weight On Bit", f"{last} N")) if last else "")
    file = pathlib.Path(f"{name}.xml")
    file.write_text('<?xml version="1.0"?>\n' + text.replace("><", ">\n<"), encoding="utf-8")
    return str(file)


def rows(folder, table="buckling.csv"):
    with open(pathlib.Path(folder) / table, encoding="utf-8", newline="") as file:
        return [{key.split(" [")[0]: float(value) if value else None for key, value in row.items()}
                for row in csv.DictReader(file)]


def shape_contact(folder, states, length, inclination=90.0):
    """Contact force per length of the middle half by the equilibrium of a pipe on its wall that
    winds by the angle a(s) from the low side (R. F. Mitchell, SPE Drilling & Completion 12, 1997):
    n = r (F b^2 + E I (3 c^2 + 4 b dc/ds - b^4)) + w cos a with b = da/ds, c = db/ds; the mean is r
    (F b^2 - E I (c^2 + b^4)) + w cos a and what 4 E I r b c is at the ends."""
    with h5py.File(f"{folder}/buckling.h5") as file:
        depth, high, right, weights = (file[name][:]
                                       for name in ("states/depth", "states/deflection_high",
                                                    "states/deflection_right",
                                                    "path/weight_on_bit"))
    inside = (depth > 0.25 * length) & (depth < 0.75 * length)
    across, along = (WEIGHT * f(math.radians(inclination)) for f in (math.sin, math.cos))
    found = []
    for state in states:
        angle = np.unwrap(np.arctan2(right[state], -high[state]))
        first = np.gradient(angle, depth, edge_order=2)
        second = np.gradient(first, depth, edge_order=2)
        s, a, b, c = (values[inside] for values in (depth, angle, first, second))

        def mean(values):
            return np.sum(0.5 * (values[1:] + values[:-1]) * np.diff(s)) / (s[-1] - s[0])

        force = weights[state] - along * (length - s)
        ends = 4 * (b[-1] * c[-1] - b[0] * c[0]) / (s[-1] - s[0])
        found.append(CLEARANCE * (mean(force * b**2) - RIGIDITY *
                                  (mean(b**4) + mean(c**2) - ends)) + across * mean(np.cos(a)))
    return found


def hanging_beam(length, elements):
    """Least weight on bit W [N] at which a vertical beam between hinges buckles: E I u_ssss + ((W -
    w (L - s)) u_s)_s = 0, cubic elements of its own."""
    h = length / elements
    bending = RIGIDITY / h**3 * np.array(
        [[12, 6 * h, -12, 6 * h], [6 * h, 4 * h**2, -6 * h, 2 * h**2], [-12, -6 * h, 12, -6 * h],
         [6 * h, 2 * h**2, -6 * h, 4 * h**2]])
    slope = np.array([[36, 3 * h, -36, 3 * h], [3 * h, 4 * h**2, -3 * h, -h**2],
                      [-36, -3 * h, 36, -3 * h], [3 * h, -h**2, -3 * h, 4 * h**2]]) / (30 * h)
    places, hanging, pushed = [], [], []
    for e in range(elements):
        places += [(2 * e + i, 2 * e + j) for i in range(4) for j in range(4)]
        hanging += list((bending + WEIGHT * (length - (e + 0.5) * h) * slope).ravel())
        pushed += list(slope.ravel())
    free = np.delete(np.arange(2 * elements + 2), [0, 2 * elements])
    K, G = (coo_matrix((values, np.transpose(places))).tocsc()[np.ix_(free, free)]
            for values in (hanging, pushed))
    return float(eigsh(K, k=1, M=G, sigma=0.0, which="LM", return_eigenvectors=False)[0])
