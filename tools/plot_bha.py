#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the results of `tooljoint bha`: tools/plot_bha.py DIR [--output FILE.png]

DIR/bha.h5: the string in its hole towards the high side and towards the right side, with its
clearance to the wall (narrow at stabilisers); its bending moment; and the side force of the bit
against the weight on bit, or against inclination or tool face if the deck varies those instead.
"""
import sys

try:
    from plots import COLOURS, GREY, MARKERS, headline, label, np, plt
    from report.folder import conditions, draw_folder
except ImportError as missing:
    sys.exit(f"{missing}: plot_bha.py needs h5py, numpy and matplotlib (Debian: python3-h5py "
             "python3-matplotlib, then /usr/bin/python3).")

MOST_LINES = 6  # states drawn along the string
SIDES = {"high": ("high side", "-"), "right": ("right side", "--")}
AXES = {
    "weight_on_bit": ("weight on bit", "kN", 1e-3),
    "inclination": ("inclination", "deg", 180 / np.pi),
    "tool_face": ("tool face", "deg", 180 / np.pi),
}


def columns(results, group):
    return {name: data[()] for name, data in results[group].items()}


def named(rows, i):
    face = "rotating" if rows["rotating"][
        i] else f"tool face {np.degrees(rows['tool_face'][i]):.0f} deg"
    return (f"{rows['weight_on_bit'][i] / 1e3:.0f} kN, {np.degrees(rows['inclination'][i]):.0f} "
            f"deg, {face}")


def shown(rows):
    """Indices of the states drawn along the string: the largest weight in the first hole."""
    first = rows["inclination"] == rows["inclination"][0]
    return np.flatnonzero(first
                          & (rows["weight_on_bit"] == rows["weight_on_bit"].max()))[:MOST_LINES]


def draw_string(axes, rows, profile, side):
    """Deflection towards one side, with the walls at the clearance of the string."""
    x = profile["from_bit"][0]
    for sign in (-1, 1):
        axes.fill_between(x, sign * 1e3 * profile["clearance"][0],
                          sign * 1e3 * profile["clearance"].max() * 1.25, step="mid", color=GREY,
                          alpha=0.35, linewidth=0)
    for number, i in enumerate(shown(rows)):
        axes.plot(x, 1e3 * profile[f"deflection_{side}"][i], color=COLOURS[number], linewidth=1.3,
                  label=named(rows, i))
    axes.set_ylabel(label(f"to the {SIDES[side][0]}", "mm"))


def draw_moment(axes, rows, profile):
    for number, i in enumerate(shown(rows)):
        moment = np.hypot(profile["moment_high"][i], profile["moment_right"][i])
        axes.plot(profile["from_bit"][i], moment / 1e3, color=COLOURS[number], linewidth=1.3)
    axes.set_ylabel(label("bending moment", "kN m"))


def draw_forces(axes, rows):
    """Side force against the parameter with most values; one line for each combination of the other
    parameters."""
    along = max(AXES, key=lambda name: len(np.unique(rows[name])))
    others = [name for name in AXES if name != along]
    keys = sorted({
        tuple([rows["rotating"][i], *(rows[name][i] for name in others)])
        for i in range(len(rows["rotating"])) if along != "tool_face" or not rows["rotating"][i]
    })
    for number, key in enumerate(keys):
        own = (rows["rotating"] == key[0]) & np.logical_and.reduce(
            [rows[name] == value for name, value in zip(others, key[1:])])
        values = [AXES[name][2] * value for name, value in zip(others, key[1:])]
        words = ", ".join(
            f"{AXES[name][0]} {value:.0f}" for name, value in zip(others, values)
            if len(np.unique(rows[name])) > 1 and not (key[0] and name == "tool_face"))
        for side, (what, dashes) in SIDES.items():
            axes.plot(
                AXES[along][2] * rows[along][own], rows[f"side_force_{side}"][own] / 1e3, dashes,
                marker=MARKERS[number % len(MARKERS)], markersize=4,
                color=COLOURS[number % len(COLOURS)], linewidth=1.2, label=", ".join(
                    part for part in (what, "rotating" if key[0] else "", words) if part))
    axes.axhline(0, color=GREY, linewidth=0.6)
    axes.set_xlabel(label(*AXES[along][:2])), axes.set_ylabel(label("side force of the bit", "kN"))
    axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.01, 0.5))


def draw_bha(results):
    rows, profile = columns(results, "rows"), columns(results, "profile")
    figure, axes = plt.subplots(4, 1, figsize=(9, 11), constrained_layout=True)
    draw_string(axes[0], rows, profile, "high")
    draw_string(axes[1], rows, profile, "right")
    draw_moment(axes[2], rows, profile)
    axes[0].legend(fontsize=7, loc="center left", bbox_to_anchor=(1.01, 0.5))
    draw_forces(axes[3], rows)
    for along in axes[:3]:
        along.set_xlabel(label("distance from the bit", "m"))
    headline(figure, "Bottom-hole assembly: deflection, bending moment, side force",
             conditions(results))
    return figure


if __name__ == "__main__":
    draw_folder(__doc__, "folder of tooljoint bha", {"bha.h5": draw_bha})
