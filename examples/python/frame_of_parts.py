#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A frame of parts: a portal with a gable, five parts of plane beam elements in one loop, as in
examples/06_frame_with_a_loop.

          5
        /   \\
      4 ----- 3
      |       |
      1       2

Every member is a separate part, with scipy matrices in the common axes; nodes with equal numbers
are joined. The feet 1 and 2 are clamped. The frame is reduced, compared with the unreduced one, and
shaken at its apex, without and with a guy rope at corner 3, a law written here.
"""
# %% Definitions
import common  # in the folder of this script
import numpy as np
import tooljoint as tj

EA, EI, MASS = 4.0e8, 6.0e5, 30.0  # N, N m2, kg/m
CORNERS = {1: (0, 0), 2: (6, 0), 3: (6, 4), 4: (0, 4), 5: (3, 6)}
MEMBERS = {
    "left column": (1, 4), "right column": (2, 3), "tie beam": (4, 3), "left rafter": (4, 5),
    "right rafter": (3, 5)
}


@tj.point_law("Guy Rope", width=2)
def guy_rope(t, d, v, stiffness=tj.Parameter(unit="N/m"), damping=tj.Parameter(0.0, "N s/m")):
    """A rope down to the right at 45 degrees: it pulls when it is stretched, and is slack
    otherwise."""
    along = np.array([-1.0, 1.0]) / np.sqrt(2)  # from the anchor to the corner
    longer, rate = d @ along, v @ along
    return np.outer(np.where(longer > 0, -stiffness * longer - damping * rate, 0.0), along)


def member(name, elements):
    """Matrices of a member in the common axes, without the dofs of a clamped foot."""
    (first,
     last), length, (c, s) = MEMBERS[name], *common.line(*(CORNERS[node] for node in MEMBERS[name]))
    K, M = common.beam(length, elements, EA, EI, MASS, c, s)
    nodes = np.repeat([first, *(1000 * first + 100 * last + np.arange(1, elements)), last], 3)
    free = np.flatnonzero(nodes > 2)
    interface = np.flatnonzero(nodes[free] <= 5)
    part = tj.part(name, M[free][:, free], K[free][:, free], nodes=nodes[free],
                   component_names=("u", "v", "theta"), interface=interface)
    return part, nodes, (c, s)


# %% Parts, full and reduced
options = common.options(__doc__)
elements = 6 if options.short else 20
parts = [member(name, elements)[0] for name in MEMBERS]
full, reduced = tj.couple(parts), tj.synthesise(parts, "Craig-Bampton", modes=6)
comparison = tj.compare_modes(reduced, 8)
for row in comparison:
    print(f"{row['full_hz']:9.4f} Hz   error {row['error']:8.1e}   estimate "
          f"{row['estimate']:8.1e}   MAC {row['mac']:.6f}")
worst = max(row["error"] for row in comparison)
assert 0 <= worst < 1e-3, f"the reduced frame is wrong by {worst:.1e}"

# %% Motions with and without the rope
corner = [reduced.model.position(3, component) for component in ("u", "v")]
push = np.zeros(len(reduced.model))
push[reduced.model.position(5, "u")] = 20e3
end = 0.3 if options.short else 1.5
motions = {}
for rope in (False, True):
    model = reduced.model.copy()
    model.add_load(push, "shaker near the lowest mode", lambda t: np.sin(2 * np.pi * 3.0 * t))
    model.add_damping(1e-4 * model.stiffness())
    if rope:
        model.add_points("guy", tj.law("Guy Rope", stiffness="20 kN/mm", damping=2e3),
                         np.eye(len(model))[corner], nodes=[3])
    motion = tj.integrate(model, end, step="0.5 ms", sampling_interval="2.5 ms")
    motions["with the rope" if rope else "free"] = motion

# %% Shapes and histories
figure, (shapes, history) = common.figure(2)
modes = tj.modes(reduced, 2)
recovered = (reduced.model.recovery @ modes.shapes).reshape(-1, 3, 2)
place = {node: i for i, node in enumerate(reduced.model.recovery_nodes)}
for name in MEMBERS:
    _, nodes, _ = member(name, elements)
    nodes = nodes[::3]
    straight = np.linspace(CORNERS[nodes[0]], CORNERS[nodes[-1]], len(nodes))
    shapes.plot(*straight.T, color="0.8")
    for k, colour in ((0, "C0"), (1, "C1")):
        moved = straight + [
            recovered[place[node], :2, k] / abs(recovered[:, :2, k]).max() if node in place else
            (0, 0) for node in nodes
        ]
        shapes.plot(*moved.T, color=colour,
                    label=f"{modes.frequency[k]:.2f} Hz" if name == "tie beam" else None)
shapes.set(title="Two lowest modes, reduced", aspect="equal", xlabel="x [m]", ylabel="y [m]")
shapes.legend()
for name, motion in motions.items():
    history.plot(motion.time, 1e3 * motion.at(5, "u"), label=name)
history.set(title="The apex, shaken", xlabel=motion.time.label, ylabel="Displacement u [mm]")
history.legend()
common.save(figure, options, "frame_of_parts")
free, held = (abs(motion.at(3, "u")).max() for motion in motions.values())
print(f"The rope reduces the largest displacement of its corner from {1e3 * free:.2f} mm to "
      f"{1e3 * held:.2f} mm.")
assert held < free
