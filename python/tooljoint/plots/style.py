# SPDX-License-Identifier: BSD-3-Clause
"""Colours, axes and titles of all plots."""
from __future__ import annotations

import math
import textwrap
from typing import Any, Callable, Sequence

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from matplotlib import ticker
from matplotlib.transforms import ScaledTranslation

RPM = 30 / np.pi
# Okabe and Ito (2008), distinguishable by everyone, darkened if too light for thin lines.
COLOURS = [
    "#0072B2", "#C24E00", "#009E73", "#B8860B", "#CC4C99", "#3F9BD4", "#7A3E9D", "#4D4D4D",
    "#8C2D04", "#5C7A00", "#E69F00", "#117733", "#882255", "#1B9E9E", "#6B4C2A", "#9A6FB0"
]
# 13 markers and 16 colours have no common divisor, so that no pair occurs twice
MARKERS = "osD^vPX*hp<>d"
GREY = "#8a8a8a"
PALE = "#d9d9d9"
SUPERSCRIPTS = str.maketrans("-0123456789",
                             "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")  # as text: matplotlib takes 10 ms for a formula
MAP = "cividis"  # of forces and stresses: safe for colour blindness and in grey
STYLE = {
    "font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "axes.titlesize": 10,
    "axes.titleweight": "bold", "axes.titlelocation": "left", "axes.edgecolor": "#555555",
    "xtick.color": "#555555", "ytick.color": "#555555", "axes.grid": True, "grid.color": "#e6e6e6",
    "grid.linewidth": 0.6, "axes.prop_cycle": matplotlib.cycler(color=COLOURS),
    "svg.fonttype": "none", "svg.hashsalt": "tooljoint", "figure.dpi": 100, "savefig.dpi": 150,
    "legend.frameon": False
}
SLENDER = 2.9  # width of a plot of one column in a report [inch]
WIDE = 4.8
PAD = 3.0  # of matplotlib's constrained layout [pt], above a title


def use_style() -> None:
    """Draws all later figures of the process in this style."""
    plt.rcParams.update(STYLE)


def label(quantity: str, unit: str = "") -> str:
    """Label of an axis: "torque [kN m]"; only the name for a quantity without unit."""
    return f"{quantity} [{unit}]" if unit and unit != "1" else quantity


def tick(value: float, _: Any = None) -> str:
    return f"{value + 0.0:.10g}"


def figure(width: float = WIDE, height: float = 3.0) -> tuple[Any, Any]:
    """A figure and its axes, without overlaps. The number of ticks is fixed: if it depended on the
    size of the axes, it would change that size."""
    made, axes = plt.subplots(figsize=(width, height), constrained_layout=True)
    whole_ticks(axes, 8 if width > SLENDER else 4, 8 if height > 2.9 else 5)
    return made, axes


def whole_ticks(axes: Any, across: int, up: int) -> None:
    """At most so many ticks, with full numbers, without a common factor or offset."""
    for axis, most in ((axes.xaxis, across), (axes.yaxis, up)):
        axis.set_major_locator(ticker.MaxNLocator(most))
        axis.set_major_formatter(ticker.FuncFormatter(tick))


def headline(made: Any, what: str, conditions: str = "") -> None:
    """Title of a figure with constrained layout: its content, and its conditions smaller below."""
    lines = textwrap.wrap(conditions, int(17 * made.get_figwidth()))
    made.suptitle("\n".join([what, *(" " for _ in lines)]), x=0.01, ha="left", fontsize=10,
                  fontweight="bold")
    down = ScaledTranslation(0, -(PAD + 14) / 72, made.dpi_scale_trans)
    made.text(0.01, 1.0, "\n".join(lines), transform=made.transFigure + down, va="top", fontsize=8,
              color="#555555").set_in_layout(False)


def depth_axis(axes: Any, limits: tuple[float, float], name: str = "measured depth") -> None:
    """Makes the vertical axis a depth between `limits` [m], downwards."""
    axes.set_ylabel(label(name, "m"))
    axes.set_ylim(max(limits), min(limits))


def profile(text: str, limits: tuple[float, float], height: float = 4.2) -> tuple[Any, Any]:
    """Narrow axes with the measured depth downwards between `limits` [m]."""
    made, axes = figure(SLENDER, height)
    axes.set_xlabel(text)
    depth_axis(axes, limits)
    return made, axes


def profiles(row: Sequence[Any], labels: Sequence[str], limits: tuple[float, float]) -> None:
    """Narrow axes side by side with a common measured depth, numbered on the first of them."""
    for number, (axes, text) in enumerate(zip(row, labels)):
        whole_ticks(axes, 3, 8)
        axes.set_xlabel(text)
        depth_axis(axes, limits)
        if number:
            axes.set_ylabel("")
            axes.tick_params(labelleft=False)


def in_time(text: str, times: Sequence[float], height: float = 2.5,
            width: float = WIDE) -> tuple[Any, Any]:
    """Axes over the time between the first and the last of `times` [s]."""
    made, axes = figure(width, height)
    axes.set_xlabel(label("time", "s"))
    axes.set_ylabel(text)
    if len(times) > 1:
        axes.set_xlim(times[0], times[-1])
    return made, axes


