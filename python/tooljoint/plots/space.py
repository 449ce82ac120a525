# SPDX-License-Identifier: BSD-3-Clause
"""Axes in space with one scale: north, east, depth."""
from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib import ticker

from .style import label

# shortest axis as a share of the longest, so that a vertical well has space for its numbers
LEAST_SHARE = 0.25
FEWEST = 2  # fewest numbers of a short axis
ZOOM = 0.8  # leaves room for the labels


def space_axes(made: Any, place: Any, names: tuple[str, str,
                                                   str] = ("north", "east", "depth")) -> Any:
    """Three-dimensional axes at a place of a grid (or 111), in metres; an axis "depth" is drawn
    downwards by equal_axes()."""
    axes = made.add_subplot(place, projection="3d")
    x, y, z = (label(name, "m") for name in names)
    axes.set_xlabel(x), axes.set_ylabel(y), axes.set_zlabel(z)
    axes.view_init(elev=18, azim=-150)
    axes.tick_params(labelsize=7, pad=0)
    axes.tick_params(axis="z", pad=9)
    for axis, turn, pad in (
        (axes.xaxis, 0, 10),
        (axes.yaxis, 0, 10),
        (axes.zaxis, 90, 24),
    ):  # pads [pt] for numbers of four digits
        axis.set_rotate_label(False)
        axis.label.set_rotation(turn)
        axis.labelpad = pad
    return axes


def equal_axes(axes: Any, points: Any) -> None:
    """Sets limits around `points` (n x 3) with the same scale on all three axes."""
    points = np.asarray(points, float)
    low, high = points.min(axis=0), points.max(axis=0)
    middle, span = 0.5 * (low + high), high - low
    span = np.maximum(span, LEAST_SHARE * (span.max() or 1.0))
    first, last = middle - 0.5 * span, middle + 0.5 * span
    axes.set_xlim(first[0], last[0]), axes.set_ylim(first[1], last[1])
    down = axes.get_zlabel().startswith("depth")
    axes.set_zlim(*((last[2], first[2]) if down else (first[2], last[2])))
    axes.set_box_aspect(span, zoom=ZOOM)
    for axis, share in zip((axes.xaxis, axes.yaxis, axes.zaxis), span / span.max()):
        axis.set_major_locator(ticker.MaxNLocator(max(FEWEST, round(5 * share)),
                                                  min_n_ticks=FEWEST))
