#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the plots of a study: plot_study.py DIR [--output DIR] [--formats png,svg]

Reads study.csv and study.h5 in DIR and writes study_speed, study_bases, study_modes,
study_error_over_time, study_bit_speed, study_statistics, study_static and study_reference into the
output folder, each only if the study has data for it. Needs h5py, numpy and matplotlib.
"""
import argparse
import math
import pathlib
import sys
import textwrap

try:
    import numpy as np

    import plots
    from plots import COLOURS, GREY, MARKERS, Labels, headline, label, logarithmic, percent, plt
    from report import deck, files, results
    from report.figures_study import (PALE, draw_bit_speed, draw_error_over_time, draw_reference,
                                      draw_static, draw_statistics, short)
except ImportError as missing:
    sys.exit(f"{missing}: plot_study.py needs h5py, numpy and matplotlib (Debian: python3-h5py "
             "python3-matplotlib, then /usr/bin/python3).")


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
        """Relative excess of the longest over the shortest repeat; 0 for a single one."""
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
        """Conditions of the scene from the deck."""
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
    Names are beside the lines if all fit there."""
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
    """Labels after a legend has narrowed the axes: texts that now overlap others are removed."""
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
    """Points of a line for logarithmic axes: both numbers known and positive."""
    return [(x(run), y(run)) for run in runs if x(run) > 0 and y(run) > 0]


def draw_bases(study):
    """Cost and error of a reduced model: one line for each basis or variant of a basis. Runs whose
    motion failed are included with their frequencies."""
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


PLOTS = {
    "speed": draw_speed, "bases": draw_bases, "modes": draw_modes,
    "error_over_time": draw_error_over_time, "bit_speed": draw_bit_speed,
    "statistics": draw_statistics, "static": draw_static, "reference": draw_reference
}


def draw_all(study, output, kinds):
    """Draws the plots for which the study has data, and returns their names."""
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
    parser.add_argument("--output", type=pathlib.Path, help="folder of the pictures (default: DIR)")
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
