#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the width of prose in Markdown pages: 100 columns. Pages must not have tabs: a tab in a
formula is a \\t without its backslash.

    wrap.py PAGE...            names the pages with wider paragraphs or tabs, exit code 1 if there
                               are any
    wrap.py --update PAGE...   wraps those paragraphs; code, tables, headings, formulas and pictures
                               are not changed
    wrap.py --self-test        shows that it detects such lines
"""
import pathlib
import re
import sys
import textwrap

WIDTH = 100
GLUE = "\0"  # replaces a blank at which a line must not break
UNBROKEN = re.compile(r"`+[^`]+`+|\$[^$\n]+\$|!?\[[^\]]*\]\([^)]*\)")
ITEM = re.compile(r"(\s*(?:[-*+]|\d+[.)])\s+)(.*)$")
STANDS = re.compile(
    r"\s*(#|\||<|>|!\[|\(.*\)=$|---|===|\[\^?[^\]]+\]:)")  # starts of lines that are not changed
FENCE = re.compile(r"\s*(```+|~~~+|\$\$|<!--)")
CONTROL = re.compile(r"[\x00-\x09\x0b-\x1f]")
MARKUP = re.compile(r"([-+*#>|=:]|\d+[.)])(\s|$)|~|<")  # markup at the start of a line


def filled(first, rest, text):
    """Lines of at most WIDTH columns with the prefixes `first` and `rest`; no line begins with
    markup."""
    text = UNBROKEN.sub(lambda found: found[0].replace(" ", GLUE), " ".join(text.split()))
    while True:
        lines = textwrap.wrap(text, WIDTH, initial_indent=first, subsequent_indent=rest,
                              break_long_words=False, break_on_hyphens=False)
        bad = next((line[len(rest):] for line in lines[1:] if MARKUP.match(line[len(rest):])), None)
        if bad is None:
            return [line.replace(GLUE, " ") for line in lines]
        text = text.replace(" " + bad, GLUE + bad, 1)


def end_of(line):
    """The end mark of the block that the line opens; "" if it opens none or also ends it."""
    start = FENCE.match(line)
    if not start:
        return ""
    end = "-->" if start[1] == "<!--" else start[1]
    return "" if end in line[start.end():] else end


def is_code(line, before):
    """An indented line after an empty one, unless it continues an item of a list."""
    if not re.match(r" {4}|\t", line) or (before and before[-1].strip()):
        return False
    left = next((each for each in reversed(before) if each.strip() and not each.startswith(" ")),
                "")
    return not ITEM.match(left)


def paragraph(lines, at):
    """Position after the paragraph or item that begins at `at`."""
    end = at + 1
    while end < len(lines) and lines[end].strip() and not (ITEM.match(lines[end]) or FENCE.match(
            lines[end]) or STANDS.match(lines[end])):
        end += 1
    return end


def wrapped(text):
    """The text of a page with its wide paragraphs wrapped."""
    lines, out, at, fence = text.split("\n"), [], 0, ""
    while at < len(lines):
        line = lines[at]
        if fence or FENCE.match(line) or not line.strip() or STANDS.match(line) or is_code(
                line, out):
            fence = ("" if fence in line else fence) if fence else end_of(line)
            out.append(line)
            at += 1
            if not fence and is_code(line, out[:-1]):
                while at < len(lines) and re.match(r" {4}|\t", lines[at]):
                    out.append(lines[at])
                    at += 1
            continue
        end = paragraph(lines, at)
        block, at = lines[at:end], end
        if max(map(len, block)) <= WIDTH or any(each.endswith(("  ", "\\")) for each in block):
            out += block
            continue
        item = ITEM.match(block[0])
        first = item[1] if item else re.match(r"\s*", block[0])[0]
        out += filled(first, " " * len(first), " ".join([block[0][len(first):], *block[1:]]))
    return "\n".join(out)


def self_test():
    wide = "word " * 30
    cases = {  # a page and whether it changes
        wide + "\n": True, "short\nlines\n": False, f"```sh\n{wide}\n```\n": False,
        f"| {wide}|\n": False, f"# {wide}\n": False, f"text\n\n    {wide}\n    {wide}\n": False,
        f"- item {wide}\n  goes on\n": True, f"$$\n{wide}\n$$ (label)\n": False,
        f"<!--\n{wide}\n-->\n": False
    }
    faults = [
        page for page, changes in cases.items() if (wrapped(page) != page) != changes
        or max(map(len,
                   wrapped(page).split("\n"))) > (WIDTH if changes else 200)
    ]
    marked = wrapped("a " * 49 + "word - and more of it " * 3 + "`code of words` " * 9)
    faults += [line for line in marked.split("\n") if MARKUP.match(line) or line.count("`") % 2]
    faults += [page for page in ("$$\n\text{x}\n$$\n", "\frac") if not CONTROL.search(page)]
    faults += [page for page in cases if CONTROL.search(page)]
    print("\n".join(faults) or "all caught")
    return 1 if faults else 0


def main():
    arguments = sys.argv[1:]
    if arguments == ["--self-test"]:
        return self_test()
    update = arguments[:1] == ["--update"]
    wide, spoilt = [], False
    for path in map(pathlib.Path, arguments[update:]):
        text = path.read_text(encoding="utf-8")
        for found in CONTROL.finditer(text):
            print(f"{path}:{text.count(chr(10), 0, found.start()) + 1}: has {found[0]!r}")
            spoilt = True
        if wrapped(text) == text:
            continue
        wide.append(path)
        if update:
            path.write_text(wrapped(text), encoding="utf-8")
    for path in wide:
        advice = f"has prose of more than {WIDTH} columns: tests/lint/wrap.py --update {path}"
        print(f"{path}: {'wrapped' if update else advice}")
    return 1 if spoilt or (wide and not update) else 0


if __name__ == "__main__":
    sys.exit(main())
