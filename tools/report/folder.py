# SPDX-License-Identifier: BSD-3-Clause
"""Main function of the tools that draw the results of a command, and the titles of their
figures."""
import argparse
import pathlib
import sys

import plots
from report import deck
from report.files import failing, reading, writing
from report.results import open_results


def conditions(results):
    """Conditions of the scene from the deck in an HDF5 file of results, for the second line of a
    title."""
    text, overrides = (results.attrs.get(name, "") for name in ("deck_text", "overrides"))
    lists = deck.read(text, overrides)
    name = pathlib.PurePath(results.attrs.get("deck_file", "")).stem
    changed = ", ".join(line for line in overrides.splitlines() if line)
    return "; ".join(part for part in (name, deck.conditions(lists), changed) if part)


def parser(description, kind, files):
    options = argparse.ArgumentParser(description=description,
                                      formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("folder", type=pathlib.Path, help=kind)
    options.add_argument(
        "--output", type=pathlib.Path, help="picture (default: "
        f"{' or '.join(pathlib.Path(f).stem + '.png' for f in files)} in the folder)")
    return options


def opened(folder, kind, files):
    """(name, open file) of the first of `files` in the folder; ends with a message if there is
    none."""
    found = next((name for name in files if (folder / name).is_file()), None)
    if found is None:
        missing = f"neither {' nor '.join(files)}" if len(files) > 1 else f"no {next(iter(files))}"
        sys.exit(f"{folder} holds {missing}. Give the {kind}.")
    with failing():
        return found, open_results(folder / found)


def save(made, path):
    """Writes a figure and prints its name."""
    with failing(), writing(path):
        plots.save(made, path)
    print(f"drawn {path}")


def draw_folder(description, kind, files):
    """Main function of a tool: draws the first of `files` (name.h5 -> pictures) in the folder as
    name.png there, or as the file of --output. `kind`: description of the folder.

    Pictures are given as a function of the open file that makes a figure, or several with their
    titles, {"": (title, function), "shapes": (title, function)}: the second is name_shapes.png. A
    function returns None if there is nothing to draw."""
    options = parser(description, kind, files).parse_args()
    plots.use_style()
    found, results = opened(options.folder, kind, files)
    output = options.output or (options.folder / found).with_suffix(".png")
    pictures = files[found] if isinstance(files[found], dict) else {"": ("", files[found])}
    with results:
        for suffix, (title, function) in pictures.items():
            with failing(), reading(options.folder / found):
                made = function(results)
            if made is None:
                continue
            if title:
                plots.headline(made, title, conditions(results))
            path = output.with_name(f"{output.stem}_{suffix}{output.suffix}") if suffix else output
            save(made, path)
