# SPDX-License-Identifier: BSD-3-Clause
"""Plots of campbell.h5 and response.h5: diagrams over the rotary speed, modes and amplitudes along
a string with depth downwards."""
from __future__ import annotations

from typing import Any

import numpy as np

from .style import (COLOURS, GREY, MAP, PALE, RPM, depth_axis, label, legend_above, logarithmic,
                    plt, whole_ticks)

FORWARD, BACKWARD = COLOURS[:2]
UNSTABLE = "#B00020"  # of modes that grow
CLEAR_WHIRL = 0.1  # as a share of a circular orbit; smaller values are drawn grey
MOST_SHAPES = 8  # per picture
ROUNDING = 1e-9  # a smaller damping ratio is zero
NO_LATERAL = 1e-3  # smaller lateral shares of the largest displacement are not lateral motion


def columns(results: Any, group: str) -> dict[str, Any] | None:
    """The datasets of a group by name; None if there is no group."""
    return {name: data[:] for name, data in results[group].items()} if group in results else None


def texts(dataset: Any) -> list[str]:
    return [text.decode() if isinstance(text, bytes) else str(text) for text in dataset[:]]


def whirl_colour(whirl: float) -> str:
    return FORWARD if whirl > CLEAR_WHIRL else BACKWARD if whirl < -CLEAR_WHIRL else GREY


def whirl_word(whirl: float) -> str:
    """The word for the whirl of a mode, printed beside its frequency."""
    return "forward" if whirl > CLEAR_WHIRL else "backward" if whirl < -CLEAR_WHIRL else "in a line"


def campbell_figure(results: Any) -> Any:
    """Frequencies and damping ratios against the rotary speed, lines of the excitations, critical
    speeds."""
    rows, crossings = columns(results, "campbell"), columns(results, "crossings")
    if rows is None:
        return None
    made, (frequencies, damping) = plt.subplots(2, 1, figsize=(8, 8), sharex=True,
                                                height_ratios=[2.2, 1], constrained_layout=True)
    grows = rows["damping"] < -ROUNDING
    words = set()
    for mode in np.unique(rows["mode"]):
        here = rows["mode"] == mode
        whirl = np.median(rows["whirl"][here])
        words.add(whirl_word(whirl))
        look = {
            "color": whirl_colour(whirl), "linewidth": 1.1,
            "marker": "." if np.sum(here) == 1 else ""
        }
        frequencies.plot(RPM * rows["speed"][here], rows["frequency"][here], **look)
        damping.plot(RPM * rows["speed"][here], rows["damping"][here], **look)
    for axes, name in ((frequencies, "frequency"), (damping, "damping")):
        axes.plot(RPM * rows["speed"][grows], rows[name][grows], "x", color=UNSTABLE, markersize=4)
    first, last = RPM * rows["speed"].min(), RPM * rows["speed"].max()
    low, top = rows["frequency"].min(), rows["frequency"].max()
    room = 0.05 * (top - low if top > low else top)
    low, top = (0.0 if low < 0.5 * top else low -
                room), top + 2 * room  # space for the names of the excitations above the modes
    frequencies.set_xlim(first, last), frequencies.set_ylim(low, top)
    for name, order, offset in zip(texts(results["excitations"]), results["orders"][:],
                                   results["offsets"][:]):
        ends = np.array([first, last])
        frequencies.plot(ends, order * ends / 60 + offset, color="0.7", linewidth=0.8,
                         linestyle="--")
        at = min(last, 60 * (top - offset) / order) if order > 0 else last
        if at > first and low < order * at / 60 + offset <= top * (
                1 + 1e-9):  # vertical beside a line that leaves through the top, else above its end
            frequencies.annotate(
                name, (at, order * at / 60 + offset), fontsize=8, color="0.4", ha="right",
                **({"rotation": 90, "va": "top"} if at < last else {"va": "bottom"}))
    if crossings is not None:
        frequencies.plot(RPM * crossings["speed"], crossings["frequency"], "ko", markersize=4,
                         fillstyle="none", label="critical speeds")
    for word, text, colour in (
        ("forward", "forward whirl", FORWARD),
        ("backward", "backward whirl", BACKWARD),
        ("in a line", "in a line, axial, torsional", GREY),
    ):
        if word in words:
            frequencies.plot([], [], color=colour, label=text)
    if grows.any():
        frequencies.plot([], [], "x", color=UNSTABLE, markersize=4, label="grows")
    frequencies.set_ylabel(label("frequency", "Hz"))
    legend_above(frequencies)
    damping.axhline(0, color="0.7", linewidth=0.6)
    damping.set_ylim(bottom=min(-1e-4, 1.1 * rows["damping"].min()),
                     top=max(1e-3, 1.1 * rows["damping"].max()))  # wide enough not to show rounding
    damping.set_ylabel("damping ratio"), damping.set_xlabel(label("rotary speed", "rpm"))
    return made


