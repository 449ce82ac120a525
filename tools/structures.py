# SPDX-License-Identifier: BSD-3-Clause
"""Test structures as part files: beams, frames, solids and rotors assembled with scipy,
independently of the program.

Every structure is a `Structure`: sparse M, C, K, labels (node from 1, component) and positions. SI
units.
"""
import pathlib

import h5py
import numpy as np
from scipy import sparse

COMPONENTS = ["u", "v", "w", "theta_x", "theta_y", "theta_z"]
STEEL = {"E": 2.1e11, "nu": 0.3, "rho": 7850.0}


class Structure:
    def __init__(self, M, K, C=None, nodes=None, components=6, positions=None):
        self.M, self.K = sparse.csr_matrix(M), sparse.csr_matrix(K)
        self.C = sparse.csr_matrix(self.M.shape) if C is None else sparse.csr_matrix(C)
        count = self.M.shape[0]
        self.labels = np.array([(i // components + 1, i % components + 1)
                                for i in range(count)]) if nodes is None else np.array(nodes)
        self.positions = positions
        self.components = COMPONENTS[:components]

    def held(self, dofs):
        """Removes the dofs (node, component), both from 1."""
        gone = {tuple(d) for d in dofs}
        keep = np.array([i for i, label in enumerate(self.labels) if tuple(label) not in gone])
        part = lambda A: A[keep][:, keep]
        out = Structure(part(self.M), part(self.K), part(self.C), self.labels[keep],
                        len(self.components), self.positions)
        return out

    def write(self, path, interfaces=None):
        """Writes an HDF5 part; `interfaces`: name -> nodes."""
        with h5py.File(path, "w") as f:
            f.attrs["format"] = "tooljoint part 1"
            f["components"] = self.components
            f["dofs"] = self.labels
            for name, A in (("mass", self.M), ("stiffness", self.K), ("damping", self.C)):
                A = sparse.coo_matrix(A)
                if name == "damping" and A.nnz == 0:
                    continue
                group = f.create_group(name)
                group["row"], group["column"], group["value"], group[
                    "shape"] = A.row, A.col, A.data, A.shape
            for name, members in (interfaces or {}).items():
                f["interfaces/" + name] = np.array(members)


def _plane_bending(E, I, rho, A, l):
    k = E * I / l**3 * np.array([[12, 6 * l, -12, 6 * l], [6 * l, 4 * l * l, -6 * l, 2 * l * l],
                                 [-12, -6 * l, 12, -6 * l], [6 * l, 2 * l * l, -6 * l, 4 * l * l]])
    m = rho * A * l / 420 * np.array([
        [156, 22 * l, 54, -13 * l],
        [22 * l, 4 * l * l, 13 * l, -3 * l * l],
        [54, 13 * l, 156, -22 * l],
        [-13 * l, -3 * l * l, -22 * l, 4 * l * l],
    ])
    return k, m


def beam_element(l, radius, E, nu, rho):
    """Euler-Bernoulli element of a round bar along its local z: K, M (consistent) and G for unit
    speed about z (skew-symmetric, rotary inertia of a disc)."""
    A, I = np.pi * radius**2, np.pi * radius**4 / 4
    K, M, G = np.zeros((12, 12)), np.zeros((12, 12)), np.zeros((12, 12))
    k, m = _plane_bending(E, I, rho, A, l)
    for dofs, sign in (((0, 4, 6, 10), 1), ((1, 3, 7, 9), -1)):  # u with theta_y; v with -theta_x
        T = np.diag([1, sign, 1, sign])
        K[np.ix_(dofs, dofs)] += T @ k @ T
        M[np.ix_(dofs, dofs)] += T @ m @ T
    bar = np.array([[1, -1], [-1, 1]])
    mass = np.array([[2, 1], [1, 2]])
    K[np.ix_((2, 8), (2, 8))] += E * A / l * bar
    M[np.ix_((2, 8), (2, 8))] += rho * A * l / 6 * mass
    torsion = E / (2 * (1 + nu)) * 2 * I
    K[np.ix_((5, 11), (5, 11))] += torsion / l * bar
    M[np.ix_((5, 11), (5, 11))] += rho * 2 * I * l / 6 * mass
    # lumped polar inertia: I_p (theta_x' theta_y - theta_y' theta_x)
    polar = rho * 2 * I * l / 2
    for x, y in ((3, 4), (9, 10)):
        G[x, y] += polar
        G[y, x] -= polar
    return K, M, G


def members(lines, radius, material=None, speed=0.0):
    """Round bars between points: `lines` is a list of (node, node) on `points`; the local frame is
    the smallest rotation from z."""
    material = material or STEEL
    points, pairs = lines
    points = np.asarray(points, float)
    n = 6 * len(points)
    rows, columns, values = [], [], {"K": [], "M": [], "G": []}
    for a, b in pairs:
        axis = points[b] - points[a]
        l = np.linalg.norm(axis)
        z = axis / l
        helper = np.eye(3)[np.argmin(np.abs(z))]
        x = np.cross(helper, z)
        x /= np.linalg.norm(x)
        T = np.kron(np.eye(4), np.array([x, np.cross(z, x), z]))
        K, M, G = beam_element(l, radius, **material)
        dofs = np.r_[6 * a:6 * a + 6, 6 * b:6 * b + 6]
        r, c = np.meshgrid(dofs, dofs, indexing="ij")
        rows.append(r.ravel())
        columns.append(c.ravel())
        for name, A in (("K", K), ("M", M), ("G", G)):
            values[name].append((T.T @ A @ T).ravel())
    matrix = {
        name: sparse.csr_matrix(
            (np.concatenate(v), (np.concatenate(rows), np.concatenate(columns))), (n, n))
        for name, v in values.items()
    }
    symmetric = lambda A: (A + A.T) / 2
    return Structure(symmetric(matrix["M"]), symmetric(matrix["K"]),
                     speed * matrix["G"] if speed else None, positions=points)


def beam(elements, length=10.0, radius=0.05, direction=(0, 0, 1), speed=0.0):
    direction = np.asarray(direction, float) / np.linalg.norm(direction)
    points = [direction * length * i / elements for i in range(elements + 1)]
    return members((points, [(i, i + 1) for i in range(elements)]), radius, speed=speed)


def pinned_beam(elements, **options):
    """Simply supported along z: u, v and theta_z held at both ends, w at the first end."""
    ends = [(1, 1), (1, 2), (1, 3), (1, 6), (elements + 1, 1), (elements + 1, 2)]
    return beam(elements, **options).held(ends)


def frame(storeys, per_member, bays=1, side=3.0, radius=0.05, fixed=True):
    """A square tower: four columns and a ring of beams per storey (bays > 1: a grid of squares)."""
    points, pairs, found = [], [], {}

    def node(p):
        key = tuple(np.round(p, 9))
        if key not in found:
            found[key] = len(points)
            points.append(p)
        return found[key]

    def member(a, b):
        a, b = np.asarray(a, float), np.asarray(b, float)
        last = node(a)
        for i in range(1, per_member + 1):
            now = node(a + (b - a) * i / per_member)
            pairs.append((last, now))
            last = now

    grid = range(bays + 1)
    for s in range(storeys):
        for i in grid:
            for j in grid:
                member((i * side, j * side, s * side), (i * side, j * side, (s + 1) * side))
                if i < bays:
                    member((i * side, j * side, (s + 1) * side),
                           ((i + 1) * side, j * side, (s + 1) * side))
                if j < bays:
                    member((i * side, j * side, (s + 1) * side),
                           (i * side, (j + 1) * side, (s + 1) * side))
    whole = members((points, pairs), radius)
    feet = [(k + 1, c) for k, p in enumerate(points) if p[2] == 0.0 for c in range(1, 7)]
    return whole.held(feet) if fixed else whole


def solid(nx, ny, nz, size=(1.0, 1.0, 4.0), material=None):
    """Eight-node hexahedra with 2 x 2 x 2 Gauss points, three displacements per node,
    unsupported."""
    material = material or STEEL
    E, nu, rho = material["E"], material["nu"], material["rho"]
    h = np.array(size) / (nx, ny, nz)
    corners = np.array([(i, j, k) for k in (0, 1) for j in (0, 1) for i in (0, 1)])
    D = np.zeros((6, 6))
    D[:3, :3] = nu
    D[np.arange(3), np.arange(3)] = 1 - nu
    D[np.arange(3, 6), np.arange(3, 6)] = (1 - 2 * nu) / 2
    D *= E / ((1 + nu) * (1 - 2 * nu))
    Ke, Me = np.zeros((24, 24)), np.zeros((24, 24))
    for gauss in np.array(np.meshgrid(*[[-1, 1]] * 3)).reshape(3, -1).T / np.sqrt(3):
        s = 2 * corners - 1
        N = np.prod(1 + s * gauss, axis=1) / 8
        dN = np.empty((8, 3))
        for d in range(3):
            others = [e for e in range(3) if e != d]
            dN[:, d] = s[:, d] * np.prod(1 + s[:, others] * gauss[others], axis=1) / 8 * 2 / h[d]
        B = np.zeros((6, 24))
        for a in range(8):
            x, y, z = dN[a]
            B[:, 3 * a:3 * a + 3] = [[x, 0, 0], [0, y, 0], [0, 0, z], [y, x, 0], [0, z, y],
                                     [z, 0, x]]
        volume = np.prod(h) / 8
        Ke += volume * B.T @ D @ B
        Me += volume * rho * np.kron(np.outer(N, N), np.eye(3))
    number = lambda i, j, k: i + (nx + 1) * (j + (ny + 1) * k)
    rows, columns, k, m = [], [], [], []
    for cell in np.ndindex(nx, ny, nz):
        nodes = [number(*(np.array(cell) + c)) for c in corners]
        dofs = (3 * np.array(nodes)[:, None] + np.arange(3)).ravel()
        r, c = np.meshgrid(dofs, dofs, indexing="ij")
        rows.append(r.ravel())
        columns.append(c.ravel())
        k.append(Ke.ravel())
        m.append(Me.ravel())
    n = 3 * (nx + 1) * (ny + 1) * (nz + 1)
    matrix = lambda v: sparse.csr_matrix((np.concatenate(v),
                                          (np.concatenate(rows), np.concatenate(columns))), (n, n))
    positions = np.array([(i, j, l) for l in range(nz + 1) for j in range(ny + 1)
                          for i in range(nx + 1)]) * h
    return Structure(matrix(m), matrix(k), components=3, positions=positions)


def deck(path, parts, joints=(), reduction=None):
    """A deck of parts; `parts`: name -> file; `reduction`: XML inside the list Reduction."""
    imported = "".join(f'<ParameterList name="{name}"><Parameter name="File" type="string" '
                       f'value="{file}"/></ParameterList>' for name, file in parts.items())
    joined = ('<Parameter name="Joints" type="Array(string)" '
              f'value="{{{", ".join(joints)}}}"/>') if joints else ""
    reduced = (f'<ParameterList name="Reduction">{reduction}</ParameterList>'
               ) if reduction is not None else ""
    pathlib.Path(path).write_text(
        '<ParameterList name="test"><ParameterList name="Parts"><ParameterList '
        f'name="Imported">{imported}</ParameterList>{joined}</ParameterList>{reduced}</'
        'ParameterList>', encoding="utf-8")
    return path
