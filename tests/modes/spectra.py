# SPDX-License-Identifier: BSD-3-Clause
"""Values of damped modes: printed values, values of dense forms, and their differences."""
import numpy as np
from scipy.linalg import eig, eigh

TWO_PI = 2 * np.pi


def column(rows, key):
    return np.array([row[key] for row in rows])


def values(rows, which="full"):
    """s [1/s] of damped_modes.csv."""
    size, imaginary, ratio = (TWO_PI * column(rows, which), TWO_PI * column(rows, which + "_im"),
                              column(rows, which + "_damping"))
    return -ratio * size + 1j * imaginary


def companion(structure, count):
    """The `count` values of smallest |s| with Im s >= 0, of the dense companion form (QZ-free: M is
    regular)."""
    M, C, K = (A.toarray() for A in (structure.M, structure.C, structure.K))
    n = len(M)
    scale = np.sqrt(np.abs(np.diag(K)) / np.diag(M)).max()  # balances the blocks
    d = 1 / np.sqrt(np.diag(M))
    M, C, K = (d[:, None] * A * d for A in (M, C, K))
    A = np.block([
        [np.zeros((n, n)), scale * np.eye(n)],
        [-np.linalg.solve(M, K) / scale, -np.linalg.solve(M, C)],
    ])
    s = eig(A, right=False)
    s = s[s.imag >= -1e-9 * np.abs(s)]
    return s[np.argsort(np.abs(s))][:count]


def same(found, exact, tolerance):
    """Largest relative distance when each value is paired with the nearest remaining one."""
    left, worst = list(exact), 0.0
    for s in found:
        nearest = min(range(len(left)), key=lambda i: abs(left[i] - s))
        worst = max(worst, abs(left.pop(nearest) - s) / max(abs(s), 1e-300))
    return worst <= tolerance, f"{worst:.1e}"


def proportional(structure, alpha, beta, count):
    """Values of C = alpha M + beta K from the undamped ones; a double zero is listed once."""
    omega2 = np.maximum(eigh(structure.K.toarray(), structure.M.toarray(), eigvals_only=True), 0)
    c = alpha + beta * omega2
    root = np.sqrt((c**2 / 4 - omega2).astype(complex))
    s = np.concatenate([-c / 2 + root, -c / 2 - root])
    s = s[s.imag >= 0]
    return s[np.argsort(np.abs(s))][:count]
