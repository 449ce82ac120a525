# SPDX-License-Identifier: BSD-3-Clause
"""Compares numbers of a run with reference values."""
from checks import expect


def near(what, found, truth, tolerance):
    expect(f"{what}: {found:.6g}, true {truth:.6g} within {tolerance:.2g}",
           abs(found - truth) <= tolerance)
