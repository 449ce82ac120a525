# SPDX-License-Identifier: BSD-3-Clause
"""Sections of modes.csv, damped_modes.csv and basis.csv."""
import math

import plots
from plots import COLOURS, GREY, rotating
from report import tables
from report.figures import Figure
from report.files import numbers, read_table
from report.page import cards
from report.quantities import fixed, percent, plain
from report.results import open_results

BASIS_ROWS = 60  # rows on a page; basis.csv has all
DIGITS = 4  # significant digits of the largest number in a column of frequencies
# displayed columns; undamped modes have no damping
TITLES = {
    "mode": "mode", "full": "full model [Hz]", "full_im": "in motion [Hz]",
    "full_damping": "damping ratio", "coupled_mode": "coupled mode",
    "coupled": "reduced model [Hz]", "coupled_im": "in motion [Hz]",
    "coupled_damping": "damping ratio", "mac": "MAC", "error": "error",
    "estimate": "estimated error", "definite": "complete"
}
FREQUENCIES, RATIOS, SHARES = ("full", "full_im", "coupled",
                               "coupled_im"), ("full_damping", "coupled_damping", "mac"), (
                                   "error",
                                   "estimate",
                               )
MODELS = (("full", "full model", "o", COLOURS[0]), ("coupled", "reduced model", "x", COLOURS[1]))


def basis_table(folder):
    """The first BASIS_ROWS vectors of the bases, in the order of basis.csv."""
    if not (folder / "basis.csv").is_file():
        return ""
    rows = read_table(folder / "basis.csv")
    if not rows:
        return ""
    shown = rows[:BASIS_ROWS]
    more = f", the first {BASIS_ROWS} of {len(rows)}; basis.csv has all" if len(
        rows) > BASIS_ROWS else ""
    table = tables.table(("part", "kind", "vector", "frequency [Hz]", "residual", "kept", "why"),
                         [(row["part"], row["kind"], plain(row["vector"]), plain(
                             row["frequency"]), plain(row["residual"], 2), row["kept"], row["why"])
                          for row in shown], (3, 4))
    return f"<details><summary>Vectors of the bases{more}</summary>{table}</details>"


def whole_numbers(axes):
    """Ticks at mode numbers, with space for the markers."""
    axes.xaxis.set_major_locator(plots.plt.MaxNLocator(integer=True))
    axes.margins(y=0.08)


def modes_figure(name, rows, columns, label, caption, zero=False):
    """Columns of a full and of a reduced model, a marker for each mode; None if all values are
    missing or 0."""
    made, axes = plots.figure(plots.WIDE, 2.4)
    for column, text, marker, colour in columns:
        if column in rows[0] and any(value
                                     for value in numbers(rows, column) if math.isfinite(value)):
            axes.plot(numbers(rows, "mode"), numbers(rows, column), marker, color=colour,
                      markersize=5, markerfacecolor="none", label=text)
    if not axes.lines:
        plots.plt.close(made)
        return []
    if zero:
        axes.axhline(0, color=GREY, linewidth=0.6)
    else:
        axes.set_ylim(bottom=min(0, axes.get_ylim()[0]))
    axes.set_xlabel("mode"), axes.set_ylabel(label)
    whole_numbers(axes)
    plots.legend_above(axes)
    return [Figure(name, made, caption, True)]


def errors_figure(rows):
    made_of = [row for row in rows if isinstance(row.get("error"), float) and row["error"] != 0]
    if not made_of:
        return []
    made, axes = plots.figure(plots.WIDE, 2.4)
    axes.set_yscale("log")
    axes.plot(numbers(made_of, "mode"), [abs(x) for x in numbers(made_of, "error")], "o",
              color=COLOURS[0], markersize=4, label="error")
    estimated = [
        row for row in made_of if isinstance(row.get("estimate"), float) and row["estimate"] > 0
    ]
    if estimated:
        axes.plot(numbers(estimated, "mode"), numbers(estimated, "estimate"), "s", markersize=4,
                  markerfacecolor="none", color=COLOURS[1], label="estimate")
    plots.logarithmic(axes.yaxis)
    axes.set_xlabel("mode"), axes.set_ylabel("relative error of the frequency [1]")
    whole_numbers(axes)
    plots.legend_above(axes)
    return [
        Figure("mode-errors", made,
               "Errors of the coupled frequencies, and their estimates without the full model.",
               True)
    ]


