# SPDX-License-Identifier: BSD-3-Clause
"""Compares the numbers of two results folders."""
import json
import pathlib

import h5py
import numpy as np

OWN = {"wall_s", "cpu_s", "real_time_factor"}  # times differ between runs


def numbers(folder):
    with h5py.File(pathlib.Path(folder, "results.h5")) as file:
        found = {}
        file.visititems(lambda name, item: found.update({name: item[()]})
                        if isinstance(item, h5py.Dataset) else None)
    return found


def differences(whole, other, tolerance=0.0):
    """Names of the differences of two results folders."""
    a, b = numbers(whole), numbers(other)
    names = sorted(a.keys() ^ b.keys())
    for name in sorted(a.keys() & b.keys()):
        same = a[name].shape == b[name].shape
        if same and tolerance > 0 and a[name].dtype.kind == "f":
            same = np.abs(a[name] - b[name]).max(
                initial=0.0) <= tolerance * max(np.abs(a[name]).max(initial=0.0), 1e-300)
        elif same:
            same = np.array_equal(a[name], b[name])
        if not same:
            names.append(name)
    if tolerance == 0:
        for name in ("motion.csv", "results.xdmf"):
            files = [pathlib.Path(folder, name) for folder in (whole, other)]
            if files[0].exists() != files[1].exists() or (
                    files[0].exists() and files[0].read_bytes() != files[1].read_bytes()):
                names.append(name)
        figures = [
            json.loads(pathlib.Path(folder,
                                    "summary.json").read_text(encoding="utf-8"))["transient"]
            for folder in (whole, other)
        ]
        names += [
            f"summary.json transient.{key}: {figures[0][key]} and {figures[1][key]}"
            for key in figures[0] if key not in OWN and figures[0][key] != figures[1][key]
        ]
    return names
