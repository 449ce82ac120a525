#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks rules of the source tree that a compiler does not check: allowed includes, forbidden
names, licence lines, sizes, repeated code, names without their headers.

    lint.py PROJECT         prints file:line: complaint, exit code 1 if there are any
    lint.py --self-test     shows that each rule detects its fault
    lint.py --rooms         prints the table of folders for docs/architecture.md
    lint.py --counts PROJECT  prints the lines of product code by folder, and of tests, and the
                              folders with the most sources
"""
import pathlib
import re
import stat
import subprocess
import sys
import tempfile

import planted
import reach
import repeats
import rooms
import sizes

LONGEST = 500  # lines of a source file; a longer one contains two concepts
WIDEST = 100  # columns of a line of Python; clang-format checks C++
ROOMS = [
    "src", "substructures", "python", "tests", "tools", "examples", "benchmarks", "cmake", "docs",
    "xml"
]
TOP = [
    "CMakeLists.txt", "CMakePresets.json", "README.md", "CHANGELOG.md", "CONTRIBUTING.md",
    "CITATION.cff", "quickstart", ".ci/run"
]
SOURCES = {".cpp", ".hpp", ".py", ".sh", ".cmake", ".in"}
TEXTS = SOURCES | {".txt", ".md", ".xml", ".json", ".csv", ".cff", ".yml", ".yaml", ".supp", ""}
# Spelt so that this file does not contain them.
FORBIDDEN = [
    re.compile(word) for word in [
        r"\bTO"
        r"DO\b", r"\bFIX"
        r"ME\b", r"\bXX"
        r"X\b", r"(?i)\bnot "
        r"implemented\b", r"(?i)\bplace"
        r"holder\b", r"(?<![\w.])/wo"
        r"rk/"
    ]
]
FOREIGN = re.compile(r"(?i)drill[\s_-]?(string|pipe)")
BY_NAME = re.compile(r'\b(?:name|law) [!=]= "1"')
PERSONS = re.compile(r"(?i)\b(looked at|unasked|(?:is|are|was|were) (?:asked|told))\b"
                     )  # in product code and pages: verbs of people
INCLUDE = re.compile(r'\s*#\s*include\s*[<"]([^>"]+)[>"]')


def is_source(path):
    return path.suffix in SOURCES or path.name in ("CMakeLists.txt", "quickstart", "run")


def lint_file(root, path):
    relative = path.relative_to(root)
    parts = relative.parts
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except UnicodeDecodeError:
        yield 1, "is not UTF-8 text"
        return
    if is_source(path):
        first = lines[1:2] if lines and lines[0].startswith("#!") else lines[:1]
        if not first or "SPDX-License-Identifier: BSD-3-Clause" not in first[0]:
            yield 1, "has no SPDX-License-Identifier: BSD-3-Clause on its first line"
        if len(lines) > LONGEST:
            yield LONGEST + 1, (f"has {len(lines)} lines, more than {LONGEST}: which two ideas are "
                                "in it?")
    if path.suffix == ".py":
        for number, line in enumerate(lines, 1):
            if len(line) > WIDEST:
                yield number, f"has {len(line)} columns, more than {WIDEST}"
    yield from sizes.of_source(relative.as_posix(), "\n".join(lines))
    if relative.as_posix() == "docs/architecture.md":
        yield from sizes.of_recipes("\n".join(lines))
    spoken = parts[0] in ("src", "substructures", "python", "docs",
                          "examples") or relative.as_posix() in ("README.md", "CONTRIBUTING.md")
    toolkit = parts[0] == "src" and parts[1] != "app"
    bad_deck = parts[:2] == ("tests", "decks") and path.suffix == ".xml"
    for number, line in enumerate(lines, 1):
        for word in [] if bad_deck else FORBIDDEN:
            if match := word.search(line):
                yield number, f"says \"{match.group(0)}\""
        if spoken and (match := PERSONS.search(line)):
            yield number, (f"says \"{match.group(0)}\" of a computation: name what it does "
                           "(evaluated, compared, printed)")
        if toolkit and (match := FOREIGN.search(line)):
            yield number, f"says \"{match.group(0)}\": the toolkit has never heard of it"
        if parts[0] in ("src", "substructures") and BY_NAME.search(line):
            yield number, ("compares the name of a law with \"1\": ScalarLaw::isOne() says whether "
                           "it is constant")
        if path.suffix in (".cpp", ".hpp") and (match := INCLUDE.match(line)):
            if problem := rooms.include_problem(parts, match.group(1)):
                yield number, f"includes {match.group(1)}: {problem}"


def files_of(root, room):
    """The files of a room. In xml/ only decks in git count, since others are a user's own; without
    git (an unpacked archive) all count."""
    if room == "xml":
        listed = subprocess.run(["git", "-C", str(root), "ls-files", "-z", "--", room],
                                stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                                check=False).stdout
        if listed:
            return [root / name for name in listed.split("\0") if name]
    return (root / room).rglob("*")


def modes(root):
    """Complaints about command-line scripts that are not executable."""
    for path in sorted((root / "tools").glob("*.py")):
        if not path.stat().st_mode & stat.S_IXUSR:
            yield f"{path.relative_to(root)}:1: is not executable: chmod +x"


def house(root):
    """Checks that the table of rooms in docs/architecture.md is that of rooms.py."""
    page = root / "docs" / "architecture.md"
    if page.is_file() and rooms.table() not in page.read_text(encoding="utf-8"):
        yield "docs/architecture.md:1: has not the table of rooms that lint.py --rooms prints"


def room_lines(root):
    """Lines of product code of each room, "src/deck"."""
    lines = {}
    for path in [*root.glob("src/**/*"), *root.glob("substructures/**/*")]:
        if path.suffix in (".cpp", ".hpp", ".py") and path.is_file():
            room = "/".join(path.relative_to(root).parts[:2])
            lines[room] = lines.get(room, 0) + len(path.read_text(encoding="utf-8").splitlines())
    return lines


def size_table(root):
    """Complaints about numbers of lines in docs/architecture.md that differ from the tree by more
    than a tenth."""
    page = root / "docs" / "architecture.md"
    rows = re.findall(r"^\| ([a-z, ]+) \| ([\d,]+) \|", page.read_text(
        encoding="utf-8"), re.M) if page.is_file() else []
    left = room_lines(root)
    for names, said in rows:
        if names.startswith("other rooms"):
            mine = sum(count for room, count in left.items() if room.startswith("substructures/"))
        else:
            mine = sum(
                left.pop(f"{side}/{name}", 0) for name in names.split(", ")
                for side in ("src", "substructures"))
        if abs(int(said.replace(",", "")) - mine) > 0.1 * mine:
            yield f"docs/architecture.md:1: says that {names} have {said} lines; they have {mine}"


def strangers(root):
    """Complaints about tracked files at the top level that belong to no folder of the project,
    usually results of a run."""
    listed = subprocess.run(["git", "-C", str(root), "ls-files", "-z"], stdout=subprocess.PIPE,
                            stderr=subprocess.DEVNULL, text=True, check=False).stdout
    known = set(ROOMS) | {".ci"}
    known |= set(TOP) | {"LICENSE"}
    firsts = {
        name.partition("/")[0]: name for name in sorted(listed.split("\0"), reverse=True) if name
    }
    for room in sorted(set(firsts) - known):
        if room != firsts[room] or not room.startswith("."):
            yield (f"{firsts[room]}:1: stands in no room of the project: results of runs stay out "
                   f'of git (git rm -r --cached "{room}")')


def of_all_sources(root, files):
    """Complaints about repeated code in product code, the Python package or tools, and about names
    without their headers."""
    texts = {
        path.relative_to(root).as_posix(): path.read_text(encoding="utf-8", errors="replace")
        for path in files if path.suffix in (".cpp", ".hpp", ".py")
    }
    yield from repeats.of_texts(texts)
    yield from reach.complaints(texts)


def lint(root):
    """All complaints about a tree as texts, and the number of files read."""
    files = [root / name for name in TOP if (root / name).is_file()]
    for room in ROOMS:
        files += sorted(
            path for path in files_of(root, room)
            if path.is_file() and path.suffix in TEXTS and "__pycache__" not in path.parts)
    complaints = [
        f"{path.relative_to(root)}:{line}: {what}" for path in files
        for line, what in lint_file(root, path)
    ]
    complaints += [
        *modes(root), *house(root), *size_table(root), *strangers(root),
        *of_all_sources(root, files),
        *sizes.of_folders(path.relative_to(root).as_posix() for path in files)
    ]
    return complaints, len(files)


def counts(root):
    """Lines and files of each half and of the rooms of product code, and the folders with the most
    sources."""
    folders = {}
    for room in ["src", "substructures", "python", "tests", "tools"]:
        paths = [
            path for path in (root / room).rglob("*")
            if path.is_file() and path.suffix in (".cpp", ".hpp",
                                                  ".py") and "__pycache__" not in path.parts
        ]
        lines = sum(len(path.read_text(encoding="utf-8").splitlines()) for path in paths)
        yield f"{room:<15}{lines:>8} lines{len(paths):>6} files"
        if room in ("src", "substructures", "python"):
            for path in paths:
                folder = path.parent.relative_to(root).as_posix()
                folders[folder] = folders.get(folder, 0) + 1
    yield from (f"{own:<27}{lines:>6} lines" for own, lines in sorted(room_lines(root).items()))
    for folder, files in sorted(folders.items(), key=lambda item: -item[1])[:5]:
        yield f"{folder:<40}{files:>4} sources"


def self_test():
    cases = planted.all_cases(LONGEST)
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, (text, _) in cases.items():
            if text is None:  # a folder
                continue
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text, encoding="utf-8")
        subprocess.run(["git", "init", "-q", str(root)], check=True)
        subprocess.run(["git", "-C", str(root), "add", "run2", "left over.mtx"], check=True)
        complaints, _ = lint(root)
        for name, (_, expected) in cases.items():
            mine = [one for one in complaints if one.startswith(name + ":")]
            wanted = (expected,) if isinstance(expected, str) else expected
            good = not mine if wanted is None else all(
                any(one in complaint for complaint in mine) for one in wanted)
            failures += not good
            print(f"{'ok    ' if good else 'FAILED'} {name}: {mine}")
    return 1 if failures else 0


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    if sys.argv[1:] == ["--rooms"]:
        print(rooms.table(), end="")
        return 0
    if sys.argv[1:2] == ["--counts"]:
        print("\n".join(counts(pathlib.Path(sys.argv[2]).resolve())))
        return 0
    complaints, count = lint(pathlib.Path(sys.argv[1]).resolve())
    print("\n".join(complaints))
    print(f"{count} files read, {len(complaints)} complaints.")
    return 1 if complaints or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
