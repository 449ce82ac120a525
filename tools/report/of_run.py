# SPDX-License-Identifier: BSD-3-Clause
"""The report of a run: a string in its well, or imported parts."""
from report import (checks, deck, figures, figures_measured, figures_parts, frame, modal, results,
                    scene3d, tables, torque_drag)
from report.page import Page, cards
from report.quantities import both, fixed, percent


def headline(run):
    """Cards with the main results."""
    found = []
    whole = "the whole motion" + ("" if run.time is None or len(run.time) == 0 else
                                  f", {results.span(run.time[0], run.time[-1])}")
    if run.is_string and run.value("static.hook_load") is not None:
        found.append(("Hook load", *both(run.value("static.hook_load"), "hook load"),
                      "at rest, without block", False))
        found.append(("Surface torque", *both(run.value("static.surface_torque"), "torque"),
                      "at rest, against the rotation", False))
        node = run.value("static.max_normal_force_node")
        if node:
            depth, feet = both(run.s[node - 1], "length")
            found.append(
                ("Largest side force", *both(run.value("static.max_normal_force"), "side force"),
                 f"at rest, at {depth} ({feet}), {run.component_at(node - 1) or f'node {node}'}",
                 False))
    speed = run.value("transient.bit_speed_rpm") or {}
    if speed.get("mean") is not None:
        found.append(("Bit speed", f"{fixed(speed['mean'], 1)} rpm",
                      f"{fixed(speed['min'], 1)} to {fixed(speed['max'], 1)} rpm",
                      f"mean and range of {whole}", False))
    for what, unit in (("displacement", "m"), ("rotation", "rad"), ("coordinate", "")):
        largest = run.value(f"transient.max_{what}")
        if largest is not None:
            found.append(
                (f"Largest {what}", f"{largest:.4g}", unit, f"of all nodes in {whole}", False))
    worst = checks.worst(run.summary)
    if worst:
        name, value, bound = worst
        found.append(("Worst check", "met" if value <= bound else "NOT MET", f"{value:.2g}",
                      f"{name}, bound {bound:g}", value > bound))
    energy = run.value("transient.energy_residual")
    if energy is not None:
        found.append(
            ("Energy balance",
             percent(energy), "", f"lost (> 0) or made (< 0) by the integration in {whole}",
             abs(energy) > checks.ENERGY))
    return cards(found) if found else ""


def conditions(run, scene):
    words = []
    if run.is_string:
        words.append(f"string of {run.s[-1]:.0f} m")
    elif "/model/part" in run.file:
        words.append(
            f"{len(run.file['/model/part_names'])} parts, {len(run.file['/model/part'])} nodes")
    said = deck.conditions(scene)
    if said:
        words.append(said)
    if run.value("transient.model"):
        basis = f" ({run.value('reduction.basis')})" if run.value(
            "transient.model") == "reduced" else ""
        words.append(f"{run.value('transient.model')} model{basis}, "
                     f"{run.value('transient.start'):g} to {run.value('transient.end'):g} s")
    elif "/static" in run.file:
        words.append("static state")
    return ", ".join(words)


def over_time(run):
    return [*figures.bit_speed(run), *figures.surface(run)]


def string_sections(page, run):
    with page.section(run.path):
        page.view(*scene3d.of_string(run))
        page.plots("well", "Well", figures.well(run))
    with page.section(run.path):
        page.plots("static", "Static state", figures.static_profiles(run),
                   after=torque_drag.invitation(run, frame.scene_of(run)))
    with page.section(run.folder / "torque_drag.csv"):
        torque_drag.add(page, run.folder)
    with page.section(run.path):
        motion_sections(page, run)


def motion_sections(page, run):
    if run.records:
        motion = results.Motion(run)
        chosen = results.chosen_nodes(run, motion.lateral_rms())
        motion = results.Motion(run, chosen)
        page.plots("motion", "Motion", [
            *over_time(run), *figures.contact(run, results.Contact(run)),
            *figures.vibration(run, motion)
        ], tables.pairs(results.merits(run, motion), results.times_of_merits(run, motion)))
        page.plots("orbits", "Orbits", figures.orbits(run, motion, chosen))
        page.plots("spectra", "Spectra", figures.spectra(run, motion, chosen))
    elif run.time is not None:
        page.plots("motion", "Motion", over_time(run),
                   tables.pairs(results.merits(run), results.times_of_merits(run)))


def part_sections(page, run):
    with page.section(run.path):
        data, note = scene3d.of_parts(run)
        if data is None:
            page.add("space", "In space", f'<p class="remark">{note}</p>')
        else:
            page.view(data, note)
    with page.section(run.path):
        page.plots("displacements", "Displacements", figures_parts.displacements(run))
        page.plots("motion", "Motion", [*figures_parts.movers(run), *figures_parts.forces(run)])
        page.plots("spectra", "Spectra", figures_parts.spectra(run))


def page_of(folder):
    run = results.Run(folder)
    page = Page(run.name, conditions(run, frame.scene_of(run)))
    frame.notes(page, run)
    page.add("figures", "Figures", headline(run))
    if run.is_string and "/static/displacement" in run.file:
        string_sections(page, run)
    elif "/model/part" in run.file:
        part_sections(page, run)
    with page.section(run.path):
        page.plots("measured", "Measured log", figures_measured.beside(run),
                   figures_measured.overview(run))
    vectors = ""
    with page.section(folder / "basis.csv"):
        vectors = modal.basis_table(folder)
    page.add("reduction", "Reduction and errors", tables.of_reduction(run) + vectors)
    measured = checks.measured(run.summary)
    page.add("checks", "Checks", tables.of_checks(measured) if measured else "")
    page.add("numerics", "Computation", tables.of_numerics(run))
    modal.add(page, folder)
    frame.close(page, run)
    return page
