#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Choose a basis: the number of coordinates that each reduction method needs for the lowest ten
frequencies of a beam of three parts. The true errors are compared with the error estimate, which
does not use the full model. A method written here in a few lines is included.
"""
# %% Definitions
import common  # in the folder of this script
import numpy as np
import tooljoint as tj

EA, EI, MASS = 4.0e8, 6.0e5, 30.0  # N, N m2, kg/m


@tj.basis("Inverse Steps")
def inverse_steps(part, count, steps=2):
    """A random subspace of the interior, moved towards its low modes by inverse iteration (Halko,
    Martinsson, Tropp 2011)."""
    vectors = np.random.default_rng(1).standard_normal((len(part.interior), count + 4))
    for step in range(steps):
        vectors = np.linalg.qr(part.solve_interior(part.interior_mass @ vectors))[0]
    return vectors


def beam_of_parts(elements):
    """A beam of 9 m on two bearings, cut at 3 m and 6 m."""
    parts = []
    for number in range(3):
        K, M = common.beam(3.0, elements, EA, EI, MASS)
        nodes = np.repeat(np.arange(number * elements, (number + 1) * elements + 1) + 1, 3)
        held = {0: [0, 1], 1: [],
                2: [3 * elements + 1]}[number]  # u and v of the first node, v of the last
        free = np.setdiff1d(np.arange(len(nodes)), held)
        interface = np.flatnonzero(np.isin(nodes[free], [elements + 1, 2 * elements + 1]))
        components = np.tile([0, 1, 2], elements + 1)[free]
        parts.append(
            tj.part(f"part {number + 1}", M[free][:, free], K[free][:, free], nodes=nodes[free],
                    components=components, component_names=("u", "v", "theta"),
                    interface=interface))
    return parts


# %% Options and parts
options = common.options(__doc__)
parts = beam_of_parts(10 if options.short else 30)
methods = ["Guyan", "Craig-Bampton", "Rubin", "Krylov", "Inverse Steps"]
counts = (2, 4, 8) if options.short else (2, 4, 6, 8, 12, 16)

# %% Errors and estimates of each method
full = tj.couple(parts)
figure, (left, right) = common.figure(2)
for method in methods:
    sizes, errors, estimates = [], [], []
    for count in counts:
        synthesis = tj.synthesise(parts, method, modes=count)
        rows = tj.compare_modes(synthesis, 10)
        sizes.append(len(synthesis.model))
        # 1 for a mode of the full model that is missing in the reduced one
        errors.append(max(1.0 if row["error"] is None else abs(row["error"]) for row in rows))
        known = [row["estimate"] for row in rows if row["estimate"] is not None
                 ]  # not available for every basis
        estimates.append(max(known, default=np.nan))
    line, = left.semilogy(sizes, errors, "o-", label=method)
    right.loglog(errors, estimates, "o", color=line.get_color(), label=method)
    print(f"{method:14}", *(f"{size:3}: {error:.1e}" for size, error in zip(sizes, errors)))
    assert errors[-1] < errors[0], f"{method}: more modes are not better: {errors}"
bounds = right.get_xlim()
right.loglog(bounds, bounds, color="0.8", zorder=0)
left.set(title=f"Ten frequencies of {len(full)} dofs", xlabel="Coordinates",
         ylabel="Largest relative error")
right.set(title="The estimate does not know the full model", xlabel="Error",
          ylabel="Estimated error")
left.legend()
common.save(figure, options, "choose_a_basis")

# %% A tolerance chooses the modes
chosen = tj.synthesise(parts, "Craig-Bampton", frequency_tolerance=1e-4, estimated_frequencies=10)
kept = ", ".join(f"{part.modes} of {part.name}" for part in chosen.parts)
worst = max(row["error"] for row in tj.compare_modes(chosen, 10))
print(f"A tolerance of 1e-4 keeps {kept}: error {worst:.1e}.")
assert worst < 1e-4
