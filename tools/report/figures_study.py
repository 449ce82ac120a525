# SPDX-License-Identifier: BSD-3-Clause
"""Figures of a study over time: errors, bit speed, statistics, initial states of the runs and
reliability of the reference. `tools/plot_study.py` draws them."""
import numpy as np

import plots
from plots import COLOURS, GREY, RPM, headline, label, logarithmic, panels, percent, plt, shades

PALE = "#d9d9d9"  # of the reference of the curves


def short(value):
    """"Cut-off Frequency 25 Hz" -> "25 Hz"; "Modes 60" -> "60 modes"."""
    if value.startswith("Modes "):
        return value[6:] + " modes"
    for name in ("Step ", "Cut-off Frequency "):
        if value.startswith(name):
            return value[len(name):]
    return value[:1].lower() + value[1:] if value[:2].istitle() else value


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
        ends = [(runs[0], True), (runs[-1], False)]
        for run, below in ends if len(runs) > 1 else [(runs[0], False)]:
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
    """The fastest run of a line with a vibration error of at most 1 %, or else its most accurate
    one."""
    good = [run for run in runs if run.number("vibration_error") <= enough]
    return min(good, key=lambda run: run.number("cpu_per_simulated_s")) if good else min(
        runs, key=lambda run: run.number("vibration_error"))


def draw_bit_speed(study):
    """Bit speed over time: one run of each line and the reference."""
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
    """The initial state of every run."""
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
    """Reliability of the reference: growth of a small change, and distance to its check."""
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
