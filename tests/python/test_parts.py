# SPDX-License-Identifier: BSD-3-Clause
"""Parts from scipy matrices: reduction, coupling and modes against scipy.linalg.eigh of the whole
structure."""
import gc
import pathlib
import unittest

import beams
import numpy as np
import scipy.linalg
import scipy.sparse as sparse
import tooljoint as tj


def exact(K, M, count):
    """Frequencies [Hz] and shapes of the pencil."""
    values, shapes = scipy.linalg.eigh(K.toarray(), M.toarray())
    return np.sqrt(values[:count]) / (2 * np.pi), shapes[:, :count]


class Matrices(unittest.TestCase):
    def test_matrices_come_back_without_copies(self):
        left, _, K, M = beams.halves(tj)
        model = left.model
        given = M[:len(left), :len(left)].toarray(
        )[:-2, :-2]  # without the interface, where the right half adds
        self.assertTrue(np.allclose(model.mass.toarray()[:-2, :-2], given, rtol=1e-14))
        first, second = model.mass, model.mass
        self.assertTrue(np.shares_memory(first.data, second.data),
                        "two reads of one mass matrix have copies")
        with self.assertRaises(ValueError, msg="a shared matrix can be written to"):
            first.data[0] = 1.0

    def test_an_array_outlives_what_it_came_from(self):
        left, _, _, _ = beams.halves(tj)
        mass, expected = left.model.mass, left.model.mass.toarray()
        model = left.model
        del left
        gc.collect()
        self.assertEqual(len(model), expected.shape[0])
        del model
        gc.collect()
        self.assertTrue(np.array_equal(mass.toarray(), expected))

    def test_any_matrix_is_taken(self):
        K, M = beams.beam(1.0, 3)
        K, M = K[2:, 2:], M[2:, 2:]
        want = tj.modes(tj.part("csr", M, K, component_names=("v", "theta")), 3).frequency
        # Every entry is stored twice in its row, with half its value.
        twice = sparse.csr_matrix((np.repeat(K.data / 2, 2), np.repeat(K.indices, 2), 2 * K.indptr),
                                  K.shape)
        for name, matrix in {
                "csc": K.tocsc(), "dense": K.toarray(), "lists": K.toarray().tolist(),
                "entries given twice": twice
        }.items():
            part = tj.part(name, M, matrix, component_names=("v", "theta"))
            self.assertTrue(np.array_equal(part.model.stiffness().toarray(), K.toarray()), name)
            self.assertTrue(np.allclose(tj.modes(part, 3).frequency, want, rtol=1e-10), name)

    def test_what_is_no_matrix_is_refused(self):
        for mass in ("mass", np.eye(3), 1j * np.eye(2), [[1.0, np.nan], [np.nan, 1.0]]):
            with self.assertRaises(tj.ModelError) as caught:
                tj.part("bad", mass, np.eye(2))
            self.assertGreater(len(str(caught.exception)), 20)
        with self.assertRaisesRegex(tj.ModelError, "2 rows, but 3 nodes"):
            tj.part("bad", np.eye(2), np.eye(2), nodes=[1, 2, 3], components=[0, 0, 0])

    def test_matrices_whose_arrays_were_changed_are_refused(self):
        for name, place, value in (("indices", 0, 99), ("indices", 0, -1), ("indptr", 2, 99)):
            for kind in ("csr", "csc"):
                matrix = sparse.random(4, 4, 0.9, kind, random_state=1)
                getattr(matrix, name)[place] = value
                with self.assertRaisesRegex(tj.ModelError, "stiffness matrix is no matrix"):
                    tj.part("changed", np.eye(4), matrix)
        masked = np.ma.masked_array(np.eye(4), mask=np.eye(4) < 1)
        with self.assertRaisesRegex(tj.ModelError, "The mass matrix has masked entries"):
            tj.part("masked", masked, np.eye(4))
        with self.assertRaisesRegex(tj.ModelError, "load.* has masked entries"):
            tj.part("masked", np.eye(4), np.eye(4), load=masked[0])

    def test_positions_that_are_none_are_refused(self):
        for name, wrong in {
                "nodes": ["a", "b"], "components": [0.5, 0], "interface": [2], "retained": [-1]
        }.items():
            with self.assertRaisesRegex(
                    tj.ModelError, "whole numbers" if name in ("nodes", "components") else name):
                tj.part("bad", np.eye(2), np.eye(2), **{name: wrong})
        with self.assertRaisesRegex(tj.ModelError, "retained"):
            tj.part("bad", np.eye(2), np.eye(2), interface=[1], retained=[1])
        with self.assertRaisesRegex(tj.ModelError, "nodes has 0; nodes are numbered from 1 on"):
            tj.part("bad", np.eye(2), np.eye(2), nodes=[0, 1])
        with self.assertRaisesRegex(tj.ModelError, "whole numbers"):
            tj.part("mask", np.eye(2), np.eye(2), interface=[True, False])
        with self.assertRaisesRegex(tj.ModelError, "whole numbers"):
            tj.part("huge", np.eye(2), np.eye(2), nodes=[1, 2**70])
        for wrong in ({"nodes": [1, 1], "components": [0, 0]}, {"component_names": ["u", "u"]}):
            with self.assertRaisesRegex(tj.ModelError, "Dofs 0 and 1 are both u of node 1"):
                tj.part("twice", np.eye(2), np.eye(2), **wrong)
        for wrong, sentence in (((5, {}), "name is 5"), (("a", {"component_names": []}),
                                                         "is empty")):
            with self.assertRaisesRegex(tj.UsageError, sentence):
                tj.part(wrong[0], np.eye(2), np.eye(2), **wrong[1])
        with self.assertRaisesRegex(tj.ModelError, "given for node 7, which part \"a\" does not"):
            tj.write_part(tj.part("a", [[1]], [[1]]), "a.h5", positions={7: [0, 0, 0]})

    def test_points_that_are_none_are_refused(self):
        model = tj.part("pair", np.eye(2), np.eye(2)).model
        spring = tj.law("Spring", stiffness=1.0)
        for rows, offset in (([[np.nan, 0]], [0.0]), ([[1, 0]], [np.inf])):
            with self.assertRaisesRegex(tj.ModelError, "a row or an offset that is not finite"):
                model.add_points("s", spring, rows, offset)
        model.add_points("s", spring, [[1, 0]])
        self.assertEqual(model.point_force(0, [2, 5], [0, 0]).tolist(), [-2, 0])
        for q, v in (([2], [0, 0]), ([2, 5], [0, 0, 0])):
            with self.assertRaisesRegex(tj.ModelError, "expected are 2 entries"):
                model.point_force(0, q, v)

    def test_vectors_that_do_not_fit_are_refused(self):
        part = tj.part("chain", np.eye(3), np.eye(3))
        for load, reason in (
            (np.ones((3, 2)), "3 x 2"),
            (np.ones(2), "array of 2; expected are 3 entries"),
            ("abc", "no vector"),
            (1j * np.ones(3), "no vector"),
            (None, "one number"),
        ):
            with self.assertRaisesRegex(tj.ModelError, reason):
                part.model.add_load(load)
            with self.assertRaisesRegex(tj.ModelError, reason):
                part.model.set_start(load, np.zeros(3))
        for refused in (lambda: part.model.add_load([1, np.nan, 1]),
                        lambda: part.model.add_damping(np.eye(2)),
                        lambda: part.model.add_stiffness(np.eye(4), "k"),
                        lambda: part.model.set_start([np.inf, 0, 0], np.zeros(3))):
            with self.assertRaises(tj.ModelError):
                refused()
        self.assertEqual(len(tj.modes(part, 2).frequency), 2, "what was refused has left nothing")
        part.model.add_load(np.ones((3, 1)))
        part.model.add_load([1, 2, 3])
        self.assertEqual(part.model.load().tolist(), [2, 3, 4])

    def test_arguments_of_other_kinds_are_named(self):
        part = tj.part("chain", np.eye(3), 2 * np.eye(3) - np.eye(3, k=1) - np.eye(3, k=-1))
        both = tj.synthesise([part], modes=2)
        for call, sentence in {
                lambda: tj.modes(part, 2.5): "modes(): count is 2.5; expected is a whole number.",
                lambda: tj.modes(3, 2): "modes(): of is 3; expected is a Part or a ReducedPart or "
                "a Synthesis or a Model.",
                lambda: tj.damped_modes(part, 2, np.nan): "damped_modes(): t is nan; expected is a "
                "finite number.",
                lambda: tj.mac(np.eye(2),
                               np.eye(2) * np.nan, np.eye(2)): "mac(): a shape has an "
                "entry that is not finite.",
                lambda: tj.integrate(part, 0.01).at(1, "u", "speed"): "at(): what is 'speed'; "
                "expected is one of displacement, velocity, acceleration.",
                lambda: tj.damped_modes(part, 2, "1 s"): "damped_modes(): t is '1 s'; expected is "
                "a number.",
                lambda: tj.compare_modes(part, 2): "compare_modes(): synthesis is <Part",
                lambda: tj.compare_modes(both, 2.5): "compare_modes(): count is 2.5",
                lambda: tj.estimate_frequencies(both, "2"): "estimate_frequencies(): count is '2'",
                lambda: tj.mac(1, 2, 3): "mac(): expected are two arrays of shapes",
                lambda: tj.couple([1]): "couple(): parts[0] is 1; expected is a Part or a "
                "ReducedPart.",
                lambda: tj.couple([part], 3): "coupling is 3; expected is the deck list Coupling",
                lambda: tj.reduce(3): "reduce(): parts is 3; expected is a list",
                lambda: tj.reduce(part, modes=object()): "is no value of a deck",
                lambda: tj.synthesise(part): "synthesise(): parts is <Part",
                lambda: tj.integrate("part", 1): "integrate(): of is 'part'",
                lambda: tj.law("Spring", points=1.5, stiffness=1.0): "law(): points is 1.5",
                lambda: tj.read_part("part.json", laws={
                    "Omega": "fast"
                }): "read_part(): Omega is 'fast'; expected is a number.",
        }.items():
            with self.assertRaises(tj.UsageError) as caught:
                call()
            self.assertIn(sentence, str(caught.exception))
        with self.assertRaisesRegex(tj.ModelError,
                                    'the interface "end" has 1.5; expected are whole numbers'):
            tj.write_part(part, "part.h5", interfaces={"end": [1.5]})
        self.assertEqual(len(tj.modes(part, np.int64(2))), 2)

    def test_a_dof_without_mass_and_stiffness_is_refused(self):
        loose = np.diag([1.0, 1, 1, 1, 0])
        for count in (1, 4, 5):
            with self.assertRaisesRegex(tj.ModelError, "neither mass nor stiffness"):
                tj.modes(tj.part("loose", loose, loose), count)


