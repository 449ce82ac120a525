#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs a deck and compares a few physical norms of its summary.json with a gold.

A gold is a JSON file:

    {
      "deck": "xml/helical_170m.xml",                     relative to the project
      "set": ["Transient/End Time=0.2"],                  overrides, may be absent
      "ranks": [1, 2, 4],                                 one CTest each
      "timeout_s": 300,
      "rests_on": {                                       reason why the value of each norm is right
        "static.residual":        "balance: the bound is Static/Tolerance",
        "static.top_axial_force": "closed form: weight of the string less the weight on bit"
      },
      "norms": {
        "static.residual":        {"value": 1e-9, "at_most": true},
        "path.converged":         {"value": true},
        "static.top_axial_force": {"value": 81234.5, "relative": 1e-10, "absolute": 0.0,
                                   "why": "np equality of the static state"},
        "reduction.substructures.0.modes": {"value": 60}
      }
    }

`rests_on` begins with one of "closed form", "balance", "published", "independent computation",
"pinned", a colon, and the argument. A "pinned" value is supported only by an earlier result: the
argument says why there is nothing better.

Keys are dotted paths into summary.json; numbers are indices of lists. A real number needs
`relative` and/or `absolute` (the sum of both allowances holds), or `at_most`, which bounds its
size, or `at_least`, which bounds the number; whole numbers, texts and booleans without tolerance
must be equal. `--update` runs the deck once on the first of `ranks` and rewrites the values (not
those with `at_most` or `at_least`), never the tolerances.
"""
import argparse
import copy
import json
import math
import os
import pathlib
import subprocess
import sys

os.environ.setdefault("TOOLJOINT_REPORT", "off")  # reports of these runs are not needed

SOURCES = ("closed form", "balance", "published", "independent computation", "pinned")


def look_up(summary, key):
    """The value at a dotted path; raises KeyError with the missing key."""
    value = summary
    for step in key.split("."):
        if isinstance(value, list) and step.isdigit() and int(step) < len(value):
            value = value[int(step)]
        elif isinstance(value, dict) and step in value:
            value = value[step]
        else:
            raise KeyError(step)
    return value


def run(options, gold, ranks, output):
    """Runs the deck and returns its summary; ends the process with the program's output when the
    run fails."""
    command = [
        options.mpiexec, "-np",
        str(ranks), options.program, "run",
        str(options.project / gold["deck"]), "--output",
        str(output)
    ]
    for override in gold.get("set", []):
        command += ["--set", override]
    print(" ".join(command), flush=True)
    (output / "summary.json").unlink(missing_ok=True)
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors="replace", check=False)
    if done.returncode != 0:
        sys.exit(f"{done.stdout}\nThe run failed with exit code {done.returncode}.")
    with open(output / "summary.json", encoding="utf-8") as file:
        return json.load(file)


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def compare(norm, found):
    """(difference, allowed, ok) as two texts and a boolean."""
    expected = norm["value"]
    if not (is_number(expected) and is_number(found)):
        return "", "equal", type(expected) is type(found) and expected == found
    if not math.isfinite(found):
        return "", "finite", False
    if norm.get("at_least"):
        return f"{expected - found:.3e}", "at least", found >= expected
    if norm.get("at_most"):
        return f"{abs(found) - expected:.3e}", "at most", abs(found) <= expected
    allowed = norm.get("relative", 0.0) * abs(expected) + norm.get("absolute", 0.0)
    return f"{abs(found - expected):.3e}", f"{allowed:.3e}", abs(found - expected) <= allowed


def faults_of(gold):
    """Errors of a gold: norms that cannot fail, cannot be read, or have no reason."""
    norms, arguments = gold.get("norms", {}), gold.get("rests_on", {})
    if not norms:
        yield "no norms, so nothing would be compared."
    for key, norm in norms.items():
        if "value" not in norm:
            yield f"{key} has no value yet: run with --update and look at what it wrote."
        elif isinstance(
                norm["value"],
                float) and not ({"relative", "absolute", "at_most", "at_least"} & norm.keys()):
            yield f"{key} is a real number and states no tolerance."
        source, _, argument = arguments.get(key, "").partition(": ")
        if source not in SOURCES or not argument.strip():
            yield (f"{key} does not say in \"rests_on\" what its value rests on: one of "
                   f"{', '.join(SOURCES)}, a colon, and why.")
    for key in arguments.keys() - norms.keys():
        yield f"\"rests_on\" argues for {key}, which is no norm."


def check_gold(gold, path):
    """Ends the process if the gold itself has errors."""
    faults = list(faults_of(gold))
    if faults:
        sys.exit("\n".join(f"{path}: {fault}" for fault in faults))


def self_test():
    """Shows that every fault of a gold is detected, and that values outside of their tolerance
    fail."""
    good = {
        "norms": {
            "a.b": {"value": 1.5, "relative": 0.1},
            "c": {"value": 3},
            "d": {"value": 1.0, "at_most": True},
        },
        "rests_on": {
            "a.b": "closed form: 3/2", "c": "pinned: no closed form",
            "d": "balance: what goes in comes out"
        },
    }
    cases = {
        "": lambda gold: None, "no norms": lambda gold: gold.update(norms={}, rests_on={}),
        "no value yet": lambda gold: gold["norms"]["c"].pop("value"),
        "states no tolerance": lambda gold: gold["norms"]["a.b"].pop("relative"),
        "c does not say": lambda gold: gold["rests_on"].pop("c"),
        "d does not say": lambda gold: gold.pop("rests_on"),
        "a.b does not say": lambda gold: gold["rests_on"].update({"a.b": "guess: it looks right"}),
        "one of closed form": lambda gold: gold["rests_on"].update({"a.b": "closed form: "}),
        "argues for e": lambda gold: gold["rests_on"].update(e="pinned: x")
    }
    failures = 0
    for sentence, spoil in cases.items():
        gold = copy.deepcopy(good)
        spoil(gold)
        faults = list(faults_of(gold))
        fine = any(sentence in fault for fault in faults) if sentence else not faults
        failures += not fine
        print(f"{'ok    ' if fine else 'FAILED'} {sentence or 'a good gold'}: {faults}")
    for norm, found, expected in (
        ({"value": 2.0, "relative": 0.1}, 2.19, True),
        ({"value": 2.0, "relative": 0.1}, 2.21, False),
        ({"value": 2.0, "absolute": 0.1}, 1.89, False),
        ({"value": 2.0, "relative": 0.05, "absolute": 0.1}, 2.19, True),
        ({"value": 1.0, "at_most": True}, -1.1, False),
        ({"value": 1.0, "at_most": True}, -0.9, True),
        ({"value": 1.0, "at_most": True}, math.nan, False),
        ({"value": -0.1, "at_least": True}, 0.5, True),
        ({"value": -0.1, "at_least": True}, -0.2, False),
        ({"value": 3}, 4, False),
        ({"value": True}, 1, False),
        ({"value": 3}, None, False),
    ):
        fine = compare(norm, found)[2] is expected
        failures += not fine
        print(f"{'ok    ' if fine else 'FAILED'} {norm} against {found}")
    return 1 if failures else 0


def update(options, gold):
    summary = run(options, gold, gold["ranks"][0], options.output)
    for key, norm in gold["norms"].items():
        if not (norm.get("at_most") or norm.get("at_least")):
            found = look_up(summary, key)
            if found != norm.get("value"):
                print(f"{key}: {norm.get('value')} -> {found}")
            norm["value"] = found
    norms = ",\n    ".join(
        f"{json.dumps(key)}: {json.dumps(norm)}" for key, norm in gold["norms"].items())
    text = json.dumps({**gold, "norms": {}}, indent=2)
    text = text.replace('"norms": {}', f'"norms": {{\n    {norms}\n  }}')
    options.gold.write_text(text + "\n", encoding="utf-8")
    return 0


def verify(options, gold):
    check_gold(gold, options.gold)
    summary = run(options, gold, options.ranks, options.output)
    width = max(len(key) for key in gold["norms"])
    print(f"{'norm':<{width}}  {'gold':>24}  {'found':>24}  {'difference':>10}  {'allowed':>10}")
    failed = 0
    for key, norm in gold["norms"].items():
        try:
            found = look_up(summary, key)
            difference, allowed, ok = compare(norm, found)
        except KeyError as step:
            found, difference, allowed, ok = f"no {step}", "", "", False
        failed += not ok
        print(f"{key:<{width}}  {norm['value']!s:>24}  {found!s:>24}  {difference:>10}  "
              f"{allowed:>10}{'' if ok else '  FAILED'}")
    print(
        f"\n{len(gold['norms'])} norms on {options.ranks} ranks, {failed} outside their tolerance.")
    return 1 if failed else 0


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("gold", type=pathlib.Path)
    parser.add_argument("--program", default=os.environ.get("TOOLJOINT_PROGRAM", "tooljoint"))
    parser.add_argument("--mpiexec", default="mpirun")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--output", type=pathlib.Path, required=True,
                        help="folder for the results of the run")
    parser.add_argument("--update", action="store_true", help="rewrite the values of the gold")
    options = parser.parse_args()
    options.project = pathlib.Path(__file__).resolve().parents[2]
    options.output.mkdir(parents=True, exist_ok=True)
    gold = json.loads(options.gold.read_text(encoding="utf-8"))
    return update(options, gold) if options.update else verify(options, gold)


if __name__ == "__main__":
    sys.exit(main())
