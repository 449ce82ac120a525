#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what `tooljoint campbell` or `tooljoint response` left in its folder: tools/plot_response.py DIR [--output FILE.png]

Campbell diagram: frequencies and damping ratios against the rotary speed, forward whirl blue, backward whirl orange, lines of the excitation orders,
critical speeds marked. Response: amplitude and phase of every output, largest amplitudes marked. Needs h5py, numpy and matplotlib; reads
campbell.h5 or response.h5 alone.
"""
import sys

try:
    import numpy as np

    from plots import COLOURS, GREY, RPM, headline, label, legend_above, plt
    from report.folder import conditions, draw_folder
except ImportError as missing:
    sys.exit(f"{missing}: plot_response.py needs h5py, numpy and matplotlib (Debian: python3-h5py python3-matplotlib, then /usr/bin/python3).")

FORWARD, BACKWARD = COLOURS[:2]
CLEAR_WHIRL = 0.1  # of a circle; less is drawn grey


def columns(results, group):
    return {name: data[:] for name, data in results[group].items()} if group in results else None


def colour(whirl):
    return FORWARD if whirl > CLEAR_WHIRL else BACKWARD if whirl < -CLEAR_WHIRL else GREY


def draw_campbell(results):
    rows, crossings = columns(results, "campbell"), columns(results, "crossings")
    figure, (frequencies, damping) = plt.subplots(2, 1, figsize=(8, 8), sharex=True, height_ratios=[2.2, 1], constrained_layout=True)
    for mode in np.unique(rows["mode"]):
        here = rows["mode"] == mode
        look = {"color": colour(np.median(rows["whirl"][here])), "linewidth": 1.1}
        frequencies.plot(RPM * rows["speed"][here], rows["frequency"][here], **look)
        damping.plot(RPM * rows["speed"][here], rows["damping"][here], **look)
    last, top = RPM * rows["speed"].max(), 1.05 * rows["frequency"].max()
    for order in results["orders"][:]:
        frequencies.plot([0, last], [0, order * last / 60], color="0.7", linewidth=0.8, linestyle="--")
        end = min(last, 60 * top / order)
        frequencies.annotate(f"{order:g}x", (end, order * end / 60), fontsize=8, color="0.4", ha="right", va="bottom")
    if crossings is not None:
        frequencies.plot(RPM * crossings["speed"], crossings["frequency"], "ko", markersize=4, fillstyle="none", label="critical speeds")
    for name, look in (("forward whirl", FORWARD), ("backward whirl", BACKWARD)):
        frequencies.plot([], [], color=look, label=name)
    frequencies.set_xlim(RPM * rows["speed"].min(), last), frequencies.set_ylim(0, top)
    frequencies.set_ylabel(label("frequency", "Hz")), legend_above(frequencies)
    damping.axhline(0, color="0.7", linewidth=0.6)
    damping.set_ylim(bottom=min(-1e-4, 1.1 * rows["damping"].min()), top=max(1e-3, 1.1 * rows["damping"].max()))  # no picture of rounding
    damping.set_ylabel("damping ratio"), damping.set_xlabel(label("rotary speed", "rpm"))
    headline(figure, "Campbell diagram", conditions(results))
    return figure


def draw_response(results):
    group, peaks = results["response"], columns(results, "peaks")
    rows = columns(results, "response")
    by_speed = np.ptp(rows["speed"]) > 0
    x, along = (RPM * rows["speed"], label("rotary speed", "rpm")) if by_speed else (rows["frequency"], label("frequency", "Hz"))
    names = [name[: -len("_amplitude")] for name in group if name.endswith("_amplitude")]
    figure, (amplitudes, phases) = plt.subplots(2, 1, figsize=(8, 7), sharex=True, height_ratios=[2, 1], constrained_layout=True)
    units = set()
    for name in names:
        unit = group[name + "_amplitude"].attrs["units"]
        unit = unit.decode() if isinstance(unit, bytes) else unit
        line, = amplitudes.semilogy(x, np.maximum(rows[name + "_amplitude"], 1e-300), linewidth=1.1, label=label(name, unit))
        units.add(unit)
        phases.plot(x, np.degrees(np.unwrap(rows[name + "_phase"])), color=line.get_color(), linewidth=1.0)
    if peaks is not None:
        amplitudes.semilogy(RPM * peaks["speed"] if by_speed else peaks["frequency"], peaks["amplitude"], "ko", markersize=4, fillstyle="none")
    positive = np.concatenate([rows[name + "_amplitude"] for name in names])
    positive = positive[positive > 0]
    if positive.size:
        amplitudes.set_ylim(bottom=0.5 * positive.min())
    amplitudes.set_ylabel(label("amplitude", units.pop() if len(units) == 1 else "unit of the output")), legend_above(amplitudes, 3)
    phases.set_ylabel(label("phase", "deg")), phases.set_xlabel(along)
    headline(figure, "Response to a harmonic force", conditions(results))
    return figure


if __name__ == "__main__":
    draw_folder(__doc__, "folder of tooljoint campbell or tooljoint response", {"campbell.h5": draw_campbell, "response.h5": draw_response})
