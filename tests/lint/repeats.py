# SPDX-License-Identifier: BSD-3-Clause
"""Finds repeated code: six or more equal lines in two places of product code, of the Python package
or of tools."""
import re

LEAST = 6  # lines of code that count as a repeat
WHERE = ("src/", "substructures/", "python/", "tools/")
# Lines that are ignored: comments, includes, braces, and the functions that every implementation of
# an interface declares.
NO_CODE = re.compile(r"(//|#|using |namespace |import |from \S+ import |return;|[{}();\])]*$|else "
                     r"\{|\} else \{|public:|private:)|.*\boverride\b")


def code(text):
    """(line number, code) of the lines that count, with one blank for each gap."""
    for number, line in enumerate(text.splitlines(), 1):
        line = " ".join(re.sub(r"\s//.*", "", line).split())
        if not NO_CODE.match(line):
            yield number, line


def of_texts(texts):
    """Complaints about repeated code in `texts`, {relative name: text}; one for each repeat, of any
    length."""
    seen = {}
    for name, text in sorted(texts.items()):
        if not name.startswith(WHERE) or not name.endswith((".cpp", ".hpp", ".py")):
            continue
        lines, last = list(code(text)), None
        for i in range(len(lines) - LEAST + 1):
            found = seen.setdefault(tuple(line for _, line in lines[i:i + LEAST]),
                                    (name, lines[i][0], i))
            first, number, at = found
            if (first, at) == (name, i):
                last = None
            elif last != (first, at - 1):
                yield (f"{name}:{lines[i][0]}: {LEAST} lines or more of code stand in "
                       f"{first}:{number}, too")
                last = (first, at)
            else:
                last = (first, at)
