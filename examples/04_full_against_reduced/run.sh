#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs half a second of the reference scene with the full and the reduced model and compares them.
set -euo pipefail
deck="$(dirname "${BASH_SOURCE[0]}")/../../xml/helical_170m.xml"
short=(--set "Transient/End Time=0.5" --set Output/XDMF=false)
tooljoint run "$deck" --output full --without Reduction --without Substructures "${short[@]}"
tooljoint run "$deck" --output reduced "${short[@]}"
tooljoint compare reduced full --to 0.5 --fail-above 0.01
