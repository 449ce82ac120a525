# SPDX-License-Identifier: BSD-3-Clause
"""Compares measured and computed signals."""
import math

import plots
from plots import COLOURS, RPM
from report.figures import DOWN_TO, Figure, draw_density, frequency_axes
from report.tables import table

COMPUTED, MEASURED = COLOURS[0], COLOURS[1]
USUAL = {"rad/s": ("rpm", RPM), "N": ("kN", 1e-3), "N m": ("kN m", 1e-3),
         "m": ("mm", 1e3)}  # SI unit -> unit of the figures, factor to it


def columns(run):
    """Rows of the comparison in summary.json whose columns are in results.h5."""
    found = (run.value("measured") or {}).get("columns") or []
    return [row for row in found if f"/measured/{row['name']}/computed" in run.file]


def overview(run):
    """A line for each column: differences, stick-slip index, largest peak."""
    rows = []
    for row in columns(run):
        unit, factor = USUAL.get(row["unit"], (row["unit"], 1.0))

        def peak(which, row=row):
            return "-" if row[which + "_peak_hz"] is None else f"{row[which + '_peak_hz']:.3g}"

        rows.append([
            row["name"], row["quantity"], unit, f"{factor * row['computed_mean']:.4g}",
            f"{factor * row['measured_mean']:.4g}", f"{factor * row['mean_difference']:.3g}",
            f"{factor * row['rms_difference']:.3g}", f"{row['computed_index']:.3g}",
            f"{row['measured_index']:.3g}",
            peak("computed"),
            peak("measured")
        ])
    titles = ("column", "quantity", "unit", "mean computed", "measured", "mean difference",
              "rms difference", "(max - min)/(2 mean) computed", "measured", "peak [Hz] computed",
              "measured")
    return table(
        titles, rows, range(3, len(titles)), "Computed less measured over the common window; (max "
        "- min)/(2 mean) of a speed is the stick-slip index") if rows else ""


def beside(run):
    """Measured and computed signals against time and frequency, two figures for each column."""
    found = []
    for number, row in enumerate(columns(run), 1):
        group = f"/measured/{row['name']}/"
        unit, factor = USUAL.get(row["unit"], (row["unit"], 1.0))
        label = f"{row['quantity'].lower()} [{unit}]"
        begin, end = row["begin"], row["end"]
        inside = (run.time >= begin) & (run.time <= end)
        made, axes = plots.in_time(label, run.time[inside])
        axes.plot(*plots.envelope(run.get(group + "time"), factor * run.get(group + "measured")),
                  color=MEASURED, linewidth=1.1, label="measured")
        axes.plot(*plots.envelope(run.time[inside],
                                  factor * run.get(group + "computed")[inside]), color=COMPUTED,
                  linewidth=0.8, label="computed")
        plots.legend_above(axes)
        found.append(
            Figure(f"measured-{number}", made,
                   f"{row['name']}: {row['quantity'].lower()}, measured and computed.", True))
        made, axes = frequency_axes(f"{row['quantity'].lower()} [({unit})²/Hz]")
        for which, colour in (("measured", MEASURED), ("computed", COMPUTED)):
            density = run.get(f"{group}{which}_spectrum")
            if density is not None:
                draw_density(axes, run.get(f"{group}{which}_frequency"), factor**2 * density,
                             color=colour, label=which)
        if not axes.lines:
            plots.plt.close(made)
            continue
        plots.legend_above(axes)
        peak = row["computed_peak_hz"], row["measured_peak_hz"]
        said = "" if None in peak or not all(
            map(math.isfinite, peak)
        ) else f"; largest peaks at {peak[0]:.3g} Hz (computed) and {peak[1]:.3g} Hz (measured)"
        found.append(
            Figure(f"measured-spectrum-{number}", made,
                   f"{row['name']}: spectra of both, {DOWN_TO}{said}.", True))
    return found
