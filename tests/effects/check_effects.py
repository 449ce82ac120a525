#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Changes every parameter of a deck and checks that the results change in the known direction.

    check_effects.py PROGRAM [--shard I/N]

effects.json has one row per parameter: {"parameter": path as in `tooljoint doc --format json` with
* for names chosen by the user, "set": overrides, "base": overrides of the run for comparison (none
if absent), "key": the result that is compared, "effect": "up", "down", "changes" or "same",
"scene": a deck beside this file other than scene.xml}. Rows of the Study list run
`tooljoint study` on tests/study/study.xml, those of the Map list `tooljoint map` on
tests/study/map.xml. Keys are dotted paths into summary.json, or "file:NAME" for the content of a
file, or "files" for the list of files, or "dataset:NAME:PATH" for a dataset of an HDF5 file; tables
and figures of an analysis (ANALYSES) come from its own command; "COMMAND.file:NAME" names the
command if two write the table. A parameter of the manual without a row, or a row without a
parameter, fails. "exempt" gives the reason why a run cannot show an effect, and names the test that
shows it.
"""
import argparse
import hashlib
import json
import pathlib
import subprocess
import sys

import h5py

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from checks import unwrapped  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
STUDY = "../study/study.xml"
MAP = "../study/map.xml"
COMMANDS = {STUDY: "study", MAP: "map"}  # of decks that are not run
SHORT = {
    STUDY: ["Study/End Time=0.1", "Study/Window=0.05"],
    MAP: ["Map/Pictures=false"],
}  # before the overrides of a row
ANALYSES = {  # command -> its tables; the keys of its summary figures begin with its name
    "torque-drag": ["file:torque_drag.csv", "file:torque_drag_broomstick.csv",
                    "file:torque_drag_calibration.csv"],
    "bha": ["file:bha.csv", "file:bha_profile.csv"],
    "buckling": ["file:buckling.csv", "file:buckling_profile.csv"],
    "campbell": ["file:campbell.csv", "file:crossings.csv", "file:spot_checks.csv",
                 "dataset:campbell.h5:shapes/speed"],
    "response": ["file:response.csv"],
}


def parameters(description, path=""):
    """Paths of all parameters of a list of the manual."""
    for parameter in description["parameters"]:
        yield f"{path}{parameter['name']}"
    for sublist in description["lists"]:
        yield from parameters(sublist, f"{path}{sublist['name']}/")
    if description.get("named_lists"):
        yield from parameters(description["named_lists"], f"{path}*/")


class Runs:
    def __init__(self, program):
        self.program = program
        self.done = {}

    def folder(self, overrides, scene, command="run"):
        """Results folder of the scene with these overrides; each set of overrides runs once."""
        key = json.dumps([command, scene, *overrides])
        if key not in self.done:
            folder = pathlib.Path("run_" + hashlib.sha1(key.encode()).hexdigest()[:12])
            words = [self.program, command, str(HERE / scene), "--output", str(folder)]
            for override in [*SHORT.get(scene, []), *overrides]:
                words += ["--without", override[1:]
                          ] if override.startswith("!") else ["--set", override]
            result = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                    text=True, check=False)
            pointless = command == "map" and result.returncode == 4  # its tables give the reason
            if result.returncode != 0 and not pointless:
                raise RuntimeError(unwrapped(result.stdout).strip().splitlines()[-1])
            self.done[key] = folder
        return self.done[key]

    def value(self, overrides, key, scene):
        command = next(
            (word for word in ANALYSES if key in ANALYSES[word] or key.startswith(word + ".")),
            COMMANDS.get(scene, "run"))
        folder = self.folder(overrides, scene, command)
        file = key.removeprefix(f"{command}.")
        if file.startswith("file:"):
            return (folder / file[5:]).read_bytes()
        if file.startswith("dataset:"):
            _, name, path = file.split(":")
            with h5py.File(folder / name, "r") as content:
                return content[path][()].tobytes()
        if key == "size":
            return (folder / "results.h5").stat().st_size
        value = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        for step in key.split("."):
            value = value[int(step)] if isinstance(value, list) else value[step]
        return value


def holds(effect, before, after):
    if effect == "same":
        return before == after
    if not all(
            isinstance(value, (int, float)) and not isinstance(value, bool)
            for value in (before, after)):
        return effect == "changes" and before != after
    margin = 1e-9 * max(abs(before), abs(after))
    return {
        "up": after > before + margin, "down": after < before - margin,
        "changes": abs(after - before) > margin
    }[effect]


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument(
        "--shard", default="1/1", help="I/N: the I-th of N groups of rows; rows of one scene are "
        "in one group and share its runs")
    options = parser.parse_args()
    table = json.loads((HERE / "effects.json").read_text(encoding="utf-8"))
    manual = json.loads(
        subprocess.run([options.program, "doc", "--format", "json"], stdout=subprocess.PIPE,
                       text=True, check=True).stdout)
    known = set(parameters(manual[0] if isinstance(manual, list) else manual))
    covered = {row["parameter"] for row in table["effects"]} | set(table["exempt"])
    faults = [f"{name}: no row in effects.json" for name in sorted(known - covered)]
    faults += [f"{name}: no such parameter" for name in sorted(covered - known)]

    runs = Runs(options.program)
    shard, shards = (int(x) for x in options.shard.split("/"))
    rows = table["effects"][len(table["effects"]) * (shard - 1) // shards:len(table["effects"]) *
                            shard // shards]
    for row in rows:
        try:
            scene = {"Study": STUDY, "Map": MAP}.get(row["parameter"].split("/")[0],
                                                     row.get("scene", "scene.xml"))
            before = runs.value(row.get("base", []), row["key"], scene)
            after = runs.value(row.get("base", []) + row["set"], row["key"], scene)
        except (RuntimeError, KeyError, TypeError, OSError) as problem:
            if "built without SUNDIALS" in str(problem) and any(
                    "SUNDIALS" in one for one in row.get("base", []) + row["set"]):
                print(f"skipped {row['parameter']}: built without SUNDIALS", flush=True)
                continue
            faults.append(f"{row['parameter']} {row['set']}: {problem}")
            continue
        good = holds(row["effect"], before, after)
        shown = "" if isinstance(before, bytes) else f": {row['key']} {before} -> {after}"
        print(f"{'ok    ' if good else 'FAILED'} {row['parameter']} {row['effect']}{shown}",
              flush=True)
        if not good:
            faults.append(
                f"{row['parameter']} {row['set']}: {row['key']} should be {row['effect']}{shown}")
    print(f"\n{len(rows)} effects looked at, {len(faults)} faults.")
    for fault in faults:
        print("  " + fault)
    return 1 if faults or not rows else 0


if __name__ == "__main__":
    sys.exit(main())
