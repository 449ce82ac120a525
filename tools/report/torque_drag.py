# SPDX-License-Identifier: BSD-3-Clause
"""Section of torque and drag: hook loads, torques, tension with the buckling limits."""
import math
import shlex
from html import escape

import plots
from plots import COLOURS, GREY
from report import deck, tables
from report.figures import Figure
from report.files import numbers, read_table
from report.page import cards
from report.quantities import FOOT, POUND, both, fixed, plain

DASHES = ("-", "--", ":", "-.", (0, (5, 1, 1, 1, 1, 1))
          )  # line styles of the friction coefficients of a broomstick plot
SAME = 1e-2  # limits with a smaller relative difference are equal
MARGINS = (
    ("yield", "yield"),
    ("sinusoidal", "sinusoidal buckling"),
    ("helical", "helical buckling"),
)
QUANTITIES = (
    ("hook_load", "hook load [kN]", "Hook load"),
    ("surface_torque", "surface torque [kN m]", "Surface torque"),
)


def by_operation(rows):
    found = {}
    for row in rows:
        found.setdefault(row["operation"], []).append(row)
    return found


def thousandth(rows, name):
    return [value / 1e3 for value in numbers(rows, name)]


def deep_axes(label, rows):
    made, axes = plots.profile(label, (0, max(numbers(rows, "bit_depth"))))
    axes.set_ylabel("depth of the bit [m]")
    return made, axes


def against_depth(value, label, title, rows):
    made, axes = deep_axes(label, rows)
    stiff = f"stiff_{value}"
    rings = stiff in rows[0] and any(math.isfinite(x) for x in numbers(rows, stiff))
    for number, (operation, own) in enumerate(by_operation(rows).items()):
        axes.plot(thousandth(own, value), numbers(own, "bit_depth"), color=COLOURS[number],
                  marker=plots.MARKERS[number], markersize=3, linewidth=1.2, label=operation)
        if rings:
            axes.plot(thousandth(own, stiff), numbers(own, "bit_depth"), color=COLOURS[number],
                      marker="o", markersize=6, markerfacecolor="none", linestyle="none")
    plots.legend_above(axes, 2, -0.4)
    return Figure(
        value.replace("_", "-"), made, f"{title} against the depth of the "
        f"bit{'; rings: the string with bending stiffness' if rings else ''}.")


def least_around(values, reach=7):
    """The least of each value and its `reach` neighbours on both sides: where tool joints and pipe
    bodies alternate, the one that buckles first."""
    return [min(values[max(0, i - reach):i + reach + 1]) for i in range(len(values))]


def limits_of(rows):
    return {
        name: [-x / 1e3 for x in least_around(numbers(rows, f"{name}_limit"))
               ] for name in ("sinusoidal", "helical")
    }


def alike(one, other):
    """Whether two operations have the same buckling limits; unknown limits are equal to each other
    only."""
    return all(
        len(one[name]) == len(other[name]) and all(
            abs(a - b) <= SAME * max(abs(a), abs(b))
            for a, b in zip(one[name], other[name]) if math.isfinite(a) or math.isfinite(b))
        for name in one)


def tensions(profiles):
    """Tension along the string of all operations with the same buckling limits, and these limits; a
    single figure in most wells."""
    groups = []
    for number, (operation, rows) in enumerate(profiles.items()):
        limits = limits_of(rows)
        group = next((group for group in groups if alike(group[0], limits)), None)
        if group is None:
            groups.append(group := (limits, []))
        group[1].append((operation, rows, COLOURS[number]))
    found = []
    for number, (limits, members) in enumerate(groups, 1):
        depth = numbers(members[0][1], "depth")
        made, axes = plots.figure(plots.WIDE, 3.6)
        for operation, rows, colour in members:
            axes.plot(thousandth(rows, "tension"), numbers(rows, "depth"), color=colour,
                      linewidth=1.3, label=operation)
        for name, dashes in (("sinusoidal", "--"), ("helical", ":")):
            if any(map(math.isfinite, limits[name])):
                axes.plot(limits[name], depth, color="black", linewidth=1.0, linestyle=dashes,
                          label=f"{name} limit")
        axes.axvline(0, color=GREY, linewidth=0.6)
        axes.set_xlabel("effective tension [kN]")
        plots.depth_axis(axes, (0, max(depth)))
        plots.legend_above(axes, 3)
        found.append(
            Figure(
                f"buckling-{number}", made, f"Tension along the string, bit at {max(depth):.0f} m, "
                "and the compressions at which pipe or tool joint buckles.", True))
    return found


