# SPDX-License-Identifier: BSD-3-Clause
"""The blocks of docs/python.md run unchanged, with the stated results."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

SOURCE = pathlib.Path(os.environ["TOOLJOINT_SOURCE_DIR"])
BLOCKS = re.findall(r"```python\n(.*?)```", (SOURCE / "docs/python.md").read_text(encoding="utf-8"),
                    re.DOTALL)
CHECKS = """
assert method == "Krylov" and len(rows) == 9
lines = {line.get_label(): line.get_ydata() for line in plt.gca().get_lines()}
assert list(lines) == ["Craig-Bampton", "Rubin", "Krylov"], list(lines)
for name, errors in lines.items():
    assert errors[-1] < 1e-3 < errors[0], f"{name}: {errors}"
"""


def run(code):
    """Output of a block in a separate process, with the frame of xml/ beside it."""
    shutil.copy(SOURCE / "xml/frame.xml", "frame.xml")
    shutil.copytree(SOURCE / "xml/frame", "frame", dirs_exist_ok=True)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False,
                          env={**os.environ, "MPLBACKEND": "Agg"})
    if done.returncode:
        raise AssertionError(done.stderr)
    return done.stdout


class Scripts(unittest.TestCase):
    def test_they_are_cells_and_have_their_figures(self):
        page = (SOURCE / "docs/python-figures.md").read_text(encoding="utf-8")
        scripts = [
            path for path in sorted((SOURCE / "examples/python").glob("*.py"))
            if path.name != "common.py"
        ]
        self.assertGreaterEqual(len(scripts), 4)
        for script in scripts:
            _, *cells = re.split(r"^# %% ", script.read_text(encoding="utf-8"), flags=re.M)
            self.assertGreaterEqual(len(cells), 4, script.name)
            for cell in cells:
                compile("# " + cell, script.name, "exec")
            figure = f"figures/python_{script.stem}.png"
            self.assertIn(figure, page)
            self.assertTrue((SOURCE / "docs" / figure).is_file(), figure)


class Blocks(unittest.TestCase):
    def test_three_bases_in_25_lines(self):
        lines = [line for line in BLOCKS[0].splitlines() if line.strip()]
        self.assertLessEqual(len(lines), 25)
        run(BLOCKS[0] + CHECKS)
        self.assertGreater(pathlib.Path("three_bases.png").stat().st_size, 5000)

    def test_a_basis_in_15_lines(self):
        self.assertLessEqual(len([line for line in BLOCKS[1].splitlines() if line.strip()]), 15)
        self.assertEqual(run(BLOCKS[1]), "Random Subspace\n")

    def test_a_law(self):
        # A mass on a spring without damping moves from 0.1 m to -0.1 m; samples hit the turning
        # point to 1e-4.
        self.assertAlmostEqual(float(run(BLOCKS[2])), -0.1, places=3)

    def test_a_law_with_states(self):
        self.assertAlmostEqual(float(run(BLOCKS[3])), 5e-3, delta=5e-6)

    def test_decks(self):
        words, modes = run(BLOCKS[4]).splitlines()
        self.assertEqual(words, "(21, 32, 6) m, rad 100")
        self.assertIn("<Modes: 3, ", modes)
        self.assertTrue(pathlib.Path("guyed.xml").is_file())

    def test_figures(self):
        run(BLOCKS[5])
        text = pathlib.Path("torque.svg").read_text(encoding="utf-8")
        for word in ("torque [kN m]", "measured depth [m]", "120 rpm, WOB 40 kN"):
            self.assertIn(f">{word}<", text)

    def test_no_block_is_forgotten(self):
        self.assertEqual(len(BLOCKS), 6)


if __name__ == "__main__":
    unittest.main()
