# SPDX-License-Identifier: BSD-3-Clause
"""The style of all plots of the project: colours, units, axes, and figures as inline SVG.

Every axis has a label with its unit, depth points downwards, maps have north up and east to the right, and axes of lengths in space are
equal. The colours are those of Okabe and Ito (2008), which all can tell apart, darkened where they are too light for thin lines.
"""
import argparse
import io
import pathlib
import re
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib import ticker  # noqa: E402

RPM = 30 / np.pi
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#B8860B", "#CC4C99", "#3F9BD4", "#7A3E9D", "#4D4D4D", "#8C2D04", "#5C7A00", "#E69F00", "#117733", "#882255",
           "#1B9E9E", "#6B4C2A", "#9A6FB0"]
MARKERS = "osD^vPX*hp<>d"  # their number has no divisor in common with that of the colours, so that no pair comes twice
GREY = "#8a8a8a"
MAP = "cividis"  # of forces and stresses: the same for all eyes, and in grey
STYLE = {"font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "axes.titlesize": 10, "axes.titleweight": "bold", "axes.titlelocation": "left",
         "axes.edgecolor": "#555555", "xtick.color": "#555555", "ytick.color": "#555555", "axes.grid": True, "grid.color": "#e6e6e6", "grid.linewidth": 0.6,
         "svg.fonttype": "none", "figure.dpi": 100, "savefig.dpi": 150, "legend.frameon": False}
SLENDER = 2.9  # width of a plot of one column in a report [inch]
WIDE = 6.2


def use_style():
    plt.rcParams.update(STYLE)


def draw_folder(description, kind, files):
    """The main of a tool that draws the folder a command has left: the first of `files` (name.h5 -> function of the open file that makes a
    figure) in it gives name.png there, or the picture of --output. `kind`: the folder, in words. Ends with a sentence where none is there."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, help=kind)
    parser.add_argument("--output", type=pathlib.Path, help=f"picture (default: {' or '.join(pathlib.Path(f).stem + '.png' for f in files)} in the folder)")
    options = parser.parse_args()
    found = next((name for name in files if (options.folder / name).is_file()), None)
    if found is None:
        missing = f"neither {' nor '.join(files)}" if len(files) > 1 else f"no {next(iter(files))}"
        sys.exit(f"{options.folder} holds {missing}. Give the {kind}.")
    use_style()
    with h5py.File(options.folder / found, "r") as results:
        made = files[found](results)
    output = options.output or (options.folder / found).with_suffix(".png")
    made.savefig(output)
    print(f"drawn {output}")


def tick(value, _=None):
    return f"{value + 0.0:.10g}"


def figure(width=WIDE, height=3.0):
    """A figure and its axes, without overlaps. The number of ticks is given: one that grew with the axes would change the room they leave."""
    made, axes = plt.subplots(figsize=(width, height), constrained_layout=True)
    axes.xaxis.set_major_locator(ticker.MaxNLocator(8 if width > SLENDER else 4))
    axes.yaxis.set_major_locator(ticker.MaxNLocator(8 if height > 2.9 else 5))
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(ticker.FuncFormatter(tick))  # each tick has its number whole, without a factor or an offset in a corner
    return made, axes


def profile(label, limits, height=4.2):
    """Slender axes with the measured depth downwards between `limits` [m]."""
    made, axes = figure(SLENDER, height)
    axes.set_xlabel(label)
    axes.set_ylabel("measured depth [m]")
    axes.set_ylim(limits[1], limits[0])
    return made, axes


def in_time(label, times, height=2.5, width=WIDE):
    made, axes = figure(width, height)
    axes.set_xlabel("time [s]")
    axes.set_ylabel(label)
    if len(times) > 1:
        axes.set_xlim(times[0], times[-1])
    return made, axes


def legend_above(axes, columns=4, left=0.0):
    """A legend that covers no data: in rows above the axes, from `left` (in widths of the axes) on."""
    axes.legend(loc="lower left", bbox_to_anchor=(left, 1.0), ncol=columns, fontsize=8, borderaxespad=0.2, handlelength=1.4, columnspacing=1.0)


def square(axes, reach):
    """Axes of two lengths of one scale around zero."""
    axes.set_xlim(-reach, reach), axes.set_ylim(-reach, reach)
    axes.set_aspect("equal")


def inline_svg(made, name, tight=False):
    """The figure as <svg> text for a page; `name` keeps its ids apart from those of others. `tight`: cut or widened to what is drawn, which
    takes twice the time and which figures of figure() do not need. The figure is closed."""
    out = io.StringIO()
    made.savefig(out, format="svg", bbox_inches="tight" if tight else None, metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    plt.close(made)
    text = out.getvalue()
    text = text[text.index("<svg"):]
    text = re.sub(r"<metadata>.*?</metadata>\s*|<!--.*?-->\s*", "", text, flags=re.S)
    text = re.sub(r'(\bid="|url\(#|href="#)', rf"\g<1>{name}-", text)
    # Coordinates to a hundredth of a point; texts between the tags stay as they are.
    text = re.sub(r"<[^>]*>", lambda tag: re.sub(r"(\d\.\d\d)\d+", r"\1", tag.group()), text)
    return re.sub(r'(<svg[^>]*?) width="[^"]*"', r"\1", re.sub(r'(<svg[^>]*?) height="[^"]*"', r"\1", text, count=1), count=1)


def thinned(values, most=1500):
    """Every k-th row, so that at most `most` are left; for curves that no screen resolves."""
    step = max(1, -(-len(values) // most))
    return values[::step]


def envelope(times, values, most=1200):
    """Curve of at most `most` points that keeps the extremes of every stretch."""
    if len(times) <= most:
        return times, values
    size = -(-2 * len(times) // most)
    count = -(-len(times) // size)
    blocks = np.pad(values, (0, count * size - len(values)), mode="edge").reshape(count, size)
    first = np.arange(count) * size
    at = np.unique(np.minimum(np.concatenate([first + blocks.argmin(axis=1), first + blocks.argmax(axis=1)]), len(times) - 1))
    return times[at], values[at]


def spectrum(values, interval):
    """One-sided power spectral density by Welch's method (1967): Hann windows of a quarter of the samples (at least 64), half overlapping,
    the mean of each taken out. Frequencies [Hz], density [unit^2/Hz]; its integral is the variance."""
    values = np.asarray(values, float)
    length = min(len(values), max(64, len(values) // 4))
    if length < 8:
        return np.array([]), np.array([])
    window = np.hanning(length)
    starts = range(0, len(values) - length + 1, max(1, length // 2))
    power = np.zeros(length // 2 + 1)
    for start in starts:
        part = values[start:start + length]
        power += np.abs(np.fft.rfft((part - part.mean()) * window)) ** 2
    power *= 2 * interval / (len(starts) * np.sum(window ** 2))
    power[0] /= 2
    if length % 2 == 0:
        power[-1] /= 2
    return np.fft.rfftfreq(length, interval), power
