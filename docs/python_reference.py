# SPDX-License-Identifier: BSD-3-Clause
"""Directive of the documentation site for the Python package. It reads the sources without
importing them.

    ```{python-reference} tooljoint
    part
    Deck
    ```

shows the signatures and docstrings of these names of the module, for classes with all public
members. An unknown name is an error, and so is a public name of a module that is on no page.
"""
import ast
import inspect
import pathlib
import re

from docutils import nodes
from docutils.statemachine import StringList
from sphinx.errors import ExtensionError
from sphinx.util.docutils import SphinxDirective

PROJECT = pathlib.Path(__file__).resolve().parents[1]
MODULES = {"tooljoint": PROJECT / "python/tooljoint",
           "tooljoint.plots": PROJECT / "tools/plots"}  # each with an __init__.py
OPERATORS = {
    "__len__": "len(self)", "__getitem__": "self[{0}]", "__setitem__": "self[{0}] = {1}",
    "__delitem__": "del self[{0}]", "__contains__": "{0} in self", "__iter__": "iter(self)"
}


def definitions(file):
    """Functions, classes and plain assignments of a source by their names."""
    found = {}
    for node in ast.parse(file.read_text(encoding="utf-8")).body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            found[node.name] = node
        elif isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            found[node.targets[0].id] = node
    return found


def public(folder):
    """Names that the __init__.py of a module offers to users: {name: definition}."""
    first = folder / "__init__.py"
    found = {name: node for name, node in definitions(first).items() if not name.startswith("_")}
    for node in ast.parse(first.read_text(encoding="utf-8")).body:
        if not isinstance(node, ast.ImportFrom) or node.level != 1 or node.module is None:
            continue
        file = next(file for file in (folder / f"{node.module}.py", folder / f"{node.module}.pyi")
                    if file.exists())
        known = definitions(file)
        found |= {alias.asname or alias.name: known[alias.name] for alias in node.names}
    return found


def known_to(module):
    """Names of a module that a page may use; for tooljoint._core these include the results of
    calls."""
    return definitions(MODULES["tooljoint"] /
                       "_core.pyi") if module == "tooljoint._core" else public(MODULES[module])


def signature(node, method=False):
    """Arguments and result of a function, without the object of a method."""
    arguments = ast.unparse(node.args)
    if method:
        arguments = re.sub(r"^self(, )?", "", arguments)
    result = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    return f"({arguments}){result}".replace("_core.", "")


def prose(node):
    """A docstring as Markdown: examples become blocks of code, descriptions of arguments a list."""
    functions = [
        one for one in [node, *getattr(node, "body", [])] if isinstance(one, ast.FunctionDef)
    ]
    arguments = {
        each.arg for one in functions for each in
        [*one.args.args, *one.args.kwonlyargs, *filter(None, [one.args.vararg, one.args.kwarg])]
    }
    lines, example, item = [], False, False
    for line in inspect.cleandoc(ast.get_docstring(node) or "").splitlines():
        named = re.match(r"(\w+(?:(?:, | and )\w+)*): ", line)
        if named and not example and set(re.split(", | and ", named[1])) <= arguments:
            lines, item = lines if item else [*lines, ""], True
            line = f"- `{named[1]}`: {line[named.end():]}"
        elif item:
            item = bool(line.strip())
            line = f"  {line}" if item else line
        if line.startswith(">>>") and not example:
            lines, example = [*lines, "```python"], True
        elif not line.strip() and example:
            lines, example = [*lines, "```"], False
        lines.append(line)
    return "\n".join([*lines, *["```"] * example])


def directive(kind, head, module, body, ticks, options=()):
    fence = "`" * ticks
    return "\n".join(
        [f"{fence}{{py:{kind}}} {head}", f":module: {module}", *options, "", body, fence, ""])


def member(node, module, cls):
    """A method or property of a class as Markdown; operators are shown as they are used."""
    decorators = [ast.unparse(one) for one in node.decorator_list]
    if "property" in decorators:
        options = [f":type: {ast.unparse(node.returns)}".replace("_core.", "")
                   ] if node.returns else []
        return directive("property", f"{cls}.{node.name}", module, prose(node), 4, options)
    if node.name in OPERATORS:
        used = OPERATORS[node.name].format(*[one.arg for one in node.args.args[1:]])
        return f"`{used.replace('self', cls.lower())}`: {prose(node)}\n" if prose(node) else ""
    return directive("method", f"{cls}.{node.name}{signature(node, True)}", module, prose(node), 4)


def shown(name, node, module):
    """A definition as Markdown."""
    if isinstance(node, ast.FunctionDef):
        return directive("function", name + signature(node), module, prose(node), 5)
    if isinstance(node, ast.Assign):
        return directive(
            "data", name, module,
            f"`{ast.unparse(node.value)}`" if len(ast.unparse(node.value)) < 100 else "", 5)
    methods = [one for one in node.body if isinstance(one, ast.FunctionDef)]
    start = next((one for one in methods if one.name == "__init__"), None)
    members = [
        member(one, module, name) for one in methods
        if not one.name.startswith("_") or one.name in OPERATORS
    ]
    exception = any(ast.unparse(base).endswith(("Error", "Exception")) for base in node.bases)
    return directive("exception" if exception else "class",
                     name + (signature(start, True) if start and not exception else ""), module,
                     "\n".join([prose(node), "", *members]), 6)


class PythonReference(SphinxDirective):
    has_content = True
    required_arguments = 1

    def run(self):
        module = self.arguments[0]
        known = known_to(module)
        for folder in MODULES.values():
            for file in folder.glob("*.py*"):
                self.env.note_dependency(str(file))
        text = []
        for name in filter(None, map(str.strip, self.content)):
            if name not in known:
                raise self.error(f"{module} has no {name}.")
            self.env.metadata[self.env.docname][f"python {module}.{name}"] = "shown"
            text.append(shown(name, known[name], module))
        node = nodes.container()
        self.state.nested_parse(StringList("\n".join(text).splitlines(), source=self.env.docname),
                                self.content_offset, node)
        return node.children


def complete(app, env):
    """Every public name of the modules is on a page."""
    there = {
        key.split(" ", 1)[1] for page in env.metadata.values() for key in page
        if key.startswith("python ")
    }
    absent = [
        f"{module}.{name}" for module, folder in MODULES.items() for name in public(folder)
        if f"{module}.{name}" not in there
    ]
    if absent:
        raise ExtensionError(
            f"No page of the site shows {', '.join(absent)}: name it in docs/api/python.md.")


def setup(app):
    app.add_directive("python-reference", PythonReference)
    app.connect("env-updated", complete)
    return {"parallel_read_safe": True}
