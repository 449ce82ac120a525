#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the plots of a study: plot_study.py DIR [--output DIR] [--formats png,svg]

Reads study.csv and study.h5 in DIR and writes study_speed, study_bases, study_modes,
study_error_over_time, study_bit_speed, study_statistics, study_static and study_reference there,
each where the study has what it shows. Needs h5py, numpy and matplotlib.
"""
import argparse
import math
import pathlib
import sys
import textwrap

try:
    import numpy as np

    import plots
    from plots import (COLOURS, GREY, MARKERS, RPM, Labels, headline, label, logarithmic, panels,
                       percent, plt, shades)
    from report import deck, files, results
except ImportError as missing:
    sys.exit(f"{missing}: plot_study.py needs h5py, numpy and matplotlib (Debian: python3-h5py "
             "python3-matplotlib, then /usr/bin/python3).")

PALE = "#d9d9d9"  # of what the curves are compared with


class Run:
    """A row of study.csv with its curves."""
    def __init__(self, row, group):
        self.row, self.group = row, group
        self.line, self.label, self.kind, self.reduced = row["line"], row["label"], row[
            "kind"], row["model"] == "reduced"
        self.value = self.label[len(self.line):].lstrip(", ") if self.label.startswith(
            self.line) else ""
        self.sweep = row["sweep"].split("; ")[-1].split("=")[0] if row["sweep"] else ""

    def number(self, name):
        text = self.row[name]
        return float(text) if text else math.nan

    def spread(self):
        """How much longer the longest of its repeats took, as a share; 0 of a single one."""
        return float(self.row.get("cpu_spread") or 0.0)

    def curve(self, name):
        return self.group[name][:] if self.group is not None and name in self.group else np.array(
            [])


class Study:
    def __init__(self, folder):
        titles, *rows = files.read_rows(folder / "study.csv")
        rows = [dict(zip((title.split(" [")[0] for title in titles), row)) for row in rows]
        self.file = results.open_results(folder / "study.h5")
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

    def conditions(self):
        """Of the scene, as the deck has them."""
        return deck.conditions(
            deck.read(self.attribute("deck_text", ""), self.attribute("overrides", "")))

    def scene(self):
        """Name and conditions, for the second line of a title."""
        return "; ".join(filter(None, (self.attribute("deck_name", ""), self.conditions())))

    def window(self):
        return float(self.attribute("window_begin")), float(self.attribute("window_end"))


def ordered(runs):
    """Runs of a line in the order of the deck, failed ones skipped."""
    return [
        run for run in runs
        if run.number("vibration_error") > 0 and run.number("cpu_per_simulated_s") > 0
    ]


def published(study):
    for name in sorted(study.file.get("published", {})):
        group = study.file["published"][name]
        points = [
            text.decode() if isinstance(text, bytes) else text for text in group["points"][:]
        ] if "points" in group else [""] * len(group["cpu_time"])
        yield group.attrs["label"], group[
            "cpu_time"][:], group["error"][:] if "error" in group else None, points


def draw_speed(study):
    """vibration error against CPU time per simulated second: down and left is better.
    Names stand beside the lines where all have room there."""
    xs = [run.number("cpu_per_simulated_s") for run in study.methods]
    ys = [run.number("vibration_error") for run in study.methods]
    if not xs:
        return None
    made, axes = plt.subplots(figsize=(10.5, 7), constrained_layout=True)
    axes.set_xscale("log"), axes.set_yscale("log")
    others = list(published(study))
    own = float(study.attribute("self_error", 0.0))
    low = min([y for y in ys if y > 0] + ([own] if own > 0 else [])) / 2.2
    high = max(ys) * (2.6 if others else 1.8)
    outside = [value for _, cpu, _, _ in others for value in cpu]
    axes.set_xlim(min(xs + outside) / 1.8, max(xs + outside) * 2.2)
    axes.set_ylim(low, high)
    logarithmic(axes.xaxis), logarithmic(axes.yaxis, percent)
    axes.set_xlabel(label("CPU time per simulated second", "s"))
    axes.set_ylabel(f"vibration error, {study.window()[0]:g} to {study.window()[1]:g} s")
    note = [
        study.conditions(),
        study.machine(), "solid: full model, dashed: reduced",
        "bands: to the longest of the repeats" if any(
            run.spread() > 0 for run in study.methods) else ""
    ]
    if study.failed:
        names = ", ".join(run.label for run in study.failed)
        note.append(f"failed, not shown: {names}"
                    if len(names) < 50 else f"{len(study.failed)} failed, not shown")
    headline(made, f"Speed against error: {study.attribute('deck_name', '')}",
             "; ".join(part for part in note if part))
    lines, drawn = {}, {}
    for name, runs in study.lines.items():
        drawn[name] = ordered(runs)
        if drawn[name]:
            x, y = [r.number("cpu_per_simulated_s") for r in drawn[name]
                    ], [r.number("vibration_error") for r in drawn[name]]
            lines[name], = axes.plot(x, y, marker=study.marker[name], markersize=5, linewidth=1.6,
                                     color=study.colour[name],
                                     linestyle="--" if drawn[name][0].reduced else "-",
                                     markeredgecolor="white", markeredgewidth=0.6, zorder=3)
            slowest = [cpu * (1 + run.spread()) for cpu, run in zip(x, drawn[name])]
            if len(x) > 1:
                plots.error_band(axes, y, x, slowest, study.colour[name], sideways=True)
            else:
                axes.hlines(y, x, slowest, color=study.colour[name], alpha=0.4, linewidth=4,
                            zorder=0)
    labels = Labels(axes)
    if own > 0:
        axes.axhspan(low, own, color=PALE, alpha=0.6, linewidth=0, zorder=0)
        labels.put("error of the reference itself", [(axes.get_xlim()[0], own)], "#666666", size=8)
    if axes.get_xlim()[0] < 1 < axes.get_xlim()[1]:
        axes.axvline(1, color=GREY, linewidth=0.8, linestyle=(0, (1, 2)), zorder=1)
        labels.put("real time", [(1, low)], "#666666", size=8)
    for line in lines.values():
        labels.occupy(*line.get_data())
    baseline = next((run for run in study.methods if run.label == study.attribute("baseline", "")),
                    None)
    if baseline:
        place = baseline.number("cpu_per_simulated_s"), baseline.number("vibration_error")
        axes.plot(*place, "o", markersize=13, markerfacecolor="none", markeredgecolor="black",
                  markeredgewidth=1, zorder=4)
        labels.put("baseline", [place], "black", size=8, reach=(12, 20, 32))
    draw_published(axes, labels, others)
    if not plots.name_lines(labels, lines):
        labels = relaid(labels, lines)
    for name, runs in drawn.items():
        for run in ([runs[0], runs[-1]] if len(runs) > 1 else []):
            labels.put(short(run.value),
                       [(run.number("cpu_per_simulated_s"), run.number("vibration_error"))],
                       study.colour[name], size=7.5, reach=(6, 10, 16))
    return made


def relaid(labels, lines):
    """The texts there are, after a legend has narrowed the axes: those that now lie on others are
    taken out."""
    axes, texts = labels.axes, list(labels.axes.texts)
    moved = Labels(axes)
    for line in lines.values():
        moved.occupy(*line.get_data())
    for text in texts:
        box = text.get_window_extent(moved.renderer)
        crossed = any(
            min(box.x1, x1) > max(box.x0, x0) and min(box.y1, y1) > max(box.y0, y0)
            for x0, y0, x1, y1 in moved.boxes)
        text.remove() if crossed else moved.boxes.append((box.x0, box.y0, box.x1, box.y1))
    return moved


def draw_published(axes, labels, others):
    for source, cpu, error, points in others:
        transform = axes.transData if error is not None else axes.get_xaxis_transform()
        height = error if error is not None else np.full(len(cpu), 0.945)
        axes.plot(cpu, height, "o", markersize=6, markerfacecolor="white",
                  markeredgecolor="#444444", transform=transform, zorder=3, clip_on=False)
        places = axes.transData.inverted().transform(
            transform.transform(np.column_stack([cpu, height])))
        labels.occupy(places[:, 0], places[:, 1])
        title = f"{source}: another machine" + (""
                                                if error is not None else ", error not published")
        labels.put(title, [places[np.argmin(cpu)]], "#444444", size=8, reach=(8, 12, 20))
        for place, text in zip(places, points):
            labels.put(text, [place], "#444444", size=7.5, reach=(6, 10, 16))


def short(value):
    """"Cut-off Frequency 25 Hz" -> "25 Hz"; "Modes 60" -> "60 modes"."""
    if value.startswith("Modes "):
        return value[6:] + " modes"
    for name in ("Step ", "Cut-off Frequency "):
        if value.startswith(name):
            return value[len(name):]
    return value[:1].lower() + value[1:] if value[:2].istitle() else value


def sweeps_modes(run):
    return run.reduced and run.sweep.split("/")[0] in ("Reduction",
                                                       "Substructures") and run.row["modes"] != ""


def draw_modes(study):
    """vibration error against the number of modes."""
    lines = {name: [run for run in runs if sweeps_modes(run)] for name, runs in study.lines.items()}
    lines = {
        name: runs for name, runs in lines.items() if len({run.row["modes"] for run in runs}) > 1
    }
    if not lines:
        return None
    made, axes = plt.subplots(figsize=(8.5, 5.5), constrained_layout=True)
    axes.set_yscale("log")
    most = max(run.number("modes") for runs in lines.values() for run in runs)
    errors = [run.number("vibration_error") for runs in lines.values() for run in runs]
    axes.set_xlim(-0.03 * most, 1.12 * most)
    axes.set_ylim(min(errors) / 2, max(errors) * 2)
    logarithmic(axes.yaxis, percent)
    axes.set_xlabel("modes, all parts together")
    axes.set_ylabel(f"vibration error, {study.window()[0]:g} to {study.window()[1]:g} s")
    headline(made, "Error against the number of modes", study.scene())
    drawn = {}
    for name, runs in lines.items():
        runs = sorted(runs, key=lambda run: run.number("modes"))
        x, y = [run.number("modes") for run in runs
                ], [run.number("vibration_error") for run in runs]
        drawn[name], = axes.plot(x, y, marker=study.marker[name], markersize=5.5, linewidth=1.6,
                                 color=study.colour[name], markeredgecolor="white",
                                 markeredgewidth=0.6)
    own = float(study.attribute("self_error", 0.0))
    if own > axes.get_ylim()[0]:
        axes.axhspan(axes.get_ylim()[0], own, color=PALE, alpha=0.6, linewidth=0, zorder=0)
    labels = Labels(axes)
    for line in drawn.values():
        labels.occupy(*line.get_data())
    plots.name_lines(labels, drawn)
    return made


def known(runs, x, y):
    """Points of a line where both numbers are known and can stand on logarithmic axes."""
    return [(x(run), y(run)) for run in runs if x(run) > 0 and y(run) > 0]


def draw_bases(study):
    """What a reduced model costs and how wrong it is: one line per basis, or per variant of one.
    Failed motions show the frequencies they had."""
    lines = {}
    for run in study.all:
        if run.kind == "method" and run.reduced and run.row["reduced_dofs"]:
            lines.setdefault(run.line, []).append(run)
    if len(lines) < 2 or len({run.row["reduced_dofs"] for runs in lines.values()
                              for run in runs}) < 2:
        return None
    dofs, vibration_error, cpu = (lambda run, name=name: run.number(name)
                                  for name in ("reduced_dofs", "vibration_error",
                                               "cpu_per_simulated_s"))
    setup, error = (lambda run: run.number("setup_cpu")), (
        lambda run: max(run.number("frequency_error"), 1e-12)
        if run.row["frequency_error"] else math.nan)
    count = int(study.attribute("frequencies", 0))
    motion, shapes = "vibration error of the motion", f"largest error of {count} frequencies"
    shown = [
        (cpu, vibration_error, label("CPU time per simulated second", "s"), motion),
        (dofs, vibration_error, "reduced dofs", motion),
    ]
    if any(run.row["frequency_error"] for runs in lines.values() for run in runs):
        shown += [
            (setup, error, label("CPU time of the reduction", "s"), shapes),
            (dofs, error, "reduced dofs", shapes),
        ]
    figure, grid = plt.subplots(
        len(shown) // 2, 2, figsize=(11, 2.4 + 3.6 * len(shown) / 2), squeeze=False,
        constrained_layout=True)
    for axes, (x, y, xlabel, ylabel) in zip(grid.flat, shown):
        for name, runs in lines.items():
            points = known(runs, x, y)
            if points:
                axes.plot(*zip(*points), marker=study.marker[name], markersize=4.5, linewidth=1.2,
                          color=study.colour[name], label=name, markeredgecolor="white",
                          markeredgewidth=0.4)
        axes.set_yscale("log"), logarithmic(
            axes.yaxis), axes.set_xlabel(xlabel), axes.set_ylabel(ylabel)
        if x is not dofs:
            axes.set_xscale("log"), logarithmic(axes.xaxis)
    full = known([run for run in study.methods if not run.reduced], cpu, vibration_error)
    if full:
        grid[0, 0].plot(*zip(*sorted(full)), "k.", label="full model")
    for axes in grid[0]:
        own = float(study.attribute("self_error", 0.0))
        if own > 0:
            axes.axhline(own, color=GREY, linewidth=0.8, linestyle="--",
                         label="error of the reference")
    found = {
        label: handle for axes in grid.flat
        for handle, label in zip(*axes.get_legend_handles_labels())
    }
    figure.legend(found.values(), found.keys(), loc="upper center", bbox_to_anchor=(0.5, 0.0),
                  ncol=4, fontsize=8)
    headline(
        figure, f"Bases: {study.attribute('deck_name', '')}", "; ".join(
            filter(None, (study.conditions(), f"{study.window()[0]:g} to {study.window()[1]:g} s",
                          study.machine()))))
    return figure


def draw_error_over_time(study):
    """eps_t(t): one panel per line, one curve per run."""
    lines = {
        name: [run for run in runs if len(run.curve("eps_t"))
               ] for name, runs in study.lines.items()
    }
    lines = {name: runs for name, runs in lines.items() if runs}
    if not lines:
        return None
    figure, grid, columns = panels(len(lines), sharex=True, sharey=True)
    check = study.companion("check")
    positive = [
        value for runs in lines.values() for run in runs for value in run.curve("eps_t")[5:]
        if value > 0
    ]
    own = np.median(check.curve("eps_t")) if check and len(check.curve("eps_t")) else None
    floor = max(min(positive), (own or 0) / 3, max(positive) * 1e-8)
    for index, (axes, (name, runs)) in enumerate(zip(grid, lines.items())):
        runs = sorted(runs, key=lambda run: run.number("vibration_error"))
        for run, colour in zip(runs, shades(study.colour[name], len(runs))):
            axes.semilogy(run.curve("error_time"), np.maximum(run.curve("eps_t"), floor / 2),
                          linewidth=1, color=colour)
        if check and len(check.curve("eps_t")):
            axes.fill_between(check.curve("error_time"), floor / 2, check.curve("eps_t"),
                              color="#d9d9d9", alpha=0.8, linewidth=0, zorder=0)
        axes.set_title(name, color=study.colour[name], fontsize=9)
        axes.set_xlim(*study.window()), axes.set_ylim(floor / 2, max(positive) * 2)
        logarithmic(axes.yaxis, percent)
        for run, below in ((runs[0], True), (runs[-1], False)) if len(runs) > 1 else ((runs[0],
                                                                                       False),):
            end = run.curve("eps_t")[-max(1, len(run.curve("eps_t")) // 4):]
            level = max(0.85 * end.min() if below else 1.15 * end.max(),
                        floor * (4 if below else 1))
            axes.text(study.window()[1], level,
                      short(run.value) + " ", ha="right", va="top" if below else "bottom",
                      fontsize=7.5, color=study.colour[name])
        if index % columns == 0:
            axes.set_ylabel("error eps_t")
        if index >= len(lines) - columns:
            axes.set_xlabel(label("time", "s"))
    headline(
        figure, "Error over time", f"{study.scene()}; dark: the largest error of each method, "
        "grey: that of the reference itself")
    return figure


def representative(runs, enough=0.01):
    """The fastest run of a line whose vibration error is at most 1 %, or else its most accurate
    one."""
    good = [run for run in runs if run.number("vibration_error") <= enough]
    return min(good, key=lambda run: run.number("cpu_per_simulated_s")) if good else min(
        runs, key=lambda run: run.number("vibration_error"))


def draw_bit_speed(study):
    """Bit speed over time, one run of each line over the reference."""
    reference = study.companion("reference")
    if reference is None or not study.lines or not len(reference.curve("bit_time")):
        return None
    figure, grid, columns = panels(len(study.lines), height=1.9, sharex=True, sharey=True)
    for index, (axes, (name, runs)) in enumerate(zip(grid, study.lines.items())):
        run = representative(runs)
        axes.plot(reference.curve("bit_time"), RPM * reference.curve("bit_speed"), color="#bdbdbd",
                  linewidth=2.2)
        axes.plot(run.curve("bit_time"), RPM * run.curve("bit_speed"), color=study.colour[name],
                  linewidth=0.8)
        axes.axvspan(*study.window(), color="#f2f2f2", zorder=0, linewidth=0)
        axes.set_title(name + (f": {short(run.value)}" if run.value else ""),
                       color=study.colour[name], fontsize=9)
        axes.set_xlim(reference.curve("bit_time")[0], reference.curve("bit_time")[-1])
        if index % columns == 0:
            axes.set_ylabel(label("bit speed", "rpm"))
        if index >= len(study.lines) - columns:
            axes.set_xlabel(label("time", "s"))
    headline(
        figure, "Bit speed", f"{study.scene()}; the fastest run of each method with vibration "
        "error up to 1 % (else its best) over the reference (grey); shaded: window of errors")
    return figure


def draw_statistics(study):
    """Contact duty, lateral motion and spectrum beyond the window."""
    reference = study.companion("reference")
    if reference is None or not len(
            reference.curve("contact_duty")) or not study.lines or "profile" not in study.file:
        return None
    s = study.file["profile/s"][:]
    rows = -(-len(study.lines) // 2)
    figure = plt.figure(figsize=(11, 6 + 0.2 * rows), constrained_layout=True)
    grid = figure.add_gridspec(2, 3, width_ratios=[1, 1, 2], height_ratios=[6, 0.2 * rows])
    duty, rms, spectrum, key = (figure.add_subplot(place)
                                for place in (grid[0, 0], grid[0, 1], grid[0, 2], grid[1, :]))
    key.axis("off")
    plots.profiles((duty, rms),
                   (label("time in contact", "%"), label("lateral vibration", "mm rms")),
                   (s[0], s[-1]))
    duty.fill_betweenx(s, 100 * reference.curve("contact_duty"), step="mid", color=PALE,
                       linewidth=0)
    rms.fill_betweenx(s, 1e3 * reference.curve("lateral_rms"), color=PALE, linewidth=0)
    if len(reference.curve("spectrum")) > 1:
        spectrum.fill_between(
            reference.curve("frequency")[1:],
            reference.curve("spectrum")[1:], color=PALE, linewidth=0)
    handles = []
    for name, runs in study.lines.items():
        run = representative(runs)
        style = {
            "color": study.colour[name], "linewidth": 1, "linestyle": "--" if run.reduced else "-"
        }
        duty.plot(100 * run.curve("contact_duty"), s, **style)
        handles += rms.plot(1e3 * run.curve("lateral_rms"), s,
                            label=name + (f": {short(run.value)}" if run.value else ""), **style)
        if len(run.curve("spectrum")) > 1:
            spectrum.plot(run.curve("frequency")[1:], run.curve("spectrum")[1:], **style)
    duty.set_xlim(0, 102), rms.set_xlim(left=0)
    if len(reference.curve("spectrum")) > 1:
        top = reference.curve("spectrum")[1:].max()
        spectrum.set_xscale("log"), spectrum.set_yscale("log")
        spectrum.set_ylim(1e-9 * top, 3 * top)
        spectrum.set_xlim(reference.curve("frequency")[1], reference.curve("frequency")[-1])
        logarithmic(spectrum.xaxis), logarithmic(spectrum.yaxis)
        spectrum.set_xlabel(label("frequency", "Hz")), spectrum.set_ylabel(
            label("lateral spectrum, mean of nodes", "m²/Hz"))
    else:
        spectrum.set_visible(False)
    key.legend(handles=handles, loc="center", ncol=2, fontsize=8)
    headline(
        figure, f"Statistics beyond {study.window()[1]:g} s",
        f"{study.scene()}; the fastest run of each method with vibration error up to 1 % (else its "
        "best), the reference in grey")
    return figure


def draw_static(study):
    """Where every run starts from."""
    if "profile" not in study.file:
        return None
    profile = {name: values[:] for name, values in study.file["profile"].items()}
    s = profile["s"]
    middle = 0.5 * (s[1:] + s[:-1])
    figure, row = plt.subplots(1, 4, figsize=(11, 5.5), sharey=True, constrained_layout=True)
    radial, contact, axial, torque = row
    plots.profiles(row, [
        label(*pair) for pair in (("lateral displacement", "mm"), ("contact force", "kN"),
                                  ("axial force", "kN"), ("torque", "kN m"))
    ], (s[0], s[-1]))
    radial.fill_betweenx(s, 1e3 * profile["clearance"], step="mid", color="#ececec", linewidth=0)
    radial.plot(1e3 * profile["radius"], s, color="black", linewidth=1.2)
    scale = np.linalg.norm(profile["radius"]) or 1.0
    away = {}
    for run in study.methods:
        start = run.curve("initial_radius")
        if len(start) == len(s) and np.linalg.norm(start - profile["radius"]) > 1e-3 * scale:
            away.setdefault(run.line, []).append((np.linalg.norm(start - profile["radius"]), run))
    for name, runs in away.items():
        run = max(runs, key=lambda pair: pair[0])[1]
        radial.plot(1e3 * run.curve("initial_radius"), s, color=study.colour[name], linewidth=1,
                    linestyle="--", label=f"start of {name}: {short(run.value)}")
    if away:
        figure.legend(loc="upper center", bbox_to_anchor=(0.5, 0.0), ncol=2, fontsize=8)
    radial.set_xlim(0, 1150 * max(profile["radius"].max(), 1e-9))
    contact.hlines(s, 0, profile["normal_force"] / 1e3, color=COLOURS[0], linewidth=1.2)
    contact.set_xlim(left=0)
    for axes, key, colour in ((axial, "axial_force", COLOURS[1]), (torque, "torque", COLOURS[2])):
        axes.plot(profile[key] / 1e3, middle, color=colour, linewidth=1.4)
        axes.axvline(0, color=GREY, linewidth=0.6)
    headline(figure, "Static state (black) in its clearance (grey)", study.scene())
    return figure


def draw_reference(study):
    """How far the reference can be trusted: growth of a small change, and distance to its check."""
    curves = [(kind, study.companion(kind), text, colour) for kind, text, colour in (
        ("check", "distance to the check run", COLOURS[0]),
        ("sensitivity", f"growth of a change of {float(study.attribute('perturbation', 0)):.0e} m",
         COLOURS[1]),
    )]
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
        axes.annotate(text, (time[kept][at], growth[kept][at:at + max(1, at // 4)].max()),
                      xytext=(0, 9), textcoords="offset points", ha="center", color=colour,
                      fontweight="bold")
    axes.axvspan(*study.window(), color="#f2f2f2", zorder=0, linewidth=0)
    axes.text(study.window()[0], 1, " window of pointwise errors",
              transform=axes.get_xaxis_transform(), va="top", fontsize=8, color="#666666",
              style="italic")
    logarithmic(axes.yaxis)
    axes.set_xlim(time[0], time[-1])
    axes.set_xlabel(label("time",
                          "s")), axes.set_ylabel(label("largest lateral distance of a node", "m"))
    headline(figure, "What the reference is worth", study.scene())
    return figure


PLOTS = {
    "speed": draw_speed, "bases": draw_bases, "modes": draw_modes,
    "error_over_time": draw_error_over_time, "bit_speed": draw_bit_speed,
    "statistics": draw_statistics, "static": draw_static, "reference": draw_reference
}


def draw_all(study, output, kinds):
    """Names of the plots that the study has something to show in."""
    made = []
    for name, draw in PLOTS.items():
        figure = draw(study)
        if figure is None:
            continue
        for kind in kinds:
            path = output / f"study_{name}.{kind}"
            with files.writing(path):
                figure.savefig(path, bbox_inches="tight")
        plt.close(figure)
        made.append(name)
    return made


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, help="folder of a study")
    parser.add_argument("--output", type=pathlib.Path, help="where the pictures go (default: DIR)")
    parser.add_argument("--formats", default="png,svg", help="file types, separated by commas")
    options = parser.parse_args()
    for name in ("study.csv", "study.h5"):
        if not (options.folder / name).is_file():
            sys.exit(f"{options.folder} holds no {name}: name the folder of a study.")
    output = options.output or options.folder
    with files.failing(), files.writing(output):
        output.mkdir(parents=True, exist_ok=True)
    plots.use_style()
    with files.failing(), files.reading(options.folder / "study.csv"):
        made = draw_all(Study(options.folder), output, options.formats.split(","))
    print(
        textwrap.fill(f"pictures    {output}: " + ", ".join(f"study_{name}" for name in made), 100,
                      subsequent_indent=" " * 12, break_long_words=False, break_on_hyphens=False))
    return 0


if __name__ == "__main__":
    sys.exit(main())
