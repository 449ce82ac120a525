#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the plots of a study: plot_study.py DIR [--output DIR] [--formats png,svg]

Reads study.csv and study.h5 in DIR and writes study_speed, study_bases, study_modes, study_error_over_time, study_bit_speed, study_statistics,
study_static and study_reference there, each where the study has what it shows. Needs h5py, numpy and matplotlib.
"""
import argparse
import csv
import math
import pathlib
import sys

try:
    import h5py
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
    from matplotlib import ticker

    from plots import COLOURS, GREY, MARKERS, RPM, use_style
except ImportError as missing:
    sys.exit(f"{missing}: plot_study.py needs h5py, numpy and matplotlib (Debian: python3-h5py python3-matplotlib, then /usr/bin/python3).")

class Run:
    """A row of study.csv with its curves."""

    def __init__(self, row, group):
        self.row, self.group = row, group
        self.line, self.label, self.kind, self.reduced = row["line"], row["label"], row["kind"], row["model"] == "reduced"
        self.value = self.label[len(self.line):].lstrip(", ") if self.label.startswith(self.line) else ""
        self.sweep = row["sweep"].split("; ")[-1].split("=")[0] if row["sweep"] else ""

    def number(self, name):
        text = self.row[name]
        return float(text) if text else math.nan

    def curve(self, name):
        return self.group[name][:] if self.group is not None and name in self.group else np.array([])


class Study:
    def __init__(self, folder):
        with open(folder / "study.csv", newline="", encoding="utf-8") as text:
            rows = [{name.split(" [")[0]: value for name, value in row.items()} for row in csv.DictReader(text)]
        self.file = h5py.File(folder / "study.h5", "r")
        self.all = [Run(row, self.file.get(f"runs/{i + 1:03d}")) for i, row in enumerate(rows)]
        self.done = [run for run in self.all if run.row["status"] == "done"]
        self.failed = [run for run in self.all if run.row["status"] == "failed"]
        self.methods = [run for run in self.done if run.kind == "method"]
        self.lines = {}
        for run in self.methods:
            self.lines.setdefault(run.line, []).append(run)
        names = list(dict.fromkeys(run.line for run in self.all if run.kind == "method"))
        self.colour = {name: COLOURS[i % len(COLOURS)] for i, name in enumerate(names)}
        self.marker = {name: MARKERS[i % len(MARKERS)] for i, name in enumerate(names)}

    def companion(self, kind):
        return next((run for run in self.done if run.kind == kind), None)

    def attribute(self, name, default=None):
        return self.file.attrs.get(name, default)

    def machine(self):
        return self.attribute("machine", "")

    def window(self):
        return float(self.attribute("window_begin")), float(self.attribute("window_end"))


def plain(value):
    """Numbers on logarithmic axes as people write them."""
    if value <= 0:
        return ""
    if 1e-3 <= value < 1e4:
        return f"{value:g}"
    exponent = math.floor(math.log10(value) + 1e-9)
    return rf"$10^{{{exponent}}}$"


def percent(value):
    return f"{100 * value:g} %" if value >= 1e-5 else plain(value)


def logarithmic(axis, formatter=plain):
    axis.set_major_locator(ticker.LogLocator(base=10, numticks=20))
    axis.set_major_formatter(ticker.FuncFormatter(lambda value, _: formatter(value)))
    low, high = axis.get_view_interval()
    narrow = low > 0 and high < 30 * low
    axis.set_minor_locator(ticker.LogLocator(base=10, subs=(2, 3, 5) if narrow else range(2, 10), numticks=40))
    axis.set_minor_formatter(ticker.FuncFormatter(lambda value, _: formatter(value)) if narrow else ticker.NullFormatter())


class Labels:
    """Texts beside points, put where they cover the least: other texts, markers and lines."""

    def __init__(self, axes):
        self.axes, self.boxes, self.points = axes, [], []
        self.renderer = axes.figure.canvas.get_renderer()

    def occupy(self, x, y):
        """A line through these points: later texts keep off it."""
        pixels = self.axes.transData.transform(np.column_stack([x, y]).astype(float))
        self.points.extend(pixels)
        for a, b in zip(pixels[:-1], pixels[1:]):
            self.points.extend(a + (b - a) * f for f in np.linspace(0, 1, max(2, int(np.hypot(*(b - a)) / 6)), endpoint=False))

    def put(self, text, anchors, colour, size=9, weight="normal", reach=(7, 16, 28, 44, 62), limit=None):
        """At the best place around one of the anchors (data coordinates); False when nothing below `limit` was found."""
        sample = self.axes.text(0, 0, text, fontsize=size, fontweight=weight)
        box = sample.get_window_extent(self.renderer)
        sample.remove()
        frame = self.axes.get_window_extent(self.renderer)
        best = None
        points = np.array(self.points) if self.points else np.zeros((0, 2))
        for anchor in anchors:
            place = self.axes.transData.transform(anchor)
            for distance in reach:
                for angle in range(0, 360, 15):
                    dx, dy = math.cos(math.radians(angle)), math.sin(math.radians(angle))
                    left = place[0] + dx * distance * 1.4 - box.width * (0.5 - 0.5 * dx)
                    low = place[1] + dy * distance * 1.4 - box.height * (0.5 - 0.5 * dy)
                    cost = self.cost(left, low, box.width, box.height, frame, points) + 0.35 * distance
                    if best is None or cost < best[0]:
                        best = (cost, left, low, place, distance)
        cost, left, low, place, distance = best
        if limit is not None and cost > limit:
            return False
        inverse = self.axes.transData.inverted()
        self.axes.text(*inverse.transform((left, low)), text, color=colour, fontsize=size, fontweight=weight, va="bottom", ha="left", zorder=6, clip_on=False,
                       linespacing=1.1)
        if distance > 20:
            near = (min(max(place[0], left), left + box.width), min(max(place[1], low), low + box.height))
            self.axes.plot(*zip(inverse.transform(near), inverse.transform(place)), color=colour, linewidth=0.5, alpha=0.6, zorder=1)
        self.boxes.append((left, low, left + box.width, low + box.height))
        return True

    def cost(self, left, low, width, height, frame, points):
        right, top = left + width, low + height
        cost = 0.0
        for x0, y0, x1, y1 in self.boxes:
            overlap = max(0.0, min(right, x1 + 3) - max(left, x0 - 3)) * max(0.0, min(top, y1 + 2) - max(low, y0 - 2))
            cost += 2.0 * overlap
        if len(points):
            inside = (points[:, 0] > left - 3) & (points[:, 0] < right + 3) & (points[:, 1] > low - 3) & (points[:, 1] < top + 3)
            cost += 25.0 * np.count_nonzero(inside)
        outside = max(0, frame.x0 - left) + max(0, right - frame.x1) + max(0, frame.y0 - low) + max(0, top - frame.y1)
        return cost + 40.0 * outside


def ordered(runs):
    """Runs of a line in the order of the deck, failed ones skipped."""
    return [run for run in runs if run.number("vibration_error") > 0 and run.number("cpu_per_simulated_s") > 0]


def published(study):
    for name in sorted(study.file.get("published", {})):
        group = study.file["published"][name]
        points = [text.decode() if isinstance(text, bytes) else text for text in group["points"][:]] if "points" in group else [""] * len(group["cpu_time"])
        yield group.attrs["label"], group["cpu_time"][:], group["error"][:] if "error" in group else None, points


def draw_speed(study):
    """vibration error against CPU time per simulated second: down and left is better."""
    figure, axes = plt.subplots(figsize=(10.5, 7))
    axes.set_xscale("log"), axes.set_yscale("log")
    xs = [run.number("cpu_per_simulated_s") for run in study.methods]
    ys = [run.number("vibration_error") for run in study.methods]
    if not xs:
        return None
    others = list(published(study))
    own = float(study.attribute("self_error", 0.0))
    low = min([y for y in ys if y > 0] + ([own] if own > 0 else [])) / 2.2
    high = max(ys) * (2.6 if others else 1.8)
    outside = [value for _, cpu, _, _ in others for value in cpu]
    axes.set_xlim(min(xs + outside) / 1.8, max(xs + outside) * 2.2)
    axes.set_ylim(low, high)
    if own > 0:
        axes.axhspan(low, own, color="#d9d9d9", alpha=0.6, linewidth=0, zorder=0)
        axes.text(0.008, own, " error of the reference itself", transform=axes.get_yaxis_transform(), va="top", fontsize=8, color="#666666", style="italic")
    if axes.get_xlim()[0] < 1 < axes.get_xlim()[1]:
        axes.axvline(1, color=GREY, linewidth=0.8, linestyle=(0, (1, 2)), zorder=1)
        axes.text(1, 0.012, " real time ", transform=axes.get_xaxis_transform(), fontsize=8, color="#666666", style="italic", ha="left")
    figure.canvas.draw()
    labels = Labels(axes)
    for name, runs in study.lines.items():
        runs = ordered(runs)
        x, y = [r.number("cpu_per_simulated_s") for r in runs], [r.number("vibration_error") for r in runs]
        axes.plot(x, y, marker=study.marker[name], markersize=5, linewidth=1.6, color=study.colour[name], linestyle="--" if runs and runs[0].reduced else "-",
                  markeredgecolor="white", markeredgewidth=0.6, zorder=3)
        if runs:
            labels.occupy(x, y)
    baseline = next((run for run in study.methods if run.label == study.attribute("baseline", "")), None)
    if baseline:
        axes.plot(baseline.number("cpu_per_simulated_s"), baseline.number("vibration_error"), "o", markersize=13, markerfacecolor="none", markeredgecolor="black",
                  markeredgewidth=1, zorder=4)
    draw_published(axes, labels, others)
    for name, runs in study.lines.items():
        runs = ordered(runs)
        if runs:
            labels.put(wrapped(name), [(r.number("cpu_per_simulated_s"), r.number("vibration_error")) for r in runs], study.colour[name], size=9.5, weight="bold")
    if baseline:
        labels.put("baseline", [(baseline.number("cpu_per_simulated_s"), baseline.number("vibration_error"))], "black", size=8, reach=(12, 20, 32))
    for name, runs in study.lines.items():
        runs = ordered(runs)
        for run in ([runs[0], runs[-1]] if len(runs) > 1 else []):
            labels.put(short(run.value), [(run.number("cpu_per_simulated_s"), run.number("vibration_error"))], study.colour[name], size=7.5, reach=(6, 10, 16), limit=60)
    logarithmic(axes.xaxis), logarithmic(axes.yaxis, percent)
    axes.set_xlabel(f"CPU time per simulated second [s]  ({study.machine()})")
    axes.set_ylabel(f"vibration error, {study.window()[0]:g} to {study.window()[1]:g} s")
    axes.set_title(f"Speed against error: {study.attribute('deck_name', '')}")
    note = "solid: full model, dashed: reduced"
    if study.failed:
        names = ", ".join(run.label for run in study.failed)
        note += f"; failed, not shown: {names}" if len(names) < 50 else f"; {len(study.failed)} failed, not shown"
    axes.text(1, 1.012, note, transform=axes.transAxes, ha="right", va="bottom", fontsize=8, color="#666666")
    return figure


def draw_published(axes, labels, others):
    for label, cpu, error, points in others:
        transform = axes.transData if error is not None else axes.get_xaxis_transform()
        height = error if error is not None else np.full(len(cpu), 0.945)
        axes.plot(cpu, height, "o", markersize=6, markerfacecolor="white", markeredgecolor="#444444", transform=transform, zorder=3, clip_on=False)
        places = axes.transData.inverted().transform(transform.transform(np.column_stack([cpu, height])))
        labels.occupy(places[:, 0], places[:, 1])
        title = f"{label}: another machine" + ("" if error is not None else ", error not published")
        labels.put(title, [places[np.argmin(cpu)]], "#444444", size=8, reach=(8, 12, 20))
        for place, text in zip(places, points):
            labels.put(text, [place], "#444444", size=7.5, reach=(6, 10, 16), limit=80)


def wrapped(name, width=24):
    """Long names on two lines, broken at a comma or a blank."""
    if len(name) <= width:
        return name
    middle = len(name) / 2
    breaks = [i for i, c in enumerate(name) if c == " "]
    if not breaks:
        return name
    at = min(breaks, key=lambda i: abs(i - middle) - (9 if name[i - 1] == "," else 0))
    return name[:at] + "\n" + name[at + 1:]


def short(value):
    """"Cut-off Frequency 25 Hz" -> "25 Hz"; "Modes 60" -> "60 modes"."""
    if value.startswith("Modes "):
        return value[6:] + " modes"
    for name in ("Step ", "Cut-off Frequency "):
        if value.startswith(name):
            return value[len(name):]
    return value[:1].lower() + value[1:] if value[:2].istitle() else value


def sweeps_modes(run):
    return run.reduced and run.sweep.split("/")[0] in ("Reduction", "Substructures") and run.row["modes"] != ""


def draw_modes(study):
    """vibration error against the number of modes."""
    lines = {name: [run for run in runs if sweeps_modes(run)] for name, runs in study.lines.items()}
    lines = {name: runs for name, runs in lines.items() if len({run.row["modes"] for run in runs}) > 1}
    if not lines:
        return None
    figure, axes = plt.subplots(figsize=(8.5, 5.5))
    axes.set_yscale("log")
    most = max(run.number("modes") for runs in lines.values() for run in runs)
    errors = [run.number("vibration_error") for runs in lines.values() for run in runs]
    axes.set_xlim(-0.03 * most, 1.12 * most)
    axes.set_ylim(min(errors) / 2, max(errors) * 2)
    figure.canvas.draw()
    labels = Labels(axes)
    for name, runs in lines.items():
        runs = sorted(runs, key=lambda run: run.number("modes"))
        x, y = [run.number("modes") for run in runs], [run.number("vibration_error") for run in runs]
        axes.plot(x, y, marker=study.marker[name], markersize=5.5, linewidth=1.6, color=study.colour[name], markeredgecolor="white", markeredgewidth=0.6)
        labels.occupy(x, y)
    for name, runs in lines.items():
        labels.put(wrapped(name), [(run.number("modes"), run.number("vibration_error")) for run in runs], study.colour[name], weight="bold")
    own = float(study.attribute("self_error", 0.0))
    if own > axes.get_ylim()[0]:
        axes.axhspan(axes.get_ylim()[0], own, color="#d9d9d9", alpha=0.6, linewidth=0, zorder=0)
    logarithmic(axes.yaxis, percent)
    axes.set_xlabel("modes, all parts together")
    axes.set_ylabel(f"vibration error, {study.window()[0]:g} to {study.window()[1]:g} s")
    axes.set_title("Error against the number of modes")
    return figure


def known(runs, x, y):
    """Points of a line where both numbers are known and can stand on logarithmic axes."""
    return [(x(run), y(run)) for run in runs if x(run) > 0 and y(run) > 0]


def draw_bases(study):
    """What a reduced model costs and how wrong it is: one line per basis, or per variant of one. Failed motions show the frequencies they had."""
    lines = {}
    for run in study.all:
        if run.kind == "method" and run.reduced and run.row["reduced_dofs"]:
            lines.setdefault(run.line, []).append(run)
    if len(lines) < 2 or len({run.row["reduced_dofs"] for runs in lines.values() for run in runs}) < 2:
        return None
    dofs, vibration_error, cpu = (lambda run, name=name: run.number(name) for name in ("reduced_dofs", "vibration_error", "cpu_per_simulated_s"))
    setup, error = (lambda run: run.number("setup_cpu")), (lambda run: max(run.number("frequency_error"), 1e-12) if run.row["frequency_error"] else math.nan)
    count = int(study.attribute("frequencies", 0))
    motion, shapes = "vibration error of the motion", f"largest error of {count} frequencies"
    plots = [(cpu, vibration_error, "CPU time per simulated second [s]", motion), (dofs, vibration_error, "reduced dofs", motion)]
    if any(run.row["frequency_error"] for runs in lines.values() for run in runs):
        plots += [(setup, error, "CPU time of the reduction [s]", shapes), (dofs, error, "reduced dofs", shapes)]
    figure, grid = plt.subplots(len(plots) // 2, 2, figsize=(11, 2.4 + 3.6 * len(plots) / 2), squeeze=False, constrained_layout=True)
    for axes, (x, y, xlabel, ylabel) in zip(grid.flat, plots):
        for name, runs in lines.items():
            points = known(runs, x, y)
            if points:
                axes.plot(*zip(*points), marker=study.marker[name], markersize=4.5, linewidth=1.2, color=study.colour[name], label=name, markeredgecolor="white",
                          markeredgewidth=0.4)
        axes.set_yscale("log"), axes.set_xlabel(xlabel), axes.set_ylabel(ylabel)
        if x is not dofs:
            axes.set_xscale("log"), logarithmic(axes.xaxis)
    full = known([run for run in study.methods if not run.reduced], cpu, vibration_error)
    if full:
        grid[0, 0].plot(*zip(*sorted(full)), "k.", label="full model")
    for axes in grid[0]:
        own = float(study.attribute("self_error", 0.0))
        if own > 0:
            axes.axhline(own, color=GREY, linewidth=0.8, linestyle="--", label="error of the reference")
    found = {label: handle for axes in grid.flat for handle, label in zip(*axes.get_legend_handles_labels())}
    figure.legend(found.values(), found.keys(), loc="upper center", bbox_to_anchor=(0.5, 0.0), ncol=4, fontsize=8)
    figure.suptitle(f"Bases: {study.attribute('deck_name', '')}, {study.window()[0]:g} to {study.window()[1]:g} s  ({study.machine()})", x=0.01, ha="left", fontsize=10,
                    fontweight="bold")
    return figure


def panels(count, height=2.3, width=4.0, **options):
    """A grid of small plots with the same axes; as many columns as make it about square."""
    columns = min(3, count)
    rows = -(-count // columns)
    figure, grid = plt.subplots(rows, columns, figsize=(width * columns + 0.6, height * rows + 0.7), squeeze=False, constrained_layout=True, **options)
    for index, unused in enumerate(grid.flat[count:], count):
        unused.set_visible(False)
        grid.flat[index - columns].tick_params(labelbottom=True)
    return figure, list(grid.flat[:count]), columns


def shades(colour, count):
    """From pale to the full colour."""
    base = np.array(matplotlib.colors.to_rgb(colour))
    return [tuple(1 - (1 - base) * f) for f in (np.linspace(0.35, 1, count) if count > 1 else [1.0])]


def draw_error_over_time(study):
    """eps_t(t): one panel per line, one curve per run."""
    lines = {name: [run for run in runs if len(run.curve("eps_t"))] for name, runs in study.lines.items()}
    lines = {name: runs for name, runs in lines.items() if runs}
    if not lines:
        return None
    figure, grid, columns = panels(len(lines), sharex=True, sharey=True)
    check = study.companion("check")
    positive = [value for runs in lines.values() for run in runs for value in run.curve("eps_t")[5:] if value > 0]
    own = np.median(check.curve("eps_t")) if check and len(check.curve("eps_t")) else None
    floor = max(min(positive), (own or 0) / 3, max(positive) * 1e-8)
    for index, (axes, (name, runs)) in enumerate(zip(grid, lines.items())):
        runs = sorted(runs, key=lambda run: run.number("vibration_error"))
        for run, colour in zip(runs, shades(study.colour[name], len(runs))):
            axes.semilogy(run.curve("error_time"), np.maximum(run.curve("eps_t"), floor / 2), linewidth=1, color=colour)
        if check and len(check.curve("eps_t")):
            axes.fill_between(check.curve("error_time"), floor / 2, check.curve("eps_t"), color="#d9d9d9", alpha=0.8, linewidth=0, zorder=0)
        axes.set_title(name, color=study.colour[name], fontsize=9)
        axes.set_xlim(*study.window()), axes.set_ylim(floor / 2, max(positive) * 2)
        logarithmic(axes.yaxis, percent)
        for run, below in ((runs[0], True), (runs[-1], False)) if len(runs) > 1 else ((runs[0], False),):
            end = run.curve("eps_t")[-max(1, len(run.curve("eps_t")) // 4):]
            level = max(0.85 * end.min() if below else 1.15 * end.max(), floor * (4 if below else 1))
            axes.text(study.window()[1], level, short(run.value) + " ", ha="right", va="top" if below else "bottom", fontsize=7.5, color=study.colour[name])
        if index % columns == 0:
            axes.set_ylabel("eps_t")
        if index >= len(lines) - columns:
            axes.set_xlabel("time [s]")
    figure.suptitle("Error over time (dark: the largest of each method; grey: of the reference itself)", x=0.01, ha="left", fontsize=10, fontweight="bold")
    return figure


def representative(runs, enough=0.01):
    """The fastest run of a line whose vibration error is at most 1 %, or else its most accurate one."""
    good = [run for run in runs if run.number("vibration_error") <= enough]
    return min(good, key=lambda run: run.number("cpu_per_simulated_s")) if good else min(runs, key=lambda run: run.number("vibration_error"))


def draw_bit_speed(study):
    """Bit speed over time, one run of each line over the reference."""
    reference = study.companion("reference")
    if reference is None or not study.lines or not len(reference.curve("bit_time")):
        return None
    figure, grid, columns = panels(len(study.lines), height=1.9, sharex=True, sharey=True)
    for index, (axes, (name, runs)) in enumerate(zip(grid, study.lines.items())):
        run = representative(runs)
        axes.plot(reference.curve("bit_time"), RPM * reference.curve("bit_speed"), color="#bdbdbd", linewidth=2.2)
        axes.plot(run.curve("bit_time"), RPM * run.curve("bit_speed"), color=study.colour[name], linewidth=0.8)
        axes.axvspan(*study.window(), color="#f2f2f2", zorder=0, linewidth=0)
        axes.set_title(name + (f": {short(run.value)}" if run.value else ""), color=study.colour[name], fontsize=9)
        axes.set_xlim(reference.curve("bit_time")[0], reference.curve("bit_time")[-1])
        if index % columns == 0:
            axes.set_ylabel("bit speed [rpm]")
        if index >= len(study.lines) - columns:
            axes.set_xlabel("time [s]")
    figure.suptitle("Bit speed: the fastest run of each method with vibration error up to 1 % (else its best) over the reference (grey); shaded: window of errors",
                    x=0.01, ha="left", fontsize=10, fontweight="bold")
    return figure


def draw_statistics(study):
    """Contact duty, lateral motion and spectrum beyond the window."""
    reference = study.companion("reference")
    if reference is None or not len(reference.curve("contact_duty")) or not study.lines or "profile" not in study.file:
        return None
    s = study.file["profile/s"][:]
    rows = -(-len(study.lines) // 2)
    figure, (duty, rms, spectrum, key) = plt.subplots(4, 1, figsize=(10, 9 + 0.2 * rows), constrained_layout=True, height_ratios=[3, 3, 3, 0.25 * rows])
    key.axis("off")
    duty.fill_between(s, 100 * reference.curve("contact_duty"), step="mid", color="#d0d0d0", linewidth=0)
    rms.fill_between(s, 1e3 * reference.curve("lateral_rms"), color="#d0d0d0", linewidth=0)
    if len(reference.curve("spectrum")) > 1:
        spectrum.fill_between(reference.curve("frequency")[1:], reference.curve("spectrum")[1:], color="#d0d0d0", linewidth=0)
    handles = []
    for name, runs in study.lines.items():
        run = representative(runs)
        style = {"color": study.colour[name], "linewidth": 1, "linestyle": "--" if run.reduced else "-"}
        duty.plot(s, 100 * run.curve("contact_duty"), drawstyle="steps-mid", **style)
        handles += rms.plot(s, 1e3 * run.curve("lateral_rms"), label=name + (f": {short(run.value)}" if run.value else ""), **style)
        if len(run.curve("spectrum")) > 1:
            spectrum.plot(run.curve("frequency")[1:], run.curve("spectrum")[1:], **style)
    duty.set_ylabel("time in contact [%]"), duty.set_xlim(s[0], s[-1]), duty.set_ylim(0, 102)
    rms.set_ylabel("rms of the lateral motion [mm]"), rms.set_xlabel("depth along the well [m]"), rms.set_xlim(s[0], s[-1]), rms.set_ylim(bottom=0)
    if len(reference.curve("spectrum")) > 1:
        spectrum.set_xscale("log"), spectrum.set_yscale("log")
        top = reference.curve("spectrum")[1:].max()
        spectrum.set_ylim(1e-9 * top, 3 * top)
        spectrum.set_xlim(reference.curve("frequency")[1], reference.curve("frequency")[-1])
        logarithmic(spectrum.xaxis)
        spectrum.set_xlabel("frequency [Hz]"), spectrum.set_ylabel("lateral spectrum, mean of nodes [m²/Hz]")
    else:
        spectrum.set_visible(False)
    key.legend(handles=handles, loc="center", ncol=2, fontsize=8)
    duty.set_title(f"Beyond {study.window()[1]:g} s: the fastest run of each method with vibration error up to 1 % (else its best), the reference in grey")
    return figure


def draw_static(study):
    """Where every run starts from."""
    if "profile" not in study.file:
        return None
    profile = {name: values[:] for name, values in study.file["profile"].items()}
    s = profile["s"]
    middle = 0.5 * (s[1:] + s[:-1])
    figure, (radial, contact, axial) = plt.subplots(3, 1, figsize=(10, 8), sharex=True, constrained_layout=True)
    radial.fill_between(s, 1e3 * profile["clearance"], step="mid", color="#ececec", linewidth=0)
    radial.plot(s, 1e3 * profile["radius"], color="black", linewidth=1.2)
    scale = np.linalg.norm(profile["radius"]) or 1.0
    away = {}
    for run in study.methods:
        start = run.curve("initial_radius")
        if len(start) == len(s) and np.linalg.norm(start - profile["radius"]) > 1e-3 * scale:
            away.setdefault(run.line, []).append((np.linalg.norm(start - profile["radius"]), run))
    for name, runs in away.items():
        run = max(runs, key=lambda pair: pair[0])[1]
        radial.plot(s, 1e3 * run.curve("initial_radius"), color=study.colour[name], linewidth=1, linestyle="--", label=f"start of {name}: {short(run.value)}")
    if away:
        radial.legend(fontsize=8, loc="lower left", bbox_to_anchor=(0.45, 1.0), ncol=1, borderaxespad=0.1)
    radial.set_ylabel("lateral displacement [mm]"), radial.set_xlim(s[0], s[-1]), radial.set_ylim(0, 1150 * max(profile["radius"].max(), 1e-9))
    radial.set_title("Static state (black) in its clearance (grey)")
    contact.vlines(s, 0, profile["normal_force"] / 1e3, color="#0072B2", linewidth=1.2)
    contact.set_ylabel("contact force [kN]"), contact.set_ylim(bottom=0)
    axial.axhline(0, color=GREY, linewidth=0.6)
    for key, unit, colour in (("axial_force", "axial force [kN]", "#D55E00"), ("torque", "torque [kN m]", "#009E73")):
        axial.plot(middle, profile[key] / 1e3, color=colour, linewidth=1.4)
        axial.annotate(unit, (middle[len(middle) // 8], profile[key][len(middle) // 8] / 1e3), xytext=(0, 6), textcoords="offset points", color=colour, fontweight="bold")
    axial.set_xlabel("depth along the well [m]")
    return figure


def draw_reference(study):
    """How far the reference can be trusted: growth of a small change, and distance to its check."""
    curves = [(kind, study.companion(kind), text, colour) for kind, text, colour in
              (("check", "distance to the check run", "#0072B2"), ("sensitivity", f"growth of a change of {float(study.attribute('perturbation', 0)):.0e} m", "#D55E00"))]
    curves = [entry for entry in curves if entry[1] is not None and len(entry[1].curve("growth"))]
    if not curves:
        return None
    figure, axes = plt.subplots(figsize=(8.5, 4.8), constrained_layout=True)
    axes.set_yscale("log")
    for _, run, text, colour in curves:
        time, growth = run.curve("growth_time"), run.curve("growth")
        kept = growth > 0
        axes.plot(time[kept], growth[kept], color=colour, linewidth=1)
        at = int(0.62 * (np.count_nonzero(kept) - 1))
        axes.annotate(text, (time[kept][at], growth[kept][at:at + max(1, at // 4)].max()), xytext=(0, 9), textcoords="offset points", ha="center", color=colour, fontweight="bold")
    axes.axvspan(*study.window(), color="#f2f2f2", zorder=0, linewidth=0)
    axes.text(study.window()[0], 1, " window of pointwise errors", transform=axes.get_xaxis_transform(), va="top", fontsize=8, color="#666666", style="italic")
    logarithmic(axes.yaxis)
    axes.set_xlim(time[0], time[-1])
    axes.set_xlabel("time [s]"), axes.set_ylabel("largest lateral distance of a node [m]")
    axes.set_title("What the reference is worth")
    return figure


PLOTS = {"speed": draw_speed, "bases": draw_bases, "modes": draw_modes, "error_over_time": draw_error_over_time, "bit_speed": draw_bit_speed, "statistics": draw_statistics,
         "static": draw_static, "reference": draw_reference}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, help="folder of a study")
    parser.add_argument("--output", type=pathlib.Path, help="where the pictures go (default: DIR)")
    parser.add_argument("--formats", default="png,svg", help="file types, separated by commas")
    options = parser.parse_args()
    for name in ("study.csv", "study.h5"):
        if not (options.folder / name).is_file():
            sys.exit(f"{options.folder} holds no {name}: name the folder of a study.")
    output = options.output or options.folder
    output.mkdir(parents=True, exist_ok=True)
    use_style()
    study = Study(options.folder)
    made = []
    for name, draw in PLOTS.items():
        figure = draw(study)
        if figure is None:
            continue
        for kind in options.formats.split(","):
            figure.savefig(output / f"study_{name}.{kind}", bbox_inches="tight")
        plt.close(figure)
        made.append(name)
    print(f"pictures    {output}: " + ", ".join(f"study_{name}" for name in made))
    return 0


if __name__ == "__main__":
    sys.exit(main())
