# SPDX-License-Identifier: BSD-3-Clause
"""Reports of analyses: torque-drag, bha, buckling, campbell, response, modes."""
import math
import os

import plots
from plots import COLOURS, rotating
from report import deck, frame, modal, results, tables, torque_drag
from report.figures import Figure
from report.files import numbers, read_table
from report.page import Page, cards
from report.quantities import POUND, both, fixed, percent

ROUNDING = 1e-6  # [mm], [kN m]: smaller values along an assembly are zero
BUCKLING_ROWS = 40  # rows on a page; buckling.csv has all
MOST_PEAKS = 4  # among the headline figures of a response


def state_name(row):
    """Weight, hole and tool face of a row of bha.csv, and whether the string is buckled."""
    face = "rotating" if row[
        "mode"] == "rotating" else f"tool face {math.degrees(row['tool_face']):.0f} deg"
    return (f"{row['weight_on_bit'] / 1e3:.0f} kN ({1e-3 * row['weight_on_bit'] / POUND:.0f} "
            f"klbf), {math.degrees(row['inclination']):.0f} deg, "
            f"{face}{', UNSTABLE' if unstable(row) else ''}")


def along_assembly(name, label, caption, states, value):
    """A line for each state; `value` is a function of a row of bha_profile.csv."""
    made, axes = plots.figure(plots.WIDE, 2.4)
    for number, (state, own) in enumerate(states.items()):
        axes.plot(numbers(own, "from_bit"), [value(row) for row in own],
                  color=COLOURS[number % len(COLOURS)], linewidth=1.2, label=state)
    if max(map(abs, axes.dataLim.intervaly)) < ROUNDING:
        axes.set_ylim(-1, 1)
    axes.set_xlabel("distance from the bit [m]"), axes.set_ylabel(label)
    plots.legend_above(axes, 2, -0.25)
    return Figure(name, made, caption, True)


def without_common(states):
    """The common start of the names of all states, for a caption, and the states with shortened
    names."""
    names = [name.split(", ") for name in states]
    count = len(os.path.commonprefix([parts[:-1] for parts in names])) if len(names) > 1 else 0
    common = ", ".join(names[0][:count]) if count else ""
    return f", {common}" if common else "", {
        ", ".join(parts[count:]): own for parts, own in zip(names, states.values())
    }


def unstable(row):
    return row.get("stable") == 0  # a number in bha.csv, a boolean in the summary


def bha_headline(results):
    """Cards of the state with the largest stable weight on bit, and the number of unstable
    states."""
    rows = results.value("bha.rows") or []
    found = []
    lost = sum(map(unstable, rows))
    if rows:
        row = max(rows, key=lambda row: (not unstable(row), row["weight_on_bit"]))
        state = state_name(row)
        found = [
            ("Side force, high side", *both(row["side_force_high"], "side force"), state, False),
            ("Side force, right side", *both(row["side_force_right"], "side force"), state, False),
        ]
        if row["sag_high"] is not None:
            found.append(
                ("Sag of the survey tool", f"{fixed(math.degrees(row['sag_high']), 3)} deg",
                 "to the high side",
                 f"{fixed(math.degrees(row['sag_right']), 3)} deg to the right; {state}", False))
        if row["tangency"] is not None:
            found.append(
                ("Tangency", *both(row["tangency"], "length"), f"from the bit; {state}", False))
        found += [
            ("Largest bending moment", *both(row["largest_moment"], "torque"),
             f"at {row['largest_moment_from_bit']:.1f} m from the bit; {state}", False),
            ("Unstable states", str(lost), f"of {len(rows)}",
             "the string buckles under that weight" if lost else "", lost > 0),
        ]
    return cards(found) if found else ""


