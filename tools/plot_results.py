#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what a run left in its folder: tools/plot_results.py DIR [--output FILE.png]

The string in its well coloured by contact force, static radial displacement and clearance, contact forces, axial force and torque, and
the bit speed over time. Needs h5py, numpy and matplotlib; reads results.h5 alone.
"""
import argparse
import pathlib
import sys

try:
    import h5py
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
except ImportError as missing:
    sys.exit(f"{missing}: plot_results.py needs h5py, numpy and matplotlib (Debian: python3-h5py python3-matplotlib, then /usr/bin/python3).")


def draw_well(axes, results):
    """Nodes on the well axis (deviation not to scale), coloured by the static contact force."""
    position = results["/model/position"][:]
    force = results["/static/normal_force"][:] / 1e3
    axes.plot(*position.T, color="0.8", linewidth=4, zorder=0)
    points = axes.scatter(*position.T, c=force, cmap="inferno_r", s=8, depthshade=False)
    axes.invert_zaxis()
    axes.view_init(elev=18, azim=-150)
    axes.set_xlabel("X [m]"), axes.set_ylabel("Y [m]"), axes.set_zlabel("Z [m]")
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
    rpm = 30 / np.pi
    axes.plot(time, rpm * bit, linewidth=0.6, label="bit")
    axes.plot(time, rpm * rotary, linewidth=1.2, label="surface")
    axes.set_xlabel("time [s]"), axes.set_ylabel("speed [rpm]"), axes.legend(fontsize=7)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, help="results folder of a run")
    parser.add_argument("--output", type=pathlib.Path, help="picture (default: DIR/results.png)")
    options = parser.parse_args()
    if not (options.folder / "results.h5").is_file():
        sys.exit(f"{options.folder} holds no results.h5: name the folder of a run that ended.")
    with h5py.File(options.folder / "results.h5") as results:
        moves = "/transient/velocity" in results
        figure = plt.figure(figsize=(11, 8 if moves else 6), constrained_layout=True)
        grid = figure.add_gridspec(4 if moves else 3, 2, width_ratios=[1, 1.15])
        draw_well(figure.add_subplot(grid[:3, 0], projection="3d"), results)
        draw_static(*(figure.add_subplot(grid[row, 1]) for row in range(3)), results)
        if moves:
            draw_motion(figure.add_subplot(grid[3, :]), results)
    figure.savefig(options.output or options.folder / "results.png", dpi=110)
    return 0


if __name__ == "__main__":
    sys.exit(main())
