#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs xml/first_run.xml reduced and full and prints a summary of the results.

    tools/first_run.py [--program build/release/tooljoint] [--output results/first_run]

The output folder receives the runs `reduced` and `full`, a picture, and comparison.json with the
printed numbers in SI units. Needs h5py and numpy, and matplotlib for the picture.
"""
import argparse
import json
import math
import os
import pathlib
import shlex
import subprocess
import sys
import xml.etree.ElementTree as ET

try:
    import h5py
    import numpy as np

    from report import checks
except ImportError as missing:
    sys.exit(f"{missing}: first_run.py needs h5py and numpy "
             "(Debian: python3-h5py, then /usr/bin/python3).")

ROOT = pathlib.Path(__file__).resolve().parent.parent
DECK = ROOT / "xml" / "first_run.xml"
FULL = ["--without", "Reduction", "--without", "Substructures"]
COLUMNS = 100  # width of a printed line
UNITS = {"": 1.0, "in": 0.0254, "m": 1.0, "kN": 1e3, "kN m": 1e3, "g/cm3": 1e3}


def value(list_element, path):
    """Parameter PATH ("Loads/Gravity") below an element of a deck, in SI units, or its text if it
    is not a number."""
    *lists, name = path.split("/")
    for one in lists:
        list_element = list_element.find(f"ParameterList[@name='{one}']")
    text = list_element.find(f"Parameter[@name='{name}']").get("value")
    number, _, unit = text.partition(" ")
    try:
        return float(number) * UNITS[unit]
    except (ValueError, KeyError):
        return text


def entries(text):
    """{2*pipe, bit} -> pipe, pipe, bit."""
    for entry in text.strip("{}").split(","):
        count, star, name = entry.strip().partition("*")
        yield from [name] * int(count) if star else [count]


def segments(deck):
    """(component, length, outer radius, inner radius) [m] of the string from the surface down."""
    scene = ET.parse(deck).getroot()
    library = ET.parse(deck.parent / value(scene, "Drillstring/Library")).getroot()

    def pieces(name):
        component = library.find(f"ParameterList[@name='{name}']")
        if component.find("Parameter[@name='Parts']") is None:
            return [
                tuple(value(component, key) for key in ("Length", "Outer Radius", "Inner Radius"))
            ]
        return [piece for part in entries(value(component, "Parts")) for piece in pieces(part)]

    return [(name, *piece) for name in entries(value(scene, "Drillstring/Assembly"))
            for piece in pieces(name)]


def loads(deck):
    """Weight on bit [N], torque on bit [N m], and the weight in mud per metre [N/m] as a function
    of the radii."""
    scene = ET.parse(deck).getroot()
    steel, mud, g = (value(scene, path)
                     for path in ("Drillstring/Material/Density", "Mud/Density", "Loads/Gravity"))
    return value(scene,
                 "Loads/Weight On Bit"), value(scene, "Loads/Torque On Bit"), lambda outer, inner: (
                     (steel - mud) * math.pi * (outer**2 - inner**2) * g)


def short(path):
    """The path for a shell in the working folder."""
    relative = os.path.relpath(path)
    return relative if os.sep in relative else os.path.join(".", relative)


def lines(label, command):
    """LABEL and a command, wrapped with the line continuation of a shell if it is wide."""
    text, width = label, len(label)
    for word in map(shlex.quote, command):
        if width + len(word) > COLUMNS - 2:
            text, width = text + "\\\n" + " " * len(label), len(label)
        text, width = text + word + " ", width + len(word) + 1
    return text.rstrip()


def run(program, folder, more):
    """Runs the scene into `folder` and returns its summary. Only warnings are printed; if the
    program fails, this script ends with the same exit code."""
    command = [short(program), "run", short(DECK), "--output", short(folder), "--quiet", *more]
    print(lines("== ", command), flush=True)
    code = subprocess.run(command, check=False).returncode
    if code:
        sys.exit(code)
    return json.loads((folder / "summary.json").read_text(encoding="utf-8"))


def figures(program, output):
    """All printed numbers."""
    reduced, full = run(program, output / "reduced", []), run(program, output / "full", FULL)
    compared = subprocess.run(
        [str(program), "compare",
         str(output / "reduced"),
         str(output / "full"), "--json"], stdout=subprocess.PIPE, check=True)
    weight_on_bit, torque_on_bit, in_mud = loads(DECK)
    string = segments(DECK)
    with h5py.File(output / "reduced" / "results.h5") as results:
        force, depth = results["/static/normal_force"][:], results["/model/s"][:]
    node = int(np.argmax(force))
    ends = np.cumsum([length for _, length, _, _ in string])
    errors = [(measure(summary) / bound, name, measure(summary), bound)
              for summary in (reduced, full) for name, measure, bound in checks.CHECKS]
    cpu = {
        name: s["transient"]["cpu_s"] / (s["transient"]["end"] - s["transient"]["start"])
        for name, s in (("reduced", reduced), ("full", full))
    }
    return {
        "dofs": {
            "reduced": reduced["reduction"]["reduced_dofs"], "full": full["model"]["free_dofs"]
        },
        "cpu_per_simulated_second": cpu,
        "speed_up": cpu["full"] / cpu["reduced"],
        "vibration_error": json.loads(compared.stdout)["vibration_error"],
        "hook_load": reduced["static"]["hook_load"],
        "weight_in_mud": sum(length * in_mud(outer, inner) for _, length, outer, inner in string),
        "weight_on_bit": weight_on_bit,
        "surface_torque": reduced["static"]["surface_torque"],
        "torque_on_bit": torque_on_bit,
        "side_force": {
            "value": float(force[node]),
            "depth": float(depth[node]),
            "component": string[int(np.searchsorted(ends, depth[node]))][0],
        },
        "bit_speed_rpm": reduced["transient"]["bit_speed_rpm"],
        "worst_check": dict(zip(("name", "value", "bound"),
                                max(errors)[1:])),
    }


def report(f, program, output):
    """The table and the summary."""
    wall = f["weight_in_mud"] - f["weight_on_bit"] - f["hook_load"]
    side, bit, check = f["side_force"], f["bit_speed_rpm"], f["worst_check"]
    hook = (f"weight in mud {f['weight_in_mud'] / 1e3:.1f} - on the bit "
            f"{f['weight_on_bit'] / 1e3:.1f} - on the wall {wall / 1e3:.1f}")
    friction = f["surface_torque"] - f["torque_on_bit"]
    torque = (f"torque on bit {f['torque_on_bit'] / 1e3:.2f} + friction on the wall "
              f"{friction / 1e3:.2f}")
    place = f"at a measured depth of {side['depth']:.1f} m, {side['component']}"
    verdict = "met" if check["value"] <= check["bound"] else "NOT MET"
    cpu = f["cpu_per_simulated_second"]
    return f"""
