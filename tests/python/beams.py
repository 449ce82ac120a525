# SPDX-License-Identifier: BSD-3-Clause
"""Matrices of beams of plane Euler-Bernoulli elements for the tests: components v and theta of each
node."""
import numpy as np
import scipy.sparse as sparse

EI, MASS = 2.0e4, 12.0  # N m2, kg/m


def beam(length, elements):
    """K and M of a free beam, 2 (elements + 1) dofs."""
    l = length / elements
    k = EI / l**3 * np.array([[12, 6 * l, -12, 6 * l], [6 * l, 4 * l * l, -6 * l, 2 * l * l],
                              [-12, -6 * l, 12, -6 * l], [6 * l, 2 * l * l, -6 * l, 4 * l * l]])
    m = MASS * l / 420 * np.array([
        [156, 22 * l, 54, -13 * l],
        [22 * l, 4 * l * l, 13 * l, -3 * l * l],
        [54, 13 * l, 156, -22 * l],
        [-13 * l, -3 * l * l, -22 * l, 4 * l * l],
    ])
    size = 2 * (elements + 1)
    K, M = sparse.lil_matrix((size, size)), sparse.lil_matrix((size, size))
    for e in range(elements):
        at = np.ix_(range(2 * e, 2 * e + 4), range(2 * e, 2 * e + 4))
        K[at] += k
        M[at] += m
    return K.tocsr(), M.tocsr()


def halves(tj, elements=24):
    """A cantilever of 4 m cut in its middle, clamped at node 1: the two parts, and K and M of the
    whole."""
    K, M = beam(4.0, elements)
    half = elements // 2
    Kh, Mh = beam(2.0, half)
    names = ("v", "theta")
    left = tj.part("left", Mh[2:, 2:], Kh[2:, 2:], nodes=np.repeat(np.arange(2, half + 2), 2),
                   component_names=names, interface=[2 * half - 2, 2 * half - 1])
    right = tj.part("right", Mh, Kh, nodes=np.repeat(np.arange(half + 1, elements + 2), 2),
                    component_names=names, interface=[0, 1], retained=[2 * half])
    return left, right, K[2:, 2:], M[2:, 2:]