class Reduction(unittest.TestCase):
    def setUp(self):
        self.left, self.right, self.K, self.M = beams.halves(tj)
        self.frequency, self.shapes = exact(self.K, self.M, 6)

    def test_unreduced_parts_are_the_whole(self):
        full = tj.couple([self.left, self.right])
        self.assertEqual(len(full), self.K.shape[0])
        found = tj.modes(full, 6)
        self.assertEqual(found.frequency.unit, "Hz")
        self.assertTrue(np.allclose(found.frequency, self.frequency, rtol=1e-9),
                        f"{found.frequency} against {self.frequency}")

    def test_four_methods_against_the_whole(self):
        # The sixth frequency of the cantilever needs a third bending mode of each half: eight modes
        # bring all six within 0.1 %.
        for method, tolerance, above in (
            ("Craig-Bampton", 1e-3, True),
            ("Rubin", 1e-3, True),
            ("Krylov", 1e-3, True),
            ("Dual Craig-Bampton", 1e-3, False),
        ):
            with self.subTest(method):
                synthesis = tj.synthesise([self.left, self.right], method, modes=8)
                error = np.asarray(tj.modes(synthesis, 6).frequency) / self.frequency - 1
                self.assertLess(abs(error).max(), tolerance, f"{method}: errors {error}")
                if above:  # Rayleigh-Ritz
                    self.assertGreater(error.min(), -1e-9, f"{method}: errors {error}")

    def test_more_modes_are_better_and_all_are_exact(self):
        errors = []
        for modes in (1, 3, 9):
            found = tj.modes(tj.synthesise([self.left, self.right], modes=modes), 3).frequency
            errors.append(max(np.asarray(found) / self.frequency[:3] - 1))
        self.assertTrue(errors[0] > 10 * errors[1] > 100 * errors[2], f"{errors}")
        found = tj.modes(tj.synthesise([self.left, self.right], all_modes=True), 6).frequency
        self.assertTrue(np.allclose(found, self.frequency, rtol=1e-8))

    def test_reduce_and_couple_step_by_step(self):
        reduced = tj.reduce([self.left, self.right], "Craig-Bampton", cut_off_frequency="2 kHz")
        for part, like in zip(reduced, (self.left, self.right)):
            basis = part.basis
            self.assertEqual(basis.shape, (len(like), len(part)))
            projected = basis.T @ like.model.stiffness() @ basis
            self.assertTrue(
                np.allclose(projected.toarray(),
                            part.model.stiffness().toarray(), atol=1e-9 * abs(projected).max()))
            self.assertTrue((part.frequencies_hz <= 2000).all()
                            and len(part.frequencies_hz) == part.modes > 0)
        step = tj.modes(tj.couple(reduced), 6).frequency
        once = tj.modes(tj.synthesise([self.left, self.right], cut_off_frequency=2000), 6).frequency
        self.assertTrue(np.allclose(step, once, rtol=1e-10))
        self.assertIn("fixed-interface", reduced[0].table())

    def test_mac_and_comparison(self):
        synthesis = tj.synthesise([self.left, self.right], modes=6)
        for row, frequency in zip(tj.compare_modes(synthesis, 4), self.frequency):
            self.assertAlmostEqual(row["full_hz"] / frequency, 1.0, places=8)
            self.assertAlmostEqual(row["mac"], 1.0, places=4)
            self.assertTrue(row["estimate"] / 2 < row["error"] < 2 * row["estimate"] + 1e-10,
                            f"estimate {row['estimate']}, error {row['error']}")
        row = tj.compare_modes(synthesis, synthesis.model.mass.shape[0] + 2)[-1]
        self.assertTrue(
            all(row[key] is None
                for key in ("coupled_mode", "coupled_hz", "mac", "error", "estimate")),
            "more modes than the reduced model has")
        # The definition, with the shapes of the whole: M-orthogonal, so that MAC is the identity.
        found = tj.mac(self.shapes, -3 * self.shapes, self.M)
        self.assertTrue(np.allclose(found, np.eye(6), atol=1e-9))
        turned = self.shapes[:, :1] + self.shapes[:, 1:2]
        self.assertTrue(
            np.allclose(tj.mac(turned, self.shapes[:, :3], self.M), [[0.5, 0.5, 0.0]], atol=1e-9))

    def test_a_tolerance_chooses_the_modes(self):
        synthesis = tj.synthesise([self.left, self.right], frequency_tolerance=1e-5,
                                  estimated_frequencies=4)
        error = np.asarray(tj.modes(synthesis, 4).frequency) / self.frequency[:4] - 1
        self.assertTrue(0 <= error.max() < 1e-5, f"{error}")
        self.assertTrue(synthesis.rounds)
        self.assertLess(len(synthesis.model), len(self.left) + len(self.right) - 10)

    def test_damping_that_a_basis_leaves_out_is_warned_of(self):
        K = 1e4 * (2 * np.eye(4) - np.eye(4, k=1) - np.eye(4, k=-1))
        ends, light = np.diag([0.0, 0.0, 0.0, 30.0]), np.diag([1.0, 1.0, 1.0, 0.0])
        parts = [
            tj.part("bar", light, K, damping=ends, nodes=[1, 2, 3, 4], interface=[3]),
            tj.part("load", np.eye(2), K[:2, :2], nodes=[4, 5], interface=[0])
        ]
        for method, left_out in (("MacNeal", True), ("Dual Craig-Bampton", True), ("Rubin", False)):
            coupled = tj.synthesise(parts, method, all_modes=True)
            said = "1 boundary dofs with damping but no mass (first u of node 4)"
            self.assertEqual(said in " ".join(tj.warnings()), left_out, method)
            damping = [tj.damped_modes(each, 1).damping[0] for each in (coupled, tj.couple(parts))]
            self.assertEqual(abs(damping[0] - damping[1]) > 0.1 * damping[1], left_out, damping)
        K[0, 1] *= 0.5
        skew = tj.part("skew", np.eye(4), K, nodes=[1, 2, 3, 4], interface=[3])
        remarks = tj.synthesise([skew, parts[1]], "Dual Craig-Bampton", modes=1).parts[0].remarks
        self.assertRegex(remarks[0],
                         r"loads on boundary dofs is not exact: .* difference [\d.]+ %$")

    def test_springs_between_parts_of_the_list_coupling(self):
        # A spring to the ground at the tip is a term on the diagonal of K.
        stiffness = 5e4
        springs = {
            "Point Laws": {
                "tip": {
                    "First": "right:25", "Component": "v", "Type": "Spring",
                    "Spring": {"Stiffness": stiffness}
                }
            }
        }
        K = self.K.tolil()
        K[-2, -2] += stiffness
        want, _ = exact(K.tocsr(), self.M, 4)
        found = tj.modes(tj.couple([self.left, self.right], springs), 4).frequency
        self.assertTrue(np.allclose(found, want, rtol=1e-8), f"{found} against {want}")

    def test_damped_modes(self):
        beta = 1e-4
        left, right, K, M = beams.halves(tj)
        for part in (left, right):
            part.model.add_damping(beta * part.model.stiffness())
        found = tj.damped_modes(tj.couple([left, right]), 3)
        want = beta * 2 * np.pi * self.frequency[:3] / 2  # zeta = beta omega / 2
        self.assertTrue(np.allclose(found.damping, want, rtol=1e-6),
                        f"{found.damping} against {want}")

    def test_parts_as_files_take_part_in_a_deck(self):
        parts = "".join(f'<ParameterList name="{name}"><Parameter name="File" type="string" '
                        f'value="{file}"/></ParameterList>'
                        for name, file in (("left", "left.h5"), ("right", "right")))
        pathlib.Path("beam.xml").write_text(
            f"""<ParameterList name="beam">
  <ParameterList name="Parts"><ParameterList name="Imported">{parts}</ParameterList>
    <Parameter name="Joints" type="Array(string)" value="{{left:middle = right:middle}}"/>
    </ParameterList></ParameterList>""", encoding="utf-8")
        if tj.rank() == 0:
            pathlib.Path("right").mkdir(exist_ok=True)
        tj.write_part(self.left, "left.h5", {"middle": self.left.interface})
        tj.write_part(self.right, "right", {"middle": self.right.interface})
        for part, again in (
            (self.left, tj.read_part("left.h5", "left")),
            (self.right, tj.read_part("right", "right")),
        ):
            self.assertEqual(again.name, part.name)
            self.assertEqual(again.interface.tolist(), part.interface.tolist())
            self.assertTrue(np.array_equal(again.model.mass.toarray(), part.model.mass.toarray()))
            self.assertEqual(again.model.dof_names, part.model.dof_names)
        found = tj.modes(tj.Deck("beam.xml").at_rest().full(), 6).frequency
        self.assertTrue(np.allclose(found, self.frequency, rtol=1e-8),
                        f"{found} against {self.frequency}")
        with self.assertRaises(tj.DeckError):
            tj.read_part("nowhere.h5")
        reduced = tj.reduce(self.left, modes=2)
        with self.assertRaisesRegex(tj.UsageError, "takes a Part, not <ReducedPart"):
            tj.write_part(reduced, "reduced.h5")
        part = tj.part("reduced", reduced.model.mass, reduced.model.stiffness(),
                       interface=range(reduced.interface))
        tj.write_part(part, "reduced.h5")
        self.assertTrue(
            np.allclose(
                tj.modes(tj.read_part("reduced.h5"), 2).frequency,
                tj.modes(reduced.model, 2).frequency, rtol=1e-10))

    def test_laws_of_a_file_are_given_and_point_laws_told(self):
        stiff, k = np.diag([5e3, 0, 0]), 1e3 * np.array([[2.0, -1, 0], [-1, 2, -1], [0, -1, 2]])
        part = tj.part("bearing", np.eye(3), k, interface=[2])
        part.model.add_stiffness(stiff, "bearing", lambda t: 2.0)
        part.model.add_points("spring", tj.law("Spring", stiffness=1.0), [[1.0, 0, 0]])
        exact = tj.modes(tj.part("fixed", np.eye(3), k + 2 * stiff, interface=[2]), 3).frequency
        tj.write_part(part, "bearing.h5")
        with self.assertRaisesRegex(tj.DeckError, "law of time \"bearing\".*laws="):
            tj.read_part("bearing.h5")
        with self.assertRaisesRegex(tj.DeckError, "has no law of time \"Omega\""):
            tj.read_part("bearing.h5", laws={"bearing": 2, "Omega": 1})
        for law in (2, lambda t: 2.0):
            again = tj.read_part("bearing.h5", laws={"bearing": law})
            self.assertTrue(any("point law \"spring\"" in warning for warning in tj.warnings()),
                            tj.warnings())
            self.assertTrue(np.allclose(tj.modes(again, 3).frequency, exact, rtol=1e-9))
        with self.assertRaisesRegex(tj.ModelError, "cannot be called"):
            part.model.add_load([1.0, 0, 0], "load", {"Form": "Ramp"})

    def test_reduced_parts_take_no_coupling(self):
        reduced = tj.reduce([self.left, self.right], modes=2)
        with self.assertRaisesRegex(tj.UsageError, "synthesise"):
            tj.couple(reduced, {"Springs": {}})
        with self.assertRaisesRegex(tj.UsageError, "Some of the parts are reduced"):
            tj.couple([self.left, reduced[1]])


if __name__ == "__main__":
    unittest.main()
