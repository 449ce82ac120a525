# SPDX-License-Identifier: BSD-3-Clause
"""The examples in the docstrings of the package, as doctests."""
import doctest
import os
import pathlib
import sys
import unittest

import tooljoint
import tooljoint.plots  # not part of the package without matplotlib

SCENE = str(pathlib.Path(os.environ["TOOLJOINT_SOURCE_DIR"]) / "xml/frame.xml")
NAMES = sorted(
    name for name in sys.modules if name.startswith("tooljoint.") and name != "tooljoint._core")


class Docstrings(unittest.TestCase):
    def test_examples(self):
        attempted = 0
        for name in NAMES:
            with self.subTest(name):
                done = doctest.testmod(sys.modules[name], extraglobs={"example_deck": SCENE},
                                       optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
                self.assertEqual(done.failed, 0)
                attempted += done.attempted
        self.assertGreater(attempted, 40)

    def test_everything_public_has_a_docstring(self):
        for name in tooljoint.__all__:
            one = getattr(tooljoint, name)
            self.assertTrue((one.__doc__ or "").strip(), f"{name} has no docstring")
            for method, function in vars(one).items() if isinstance(one, type) else ():
                if not method.startswith("_") and callable(function):
                    self.assertTrue((function.__doc__ or "").strip(),
                                    f"{name}.{method} has no docstring")


if __name__ == "__main__":
    unittest.main()
