# SPDX-License-Identifier: BSD-3-Clause
"""Figures of a run of imported parts: displacements of all nodes, the nodes with the largest
motion, forces of point laws."""
import h5py
import numpy as np

import plots
from plots import COLOURS
from report import results
from report.figures import DOWN_TO, Figure, draw_spectrum, frequency_axes


def components(run):
    """(number, name, unit) of the components of a node."""
    pairs = zip(results.texts(run.file["/model/components"]),
                results.texts(run.file["/model/component_units"]))
    return [(number, name, unit) for number, (name, unit) in enumerate(pairs)]


def label(name, unit):
    return f"{name} [{unit}]" if unit else name


def node_name(run, row):
    return (f"node {run.get('/model/node')[row]} of "
            f"{results.texts(run.file['/model/part_names'])[run.get('/model/part')[row] - 1]}")


def start_of(run):
    """Displacements at the start; only of the recorded nodes if there is a motion."""
    start = run.get("/static/displacement")
    return start[run.recorded] if run.records else start


def range_of(run):
    """Smallest and largest displacement of every recorded node and component over the motion."""
    low = high = start_of(run)
    if run.records:
        for _, block in run.blocks("/transient/displacement"):
            low, high = np.minimum(low, block.min(axis=0)), np.maximum(high, block.max(axis=0))
    return low, high


def displacements(run):
    """Displacements of every node, part by part: at the start, and the range of the motion."""
    part, names = run.get("/model/part"), results.texts(run.file["/model/part_names"])
    start = start_of(run)
    if run.records:
        part = part[run.recorded]
    low, high = range_of(run)
    row = np.arange(len(part))
    found = []
    for c, name, unit in components(run):
        if not np.abs(np.stack([low[:, c], high[:, c]])).max() > 0:
            continue
        made, axes = plots.figure(plots.WIDE, 2.0)
        if run.records:
            axes.fill_between(row, low[:, c], high[:, c], step="mid", color=COLOURS[5], alpha=0.5,
                              linewidth=0, label="range of the motion")
        axes.plot(row, start[:, c], ".", color="black", markersize=3, label="start")
        for first in np.flatnonzero(np.diff(part)):
            axes.axvline(first + 0.5, color="0.7", linewidth=0.6)
        present = np.unique(part)
        if len(present) <= 12:
            axes.set_xticks([row[part == number].mean() for number in present])
            axes.set_xticklabels([names[number - 1] for number in present], fontsize=8, rotation=15,
                                 ha="right")
        axes.set_xlim(-0.5, len(part) - 0.5)
        axes.set_ylabel(label(name, unit)), axes.set_xlabel("nodes, part by part")
        plots.legend_above(axes)
        found.append(
            Figure(
                f"nodes-{c + 1}", made, f"Component {name} of all "
                f"{'' if run.moves or not run.records else 'recorded '}nodes.", True))
    return found


def histories(run):
    """(component, name, unit, node, values) of the node with the largest motion in each
    component."""
    if not run.records:
        return
    low, high = range_of(run)
    for c, name, unit in components(run):
        reach = high[:, c] - low[:, c]
        if reach.max() > 0:
            node = int(reach.argmax())
            history = run.file["/transient/displacement"][:, node, c]
            yield c, name, unit, int(run.recorded[node]), history


def movers(run):
    found = []
    for c, name, unit, node, values in histories(run):
        made, axes = plots.in_time(label(name, unit), run.time, 2.0)
        axes.plot(*plots.envelope(run.time, values), color=COLOURS[c % len(COLOURS)], linewidth=0.8)
        found.append(
            Figure(f"mover-{c + 1}", made,
                   f"Component {name} of {node_name(run, node)}, which moves most.", True))
    return found


def forces(run):
    """Recorded channels of point laws: the largest magnitude over their points."""
    moving = run.file.get("/transient")
    found = []
    for law in moving if moving is not None else []:
        if not isinstance(moving[law], h5py.Group):
            continue
        for name, channel in moving[law].items():
            made, axes = plots.in_time(f"{name.replace('_', ' ')} [{channel.attrs['units']}]",
                                       run.time, 2.0)
            axes.plot(
                *plots.envelope(run.time,
                                np.abs(channel[:]).reshape(len(run.time), -1).max(axis=1)),
                color=COLOURS[1], linewidth=0.8)
            found.append(
                Figure(f"law-{len(found) + 1}", made,
                       f"{law}: {name.replace('_', ' ')}, largest size over its points.", True))
    return found


def spectra(run):
    if not run.records:
        return []
    interval = float(np.median(np.diff(run.time)))
    found = []
    for wanted in ("m", "rad"):
        made, axes = frequency_axes(f"displacement [{wanted}²/Hz]")
        for c, name, unit, node, values in histories(run):
            if unit == wanted:
                draw_spectrum(axes, values[run.second_half():], interval,
                              color=COLOURS[c % len(COLOURS)],
                              label=f"{name}, {node_name(run, node)}")
        if axes.lines:
            plots.legend_above(axes, 2)
            found.append(
                Figure(
                    f"spectrum-{wanted}", made,
                    f"Spectra of the nodes that move most, second half of the motion, {DOWN_TO}.",
                    True))
        else:
            plots.plt.close(made)
    return found
