#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Reduces three members once and uses the reduced ones in three scenes, without their original files.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
frame="$here/../../xml/frame.xml"
python=python3
"$python" -c "import h5py" 2> /dev/null || python=/usr/bin/python3

# reduce once
tooljoint export "$here/library.xml" --output parts
tooljoint export "$here/library.xml" --output parts_mtx --format mtx

# 1. the frame of xml/, reduced in its own deck and made of the reduced members. Wind and initial velocity are left out: the wind acts on a node that is not
#    a dof of the reduced members, and the initial velocity of one of their dofs also moves the nodes beside it.
still=(--without Parts/Loads/wind --without Parts/Laws/gust --without Parts/Starts)
members() {  # folder, ending
  local name
  for name in "left column" "right column"; do echo "Parts/Imported/$name/File=$PWD/$1/column$2"; done
  for name in "top beam" "middle beam"; do echo "Parts/Imported/$name/File=$PWD/$1/beam$2"; done
  echo "Parts/Imported/arm/File=$PWD/$1/arm$2"
}
reuse=() reuse_mtx=()
while read -r line; do reuse+=(--set "$line"); done < <(members parts .h5)
while read -r line; do reuse_mtx+=(--set "$line"); done < <(members parts_mtx "")
tooljoint modes "$frame" --count 20 --output in_place "${still[@]}"
tooljoint modes "$frame" --count 20 --output reused "${still[@]}" --without Reduction "${reuse[@]}"
tooljoint modes "$frame" --count 20 --output reused_mtx "${still[@]}" --without Reduction "${reuse_mtx[@]}"

# 2. its motion under the shaker
tooljoint run "$frame" --output motion_in_place "${still[@]}"
tooljoint run "$frame" --output motion_reused "${still[@]}" --without Reduction "${reuse[@]}"

# 3. another frame, of the reduced and of the unreduced members
cp "$here/tower.xml" .
tooljoint modes tower.xml --count 10 --output tower
sed "s#parts/\(column\|beam\).h5#$here/../../xml/frame/\1#" tower.xml > tower_full.xml
tooljoint modes tower_full.xml --count 10 --output tower_full

"$python" - <<'PY'
import csv, sys
import h5py
import numpy as np

def hertz(folder, key):
    return np.array([float(row[key]) for row in csv.DictReader(open(folder + "/modes.csv"))])

def motion(folder):
    with h5py.File(folder + "/results.h5") as file:
        return file["/model/part"][:], file["/model/node"][:], file["/transient/displacement"][:]

in_place = np.sort(hertz("in_place", "coupled [Hz]"))
differences = {name: np.abs(hertz(name, "full [Hz]") / in_place - 1).max() for name in ("reused", "reused_mtx")}
part, node, here = motion("motion_in_place")
again_part, again_node, there = motion("motion_reused")
order = {key: i for i, key in enumerate(zip(again_part, again_node))}
rows = [order[key] for key in zip(part, node) if key in order]
kept = [i for i, key in enumerate(zip(part, node)) if key in order]
differences["motion"] = np.abs(here[:, kept] - there[:, rows]).max() / np.abs(here).max()
tower = np.abs(hertz("tower", "full [Hz]") / hertz("tower_full", "full [Hz]") - 1).max()
print(f"frequencies: {differences['reused']:.1e} from HDF5, {differences['reused_mtx']:.1e} from Matrix Market; motion of {len(kept)} nodes: {differences['motion']:.1e}")
print(f"tower of reduced members against full ones: {tower:.1e}")
faults = [name for name in ("reused", "reused_mtx") if differences[name] > 1e-12]
if differences["motion"] > 1e-9 or len(kept) < 30:
    faults.append("motion")
if tower > 5e-3:
    faults.append("tower")
sys.exit("wrong: " + ", ".join(faults) if faults else 0)
PY
