#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs the hanging string and compares its hook load with its weight.
set -euo pipefail
deck="$(dirname "${BASH_SOURCE[0]}")/deck.xml"
tooljoint run "$deck" --output results
python3 - <<'PY'
import json, math
force = json.load(open("results/summary.json"))["static"]["hook_load"]
expected = 7850 * math.pi * (0.0635**2 - 0.054**2) * 9.81 * 90
print(f"hook load {force:.3f} N, rho S g L = {expected:.3f} N")
raise SystemExit(0 if abs(force - expected) < 1e-6 * expected else "The string does not carry its own weight.")
PY
