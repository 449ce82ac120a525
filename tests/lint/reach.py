# SPDX-License-Identifier: BSD-3-Clause
"""Finds names of src/common in sources whose includes do not reach the declaring header. Sources of
a folder are compiled together, so a compiler can find such a name through another source."""
import pathlib
import re

INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.M)
# Declarations of a namespace: they begin in the first column.
DECLARED = re.compile(
    r"^(?:using (\w+) =|(?:class|struct|enum class) (\w+)\b[^;]*\{|"
    r"(?:template <[^>]*>\s*)?(?:inline |constexpr )*[\w:]+(?:<[^;={]*>)?[ &*]+(\w+)\()", re.M)
TEXT = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', re.S)
ROOM = "src/common/"
CAMEL = re.compile(r"[A-Z]")  # a name without a capital letter may be a local variable


def without_texts(source):
    """The code, without comments and literals."""
    return TEXT.sub('""', source)


def owners(sources):
    """Name -> its header, for the names declared by exactly one header of src/common."""
    found = {}
    for name, code in sources.items():
        if not name.endswith(".hpp"):
            continue
        for groups in DECLARED.findall(code):
            found.setdefault("".join(groups), set()).add(name)
    return {
        word: next(iter(headers)) for word, headers in found.items()
        if len(headers) == 1 and next(iter(headers)).startswith(ROOM) and CAMEL.search(word)
    }


def complaints(texts):
    """One for each name. `texts`: path below the project -> text of a source."""
    includes, codes = {}, {}
    for name, text in texts.items():
        if name.split("/")[0] not in ("src", "substructures") or name.endswith(".py"):
            continue
        near = str(pathlib.PurePosixPath(name).parent)
        includes[name] = [
            path for header in INCLUDE.findall(text)
            for path in (f"src/{header}", header, f"{near}/{header}") if path in texts
        ]
        codes[name] = without_texts(text)
    owned = owners(codes)
    if not owned:
        return
    used = re.compile(r"(?<![\w.>~])(?:(?<!:)|(?<=tooljoint::)|(?<=parallel::)|(?<=log::))(" +
                      "|".join(map(re.escape, owned)) + r")\b")
    for name, code in codes.items():
        reached, new = {name}, [name]
        while new:
            more = [path for path in includes[new.pop()] if path not in reached]
            reached.update(more)
            new += more
        for word in sorted(set(used.findall(code))):
            own = re.search(rf"\b(?:class|struct) {word}\b|^ +\w+& {word}\(", code, re.M)
            if owned[word] not in reached and not own:
                line = code[:re.search(rf"\b{word}\b", code).start()].count("\n") + 1
                yield (f"{name}:{line}: names {word}, but its includes do not reach "
                       f"{owned[word].removeprefix('src/')}")
