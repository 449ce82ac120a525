#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the figures of docs/scale.md from its tables: time and memory against dofs, ranks and rows.
Nothing is measured; tools/scale.py draws them too."""
import pathlib
import re
import sys

import plots

DOCS = pathlib.Path(__file__).resolve().parent.parent / "docs"
NAMES = {
    "scale_solids": "Time and memory of large parts against their dofs",
    "scale_strings": "Time of static states against their dofs",
    "scale_ranks": "Time, efficiency and memory against the number of ranks",
    "scale_rows": "Rows per hour and time of a plan"
}


def tables(text):
    """Tables of a document, each as a list of rows {column: text}; columns of equal name are
    numbered from the second one on."""
    found = []
    for block in re.findall(r"(?:^\|.*\n)+", text + "\n", re.M):
        head, _, *lines = [[cell.strip() for cell in line.strip().strip("|").split("|")]
                           for line in block.splitlines()]
        head = [
            name if head.index(name) == i else f"{name} {head[:i].count(name) + 1}"
            for i, name in enumerate(head)
        ]
        found.append([dict(zip(head, line)) for line in lines])
    return found


def table_with(found, *columns):
    """The table that has these columns."""
    return next(rows for rows in found if rows and all(column in rows[0] for column in columns))


def number(cell):
    """The number in a cell, or None."""
    read = re.match(r"-?[0-9.]+(e[-+]?[0-9]+)?", cell)
    return float(read.group()) if read else None


def line(axes, rows, x, y, style, text, place):
    """One column against another, where both are known."""
    pairs = [(number(row[x]), number(row[y])) for row in rows]
    known = sorted({pair for pair in pairs if None not in pair})
    if known:
        axes.plot(*zip(*known), style, color=plots.COLOURS[place], label=text)


def two(height=3.2):
    return plots.plt.subplots(1, 2, figsize=(7.4, height), constrained_layout=True)


def solids(found):
    figure, (time, space) = two()
    reduced, cut = table_with(found, "entries of K"), table_with(found, "largest estimate")
    for axes, column, whole in (
        (time, "wall [s]", "whole: wall [s]"),
        (space, "memory [MB]", "memory [MB] 2"),
    ):
        line(axes, reduced, "dofs", column, "o-", "reduction", 0)
        for place, ranks in ((1, "1"), (2, "2")):
            line(axes, [row for row in cut if row["ranks"] == ranks], "dofs", column, "s-",
                 f"50 modes by parts, {ranks} rank{'s' * (ranks != '1')}", place)
        line(axes, cut, "dofs", whole, "^--", "50 modes of the whole", 3)
        plots.log_log(axes)
        axes.set(xlabel="dofs of the block")
    time.set_ylabel(plots.label("wall time", "s"))
    space.set_ylabel(plots.label("peak memory of a rank", "MB"))
    time.legend(fontsize="x-small")
    return figure


def strings(found):
    figure, (equilibrium, whole) = two()
    rows = table_with(found, "equilibrium: 1 rank [s]")
    for axes, first, title in (
        (equilibrium, "equilibrium: 1 rank [s]", "equilibrium alone"),
        (whole, "whole: 1 rank [s]", "path, equilibrium and stability"),
    ):
        line(axes, rows, "dofs", first, "o-", "1 rank", 0)
        line(axes, rows, "dofs", "2 ranks [s]" if axes is equilibrium else "2 ranks [s] 2", "s-",
             "2 ranks", 1)
        plots.log_log(axes)
        axes.set(xlabel="dofs of the string", ylabel=plots.label("wall time", "s"), title=title)
    equilibrium.legend()
    return figure


def ranks(found):
    figure, (time, efficiency,
             space) = plots.plt.subplots(1, 3, figsize=(9, 3.6), constrained_layout=True,
                                         gridspec_kw={"width_ratios": (1.6, 1, 1)})
    for place, row in enumerate(table_with(found, "1 rank [us per step]")):
        steps = [number(row[f"{n} [us per step]"]) for n in ("1 rank", "2 ranks")]
        time.plot((1, 2), [steps[0] / each for each in steps], ".-",
                  color=plots.COLOURS[place % len(plots.COLOURS)],
                  label=f"{row['scene']}, {row['model']}")
    time.plot((1, 2), (1, 2), ":", color=plots.GREY, label="ideal")
    time.set(xlabel="ranks", ylabel="times as fast", xticks=(1, 2), ylim=(0.9, 3.2))
    time.legend(loc="upper left", fontsize="x-small")
    counted = table_with(found, "predicted efficiency")
    line(efficiency, counted, "ranks", "predicted efficiency", "o-", "", 0)
    efficiency.set(xlabel="ranks", ylabel=plots.label("predicted efficiency", "%"), ylim=(0, 105))
    line(space, counted, "ranks", "memory of a rank [MB]", "o-", "", 1)
    space.set(xlabel="ranks", ylabel=plots.label("memory of a rank", "MB"))
    space.set_ylim(0, 1.1 * max(number(row["memory of a rank [MB]"]) for row in counted))
    return figure


def rows(found):
    figure, (speed, plan) = two()
    measured = table_with(found, "rows", "ranks", "wall [s]")
    per_hour = [3600 * number(row["rows"]) / number(row["wall [s]"]) for row in measured]
    speed.plot([number(row["ranks"]) for row in measured], per_hour, "o-", color=plots.COLOURS[0])
    speed.set(xlabel="ranks", ylabel="rows per hour",
              xticks=[number(row["ranks"]) for row in measured])
    speed.set_ylim(bottom=0)
    planned = table_with(found, "plan: CPU [s]")
    line(plan, planned, "rows", "plan: CPU [s]", "o-", "plan", 0)
    line(plan, planned, "rows", "collect: CPU [s]", "s-", "collect", 1)
    plots.log_log(plan)
    plan.set(xlabel="rows of the study", ylabel=plots.label("CPU time", "s"))
    plan.legend()
    return figure


def draw(text, folder):
    """Draws all figures of the document `text` into a folder."""
    plots.use_style()
    found = tables(text)
    for name, make in (("scale_solids", solids), ("scale_strings", strings), ("scale_ranks", ranks),
                       ("scale_rows", rows)):
        plots.save(make(found), folder / f"{name}.svg")


def main():
    draw((DOCS / "scale.md").read_text(encoding="utf-8"), DOCS / "figures")
    return 0


if __name__ == "__main__":
    sys.exit(main())