def panels(count: int, height: float = 2.3, width: float = 4.0,
           **options: Any) -> tuple[Any, list[Any], int]:
    """A grid of small plots with shared axes, about square: the figure, its axes, the number of
    columns."""
    columns = min(3, count)
    rows = -(-count // columns)
    made, grid = plt.subplots(rows, columns, figsize=(width * columns + 0.6, height * rows + 0.7),
                              squeeze=False, constrained_layout=True, **options)
    for index, unused in enumerate(grid.flat[count:], count):
        unused.set_visible(False)
        grid.flat[index - columns].tick_params(labelbottom=True)
    return made, list(grid.flat[:count]), columns


def shades(colour: str, count: int) -> list[tuple[float, ...]]:
    """Colours from pale to full."""
    base = np.array(matplotlib.colors.to_rgb(colour))
    shares: Any = np.linspace(0.35, 1, count) if count > 1 else [1.0]
    return [tuple(1 - (1 - base) * f) for f in shares]


def legend_above(axes: Any, columns: int = 4, left: float = 0.0) -> None:
    """A legend that covers no data: in rows above the axes, starting at `left` (in widths of the
    axes)."""
    axes.legend(loc="lower left", bbox_to_anchor=(left, 1.0), ncol=columns, fontsize=8,
                borderaxespad=0.2, handlelength=1.4, columnspacing=1.0)


def square(axes: Any, reach: float) -> None:
    """Axes of two lengths with the same scale around zero."""
    axes.set_xlim(-reach, reach), axes.set_ylim(-reach, reach)
    axes.set_aspect("equal")


def power(value: float) -> str:
    """A positive number as a power of ten, with a factor before it where it has one.

    >>> power(1e-6), power(2e-5)
    ('10⁻⁶', '2·10⁻⁵')
    """
    exponent = math.floor(math.log10(value) + 1e-9)
    factor = f"{value / 10.0 ** exponent:.3g}"
    return ("" if factor == "1" else factor + "·") + "10" + str(exponent).translate(SUPERSCRIPTS)


def plain(value: float, low: float | None = None, high: float | None = None) -> str:
    """Numbers on logarithmic axes as people write them; all of an axis between `low` and `high` are
    written in one way.

    >>> plain(0.02), plain(1e-6), plain(0), plain(0.1, 1e-6, 1.0)
    ('0.02', '10⁻⁶', '', '10⁻¹')
    """
    if value <= 0:
        return ""
    return f"{value:g}" if 1e-3 <= (low or value) and (high or value) < 1e4 else power(value)


def percent(value: float, low: float | None = None, high: float | None = None) -> str:
    """Shares on logarithmic axes; on an axis that goes below 0.001 % as powers of ten.

    >>> percent(0.025), percent(0.1, 1e-6, 1.0)
    ('2.5 %', '10⁻¹')
    """
    if value <= 0:
        return ""
    return f"{100 * value:g} %" if (low or value) >= 1e-5 else power(value)


def logarithmic(axis: Any, formatter: Callable[..., str] = plain) -> None:
    """Ticks of a logarithmic axis with final limits: decades, minor ticks unless there are many,
    and numbered ticks at 2, 3, 5 if the axis is shorter than one and a half decades. `formatter`
    writes a number, given the least and largest decade of the axis."""
    def text(value: float, _: Any = None) -> str:
        low, high = sorted(axis.get_view_interval())
        return formatter(
            value,
            *(10.0**math.ceil(math.log10(low) - 1e-9), high) if low > 0 else (None, None))

    axis.set_major_locator(ticker.LogLocator(base=10, numticks=20))
    axis.set_major_formatter(ticker.FuncFormatter(text))
    low, high = axis.get_view_interval()
    narrow = low > 0 and high < 30 * low
    wide = low > 0 and high > 1e6 * low
    axis.set_minor_locator(ticker.NullLocator() if wide else ticker.
                           LogLocator(base=10, subs=(2, 3,
                                                     5) if narrow else range(2, 10), numticks=40))
    axis.set_minor_formatter(ticker.FuncFormatter(text) if narrow else ticker.NullFormatter())


def log_log(axes: Any, x: Callable[..., str] = plain, y: Callable[..., str] = plain) -> None:
    """Logarithmic axes with the limits of the data; `x` and `y` format the ticks."""
    axes.set_xscale("log"), axes.set_yscale("log")
    logarithmic(axes.xaxis, x)
    logarithmic(axes.yaxis, y)


def error_band(axes: Any, x: Any, low: Any, high: Any, colour: str = GREY, text: str | None = None,
               sideways: bool = False) -> None:
    """Draws the uncertainty of a curve as a pale band between `low` and `high` at each `x`;
    `sideways`: at each y, for an uncertain abscissa."""
    fill = axes.fill_betweenx if sideways else axes.fill_between
    fill(x, low, high, color=colour, alpha=0.25, linewidth=0, zorder=0, label=text)
