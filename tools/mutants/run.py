#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Mutation check: makes one small fault at a time in the product code and runs the test that must
detect it.

    run.py                      all entries of mutants.json, in a copy of the sources with its own
                                build tree
    run.py --only beam --only 'contact*'   entries whose name or file matches one of the patterns
                                           (shell style; a part of it is enough)
    run.py --list               names of the entries, their files and tests
    run.py --check              every entry still applies exactly once and names an existing test
                                (takes seconds, builds nothing)
    run.py --self-test          tests --check

An entry of mutants.json has `name`, `file`, `old`, `new`, `test` (of CTest) and, for a GoogleTest
program, `filter` (Suite.Test, several joined by a colon). White space is ignored in the search for
`old` in the file.

A mutant is killed if its test fails and survives if the test passes. A mutant that does not compile
or exceeds the time limit of the test counts as not killed. Exit code 0: at least --least percent
are killed; 1: fewer; 2: wrong use, an entry that does not apply, or a test that fails without a
fault.
"""
import argparse
import fnmatch
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
PROJECT = HERE.parents[1]
KEYS = {"name", "file", "old", "new", "test"}
# Kinds of tests with one program per folder: tests/KIND/ROOM is the CTest test KIND.ROOM (mpi:
# KIND.ROOM.npN), target KIND_ROOM.
PROGRAM = re.compile(r"(unit|verification|stability|mpi)\.(\w+?)(\.np\d+)?$")


def pattern(text):
    """Regular expression for `text` that ignores white space."""
    return re.compile(r"\s*".join(re.escape(letter) for letter in "".join(text.split())))


def apply(text, entry):
    """The text of a file with the fault. ValueError unless the old text occurs exactly once."""
    found = list(pattern(entry["old"]).finditer(text))
    if len(found) != 1:
        raise ValueError(f"the old text is found {len(found)} times in {entry['file']}, expected "
                         f"once: {entry['old']}")
    return text[:found[0].start()] + entry["new"] + text[found[0].end():]


def program_of(test):
    """Target of a GoogleTest test, None for any other test."""
    match = PROGRAM.match(test)
    return f"{match[1]}_{match[2]}" if match else None


def tests_of_room(project, test):
    """Names Suite.Test in the sources of a GoogleTest program."""
    kind, room = PROGRAM.match(test).group(1, 2)
    names = set()
    for source in sorted((project / "tests" / kind / room).rglob("*.cpp")):
        for suite, name in re.findall(r"\bTEST(?:_F|_P)?\(\s*(\w+)\s*,\s*(\w+)\s*\)",
                                      source.read_text(encoding="utf-8")):
            names.add(f"{suite}.{name}")
    return names


def complaints(project, entries):
    """Errors in the entries, one line each."""
    seen = set()
    for entry in entries:
        name = entry.get("name", "an entry without a name")
        if not KEYS <= entry.keys() <= KEYS | {"filter"}:
            yield f"{name}: an entry has the keys {', '.join(sorted(KEYS))} and perhaps filter"
            continue
        if name in seen:
            yield f"{name}: the name is given twice"
        seen.add(name)
        path = project / entry["file"]
        if not path.is_file():
            yield f"{name}: there is no file {entry['file']}"
            continue
        try:
            text = path.read_text(encoding="utf-8")
            if "".join(apply(text, entry).split()) == "".join(text.split()):
                yield f"{name}: the new text is the old one"
        except ValueError as error:
            yield f"{name}: {error}"
        if program_of(entry["test"]) is None:
            if "filter" in entry:
                yield f"{name}: {entry['test']} is no GoogleTest program, so it takes no filter"
            continue
        known = tests_of_room(project, entry["test"])
        for wanted in entry.get("filter", "*").split(":"):
            plain = re.sub(r"^\w+/|/\w+$", "",
                           wanted)  # of a parameterised test: Prefix/Suite.Test/number
            if not any(fnmatch.fnmatchcase(one, re.sub(r"/\*$", "", plain)) for one in known):
                yield f"{name}: {entry['test']} has no test {wanted}"


def self_test():
    good = {
        "name": "a", "file": "src/A.cpp", "old": "x = 1 + y;", "new": "x = 1 - y;",
        "test": "unit.a", "filter": "A.adds"
    }
    cases = {
        "": good,
        "found 0 times": good | {"old": "x = 2 + y;"},
        "found 2 times": good | {"old": "return"},
        "is the old one": good | {"new": "x = 1+y;"},
        "no file": good | {"file": "src/B.cpp"},
        "has no test": good | {"filter": "A.subtracts"},
        "takes no filter": good | {"test": "exit_codes"},
        "has the keys": {"name": "a"},
    }
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for path, text in {
                "src/A.cpp": "int f(int y) {\n  int x =\n      1 + y;\n  if (y) return x;\n"
                "  return y;\n}\n", "tests/unit/a/Test.cpp": "TEST(A, adds) {}\n"
        }.items():
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_text(text, encoding="utf-8")
        for expected, entry in cases.items():
            found = list(complaints(root, [entry]))
            right = not found if expected == "" else len(found) == 1 and expected in found[0]
            failures += not right
            print("ok    " if right else "FAILED", expected or "a good entry", found)
    twice = list(complaints(PROJECT, [{"name": "a"}, {"name": "a"}]))
    return 1 if failures or len(twice) != 2 else 0


class Tree:
    """A copy of the sources with a separate build tree."""
    def __init__(self, folder, preset, jobs):
        self.folder = folder
        self.preset = preset
        self.jobs = jobs
        self.build_folder = folder / "build" / preset

    def update(self):
        """Copy changed files, delete removed ones, configure once."""
        listed = subprocess.run(
            ["git", "-C", PROJECT, "ls-files", "-z", "-co", "--exclude-standard"], check=True,
            capture_output=True).stdout
        wanted = {
            name for name in os.fsdecode(listed).split("\0")
            if name and ((PROJECT / name).is_file() or (PROJECT / name).is_symlink())
        }
        for name in sorted(wanted):
            source, target = PROJECT / name, self.folder / name
            if source.is_symlink():  # tools/plots
                if not target.is_symlink():
                    target.parent.mkdir(parents=True, exist_ok=True)
                    target.symlink_to(source.readlink())
                continue
            if target.is_file() and target.read_bytes() == source.read_bytes():
                continue
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, target)
        for room in ("src", "substructures", "tests"):
            for path in (self.folder / room).rglob("*"):
                if path.is_file() and str(path.relative_to(self.folder)) not in wanted:
                    path.unlink()
        if not (self.build_folder / "build.ninja").is_file():
            subprocess.run(["cmake", "--preset", self.preset], cwd=self.folder, check=True)

    def build(self, targets):
        """The output of a failed build, None on success."""
        done = subprocess.run(
            ["cmake", "--build", self.build_folder, "-j",
             str(self.jobs), "--target", *targets], capture_output=True, text=True,
            errors="replace")
        return done.stdout + done.stderr if done.returncode else None

    def run(self, test, filters):
        """Outcome of a test (passed, failed, timed out, not run: no test of that name), and its
        output."""
        environment = dict(os.environ)
        environment.pop("GTEST_FILTER", None)
        if filters:
            environment["GTEST_FILTER"] = filters
        # otherwise analyses continue with rows of another mutant
        scratch = self.build_folder / "tests/scratch" / test
        if scratch.is_dir():
            shutil.rmtree(scratch)
            scratch.mkdir()
        done = subprocess.run(
            ["ctest", "--test-dir", self.build_folder, "-R", f"^{re.escape(test)}$", "--verbose"],
            env=environment, capture_output=True, text=True, errors="replace")
        output = done.stdout + done.stderr
        if "No tests were found" in output or re.search(r"Running 0 tests", output):
            return "not run", output
        if "***Timeout" in output:
            return "timed out", output
        return ("passed" if done.returncode == 0 else "failed"), output


def target_of(entry):
    return program_of(entry["test"]) or ("tooljoint_python"
                                         if entry["test"].startswith("python.") else "tooljoint")


def baseline(tree, entries):
    """Whether everything builds and every named test passes without a fault."""
    print(f"Building {len({target_of(entry) for entry in entries})} targets in {tree.folder} ...",
          flush=True)
    if failure := tree.build(sorted({target_of(entry) for entry in entries})):
        print(failure[-4000:])
        return False
    good = True
    for test, filters in sorted({(entry["test"], entry.get("filter", "")) for entry in entries}):
        outcome, output = tree.run(test, filters)
        if outcome != "passed":
            good = False
            print(f"Without any fault, {test} {filters} has {outcome}:\n{output[-3000:]}",
                  flush=True)
    return good


def mutate(tree, entry):
    """Outcome of one mutant: killed, SURVIVED, build error, timed out."""
    path = tree.folder / entry["file"]
    original = path.read_text(encoding="utf-8")
    path.write_text(apply(original, entry), encoding="utf-8")
    try:
        if failure := tree.build([target_of(entry)]):
            errors = [line for line in failure.splitlines() if "error" in line]
            return "build error", "\n".join(errors[:3]) or failure[-500:]
        outcome, _ = tree.run(entry["test"], entry.get("filter", ""))
        return {"failed": "killed", "passed": "SURVIVED"}.get(outcome, outcome), ""
    finally:
        path.write_text(original, encoding="utf-8")


def selected(entries, patterns):
    if not patterns:
        return entries
    return [
        entry for entry in entries if any(
            fnmatch.fnmatchcase(text, f"*{one}*") for one in patterns
            for text in (entry["name"], entry["file"]))
    ]


def table(entries, arguments):
    tree = Tree(arguments.tree.resolve(), arguments.preset, arguments.jobs)
    tree.update()
    if not baseline(tree, entries):
        return 2
    width = max(len(entry["name"]) for entry in entries)
    killed = 0
    print(f"{'mutant':{width}}  {'outcome':11}  {'seconds':>7}  file: test", flush=True)
    for entry in entries:
        begin = time.monotonic()
        outcome, why = mutate(tree, entry)
        killed += outcome == "killed"
        test = " ".join([entry["test"], entry.get("filter", "")]).strip()
        print(
            f"{entry['name']:{width}}  {outcome:11}  {time.monotonic() - begin:7.1f}  "
            f"{entry['file']}: {test}", flush=True)
        if why:
            print("    " + why.replace("\n", "\n    "), flush=True)
    share = 100.0 * killed / len(entries)
    print(f"{killed} of {len(entries)} mutants are killed ({share:.1f} %; at least "
          f"{arguments.least:g} % are required).")
    return 0 if share >= arguments.least else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", action="append", default=[], metavar="PATTERN",
                        help="entries whose name or file matches; may be repeated")
    parser.add_argument("--list", action="store_true", help="print the entries and stop")
    parser.add_argument("--check", action="store_true",
                        help="check the entries against the sources and stop")
    parser.add_argument("--self-test", action="store_true", help="test --check and stop")
    parser.add_argument("--tree", type=pathlib.Path, default=PROJECT / "build" / "mutants",
                        help="folder of the copy (default: build/mutants)")
    parser.add_argument("--preset", default="release",
                        help="CMake preset of the copy (default: release)")
    parser.add_argument("--jobs", type=int, default=2, help="compilers at a time (default: 2)")
    parser.add_argument("--least", type=float, default=95.0,
                        help="percentage that must be killed (default: 95)")
    arguments = parser.parse_args()
    if arguments.self_test:
        return self_test()
    everything = json.loads((HERE / "mutants.json").read_text(encoding="utf-8"))
    wrong = list(complaints(PROJECT, everything))
    for line in wrong:
        print(line)
    if wrong:
        return 2
    if arguments.check:
        print(f"{len(everything)} entries apply, each once.")
        return 0
    entries = selected(everything, arguments.only)
    if not entries:
        print("No entry matches; --list prints all.")
        return 2
    if arguments.list:
        for entry in entries:
            print(f"{entry['name']}: {entry['file']}, {entry['test']} {entry.get('filter', '')}")
        return 0
    return table(entries, arguments)


if __name__ == "__main__":
    sys.exit(main())
