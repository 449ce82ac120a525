# SPDX-License-Identifier: BSD-3-Clause
"""The report of a map: its pictures, its best and worst points, and all points as a table."""
import pathlib

import numpy as np

import plot_map
import plots
from report import deck, results, tables
from report.figures import Figure
from report.page import Page, cards
from report.quantities import plain

MOST_PICTURES = 24  # on a page; the folder of the map has all
MOST_NAMED = 12  # longer axes are shown by their ends
MOST_ROWS = 2000  # of the table on a page; map.csv has all


def limit(value):
    """"unsafe above 6.5" for a value; "" without a limit."""
    words = [
        f"{side} {value[f'unsafe_{side}']:g}" for side in ("below", "above")
        if value[f"unsafe_{side}"] is not None
    ]
    return "unsafe " + " and ".join(words) if words else ""


def counted(value):
    """A limit and the number of unsafe points."""
    return f"{limit(value)}: {value['unsafe']} of {value['known']} points" if limit(value) else ""


def point(made, row):
    """"speed 60 rpm, weight on bit 5 kN" for a row of the table."""
    return ", ".join(" ".join(
        filter(None, (axis["name"], pathlib.PurePath(row[axis["name"]]).name, axis["unit"])))
                     for axis in made.axes)


def extremes(value, grid):
    """(word, row of the table) of the best and the worst point of a value. A limit on one side
    defines which is which; without one they are the smallest and the largest. Empty if no point has
    the value."""
    if not np.isfinite(grid).any():
        return []
    least, largest = int(np.nanargmin(grid)), int(np.nanargmax(grid))
    above, below = value["unsafe_above"] is not None, value["unsafe_below"] is not None
    if above == below:
        return [("least", least), ("largest", largest)]
    return [("best", least), ("worst", largest)] if above else [("best", largest), ("worst", least)]


def safe(made):
    """Points whose values are known and within their limits; None for a map without limits."""
    limited = [value for value in made.values if limit(value)]
    if not limited:
        return None
    return np.all([
        np.isfinite(made.grid[value["name"]]) & ~plot_map.unsafe(value, made.grid[value["name"]])
        for value in limited
    ], axis=0)


def headline(made, summary):
    """Cards with the best and worst points, the safe points and the time."""
    total = len(made.rows)
    found = [("Points done", str(summary["done"]), f"of {total}", f"{summary['failed']} failed",
              summary["failed"] > 0)]
    harmless = safe(made)
    if harmless is not None:
        found.append(("Safe points", str(np.count_nonzero(harmless)), f"of {total}",
                      "every value with a limit is known and safe", not harmless.any()))
    for value in made.values:
        grid = made.grid[value["name"]]
        ends = extremes(value, grid)
        if not ends:
            found.append((value["name"], "-", "", "no point has this value", True))
        for word, row in ends:
            bad = bool(plot_map.unsafe(value, grid).flat[row])
            found.append((f"{value['name']}, {word}",
                          f"{plain(grid.flat[row])} {value.get('unit') or ''}".strip(),
                          point(made, made.rows[row]), limit(value), bad))
    found.append(
        ("Time per point", f"{summary['wall_per_point_s']:.3g} s",
         f"CPU time {summary['cpu_per_point_s']:.3g} s", "mean of the points that ended", False))
    return cards(found)


def places(texts):
    """Points of an axis; only the ends of a long axis."""
    names = [pathlib.PurePath(text).name for text in texts]
    return ", ".join(names) if len(
        names) <= MOST_NAMED else f"{len(names)} points: {', '.join(names[:3])}, ..., {names[-1]}"


def grid_tables(made):
    """Tables of the varied parameters and of the mapped values."""
    axes = [(axis["name"], axis["parameter"], axis["unit"] or "-", places(axis["texts"]))
            for axis in made.axes]
    values = [(value["name"], value["key"], value.get("unit") or "-", limit(value)
               or "-", plain(value["min"]), plain(value["max"]), value["known"],
               value["unsafe"] if limit(value) else "-") for value in made.values]
    return (tables.table(("axis", "parameter of the deck", "unit", "points"), axes) + tables.table(
        ("value", "key of summary.json", "unit", "limit", "least", "largest", "known", "unsafe"),
        values, range(4, 8)))


def caption(made, value, rest):
    where = ", ".join(f"{axis['name']} {axis['texts'][i]} {axis['unit']}".strip()
                      for axis, i in zip(made.axes[2:], rest))
    first = f"{value['name']} ({value['key']})" + (f" at {where}" if where else "")
    return "; ".join(
        filter(None, (first, counted(value) +
                      (" of the whole map" if where and limit(value) else "")))) + "."


