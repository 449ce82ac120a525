# SPDX-License-Identifier: BSD-3-Clause
"""The report of a study: its plots, its rows and the reliability of its reference."""
import plot_study
from report import deck, files, results, tables
from report.figures import Figure
from report.page import Page, cards
from report.quantities import percent, plain

CAPTIONS = {
    "speed": "Speed against error of all runs: down and left is better.",
    "bases": "Errors of the bases against their size.",
    "modes": "Vibration error against the number of modes.",
    "error_over_time": "Error over time inside the window.",
    "bit_speed": "Bit speed of the reference and of methods.",
    "statistics": "Statistics beyond the window.",
    "static": "The state at rest that every run starts from.",
    "reference": "How far the reference can be trusted.",
}


def headline(summary):
    rows = [
        row for row in summary.get("study") or [] if row["kind"] == "method"
        and row["status"] == "done" and row["vibration_error"] is not None
    ]
    found = []
    full, reduced = ([
        row for row in rows if row["model"] == model and row["vibration_error"] <= 0.01
    ] for model in ("full", "reduced"))
    for name, own in (
        ("Fastest full run within 1 %", full),
        ("Fastest reduced run within 1 %", reduced),
    ):
        if own:
            best = min(own, key=lambda row: row["cpu_per_simulated_s"])
            found.append(
                (name, f"{best['cpu_per_simulated_s']:.3g} s", "CPU time per simulated second",
                 f"{best['label']}, vibration error {percent(best['vibration_error'])}", False))
    own = (summary.get("reference") or {}).get("self_error") or {}
    if own.get("vibration_error") is not None:
        found.append(("Error of the reference", percent(own["vibration_error"]), "",
                      "distance to its check", False))
    return cards(found) if found else ""


def draw_all(study):
    found = []
    for name, draw in plot_study.PLOTS.items():
        made = draw(study)
        if made is not None:
            found.append(Figure(f"study-{name.replace('_', '-')}", made, CAPTIONS[name],
                                large=True))
    return found


def page_of(folder):
    summary = results.read_summary(folder)
    for name in ("study.csv", "study.h5"):
        if not (folder / name).is_file():
            raise files.Unreadable(f"{folder} holds no {name}: the study did not end. Run it "
                                   "again; it goes on from the runs it has.")
    with files.reading(folder / "study.csv"):
        study = plot_study.Study(folder)
    page = Page(f"Study: {study.attribute('deck_name', folder.name)}",
                f"{len(study.done)} runs done, {len(study.failed)} failed, on {study.machine()}")
    if summary.get("status") != "finished":
        page.note(f"This study is {summary.get('status')}: {summary.get('message')}")
    for warning in summary.get("warnings") or []:
        page.note(warning)
    for sentence in summary.get("step_limits") or []:
        page.note(sentence[:1].upper() + sentence[1:])
    for run in study.failed:
        page.note(f"{run.label} failed: {run.row.get('reason', '')}")
    if not page.notes:
        page.note("No warnings; no run failed.", good=True)
    page.add("figures", "Figures", headline(summary))
    page.plots("plots", "Plots", draw_all(study))
    page.add("rows", "Runs", rows_of(study))
    scene = deck.read(study.attribute("deck_text", ""), study.attribute("overrides", ""))
    rows = list(deck.rows(scene))
    page.add("deck", "Deck", tables.of_deck(rows) if rows else "")
    page.footer = (f"Written by tooljoint report from {folder}: program "
                   f"{study.attribute('program_version', '')} ({study.attribute('git_hash', '')}), "
                   f"{study.attribute('date', '')}.")
    return page


def rows_of(study):
    def cell(run, name, digits=3):
        value = run.number(name)
        return plain(value, digits)

    return tables.table(
        ("run", "model", "dofs", "step [s] or tolerance", "CPU s per simulated s",
         "vibration error", "eps_t max", "eps_n max", "energy balance", "status"),
        [(run.label, run.row["model"], run.row["reduced_dofs"] or "-", cell(
            run, "step_or_tolerance"), cell(
                run, "cpu_per_simulated_s"), percent(run.number("vibration_error")),
          percent(run.number("eps_t_max")), percent(
              run.number("eps_n_max")), percent(run.number("energy_residual")), run.row["status"])
         for run in study.all], range(2, 9))