def broomsticks(folder, rows):
    """Curves for one friction coefficient each, and measurements if the folder has them."""
    broom, measured = (read_table(folder / f"torque_drag_{name}.csv") if
                       (folder / f"torque_drag_{name}.csv").is_file() else []
                       for name in ("broomstick", "measured"))
    if not broom and not measured:
        return []
    found = []
    frictions = sorted({row["friction"] for row in broom})
    for value, label, title in QUANTITIES:
        made, axes = plots.figure(plots.WIDE, 3.6)
        axes.set_xlabel(label)
        plots.depth_axis(axes, (0, max(numbers(broom + measured + rows, "bit_depth"))),
                         "depth of the bit")
        for number, (operation, own) in enumerate(by_operation(broom).items()):
            for friction in frictions:
                curve = [row for row in own if row["friction"] == friction]
                dashes = DASHES[frictions.index(friction) % len(DASHES)]
                axes.plot(thousandth(curve, value), numbers(curve, "bit_depth"),
                          color=COLOURS[number], linewidth=1.0, linestyle=dashes)
            axes.plot([], [], color=COLOURS[number], label=operation)
        for friction in frictions:
            axes.plot([], [], color="black", linewidth=1.0,
                      linestyle=DASHES[frictions.index(friction) % len(DASHES)],
                      label=f"friction {friction:g}")
        for number, (operation, own) in enumerate(by_operation(measured).items()):
            axes.plot(thousandth(own, value), numbers(own, "bit_depth"), color="black",
                      marker=plots.MARKERS[number], markersize=4, linestyle="none",
                      label=f"{operation}, measured")
        plots.legend_above(axes, 3)
        said = "; ".join(
            filter(None,
                   ("a colour for each operation, a line style for each friction coefficient of "
                    "the whole hole" if broom else "", "marks: measured" if measured else "")))
        found.append(
            Figure(f"broomstick-{value.replace('_', '-')}", made,
                   f"{title} against the depth of the bit: {said}.", True))
    return found


def table_of(rows):
    """Operations with the bit at its largest depth."""
    deepest = max(numbers(rows, "bit_depth"))

    def scaled(row, name, *factors):
        return [
            fixed(row[name] * factor, 1) if isinstance(row[name], float) else "-"
            for factor in factors
        ]

    return tables.table(
        ("operation", "hook load [kN]", "[klbf]", "torque [kN m]", "[kft lbf]",
         *(name for name, _ in MARGINS), "lock-up [m]"),
        [(row["operation"], *scaled(row, "hook_load", 1e-3, 1e-3 / POUND),
          *scaled(row, "surface_torque", 1e-3, 1e-3 / (FOOT * POUND)),
          *(fixed(row[f"{name}_margin"], 2) if isinstance(row[f"{name}_margin"], float) else "-"
            for name, _ in MARGINS), plain(row["lock_up_depth"]))
         for row in rows if row["bit_depth"] == deepest], range(1, 9),
        f"Bit at {deepest:.0f} m; margins are allowed over present load, above 1 there is reserve")


def headline(results):
    """Cards with the operations with the bit at its largest depth."""
    rows = results.value("torque_drag.rows") or []
    found = []
    loads = [row for row in rows if row["hook_load"] is not None]
    for name, pick in (("Largest hook load", max), ("Least hook load", min)):
        if loads:
            row = pick(loads, key=lambda row: row["hook_load"])
            found.append((name, *both(row["hook_load"], "hook load"), row["operation"], False))
    turned = [row for row in rows if row["surface_torque"]]
    if turned:
        row = max(turned, key=lambda row: abs(row["surface_torque"]))
        found.append(("Largest surface torque", *both(row["surface_torque"], "torque"),
                      row["operation"], False))
    for name, words in MARGINS:
        known = [row for row in rows if row[f"{name}_margin"] is not None]
        if known:
            row = min(known, key=lambda row, name=name: row[f"{name}_margin"])
            found.append(
                (f"Margin to {words}", fixed(row[f"{name}_margin"], 2), "above 1 there is reserve",
                 f"{row['operation']}, at {both(row[f'{name}_margin_depth'], 'length')[0]}",
                 row[f"{name}_margin"] < 1))
    if results.value("torque_drag.locked_up"):
        found.append(("Locked up", plain(results.value("torque_drag.locked_up")), "",
                      "combinations of operation and depth", True))
    return cards(found) if found else ""


def invitation(run, scene):
    """The command that adds torque, drag and buckling limits to the page of a run without them; ""
    if the deck lacks the data for them."""
    if (run.folder / "torque_drag.csv").is_file() or deck.value(
            scene, "Contact/Friction/Dynamic") is None or "Loads" not in scene:
        return ""
    edits = [edit for edit in run.attribute("overrides").splitlines() if edit]
    switches = [
        part for edit in edits
        for part in (("--without", edit[1:]) if edit.startswith("!") else ("--set", edit))
    ]
    command = shlex.join([
        "tooljoint", "torque-drag",
        run.attribute("deck_file"), "--output",
        str(run.folder), *switches
    ])
    return ('<p class="remark no-print">Torque, drag and buckling limits on this page: '
            f'<code>{escape(command)}</code>, or <code>Torque and Drag/After Run</code> in the '
            'deck.</p>')


def add(page, folder):
    """Adds hook load and surface torque against the depth of the bit, and tension with buckling
    limits at the largest depth."""
    rows = read_table(folder / "torque_drag.csv") if (folder / "torque_drag.csv").is_file() else []
    if not rows:
        return
    found = [against_depth(*quantity, rows) for quantity in QUANTITIES]
    if (folder / "torque_drag_profile.csv").is_file():
        with page.section(folder / "torque_drag_profile.csv"):
            found += tensions(by_operation(read_table(folder / "torque_drag_profile.csv")))
    with page.section(folder / "torque_drag_broomstick.csv"):
        found += broomsticks(folder, rows)
    page.plots("torque-drag", "Torque and drag", found, table_of(rows))
