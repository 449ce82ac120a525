#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""An element, a load and a mud model outside of the library, each in a separate file, against
closed forms.

    check_string.py PROGRAM MPIEXEC FOLDER

PROGRAM is tooljoint, FOLDER has the shared objects libRod.so, libWallDrag.so and libCuttings.so.
The string hangs in a vertical well: `pipe` above, `tool` below, PIPE and TOOL metres long.
"""
import csv
import json
import math
import os
import pathlib
import sys

import h5py

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from checks import expect, finish, tooljoint  # noqa: E402

E, NU, RHO, G = 2.1e11, 0.3, 7850.0, 9.81
OUTER, INNER = 0.06, 0.05
AREA = math.pi * (OUTER**2 - INNER**2)
PIPE, TOOL, ELEMENTS = 120.0, 80.0, 40
FACTOR = 0.25  # factor on E S of the rods

DECK = """<ParameterList name="string">
  <ParameterList name="Well">
    <Parameter name="Trajectory" type="string" value="Vertical"/>
    <ParameterList name="Vertical">
      <Parameter name="Length" type="double" value="300"/>
    </ParameterList>
    <Parameter name="Bore Radius" type="double" value="0.108"/>
  </ParameterList>
  <ParameterList name="Drillstring">
    <Parameter name="Assembly" type="Array(string)" value="{{pipe, tool}}"/>
    <ParameterList name="Components">
      {pipe}
      {tool}
    </ParameterList>
    <ParameterList name="Material">
      <Parameter name="Density" type="double" value="7850"/>
      <Parameter name="Young Modulus" type="double" value="2.1e11"/>
      <Parameter name="Poisson Ratio" type="double" value="0.3"/>
    </ParameterList>
  </ParameterList>
  {supports}
  {mud}
  <ParameterList name="Loads">
    <Parameter name="Gravity" type="double" value="9.81"/>
    <Parameter name="Weight On Bit" type="double" value="{weight_on_bit}"/>
    {loads}
  </ParameterList>
</ParameterList>
"""
ROD = f"""<Parameter name="Element" type="string" value="Rod"/>
        <ParameterList name="Rod">
          <Parameter name="Axial Factor" type="double" value="{FACTOR}"/>
        </ParameterList>"""
GUIDE = f"""<ParameterList name="Supports">
    <ParameterList name="guide">
      <Parameter name="Node" type="int" value="{ELEMENTS + 1}"/>
      <Parameter name="Dofs" type="string" value="u v"/>
    </ParameterList>
  </ParameterList>"""
WALL = """<ParameterList name="Contact">
    <Parameter name="Stiffness" type="double" value="1e6"/>
    <ParameterList name="Friction">
      <Parameter name="Static" type="double" value="0.3"/>
      <Parameter name="Dynamic" type="double" value="0.3"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Torque and Drag"/>"""
DRAG = """<ParameterList name="Wall Drag">
      <Parameter name="From" type="double" value="31"/>
      <Parameter name="To" type="double" value="154"/>
      <Parameter name="Force Per Length" type="double" value="{drag}"/>
    </ParameterList>"""
PUSH = """<ParameterList name="Forces">
      <ParameterList name="push">
        <Parameter name="Node" type="int" value="{node}"/>
        <Parameter name="Component" type="string" value="w"/>
        <Parameter name="Value" type="double" value="{force}"/>
        <Parameter name="End Time" type="double" value="{end}"/>
      </ParameterList>
    </ParameterList>"""
MOTION = """<ParameterList name="Transient">
    <Parameter name="End Time" type="double" value="{end}"/>
    <Parameter name="Sampling Interval" type="double" value="0.01"/>
    <Parameter name="Step" type="double" value="2e-4"/>
  </ParameterList>"""
PARTS = """<ParameterList name="Substructures">
    <Parameter name="Rule" type="string" value="By component"/>
  </ParameterList>
  <ParameterList name="Reduction">
    <ParameterList name="Mode Selection">
    <Parameter name="Modes" type="int" value="40"/></ParameterList>
  </ParameterList>
  """
MUD = """<ParameterList name="Mud">
    <Parameter name="Model" type="string" value="Cuttings"/>
    <Parameter name="Density" type="double" value="1200"/>
    <ParameterList name="Cuttings">
      <Parameter name="Cuttings Density" type="double" value="300"/>
    </ParameterList>
  </ParameterList>"""


