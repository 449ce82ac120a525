# SPDX-License-Identifier: BSD-3-Clause
"""Scenes, runs and tables that the checks of `tooljoint campbell` and `tooljoint response`
share."""
import csv
import json
import pathlib
import sys

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from checks import expect, tooljoint  # noqa: E402
from screens import expect_screen  # noqa: E402

SOURCES = pathlib.Path(sys.argv[3])
RPM = np.pi / 30
GYROSCOPIC = ('<ParameterList name="Omega"><Parameter name="Form" type="string" value="Constant"/>'
              '<ParameterList name="Constant"><Parameter name="Value" type="double" value="0"/>'
              '</ParameterList></ParameterList>')


def lists(name, inner):
    return f'<ParameterList name="{name}">{inner}</ParameterList>'


def values(**given):
    """Parameters of a list; blanks in a name are written as underscores."""
    kinds = {str: "string", int: "int", float: "double"}
    return "".join(
        f'<Parameter name="{key.replace("_", " ")}" type="{kinds[type(value)]}" value="{value}"/>'
        for key, value in given.items())


def part(path, components, mass, stiffness, damping=None, gyroscopic=None, terms=()):
    """A part in one file; `gyroscopic` is the gyroscopic matrix at unit speed, `terms` further
    stiffnesses (law, matrix)."""
    nodes = len(mass) // len(components)
    with h5py.File(path, "w") as f:
        f.attrs["format"] = "tooljoint part 1"
        f["components"] = components
        f["dofs"] = [[node + 1, c + 1] for node in range(nodes) for c in range(len(components))]
        f["mass"] = mass
        for name, law, matrix in (
            ("stiffness/structure", "1", stiffness),
            ("damping/structure", "1", damping),
            ("damping/gyroscopic", "Omega", gyroscopic),
                *((f"stiffness/{law}", law, matrix) for law, matrix in terms),
        ):
            if matrix is not None:
                f[name] = matrix
                f[name].attrs["law"] = law


def deck(name, file, analyses, laws="", reduction=""):
    whole = lists(
        "Parts",
        lists("Imported", lists("rotor", values(File=file))) +
        (lists("Laws", laws) if laws else ""))
    path = pathlib.Path(f"{name}.xml")
    path.write_text(lists(name, whole + reduction + analyses), encoding="utf-8")
    return str(path)


def table(folder, name):
    with open(pathlib.Path(folder) / f"{name}.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    return {key.split(" [")[0]: np.array([float(row[key]) for row in rows]) for key in rows[0]}


def run(command, scene, folder, *settings, ranks=1):
    arguments = [
        word for setting in settings
        for word in (("--without", setting[1:]) if setting.startswith("!") else ("--set", setting))
    ]
    done = tooljoint(command, scene, "--output", folder, *arguments, ranks=ranks, seconds=280)
    expect(f"{folder}: {command} ends well", done.returncode == 0, done.stderr
           or done.stdout[-600:])
    expect_screen(done, folder, command)
    return done


def close(what, found, exact, tolerance):
    error = np.max(np.abs(np.asarray(found) - exact) / np.max(np.abs(exact)))
    expect(f"{what}: largest difference {error:.1e}, allowed {tolerance:.0e}", error <= tolerance)


def modes_at(rows, speed):
    here = np.abs(rows["speed"] - speed) < 1e-9 * (1 + speed)
    return {key: column[here] for key, column in rows.items()}


def estimates(folder):
    """Compares the errors of the spot checks with their estimates, if they are more than
    rounding."""
    checks = table(folder, "spot_checks")
    large = checks["error"] > 1e-8
    expect(f"{folder}: the spot checks found the modes", np.all(checks["mac"] > 0.9), checks["mac"])
    expect(
        f"{folder}: {np.sum(large)} errors up to {checks['error'].max():.1e} within a factor of 2 "
        "of the estimates",
        np.all(checks["error"][large] < 2 * checks["estimate"][large])
        and np.all(checks["estimate"][large] < 2 * checks["error"][large] + 1e-8),
        np.c_[checks["full"], checks["error"], checks["estimate"]][large])


# Assembly of the reference scene with half of its pipes and collars.
SHORTER = "{pipe, last pipe, collar, stabiliser, 2*collar, stabiliser, collar, bit}"

SHAFT = """<ParameterList name="shaft">
  <ParameterList name="Well"><Parameter name="Trajectory" type="string" value="Vertical"/>
  <Parameter name="Bore Radius" type="double" value="1"/>
    <ParameterList name="Vertical">
    <Parameter name="Length" type="double" value="2"/></ParameterList></ParameterList>
  <ParameterList name="Supports"><Parameter name="Top" type="string" value="u v w theta_z"/>
  <Parameter name="Bit" type="string" value="u v"/></ParameterList>
  <ParameterList name="Drillstring"><ParameterList name="Components"><ParameterList name="bar">
  <Parameter name="Length" type="double" value="2"/>
    <Parameter name="Elements" type="int" value="40"/>
    <Parameter name="Outer Radius" type="double" value="0.1"/>
    <Parameter name="Inner Radius" type="double" value="0"/></ParameterList></ParameterList>
    <Parameter name="Assembly" type="Array(string)" value="{bar}"/></ParameterList>
  <ParameterList name="Rotary Speed"><Parameter name="Law" type="string" value="Constant"/>
  <ParameterList name="Constant">
  <Parameter name="Speed" type="double" value="1"/></ParameterList></ParameterList>
  <ParameterList name="Campbell"><Parameter name="Highest Speed" type="double" value="4000"/>
  <Parameter name="Points" type="int" value="9"/><Parameter name="Modes" type="int" value="4"/>
    <Parameter name="Orders" type="Array(double)" value="{1}"/></ParameterList>
</ParameterList>
"""


def material():
    """Young's modulus, Poisson's ratio and density of a deck without the list Material."""
    manual = json.loads(tooljoint("doc", "--format", "json").stdout)
    bar = next(one for one in manual[0]["lists"]
               if one["name"] == "Drillstring") if isinstance(manual, list) else next(
                   one for one in manual["lists"] if one["name"] == "Drillstring")
    number = {one["name"]: one.get("default") for one in bar["parameters"]}
    return tuple(
        float(number.get(name, default) or default)
        for name, default in (("Young Modulus", 2.1e11), ("Poisson Ratio", 0.3), ("Density", 7850)))