def draw_all(made):
    """The pictures of the page."""
    found = []
    for value, rest, name in made.pictures():
        if len(found) == MOST_PICTURES:
            break
        found.append(
            Figure(name.replace("_", "-"), plot_map.draw(made, value, rest),
                   caption(made, value, rest), True))
    return found


def reason(row):
    """The first sentence of the reason why a point failed; map.csv has all of it."""
    first, dot, _ = row["reason"].partition(". ")
    return first + dot.strip()


def points_table(made):
    """One row per point, with the values that are unsafe there."""
    beyond = {
        value["name"]: plot_map.unsafe(value, made.grid[value["name"]]).ravel()
        for value in made.values
    }
    some_failed = any(row["reason"] for row in made.rows)
    names = [axis["name"] for axis in made.axes]
    rows = []
    for i, row in enumerate(made.rows[:MOST_ROWS]):
        values = [
            plain(float(row[value["name"]])) if row[value["name"]] else "-" for value in made.values
        ]
        unsafe = ", ".join(name for name, cells in beyond.items() if cells[i])
        rows.append([
            row["point"], *(pathlib.PurePath(row[name]).name for name in names), *values, unsafe,
            row["status"], *(plain(float(row[name]), 3) for name in ("cpu", "wall")),
            *([reason(row)] if some_failed else [])
        ])
    numeric = [1 + k for k, axis in enumerate(made.axes) if axis["numeric"]]
    after = 1 + len(names) + len(made.values)
    columns = {0, *numeric, *range(1 + len(names), after), after + 2, after + 3}
    titles = ("point", *(axis["label"] for axis in made.axes),
              *(plots.label(value["name"],
                            value.get("unit") or "") for value in made.values), "unsafe", "status",
              "CPU [s]", "wall [s]", *(["reason"] if some_failed else []))
    more = f"The first {MOST_ROWS} of {len(made.rows)} points; map.csv has all. " if len(
        made.rows) > MOST_ROWS else ""
    return tables.table(titles, rows, columns, f"{more}A click on a title sorts the table",
                        "sortable")


def computation(summary, attributes):
    return tables.pairs([
        ("Program", f"{attributes.get('program_version', '')} ({attributes.get('git_hash', '')})",
         ""),
        ("Deck", summary["deck"]["file"], f"SHA-256 {str(summary['deck']['sha256'])[:16]}"),
        ("Date", attributes.get("date", ""), ""),
        ("Ranks", plain(summary["ranks"]), ""),
        ("Wall time", f"{plain(summary['wall_s'], 3)} s",
         "of the last command; points that were known from before took none of it"),
    ])


def attributes_of(folder):
    """Attributes of map.h5 as texts."""
    with results.open_results(folder / "map.h5") as file:
        return {
            name: value.decode() if isinstance(value, bytes) else value
            for name, value in file.attrs.items()
        }


def page_of(folder):
    summary = results.read_summary(folder)
    made = plot_map.Map(folder)
    page, attributes = Page(f"Map: {pathlib.Path(summary['deck']['file']).stem}"), {}
    with page.section(folder / "map.h5"):
        attributes = attributes_of(folder)
    scene = deck.read(attributes.get("deck_text", ""), attributes.get("overrides", ""))
    size = " x ".join(f"{axis['name']} ({axis['points']})" for axis in made.axes)
    fixed = deck.conditions(scene, {axis["parameter"] for axis in made.axes})
    page.conditions = ", ".join(filter(None, (f"{len(made.rows)} points: {size}", fixed)))
    for warning in summary.get("warnings") or []:
        page.note(warning)
    if not page.notes:
        page.note("No warnings; no point failed.", good=True)
    page.add("figures", "Figures", headline(made, summary["map"]))
    shown = draw_all(made)
    count = sum(1 for _ in made.pictures())
    more = (f'<p class="remark">The first {len(shown)} of {count} maps; tools/plot_map.py draws '
            'all into the folder.</p>') if count > len(shown) else ""
    page.plots("maps", "Maps", shown, more)
    page.add("grid", "Parameters and values", grid_tables(made))
    page.add("points", "Points", points_table(made))
    page.sort_tables()
    page.add("numerics", "Computation", computation(summary, attributes))
    rows = list(deck.rows(scene))
    page.add("deck", "Deck", tables.of_deck(rows) if rows else "")
    page.footer = (f"Written by tooljoint report from {folder}: program "
                   f"{attributes.get('program_version', '')} ({attributes.get('git_hash', '')}), "
                   f"{attributes.get('date', '')}.")
    return page
