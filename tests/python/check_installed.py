# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the package in FOLDER can be imported, with the libraries installed beside it, and
computes.

    check_installed.py FOLDER
"""
import pathlib
import sys

import numpy as np
import tooljoint as tj

folder = pathlib.Path(sys.argv[1]).resolve()
package = pathlib.Path(tj.__file__).resolve().parent
assert package == folder / "tooljoint", f"{package} is imported, not {folder / 'tooljoint'}"
loaded = {
    line.split()[-1] for line in open("/proc/self/maps", encoding="utf-8") if "libtooljoint" in line
}
prefix = str(folder.parents[2])
assert len(loaded) == 2 and all(
    name.startswith(prefix)
    for name in loaded), f"libraries {loaded}, expected are two below {prefix}"
assert (package / "_core.pyi").is_file() and (package /
                                              "py.typed").is_file(), "the stubs are not installed"
frequency = tj.modes(tj.part("mass", [[1.0]], [[4 * np.pi**2]]), 1).frequency[0]
assert abs(frequency - 1) < 1e-12, f"the frequency is {frequency} Hz, expected 1 Hz"
