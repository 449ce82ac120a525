# SPDX-License-Identifier: BSD-3-Clause
"""Sections and reports of tables: torque_drag.csv, bha.csv, buckling.csv, campbell.h5, response.h5, modes.csv, basis.csv."""
import math

import h5py

import plots
from plots import COLOURS, GREY, rotating
from report import tables
from report.figures import Figure
from report.page import Page
from report.quantities import FOOT, POUND, percent, plain
from report.results import read_table

BUCKLING_ROWS = 40  # of a page; buckling.csv has all
BASIS_ROWS = 60  # of a page; basis.csv has all


def numbers(rows, name):
    return [row[name] if isinstance(row[name], float) else math.nan for row in rows]


def by_operation(rows):
    found = {}
    for row in rows:
        found.setdefault(row["operation"], []).append(row)
    return found


def against_depth(name, label, caption, rows, value, scale):
    made, axes = plots.profile(label, (0, max(numbers(rows, "bit_depth"))))
    axes.set_ylabel("depth of the bit [m]")
    for number, (operation, own) in enumerate(by_operation(rows).items()):
        axes.plot([scale * x for x in numbers(own, value)], numbers(own, "bit_depth"), color=COLOURS[number], marker=plots.MARKERS[number], markersize=3, linewidth=1.2,
                  label=operation)
        stiff = numbers(own, f"stiff_{value}") if f"stiff_{value}" in own[0] else []
        if any(math.isfinite(x) for x in stiff):
            axes.plot([scale * x for x in stiff], numbers(own, "bit_depth"), color=COLOURS[number], marker="o", markersize=6, markerfacecolor="none", linestyle="none")
    plots.legend_above(axes, 2, -0.4)
    return Figure(name, made, caption)


def least_around(values, reach=7):
    """The least of each value and its `reach` neighbours on both sides: of tool joint and pipe body in turn, that of the one that buckles first."""
    return [min(values[max(0, i - reach):i + reach + 1]) for i in range(len(values))]


def limits_of(operation, rows, number):
    """Tension of one operation along the string, and where it would buckle."""
    depth = numbers(rows, "depth")
    made, axes = plots.profile("effective tension [kN]", (0, max(depth)))
    axes.plot([x / 1e3 for x in numbers(rows, "tension")], depth, color=COLOURS[0], linewidth=1.4, label="tension")
    low, high = axes.get_xlim()
    for name, colour, dashes in (("sinusoidal", COLOURS[1], "--"), ("helical", COLOURS[4], ":")):
        axes.plot([-x / 1e3 for x in least_around(numbers(rows, f"{name}_limit"))], depth, color=colour, linewidth=1.1, linestyle=dashes, label=f"{name} limit")
    reach = max(high - low, 1.0)
    axes.set_xlim(min(low, -0.35 * reach), high)
    axes.axvline(0, color=GREY, linewidth=0.6)
    plots.legend_above(axes, 2, -0.4)
    return Figure(f"buckling-{number + 1}", made, f"{operation}, bit at {max(depth):.0f} m: tension, and the compressions at which pipe or tool joint buckles.")


def add_torque_drag(page, folder):
    """Hook load and surface torque against the depth of the bit, and tension with buckling limits at the deepest bit."""
    if not (folder / "torque_drag.csv").is_file():
        return
    rows = read_table(folder / "torque_drag.csv")
    if not rows:
        return
    found = [against_depth("hook-load", "hook load [kN]", "Hook load against the depth of the bit; rings: the string with bending stiffness.", rows, "hook_load", 1e-3),
             against_depth("surface-torque", "surface torque [kN m]", "Surface torque against the depth of the bit; rings: the string with bending stiffness.", rows, "surface_torque", 1e-3)]
    if (folder / "torque_drag_profile.csv").is_file():
        profiles = by_operation(read_table(folder / "torque_drag_profile.csv"))
        found += [limits_of(operation, own, number) for number, (operation, own) in enumerate(profiles.items())]
    found += broomsticks(folder, rows)
    deepest = max(numbers(rows, "bit_depth"))
    last = [row for row in rows if row["bit_depth"] == deepest]
    table = tables.table(("operation", "hook load [kN]", "[klbf]", "torque [kN m]", "[kft lbf]", "yield", "sinusoidal", "helical", "lock-up [m]"),
                         [(row["operation"], *scaled(row["hook_load"], 1e-3, 1e-3 / POUND), *scaled(row["surface_torque"], 1e-3, 1e-3 / (FOOT * POUND)),
                           *(plain(row[f"{name}_margin"], 3) for name in ("yield", "sinusoidal", "helical")), plain(row["lock_up_depth"])) for row in last],
                         range(1, 9), f"Bit at {deepest:.0f} m; margins are allowed over present load, above 1 there is reserve")
    page.plots("torque-drag", "Torque and drag", found, table)


