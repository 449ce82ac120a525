# SPDX-License-Identifier: BSD-3-Clause
"""Reads and compares datasets and tables of a run."""
import csv
import pathlib
import re
import subprocess
import sys

import numpy as np

import documented
from checks import expect

PROGRAM = sys.argv[1]
ROOT = pathlib.Path(__file__).resolve().parents[2]


def near(what, found, expected, tolerance):
    """`found` and `expected` differ by at most `tolerance` times the largest expected size."""
    found, expected = np.asarray(found, float), np.asarray(expected, float)
    if found.shape != expected.shape:
        expect(what, False, f"shapes {found.shape} and {expected.shape}")
        return
    size = np.abs(expected).max()
    error = np.abs(found - expected).max() / size if size > 0 else np.abs(found).max()
    expect(what, size > 0 and error <= tolerance, f"({error:.1e} of {size:.3g})")


def run(deck, folder, *overrides):
    command = [PROGRAM, "run", str(deck), "--output", folder]
    for override in overrides:
        command += ["--set", override]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} ended with {done.returncode}:\n{done.stdout}")
    return pathlib.Path(folder)


def check_datasets(title, file, rows, sizes, written):
    wrong, met = documented.faults(file, rows, sizes)
    written |= met
    expect(f"{title}: datasets have the units and shapes of docs/file-formats.md", not wrong
           and len(met) > 5, "; ".join(wrong))


def table(path, header):
    """Columns of a CSV file by name; the header with its units is `header`."""
    with open(path, encoding="utf-8", newline="") as file:
        lines = list(csv.reader(file))
    expect(f"header of {path.name}", lines[0] == header, lines[0] if lines[0] != header else "")
    columns = np.array(lines[1:], float).T
    return {re.sub(r" \[.*\]", "", name): column for name, column in zip(lines[0], columns)}


def rates(values, time):
    """Central differences at the inner samples."""
    apart = time[2:] - time[:-2]
    return (values[2:] - values[:-2]) / apart.reshape((-1,) + (1,) * (values.ndim - 1))


def relative(found, expected):
    return np.linalg.norm(found - expected) / np.linalg.norm(expected)


def check_motion(title, file, speed_error, acceleration_error):
    time = file["/transient/time"][:]
    d, v, a = (file[f"/transient/{name}"][:]
               for name in ("displacement", "velocity", "acceleration"))
    expect(f"{title}: there is motion", np.ptp(d, axis=0).max() > 1e-5)
    error = relative(v[1:-1], rates(d, time))
    expect(f"{title}: velocities are the rates of the displacements", error < speed_error,
           f"({error:.1e})")
    error = relative(a[1:-1], rates(v, time))
    expect(f"{title}: accelerations are the rates of the velocities", error < acceleration_error,
           f"({error:.1e})")