def add_bha(page, folder):
    """Forces and tilt at the bit, and the assembly in the hole under the largest weight."""
    if not ((folder / "bha.csv").is_file() and (folder / "bha_profile.csv").is_file()):
        return
    rows, states = read_table(folder / "bha.csv"), {}
    names = {(row["weight_on_bit"], row["inclination"], row["mode"], row["tool_face"]):
             state_name(row) for row in rows}
    stable = [row["weight_on_bit"] for row in rows if not unstable(row)]
    largest = max(stable or numbers(rows, "weight_on_bit"))
    for row in read_table(folder / "bha_profile.csv"):
        if row["weight_on_bit"] >= largest and row["inclination"] == rows[0]["inclination"]:
            states.setdefault(
                names[row["weight_on_bit"], row["inclination"], row["mode"], row["tool_face"]],
                []).append(row)
    common, states = without_common(states)
    found = [
        along_assembly("bha-high", "to the high side [mm]",
                       f"Deflection of the assembly from the axis of the hole{common}.", states,
                       lambda row: 1e3 * row["deflection_high"]),
        along_assembly("bha-right", "to the right side [mm]",
                       "The same to the right, looking down the hole.", states,
                       lambda row: 1e3 * row["deflection_right"]),
        along_assembly("bha-moment", "bending moment [kN m]", "Bending moment.", states,
                       lambda row: math.hypot(row["moment_high"], row["moment_right"]) / 1e3)
    ]
    degree = 180 / math.pi
    shown = (
        ("side force, high [kN]", "side_force_high", 1e-3, 3),
        ("[lbf]", "side_force_high", 1 / POUND, 0),
        ("right [kN]", "side_force_right", 1e-3, 3),
        ("[lbf]", "side_force_right", 1 / POUND, 0),
        ("tilt, high [deg]", "tilt_high", degree, 3),
        ("right [deg]", "tilt_right", degree, 3),
        ("sag [deg]", "sag_high", degree, 3),
        ("tangency [m]", "tangency", 1.0, 1),
        ("largest moment [kN m]", "largest_moment", 1e-3, 3),
        ("stress [MPa]", "largest_von_mises", 1e-6, 1),
    )
    table = tables.table(
        ("state", *(title for title, *_ in shown)),
        [(state_name(row),
          *(fixed(row[name] * factor, decimals) if isinstance(row.get(name), float) else "-"
            for _, name, factor, decimals in shown))
         for row in rows], range(1,
                                 len(shown) + 1), "Side force of the bit on the rock, to the high "
        "side and to the right side of the hole; tangency and sag as far from the "
        "bit as they are computed")
    page.plots("bha", "Bottom-hole assembly", found, after=table)


def against_weight(name, label, caption, rows, lines, scale):
    """Columns of buckling.csv against the weight on bit, with gaps at jumps."""
    made, axes = plots.figure(plots.WIDE, 2.4)
    for number, (column, legend) in enumerate(lines):
        for branch in sorted(set(numbers(rows, "branch"))):
            own = [row for row in rows if row["branch"] == branch]
            axes.plot([x / 1e3 for x in numbers(own, "weight_on_bit")],
                      [scale * x for x in numbers(own, column)], color=COLOURS[number],
                      linewidth=1.2, linestyle="--" if number else "-",
                      label=legend if branch == 0 else None)
    axes.set_xlabel("weight on bit [kN]"), axes.set_ylabel(label)
    plots.legend_above(axes, 2, -0.25)
    return Figure(name, made, caption, True)


def buckled_shape(rows):
    """The last state in both lateral directions of the hole."""
    made, axes = plots.figure(plots.WIDE, 2.4)
    for number, (column, legend) in enumerate(
        (("deflection_high", "to the high side"), ("deflection_right", "to the right side"))):
        axes.plot(numbers(rows, "depth"), [1e3 * x for x in numbers(rows, column)],
                  color=COLOURS[number], linewidth=1.2, label=legend)
    axes.set_xlabel("depth [m]"), axes.set_ylabel("deflection [mm]")
    plots.legend_above(axes, 2, -0.25)
    return Figure("buckling-shape", made,
                  "Deflection from the axis of the hole under the last weight on bit.", True)


