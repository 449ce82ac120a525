#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the maps of `tooljoint map`: plot_map.py DIR

DIR contains map.csv and summary.json. Every value of the list `Map/Values` becomes map_NAME.png and
.svg: cells over the first two axes coloured by the value, contour lines if the grid has at least
three points in each direction, unsafe cells hatched, a line at the limit, failed points crossed
out. With more than two axes there is one picture for each point of the other axes.
"""
import argparse
import itertools
import pathlib
import re

import plots  # must precede matplotlib
from plots import np, plt
from matplotlib.patches import PathPatch
from matplotlib.path import Path

from report import deck, files, results

UNSAFE = "#D55E00"
LEAST_FOR_CONTOURS = 3  # fewest points along an axis
CONTOURS = 6  # intervals between contour lines, at most
MOST_CELLS = 400  # up to this many are vector graphics, more an image
MOST_TICKS = 9, 14  # horizontal, vertical
LONGEST_TICKS = 48  # letters of all ticks of a horizontal axis


class Map:
    """The table of a map as grids: `failed`, and `grid` for each value, nan where the value is not
    known. `rows` are those of map.csv, by names without units, in the order of the grids.
    Unreadable: the table is missing or does not match the summary."""
    def __init__(self, folder):
        summary, lines = results.read_summary(folder).get("map"), files.read_rows(
            folder / "map.csv")
        if not summary or not summary.get("axes"):
            raise files.Unreadable(f"{folder}/summary.json is not that of a map that has ended. "
                                   f"tooljoint map DECK --output {folder} goes on with the map, "
                                   f"--collect {folder} makes one of the points that are done.")
        self.folder, self.axes, self.values = folder, summary["axes"], summary["values"]
        self.rows = [
            dict(zip((re.sub(r" \[[^\]]*\]$", "", name) for name in lines[0]), line))
            for line in lines[1:]
        ]
        shape = [axis["points"] for axis in self.axes]
        if len(self.rows) != np.prod(shape):
            raise files.Unreadable(f"{folder}/map.csv has {len(self.rows)} rows, the grid of "
                                   f"summary.json {np.prod(shape)} points. Run the map again, or "
                                   "restore both files from a copy.")
        with files.reading(folder / "map.csv"):
            self.sort(shape)

    def sort(self, shape):
        rows = self.rows
        self.failed = np.array([row["status"] != "done" for row in rows]).reshape(shape)
        self.grid = {
            value["name"]: np.array([float(row[value["name"]] or "nan") for row in rows
                                     ]).reshape(shape) for value in self.values
        }
        for k, axis in enumerate(self.axes):
            texts = list(dict.fromkeys(row[axis["name"]] for row in rows))
            axis["texts"] = texts
            # values that are not numbers keep their order
            axis["places"] = np.array([float(text) for text in texts
                                       ]) if axis["numeric"] else np.arange(shape[k], dtype=float)
            axis["label"] = axis["name"] + (f" [{axis['unit']}]" if axis["unit"] else "")

    def pictures(self):
        """(value, point of the third and further axes, name of the picture) of all pictures."""
        for value in self.values:
            for rest in itertools.product(*(range(axis["points"]) for axis in self.axes[2:])):
                yield value, rest, "map_" + re.sub(r"\W+", "_", value["name"]) + "".join(
                    f"_{i + 1}" for i in rest)

    def conditions(self):
        """Scene, fixed parameters and overrides, for the second line of a title."""
        with results.open_results(self.folder / "map.h5") as file:
            said = {
                name: file.attrs.get(name, "") for name in ("deck_file", "deck_text", "overrides")
            }
        fixed = deck.conditions(deck.read(said["deck_text"], said["overrides"]),
                                {axis["parameter"] for axis in self.axes})
        changed = ", ".join(line for line in said["overrides"].splitlines()
                            if line and not line.startswith(("Map/", "!Map/")))
        return "; ".join(filter(None, (pathlib.PurePath(said["deck_file"]).stem, fixed, changed)))


def edges(places):
    """Borders of the cells around increasing positions."""
    middle = (places[1:] + places[:-1]) / 2
    return np.concatenate([[2 * places[0] - middle[0]], middle, [2 * places[-1] - middle[-1]]])


def limits(value):
    return sorted(
        value[name] for name in ("unsafe_above", "unsafe_below") if value[name] is not None)


def unsafe(value, grid):
    out = np.zeros(grid.shape, bool)
    if value["unsafe_above"] is not None:
        out |= grid > value["unsafe_above"]
    if value["unsafe_below"] is not None:
        out |= grid < value["unsafe_below"]
    return out


def lines(axes, x, y, grid, value):
    """Contour lines; the limit between safe and unsafe is drawn thicker."""
    if min(len(x), len(y)) < LEAST_FOR_CONTOURS or np.count_nonzero(
            np.isfinite(grid)) < LEAST_FOR_CONTOURS**2 or np.nanmin(grid) == np.nanmax(grid):
        return
    masked = np.ma.masked_invalid(grid.T)
    low, high = np.nanmin(grid), np.nanmax(grid)
    even = [
        level for level in plots.ticker.MaxNLocator(CONTOURS).tick_values(low, high)
        if low < level < high
    ]
    if even:
        # dark lines on the light half of the colours
        drawn = axes.contour(
            x, y, masked, levels=even,
            colors=["white" if level < (low + high) / 2 else "black" for level in even],
            linewidths=0.7)
        axes.clabel(drawn, fontsize=8, fmt=plots.tick)
    levels = [level for level in limits(value) if low < level < high]
    if levels:
        axes.contour(x, y, masked, levels=levels, colors=UNSAFE, linewidths=1.8)


def hatch(axes, x, y, beyond):
    """Hatches the unsafe cells; adjacent cells of a row become one rectangle."""
    left, low = edges(x), edges(y)
    areas = []
    for j, row in enumerate(beyond.T):
        ends = np.flatnonzero(np.diff(np.concatenate([[0], row, [0]])))
        areas += [
            plt.Rectangle((left[first], low[j]), left[last] - left[first], low[j + 1] - low[j])
            for first, last in ends.reshape(-1, 2)
        ]
    outline = Path.make_compound_path(*(area.get_transform().transform_path(area.get_path())
                                        for area in areas))
    axes.add_patch(PathPatch(outline, fill=False, hatch="///", edgecolor=UNSAFE, linewidth=0))
    axes.scatter([], [], marker="s", facecolor="none", edgecolor=UNSAFE, hatch="////",
                 label="unsafe")


def tick_texts(axes, along, axis, places, order, most):
    """Ticks at the points, or at as many of them as fit."""
    texts = [
        f"{place:.5g}" if axis["numeric"] else pathlib.PurePath(axis["texts"][i]).name
        for place, i in zip(places, order)
    ]
    room = (places[-1] - places[0]) / most
    kept = [0]
    for i, place in enumerate(places):
        if place - places[kept[-1]] >= room:
            kept.append(i)
    along.set_ticks(places[kept], [texts[i] for i in kept])
    if along is axes.xaxis and sum(len(texts[i]) for i in kept) > LONGEST_TICKS:
        plt.setp(axes.get_xticklabels(), rotation=30, ha="right", rotation_mode="anchor")
    along.set_label_text(axis["label"])


def draw(made, value, rest, conditions=""):
    """The map of one value over the first two axes, at the point `rest` of the others. `conditions`
    are written below the title of pictures that are not part of a page."""
    first, second = made.axes[:2]
    # cells need increasing positions
    order = np.argsort(first["places"]), np.argsort(second["places"])
    pick = lambda grid: grid[(slice(None), slice(None), *rest)][np.ix_(*order)]  # noqa: E731
    grid, failed = pick(made.grid[value["name"]]), pick(made.failed)
    x, y = first["places"][order[0]], second["places"][order[1]]
    picture, axes = plots.figure(plots.WIDE, 3.6)
    axes.grid(False)
    if np.isfinite(grid).any():
        whole = made.grid[value["name"]]
        cells = axes.pcolormesh(edges(x), edges(y), np.ma.masked_invalid(grid.T), cmap=plots.MAP,
                                vmin=np.nanmin(whole), vmax=np.nanmax(whole),
                                rasterized=grid.size > MOST_CELLS)
        picture.colorbar(cells, ax=axes, label=plots.label(value["name"], value.get("unit") or ""))
    lines(axes, x, y, grid, value)
    beyond = unsafe(value, grid)
    if beyond.any():
        hatch(axes, x, y, beyond)
    lost = failed | ~np.isfinite(grid)
    if lost.any():
        i, j = np.nonzero(lost)
        axes.scatter(x[i], y[j], marker="x", color="#4D4D4D", label="missing")
    tick_texts(axes, axes.xaxis, first, x, order[0], MOST_TICKS[0])
    tick_texts(axes, axes.yaxis, second, y, order[1], MOST_TICKS[1])
    title = value["name"] + "".join(f", {axis['name']} {axis['texts'][i]} {axis['unit']}"
                                    for axis, i in zip(made.axes[2:], rest))
    if conditions:
        plots.headline(picture, title.strip(), conditions)
    else:
        axes.set_title(title.strip(), pad=18 if beyond.any() or lost.any() else 6)
    if beyond.any() or lost.any():
        plots.legend_above(axes)
    return picture


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, metavar="DIR", help="folder of a finished map")
    folder = parser.parse_args().folder
    plots.use_style()
    with files.failing():
        made = Map(folder)
        conditions = made.conditions()
        for value, rest, name in made.pictures():
            picture = draw(made, value, rest, conditions)
            for kind in ("png", "svg"):
                with files.writing(folder / f"{name}.{kind}"):
                    picture.savefig(folder / f"{name}.{kind}")
            plt.close(picture)
            print(f"{folder / name}.png")


if __name__ == "__main__":
    main()
