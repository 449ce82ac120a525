#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A basis, an explicit and an implicit integrator outside of the library, each in a file of its own, named in decks.

    check_variants.py PROGRAM FOLDER MPIEXEC SOURCE

PROGRAM is tooljoint, FOLDER holds the shared objects of this folder, SOURCE the folder tests/.
"""
import csv
import pathlib
import signal
import subprocess
import sys
import time

import numpy as np
from check_extension import CREEP, END, FAST, PARTS, STIFFNESS, Checks, displacement, own_list


def chain(source, integrator, step, own="", end=END):
    """The deck of two masses that bounce off a creeping wall, a law with a state."""
    text = PARTS.format(part=source / "decks/parts/good", law=own_list(STIFFNESS, FAST, CREEP), integrator=integrator, step=step, end=end)
    return text.replace('<Parameter name="Step"', own + '<Parameter name="Step"')


def run_chain(checks, source, name, *arguments, **keywords):
    deck = pathlib.Path(f"{name}.xml")
    deck.write_text(chain(source, *arguments, **keywords), encoding="utf-8")
    summary = checks.run(deck, name)["transient"]
    return displacement(name), summary


def explicit(checks, source):
    """Heun errs by O(h^2), RK4 at a tenth of its step by nothing beside that."""
    exact, _ = run_chain(checks, source, "rk4", "RK4", 1e-4)
    errors = []
    for step in (1e-3, 5e-4):
        found, summary = run_chain(checks, source, f"heun_{step}", "Heun", step)
        errors.append(np.abs(found - exact).max() / np.abs(exact).max())
    # vibration of the stiffest mode, w = sqrt(1000) /s on the wall: phase error (w h)^2 / 6 per radian, a few radians of contact
    checks.expect(errors[0] < 5 * 1000 * 1e-3**2 / 6, f"Heun agrees with RK4, error {errors[0]:.1e}")
    checks.expect(3 < errors[0] / errors[1] < 5.5, f"and is of second order, {errors[0]:.1e} and {errors[1]:.1e}")
    measured(checks, "Heun", summary)


def implicit(checks, source):
    """Generalized-alpha with spectral radius 1 and without phase correction is the trapezoidal rule; what is left are the iterations."""
    alpha = """<ParameterList name="Generalized-alpha">
      <Parameter name="Spectral Radius" type="double" value="1"/>
      <Parameter name="Phase Correction" type="bool" value="false"/>
      <Parameter name="Tolerance" type="double" value="1e-10"/>
    </ParameterList>"""
    exact, known = run_chain(checks, source, "alpha", "Generalized-alpha", 5e-4, alpha)
    found, summary = run_chain(checks, source, "trapezoidal", "Trapezoidal", 5e-4)
    error = np.abs(found - exact).max() / np.abs(exact).max()
    checks.expect(error < 1e-7, f"Trapezoidal agrees with Generalized-alpha, error {error:.1e}")
    measured(checks, "Trapezoidal", summary)
    # the one has the third term of its series, the other a step and its halves, which differ by 3/4 of it
    ratio = summary["local_error"] / known["local_error"]
    checks.expect(0.4 < ratio < 1.2, f"the local error is that of Generalized-alpha, ratio {ratio:.2f}")


def measured(checks, name, summary):
    checks.expect(summary["integrator"] == name, f"{name} is named in the summary")
    checks.expect(abs(summary["energy_residual"]) < 1e-3, f"its ledger closes, residual {summary['energy_residual']:.1e}")
    checks.expect(0 < summary["local_error"] < 0.025 and summary["halving_error"] > 0,
                  f"its steps are measured: {summary['local_error']:.1e} and {summary['halving_error']:.1e}")


def coarse_steps(checks, source):
    """The chain alone, on a wall of no stiffness: w h = 1.0 and 0.4, of which a step loses about (w h)^2 / 16."""
    deck = pathlib.Path("coarse.xml")
    text = chain(source, "Trapezoidal", 0.25, end=250.0)
    deck.write_text(text.replace(f'value="{STIFFNESS}"', 'value="1e-9"').replace(f'value="{FAST}"', 'value="1e-9"'), encoding="utf-8")
    said = checks.output(deck, "coarse")
    checks.expect("warning: The time step (0.25 s) is too large: local error" in said and "Reduce Transient/Step." in said,
                  "steps that are too large are told")


def restart(checks, source, integrator):
    """An interrupted run that goes on ends with the same numbers as one that was not."""
    name = f"restart_{integrator}"
    deck = pathlib.Path(f"{name}.xml")
    deck.write_text(chain(source, integrator, 1e-4, end=150.0), encoding="utf-8")
    folder = pathlib.Path(f"{name}_interrupted")
    process = subprocess.Popen([checks.program, "run", str(deck), "--output", str(folder)], env=checks.environment, stdout=subprocess.DEVNULL)
    while process.poll() is None and not (folder / "checkpoint.bin").exists():
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    checks.expect(process.wait() == 130, f"{integrator} is interrupted")
    checks.run(deck, str(folder), "--restart", str(folder))
    checks.run(deck, f"{name}_whole")
    checks.expect(np.array_equal(displacement(str(folder)), displacement(f"{name}_whole")), f"{integrator} goes on with the same numbers")


def frequencies(checks, source, name, basis, own=""):
    scene = (source.parent / "examples/07_your_own_basis/scene.xml").read_text(encoding="utf-8").replace("../../xml", str(source.parent / "xml"))
    head, tail = scene.split('<ParameterList name="Reduction">')
    deck = pathlib.Path(f"{name}.xml")
    deck.write_text(f"""{head}<ParameterList name="Reduction">
    <Parameter name="Basis" type="string" value="{basis}"/>
    <ParameterList name="Mode Selection"><Parameter name="Modes" type="int" value="4"/></ParameterList>{own}
  </ParameterList>
</ParameterList>""", encoding="utf-8")
    checks.output(deck, name, command="modes")
    with open(pathlib.Path(name) / "modes.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return np.array([float(row[column]) for row in rows for column in row if column == "coupled [Hz]" and row[column]])


def basis(checks, source):
    """What the kept modes lack falls by (w_k / w_j)^2 with each step, j being the first vector beyond the subspace."""
    known = frequencies(checks, source, "craig_bampton", "Craig-Bampton")
    errors = []
    for steps in (1, 30):
        own = f'<ParameterList name="Inverse Subspace"><Parameter name="Steps" type="int" value="{steps}"/></ParameterList>'
        found = frequencies(checks, source, f"subspace_{steps}", "Inverse Subspace", own)
        errors.append(np.abs(found / known - 1).max())
    checks.expect(len(known) > 10, f"{len(known)} frequencies")
    checks.expect(errors[1] < 1e-7, f"a subspace that has converged gives the frequencies of Craig-Bampton, error {errors[1]:.1e}")
    checks.expect(errors[0] > 1e-5, f"one that has not gives others, error {errors[0]:.1e}")


def main():
    program, folder, mpiexec, source = sys.argv[1:5]
    objects = " ".join(f"{folder}/lib{name}.so" for name in ("CreepingWall", "Heun", "Trapezoidal", "InverseSubspace"))
    checks, source = Checks(program, objects, mpiexec), pathlib.Path(source)
    explicit(checks, source)
    implicit(checks, source)
    coarse_steps(checks, source)
    for integrator in ("Heun", "Trapezoidal"):
        restart(checks, source, integrator)
    basis(checks, source)
    return 1 if checks.failures else 0


if __name__ == "__main__":
    sys.exit(main())
