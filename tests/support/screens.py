# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the numbers on last screens of studies, maps and analyses are those of
summary.json."""
import json
import math
import pathlib
import re
import shlex

from checks import expect

UNREAD = {
    "torque_drag": "Torque and Drag", "bha": "Bottom-Hole Assembly", "buckling": "Buckling",
    "campbell": "Campbell", "response": "Response", "map": "Map"
}  # lists that are not read by the next command


def _extreme(rows, key, choose, factor=1.0):
    found = [row[key] for row in rows or [] if row[key] is not None]
    return choose(found) * factor if found else None


def _largest(values):
    return max(values, key=abs)


def _numbers(analysis, summary):
    """Name on the screen, or name and unit if a name has several -> number in the printed unit;
    None: the name is not on the screen."""
    group = summary[analysis]
    if analysis == "torque_drag":
        rows = group["rows"]
        return {
            "largest hook load": _extreme(rows, "hook_load", max, 1e-3),
            "least hook load": _extreme(rows, "hook_load", min, 1e-3),
            "surface torque": _extreme(rows, "surface_torque", _largest, 1e-3),
            "helical margin": _extreme(rows, "helical_margin", min),
        }
    if analysis == "bha":
        rows = group["rows"]
        return {
            "side force at the bit": _extreme(rows, "side_force_high", _largest, 1e-3),
            "bending moment": _extreme(rows, "largest_moment", max, 1e-3),
            "von Mises stress": _extreme(rows, "largest_von_mises", max, 1e-6),
        }
    if analysis == "buckling":
        scaled = {
            "first buckling": group["limit"], "helical limit": group["theory"]["helical"],
            "last weight on bit": group["last_weight_on_bit"]
        }
        return {
            **{name: value and value / 1e3 for name, value in scaled.items()}, "jumps": len(
                group["jumps"] or [])
        }
    if analysis == "campbell":
        return {
            "speeds": group["points"],
            "critical speeds": len(group["crossings"] or []),
            "least damping ratio": group["least_damping"] and 100 * group["least_damping"],
            "growing from": _extreme(group["stability_limits"], "speed_rpm", min),
        }
    if analysis == "response":
        peaks = group["peaks"] or []
        units = {peak["unit"] for peak in peaks}
        largest = {("largest peak",
                    unit): _extreme([peak
                                     for peak in peaks if peak["unit"] == unit], "amplitude", max)
                   for unit in units} if units else {"largest peak": None}
        return {
            "points": group["points"], "wall reached from": group["contact_speed_rpm"], **largest
        }
    if analysis == "modes":
        return {
            "modes": group["count"], "lowest frequency": group["lowest_hz"],
            "error by reduction": group["largest_error"] and 100 * group["largest_error"]
        }
    if analysis == "map":
        return {"points": group["points"], group["values"][0]["name"]: group["values"][0]["min"]}
    methods = [row for row in group if row["kind"] == "method" and row["status"] == "done"]
    return {"runs": len(methods), "most accurate": _extreme(methods, "vibration_error", min, 100)}


def _rounds(value, text):
    """Whether a text is the value with at least three digits, or rounded to its last decimal."""
    decimals = len(text.partition(".")[2]) if "e" not in text else 300
    return math.isclose(float(text), value, rel_tol=6e-3, abs_tol=0.501 * 10.0**-decimals)


def expect_screen(done, folder, analysis):
    """Every number on the screen is the rounded one of the summary; the screen names the report and
    the next steps."""
    summary = json.loads((pathlib.Path(folder) / "summary.json").read_text(encoding="utf-8"))
    said = re.sub(r"\x1b\[\d+m", "", done.stdout)
    screen = said[said.rfind("\n\n", 0, max(said.rfind("\nopen "), said.rfind("\nreport ")) - 1):]
    for name, wanted in _numbers(analysis, summary).items():
        name, unit = name if isinstance(name, tuple) else (name, "")
        found = re.search(
            rf"^{re.escape(name)} +(-?\d[\d.e+-]*){unit and ' ' + re.escape(unit) + ' '}", screen,
            re.M)
        same = found is None if wanted is None else found is not None and _rounds(wanted, found[1])
        if not same:
            expect(f"{folder}: the last screen of {analysis}: {name} is {wanted}", False,
                   screen[-900:])
    following = re.search(r"^next +tooljoint ((?:.*\\\n)*.*)", screen, re.M)
    words = shlex.split(following[1].replace("\\\n", " ")) if following else []
    if not (words and pathlib.Path(words[1]).exists()):
        expect(f"{folder}: the last screen of {analysis} says what to try next", False,
               screen[-900:])
    unread = [word for word in words if word.startswith(UNREAD.get(analysis, "none") + "/")]
    if unread:
        expect(f"{folder}: what to try next has no settings of {analysis}, which it does not read",
               False, unread)
    expect(
        f"{folder}: the last screen of {analysis} has the numbers of the summary, in 100 columns",
        all(len(line) <= 100 for line in screen.strip().partition("\n\n")[0].splitlines()), screen)
