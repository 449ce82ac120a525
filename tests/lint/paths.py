#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the parameter paths in docs/parameters.md and other pages exist in that manual.

    paths.py PARAMETERS [PAGE ...] | --self-test

A path is the name of a list, a "/" and a word, which must be a list or parameter of that list.
Paths are plain text in the descriptions of parameters, and between backticks in pages.
"""
import collections
import pathlib
import re
import sys

WORD = r"[A-Z][\w-]*"
PATH = re.compile(rf"{WORD}(?: [\w-]+)*(?:/{WORD}(?: [\w-]+)*)+")


def declared(text):
    """Names in each list, by the name of the list: {"Transient": {"Step", "Generalized-alpha",
    ...}}; None for a list whose names are chosen by the user."""
    inside = collections.defaultdict(set)
    for line in text.splitlines():
        if heading := re.match(r"#+ (\S.*)", line):
            path = [
                None if name.startswith("\\<") else name for name in heading.group(1).split("/")
            ]
            for outer, inner in zip(path, path[1:]):
                inside[outer].add(inner)
        elif row := re.match(r"\| `([^`]+)` \|", line):
            inside[path[-1]].add(row.group(1))
    return inside


def ends(words, names):
    """The longest name that ends the words."""
    return next((name for n in range(len(words)) if (name := " ".join(words[n:])) in names), None)


def begins(words, names):
    """The longest name that begins the words."""
    return next((name for n in range(len(words), 0, -1) if (name := " ".join(words[:n])) in names),
                None)


def faults(text, inside):
    """Paths in a text that do not exist."""
    found = []
    for match in PATH.finditer(text):
        parts = [part.split() for part in match.group().split("/")]
        for before, behind in zip(parts, parts[1:]):
            outer = ends(before, inside)
            if outer is None or None in inside[outer]:
                continue
            if begins(behind, inside[outer]) is None:
                found.append(f'{outer}/{" ".join(behind)}: "{outer}" has no such list or parameter')
    return found


def complaints(parameters, pages):
    text = parameters.read_text(encoding="utf-8")
    inside = declared(text)
    texts = [(parameters.name, line) for line in text.splitlines() if not line.startswith("#")]
    for page in pages:
        texts += [(page.name, quoted)
                  for quoted in re.findall(r"`([A-Z][^`\n]*)`", page.read_text(encoding="utf-8"))]
    return [f"{name}: {fault}" for name, text in texts for fault in faults(text, inside)]


def self_test():
    inside = declared("## Scene\n### Scene/Reduction\n| `Basis` | string |\n"
                      "#### Scene/Reduction/Mode Selection\n| `Cut-off Frequency` | double |\n"
                      "### Scene/Loads/\\<Load>\n")
    assert not faults(
        "Reduce Reduction/Mode Selection/Cut-off Frequency below that, or COPPE/UFRJ, Loads/Mine",
        inside)
    assert len(faults("Path: Reduction/Cut-off Frequency, Basis", inside)) == 1
    assert len(faults("Reduction/Mode Selection/Basis", inside)) == 1
    assert not faults("Scene/Reduction and Reduction/Basis differ", inside)
    return 0


def main():
    if "--self-test" in sys.argv:
        return self_test()
    parameters, *pages = map(pathlib.Path, sys.argv[1:])
    found = complaints(parameters, pages)
    print("\n".join(found + [f"{len(found)} paths lead nowhere."]))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