def broomsticks(folder, rows):
    """Curves of one friction coefficient each and what was measured, where the folder has them."""
    broom, measured = (read_table(folder / f"torque_drag_{name}.csv") if (folder / f"torque_drag_{name}.csv").is_file() else [] for name in ("broomstick", "measured"))
    if not broom and not measured:
        return []
    found = []
    deepest = max(numbers(broom + measured + rows, "bit_depth"))
    for value, label, title in (("hook_load", "hook load [kN]", "Hook load"), ("surface_torque", "surface torque [kN m]", "Surface torque")):
        made, axes = plots.profile(label, (0, deepest))
        axes.set_ylabel("depth of the bit [m]")
        frictions = sorted({row["friction"] for row in broom})
        for operation, own in by_operation(broom).items():
            for friction in frictions:
                curve = [row for row in own if row["friction"] == friction]
                axes.plot([x / 1e3 for x in numbers(curve, value)], numbers(curve, "bit_depth"), color=COLOURS[frictions.index(friction) % len(COLOURS)], linewidth=0.9,
                          label=f"friction {friction:g}" if operation == broom[0]["operation"] else None)
        for number, (operation, own) in enumerate(by_operation(measured).items()):
            axes.plot([x / 1e3 for x in numbers(own, value)], numbers(own, "bit_depth"), color="black", marker=plots.MARKERS[number], markersize=4, linestyle="none",
                      label=f"{operation}, measured")
        plots.legend_above(axes, 2, -0.4)
        found.append(Figure(f"broomstick-{value.replace('_', '-')}", made, f"{title}: one friction coefficient in the whole hole for each curve; dots: measured."))
    return found


def scaled(value, *factors):
    return [f"{value * factor:.1f}" if isinstance(value, float) else "-" for factor in factors]


def basis_table(folder):
    """The first BASIS_ROWS vectors of the bases, in the order of basis.csv."""
    if not (folder / "basis.csv").is_file():
        return ""
    rows = read_table(folder / "basis.csv")
    if not rows:
        return ""
    shown = rows[:BASIS_ROWS]
    more = f", the first {BASIS_ROWS} of {len(rows)}; basis.csv has all" if len(rows) > BASIS_ROWS else ""
    table = tables.table(("part", "kind", "vector", "frequency [Hz]", "residual", "kept", "why"),
                         [(row["part"], row["kind"], plain(row["vector"]), plain(row["frequency"]), plain(row["residual"], 2), row["kept"], row["why"]) for row in shown], (3, 4))
    return f"<details><summary>Vectors of the bases{more}</summary>{table}</details>"


def modes_figure(rows):
    made, axes = plots.figure(plots.WIDE, 2.8)
    made_of = [row for row in rows if isinstance(row.get("error"), float) and row["error"] != 0]
    if not made_of:
        plots.plt.close(made)
        return []
    axes.set_yscale("log")
    axes.plot(numbers(made_of, "mode"), [abs(x) for x in numbers(made_of, "error")], "o", color=COLOURS[0], markersize=4, label="error")
    estimated = [row for row in made_of if isinstance(row.get("estimate"), float) and row["estimate"] > 0]
    if estimated:
        axes.plot(numbers(estimated, "mode"), numbers(estimated, "estimate"), "s", markersize=4, markerfacecolor="none", color=COLOURS[1], label="estimate")
    plots.logarithmic(axes.yaxis)
    axes.set_xlabel("mode"), axes.set_ylabel("relative error of the frequency [1]")
    plots.legend_above(axes)
    return [Figure("mode-errors", made, "Errors of the coupled frequencies, and their estimates without the full model.", True)]


def add_modes(page, folder):
    for file, title in (("modes.csv", "Eigenfrequencies"), ("damped_modes.csv", "Damped modes")):
        if not (folder / file).is_file():
            continue
        rows = read_table(folder / file)
        if not rows:
            continue
        names = list(rows[0])
        units = {"full": " [Hz]", "coupled": " [Hz]", "full_im": " [Hz]", "coupled_im": " [Hz]"}
        cells = [[percent(row[name]) if name in ("error", "estimate") and isinstance(row[name], float) else plain(row[name], 6) for name in names] for row in rows]
        table = tables.table([name.replace("_", " ") + units.get(name, "") for name in names], cells, range(len(names)))
        figures = modes_figure(rows) if file == "modes.csv" else []
        if figures:
            page.plots(file.split(".")[0].replace("_", "-"), title, figures, table)
        else:
            page.add(file.split(".")[0].replace("_", "-"), title, table)


