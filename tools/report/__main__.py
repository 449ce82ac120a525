#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes one HTML file with the contents of a results folder: python3 tools/report DIR [--output
FILE]

DIR is the folder of a run (results.h5, summary.json), of a study (study.csv, study.h5), of a map
(map.csv), or of `torque-drag`, `bha`, `buckling`, `campbell`, `response` or `modes`. The file is
self-contained and needs no network. Needs numpy, h5py and matplotlib, and three.js (Debian:
libjs-three) for the view in space. Exit codes: 0 done, 1 wrong usage, 5 nothing to report on, or a
file that cannot be read or written. If one of several files is damaged, the report shows the
others, and the exit code is 5 as well.
"""
import argparse
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[0] = str(HERE.parent)

from report.files import (USAGE, Unreadable, fail, failing, reading,
                          write)  # noqa: E402: from the parent folder

try:
    import h5py  # noqa: F401
    import plots
    from report import of_map, of_run, of_study, of_tables
    from report.page import viewer
except ImportError as missing:
    fail(f"{missing}: the report needs numpy, h5py and matplotlib (Debian: python3-h5py "
         "python3-matplotlib, then /usr/bin/python3).")


class Arguments(argparse.ArgumentParser):
    def error(self, message):
        self.print_usage(sys.stderr)
        print(message, file=sys.stderr)
        sys.exit(USAGE)


def page_of(folder):
    """The page for the contents of the folder."""
    if not folder.is_dir():
        raise Unreadable(f"\"{folder}\" is no folder. Name the results folder of a run, a study, a "
                         "map, torque-drag, bha, buckling, campbell, response or modes.")
    if (folder / "study.csv").is_file() or (folder / "study.h5").is_file():
        return of_study.page_of(folder)
    if (folder / "results.h5").is_file():
        return of_run.page_of(folder)
    if (folder / "map.csv").is_file():
        return of_map.page_of(folder)
    if any((folder / name).is_file() for name in ("torque_drag.csv", "bha.csv", "buckling.csv",
                                                  "campbell.h5", "response.h5", "modes.csv")):
        return of_tables.page_of(folder)
    for name, what in (
        ("results.h5.part", "run"),
        ("study.csv.part", "study"),
        ("map.csv.part", "map"),
    ):
        if (folder / name).is_file():
            raise Unreadable(f"{folder} holds {name}, the results of a {what} that has not ended. "
                             "Wait for its end, or start it again.")
    raise Unreadable(f"{folder} holds no results.h5, study.csv, map.csv, torque_drag.csv, bha.csv, "
                     "buckling.csv, campbell.h5, response.h5 or modes.csv. Name the results "
                     "folder of a run, a study, a map, torque-drag, bha, buckling, campbell, "
                     "response or modes.")


def main():
    parser = Arguments(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
                       prog="report")
    parser.add_argument("folder", type=pathlib.Path, help="results folder")
    parser.add_argument("--output", type=pathlib.Path,
                        help="file to write (default: DIR/report.html)")
    parser.add_argument("--quiet", action="store_true", help="do not print the name of the file")
    options = parser.parse_args()
    plots.use_style()
    path = options.output or options.folder / "report.html"
    with failing():
        with reading(options.folder):
            page = page_of(options.folder)
        if page.damaged and not page.sections:
            fail("\n".join(page.damaged))
        text = page.text()
        write(path, text)
    if not options.quiet:
        size = len(text.encode())
        print(f"report      {path}: " +
              (f"{size / 1e6:.1f} MB" if size >= 1e6 else f"{size / 1e3:.0f} kB"))
    if viewer() is None:
        print("The report has no 3-D view: three.js is not installed (Debian: libjs-three).",
              file=sys.stderr)
    if page.damaged:
        fail("\n".join((*page.damaged, f"{path} was written without what these files hold.")))
    return 0


if __name__ == "__main__":
    sys.exit(main())
