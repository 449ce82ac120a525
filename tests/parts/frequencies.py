# SPDX-License-Identifier: BSD-3-Clause
"""Decks of parts and their frequencies by `tooljoint modes`."""
import csv
import pathlib

import numpy as np

from checks import expect, tooljoint

ROOT = pathlib.Path(__file__).resolve().parents[2]


def hertz(deck, key, *arguments, ranks=1, count=12):
    folder = f"modes_{len(list(pathlib.Path().glob('modes_*')))}"
    done = tooljoint("modes", str(deck), "--count", str(count), "--output", folder, *arguments,
                     ranks=ranks)
    if done.returncode != 0:
        expect(f"modes of {deck}", False, done.stderr)
        return np.zeros(count)
    return np.sort(
        [float(row[key]) for row in csv.DictReader(open(f"{folder}/modes.csv", encoding="utf-8"))])
