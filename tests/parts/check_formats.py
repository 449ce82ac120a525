#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A swept plate through the files of every format: check_formats.py PROGRAM

The plate consists of hexahedra, is swept by 30 degrees, and its root moves as a rigid body with the
six dofs of one node. It is written here in each format that the program reads; the frequencies must
be those of its matrices. Then it is reduced, exported in each format that the program writes, and
read again; the frequencies must be those of the reduced plate. A failed export leaves no files.
"""
import csv
import json
import pathlib
import shutil
import sys

import h5py
import numpy as np
import scipy.sparse as sparse
from scipy.io import hb_write
from scipy.linalg import eigh

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from checks import expect, finish, tooljoint  # noqa: E402

YOUNG, POISSON, DENSITY = 7.1e10, 0.33, 2770.0
CELLS, EDGES = (8, 3, 1), np.array([[0.05, 0.05 * np.tan(np.radians(30)), 0], [0, 0.06, 0],
                                    [0, 0, 0.02]])
CORNERS = np.array([[x, y, z] for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)], dtype=float)
COMPONENTS = "u", "v", "w", "theta_x", "theta_y", "theta_z"
MODES, RIGID = 12, 6
# ten digits of entries; the largest eigenvalue is some thousand times that of the lowest bending
# mode
OF_PUNCH = 1e-6


def element():
    """K, M of a parallelepiped with the edges EDGES, trilinear, 2 x 2 x 2 points of Gauss."""
    lam, shear = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON)), YOUNG / (2 * (1 + POISSON))
    D = np.diag([2 * shear] * 3 + [shear] * 3)
    D[:3, :3] += lam
    K, M, weight = np.zeros((24, 24)), np.zeros((24, 24)), np.linalg.det(EDGES / 2)
    for point in CORNERS / np.sqrt(3):
        one = (1 + CORNERS * point) / 2
        local = np.column_stack(
            [CORNERS[:, a] / 2 * one[:, (a + 1) % 3] * one[:, (a + 2) % 3] for a in range(3)])
        B = np.zeros((6, 24))
        for i, (x, y, z) in enumerate(np.linalg.solve(EDGES / 2, local.T).T):
            B[:, 3 * i:3 * i + 3] = [[x, 0, 0], [0, y, 0], [0, 0, z], [y, x, 0], [0, z, y],
                                     [z, 0, x]]
        N = np.kron(one.prod(axis=1), np.eye(3))
        K += weight * B.T @ D @ B
        M += weight * DENSITY * N.T @ N
    return K, M


def plate():
    """K, M, labels (node, component from 1) and positions; node 1 carries the root."""
    n = np.array(CELLS) + 1
    grid = np.array([[i, j, k] for k in range(n[2]) for j in range(n[1]) for i in range(n[0])])
    x = grid @ EDGES
    number = {tuple(g): i for i, g in enumerate(grid)}
    K, M = np.zeros((3 * len(x), 3 * len(x))), np.zeros((3 * len(x), 3 * len(x)))
    Ke, Me = element()
    for cell in grid[(grid < CELLS).all(axis=1)]:
        dofs = np.concatenate([3 * number[tuple(cell + (c > 0))] + np.arange(3) for c in CORNERS])
        K[np.ix_(dofs, dofs)] += Ke
        M[np.ix_(dofs, dofs)] += Me
    root = grid[:, 0] == 0
    middle = x[root].mean(axis=0)
    free = np.flatnonzero(~root)
    T = np.zeros((3 * len(x), 6 + 3 * len(free)))
    for i in np.flatnonzero(root):  # u + theta x r
        r = x[i] - middle
        T[3 * i:3 * i + 3, :6] = np.hstack(
            [np.eye(3), [[0, r[2], -r[1]], [-r[2], 0, r[0]], [r[1], -r[0], 0]]])
    for j, i in enumerate(free):
        T[3 * i:3 * i + 3, 6 + 3 * j:9 + 3 * j] = np.eye(3)
    labels = [(1, c) for c in range(1, 7)] + [(j + 2, c) for j in range(len(free))
                                              for c in (1, 2, 3)]
    K, M = (np.where(np.abs(A) > 1e-14 * np.abs(A).max(), A, 0) for A in (T.T @ K @ T, T.T @ M @ T))
    return (K + K.T) / 2, (M + M.T) / 2, labels, np.vstack([middle, x[free]])


def hdf5(K, M, labels, positions, name="plate.h5", first=1):
    """The nodes are numbered from `first`."""
    labels = np.array(labels) + [first - 1, 0]
    with h5py.File(name, "w") as file:
        file.attrs["format"] = np.bytes_(
            "tooljoint part 1")  # texts of fixed length, as written by MATLAB and Fortran
        file["components"] = np.array(COMPONENTS, "S8")
        file["dofs"] = labels
        file["mass"], file["stiffness"] = M, K
        file["positions"] = np.column_stack([np.arange(len(positions)) + first, positions])
        file["interfaces/root"] = [first]
    return name


def abaqus(K, M, labels, _):
    for tag, A in (("STIF", K), ("MASS", M)):
        rows = [
            f"{labels[i][0]},{labels[i][1]}, {labels[j][0]},{labels[j][1]}, {A[i, j]:.16e}"
            for i in range(len(A)) for j in range(i + 1) if A[i, j] != 0
        ]
        pathlib.Path(f"plate_{tag}1.mtx").write_text("\n".join(rows) + "\n", encoding="utf-8")
    return "plate_STIF1.mtx"


def harwell_boeing(K, M, labels, _):
    """Equations in another order than the labels."""
    folder = pathlib.Path("ansys")
    folder.mkdir(exist_ok=True)
    order = np.random.default_rng(5).permutation(len(K))
    names = "UX", "UY", "UZ", "ROTX", "ROTY", "ROTZ"
    for name, A in (("K", K), ("M", M)):
        lower = sparse.csc_matrix(np.tril(A[np.ix_(order, order)]))
        lower.sort_indices()
        n, count = len(A), lower.nnz
        (folder / f"{name}.hb").write_text(
            "\n".join([
                "swept plate",
                f"{n + 1 + 2 * count} {n + 1} {count} {count}",
                f"RSA {n} {n} {count} 0",
                "(1I14) (1I14) (1E25.16)",
                *(f"{i + 1:14}" for i in (*lower.indptr, *lower.indices)),
                *(f"{x:25.16E}" for x in lower.data),
            ]) + "\n", encoding="utf-8")
        rows = "".join(
            f"{i + 1} {labels[j][0]} {names[labels[j][1] - 1]}\n" for i, j in enumerate(order))
        (folder / f"{name}.mapping").write_text("Matrix Eqn Node DOF\n" + rows, encoding="utf-8")
    (folder / "part.json").write_text(
        '{"format": "tooljoint part 1", "matrices": {"stiffness": "K.hb", "mass": "M.hb"}}',
        encoding="utf-8")
    return "ansys/part.json"


def harwell_boeing_of_scipy(K, M, labels, _):
    """Numbers between blanks, in narrower columns than the format states."""
    folder = pathlib.Path("scipy")
    folder.mkdir(exist_ok=True)
    names = "UX", "UY", "UZ", "ROTX", "ROTY", "ROTZ"
    for name, A in (("K", K), ("M", M)):
        hb_write(folder / f"{name}.hb", sparse.csc_matrix(A))
        rows = "".join(f"{i + 1} {node} {names[component - 1]}\n"
                       for i, (node, component) in enumerate(labels))
        (folder / f"{name}.mapping").write_text("Matrix Eqn Node DOF\n" + rows, encoding="utf-8")
    (folder / "part.json").write_text(
        '{"format": "tooljoint part 1", "matrices": {"stiffness": "K.hb", "mass": "M.hb"}}',
        encoding="utf-8")
    return "scipy/part.json"


def nastran(K, M, labels, _):
    lines = []
    for name, A in (("KAAX", K), ("MAAX", M)):
        lines.append(f"DMIG    {name:8}{0:8}{6:8}{2:8}{0:8}")
        for j in range(len(A)):
            column = [i for i in range(j, len(A)) if A[i, j] != 0]
            if not column:
                continue
            lines.append(f"DMIG*   {name:16}{labels[j][0]:16}{labels[j][1]:16}")
            lines += [
                f"*       {labels[i][0]:16}{labels[i][1]:16}{fortran(A[i, j]):>16}" for i in column
            ]
    pathlib.Path("plate.pch").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return "plate.pch"


def fortran(value):
    """Sixteen columns with a D exponent."""
    for digits in range(12, 6, -1):
        text = f"{value:.{digits}e}".replace("e", "D")
        if len(text) <= 16:
            return text
    raise ValueError(value)


def deck(name, file, reduction=False):
    kept = '<Parameter name="Retained" type="Array(string)" value="{1}"/>' if reduction else ""
    reduced = ('<ParameterList name="Reduction"><ParameterList name="Mode Selection"><Parameter '
               'name="Modes" type="int" value="' + str(MODES) +
               '"/></ParameterList></ParameterList>') if reduction else ""
    pathlib.Path(name).write_text(
        '<ParameterList name="plate"><ParameterList name="Parts"><ParameterList name="Imported">'
        '<ParameterList name="plate"><Parameter name="File" type="string" '
        f'value="{file}"/>{kept}</ParameterList></ParameterList>'
        f'</ParameterList>{reduced}</ParameterList>', encoding="utf-8")
    return name


def hertz(name, key, *words):
    folder = f"modes_{pathlib.Path(name).stem}_{key[0]}"
    done = tooljoint("modes", name, "--count", str(RIGID + MODES), "--output", folder, *words)
    if done.returncode != 0:
        expect(f"modes of {name}", False, done.stderr)
        return np.zeros(RIGID + MODES)
    return np.sort(
        [float(row[key]) for row in csv.DictReader(open(f"{folder}/modes.csv", encoding="utf-8"))])


def same(what, found, exact, tolerance):
    """Elastic frequencies agree; a free plate has six rigid-body motions."""
    error = np.abs(found[RIGID:] / exact[RIGID:] - 1).max()
    expect(
        what,
        len(found) == len(exact) and np.abs(found[:RIGID]).max() < 1e-3 * exact[RIGID]
        and error < tolerance, f"{error:.1e}")


def frequencies(K, M, count=RIGID + MODES):
    return np.sqrt(np.abs(eigh(K, M, eigvals_only=True)[:count])) / (2 * np.pi)


def superelement(path):
    """M and K of a file as read by ReadFlexASCII of OpenFAST."""
    lines = pathlib.Path(path).read_text(encoding="utf-8").splitlines()
    n = int(next(line for line in lines if line.startswith("!Dimension")).split(":")[1])
    found = []
    for heading in ("!Mass Matrix", "!Stiffness Matrix"):
        first = next(i for i, line in enumerate(lines) if line.startswith(heading)) + 2
        found.append(np.array([[float(x) for x in line.split()] for line in lines[first:first + n]
                               ]))
    return found


def read_formats(K, M, labels, positions):
    exact = frequencies(K, M)
    for write, tolerance in ((hdf5, 1e-10), (abaqus, 1e-10), (harwell_boeing, 1e-10),
                             (harwell_boeing_of_scipy, 1e-10), (nastran, OF_PUNCH)):
        name = write.__name__
        found = hertz(deck(f"read_{name}.xml", write(K, M, labels, positions)), "full [Hz]")
        same(f"a plate written as {name} has its frequencies", found, exact, tolerance)


def written_formats():
    reduced = deck("reduced.xml", "plate.h5", reduction=True)
    exact = hertz(reduced, "coupled [Hz]", "--coupled")
    for kind, file, tolerance in (("hdf5", "plate.h5", 1e-10), ("mtx", "plate/part.json", 1e-10),
                                  ("dmig", "plate.pch", OF_PUNCH)):
        done = tooljoint("export", reduced, "--format", kind, "--output", f"written {kind}")
        expect(f"a reduced plate is exported as {kind}", done.returncode == 0, done.stderr)
        same(f"and has its frequencies when it is read from {kind}",
             hertz(deck(f"again_{kind}.xml", f"written {kind}/{file}"), "full [Hz]"), exact,
             tolerance)
    done = tooljoint("export", reduced, "--format", "extptfm", "--output", "written extptfm")
    expect("a reduced plate is exported as extptfm", done.returncode == 0, done.stderr)
    mass, stiffness = superelement("written extptfm/plate.dat")
    same("and has its frequencies when it is read as OpenFAST does", frequencies(stiffness, mass),
         exact, 1e-10)
    warning = "without its rotation in the scene"
    expect("without a word on its axes, which are those of the scene", warning not in done.stderr,
           done.stderr)
    done = tooljoint("export", reduced, "--set", "Parts/Imported/plate/Rotation Angle=30 deg",
                     "--format", "extptfm", "--output", "written turned")
    expect("one that the scene turns is exported with a warning", done.returncode == 0
           and warning in done.stderr, done.stderr)


def failing_export(K, M, labels, positions):
    """The second part has two retained nodes, which the format does not support; the first one is
    written before."""
    text = pathlib.Path("reduced.xml").read_text(encoding="utf-8")
    second = ('<ParameterList name="wide"><Parameter name="File" type="string" value="{}"/>'
              '<Parameter name="Retained" type="Array(string)" value="{{1001, 1002}}"/>'
              '</ParameterList>')
    second = second.format(hdf5(K, M, labels, positions, "wide.h5", 1001))
    at = text.index('<ParameterList name="plate"><Parameter')
    pathlib.Path("failing.xml").write_text(
        (text[:at] +
         text[at:].replace("</ParameterList></ParameterList></ParameterList>",
                           "</ParameterList>" + second + "</ParameterList></ParameterList>", 1)),
        encoding="utf-8")
    folder = pathlib.Path("failing")
    shutil.rmtree(folder, ignore_errors=True)  # of an earlier run of this test
    folder.mkdir()
    (folder / "plate.dat").write_text("of an earlier export", encoding="utf-8")
    done = tooljoint("export", "failing.xml", "--format", "extptfm", "--output", "failing")
    expect("a part that the format cannot hold ends the export", done.returncode == 3
           and "\"wide\"" in done.stderr, f"{done.returncode}: {done.stderr}")
    left = sorted(path.name for path in folder.iterdir())
    expect(
        "a failing export leaves what was there", left == ["plate.dat"]
        and (folder / "plate.dat").read_text(encoding="utf-8") == "of an earlier export", str(left))


def equilibrium_round_trip():
    """A bar at rest under a load and on a spring of the deck, reduced, exported and read again: the
    spring keeps its reference, so the bar stays at rest."""
    k = 1e4
    content = {
        "format": "tooljoint part 1",
        "components": ["u"],
        "dofs": [[i, "u"] for i in (1, 2, 3, 4)],
        "mass": np.eye(4).tolist(),
        "stiffness": [[2 * k, -k, 0, 0], [-k, 2 * k, -k, 0], [0, -k, 2 * k, -k], [0, 0, -k, k]],
        "interfaces": {"tip": [4]},
    }
    pathlib.Path("bar.json").write_text(json.dumps(content), encoding="utf-8")
    text = """<ParameterList name="bar"><ParameterList name="Parts"><ParameterList name="Imported">
    <ParameterList name="a">
      <Parameter name="File" type="string" value="{file}"/></ParameterList>
      </ParameterList>{start}</ParameterList>
      <ParameterList name="Coupling"><Parameter name="Node Numbers" type="string" value="Own"/>
      <ParameterList name="Springs"><ParameterList name="k">
      <Parameter name="First" type="string" value="a:4"/>
      <Parameter name="Component" type="string" value="u"/>
      <Parameter name="Stiffness" type="double" value="1e4"/></ParameterList></ParameterList>
      </ParameterList>{reduction}
      <ParameterList name="Transient">
      <Parameter name="End Time" type="double" value="0.5"/></ParameterList></ParameterList>"""
    equilibrium = '<Parameter name="Initial State" type="string" value="Equilibrium"/>'
    load = """<ParameterList name="Loads"><ParameterList name="l">
    <Parameter name="Part" type="string" value="a"/><Parameter name="Node" type="int" value="4"/>
      <Parameter name="Component" type="string" value="u"/>
      <Parameter name="Value" type="double" value="100"/></ParameterList></ParameterList>"""
    reduction = ('<ParameterList name="Reduction"><ParameterList name="Mode Selection"><Parameter '
                 'name="Modes" type="int" value="2"/></ParameterList></ParameterList>')
    for name, file, start, reduce in (
        ("bar", "bar.json", equilibrium + load, reduction),
        ("bar_again", "bars/a.h5", "", ""),
        ("bar_at_rest", "bars/a.h5", equilibrium, ""),
    ):
        pathlib.Path(f"{name}.xml").write_text(
            text.format(file=file, start=start, reduction=reduce), encoding="utf-8")
    done = tooljoint("export", "bar.xml", "--output", "bars")
    expect("a bar at rest on a spring is exported", done.returncode == 0, done.stderr)
    for name in ("bar", "bar_again", "bar_at_rest"):
        done = tooljoint("run", f"{name}.xml", "--output", name)
        expect(f"{name}: moves", done.returncode == 0, done.stderr)
        if done.returncode:
            continue
        with h5py.File(f"{name}/results.h5") as results:
            force = results["transient/k/spring_force"][()]
        expect(f"{name}: the spring goes on carrying 80 N", np.allclose(force, -80.0, rtol=1e-6),
               f"({force.min()} to {force.max()} N)")


part = plate()
read_formats(*part)
written_formats()
failing_export(*part)
equilibrium_round_trip()
finish()
