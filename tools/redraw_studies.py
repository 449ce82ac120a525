#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Redraws the figures of the studies in the current style, from the tables in the documents.

    tools/redraw_studies.py [--output docs/figures] [--only speed_helical,...]

speed_*.svg come from docs/tables/speed_*.csv, cms_variants_*.png from
docs/tables/cms_variants_*.csv; no run is repeated. Needs h5py, numpy and matplotlib.
"""
import argparse
import csv
import pathlib
import re
import sys
import tempfile
import xml.etree.ElementTree as xml

try:
    import h5py
    from PIL import Image

    import plot_study
    import plots
    from report import deck
except ImportError as missing:
    sys.exit(f"{missing}: redraw_studies.py needs h5py, numpy and matplotlib (Debian: python3-h5py "
             "python3-matplotlib, then /usr/bin/python3).")

PROJECT = pathlib.Path(__file__).resolve().parent.parent
COLUMNS = ("line", "label", "kind", "model", "sweep", "status", "vibration_error",
           "cpu_per_simulated_s", "cpu_spread", "reduced_dofs", "modes", "frequency_error",
           "setup_cpu", "reason")
SPEED = {
    "helical": "study_helical_170m", "stress": "stress_170m", "vertical": "vertical_1000m",
    "inclined": "inclined_1000m"
}
VARIANTS = {"helical": "cms_variants", "frame": "cms_variants_frame"}
BASELINE = "RK4 adaptive, Tolerance 1e-2"


def line_of(label):
    """A label without its last part, the value of the sweep: "RK4, Safety 0.95" -> "RK4"."""
    return label.rpartition(", ")[0] or label


def scene(name):
    """Text and lists of a deck."""
    text = (PROJECT / f"xml/{name}.xml").read_text(encoding="utf-8")
    return text, deck.read(text, "")


def save_small(made, path):
    """Saves a PNG with a palette: half the size, and line colours remain distinct."""
    made.savefig(path, dpi=110, bbox_inches="tight")
    plots.plt.close(made)
    with Image.open(path) as shot:
        shot.convert("RGB").quantize(256).save(path, optimize=True)


def published(lists, file):
    for number, (name, entry) in enumerate((lists.get("Study", {}).get("Published") or {}).items(),
                                           1):
        group = file.create_group(f"published/{number:03d}")
        group.attrs["label"] = name
        group["cpu_time"] = [float(value) for value in re.findall(r"[-+.\deE]+", entry["CPU Time"])]
        if "Error" in entry:
            group["error"] = [float(value) for value in re.findall(r"[-+.\deE]+", entry["Error"])]
        if "Points" in entry:
            group["points"] = [text.strip() for text in entry["Points"].strip("{}").split(",")]


def study(name, rows, attributes):
    """The study of a deck, made from rows and attributes of a document."""
    text, lists = scene(name)
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        with open(folder / "study.csv", "w", newline="", encoding="utf-8") as out:
            csv.writer(out).writerows(
                [COLUMNS, *([row.get(column, "") for column in COLUMNS] for row in rows)])
        with h5py.File(folder / "study.h5", "w") as file:
            file.attrs.update({
                "deck_name": xml.fromstring(text).get("name", name),
                "deck_text": text,
                **attributes,
            })
            published(lists, file)
        return plot_study.Study(folder)


def speed(name):
    """Figure of docs/tables/speed_NAME.csv; the page gives the reference."""
    page = (PROJECT / "docs/speed-against-error.md").read_text(encoding="utf-8")
    said = re.search(
        rf"xml/{SPEED[name]}\.xml`\. .*?vibration error of (\S+) over (\S+) to (\S+) s",
        " ".join(page.split()))
    with open(PROJECT / f"docs/tables/speed_{name}.csv", newline="", encoding="utf-8") as file:
        table = list(csv.DictReader(file))
    most = max(int(row["dofs"]) for row in table)
    rows = [{
        "line": line_of(row["run"]), "label": row["run"], "kind": "method",
        "model": "full" if int(row["dofs"]) == most else "reduced", "reduced_dofs": row["dofs"],
        "status": "done" if row["vibration_error"] else "failed",
        "vibration_error": row["vibration_error"],
        "cpu_per_simulated_s": row["cpu_per_simulated_s [s]"], "cpu_spread": row["cpu_spread"],
        "reason": row["remarks"]
    } for row in table]
    machine = re.search(r"^Machine: (.*?), \d+ processors", page, re.M).group(1)
    return plot_study.draw_speed(
        study(
            SPEED[name], rows, {
                "machine": machine, "baseline": BASELINE, "self_error": float(said.group(1)),
                "window_begin": float(said.group(2)), "window_end": float(said.group(3))
            }))


def variants(name):
    """Figure of docs/tables/cms_variants_NAME.csv; the page gives machine and steps."""
    page = (PROJECT / "docs/cms-variants.md").read_text(encoding="utf-8")
    section = page[page.index(f"<!-- {name} -->"):]
    section = section[:section.index("<!-- end -->")]
    with open(PROJECT / f"docs/tables/cms_variants_{name}.csv", newline="",
              encoding="utf-8") as file:
        table = list(csv.DictReader(file))
    rows = []
    for row in table[1:]:  # the first is the reference
        label, error = row["run"], row["vibration_error"]
        rows.append({
            "line": line_of(label), "label": label, "kind": "method",
            "model": "full" if line_of(label) == "Full" else "reduced",
            "status": "done" if error else "failed", "vibration_error": error,
            "cpu_per_simulated_s": row["cpu_per_simulated_s [s]"], "reduced_dofs": row["dofs"],
            "frequency_error": row["frequency_error"], "setup_cpu": row["setup_cpu [s]"]
        })
    own = re.search(r"vibration error of (\S+) against RK4", " ".join(section.split()))
    _, lists = scene(VARIANTS[name])
    window = float(
        next(
            filter(None, (deck.value(lists, path)
                          for path in ("Study/Window", "Study/End Time", "Transient/End Time")))))
    return plot_study.draw_bases(
        study(
            VARIANTS[name], rows, {
                "machine": re.search(
                    r"^Machine: (.*?), \d+ cores", section, re.M).group(1), "self_error": float(
                        own.group(1)), "frequencies": 20, "window_begin": 0.0, "window_end": window
            }))


FIGURES = {
    **{f"speed_{name}.svg": (speed, name) for name in SPEED},
    **{f"cms_variants_{name}.png": (variants, name) for name in VARIANTS}
}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", type=pathlib.Path, default=PROJECT / "docs/figures",
                        help="folder of the figures")
    parser.add_argument("--only", type=lambda text: text.split(","),
                        default=[name.partition(".")[0] for name in FIGURES],
                        help="figures without their extensions, separated by commas")
    options = parser.parse_args()
    plots.use_style()
    for file, (draw, name) in FIGURES.items():
        if file.partition(".")[0] in options.only:
            made = draw(name)
            (save_small if file.endswith(".png") else plots.save)(made, options.output / file)
            print(f"drawn {options.output / file}")


if __name__ == "__main__":
    main()