def state_name(row):
    """Weight, hole and tool face of a row of bha.csv."""
    face = "rotating" if row["mode"] == "rotating" else f"tool face {math.degrees(row['tool_face']):.0f} deg"
    return f"{row['weight_on_bit'] / 1e3:.0f} kN, {math.degrees(row['inclination']):.0f} deg, {face}"


def along_assembly(name, label, caption, states, value):
    """A line for each state; `value` of a row of bha_profile.csv."""
    made, axes = plots.figure(plots.WIDE, 2.8)
    for number, (state, own) in enumerate(states.items()):
        axes.plot(numbers(own, "from_bit"), [value(row) for row in own], color=COLOURS[number % len(COLOURS)], linewidth=1.2, label=state)
    axes.set_xlabel("distance from the bit [m]"), axes.set_ylabel(label)
    plots.legend_above(axes, 2, -0.25)
    return Figure(name, made, caption, True)


def add_bha(page, folder):
    """Forces and tilt at the bit, and the assembly in the hole under the largest weight."""
    if not ((folder / "bha.csv").is_file() and (folder / "bha_profile.csv").is_file()):
        return
    rows, states = read_table(folder / "bha.csv"), {}
    largest = max(numbers(rows, "weight_on_bit"))
    for row in read_table(folder / "bha_profile.csv"):
        if row["weight_on_bit"] == largest and row["inclination"] == rows[0]["inclination"]:
            states.setdefault(state_name(row), []).append(row)
    found = [along_assembly("bha-high", "to the high side [mm]", "Deflection of the assembly from the axis of the hole.", states, lambda row: 1e3 * row["deflection_high"]),
             along_assembly("bha-right", "to the right side [mm]", "The same to the right, looking down the hole.", states, lambda row: 1e3 * row["deflection_right"]),
             along_assembly("bha-moment", "bending moment [kN m]", "Bending moment.", states, lambda row: math.hypot(row["moment_high"], row["moment_right"]) / 1e3)]
    degree = 180 / math.pi
    table = tables.table(("state", "side force, high [kN]", "right [kN]", "tilt, high [deg]", "right [deg]", "largest moment [kN m]", "stress [MPa]"),
                         [(state_name(row), *(f"{row[name] * factor:.3f}" for name, factor in (("side_force_high", 1e-3), ("side_force_right", 1e-3), ("tilt_high", degree), ("tilt_right", degree),
                                                                                                ("largest_moment", 1e-3), ("largest_von_mises", 1e-6)))) for row in rows],
                         range(1, 7), "Side force of the bit on the rock, to the high side and to the right side of the hole")
    page.plots("bha", "Bottom-hole assembly", found, table)


def against_weight(name, label, caption, rows, lines, scale):
    """Columns of buckling.csv against the weight on bit; jumps are gaps."""
    made, axes = plots.figure(plots.WIDE, 2.8)
    for number, (column, legend) in enumerate(lines):
        for branch in sorted(set(numbers(rows, "branch"))):
            own = [row for row in rows if row["branch"] == branch]
            axes.plot([x / 1e3 for x in numbers(own, "weight_on_bit")], [scale * x for x in numbers(own, column)], color=COLOURS[number], linewidth=1.2,
                      linestyle="--" if number else "-", label=legend if branch == 0 else None)
    axes.set_xlabel("weight on bit [kN]"), axes.set_ylabel(label)
    plots.legend_above(axes, 2, -0.25)
    return Figure(name, made, caption, True)


def buckled_shape(rows):
    """The last state to both sides of the hole."""
    made, axes = plots.figure(plots.WIDE, 2.8)
    for number, (column, legend) in enumerate((("deflection_high", "to the high side"), ("deflection_right", "to the right side"))):
        axes.plot(numbers(rows, "depth"), [1e3 * x for x in numbers(rows, column)], color=COLOURS[number], linewidth=1.2, label=legend)
    axes.set_xlabel("depth [m]"), axes.set_ylabel("deflection [mm]")
    plots.legend_above(axes, 2, -0.25)
    return Figure("buckling-shape", made, "Deflection from the axis of the hole under the last weight on bit.", True)


