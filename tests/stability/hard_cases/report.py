# SPDX-License-Identifier: BSD-3-Clause
"""Writes docs/hard-cases.md, its figures and its tables from the rows of the cases."""
import collections
import csv
import math
import pathlib
import platform
import re
import sys

from rows import CASES

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "tools"))
import plots  # noqa: E402

ORDER = ("met", "warned", "off", "refused", "WRONG")
PARTS = {
    "short": "This is the short version: a few points of the range, near its easy end.",
    "stopped": "The case was stopped before its end: the last points of the range are not there."
}
LONGEST_NOTE = 150  # longest sentence in the page [characters]
COLUMNS = ("variant", "parameter", "truth", "found", "deviation", "bound", "verdict", "cost",
           "what the program says")
VERDICT = COLUMNS.index("verdict")
HEAD = """# Hard cases

Cases that are hard for the statics, the reduction or the integration, each swept over a range of
its parameter and set beside a truth of its own: a closed form, an eigenvalue, a tighter step,
another integrator, or the statistics of perturbed runs. This page, its figures and its tables are
written by

    cmake --build --preset release --target hard-cases

A row of a sweep is *met* where the number is within its bound of the truth, *warned* where it is
not and the run says so (error up to 50 %), *off* where nothing says so and the error of the motion
is below 20 %, *refused* where the program ends with exit code 2, 3 or 4 and a sentence instead of a
number, and WRONG where none of these holds. The command fails when a row is WRONG, or when a row
that must be met is refused. Each chapter shows the rows that are not met and names the table of all
its rows. The overview counts rows. Costs are CPU times over those of the easy variant that is
named; counters are those of `summary.json` over its steps. `ctest -R hard_cases` runs a short
version.

"""


def cell(text):
    return " ".join(str(text).replace("|", "\\|").split())


def without_folders(text):
    return re.sub(r"(?<![\w/])/\S*/(?=\w+\.(?:xml|json))", "", text)


def shortened(text):
    return text if len(text) <= LONGEST_NOTE else text[:LONGEST_NOTE - 3].rsplit(" ", 1)[0] + " ..."


def line(cells):
    return "| " + " | ".join(cell(x) for x in cells) + " |\n"


def table(head, lines):
    return line(head) + "|" + "---|" * len(head) + "\n" + "".join(line(cells) for cells in lines)


