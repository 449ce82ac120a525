#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs the hanging string and compares the force at its top with the weight below the middle of the first element.
set -euo pipefail
deck="$(dirname "${BASH_SOURCE[0]}")/deck.xml"
tooljoint run "$deck" --output results
python3 - <<'PY'
import json, math
force = json.load(open("results/summary.json"))["static"]["top_axial_force"]
expected = 7850 * math.pi * (0.0635**2 - 0.054**2) * 9.81 * (90 - 1.5)
print(f"top axial force {force:.3f} N, rho S g (L - l/2) = {expected:.3f} N")
raise SystemExit(0 if abs(force - expected) < 1e-6 * expected else "The string does not carry its own weight.")
PY
