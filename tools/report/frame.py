# SPDX-License-Identifier: BSD-3-Clause
"""Common parts of every page: notes before the sections, the deck and the origin of the page after
them."""
from report import checks, deck, tables

ENDS = {"failed": "failed", "interrupted": "was interrupted"}


def notes(page, results, what="run"):
    """The most important notes for a reader; empty for a folder without a summary."""
    if not results.summary:
        return
    status = results.value("status")
    if status != "finished":
        page.note(f"The {what} {ENDS.get(status, 'did not finish')}: "
                  f"{results.value('message') or 'its results are incomplete.'}")
    measured = checks.measured(results.summary)
    for name, value, bound in measured:
        if value > bound:
            page.note(f"Not met: {name} is {value:.1e}, its bound {bound:.0e}.")
    for warning in results.value("warnings") or []:
        page.note(warning)
    if not page.notes:
        page.note("No warnings; all checks are met." if measured else "No warnings.", good=True)


def scene_of(results):
    """The deck of the run, with its overrides."""
    return deck.read(results.attribute("deck_text"), results.attribute("overrides"))


def close(page, results):
    """Adds deck and origin of a page."""
    rows = list(deck.rows(scene_of(results)))
    page.add(
        "deck", "Deck", f"<details open><summary>{len(rows)} lines, with the overrides of the "
        f"command line</summary>{tables.of_deck(rows)}</details>" if rows else "")
    origin = (f"program {results.attribute('program_version')} ({results.attribute('git_hash')}), "
              f"results of {results.attribute('date')}, deck SHA-256 "
              f"{results.attribute('deck_sha256')}"
              if results.file is not None else "tables alone, without a summary and a deck")
    page.footer = f"Written by tooljoint report from {results.folder}: {origin}."
