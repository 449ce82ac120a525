# SPDX-License-Identifier: BSD-3-Clause
"""The tables of datasets in docs/file-formats.md, compared with the datasets of a file."""
import pathlib
import re

import h5py

MANUAL = pathlib.Path(__file__).resolve().parents[2] / "docs" / "file-formats.md"


def rows(heading):
    """First table of datasets below a heading: path -> {"shape": ..., "units": ...}. NAME and NNN
    in a path match any name."""
    text = MANUAL.read_text(encoding="utf-8")
    lines = text[text.index(heading):].split("\n| dataset |", 1)[1].splitlines()
    titles = [title.strip() for title in lines[0].strip("|").split("|")]
    found = {}
    for line in lines[2:]:
        if not line.startswith("|"):
            break
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        paths = re.findall(r"`([^`]+)`", cells[0])
        for path in paths:
            found[path] = {}
        for title, cell in zip(titles, cells[1:]):
            entries = [entry.strip() for entry in cell.split(";")]
            if title not in ("shape", "units"):
                continue
            assert len(entries) in (
                1, len(paths)), f"{MANUAL.name}: {len(entries)} {title} for {paths}"
            for path, entry in zip(paths, entries if len(entries) > 1 else entries * len(paths)):
                found[path][title] = entry
    return found


def matches(pattern, path):
    words = re.sub(r"\bNAME\b|\bNNN\b|(?<=part_)K\b", "[^/]+", re.escape(pattern))
    return re.fullmatch(words, path) is not None


def fits(shape, found, sizes):
    """`sizes` gives the numbers for the letters of a documented shape; other words match any
    number."""
    wanted = [sizes.get(word, int(word) if word.isdigit() else None) for word in shape.split(" x ")]
    return len(wanted) == len(found) and all(size in (None, extent)
                                             for size, extent in zip(wanted, found))


def faults(file, table, sizes=None):
    """Messages on datasets without a row, or with another unit or shape than in their row; and the
    rows found."""
    wrong, met = [], set()

    def look(name, dataset):
        if not isinstance(dataset, h5py.Dataset):
            return
        path = "/" + name
        patterns = [pattern for pattern in table if matches(pattern, path)]
        if len(patterns) != 1:
            wrong.append(f"{path} has {len(patterns)} rows in {MANUAL.name}")
            return
        met.add(patterns[0])
        row, unit = table[patterns[0]], dataset.attrs.get("units", "none")
        if unit != row["units"]:
            wrong.append(f"{path} is in {unit!r}, documented {row['units']!r}")
        if not dataset.attrs.get("long_name"):
            wrong.append(f"{path} has no long name")
        if sizes is not None and not fits(row["shape"], dataset.shape, sizes):
            wrong.append(f"{path} is {dataset.shape}, documented {row['shape']}")

    file.visititems(look)
    return wrong, met
