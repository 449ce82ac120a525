#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs half a second of the reference scene with the modes needed for two tolerances, and checks both.
set -euo pipefail
deck="$(dirname "${BASH_SOURCE[0]}")/../../xml/helical_170m.xml"
short=(--set "Transient/End Time=0.5" --set Output/XDMF=false)
tolerances=(--without Reduction --set "Reduction/Mode Selection/Frequency Tolerance=1e-4" --set "Reduction/Mode Selection/Motion Tolerance=0.05")
tooljoint run "$deck" --output chosen "${tolerances[@]}" --set "Reduction/Error Estimate=Both" "${short[@]}"
tooljoint modes "$deck" --output modes --without Reduction --set "Reduction/Mode Selection/Frequency Tolerance=1e-4" "${short[@]}"
tooljoint run "$deck" --output full --without Reduction --without Substructures "${short[@]}"
tooljoint compare chosen full --to 0.5 --json > compared.json
python3 - <<'PY'
import csv, json, sys
reduction = json.load(open("chosen/summary.json"))["reduction"]
estimate = reduction["estimate"]
modes = [part["modes"] for part in reduction["substructures"]]
print(f"modes of the parts: {modes}, {reduction['reduced_dofs']} dofs after {estimate['rounds']} rounds")
rows = list(csv.DictReader(open("modes/modes.csv")))
errors = [(abs(float(row["error"])), abs(float(row["estimate"]))) for row in rows]
worst = max(error for error, _ in errors)
print(f"frequencies: largest error {worst:.2e}, largest estimate {max(guess for _, guess in errors):.2e}")
vibration_error = json.load(open("compared.json"))["vibration_error"]
print(f"motion: vibration error {vibration_error:.2e}, estimated {estimate['motion_error']:.2e}")
faults = []
if worst > 1e-4:
    faults.append("the tolerance of the frequencies is not met")
if any(not error / 3 < guess < 3 * error for error, guess in errors if error > 1e-9):
    faults.append("an estimate is not within a factor 3 of the error")
if vibration_error > 0.05:
    faults.append("the tolerance of the motion is not met")
sys.exit("; ".join(faults) or 0)
PY