def add_buckling(page, folder):
    """Load and displacement, contact beside that of a helix, and the last state."""
    if not ((folder / "buckling.csv").is_file() and (folder / "buckling_profile.csv").is_file()):
        return
    rows = read_table(folder / "buckling.csv")
    found = [against_weight("buckling-path", "displacement [mm]", "Displacement of the bit down the hole, and the share of bending in it, up the hole; gaps are jumps.", rows,
                            (("bit_advance", "bit"), ("shortening", "shortening by bending")), 1e3),
             against_weight("buckling-contact", "contact force [N/m]", "Contact force per length of the middle half of the compressed part, beside that of a helix, r F^2/(4 E I).", rows,
                            (("contact_force", "contact force"), ("helical_contact_force", "helix")), 1.0),
             buckled_shape(read_table(folder / "buckling_profile.csv"))]
    shown = rows[::max(1, len(rows) // BUCKLING_ROWS)]
    table = tables.table(("weight on bit [kN]", "bit [mm]", "largest contact force [kN]", "negative pivots", "half waves", "contact force [N/m]", "helix [N/m]", "jumps before"),
                         [tuple(f"{row[name] * factor:.{digits}f}" for name, factor, digits in (("weight_on_bit", 1e-3, 2), ("bit_advance", 1e3, 3), ("largest_contact_force", 1e-3, 3), ("negative_pivots", 1, 0),
                                                                                               ("half_waves", 1, 0), ("contact_force", 1, 1), ("helical_contact_force", 1, 1), ("branch", 1, 0))) for row in shown],
                         range(8), "States of the path; buckling.csv has all")
    page.plots("buckling", "Buckling", found, table)


def of_rotation(results, pictures):
    """Figures of functions of an open HDF5 file, name -> (function, caption)."""
    return [Figure(name, made, caption, True, large=True) for name, (function, caption) in pictures.items() if (made := function(results)) is not None]


def add_campbell(page, folder):
    """Campbell diagram, modes in the hole, critical speeds."""
    if not (folder / "campbell.h5").is_file():
        return
    with h5py.File(folder / "campbell.h5", "r") as results:
        found = of_rotation(results, {"campbell": (rotating.campbell_figure, "Damped modes against the rotary speed, lines of the excitations, critical speeds."),
                                      "campbell-shapes": (rotating.shapes_figure, "Modes in the hole: at critical speeds, and at one speed of the diagram.")})
        crossings = rotating.columns(results, "crossings")
        names = {(order, offset): name for name, order, offset in zip(rotating.texts(results["excitations"]), results["orders"][:], results["offsets"][:])}
    rows = [] if crossings is None else [(names[crossings["order"][i], crossings["offset"][i]], f"{crossings['mode'][i]:.0f}", f"{plots.RPM * crossings['speed'][i]:.2f}", f"{crossings['frequency'][i]:.4f}",
                                          f"{crossings['damping'][i]:.3g}", rotating.whirl_word(crossings["whirl"][i])) for i in range(len(crossings["order"]))]
    page.plots("campbell", "Campbell diagram", found, tables.table(("excitation", "mode", "speed [rpm]", "frequency [Hz]", "damping ratio", "whirl"), rows, range(1, 5), "Critical speeds") if rows else "")


def add_response(page, folder):
    """Amplitudes over speed or frequency, and along a string."""
    if not (folder / "response.h5").is_file():
        return
    with h5py.File(folder / "response.h5", "r") as results:
        found = of_rotation(results, {"response": (rotating.response_figure, "Amplitudes and phases; circles: largest amplitudes."),
                                      "response-profile": (rotating.profile_figure, "Bending moment beside that at rest, and distance left to the wall.")})
    page.plots("response", "Harmonic response", found)


def page_of(folder):
    """Of a folder that holds tables alone."""
    page = Page(folder.resolve().name, "tables of " + " and ".join(name for name, file in (("torque-drag", "torque_drag.csv"), ("bha", "bha.csv"), ("buckling", "buckling.csv"), ("campbell", "campbell.h5"), ("response", "response.h5"), ("modes", "modes.csv"), ("damped modes", "damped_modes.csv"))
                                                                if (folder / file).is_file()))
    add_torque_drag(page, folder)
    add_bha(page, folder)
    add_buckling(page, folder)
    add_campbell(page, folder)
    add_response(page, folder)
    add_modes(page, folder)
    return page
