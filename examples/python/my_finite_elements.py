#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Finite elements of your own: a bracket of bilinear plane-stress elements, assembled here with
numpy and scipy, is cut into two parts and reduced.

A harmonic force acts on its tip; the reduced model is compared with the full one over the
frequency.
"""
# %% Definitions
import common  # in the folder of this script
import numpy as np
import scipy.sparse.linalg
import tooljoint as tj

YOUNG, POISSON, DENSITY, THICKNESS = 2.1e11, 0.3, 7850.0, 0.01
SIZE, ARM = 0.4, 0.1  # length of the L-shaped bracket, width of its arms [m]
LOSS = 2e-6  # ratio of damping to stiffness [s]


def element(side):
    """K and M (8 x 8) of a square bilinear element: 2 x 2 Gauss points."""
    D = YOUNG / (1 - POISSON**2) * np.array([[1, POISSON, 0], [POISSON, 1, 0],
                                             [0, 0, (1 - POISSON) / 2]])
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    K, M = np.zeros((8, 8)), np.zeros((8, 8))
    for point in corners / np.sqrt(3):
        shape = (1 + corners * point).prod(axis=1) / 4
        slope = corners * (1 + corners * point)[:, ::-1] / 4 * 2 / side  # d shape / d(x, y)
        B, N = np.zeros((3, 8)), np.kron(shape, np.eye(2))
        B[0, ::2], B[1, 1::2] = slope.T
        B[2, ::2], B[2, 1::2] = slope[:, 1], slope[:, 0]
        weight = THICKNESS * side**2 / 4
        K += weight * B.T @ D @ B
        M += weight * DENSITY * N.T @ N
    return K, M


def mesh(per_arm):
    """Nodes (x, y) and elements (four nodes) of the bracket."""
    cells, side = round(per_arm * SIZE / ARM), ARM / per_arm
    used = [(i, j) for i in range(cells) for j in range(cells) if i < per_arm or j < per_arm]
    corners = sorted({(i + a, j + b) for i, j in used for a in (0, 1) for b in (0, 1)})
    number = {corner: n for n, corner in enumerate(corners)}
    elements = np.array(
        [[number[i, j], number[i + 1, j], number[i + 1, j + 1], number[i, j + 1]] for i, j in used])
    return np.array(corners) * side, elements, side


def part(name, elements, nodes, side, joined, tip=-1):
    """The part of these elements, clamped at the top of the upright arm; the node `tip` is
    retained."""
    own = np.unique(elements)
    place = {node: n for n, node in enumerate(own)}
    dofs = [
        np.array([[2 * place[node], 2 * place[node] + 1] for node in each]).ravel()
        for each in elements
    ]
    K, M = (common.assemble([(matrix, each) for each in dofs], 2 * len(own))
            for matrix in element(side))
    free = np.repeat(nodes[own, 1] < SIZE - 1e-9, 2)
    K, M, labels = K[free][:, free], M[free][:, free], np.repeat(own, 2)[free]
    return tj.part(name, M, K, damping=LOSS * K, nodes=labels + 1, component_names=("u", "v"),
                   interface=np.flatnonzero(np.isin(labels, joined)),
                   retained=np.flatnonzero(labels == tip))


def response(model, tip, frequencies):
    """Displacement of the tip per newton [m/N]: (K + i omega C - omega^2 M) x = f."""
    K, C, M = model.stiffness(), model.damping(), model.mass
    force = np.eye(len(model))[tip]
    return np.array([
        scipy.sparse.linalg.spsolve((K + 1j * w * C - w**2 * M).tocsc(), force)[tip]
        for w in 2 * np.pi * frequencies
    ])


# %% Mesh and parts
options = common.options(__doc__)
nodes, elements, side = mesh(3 if options.short else 8)
upright = nodes[elements].mean(axis=1)[:, 0] < ARM
joined = np.intersect1d(elements[upright], elements[~upright])
tip = int(np.argmax(nodes[:, 0] + nodes[:, 1] *
                    (nodes[:, 0] > SIZE - 1e-9)))  # the upper corner at the end of the foot
parts = [
    part("upright", elements[upright], nodes, side, joined),
    part("foot", elements[~upright], nodes, side, joined, tip)
]

# %% Full and reduced
full, reduced = tj.couple(parts), tj.synthesise(parts, "Craig-Bampton", cut_off_frequency="30 kHz")
print(
    f"{len(full)} dofs, reduced to {len(reduced.model)}, {len(joined) * 2} of them on the interface"
)
modes = tj.modes(full, 6)
rows = tj.compare_modes(reduced, 6)
for row, whole in zip(rows, modes.frequency):
    print(f"{whole:10.2f} Hz   error {row['error']:8.1e}   estimate {row['estimate']:8.1e}   MAC "
          f"{row['mac']:.6f}")
assert 0 <= max(row["error"] for row in rows) < 2e-3

# %% Frequency response
frequencies = np.linspace(50, 1.2 * modes.frequency[3], 60 if options.short else 300)
answers = {
    name: response(model, model.position(tip + 1, "v"), frequencies)
    for name, model in (("full", full), ("reduced", reduced.model))
}
error = abs(answers["reduced"] - answers["full"]).max() / abs(answers["full"]).max()
print(f"largest error of the response: {error:.1e} of its largest value")
assert error < 0.05

# %% Figure
figure, (drawn, curve) = common.figure(2)
shape = full.recovery @ modes.shapes[:, 0]
moved = nodes.copy()
moved[full.recovery_nodes - 1] += 0.06 / abs(shape).max() * shape.reshape(-1, 2)
for each in elements:
    drawn.plot(*moved[np.r_[each, each[0]]].T, color="C0", linewidth=0.5)
drawn.set(title=f"{len(nodes)} nodes, clamped at the top", aspect="equal", xlabel="x [m]",
          ylabel="y [m]")
for name, style in (("full", "-"), ("reduced", "--")):
    curve.semilogy(frequencies, abs(answers[name]), style,
                   label=f"{name}, {len(full if name == 'full' else reduced.model)} dofs")
curve.set(title="The tip under a harmonic force", xlabel="Frequency [Hz]",
          ylabel="Receptance [m/N]")
curve.legend()
common.save(figure, options, "my_finite_elements")
