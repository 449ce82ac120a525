#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the commands of the documents: check_commands.py PROGRAM PROJECT CTEST BUILD

Blocks `sh` of the user's pages run line by line in a folder that looks like the project. Motions
and studies are shortened, so that every command runs in the test. Among the commands of
docs/validation.md that differ only in numbers one is run, static states unchanged; the decks and
overrides of the others are read. For all other commands in the pages, in blocks and within lines,
the test checks that the command, its options, decks, tools and targets exist, and the tests of this
build that a page names. Separate tests run README.md, the tutorials, docs/first-report.md and
docs/python.md word for word.
"""
import functools
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from checks import TIME_FACTOR, expect, finish  # noqa: E402

PROGRAM, PROJECT = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
CTEST, BUILD = sys.argv[3:5]
RUN = (*[
    f"docs/guide/{page}.md"
    for page in ("torque-drag", "buckling", "bottom-hole-assembly", "bit-and-top-drive",
                 "critical-speeds", "figures-of-merit", "measured-logs", "maps")
], "docs/report.md", "docs/guide/decks.md", "docs/guide/recipes.md", "docs/guide/parts.md",
       "docs/guide/coupling.md", "docs/guide/troubleshooting.md", "docs/guide/studies.md")
VALIDATION = "docs/validation.md"
SHORT = {
    "run": ["Transient/End Time=0.02"],
    "study": [
        "Study/End Time=0.06", "Study/Window=0.03", "Study/Repeats=1", "Study/Pictures=false"
    ],
    "map": [
        "Transient/End Time=0.02", "Map/Pictures=false", "Map/Grid/speed/Count=2",
        "Map/Grid/weight on bit/Values={10 kN, 20 kN}"
    ],
    "bha": [
        "Bottom-Hole Assembly/Tool Face={0 deg}", "Bottom-Hole Assembly/Rotating Tool Faces=3",
        "Bottom-Hole Assembly/Element Length=2"
    ],
    "buckling": ["Buckling/Last Weight On Bit=300 kN"],
    "torque-drag": ["Torque and Drag/Count=1", "Torque and Drag/Operations={Drill rotating}"],
    "campbell": ["Campbell/Points=2", "Campbell/Modes=2"],
    "response": ["Response/Points=3"],
}
MAPPED = {}  # deck: folder
COMPARED = ["Transient/End Time=1", "Measured Log/Begin=0 s",
            "Measured Log/End=0.9 s"]  # a motion with a log needs samples
OPTIONS_OF_DECKS = ("--set", "--without")
PLACES = re.compile(r"\b(DECK|DIR|FILE|NAME|[A-Z]{2,})\b")


def blocks(page, kinds=("sh",)):
    """Commands in the blocks of a page, with continued lines joined, and the text of the block
    before each."""
    text, before, found = (PROJECT / page).read_text(encoding="utf-8"), "", []
    for kind, body in re.findall(r"^```(\w*)\n(.*?)^```", text, re.M | re.S):
        if kind in kinds:
            lines = body.replace("\\\n", " ").splitlines()
            found += [(line, before) for line in lines if line.strip() and not line.startswith("#")]
        before = body
    return found


def stage(folder):
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "bin").mkdir(parents=True)
    (folder / "build/release").mkdir(parents=True)
    shutil.copytree(PROJECT / "xml", folder / "xml")  # some commands read a table beside a deck
    for name in ("tools", "tests", "examples", "python"):
        (folder / name).symlink_to(PROJECT / name)
    for place in ("bin", "build/release"):
        program = folder / place / "tooljoint"
        program.write_text(f"#!/bin/bash\nexec {shlex.quote(str(PROGRAM))} \"$@\"\n",
                           encoding="utf-8")
        program.chmod(0o755)


def words_of(line):
    return shlex.split(line, comments=True)


def shortened(words):
    """A command with overrides that shorten it."""
    if pathlib.Path(words[0]).name != "tooljoint" or words[1] not in SHORT or "Transient" in words:
        return words
    if words[1] == "map":  # a second map of a deck continues from the points of the first
        at = words.index("--output") + 1
        words = [*words[:at], MAPPED.setdefault(words[2], words[at]), *words[at + 1:]]
    compared = words[1] == "run" and "Measured Log" in (PROJECT / words[2]).read_text(
        encoding="utf-8")
    return [
        *words,
        *(word for text in (COMPARED if compared else SHORT[words[1]]) for word in ("--set", text))
    ]


def run_pages(folder):
    environment = {
        **os.environ, "PATH": f"{folder / 'bin'}:{os.environ['PATH']}", "TOOLJOINT_REPORT": "off"
    }
    for page in RUN:
        for line, before in blocks(page):
            words = words_of(line)
            runs = words[0] == "tooljoint" or words[0].startswith("tools/")
            if not runs or PLACES.search(" ".join(words[:3])):
                continue
            measured = re.search(r"Measured=(\S+\.csv)", line)
            if measured:
                (folder / "xml" / measured[1]).write_text(before, encoding="utf-8")
            done = subprocess.run(shortened(words), cwd=folder, env=environment,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                  check=False, timeout=240 * TIME_FACTOR)
            expect(f"{page}: {line.strip()[:110]}", done.returncode == 0,
                   f"({done.returncode}) {done.stderr[-400:]}")


def run_validation(folder):
    """Runs one of the commands that differ only in numbers; reads decks and overrides of the
    others."""
    seen, alike, ran = set(), set(), 0
    for line, _ in blocks(VALIDATION, ("sh", "")):
        words = words_of(line)
        if words[:2] != ["tooljoint", "run"]:
            continue
        kept = [words[2]]
        for option, value in zip(words[3:], words[4:]):
            kept += [option, value] if option in OPTIONS_OF_DECKS else []
        kind = re.sub(r"[-+]?\b\d[\d.e+-]*", "#", " ".join(kept))
        if kind not in alike:
            command, ran = shortened([str(PROGRAM), *words[1:]]), ran + 1
        elif tuple(kept) not in seen:
            command = [PROGRAM, "check", *kept]
        else:
            continue
        alike.add(kind)
        seen.add(tuple(kept))
        done = subprocess.run(command, cwd=folder, env={**os.environ, "TOOLJOINT_REPORT": "off"},
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              check=False)
        expect(f"{VALIDATION}: {line.strip()[:110]}", done.returncode == 0, done.stderr[-300:])
    expect(f"{VALIDATION} has {len(seen)} commands, of which {ran} run",
           len(seen) > 20 and ran >= 10, f"{len(seen)} {ran}")


@functools.lru_cache(maxsize=None)
def helped(*words):
    done = subprocess.run([*words, "--help"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, check=False)
    return done.stdout if done.returncode == 0 else None


def spelled(text, page, targets):
    """Checks that everything named in a command of a page exists."""
    text = text.split("#")[0].replace("\\|", "|")
    options = re.findall(r"(?<![\w-])--[a-z][\w-]*", text)
    if match := re.match(r"(?:mpirun -np \S+ |mpiexec -n \S+ )?(?:\S*/)?tooljoint(?: ([a-z-]+))?\b",
                         text):
        help_text = helped(str(PROGRAM), *([match[1]] if match[1] else []))
    elif match := re.match(r"(?:python3 )?(tools/[\w/]+\.py|tests/[\w/]+\.py)", text):
        expect(f"{page}: {match[1]} exists", (PROJECT / match[1]).is_file())
        if match[1].startswith("tests/"):
            return
        help_text = helped("/usr/bin/python3", str(PROJECT / match[1]))
    else:
        for target in re.findall(r"--target (\S+)", text):
            expect(f"{page}: the target {target} exists", target in targets, sorted(targets)[:5])
        return
    expect(
        f"{page}: {text[:100]}", help_text is not None
        and all(re.search(rf"{option}\b", help_text) for option in options), "no such command"
        if help_text is None else [option for option in options if option not in help_text])
    for deck in re.findall(r"\b(?:xml|examples)/[\w/]+\.xml", text):
        expect(f"{page}: {deck} exists", (PROJECT / deck).is_file())


def targets():
    """Names of custom targets in the sources of the build."""
    files = [
        PROJECT / "CMakeLists.txt", *PROJECT.glob("cmake/*.cmake"),
        *PROJECT.glob("tests/**/CMakeLists.txt"), *PROJECT.glob("python/**/CMakeLists.txt"),
        *PROJECT.glob("docs/CMakeLists.txt")
    ]
    text = "\n".join(path.read_text(encoding="utf-8") for path in files)
    return set(
        re.findall(
            r"(?:add_custom_target|pybind11_add_module|add_executable|add_library)\(\s*([\w-]+)",
            text)) | {"install", "all", "package"}


def pages():
    found = [
        *PROJECT.glob("docs/*.md"), *PROJECT.glob("docs/guide/*.md"),
        *PROJECT.glob("examples/*/README.md"), PROJECT / "README.md", PROJECT / "CONTRIBUTING.md"
    ]
    return [page for page in sorted(found) if page.name not in ("parameters.md", "CHANGELOG.md")]


def check_words():
    known, count = targets(), 0
    for page in pages():
        text, name = page.read_text(encoding="utf-8"), str(page.relative_to(PROJECT))
        begins = (r"(?:mpirun -np \S+ |mpiexec -n \S+ "
                  r")?(?:tooljoint|build/release/tooljoint|tools/\w+\.py|python3 tests/|cmake "
                  r"--build)\b")
        commands = set(re.findall(rf"`({begins}[^`\n]*)`", text))
        commands |= {
            line.strip()
            for line in re.findall(rf"^(?:    )?({begins}.*)$", text.replace("\\\n", " "), re.M)
            if not line.endswith(".")
        }
        for command in sorted(commands):
            spelled(command, name, known)
        count += len(commands)
    expect("the pages have commands", count > 100, count)
    made = re.search(r"Every table and figure of record.*?\nendif",
                     (PROJECT / "cmake/DeveloperTools.cmake").read_text(encoding="utf-8"), re.S)[0]
    written = {
        tool.stem for tool in PROJECT.glob("tools/*.py") if re.search(
            r"writes? docs/|rewrites (the tables|tables and figures) of docs/|rewrites docs/",
            " ".join(tool.read_text(encoding="utf-8").split()))
    }
    absent = [
        name for name in written | {"docs-pictures", "update-docs", "hard-cases", "strategies"}
        if not re.search(rf"[( ]({name}|{name.replace('_', '-')})[ )]", made)
    ]
    expect("the target records makes what tools write into docs/",
           len(written) > 4 and not absent, f"{absent} {sorted(written)}")


def draw_map(folder):
    """The tool that draws the maps of the documents uses the commands of their page."""
    changes = [word for text in SHORT["map"] if "Pictures" not in text for word in ("--set", text)]
    done = subprocess.run([
        PROJECT / "tools/maps.py", "--program", PROGRAM, "--work", folder / "maps", "--figures",
        folder, "--only", "map_helical_170m", *changes
    ], env={**os.environ, "TOOLJOINT_REPORT": "off"}, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, check=False)
    drawn = (folder / "map_helical_170m.svg").read_text(
        encoding="utf-8") if done.returncode == 0 else ""
    expect("tools/maps.py draws a map, which says of what scene and with what the axes do not vary",
           "<svg" in drawn and ">map_helical_170m; TOB 5 kN m, " in drawn, done.stderr[-300:])


def check_tests():
    """Each pattern of `ctest -R` fits a test of this build, or one that the build has with more
    packages; each label of `-L` has tests."""
    listed = json.loads(
        subprocess.run([CTEST, "--test-dir", BUILD, "--show-only=json-v1"], stdout=subprocess.PIPE,
                       text=True, check=True).stdout)["tests"]
    labels = {
        label for test in listed for entry in test.get("properties", ())
        if entry["name"] == "LABELS" for label in entry["value"]
    }
    names = {test["name"] for test in listed} | set(
        re.findall(r"tooljoint_add_test\(([\w.]+) ",
                   (PROJECT / "tests/CMakeLists.txt").read_text(encoding="utf-8")))
    named = 0
    for page in pages():
        for command in re.findall(r"`(ctest [^`]+)`", page.read_text(encoding="utf-8")):
            words = shlex.split(command.replace("\\|", "|"))
            for option, pattern in zip(words, words[1:]):
                known = {"-R": names, "-L": labels}.get(option)
                if known:
                    named += 1
                    expect(f"{page.name}: {command} has tests",
                           any(re.search(pattern, name) for name in known),
                           sorted(known)[:5])
    expect("the pages name tests", named > 30, named)


def main():
    folder = pathlib.Path("commands").resolve()
    stage(folder)
    check_words()
    check_tests()
    run_validation(folder)
    run_pages(folder)
    draw_map(folder)
    return finish()


if __name__ == "__main__":
    sys.exit(main())