def semi_axis(u: Any, v: Any) -> Any:
    """Larger semi-axis of the ellipse Re((u, v) exp(i phi)).

    >>> float(semi_axis(3.0, 4.0)), float(semi_axis(2.0, -2.0j))
    (5.0, 2.0)
    """
    return np.sqrt(0.5 * (np.abs(u)**2 + np.abs(v)**2 + np.abs(u * u + v * v)))


def shape_places(group: Any, most: int = MOST_SHAPES) -> list[int]:
    """The shapes to draw: those at critical speeds, then those of a single speed, lateral shapes
    first; sorted by frequency."""
    at_speed = np.flatnonzero(group["excitation"][:] == 0)
    critical = np.flatnonzero(group["excitation"][:] > 0)
    chosen = list(critical[:most]) + list(at_speed[:max(0, most - len(critical))])
    return sorted((int(i) for i in chosen), key=lambda i: float(group["frequency"][i]))


def in_hole(axes: Any, depth: Any, closed: Any, first: bool) -> None:
    """Axes of a shape against depth, with ticks for nodes on the wall; only the first ones show the
    depths."""
    axes.plot(np.full(len(closed), -1.12), closed, "_", color="0.3", markersize=3)
    axes.set_xlim(-1.2, 1.2)
    whole_ticks(axes, 3, 8)
    depth_axis(axes, (depth[0], depth[-1]))
    if not first:
        axes.set_ylabel(""), axes.tick_params(labelleft=False)


def row_of_shapes(count: int) -> tuple[Any, Any]:
    made, row = plt.subplots(1, count, figsize=(1.15 + 1.35 * count, 6.2), squeeze=False,
                             constrained_layout=True)
    return made, row[0]


def shapes_figure(results: Any, most: int = MOST_SHAPES) -> Any:
    """Modes in the hole: displacements across the axis against depth, at two instants a quarter
    period apart, and the envelope of the orbits; None without a string."""
    if "shapes" not in results or "profile/s" not in results:
        return None
    group, depth = results["shapes"], results["profile/s"][:]
    closed = depth[results["profile/normal_force"][:] > 0]
    names = [""] + texts(results["excitations"])
    places = shape_places(group, most)
    made, row = row_of_shapes(len(places))
    for number, (axes, place) in enumerate(zip(row, places)):
        shape = group["real"][place] + 1j * group["imaginary"][place]
        u, v = shape[:, 0], shape[:, 1]
        whirl = float(group["whirl"][place])
        lateral = np.max(np.abs(shape[:, :2])) > NO_LATERAL * np.max(np.abs(shape))
        if lateral:
            reach = semi_axis(u, v)
            axes.fill_betweenx(depth, -reach, reach, color=PALE, linewidth=0)
            for part, dashes in ((u, "-"), (v, "--")):
                axes.plot(part.real, depth, color=whirl_colour(whirl), linewidth=1.0,
                          linestyle=dashes)
            said = whirl_word(whirl)
        else:
            part, said = axial_or_torsional(shape)
            axes.plot(part, depth, color=COLOURS[2], linewidth=1.0)
        in_hole(axes, depth, closed, number == 0)
        met = names[int(group["excitation"][place])]
        damping = float(group["damping"][place])
        grows = damping < -ROUNDING
        axes.set_title(
            f"{format(group['frequency'][place], '#.4g').rstrip('.')} Hz\n"
            f"{RPM * group['speed'][place]:.2f} rpm{', ' + met if met else ''}\n{said}\n"
            f"damping {damping if abs(damping) > ROUNDING else 0:.3f}{', grows' if grows else ''}",
            fontsize=7.5, fontweight="normal", color=UNSTABLE if grows else "black")
    made.supxlabel(
        "displacement over the largest one; solid: u, dashed: v, grey: orbits; ticks on the left: "
        "nodes on the wall", fontsize=8)
    return made


def axial_or_torsional(shape: Any) -> tuple[Any, str]:
    """The axial or torsional component of a shape (nodes x components) without lateral motion, over
    its largest value, and its name."""
    along, about = np.max(np.abs(shape[:, 2])), np.max(np.abs(shape[:, 5]))
    part, said = (shape[:, 2], "axial") if along > about else (shape[:, 5], "torsional")
    return part.real / np.max(np.abs(part)), said