def span(values, digits=2):
    values = [v for v in values if math.isfinite(v)]
    if not values:
        return ""
    low, high = (f"{v:.{digits}g}" if v < 100 else f"{v:.0f}" for v in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"


def overview_line(case, rows):
    """A case, the number of its rows with each verdict, and its cost."""
    anchor = re.sub(r"[^a-z0-9 -]", "", f"{case.number}. {case.title}".lower()).replace(" ", "-")
    counts = [sum(row.verdict == verdict for row in rows) for verdict in ORDER]
    return line((case.number, f"[{case.title}](#{anchor})", *(count or "" for count in counts),
                 span([row.cost for row in rows])))


def strategies(rows):
    """A sentence: iterations, factorisations and other events per step."""
    used = [row.counters for row in rows if row.counters.get("steps")]
    texts = []
    for name in dict.fromkeys(key for counters in used for key in counters):
        if name == "steps":
            continue
        rates = [(counters.get(name) or 0) / counters["steps"] for counters in used]
        if any(rates):
            texts.append(f"{name.replace('_', ' ')} {span(rates)}")
    return "Per step: " + ", ".join(texts) + "." if texts else ""


def number(value):
    return f"{value:.2g}" if math.isfinite(value) else ""


def cells_of(row):
    """A row as texts, one for each of COLUMNS."""
    bound = number(row.bound) if math.isfinite(row.deviation) else ""
    return (row.variant, row.parameter, row.truth, row.found, number(row.deviation), bound,
            row.verdict, number(row.cost), without_folders(row.note))


def chapter(case, rows, drawn, part, counters):
    """Chapter of a case from rows of texts: the figures, the rows that are not met, the link to all
    rows, and the sentence of the counters."""
    unmet = [(*row[:-1], shortened(row[-1])) for row in rows if row[VERDICT] != "met"]
    keep = [i for i in range(len(COLUMNS)) if i < 2 or any(row[i] != "" for row in unmet)]
    pictures = "".join(f"\n![{title}](figures/hard_{name}.svg)\n" for name, title in drawn)
    said = (f"{len(rows) - len(unmet)} of {len(rows)} rows are met "
            f"([{csv_name(case)}](tables/{csv_name(case)}))") + ("; the others:" if unmet else ".")
    return (f"## {case.number}. {case.title}\n\n{case.must[0].upper()}{case.must[1:]}. Sweep: "
            f"{case.sweep}." + (f" Easy variant: {case.easy}." if case.easy else "") +
            (f" {PARTS[part]}" if part else "") + "\n" + pictures + f"\n{said}\n" +
            ("\n" + table([COLUMNS[i] for i in keep], [[row[i] for i in keep]
                                                       for row in unmet]) if unmet else "") +
            (f"\n{counters}\n" if counters else ""))


def csv_name(case):
    return f"hard_{case.number:02d}.csv"


def in_all(folder, cases):
    """A sentence: number of rows with each verdict in the tables of these cases."""
    counts = collections.Counter()
    for case in cases:
        with open(folder / csv_name(case), newline="", encoding="utf-8") as table_of_case:
            counts.update(row[VERDICT] for row in list(csv.reader(table_of_case))[1:])
    each = ", ".join(f"{counts[verdict]} {verdict}" for verdict in ORDER if counts[verdict])
    return f"{sum(counts.values())} rows in all: {each}."


def tabulate(path, rows):
    with open(path, "w", newline="", encoding="utf-8") as out:
        csv.writer(out, lineterminator="\n").writerows([COLUMNS, *rows])


def draw(plot, path):
    plots.use_style()
    made, axes = plots.figure(5.6, 3.4)
    for i, (label, points) in enumerate(plot.series.items()):
        points = [(x, y) for x, y in points if y is not None and math.isfinite(y)]
        if points:
            line = label.startswith("truth")
            axes.plot(*zip(*points), "-" if line else plots.MARKERS[i % len(plots.MARKERS)],
                      label=label, markersize=4, linewidth=1,
                      color="black" if line else plots.COLOURS[i % len(plots.COLOURS)])
    axes.set(xlabel=plot.x, ylabel=plot.y)
    for axis, name in ((axes.xaxis, "x"), (axes.yaxis, "y")):
        if name in plot.log:
            getattr(axes, f"set_{name}scale")("log")
            plots.logarithmic(axis)
    plots.legend_above(axes, 2)
    plots.headline(made, plot.title)
    plots.save(made, path)


def written(path):
    """Case number -> (its line of the overview, its chapter) in a document."""
    if not path.exists():
        return {}
    text = path.read_text(encoding="utf-8")
    overview = text.partition("## Overview")[2].partition("\n## ")[0]
    lines = {
        int(found[1]): found[0]
        for found in re.finditer(r"^\| (\d+) \| .*\n?", overview, re.MULTILINE)
    }
    chapters = {
        int(found[1]): found[0].rstrip() + "\n"
        for found in re.finditer(r"^## (\d+)\. .*?(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)
    }
    return {n: (lines[n], chapter) for n, chapter in chapters.items()}


def write(path, results):
    """Writes the page. `results`: case number -> (rows, plots, which part of the case they are).
    Other cases in the document are not changed."""
    figures, tables = path.parent / "figures", path.parent / "tables"
    figures.mkdir(exist_ok=True)
    tables.mkdir(exist_ok=True)
    for _, drawn, _ in results.values():
        for plot in drawn:
            draw(plot, figures / f"hard_{plot.name}.svg")
    cases = {n: found for n, found in written(path).items() if n in CASES}
    for n, (rows, drawn, part) in results.items():
        case, texts = CASES[n], [cells_of(row) for row in rows]
        tabulate(tables / csv_name(case), texts)
        cases[n] = (overview_line(case, rows),
                    chapter(case, texts, [(plot.name, plot.title) for plot in drawn], part,
                            strategies(rows)))
    text = HEAD + f"Machine: {platform.machine()}, {platform.system()}.\n\n## Overview\n\n"
    text += table(
        ("case", "", *ORDER, "cost over the easy variant"), []) + "".join(cases[n][0]
                                                                          for n in sorted(cases))
    text += f"\n{in_all(tables, [CASES[n] for n in sorted(cases)])}\n"
    text += "".join("\n" + cases[n][1] for n in sorted(cases))
    path.write_text(text, encoding="utf-8")
