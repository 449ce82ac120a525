# SPDX-License-Identifier: BSD-3-Clause
"""Tables of a page."""
from html import escape

from report.quantities import percent, plain

COUNTS = ("interior", "interface", "retained", "modes")  # dofs of a part in summary.json


def table(titles, rows, numbers=(), caption="", kind=""):
    """An HTML table; `numbers` are the columns that are aligned as numbers.
    Cells are texts. `kind`: "sortable" by a click on a title."""
    def cell(tag, column, text):
        aligned = ' class="number"' if column in numbers else ""
        return f"<{tag}{aligned}>{escape(str(text))}</{tag}>"

    head = "".join(cell("th", column, text) for column, text in enumerate(titles))
    body = "".join("<tr>" + "".join(cell("td", column, text)
                                    for column, text in enumerate(row)) + "</tr>" for row in rows)
    above = f"<caption>{escape(caption)}</caption>" if caption else ""
    style = f' class="{kind}"' if kind else ""
    return (f'<div class="scroll"><table{style}>{above}<thead><tr>{head}</tr></thead>'
            f'<tbody>{body}</tbody></table></div>')


def pairs(rows, caption=""):
    """A table of names and values, with optional remarks."""
    if not rows:
        return ""
    above = f"<caption>{escape(caption)}</caption>" if caption else ""
    body = "".join(f"<tr><th>{escape(str(name))}</th><td>{escape(str(value))}</td><td "
                   f"class=\"remark\">{escape(str(remark))}</td></tr>"
                   for name, value, remark in rows)
    return f'<div class="scroll"><table class="pairs">{above}<tbody>{body}</tbody></table></div>'


def of_deck(rows):
    """The deck: lists as headings, parameters below them."""
    lines = []
    for depth, name, value in rows:
        if value is None:
            lines.append('<tr class="list"><th colspan="2" '
                         f'style="padding-left:{depth + 0.4:.1f}em">{escape(name)}</th></tr>')
        else:
            lines.append(f'<tr><td style="padding-left:{depth + 0.4:.1f}em">{escape(name)}</td>'
                         f'<td>{escape(value)}</td></tr>')
    return f'<div class="scroll"><table class="deck"><tbody>{"".join(lines)}</tbody></table></div>'


def of_checks(checks):
    return table(("check", "value", "bound", ""),
                 [(name, f"{value:.1e}", f"{bound:.0e}", "met" if value <= bound else "NOT MET")
                  for name, value, bound in checks], (1, 2))


def of_reduction(run):
    """The parts of a reduction, the sizes of their bases, and estimated errors; "" for a full
    model."""
    reduction = run.summary.get("reduction") or {}
    parts = reduction.get("substructures") or []
    if not parts:
        return ""
    text = pairs([
        ("Basis", reduction.get("basis") or "-", ""),
        ("Dofs of the reduced model", plain(reduction.get("reduced_dofs")),
         f"of {plain(run.value('model.free_dofs'))}"),
        ("Predicted cost of a step", percent(reduction.get("cost_ratio")),
         "of a step of the full model"),
        ("Start not in the basis", percent(reduction.get("start_misfit")), "of its energy"),
    ] + [(name, percent(value), what) for name, value, what in (
        ("Estimated error of frequencies", run.value("reduction.estimate.frequency_error"),
         "largest, without the full model"),
        ("Estimated vibration error", run.value("reduction.estimate.motion_error"),
         "of the reduction alone"),
    ) if value is not None])
    text += table(("part", "interior", "interface", "retained", "modes", "cut-off [Hz]"),
                  [[part["name"], *(plain(part[key]) for key in COUNTS), part["cut-off"]]
                   for part in grouped(parts)], (1, 2, 3, 4, 5),
                  "Parts and their dofs; neighbours of equal dofs stand in one row")
    frequencies = run.value("reduction.estimate.frequencies") or []
    if frequencies:
        text += table(("frequency [Hz]", "estimated error", "part that contributes most"),
                      [(plain(f["hz"], 5), percent(f["error"]) +
                        ("" if f["complete"] else " at least"), f.get("part") or "-")
                       for f in frequencies[:20]], (0, 1),
                      "Estimated errors of the coupled frequencies")
    return text


def grouped(parts):
    """Rows of parts; adjacent parts with equal numbers of dofs share a row."""
    groups = []
    for part in parts:
        if groups and all(groups[-1][-1][key] == part[key] for key in COUNTS):
            groups[-1].append(part)
        else:
            groups.append([part])
    rows = []
    for group in groups:
        cut_offs = [part["cutoff_hz"] for part in group if part["cutoff_hz"] is not None]
        span = plain(cut_offs[0]) if len(set(
            cut_offs)) == 1 else f"{min(cut_offs):.4g} to {max(cut_offs):.4g}" if cut_offs else "-"
        name = group[0]["name"] if len(
            group) == 1 else f"{group[0]['name']} to {group[-1]['name']} ({len(group)})"
        rows.append({**group[0], "name": name, "cut-off": span})
    return rows


def of_numerics(run):
    """Computational data of the run."""
    t = run.summary.get("transient") or {}
    rows = [
        ("Program", f"{run.value('program.version')} ({run.value('program.git')})", ""),
        ("Deck", run.value("deck.file") or "-", f"SHA-256 {str(run.value('deck.sha256'))[:16]}"),
        ("Date", run.attribute("date"), ""),
        ("Ranks", plain(run.value("ranks")), ""),
        ("Model", f"{plain(run.value('model.nodes'))} nodes, {plain(run.value('model.free_dofs'))} "
         "free dofs", ""),
        ("Wall time", f"{plain(run.value('wall_s'), 3)} s", ""
         if run.value("peak_memory_mb") is None else f"{plain(run.value('peak_memory_mb'), 3)} MB"),
    ]
    if t.get("integrator"):
        rows += [
            ("Integrator", t["integrator"], f"{t['model']} model"),
            ("Motion", f"{plain(t['start'])} to {plain(t['end'])} s",
             f"{plain(t['steps'])} steps of "
             f"{' to '.join(dict.fromkeys(plain(t[key], 3) for key in ('min_step', 'max_step')))} "
             "s"),
            ("CPU time of the motion", f"{plain(t['cpu_s'], 3)} s",
             f"real-time factor {plain(t['real_time_factor'], 3)}"),
            ("Rejected, halved, unconverged steps",
             ", ".join(plain(t[key]) for key in ("rejected", "halved", "unconverged_steps")), ""),
            ("Step error", percent(t.get("step_error")),
             "estimated vibration error of equal steps"),
            ("Energy balance", percent(t.get("energy_residual")),
             "lost (> 0) or made (< 0) by the integration"),
        ]
    return pairs(rows)
