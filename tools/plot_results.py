#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what a run left in its folder: tools/plot_results.py DIR [--output FILE.png]

Of a string: its well coloured by contact force, static radial displacement and clearance, contact forces, axial force and torque, and
the bit speed over time. Of a scene of parts, for each component: displacement at the start and largest displacement of all nodes, and the
motion of the node that moves most; recorded forces between parts. Needs h5py, numpy and matplotlib; reads results.h5 alone.
"""
import sys

try:
    import h5py
    import numpy as np

    from plots import COLOURS, MAP, RPM, draw_folder, plt
except ImportError as missing:
    sys.exit(f"{missing}: plot_results.py needs h5py, numpy and matplotlib (Debian: python3-h5py python3-matplotlib, then /usr/bin/python3).")


def draw_well(axes, results):
    """Nodes on the well axis (deviation not to scale), coloured by the static contact force."""
    position = results["/model/position"][:]
    force = results["/static/normal_force"][:] / 1e3
    axes.plot(*position.T, color="0.8", linewidth=4, zorder=0)
    points = axes.scatter(*position.T, c=force, cmap=MAP, s=8, depthshade=False)
    axes.invert_zaxis()
    axes.view_init(elev=18, azim=-150)
    axes.set_xlabel("north [m]"), axes.set_ylabel("east [m]"), axes.set_zlabel("depth [m]")
    axes.set_title("string in its well")
    plt.colorbar(points, ax=axes, shrink=0.6, pad=0.12, label="static contact force [kN]")


def draw_static(radial, contact, axial, results):
    s = results["/model/s"][:]
    middle = 0.5 * (s[1:] + s[:-1])
    displacement = results["/static/displacement"][:]
    radial.fill_between(s, 1e3 * results["/model/clearance"][:], step="mid", color="0.88", label="clearance")
    radial.plot(s, 1e3 * np.hypot(displacement[:, 0], displacement[:, 1]), ".-", markersize=3, linewidth=0.8, label="static radial displacement")
    radial.set_ylabel("[mm]"), radial.legend(fontsize=7)
    contact.vlines(s, 0, results["/static/normal_force"][:] / 1e3, linewidth=1.2)
    contact.set_ylabel("contact force [kN]")
    axial.plot(middle, results["/static/axial_force"][:] / 1e3, label="axial force [kN]")
    axial.plot(middle, results["/static/torque"][:] / 1e3, label="torque [kN m]")
    axial.axhline(0, color="0.7", linewidth=0.6), axial.legend(fontsize=7)
    axial.set_xlabel("depth along the well [m]")


def draw_motion(axes, results):
    time = results["/transient/time"][:]
    rotary = results["/transient/speed"][:]
    bit = rotary + results["/transient/velocity"][:, -1, 5]
    axes.plot(time, RPM * bit, linewidth=0.6, label="bit")
    axes.plot(time, RPM * rotary, linewidth=1.2, label="surface")
    axes.set_xlabel("time [s]"), axes.set_ylabel("speed [rpm]"), axes.legend(fontsize=7)


def draw_string(results):
    moves = "/transient/velocity" in results
    figure = plt.figure(figsize=(11, 8 if moves else 6), constrained_layout=True)
    grid = figure.add_gridspec(4 if moves else 3, 2, width_ratios=[1, 1.15])
    draw_well(figure.add_subplot(grid[:3, 0], projection="3d"), results)
    draw_static(*(figure.add_subplot(grid[row, 1]) for row in range(3)), results)
    if moves:
        draw_motion(figure.add_subplot(grid[3, :]), results)
    return figure


def texts(dataset):
    return [value.decode() if isinstance(value, bytes) else value for value in dataset[:]]


def draw_nodes(axes, results, start, motion):
    """A component of all nodes, part by part: at the start, and the range of the motion (samples x nodes, or None)."""
    part, names = results["/model/part"][:], texts(results["/model/part_names"])
    row = np.arange(part.size)
    if motion is not None:
        axes.fill_between(row, motion.min(axis=0), motion.max(axis=0), step="mid", color=COLOURS[5], alpha=0.3, linewidth=0, label="range of the motion")
    axes.plot(row, start, "k.", markersize=3, label="start")
    for first in np.flatnonzero(np.diff(part)):
        axes.axvline(first + 0.5, color="0.8", linewidth=0.6)
    axes.set_xticks([row[part == number].mean() for number in np.unique(part)])
    axes.set_xticklabels([names[number - 1] for number in np.unique(part)], fontsize=7, rotation=20)
    axes.set_xlim(-0.5, part.size - 0.5)


def draw_mover(axes, results, start, motion):
    """The motion over time of the node that moves most."""
    node = int(np.abs(motion - start).max(axis=0).argmax())
    name = texts(results["/model/part_names"])[results["/model/part"][node] - 1]
    axes.plot(results["/transient/time"][:], motion[:, node], linewidth=0.7, label=f"node {results['/model/node'][node]} of {name}")
    axes.legend(fontsize=7, loc="upper right")


def draw_forces(axes, results, name):
    """A recorded channel of a point law: the largest size over its points."""
    channel = results[name]
    axes.plot(results["/transient/time"][:], np.abs(channel[:]).max(axis=1), linewidth=0.7)
    axes.set_title(f"{name.removeprefix('/transient/')}, largest size", fontsize=8)
    axes.set_ylabel(f"[{channel.attrs['units']}]")


def draw_parts(results):
    components, units = texts(results["/model/components"]), texts(results["/model/component_units"])
    start = results["/static/displacement"][:]
    motion = results["/transient/displacement"][:] if "/transient/displacement" in results else None
    moving = results.get("/transient", {})
    channels = [f"/transient/{law}/{name}" for law in moving if isinstance(moving[law], h5py.Group) for name in moving[law]]
    rows, columns = len(components) + len(channels), 1 if motion is None and not channels else 2
    figure, axes = plt.subplots(rows, columns, figsize=(5.5 * columns, 1 + 1.4 * rows), squeeze=False, constrained_layout=True)
    for c, (name, unit) in enumerate(zip(components, units)):
        draw_nodes(axes[c, 0], results, start[:, c], None if motion is None else motion[:, :, c])
        axes[c, 0].set_ylabel(f"{name} [{unit}]" if unit else name)
        axes[c, 0].tick_params(labelbottom=c + 1 == len(components))
        if motion is not None:
            draw_mover(axes[c, 1], results, start[:, c], motion[:, :, c])
        elif columns == 2:
            axes[c, 1].axis("off")
    for row, name in enumerate(channels, len(components)):
        axes[row, 0].axis("off")
        draw_forces(axes[row, 1], results, name)
    axes[0, 0].legend(fontsize=7)
    if columns == 2:
        axes[-1, 1].set_xlabel("time [s]")
    return figure


if __name__ == "__main__":
    draw_folder(__doc__, "folder of a run that ended", {"results.h5": lambda results: draw_parts(results) if "/model/part_names" in results else draw_string(results)})
