#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The first scene of a user: tools/first_run.py runs, its figures agree with a calculation by
hand, and the reduced model is faster.

    check_first_run.py PROGRAM PROJECT

By hand, with w the weight in mud per metre, Z the vertical depth, N the contact force, R its lever
arm and mu(v) the friction curve (Nguyen et al. 2020, eq. 9) at the sliding speed v = Omega R:

    hook load = sum w dZ - weight on bit
    (friction acts around the hole, so none of it along)
    torque    = torque on bit + sum mu(Omega R) N R

The hook load neglects the bending of the string and that the force of the top element is the mean
of its ends: tolerance 0.1 %. The torque is exact: tolerance 0.1 %.
"""
import json
import math
import pathlib
import subprocess
import sys

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from checks import wide  # noqa: E402

MU_STATIC, MU_DYNAMIC, V_R, OMEGA = 0.3, 0.25, 0.1, 120 * math.pi / 30


def friction(v):
    xi = math.sqrt(1 - MU_DYNAMIC / MU_STATIC)
    q = 1 / (1 + (1 - xi) / (2 * V_R * MU_DYNAMIC) * v)
    return v / (2 * V_R) * ((1 - xi) * q + (1 + xi) * q * q)


def main():
    program, project = sys.argv[1], pathlib.Path(sys.argv[2])
    sys.path.insert(0, str(project / "tools"))
    import first_run

    out = pathlib.Path("first_run")
    said = subprocess.run(
        [sys.executable, project / "tools" / "first_run.py", "--program", program, "--output", out],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    print(said.stdout)
    faults = [] if said.returncode == 0 else [f"exit code {said.returncode}"]
    found = json.loads((out / "comparison.json").read_text(encoding="utf-8"))

    def check(name, value, low, high):
        print(f"{name}: {value:.6g}, from {low:.6g} to {high:.6g}")
        if not low <= value <= high:
            faults.append(name)

    weight_on_bit, torque_on_bit, in_mud = first_run.loads(first_run.DECK)
    string = first_run.segments(first_run.DECK)
    with h5py.File(out / "reduced" / "results.h5") as results:
        depth, vertical = results["/model/s"][:], results["/model/position"][:, 2]
        force, arm = results["/static/normal_force"][:], results["/model/contact_radius"][:]
    ends = np.concatenate(([0.0], np.cumsum([length for _, length, _, _ in string])))
    check("length of the string [m]", ends[-1], depth[-1] - 1e-6, depth[-1] + 1e-6)
    weight = np.array([in_mud(outer, inner) for _, _, outer, inner in string])
    hook = (weight * np.diff(np.interp(ends, depth, vertical))).sum() - weight_on_bit
    torque = torque_on_bit + sum(friction(OMEGA * r) * n * r for n, r in zip(force, arm))
    check("hook load [N]", found["hook_load"], 0.999 * hook, 1.001 * hook)
    check("surface torque [N m]", found["surface_torque"], 0.999 * torque, 1.001 * torque)
    check("friction in the torque [N m]", found["surface_torque"] - torque_on_bit, 50,
          500)  # there is some
    check("largest side force [N]", found["side_force"]["value"],
          force.max() * (1 - 1e-9),
          force.max() * (1 + 1e-9))
    # Speed-up by reduction. CPU times vary by about a fifth on a busy machine; 3.5 was measured on
    # an idle one.
    check("dofs left", found["dofs"]["reduced"] / found["dofs"]["full"], 0.0, 0.2)
    check("vibration error", found["vibration_error"], 1e-6, 0.01)
    check("speed-up", found["speed_up"], 1.5, 20)
    for words in ("vibration error", "times as fast", "hook load", "surface torque",
                  "largest side force", "string stabiliser", "bit speed", "worst check",
                  "results.png", "new my_well"):
        if words not in said.stdout:
            faults.append(f"it does not print \"{words}\"")
    printed = said.stdout.splitlines()
    faults += [f"a line of {len(line)} columns: {line}" for line in wide(said.stdout)]
    if len(printed) > 25 or sum(line.startswith("hook load") for line in printed) != 1:
        faults.append(f"{len(printed)} lines instead of a short log with one summary")
    if not (out / "reduced" / "results.png").is_file():
        faults.append("no picture")
    print("wrong: " + "; ".join(faults) if faults else "all as it should be")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