def mode_shapes_figure(results: Any, most: int = MOST_SHAPES) -> Any:
    """The lowest undamped modes of a string in the hole: displacements across the axis against
    depth, or along or about it; None without a string."""
    if "modes/shape" not in results or "profile/s" not in results:
        return None
    depth, shapes, frequency = results["profile/s"][:], results["modes/shape"][:most], results[
        "modes/frequency"][:most]
    closed = depth[results["profile/normal_force"][:] > 0]
    made, row = row_of_shapes(len(shapes))
    for number, (axes, shape) in enumerate(zip(row, shapes)):
        if np.max(np.abs(shape[:, :2])) > NO_LATERAL * np.max(np.abs(shape)):
            said = "lateral"
            for part, dashes in ((shape[:, 0], "-"), (shape[:, 1], "--")):
                axes.plot(part, depth, color=COLOURS[0], linewidth=1.0, linestyle=dashes)
        else:
            part, said = axial_or_torsional(shape)
            axes.plot(part, depth, color=COLOURS[2], linewidth=1.0)
        in_hole(axes, depth, closed, number == 0)
        axes.set_title(
            f"mode {number + 1}\n{format(frequency[number], '#.4g').rstrip('.')} Hz\n{said}",
            fontsize=7.5, fontweight="normal", color=UNSTABLE if frequency[number] < 0 else "black")
    made.supxlabel(
        "displacement over the largest one; solid: u, dashed: v; ticks on the left: nodes on the "
        "wall", fontsize=8)
    return made


def response_figure(results: Any) -> Any:
    """Amplitude and phase of every output, largest amplitudes marked."""
    group, peaks, rows = results["response"], columns(results,
                                                      "peaks"), columns(results, "response")
    assert rows is not None
    x, along = over(rows)
    names = [name[:-len("_amplitude")] for name in group if name.endswith("_amplitude")]
    made, (amplitudes, phases) = plt.subplots(2, 1, figsize=(8, 7), sharex=True,
                                              height_ratios=[2, 1], constrained_layout=True)
    units = set()
    for name in names:
        unit = group[name + "_amplitude"].attrs["units"]
        unit = unit.decode() if isinstance(unit, bytes) else unit
        amplitude = rows[name + "_amplitude"]
        line, = amplitudes.semilogy(x, np.where(amplitude > 0, amplitude, np.nan), linewidth=1.1,
                                    label=label(name, unit))
        units.add(unit)
        phases.plot(x, np.degrees(np.unwrap(rows[name + "_phase"])), color=line.get_color(),
                    linewidth=1.0)
    if peaks is not None:
        by_speed = np.ptp(rows["speed"]) > 0
        amplitudes.semilogy(RPM * peaks["speed"] if by_speed else peaks["frequency"],
                            peaks["amplitude"], "ko", markersize=4, fillstyle="none")
    positive = np.concatenate([rows[name + "_amplitude"] for name in names])
    positive = positive[positive > 0]
    if positive.size:
        amplitudes.set_ylim(bottom=0.5 * positive.min())
        logarithmic(amplitudes.yaxis)
    amplitudes.set_ylabel(
        label("amplitude",
              units.pop() if len(units) == 1 else "unit of the output"))
    legend_above(amplitudes, 3)
    phases.set_ylabel(label("phase", "deg")), phases.set_xlabel(along)
    return made


def profile_figure(results: Any) -> Any:
    """Bending moments and distances to the wall along a string: extremes of each node in the sweep,
    and their distribution over speed or frequency; None without a string."""
    rows = columns(results, "response")
    groups = [(name, group) for name in ("bending", "margins")
              if (group := columns(results, name)) is not None]
    if not groups or rows is None:
        return None
    x, along = over(rows)
    made, grid = plt.subplots(len(groups), 2, figsize=(8, 4.2 * len(groups)), width_ratios=[1, 1.7],
                              squeeze=False, constrained_layout=True)
    for (profile, picture), (name, group) in zip(grid, groups):
        depth = group["depth"]
        bending = name == "bending"
        if bending:
            values, scale, said = group["moments"], 1e-3, label("bending moment", "kN m")
        else:
            values, scale, said = group["margins"], 1e3, label("distance to the wall", "mm")
        profile.plot(scale * (group["moment"] if bending else group["margin"]), depth,
                     color=COLOURS[0], linewidth=1.1)
        if not bending:
            profile.plot(scale * group["gap"], depth, color=GREY, linewidth=0.8, linestyle="--",
                         label="at rest")
            profile.axvline(0, color=COLOURS[1], linewidth=0.8)
            legend_above(profile)
        profile.set_xlabel(("largest " if bending else "least ") + said)
        whole_ticks(profile, 4, 8)
        depth_axis(profile, (depth[0], depth[-1]))
        drawn = picture.pcolormesh(x, depth, scale * values.T, cmap=MAP if bending else MAP + "_r",
                                   shading="nearest", rasterized=True)
        picture.set_xlabel(along), picture.grid(False)
        picture.set_ylim(max(depth), min(depth))
        made.colorbar(drawn, ax=picture, label=said)
    return made


def over(rows: dict[str, Any]) -> tuple[Any, str]:
    """The abscissa of a response and its label: the rotary speed, or the frequency if the speed is
    constant."""
    if np.ptp(rows["speed"]) > 0:
        return RPM * rows["speed"], label("rotary speed", "rpm")
    return rows["frequency"], label("frequency", "Hz")
