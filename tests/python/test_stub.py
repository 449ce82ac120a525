# SPDX-License-Identifier: BSD-3-Clause
"""Checks that python/tooljoint/_core.pyi agrees with the module. `test_stub.py --update` writes
it."""
import inspect
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

from tooljoint import _core

STUB = pathlib.Path(os.environ["TOOLJOINT_SOURCE_DIR"]) / "python/tooljoint/_core.pyi"
HEAD = '''# SPDX-License-Identifier: BSD-3-Clause
# Written by tests/python/test_stub.py --update.
from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy
import scipy.sparse
from numpy.typing import ArrayLike

'''


def typed(signature):
    """Converts types of pybind11 to those of Python: classes of this module, arrays; arguments may
    be anything that can be converted."""
    signature = re.sub(r"numpy\.ndarray\[(?:[^\[\]]|\[[^\[\]]*\])*\]", "numpy.ndarray", signature)
    signature = signature.replace("tooljoint._core.", "").replace("tooljoint::python::", "")
    signature = re.sub(r"\bUnion\[None, (.*?)\] = None",
                       lambda found: found[1].replace(", ", " | ") + " | None = None", signature)
    signature = re.sub(r"\bOptional\[([^\[\]]*)\]", r"\1 | None", signature)
    signature = re.sub(r": (Model) = None", r": \1 | None = None", signature)
    for old, new in (("List[", "list["), ("Tuple[", "tuple["), ("Dict[", "dict["),
                     ("array([], dtype=float64)", "..."), (": object", ": Any"),
                     ("-> object", "-> Any"), ("numpy.dtype", "Any")):
        signature = signature.replace(old, new)
    arguments, result = signature.rsplit("->", 1)
    arguments = arguments.replace("numpy.ndarray", "ArrayLike").replace("list[", "Iterable[")
    return arguments + "->" + result


def function(name, doc, indent=""):
    """Stub of a function from its docstring, whose first line is its signature."""
    lines = doc.strip().splitlines()
    text = " ".join(line.strip() for line in lines[1:] if line.strip())
    signature = typed(lines[0][lines[0].index("("):])
    return (f'{indent}def {name}{signature}:\n{indent}    """{text}"""\n'
            ) if text else f"{indent}def {name}{signature}: ...\n"


def members(cls):
    text = f'class {cls.__name__}:\n    """{cls.__doc__}"""\n'
    for name, one in sorted(vars(cls).items()):
        if isinstance(one, property):
            result = typed(one.fget.__doc__.strip().splitlines()[0]).split("->")[-1].strip()
            text += (f'    @property\n    def {name}(self) -> {result}:\n'
                     f'        """{one.__doc__}"""\n')
        elif (not name.startswith("_")
              or name in ("__init__", "__len__", "__repr__")) and "(self: " in (one.__doc__ or ""):
            text += function(name, re.sub(r"self: [\w.]+(?:\[[\w.]*\])?", "self", one.__doc__),
                             "    ")
    return text + "\n"


def stub():
    names = {name: one for name, one in vars(_core).items() if not name.startswith("_")}
    classes = [members(one) for _, one in sorted(names.items()) if inspect.isclass(one)]
    functions = [
        function(name, one.__doc__) for name, one in sorted(names.items())
        if not inspect.isclass(one)
    ]
    return HEAD + "\n".join(classes) + "\n" + "\n".join(functions)


class Types(unittest.TestCase):
    @unittest.skipUnless(shutil.which("mypy"), "mypy is not installed")
    def test_the_package_fits_its_stub(self):
        command = [
            "mypy", "--ignore-missing-imports", "--python-executable", sys.executable,
            "--cache-dir", "mypy",
            str(STUB.parent)
        ]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout)


class Stub(unittest.TestCase):
    def test_it_is_that_of_the_module(self):
        written, now = STUB.read_text(encoding="utf-8"), stub()
        self.assertEqual(
            written, now,
            "python/tooljoint/_core.pyi is old: run tests/python/test_stub.py --update")

    def test_it_is_python(self):
        compile(stub(), str(STUB), "exec")

    def test_everything_has_a_docstring(self):
        for line in stub().splitlines():
            self.assertFalse(
                line.endswith(": ...") and "__" not in line, f"{line} has no docstring")


if __name__ == "__main__":
    if sys.argv[1:] == ["--update"]:
        STUB.write_text(stub(), encoding="utf-8")
    else:
        unittest.main()
