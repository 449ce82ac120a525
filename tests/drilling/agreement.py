# SPDX-License-Identifier: BSD-3-Clause
"""Numbers of a run compared with true ones."""
from checks import expect


def near(what, found, truth, tolerance):
    expect(f"{what}: {found:.6g}, true {truth:.6g} within {tolerance:.2g}",
           abs(found - truth) <= tolerance)
