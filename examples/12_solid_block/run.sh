#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Reduces a solid block on two meshes and compares its lowest frequencies with those of a bar and of a beam.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
python=python3
"$python" -c "import h5py, scipy" 2> /dev/null || python=/usr/bin/python3
cp "$here/deck.xml" .
for mesh in "16 4 2" "32 8 4"; do
  # shellcheck disable=SC2086
  "$python" "$here/make_block.py" $mesh --joined 6
  tooljoint modes deck.xml --count 8 --output "modes_${mesh%% *}"
done
"$python" - <<'PY'
import csv, sys
import numpy as np

E, nu, rho, L = 2.06e11, 0.3, 7850.0, 0.8

def beam(b, h):
    """First frequency of a clamped Timoshenko beam by Dunkerley: bending, and shear with the coefficient of Cowper (1966)."""
    A, I, G, k = b * h, b * h**3 / 12, E / 2 / (1 + nu), 10 * (1 + nu) / (12 + 11 * nu)
    bending = 1.8751**2 / (2 * np.pi) * np.sqrt(E * I / (rho * A * L**4))
    shear = np.sqrt(k * G / rho) / (4 * L)
    return 1 / np.sqrt(1 / bending**2 + 1 / shear**2)

def hertz(mesh, key):
    return np.array([float(row[key]) for row in csv.DictReader(open(f"modes_{mesh}/modes.csv"))])

coarse, fine = (hertz(mesh, "full [Hz]") for mesh in (16, 32))
faults = []
for name, exact in (("weak bending", beam(0.2, 0.1)), ("strong bending", beam(0.1, 0.2))):
    meshes = [f[np.argmin(np.abs(f - exact))] for f in (coarse, fine)]
    limit = meshes[1] - (meshes[0] - meshes[1]) / 3  # the error falls with h^2
    print(f"{name}: {meshes[0]:.1f}, {meshes[1]:.1f}, towards {limit:.1f} Hz; beam {exact:.1f} Hz")
    if not meshes[0] > meshes[1] > limit or abs(limit / exact - 1) > 0.02:
        faults.append(name)
axial = np.sqrt(E / rho) / (4 * L)
nearest = fine[np.argmin(np.abs(fine - axial))]
print(f"axial: {nearest:.1f} Hz; bar {axial:.1f} Hz")
if abs(nearest / axial - 1) > 0.01:
    faults.append("axial")
reduced = hertz(32, "coupled [Hz]")
print(f"reduced against full: {np.abs(reduced / fine - 1).max():.1e}")
if not np.all(reduced > fine * (1 - 1e-9)) or np.abs(reduced / fine - 1).max() > 1e-3:
    faults.append("reduced")
sys.exit("wrong: " + ", ".join(faults) if faults else 0)
PY
