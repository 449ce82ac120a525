#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Writes two halves of a rod with Python, couples them, and compares frequencies and motion with the closed form.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
python=python3
"$python" -c "import h5py, scipy" 2> /dev/null || python=/usr/bin/python3
"$python" "$here/make_parts.py"
cp "$here/deck.xml" .
tooljoint check deck.xml
tooljoint modes deck.xml --count 4 --output modes
tooljoint run deck.xml --output results
"$python" - <<'PY'
import csv, sys
import h5py
import numpy as np

length, speed = 100.0, np.sqrt(2.1e8 / 7.85)
rows = list(csv.DictReader(open("modes/modes.csv")))
faults = []
for n, row in enumerate(rows):
    exact, found = (2 * n + 1) * speed / (4 * length), float(row["coupled [Hz]"])
    print(f"mode {n + 1}: {found:.6f} Hz, closed form {exact:.6f} Hz")
    if not 0 < found / exact - 1 < 1e-3:  # Rayleigh-Ritz: from above
        faults.append(f"mode {n + 1}")
with h5py.File("results/results.h5") as file:
    node = [i for i, (p, k) in enumerate(zip(file["/model/part"], file["/model/node"])) if (p, k) == (2, 101)][0]
    time, tip = file["/transient/time"][:], file["/transient/displacement"][:, node, 0]
# released from F x / EA: the end follows a triangle of period 4 L / c between +- F L / EA
pulled = 1e4 * length / 2.1e8
phase = (time * speed / length) % 4.0
triangle = pulled * (np.abs(phase - 2.0) - 1.0)
error = np.abs(tip - triangle).max() / pulled
print(f"start {tip[0]:.9f} m, F L / EA {pulled:.9f} m; largest distance from the triangle {error:.2e} of it")
if abs(tip[0] / pulled - 1) > 1e-10 or error > 0.02:
    faults.append("motion")
sys.exit("wrong: " + ", ".join(faults) if faults else 0)
PY
