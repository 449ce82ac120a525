#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A point law outside of the library, in a separate file, between parts and in the bore.

    check_extension.py PROGRAM MPIEXEC FOLDER SOURCE

PROGRAM is tooljoint, FOLDER has the shared objects of this folder, SOURCE is the folder tests/.
"""
import json
import os
import pathlib
import re
import sys

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from checks import expect, finish, tooljoint  # noqa: E402

STIFFNESS, FAST, CREEP = 400.0, 600.0, 0.05  # of the wall between parts
END = 1.0

PARTS = """<ParameterList name="chain">
  <ParameterList name="Parts">
    <ParameterList name="Imported">
      <ParameterList name="a">
        <Parameter name="File" type="string" value="{part}"/>
        <Parameter name="Fixed" type="Array(string)" value="{{1}}"/>
      </ParameterList>
    </ParameterList>
    <ParameterList name="Starts">
      <ParameterList name="kick">
        <Parameter name="Part" type="string" value="a"/>
        <Parameter name="Node" type="int" value="3"/>
        <Parameter name="Component" type="string" value="u"/>
        <Parameter name="Velocity" type="double" value="-1"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Coupling">
    <ParameterList name="Point Laws">
      <ParameterList name="wall">
        <Parameter name="Type" type="string" value="Creeping Wall"/>
        <Parameter name="First" type="string" value="a:3"/>
        <Parameter name="Component" type="string" value="u"/>
        {law}
      </ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Transient">
    <Parameter name="Integrator" type="string" value="{integrator}"/>
    <Parameter name="End Time" type="double" value="{end}"/>
    <Parameter name="Sampling Interval" type="double" value="0.05"/>
    <Parameter name="Step" type="double" value="{step}"/>
  </ParameterList>
</ParameterList>
"""


def own_list(stiffness, fast, creep):
    return f"""<ParameterList name="Creeping Wall">
          <Parameter name="Stiffness" type="double" value="{stiffness}"/>
          <Parameter name="Fast Stiffness" type="double" value="{fast}"/>
          <Parameter name="Creep Time" type="double" value="{creep}"/>
        </ParameterList>"""


def contact_list(law, own):
    return f"""<ParameterList name="Contact">
    <Parameter name="Law" type="string" value="{law}"/>
    <Parameter name="Stiffness" type="double" value="1e7"/>
    {own}
  </ParameterList>
"""


def load(*names):
    """Makes programs started from here load these extensions; returns SOURCE."""
    folder, source = sys.argv[3:5]
    os.environ["LD_PRELOAD"] = " ".join(f"{folder}/lib{name}.so" for name in names)
    return pathlib.Path(source)


def output(deck, folder, *arguments, ranks=1, command="run", code=0):
    """Output of a command."""
    done = tooljoint(command, str(deck), "--output", folder, *arguments, ranks=ranks)
    expect(f"{folder} ends with {code}", done.returncode == code, done.stdout + done.stderr)
    return done.stdout + done.stderr


def run(deck, folder, *arguments, ranks=1):
    """The summary of a run."""
    output(deck, folder, *arguments, ranks=ranks)
    return json.loads((pathlib.Path(folder) / "summary.json").read_text(encoding="utf-8"))


def displacement(folder):
    with h5py.File(f"{folder}/results.h5") as file:
        return file["/transient/displacement"][...].reshape(len(file["/transient/time"]), -1)


def reference(times):
    """Displacements of nodes 2 and 3 by classical Runge-Kutta steps: masses 2 and 1 kg, springs of
    10 N/m, the law at node 3."""
    def rate(y):
        u2, u3, v2, v3, x = y
        p = max(0.0, -u3)
        f = max(0.0, STIFFNESS * p + FAST * (p - x)) if p > 0 else 0.0
        return np.array(
            [v2, v3, (-20 * u2 + 10 * u3) / 2, (10 * u2 - 10 * u3 + f) / 1, (p - x) / CREEP])

    y, t, h, found = np.array([0.0, 0.0, 0.0, -1.0, 0.0]), 0.0, 1e-4, []
    for target in times:
        while t < target - h / 2:
            a = rate(y)
            b = rate(y + h / 2 * a)
            c = rate(y + h / 2 * b)
            y = y + h / 6 * (a + 2 * b + 2 * c + rate(y + h * c))
            t += h
        found.append(y[:2])
    return np.array(found)


def between_parts(source):
    exact = reference(np.arange(0, END + 1e-9, 0.05))
    size = np.abs(exact).max()
    for integrator, step, tolerance in [("RK4", 1e-4, 1e-6), ("Generalized-alpha", 5e-4, 1e-3)]:
        deck = pathlib.Path(f"{integrator}.xml")
        deck.write_text(
            PARTS.format(part=source / "decks/parts/good", law=own_list(STIFFNESS, FAST, CREEP),
                         integrator=integrator, step=step, end=END), encoding="utf-8")
        run(deck, f"parts_{integrator}")
        found = displacement(f"parts_{integrator}")
        error = np.abs(found[:, -2:] - exact).max() / size
        expect(
            f"{integrator}: the chain bounces off the creeping wall as computed here, error "
            f"{error:.1e}", error < tolerance)
        run(deck, f"parts_{integrator}_np2", ranks=2)
        expect(f"{integrator}: the same on two ranks",
               np.array_equal(found, displacement(f"parts_{integrator}_np2")))


def in_the_bore(source):
    scene = (source / "effects/scene.xml").read_text(encoding="utf-8")
    summaries = {}
    for name, contact in [
        ("elastic", contact_list("Hunt-Crossley", "")),
        ("creeping", contact_list("Creeping Wall", own_list(1e7, 3e7, 0.01))),
    ]:
        text, count = re.subn(r'<ParameterList name="Contact">.*?\n  </ParameterList>\n', contact,
                              scene, flags=re.DOTALL)
        expect("the scene has one list Contact", count == 1)
        deck = pathlib.Path(f"{name}.xml")
        deck.write_text(text, encoding="utf-8")
        summaries[name] = run(deck, f"bore_{name}")
    elastic, creeping = summaries["elastic"], summaries["creeping"]
    nodes = creeping["static"]["contact_nodes"]
    expect(f"{nodes} nodes rest on the creeping wall",
           nodes == elastic["static"]["contact_nodes"] > 0)
    for key in ("total_normal_force", "max_normal_force"):
        ratio = creeping["static"][key] / elastic["static"][key]
        expect(f"at rest it is an elastic wall: {key} {ratio - 1:+.1e}", abs(ratio - 1) < 1e-6)
    with h5py.File("bore_creeping/results.h5") as file:
        first, static = file["/transient/normal_force"][0], file["/static/normal_force"][...]
        expect("the motion starts with the forces of the static state",
               np.abs(first - static).max() < 1e-6 * static.max())
    moved = np.abs(displacement("bore_creeping")[-1] - displacement("bore_elastic")[-1]).max()
    expect(f"and moves otherwise than on an elastic wall, by {moved:.1e} m", moved > 1e-9)
    residual = abs(creeping["transient"]["energy_residual"])
    expect(f"its ledger closes, residual {residual:.1e}", residual < 0.02)
    run("creeping.xml", "bore_creeping_np2", ranks=2)
    expect(
        "the same on two ranks",
        np.allclose(displacement("bore_creeping"), displacement("bore_creeping_np2"), rtol=0,
                    atol=1e-9))


def main():
    source = load("CreepingWall")
    between_parts(source)
    in_the_bore(source)
    return finish()


if __name__ == "__main__":
    sys.exit(main())