def add_buckling(page, folder):
    """Load against displacement, contact compared with that of a helix, and the last state."""
    if not ((folder / "buckling.csv").is_file() and (folder / "buckling_profile.csv").is_file()):
        return
    rows = read_table(folder / "buckling.csv")
    found = [
        against_weight(
            "buckling-path", "displacement [mm]", "Displacement of the bit down the hole, and the "
            "share of bending in it, up the hole; gaps are jumps.", rows,
            (("bit_advance", "bit"), ("shortening", "shortening by bending")), 1e3),
        against_weight(
            "buckling-contact", "contact force [N/m]", "Contact force per length of the middle "
            "half of the compressed part, beside that of a helix, r F^2/(4 E I).", rows,
            (("contact_force", "contact force"), ("helical_contact_force", "helix")), 1.0),
        buckled_shape(read_table(folder / "buckling_profile.csv"))
    ]
    shown = rows[::max(1, len(rows) // BUCKLING_ROWS)]
    table = tables.table(
        ("weight on bit [kN]", "bit [mm]", "largest contact force [kN]", "negative pivots",
         "half waves", "contact force [N/m]", "helix [N/m]", "jumps before"), [
             tuple(f"{row[name] * factor:.{digits}f}"
                   for name, factor, digits in (("weight_on_bit", 1e-3, 2), ("bit_advance", 1e3, 3),
                                                ("largest_contact_force", 1e-3, 3),
                                                ("negative_pivots", 1, 0), ("half_waves", 1, 0),
                                                ("contact_force", 1, 1),
                                                ("helical_contact_force", 1, 1), ("branch", 1, 0)))
             for row in shown
         ], range(8), "States of the path; buckling.csv has all")
    page.plots("buckling", "Buckling", found, after=table)


def buckling_headline(results):
    """Cards with the weights on bit of the buckling events."""
    found = [(name, *both(weight, "hook load"), remark, False) for name, weight, remark in (
        ("Last weight on bit", results.value("buckling.last_weight_on_bit"),
         results.value("buckling.explanation") or ""),
        ("Limit of the straight string", results.value("buckling.limit"),
         "first negative pivot, or half waves"),
        ("Sinusoidal buckling", results.value("buckling.theory.sinusoidal"), "closed form"),
        ("Helical buckling", results.value("buckling.theory.helical"), "closed form"),
        ("Unstable from", results.value("buckling.unstable_from"),
         "first unstable state of the crooked string"),
    ) if weight is not None]
    return cards(found) if found else ""


def of_rotation(results, pictures):
    """Figures made by functions of an open HDF5 file, name -> (function, caption)."""
    return [
        Figure(name, made, caption, True, large=True)
        for name, (function, caption) in pictures.items() if (made := function(results)) is not None
    ]


def rotation_error(results, analysis):
    """A card with the largest error of a reduced model, if there is one."""
    error = results.value(f"{analysis}.largest_error")
    return [] if error is None else [("Largest error", percent(error), "",
                                      "of the reduced model, by spot checks", False)]


def campbell_headline(results):
    """Cards with critical speeds and damping."""
    crossings = results.value("campbell.crossings") or []
    found = [("Critical speeds", str(len(crossings)), "", "crossings with lines of excitations",
              False)]
    once = sorted(one["speed_rpm"] for one in crossings if one["order"] == 1)
    if once:
        found.append(("Lowest at the rotary speed", f"{fixed(once[0], 1)} rpm",
                      f"highest {fixed(once[-1], 1)} rpm", "of the excitation of order 1", False))
    least = results.value("campbell.least_damping")
    if least is not None:
        grows = least < -rotating.ROUNDING
        found.append(("Least damping ratio", f"{least:.2g}", "",
                      "modes grow where it is negative" if grows else "no mode grows", grows))
    return cards(found + rotation_error(results, "campbell"))


def add_campbell(page, folder):
    """Campbell diagram, modes in the hole, critical speeds."""
    if not (folder / "campbell.h5").is_file():
        return
    with results.open_results(folder / "campbell.h5") as results_:
        grow = "; crosses: modes that grow" if "campbell" in results_ and (
            results_["campbell/damping"][:] < -rotating.ROUNDING).any() else ""
        found = of_rotation(
            results_, {
                "campbell": (rotating.campbell_figure, "Damped modes against the rotary speed, "
                             f"lines of the excitations, critical speeds{grow}."),
                "campbell-shapes": (
                    rotating.shapes_figure,
                    "Modes in the hole: at critical speeds, and at one speed of the diagram."),
            })
        crossings = rotating.columns(results_, "crossings")
        names = {(order, offset): name for name, order, offset in zip(
            rotating.texts(results_["excitations"]), results_["orders"][:], results_["offsets"][:])}
    rows = [] if crossings is None else [
        (names[crossings["order"][i], crossings["offset"][i]], f"{crossings['mode'][i]:.0f}",
         fixed(plots.RPM * crossings["speed"][i], 2), fixed(crossings["frequency"][i], 4),
         fixed(crossings["damping"][i], 4) +
         (" UNSTABLE" if crossings["damping"][i] < -rotating.ROUNDING else ""),
         rotating.whirl_word(crossings["whirl"][i])) for i in range(len(crossings["order"]))
    ]
    table = tables.table(("excitation", "mode", "speed [rpm]", "frequency [Hz]", "damping ratio",
                          "whirl"), rows, range(1, 5)) if rows else ""
    page.plots(
        "campbell", "Campbell diagram", found,
        after=f"<details open><summary>{len(rows)} critical speeds</summary>{table}</details>"
        if rows else "")


def response_headline(results):
    """Cards with the largest amplitudes."""
    largest = {}
    for peak in results.value("response.peaks") or []:
        if peak["amplitude"] > largest.get(peak["output"],
                                           peak)["amplitude"] or peak["output"] not in largest:
            largest[peak["output"]] = peak
    several = len({peak["load"] for peak in results.value("response.peaks") or []}) > 1
    found = [(f"Largest amplitude, {output}", f"{peak['amplitude']:.3g} {peak['unit']}",
              f"{peak['hz']:.4g} Hz",
              f"at {fixed(peak['speed_rpm'], 1)} rpm{', load ' + peak['load'] if several else ''}",
              False) for output, peak in list(largest.items())[:MOST_PEAKS]]
    moment = results.value("response.bending_moment")
    if moment is not None:
        found.append(("Bending moment", *both(moment, "torque"), "beside that at rest, at "
                      f"{both(results.value('response.bending_depth'), 'length')[0]} and "
                      f"{fixed(results.value('response.bending_speed_rpm'), 1)} rpm", False))
    touch = results.value("response.contact_speed_rpm")
    if touch is not None:
        found.append(("Wall reached", f"{fixed(touch, 1)} rpm",
                      f"{results.value('response.contact_hz'):.4g} Hz",
                      f"node {results.value('response.contact_node')}, open at rest", True))
    found += rotation_error(results, "response")
    return cards(found) if found else ""


def add_response(page, folder):
    """Amplitudes over speed or frequency, and along a string."""
    if not (folder / "response.h5").is_file():
        return
    with results.open_results(folder / "response.h5") as results_:
        found = of_rotation(
            results_, {
                "response": (rotating.response_figure,
                             "Amplitudes and phases; circles: largest amplitudes."),
                "response-profile": (
                    rotating.profile_figure,
                    "Bending moment beside that at rest, and distance left to the wall."),
            })
    page.plots("response", "Harmonic response", found)


# name, its files (one must exist), title, headline figures, sections
ANALYSES = (
    ("torque_drag", ("torque_drag.csv",), "Torque and drag", torque_drag.headline, torque_drag.add),
    ("bha", ("bha.csv",), "Bottom-hole assembly", bha_headline, add_bha),
    ("buckling", ("buckling.csv",), "Buckling", buckling_headline, add_buckling),
    ("campbell", ("campbell.h5",), "Campbell diagram", campbell_headline, add_campbell),
    ("response", ("response.h5",), "Harmonic response", response_headline, add_response),
    ("modes", ("modes.csv", "damped_modes.csv"), "Modes", modal.headline, modal.add),
)


def conditions(found, scene, names):
    """The string and the conditions of the case from the deck."""
    length = found.value("model.length")
    said = deck.conditions(
        scene, more=deck.OF_ANALYSES + ((deck.BLOCK,) if "torque_drag" in names else ()))
    return ", ".join(filter(None, (f"string of {length:.0f} m" if length else "", said)))


def page_of(folder):
    """The page of a folder with results of analyses only."""
    present = [one for one in ANALYSES if any((folder / file).is_file() for file in one[1])]
    page = Page(" and ".join(title for _, _, title, _, _ in present))
    summary, file = {}, None
    with page.section(folder / "summary.json"):
        summary = results.read_summary(folder) if (folder / "summary.json").is_file() else {}
    for path in [folder / f"{name}.h5" for name, *_ in present]:
        if file is None and path.is_file():
            with page.section(path):
                file = results.open_results(path)
    found = results.Folder(folder, summary, file)
    page.title += f": {found.name}"
    page.conditions = conditions(found, frame.scene_of(found), [name for name, *_ in present])
    frame.notes(page, found, "analysis")
    headlines = []
    for _, _, _, headline, _ in present:
        with page.section(folder / "summary.json"):
            headlines.append(headline(found))
    page.add("figures", "Figures", "".join(headlines))
    for _, files, _, _, add in present:
        with page.section(folder / files[0]):
            add(page, folder)
    page.add("numerics", "Computation", tables.of_numerics(found) if found.summary else "")
    frame.close(page, found)
    return page
