#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A basis, an explicit and an implicit integrator outside of the library, each in a separate file,
used in decks.

    check_variants.py PROGRAM MPIEXEC FOLDER SOURCE

PROGRAM is tooljoint, FOLDER has the shared objects of this folder, SOURCE is the folder tests/.
"""
import csv
import pathlib
import signal
import subprocess
import sys
import time

import numpy as np
from check_extension import (CREEP, END, FAST, PARTS, STIFFNESS, displacement, expect, finish, load,
                             output, own_list, run)


def chain(source, integrator, step, own="", end=END):
    """The deck of two masses that bounce off a creeping wall, a law with a state."""
    text = PARTS.format(part=source / "decks/parts/good", law=own_list(STIFFNESS, FAST, CREEP),
                        integrator=integrator, step=step, end=end)
    return text.replace('<Parameter name="Step"', own + '<Parameter name="Step"')


def run_chain(source, name, *arguments, **keywords):
    deck = pathlib.Path(f"{name}.xml")
    deck.write_text(chain(source, *arguments, **keywords), encoding="utf-8")
    summary = run(deck, name)["transient"]
    return displacement(name), summary


def explicit(source):
    """The error of Heun is O(h^2); that of RK4 at a tenth of the step is negligible."""
    exact, _ = run_chain(source, "rk4", "RK4", 1e-4)
    errors = []
    for step in (1e-3, 5e-4):
        found, summary = run_chain(source, f"heun_{step}", "Heun", step)
        errors.append(np.abs(found - exact).max() / np.abs(exact).max())
    # vibration of the stiffest mode, w = sqrt(1000) /s on the wall: phase error (w h)^2 / 6 per
    # radian, a few radians of contact
    expect(f"Heun agrees with RK4, error {errors[0]:.1e}", errors[0] < 5 * 1000 * 1e-3**2 / 6)
    expect(f"and is of second order, {errors[0]:.1e} and {errors[1]:.1e}",
           3 < errors[0] / errors[1] < 5.5)
    measured("Heun", summary)


def implicit(source):
    """Generalized-alpha with spectral radius 1 and without phase correction is the trapezoidal
    rule; the difference comes from the iterations."""
    alpha = """<ParameterList name="Generalized-alpha">
      <Parameter name="Spectral Radius" type="double" value="1"/>
      <Parameter name="Phase Correction" type="bool" value="false"/>
      <Parameter name="Tolerance" type="double" value="1e-10"/>
    </ParameterList>"""
    exact, known = run_chain(source, "alpha", "Generalized-alpha", 5e-4, alpha)
    found, summary = run_chain(source, "trapezoidal", "Trapezoidal", 5e-4)
    error = np.abs(found - exact).max() / np.abs(exact).max()
    expect(f"Trapezoidal agrees with Generalized-alpha, error {error:.1e}", error < 1e-7)
    measured("Trapezoidal", summary)
    ratio = summary["step_error"] / known["step_error"]
    expect(f"the step error is that of Generalized-alpha, ratio {ratio:.3f}", 0.95 < ratio < 1.05)


def measured(name, summary):
    expect(f"{name} is named in the summary", summary["integrator"] == name)
    expect(f"its ledger closes, residual {summary['energy_residual']:.1e}",
           abs(summary["energy_residual"]) < 1e-3)
    expect(f"its steps are measured: {summary['step_error']:.1e}", 0 < summary["step_error"] < 0.05)


def coarse_steps(source):
    """The chain alone, on a wall without stiffness: w h = 2.0 and 0.8. For phases w 3 s of 12 and 5
    rad, the phase errors of steps exceed those of their halves by a share of (w h)^2 / 16: 3 and
    0.2 rad."""
    deck = pathlib.Path("coarse.xml")
    text = chain(source, "Trapezoidal", 0.5, end=250.0)
    deck.write_text(
        text.replace(f'value="{STIFFNESS}"',
                     'value="1e-9"').replace(f'value="{FAST}"', 'value="1e-9"'), encoding="utf-8")
    said = output(deck, "coarse", code=4)
    expect(
        "steps that are too large are refused",
        "The time step (0.5 s) is too large: step error" in said
        and "Reduce Transient/Step." in said)


def restart(source, integrator):
    """An interrupted and continued run ends with the same numbers as an uninterrupted one."""
    name = f"restart_{integrator}"
    deck = pathlib.Path(f"{name}.xml")
    deck.write_text(chain(source, integrator, 1e-4, end=150.0), encoding="utf-8")
    folder = pathlib.Path(f"{name}_interrupted")
    process = subprocess.Popen(
        [sys.argv[1], "run", str(deck), "--output",
         str(folder)], stdout=subprocess.DEVNULL)
    while process.poll() is None and not (folder / "checkpoint.bin").exists():
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    expect(f"{integrator} is interrupted", process.wait() == 130)
    run(deck, str(folder), "--restart", str(folder))
    run(deck, f"{name}_whole")
    expect(f"{integrator} goes on with the same numbers",
           np.array_equal(displacement(str(folder)), displacement(f"{name}_whole")))


def frequencies(source, name, basis, own=""):
    scene = (source.parent / "examples/07_your_own_basis/scene.xml").read_text(
        encoding="utf-8").replace("../../xml", str(source.parent / "xml"))
    head, tail = scene.split('<ParameterList name="Reduction">')
    deck = pathlib.Path(f"{name}.xml")
    deck.write_text(
        f"""{head}<ParameterList name="Reduction">
    <Parameter name="Basis" type="string" value="{basis}"/>
    <ParameterList name="Mode Selection">
    <Parameter name="Modes" type="int" value="4"/></ParameterList>{own}
  </ParameterList>
</ParameterList>""", encoding="utf-8")
    output(deck, name, command="modes")
    with open(pathlib.Path(name) / "modes.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return np.array([
        float(row[column]) for row in rows for column in row
        if column == "coupled [Hz]" and row[column]
    ])


def basis(source):
    """The error of the kept modes decreases by (w_k / w_j)^2 with each step; j is the first vector
    outside the subspace."""
    known = frequencies(source, "craig_bampton", "Craig-Bampton")
    errors = []
    for steps in (1, 30):
        own = ('<ParameterList name="Inverse Subspace"><Parameter name="Steps" type="int" '
               f'value="{steps}"/></ParameterList>')
        found = frequencies(source, f"subspace_{steps}", "Inverse Subspace", own)
        errors.append(np.abs(found / known - 1).max())
    expect(f"{len(known)} frequencies", len(known) > 10)
    expect(
        "a subspace that has converged gives the frequencies of Craig-Bampton, error "
        f"{errors[1]:.1e}", errors[1] < 1e-7)
    expect(f"one that has not gives others, error {errors[0]:.1e}", errors[0] > 1e-5)


def main():
    source = load("CreepingWall", "Heun", "Trapezoidal", "InverseSubspace")
    explicit(source)
    implicit(source)
    coarse_steps(source)
    for integrator in ("Heun", "Trapezoidal"):
        restart(source, integrator)
    basis(source)
    return finish()


if __name__ == "__main__":
    sys.exit(main())
