#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a block of hexahedra as a part.

    make_block.py NX NY NZ [--size LX LY LZ] [--joined N] [--out FILE]

Trilinear elements with eight nodes, 2 x 2 x 2 Gauss points, consistent mass, steel. The set `root`
has the nodes of the end x = 0, the set `tip` N nodes of the other end, evenly distributed (default:
all). N = -1 omits the set `tip`.
"""
import argparse

import h5py
import numpy as np
import scipy.sparse as sparse

YOUNG, POISSON, DENSITY = 2.06e11, 0.3, 7850.0
CORNERS = np.array([[x, y, z] for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)], dtype=float)


def element(h):
    """K, M of a box with edges h; rows node by node, u v w."""
    lam = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
    shear = YOUNG / (2 * (1 + POISSON))
    D = np.diag([2 * shear] * 3 + [shear] * 3)
    D[:3, :3] += lam
    K, M = np.zeros((24, 24)), np.zeros((24, 24))
    weight = np.prod(h) / 8
    for point in CORNERS / np.sqrt(3):
        one = (1 + CORNERS * point) / 2  # node x axis
        shape = one.prod(axis=1)
        slope = np.column_stack([
            CORNERS[:, a] / 2 * one[:, (a + 1) % 3] * one[:, (a + 2) % 3] * 2 / h[a]
            for a in range(3)
        ])
        B = np.zeros((6, 24))
        for i, (x, y, z) in enumerate(slope):
            B[:, 3 * i:3 * i + 3] = [[x, 0, 0], [0, y, 0], [0, 0, z], [y, x, 0], [0, z, y],
                                     [z, 0, x]]
        N = np.kron(shape, np.eye(3))
        K += weight * B.T @ D @ B
        M += weight * DENSITY * N.T @ N
    return (K + K.T) / 2, (M + M.T) / 2


def assemble(counts, size):
    """K, M and the positions of the nodes, x fastest."""
    nodes = np.array(counts) + 1
    K, M = element(np.array(size) / counts)
    corner = np.arange(np.prod(nodes)).reshape(nodes[::-1])[:-1, :-1, :-1].ravel()
    offsets = [x + nodes[0] * (y + nodes[1] * z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    dofs = (3 * (corner[:, None] + offsets)[:, :, None] + np.arange(3)).reshape(len(corner), 24)
    row, column = np.repeat(dofs, 24, axis=1).ravel(), np.tile(dofs, 24).ravel()
    n = 3 * int(np.prod(nodes))
    both = [
        sparse.csr_matrix((np.tile(A.ravel(), len(corner)), (row, column)), shape=(n, n))
        for A in (K, M)
    ]
    for A in both:
        A.sum_duplicates()
    both = [((A + A.T) * 0.5).tocoo() for A in both]  # equal triangles to the last bit
    z, y, x = np.meshgrid(*[np.linspace(0, size[a], nodes[a]) for a in (2, 1, 0)], indexing="ij")
    return *both, np.column_stack([x.ravel(), y.ravel(), z.ravel()])


def spread(nodes, count):
    return nodes[np.unique(np.linspace(0,
                                       len(nodes) -
                                       1, count).round().astype(int))] if count else nodes


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("counts", type=int, nargs=3, help="elements along x, y, z")
    parser.add_argument("--size", type=float, nargs=3, default=(0.8, 0.2, 0.1), help="edges [m]")
    parser.add_argument("--joined", type=int, default=0, help="nodes of the tip that may be joined")
    parser.add_argument("--out", default="block.h5")
    options = parser.parse_args()
    K, M, positions = assemble(options.counts, options.size)
    numbers = np.arange(1, len(positions) + 1)
    with h5py.File(options.out, "w") as file:
        file.attrs["format"] = "tooljoint part 1"
        file["components"] = ["u", "v", "w"]
        file["dofs"] = np.column_stack([np.repeat(numbers, 3), np.tile([1, 2, 3], len(numbers))])
        for name, A in (("mass", M), ("stiffness", K)):
            group = file.create_group(name)
            group["row"], group["column"], group["value"] = A.row, A.col, A.data
        file["positions"] = np.column_stack([numbers, positions])
        file["interfaces/root"] = numbers[positions[:, 0] == 0]
        if options.joined >= 0:
            file["interfaces/tip"] = spread(numbers[positions[:, 0] == options.size[0]],
                                            options.joined)
    print(f"{options.out}: {K.shape[0]} dofs, {K.nnz} entries")


if __name__ == "__main__":
    main()
