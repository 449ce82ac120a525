#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes one HTML file of what is in a results folder: python3 tools/report DIR [--output FILE]

DIR is the folder of a run (results.h5, summary.json), of a study (study.csv, study.h5), of a map (map.csv), or of `torque-drag`, `bha`, `buckling`, `campbell`, `response` or `modes`. The file needs no
network and nothing beside it. Needs numpy, h5py and matplotlib, and three.js (Debian: libjs-three) for the view in space.
Exit codes: 0 done, 1 wrong usage, 5 nothing to report on, a file that cannot be read or written.
"""
import argparse
import os
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[0] = str(HERE.parent)

USAGE, FILES = 1, 5


def fail(sentence):
    print(sentence, file=sys.stderr)
    sys.exit(FILES)


try:
    import h5py  # noqa: F401
    import plots
    from report import of_map, of_run, of_study, of_tables
    from report.page import viewer
    from report.results import Unreadable
except ImportError as missing:
    fail(f"{missing}: the report needs numpy, h5py and matplotlib (Debian: python3-h5py python3-matplotlib, then /usr/bin/python3).")


class Arguments(argparse.ArgumentParser):
    def error(self, message):
        self.print_usage(sys.stderr)
        print(message, file=sys.stderr)
        sys.exit(USAGE)


def page_of(folder):
    """The page of what the folder holds."""
    if not folder.is_dir():
        raise Unreadable(f"\"{folder}\" is no folder. Name the results folder of a run, a study, a map, torque-drag, bha, buckling, campbell, response or modes.")
    if (folder / "study.csv").is_file() or (folder / "study.h5").is_file():
        return of_study.page_of(folder)
    if (folder / "results.h5").is_file():
        return of_run.page_of(folder)
    if (folder / "map.csv").is_file():
        return of_map.page_of(folder)
    if any((folder / name).is_file() for name in ("torque_drag.csv", "bha.csv", "buckling.csv", "campbell.h5", "response.h5", "modes.csv")):
        return of_tables.page_of(folder)
    for name, what in (("results.h5.part", "run"), ("study.csv.part", "study"), ("map.csv.part", "map")):
        if (folder / name).is_file():
            raise Unreadable(f"{folder} holds {name}, the results of a {what} that has not ended. Wait for its end, or start it again.")
    raise Unreadable(f"{folder} holds no results.h5, study.csv, map.csv, torque_drag.csv, bha.csv, buckling.csv, campbell.h5, response.h5 or modes.csv. Name the results folder of a run, a study, a map, torque-drag, bha, buckling, campbell, response or modes.")


def write(path, text):
    """The file is whole or as it was before."""
    part = path.with_name(path.name + ".part")
    try:
        part.write_text(text, encoding="utf-8")
        os.replace(part, path)
    except OSError as error:
        fail(f"{path} cannot be written: {error.strerror}.")


def main():
    parser = Arguments(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, prog="report")
    parser.add_argument("folder", type=pathlib.Path, help="results folder")
    parser.add_argument("--output", type=pathlib.Path, help="file to write (default: DIR/report.html)")
    parser.add_argument("--quiet", action="store_true", help="say nothing of the file that was written")
    options = parser.parse_args()
    plots.use_style()
    try:
        page = page_of(options.folder)
    except Unreadable as error:
        fail(str(error))
    except (OSError, KeyError, ValueError, IndexError) as error:
        fail(f"The results in {options.folder} are damaged or incomplete ({type(error).__name__}: {error}). Run the deck again, or restore them from a copy.")
    text = page.text()
    path = options.output or options.folder / "report.html"
    write(path, text)
    if not options.quiet:
        print(f"report      {path}: {len(text.encode()) / 1e6:.1f} MB")
    if viewer() is None:
        print("The report has no 3-D view: three.js is not installed (Debian: libjs-three).", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