def shapes_figure(folder):
    """The lowest modes of a string in the hole."""
    if not (folder / "modes.h5").is_file():
        return []
    with open_results(folder / "modes.h5") as results:
        made = rotating.mode_shapes_figure(results)
    return [] if made is None else [
        Figure("mode-shapes", made, "The lowest undamped modes of the full model in the hole.",
               large=True)
    ]


def table_of(rows, damped):
    """All modes; the largest number of a column determines its decimals."""
    names = [
        name for name in TITLES
        if name in rows[0] and (damped or not name.endswith(("_damping", "_im")))
    ]

    def column(name):
        values = numbers(rows, name)
        if name in FREQUENCIES:
            largest = max((abs(value) for value in values if math.isfinite(value)), default=0.0)
            decimals = min(6, max(0, DIGITS - 1 -
                                  math.floor(math.log10(largest)))) if largest > 0 else 0
        else:
            decimals = DIGITS if name in RATIOS else 0
        return [
            percent(value)
            if name in SHARES else fixed(value, decimals) if math.isfinite(value) else "-"
            for value in values
        ]

    return tables.table([TITLES[name] for name in names], list(zip(*map(column, names))),
                        range(len(names)),
                        "complete: 0 where modes are missing below" if "definite" in names else "")


def grows(rows):
    """Modes of either model with a negative damping ratio."""
    return [
        row for row in rows if any(
            isinstance(row.get(name), float) and row[name] < 0
            for name in ("full_damping", "coupled_damping"))
    ]


def growing(count):
    return ("no mode grows"
            if count == 0 else "1 mode grows" if count == 1 else f"{count} modes grow")


def headline(results):
    """Cards with the lowest frequency, the least damping and the largest error."""
    found = []
    for file, what in (("modes.csv", ""), ("damped_modes.csv", ", damped")):
        path = results.folder / file
        rows = read_table(path, "mode") if path.is_file() else []
        if not rows:
            continue
        kind = "full" if "full" in rows[0] else "coupled"
        frequencies = [value for value in numbers(rows, kind) if math.isfinite(value)]
        if frequencies:
            found.append(
                (f"Lowest frequency{what}", f"{min(frequencies):.4g} Hz",
                 f"highest {max(frequencies):.4g} Hz",
                 f"{len(rows)} modes of the {dict(full='full', coupled='reduced')[kind]} model",
                 False))
        ratios = [(value, mode) for mode, value in enumerate(numbers(rows, f"{kind}_damping"), 1)
                  if math.isfinite(value)] if f"{kind}_damping" in rows[0] and what else []
        if ratios:
            least, mode = min(ratios)
            found.append(("Least damping ratio", f"{least:.3g}", f"mode {mode}",
                          growing(len(grows(rows))), least < 0))
        errors = [abs(row["error"]) for row in rows if isinstance(row.get("error"), float)]
        if errors:
            found.append(
                (f"Largest error{what}", percent(max(errors)), "", "of the reduced model", False))
    return cards(found) if found else ""


def add(page, folder):
    for file, title in (("modes.csv", "Eigenfrequencies"), ("damped_modes.csv", "Damped modes")):
        with page.section(folder / file):
            add_table(page, folder, file, title)


def add_table(page, folder, file, title):
    rows = read_table(folder / file, "mode") if (folder / file).is_file() else []
    if not rows:
        return
    name, damped = file.split(".")[0].replace("_", "-"), file.startswith("damped")
    figures = modes_figure(
        f"{name}-frequencies", rows, MODELS, "frequency [Hz]",
        "Frequencies of the damped modes, |s| / 2 pi."
        if damped else "Frequencies of the modes without damping.")
    if damped:
        ratios = [(f"{column}_damping", *rest) for column, *rest in MODELS]
        unstable = "; below 0 the motion grows" if grows(rows) else ""
        figures += modes_figure("mode-damping", rows, ratios, "damping ratio",
                                f"Damping ratios of the modes{unstable}.", zero=True)
    else:
        figures += errors_figure(rows)
        with page.section(folder / "modes.h5"):
            figures += shapes_figure(folder)
    page.plots(name, title, figures, after=table_of(rows, damped))
