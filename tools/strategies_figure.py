#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the figure of docs/strategies.md from its table: CPU time without a strategy divided by
that with all. Nothing is measured; the target `strategies` draws it too."""
import pathlib
import re
import sys

import plots
from scale_figures import number, table_with, tables

DOCS = pathlib.Path(__file__).resolve().parent.parent / "docs"
NOT_STRATEGIES = ("case", "step [us]")
KINDS = {"same motion": "o", "motion differs": "s", "refused": "x"}


def kind(cell):
    """Outcome of a run without the strategy; None if the case does not use it."""
    if cell in ("-", ""):
        return None
    return ("refused"
            if cell == "refused" else "motion differs" if "differs" in cell else "same motion")


def draw(text):
    """The figure of a document `text`."""
    cases = table_with(tables(text), *NOT_STRATEGIES)
    names = [name for name in cases[0] if name not in NOT_STRATEGIES]
    right = 1.25 * max(number(row[name]) or 0 for row in cases for name in names)
    made, axes = plots.figure(7.4, 0.3 * len(names) + 1.5)
    for place, (what, marker) in enumerate(KINDS.items()):
        points = [(number(row[name]) or right, y) for y, name in enumerate(names) for row in cases
                  if kind(row[name]) == what]
        axes.plot([x for x, _ in points], [y for _, y in points], marker,
                  color=plots.COLOURS[place], alpha=0.75, label=f"{what} ({len(points)})")
    axes.axvline(1.0, color=plots.GREY, linewidth=0.8)
    axes.set_xscale("log")
    ticks = [tick for tick in (0.1, 0.2, 0.5, 1, 2, 5) if tick < right]
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.minorticks_off()
    axes.set_yticks(range(len(names)), names)
    axes.set(ylim=(len(names) - 0.5, -0.5),
             xlabel=plots.label("CPU time without the strategy over that with all",
                                "s/s"), ylabel="strategy that is left out")
    plots.legend_above(axes)
    machine = re.search(r"^Machine: (.*?)\.$", text, re.M)
    plots.headline(made, "Strategies of a step",
                   f"{len(cases)} cases of docs/strategies.md; {machine.group(1)}")
    return made


def main():
    plots.use_style()
    plots.save(draw((DOCS / "strategies.md").read_text(encoding="utf-8")),
               DOCS / "figures/strategies.svg")
    return 0


if __name__ == "__main__":
    sys.exit(main())
