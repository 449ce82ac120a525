#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Maps of `tooljoint map` as pictures: plot_map.py DIR

DIR holds map.csv and summary.json. Every value of the list `Map/Values` becomes map_NAME.png and .svg: cells coloured by the value over the
first two axes, contour lines where the grid has three points or more each way, unsafe cells hatched with the limit as a line, failed points
crossed out. With more than two axes each point of the others has a picture of its own.
"""
import csv
import itertools
import json
import pathlib
import re
import sys

import plots
from plots import np, plt

UNSAFE = "#D55E00"
LEAST_FOR_CONTOURS = 3  # points along an axis


def fail(sentence):
    sys.exit(f"plot_map.py: {sentence}")


class Map:
    """The table of a map as grids."""

    def __init__(self, folder):
        try:
            summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))["map"]
            with open(folder / "map.csv", encoding="utf-8", newline="") as file:
                lines = list(csv.reader(file))
        except (OSError, KeyError, ValueError) as problem:
            fail(f"{folder} holds no map: {problem}")
        self.axes, self.values = summary["axes"], summary["values"]
        rows = [dict(zip((re.sub(r" \[[^\]]*\]$", "", name) for name in lines[0]), line)) for line in lines[1:]]
        shape = [axis["points"] for axis in self.axes]
        if len(rows) != np.prod(shape):
            fail(f"{folder}/map.csv has {len(rows)} rows, the grid of summary.json {np.prod(shape)} points.")
        self.failed = np.array([row["status"] != "done" for row in rows]).reshape(shape)
        self.grid = {value["name"]: np.array([float(row[value["name"]] or "nan") for row in rows]).reshape(shape) for value in self.values}
        for k, axis in enumerate(self.axes):
            texts = list(dict.fromkeys(row[axis["name"]] for row in rows))
            axis["texts"] = texts
            # points that are no numbers stand in their order
            axis["places"] = np.array([float(text) for text in texts]) if axis["numeric"] else np.arange(shape[k], dtype=float)
            axis["label"] = axis["name"] + (f" [{axis['unit']}]" if axis["unit"] else "")


def edges(places):
    """Borders of the cells around increasing places."""
    middle = (places[1:] + places[:-1]) / 2
    return np.concatenate([[2 * places[0] - middle[0]], middle, [2 * places[-1] - middle[-1]]])


def limits(value):
    return sorted(value[name] for name in ("unsafe_above", "unsafe_below") if value[name] is not None)


def unsafe(value, grid):
    out = np.zeros(grid.shape, bool)
    if value["unsafe_above"] is not None:
        out |= grid > value["unsafe_above"]
    if value["unsafe_below"] is not None:
        out |= grid < value["unsafe_below"]
    return out


def lines(axes, x, y, grid, value):
    """Contours through the points; the limit between safe and unsafe is drawn heavier."""
    if min(len(x), len(y)) < LEAST_FOR_CONTOURS or np.count_nonzero(np.isfinite(grid)) < LEAST_FOR_CONTOURS ** 2 or np.nanmin(grid) == np.nanmax(grid):
        return
    masked = np.ma.masked_invalid(grid.T)
    drawn = axes.contour(x, y, masked, levels=5, colors="white", linewidths=0.7)
    axes.clabel(drawn, fontsize=7, fmt=plots.tick)
    levels = [level for level in limits(value) if np.nanmin(grid) < level < np.nanmax(grid)]
    if levels:
        axes.contour(x, y, masked, levels=levels, colors=UNSAFE, linewidths=1.8)


def draw(made, value, rest):
    first, second = made.axes[:2]
    # cells need increasing places
    order = np.argsort(first["places"]), np.argsort(second["places"])
    pick = lambda grid: grid[(slice(None), slice(None), *rest)][np.ix_(*order)]  # noqa: E731
    grid, failed = pick(made.grid[value["name"]]), pick(made.failed)
    x, y = first["places"][order[0]], second["places"][order[1]]
    picture, axes = plots.figure(plots.WIDE, 4.2)
    axes.grid(False)
    if np.isfinite(grid).any():
        whole = made.grid[value["name"]]
        cells = axes.pcolormesh(edges(x), edges(y), np.ma.masked_invalid(grid.T), cmap=plots.MAP, vmin=np.nanmin(whole), vmax=np.nanmax(whole))
        picture.colorbar(cells, ax=axes, label=value["key"].removeprefix("transient.figures."))
    lines(axes, x, y, grid, value)
    beyond = unsafe(value, grid)
    if beyond.any():
        left, low = edges(x), edges(y)
        for i, j in np.argwhere(beyond):
            axes.add_patch(plt.Rectangle((left[i], low[j]), left[i + 1] - left[i], low[j + 1] - low[j], fill=False, hatch="///", edgecolor=UNSAFE, linewidth=0))
        axes.scatter([], [], marker="s", facecolor="none", edgecolor=UNSAFE, hatch="////", label="unsafe")
    lost = failed | ~np.isfinite(grid)
    if lost.any():
        i, j = np.nonzero(lost)
        axes.scatter(x[i], y[j], marker="x", color="#4D4D4D", label="missing")
    for axis, along, keep in ((first, axes.xaxis, order[0]), (second, axes.yaxis, order[1])):
        along.set_ticks(axis["places"][keep], [pathlib.PurePath(axis["texts"][i]).name for i in keep] if not axis["numeric"] else [plots.tick(place) for place in axis["places"][keep]])
    axes.set_xlabel(first["label"])
    axes.set_ylabel(second["label"])
    title = value["name"] + "".join(f", {axis['name']} {axis['texts'][i]} {axis['unit']}" for axis, i in zip(made.axes[2:], rest))
    axes.set_title(title.strip(), pad=18 if beyond.any() or lost.any() else 6)
    if beyond.any() or lost.any():
        plots.legend_above(axes)
    return picture


def main():
    if len(sys.argv) != 2:
        fail("give the folder of a map.")
    folder = pathlib.Path(sys.argv[1])
    made = Map(folder)
    plots.use_style()
    for value in made.values:
        for rest in itertools.product(*(range(axis["points"]) for axis in made.axes[2:])):
            name = "map_" + re.sub(r"\W+", "_", value["name"]) + "".join(f"_{i + 1}" for i in rest)
            picture = draw(made, value, rest)
            for kind in ("png", "svg"):
                picture.savefig(folder / f"{name}.{kind}")
            plt.close(picture)
            print(f"{folder / name}.png")


if __name__ == "__main__":
    main()
