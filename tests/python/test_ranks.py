# SPDX-License-Identifier: BSD-3-Clause
"""The package on several ranks: the same numbers as on one, errors on all ranks, and no rank waits
for a failed one."""
import os
import pathlib
import subprocess
import sys
import unittest

MPIEXEC = os.environ["TOOLJOINT_MPIEXEC"]
TESTS = pathlib.Path(__file__).parent
PRELUDE = "import sys; sys.path.insert(0, %r); import numpy as np, tooljoint as tj, beams\n" % str(
    TESTS)


def run(ranks, code):
    """Standard output, standard error and exit code of this code on several ranks."""
    command = [sys.executable, "-c", PRELUDE + code]
    done = subprocess.run([MPIEXEC, "-n", str(ranks), *command] if ranks > 1 else command,
                          capture_output=True, text=True, timeout=120, check=False)
    return done.stdout, done.stderr, done.returncode


class Ranks(unittest.TestCase):
    def test_ranks_agree_with_one(self):
        code = """
left, right, K, M = beams.halves(tj)
@tj.basis("Python Basis")
def build(part, count):
    vectors = np.random.default_rng(1).standard_normal((len(part.interior), count + 4))
    for step in range(3):
        vectors = part.solve_interior(part.interior_mass @ vectors)
    return vectors
@tj.point_law("Python Law")
def law(t, d, v):
    return -3e4 * d - 4e8 * d**3
right.model.add_points("tip", tj.law("Python Law"), np.eye(len(right))[-2:-1])
right.model.add_load(np.eye(len(right))[-2], "push", lambda t: 800 * np.sin(90 * t))
synthesis = tj.synthesise([left, right], "Python Basis", modes=4)
motion = tj.integrate(synthesis, 0.05, sampling_interval=0.01, step=1e-4)
# A line at a time: the ranks write into one stream.
frequencies = [round(float(f), 9) for f in tj.modes(synthesis, 4).frequency]
sys.stdout.write(f"{tj.ranks()} {frequencies} {[float('%.9e' % d) for d in motion.at(25, 'v')]}\\n")
"""
        one, _, code_one = run(1, code)
        two, errors, code_two = run(2, code)
        self.assertEqual((code_one, code_two), (0, 0), errors)
        lines = two.splitlines()
        self.assertEqual(len(lines), 2)
        self.assertEqual(lines[0], lines[1])
        values = [
            eval(line.split(" ", 1)[1].replace("] [", "], [")) for line in (one.strip(), lines[0])
        ]
        for mine, theirs in zip(*values):
            self.assertTrue(
                all(abs(a - b) <= 1e-8 * abs(max(mine, key=abs)) for a, b in zip(mine, theirs)),
                f"{mine}\n{theirs}")

    def test_an_error_of_one_rank_is_thrown_on_all(self):
        out, errors, code = run(
            2, """
left, right, K, M = beams.halves(tj)
@tj.basis("Raises On A Rank")
def build(part, count):
    if part.name == "right":
        raise ValueError("only here")
    return np.eye(len(part.interior))
try:
    tj.reduce([left, right], "Raises On A Rank", modes=2)
except tj.ModelError as error:
    sys.stdout.write(f"{error}\\n")
""")
        self.assertEqual(code, 0, errors)
        self.assertEqual(out.splitlines(),
                         ['The basis "Raises On A Rank" raised ValueError: only here.'] * 2)

    def test_a_rank_that_fails_alone_ends_all(self):
        _, errors, code = run(
            2, """
left, right, K, M = beams.halves(tj)
if tj.rank() == 1:
    raise tj.ModelError("rank 1 alone")
tj.reduce([left, right], modes=2)
""")
        self.assertEqual(code, 3, errors)
        self.assertIn("rank 1 alone", errors)

    def test_mpi_that_others_began_is_theirs_to_end(self):
        done = subprocess.run([
            sys.executable, "-c", """
import atexit, ctypes, sys
mpi = ctypes.CDLL("libmpi.so.40", ctypes.RTLD_GLOBAL)
flag = ctypes.c_int()
mpi.MPI_Init(None, None)
def last():
    mpi.MPI_Finalized(ctypes.byref(flag))
    sys.stdout.write(f"finalised: {flag.value}\\n")
    mpi.MPI_Finalize()
atexit.register(last)
import tooljoint as tj
assert len(tj.modes(tj.part("mass", [[1.0]], [[1.0]]), 1)) == 1
"""
        ], capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual((done.returncode, done.stdout), (0, "finalised: 0\n"), done.stderr)

    def test_runs_of_decks(self):
        deck = str(pathlib.Path(os.environ["TOOLJOINT_SOURCE_DIR"]) / "xml/frame.xml")
        code = f"""
results = tj.run({deck!r}, {{"Transient/End Time": 0.05, "Output/XDMF": False}},
                 output="ranks%d" % tj.ranks())
sys.stdout.write("%.9e\\n" % abs(results["transient/displacement"]).max())
"""
        (one, _, first), (two, errors, second) = run(1, code), run(2, code)
        self.assertEqual((first, second), (0, 0), errors)
        for line in two.splitlines():
            self.assertAlmostEqual(float(line) / float(one), 1.0, places=7)
        self.assertEqual(len(two.splitlines()), 2)


if __name__ == "__main__":
    unittest.main()
