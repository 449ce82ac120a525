# SPDX-License-Identifier: BSD-3-Clause
"""Numbers as texts, in SI units and in field units."""
import math

FOOT, POUND = 0.3048, 4.4482216152605  # [m], [N] (exact)
# quantity -> (SI unit, factor to it, decimals), (field unit, factor to it, decimals)
UNITS = {
    "length": (("m", 1.0, 1), ("ft", 1 / FOOT, 0)),
    "side force": (("kN", 1e-3, 2), ("lbf", 1 / POUND, 0)),
    "hook load": (("kN", 1e-3, 1), ("klbf", 1e-3 / POUND, 1)),
    "pressure": (("MPa", 1e-6, 1), ("ksi", 1e-3 * FOOT**2 / (144 * POUND), 1)),
    "penetration": (("m/h", 3600.0, 2), ("ft/h", 3600 / FOOT, 1)),
    "torque": (("kN m", 1e-3, 2), ("kft lbf", 1e-3 / (FOOT * POUND), 2)),
}
SMALLEST = 1e-6  # smallest share printed as a number


def fixed(value, decimals):
    """A number with so many decimals; numbers that round to zero have no sign.

    >>> fixed(-0.04, 1), fixed(-1.26, 1)
    ('0.0', '-1.3')
    """
    return f"{round(value, decimals) + 0.0:.{decimals}f}"


def both(value, quantity):
    """("442.7 kN", "99.5 klbf"); dashes without a value."""
    if value is None or not math.isfinite(value):
        return "-", ""
    return tuple(
        f"{fixed(value * factor, decimals)} {unit}" for unit, factor, decimals in UNITS[quantity])


def plain(value, digits=4):
    """A number in a table; - without one."""
    if value is None or value == "":
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, (int, str)):
        return str(value)
    return f"{value + 0.0:.{digits}g}" if math.isfinite(value) else "-"


def percent(value):
    if value is None or not math.isfinite(value):
        return "-"
    if abs(value) >= 0.995:
        return f"{100 * value:.0f} %"
    return f"{100 * value + 0.0:.2g} %" if value == 0 or abs(
        value) >= SMALLEST else f"< {100 * SMALLEST:g} %"
