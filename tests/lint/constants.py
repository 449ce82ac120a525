#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the numbers of an implicit step agree in src/transient/Tuned.hpp, in its table in
docs/step-constants.md, and in the code.

    constants.py PROJECT        prints file:line: what is wrong, exit code 1 if anything is
    constants.py --self-test    shows that each rule detects its fault

Tuned numbers of a step are in Tuned.hpp and, with their values, in the first table of the page. All
other named numbers of the loop are in the second table; numbers without a name must be those of
formulas (FORMULA). Named numbers of the code that judges and measures a run are in the third table,
with value and file.
"""
import pathlib
import re
import sys
import tempfile

TUNED, PAGE = pathlib.Path("src/transient/Tuned.hpp"), pathlib.Path("docs/step-constants.md")
LOOP = ("src/transient/contact/*.?pp", "src/transient/compiled/*.?pp", "src/transient/points/*.?pp",
        "src/transient/implicit/*.?pp", "src/transient/schemes/ImplicitStep.?pp",
        "src/transient/schemes/AlphaStep.?pp", "src/transient/schemes/GeneralizedAlpha.cpp")
JUDGES = ("src/transient/verdict/*.?pp", "src/transient/accuracy/*.?pp")
MOST = 30  # tuned numbers
FORMULA = {"0.0", "0.1", "0.25", "0.5", "1.0", "2.0",
           "4.0"}  # powers of two and a tenth of another number
NAMED = re.compile(r"\bconstexpr\s+(?:double|int|long|auto|std::size_t)\s+([^;]*);")
LITERAL = re.compile(r"(?<![\w.])(?:\d+\.\d*|\d*\.\d+|\d+(?=e))(?:e[+-]?\d+)?(?![\w.])",
                     re.IGNORECASE)


def code(text):
    """Text of a source with comments and strings blanked, line by line."""
    text = re.sub(r'"(?:\\.|[^"\\])*"', lambda m: '""' + "\n" * m[0].count("\n"), text)
    return re.sub(r"//[^\n]*|/\*.*?\*/", lambda m: "\n" * m[0].count("\n"), text, flags=re.DOTALL)


def declared(text):
    """(line, name, value) of the named numbers."""
    for found in NAMED.finditer(text):
        line = text.count("\n", 0, found.start()) + 1
        for part in re.split(r",(?![^(]*\))", found[1]):
            name, _, value = part.partition("=")
            yield line, name.strip(), " ".join(value.split())


def tables(page):
    """{name: value} of the tables of the page, tuned numbers and others, and {(file, name): value}
    of the third."""
    found = []
    for line in page.splitlines():
        if re.match(r"\|\s*-", line):
            found.append({})
        elif found and (cells := [cell.strip()
                                  for cell in line.split("|")[1:-1]]) and cells[0].startswith("`"):
            name = cells[0].strip("`")
            found[-1][name if len(found) < 3 else (cells[2], name)] = cells[1]
    return (found + [{}, {}, {}])[:3]


def complaints(root):
    page = (root / PAGE).read_text(encoding="utf-8")
    tuned, others, judging = tables(page)
    in_code = {
        name: (line, value)
        for line, name, value in declared(code((root / TUNED).read_text(encoding="utf-8")))
    }
    for name, (line, value) in in_code.items():
        if name not in tuned:
            yield (f"{TUNED}:{line}: {name} is not in the first table of {PAGE}: which case needs "
                   "it, and over which range do results not care?")
        elif float(tuned[name]) != float(value):
            yield f"{TUNED}:{line}: {name} is {value}, {tuned[name]} in {PAGE}"
    for name in sorted(set(tuned) - set(in_code)):
        yield f"{PAGE}:1: {name} is not in {TUNED} any more"
    if len(tuned) > MOST:
        yield (f"{PAGE}:1: lists {len(tuned)} tuned numbers, more than {MOST}: which can be merged "
               "or removed?")
    seen = set()
    for path in sorted(path for pattern in LOOP for path in root.glob(pattern)):
        text, where = code(path.read_text(encoding="utf-8")), path.relative_to(root)
        for line, name, _ in declared(text):
            seen.add(name)
            if name not in others:
                yield (f"{where}:{line}: {name} is a named number: it belongs in {TUNED}, or in "
                       f"the second table of {PAGE}")
        for number, line in enumerate(
                NAMED.sub(lambda m: "\n" * m[0].count("\n"), text).splitlines(), 1):
            for literal in LITERAL.findall(line):
                if literal not in FORMULA:
                    yield f"{where}:{number}: {literal} has no name: it belongs in {TUNED}"
    for name in sorted(set(others) - seen):
        yield f"{PAGE}:1: {name} is no number of the loop any more"
    for path in sorted(path for pattern in JUDGES for path in root.glob(pattern)):
        for line, name, value in declared(code(path.read_text(encoding="utf-8"))):
            listed = judging.pop((path.stem, name), None)
            if listed != value:
                yield (f"{path.relative_to(root)}:{line}: {name} is {value}, "
                       f"{listed or 'not there'} in the third table of {PAGE}")
    for file, name in sorted(judging):
        yield f"{PAGE}:1: {name} is no number of {file} any more"


def self_test():
    tuned = "struct Tuned {\n  static constexpr double a = 0.5, b = 1e-3;  ///< of 1e9\n};\n"
    table = ("| n | v |\n|---|---|\n| `a` | 0.5 |\n| `b` | 1e-3 |\n\n| n | v |\n|---|---|\n"
             "| `c` | fit |\n")
    cases = [  # Tuned.hpp, page, a source, part of the complaint (None: no complaint)
        (tuned, table, "constexpr int c = 3;\nx = 0.5 * Tuned::a + 1e-300;  // 0.7\n",
         "1e-300 has no name"),
        (tuned, table, "constexpr int c = 3;\nx = 0.5 * Tuned::a;  // 0.7\n", None),
        (tuned, table, "constexpr int c = 3, d = 4;\n", "d is a named number"),
        (tuned, table, "int c = 3;\n", "c is no number of the loop"),
        (tuned.replace("0.5", "0.6"), table, "constexpr int c = 3;\n", "a is 0.6, 0.5 in"),
        (tuned, table.replace("`b`",
                              "`e`"), "constexpr int c = 3;\n", "b is not in the first table"),
        (tuned, table.replace("| `b`",
                              "| `e` | 1 |\n| `b`"), "constexpr int c = 3;\n", "e is not in"),
        (tuned, table.replace("| `b`", "".join(f"| `x{i}` | 1 |\n" for i in range(MOST)) + "| `b`"),
         "constexpr int c = 3;\n", "more than"),
    ]
    judge = pathlib.Path("src/transient/verdict/B.cpp")
    third = table + "\n| n | v | f |\n|---|---|---|\n| `d` | 0.25 | B |\n"
    judged = [
        ("constexpr double d = 0.25;\n", None),
        ("constexpr double d = 0.3;\n", "d is 0.3, 0.25 in"),
        ("constexpr double d = 0.25, e = 2;\n", "e is 2, not there"),
        ("int d = 1;\n", "d is no number of B"),
    ]
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        loop = "constexpr int c = 3;\n"
        for header, page, source, judging, expected in [
            (*case[:3], "", case[3]) for case in cases
        ] + [(tuned, third, loop, *case) for case in judged]:
            for path, text in (
                (TUNED, header),
                (PAGE, page),
                (pathlib.Path("src/transient/contact/A.cpp"), source),
                (judge, judging),
            ):
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(text, encoding="utf-8")
            found = list(complaints(root))
            right = not found if expected is None else any(expected in one for one in found)
            failures += not right
            if not right:
                print(f"expected {expected!r}, found {found}")
    print(f"{len(cases) + len(judged)} cases, {failures} failures")
    return 1 if failures else 0


def main():
    if "--self-test" in sys.argv:
        return self_test()
    found = list(complaints(pathlib.Path(sys.argv[1])))
    for one in found:
        print(one)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