def component(name, length, element=""):
    return f"""<ParameterList name="{name}">
        <Parameter name="Length" type="double" value="{length}"/>
        <Parameter name="Elements" type="int" value="{ELEMENTS}"/>
        <Parameter name="Outer Radius" type="double" value="{OUTER}"/>
        <Parameter name="Inner Radius" type="double" value="{INNER}"/>
        {element}
      </ParameterList>"""


def close(found, exact, tolerance, what):
    error = abs(found - exact) / abs(exact)
    expect(f"{what}: {found:.9g}, exact {exact:.9g}, relative error {error:.1e}", error < tolerance)


def call(*words, code=0):
    """Output of a command."""
    done = tooljoint(*words)
    expect(f"tooljoint {' '.join(words)} ends with {code}", done.returncode == code,
           done.stdout + done.stderr)
    return done.stdout + done.stderr


def written(name, weight_on_bit=0.0, rods=("tool",), supports=GUIDE, mud="", loads=""):
    """The file of a deck."""
    parts = {
        part: component(part, length, ROD if part in rods else "")
        for part, length in (("pipe", PIPE), ("tool", TOOL))
    }
    path = pathlib.Path(f"{name}.xml")
    path.write_text(
        DECK.format(**parts, weight_on_bit=weight_on_bit, supports=supports, mud=mud, loads=loads),
        encoding="utf-8")
    return str(path)


def rest(name, **choices):
    """w of the bit and axial force of the first element at rest."""
    call("run", written(name, **choices), "--output", name)
    summary = json.loads((pathlib.Path(name) / "summary.json").read_text(encoding="utf-8"))
    with h5py.File(f"{name}/results.h5") as file:
        return file["/static/displacement"][
            -1, 2], summary["static"]["top_axial_force"], summary["model"]["free_dofs"]


def stretch_under_weight(length_above, length, stiffness, area):
    """Elongation of a piece by gravity, with a string of `length_above` below it."""
    return RHO * area * G * (length_above * length + length**2 / 2) / stiffness


def an_element():
    """Rods below pipes: their compliances add up; rods alone: frequencies of a rod fixed at its
    top."""
    force = 2e4
    free, _, dofs = rest("rods")
    pressed, _, _ = rest("rods_pressed", weight_on_bit=force)
    compliance = (PIPE + TOOL / FACTOR) / (E * AREA)
    close(free - pressed, force * compliance, 1e-9,
          "the weight on bit shortens pipe and rods by F (L1/ES + L2/(factor ES))")
    hanging = stretch_under_weight(TOOL, PIPE, E * AREA, AREA) + stretch_under_weight(
        0, TOOL, FACTOR * E * AREA, AREA)
    close(free, hanging, 1e-9, "their weight stretches them as it stretches rods")
    held = 4 + 2  # u v w theta_z of the top, u v of the guide
    expect(f"{dofs} free dofs: nodes of rods alone have two",
           dofs == 6 * (ELEMENTS + 1) - held + 2 * ELEMENTS)

    call("modes", written("rods_alone", rods=("pipe", "tool"), supports=""), "--output", "modes",
         "--count", "4")
    with open("modes/modes.csv", encoding="utf-8") as file:
        lines = [line for line in file if not line.startswith("#")]
    found = [float(row[1]) for row in list(csv.reader(lines))[1:]]
    speeds = {
        "axial": math.sqrt(FACTOR * E / RHO),
        "torsional": math.sqrt(E / (2 * (1 + NU)) / RHO),
    }
    exact = sorted((2 * n - 1) * speed / (4 * (PIPE + TOOL)) for n in (1, 2, 3)
                   for speed in speeds.values())[:4]
    # linear shape functions: (k h)^2/24 too high, k h = (2n - 1) pi/(4 ELEMENTS) on average
    for n, (frequency, closed) in enumerate(zip(found, exact), 1):
        close(frequency, closed, 2e-3, f"frequency {n} of the rods [Hz]")
    expect("four frequencies listed", len(found) == 4)


