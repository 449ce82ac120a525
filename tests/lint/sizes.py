# SPDX-License-Identifier: BSD-3-Clause
"""Sizes checked by lint.py: files of a folder, data members of a class, lines of a recipe."""
import re

FILES = 20  # of a folder of product code
MEMBERS = 25  # data members of a class
RECIPE = 20  # lines of a recipe for an extension
PRODUCT = ("src", "substructures", "python/core")
NO_MEMBER = re.compile(
    r"^(using|typedef|friend|enum|class|struct|union|template|static|public|private|protected)\b")
HEAD = re.compile(
    r"\b(class|struct)\s+(?:alignas\([^)]*\)\s*)?([A-Za-z_][\w:]*)(?:\s+final)?\s*(?::[^;{}]*)?\{")


def plain(text):
    """The code without comments, and with empty strings."""
    text = re.sub(r'R"(\w*)\((.*?)\)\1"', '""', text, flags=re.S)
    return re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', lambda m: '""'
                  if m.group(0)[0] in "\"'" else "", text, flags=re.S)


def statements(text, begin):
    """Statements of the body that begins at `begin`, without nested braces."""
    depth, statement, i = 1, "", begin
    while i < len(text) and depth:
        c = text[i]
        if c == "{":
            depth += 1
        elif c == "}":
            depth -= 1
            if depth == 1 and re.search(r"\)\s*(const|noexcept|override|final|\s)*(:.*)?$",
                                        statement, re.S):
                statement = ""  # the body of a function
        elif depth == 1 and c == ";":
            yield " ".join(statement.split())
            statement = ""
        elif depth == 1:
            statement += c
        i += 1


def members(statement):
    """Number of data members declared by a statement of a class."""
    statement = re.sub(r"^((public|private|protected)\s*:\s*)+", "", statement)
    while (shorter := re.sub(r"<[^<>]*>", "", statement)) != statement:
        statement = shorter
    if re.match(r"(struct|class) \w+ +\w+$", statement):
        return 1  # a type defined in the declaration
    if not statement or NO_MEMBER.match(statement):
        return 0
    names = re.sub(r"=[^,]*", "", statement)
    return 0 if "(" in names or len(names.split()) < 2 else names.count(",") + 1


def classes(text):
    """(line, name, data members) of every class and struct."""
    text = plain(text)
    for head in HEAD.finditer(text):
        if not re.search(r"\benum\s*$", text[:head.start()]):
            yield text.count("\n", 0, head.start()) + 1, head.group(2), sum(
                map(members, statements(text, head.end())))


def of_source(relative, text):
    if relative.startswith(PRODUCT) and relative.endswith((".hpp", ".cpp")):
        for line, name, count in classes(text):
            if count > MEMBERS:
                yield line, (f"{name} has {count} data members, more than {MEMBERS}: which two "
                             "ideas are in it?")


def of_folders(names):
    """Complaints about folders of product code; `names`: files with their folders."""
    folders = {}
    for name in names:
        if name.startswith(PRODUCT):
            folders.setdefault(name.rpartition("/")[0], []).append(name)
    for folder, files in sorted(folders.items()):
        if len(files) > FILES:
            yield (f"{folder}:1: has {len(files)} files, more than {FILES}: which two concepts are "
                   "in it?")


def of_recipes(text):
    """(line, complaint) about the recipes of docs/architecture.md; a recipe ends at the next bold
    word."""
    lines = text.splitlines()
    if "## Recipes" not in lines:
        return
    begins = [i for i in range(lines.index("## Recipes"), len(lines)) if lines[i].startswith("**")
              ] + [len(lines)]
    for begin, end in zip(begins, begins[1:]):
        count = len("\n".join(lines[begin:end]).strip().splitlines())
        if count > RECIPE:
            yield begin + 1, f"a recipe of {count} lines, more than {RECIPE}"