model      dofs   CPU s per simulated s   vibration error
full     {f['dofs']['full']:6d} {cpu['full']:23.3f}         (reference)
reduced  {f['dofs']['reduced']:6d} {cpu['reduced']:23.3f} {f['vibration_error']:17.2%}
The reduced model is {f['speed_up']:.1f} times as fast.

hook load           {f['hook_load'] / 1e3:7.1f} kN    {hook}
surface torque      {f['surface_torque'] / 1e3:7.2f} kN m  {torque}
largest side force  {side['value'] / 1e3:7.2f} kN    {place}
bit speed           {bit['mean']:7.1f} rpm   {bit['min']:.1f} to {bit['max']:.1f}
worst check         {verdict}: {check['name']} {check['value']:.1e}, bound {check['bound']:.0e}

open    {short(output / 'reduced' / 'report.html')}
        in a browser: figures, plots, the motion in space; results.png beside it is a picture
type    {short(program)} new my_well
        {short(program)} run my_well/my_well.xml"""


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/tooljoint")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("results/first_run"))
    options = parser.parse_args()
    found = figures(options.program, options.output)
    (options.output / "comparison.json").write_text(
        json.dumps(found, indent=2) + "\n", encoding="utf-8")
    drawing = [
        sys.executable,
        short(ROOT / "tools" / "plot_results.py"),
        short(options.output / "reduced")
    ]
    print(lines("== ", drawing), flush=True)
    subprocess.run(drawing, check=True, stdout=subprocess.DEVNULL)
    print(report(found, options.program, options.output))
    return 0 if found["worst_check"]["value"] <= found["worst_check"]["bound"] else 4


if __name__ == "__main__":
    sys.exit(main())