def a_wave():
    """A force on the free end of the rods moves it at F/(A sqrt(factor E rho)) until the wave
    returns, in the full model and in a reduced one."""
    force, end = 1e4, 0.12
    speed = force / (AREA * math.sqrt(FACTOR * E * RHO))
    expect("the wave is not back yet", end < 2 * (PIPE + TOOL) / math.sqrt(FACTOR * E / RHO))
    loads = PUSH.format(node=2 * ELEMENTS + 1, force=force, end=end)
    for name, parts in (("full", ""), ("reduced", PARTS)):
        deck = written(f"wave_{name}", rods=("pipe", "tool"),
                       supports=parts + MOTION.format(end=end), loads=loads)
        call("run", deck, "--output", f"wave_{name}")
        with h5py.File(f"wave_{name}/results.h5") as file:
            w = file["/transient/displacement"][:, -1, 2]
        # the front is as wide as an element of 2.5 m, 1 % of the 310 m it has travelled
        close(w[-1] - w[0], speed * end, 1e-2, f"way of the free end in {end} s, {name} model")


def a_load():
    """Drag between two depths acts below the top and does not depend on the elements; both ends of
    the interval lie inside elements."""
    total = 50.0 * (154 - 31)
    _, dry, _ = rest("dry")
    _, dragged, _ = rest("dragged", loads=DRAG.format(drag=50.0))
    close(dry - dragged, total, 1e-9, "the drag takes its sum off the axial force at the top")
    shown = call("check", "dragged.xml")
    expect("check names the load and its size", "wall drag" in shown and "6150" in shown)
    soft = written("dragged_soft", rods=(), supports=WALL, loads=DRAG.format(drag=50.0))
    said = " ".join(call("torque-drag", soft, "--output", "dragged_soft").split())
    expect("torque and drag says that it leaves the load out",
           'The load "wall drag" is not part of torque and drag' in said)
    wrong = written("wrong", loads=DRAG.format(drag=50.0).replace('value="154"', 'value="3"'))
    expect("a senseless load is refused", "ends (To) before it starts"
           in call("check", wrong, code=2))


def a_load_that_fails_on_one_rank():
    """The other ranks wait for the failed rank in their next message; it ends them with its message
    and code."""
    os.environ["WALL_DRAG_FAILS_ON"] = "1"
    deck = written("fails", loads=DRAG.format(drag=50.0))
    done = tooljoint("run", deck, "--output", "fails", ranks=2, seconds=60)
    del os.environ["WALL_DRAG_FAILS_ON"]
    said = " ".join(done.stderr.split())
    expect(
        "a rank that fails alone says so and ends all", done.returncode == 3
        and "rank 1 alone: Loads/Wall Drag fails, as the test wants." in said,
        f"{done.returncode} {said[-400:]}")


def a_changed_library():
    """Rows that an earlier build of an extension computed are computed again."""
    deck = written("kept", rods=(), supports=WALL, loads=DRAG.format(drag=50.0))
    known = "are known from before"
    command = ("torque-drag", deck, "--output", "kept", "--set",
               "Torque and Drag/Depths={100, 200}")
    call(*command)
    shown = call(*command)
    expect("rows of the same libraries are kept", known in " ".join(shown.split()), shown)
    library = pathlib.Path(sys.argv[3]) / "libRod.so"
    times = library.stat()
    os.utime(library, ns=(times.st_atime_ns, times.st_mtime_ns + 10**9))
    expect("rows of a library that was built again are not", known
           not in " ".join(call(*command).split()))
    os.utime(library, ns=(times.st_atime_ns, times.st_mtime_ns))


def a_mud_model():
    """Buoyancy with a denser mud outside."""
    _, dry, _ = rest("no_mud")
    _, wet, _ = rest("mud", mud=MUD)
    buoyancy = math.pi * (1200 * INNER**2 - 1500 * OUTER**2)
    close(wet / dry, 1 + buoyancy / (RHO * AREA), 1e-9, "the mud takes its share off the weight")


def the_manual():
    """The manual has names, parameters and units of all three."""
    manual = json.dumps(json.loads(call("doc", "--format", "json")))
    for word in ('"Rod"', '"Axial Factor"', '"Wall Drag"', '"Force Per Length"', '"Cuttings"',
                 '"Cuttings Density"'):
        expect(f"the manual has {word}", word in manual)


def main():
    os.environ["LD_PRELOAD"] = " ".join(
        f"{sys.argv[3]}/lib{name}.so" for name in ("Rod", "WallDrag", "Cuttings"))
    an_element()
    a_wave()
    a_load()
    a_load_that_fails_on_one_rank()
    a_changed_library()
    a_mud_model()
    the_manual()
    return finish()


if __name__ == "__main__":
    sys.exit(main())
