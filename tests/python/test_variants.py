# SPDX-License-Identifier: BSD-3-Clause
"""Bases and point laws written in Python, used in calls, decks and studies."""
import os
import pathlib
import unittest

import beams
import numpy as np
import tooljoint as tj

SOURCE = pathlib.Path(os.environ["TOOLJOINT_SOURCE_DIR"])
FRAME = SOURCE / "xml/frame.xml"


@tj.basis("Inverse Steps")
def inverse_steps(part, count, steps=3, extra=tj.Parameter(4,
                                                           doc="Vectors beside those asked for.")):
    """A random subspace of the interior, moved towards its low modes by inverse iteration (Halko et
    al. 2011)."""
    random = np.random.default_rng(1)
    vectors = random.standard_normal((len(part.interior), count + extra))
    for step in range(steps):
        vectors = np.linalg.qr(part.solve_interior(part.interior_mass @ vectors))[0]
    return vectors


class Bases(unittest.TestCase):
    def test_it_is_a_basis_like_any_other(self):
        self.assertIn("Inverse Steps", tj.bases())
        left, right, _, _ = beams.halves(tj)
        want = tj.modes(tj.synthesise([left, right], "Craig-Bampton", modes=5), 5).frequency
        found = tj.modes(tj.synthesise([left, right], "Inverse Steps", modes=5, steps=6),
                         5).frequency
        self.assertTrue(np.allclose(found, want, rtol=1e-4), f"{found} against {want}")
        worse = tj.modes(tj.synthesise([left, right], "Inverse Steps", modes=5, steps=1, extra=0),
                         5).frequency
        self.assertGreater(max(worse - want), 10 * max(abs(found - want)),
                           "steps and extra change nothing")

    def test_cut_off_frequency_and_all_modes(self):
        left, right, K, M = beams.halves(tj)
        full = tj.modes(tj.couple([left, right]), 5).frequency
        found = tj.modes(tj.synthesise([left, right], "Inverse Steps", all_modes=True), 5).frequency
        self.assertTrue(np.allclose(found, full, rtol=1e-8))
        one, other = (tj.reduce(left, method, cut_off_frequency="2 kHz")
                      for method in ("Craig-Bampton", "Inverse Steps"))
        self.assertEqual(one.modes, other.modes)
        self.assertTrue((other.frequencies_hz <= 2000).all())

    def test_parameters_are_checked_as_in_a_deck(self):
        left, _, _, _ = beams.halves(tj)
        with self.assertRaisesRegex(tj.DeckError, "/Reduction/Inverse Steps/Steps"):
            tj.reduce(left, "Inverse Steps", modes=2, steps=1.5)
        with self.assertRaisesRegex(tj.DeckError, 'Did you mean "Steps"?'):
            tj.reduce(left, "Inverse Steps", modes=2, step=1)

    def test_what_a_basis_does_wrong_is_said(self):
        left, _, _, _ = beams.halves(tj)
        kept = []
        for name, build, words in (
            ("Raises", lambda part, count: 1 / 0, 'The basis "Raises" raised ZeroDivisionError'),
            ("Short", lambda part, count: np.zeros(
                (3, 2)), 'The basis "Short" returned 3 rows for part "left"; expected are its 22'),
            ("Flat", lambda part, count: np.zeros(22), "not two dimensions"),
            ("Complex", lambda part, count: 1j * np.eye(22),
             'The basis "Complex" returned complex numbers'),
            ("Infinite", lambda part, count: np.full((22, 2), np.nan), "not finite"),
            ("Keeps", lambda part, count: kept.append(part) or np.eye(22), None),
        ):
            with self.subTest(name):
                tj.basis(name)(build)
                if words:
                    with self.assertRaisesRegex(tj.ModelError, words):
                        tj.reduce(left, name, modes=2)
                else:
                    tj.reduce(left, name, modes=2)
        tj.basis("One Shape")(lambda part, count: np.ones((22, 5)))
        reduced = tj.reduce(left, "One Shape", modes=2)
        self.assertEqual(reduced.modes, 1)
        self.assertIn("requested 2 modes, but the 5 vectors given span 1",
                      " ".join(reduced.remarks))
        with self.assertRaisesRegex(tj.UsageError, "for the time of its call"):
            kept[0].interior_mass
        with self.assertRaisesRegex(tj.UsageError, "already"):
            tj.basis("Craig-Bampton")(lambda part, count: None)
        tj.basis("Short")(lambda part, count: np.eye(22))  # defined again, as in a notebook
        tj.reduce(left, "Short", modes=2)

    def test_it_takes_part_in_a_deck_and_in_a_study(self):
        changes = {
            "Reduction/Basis": "Inverse Steps", "Reduction/Inverse Steps/Steps": 5,
            "Reduction/Error Estimate": "Frequencies"
        }
        results = tj.run(FRAME, {**changes, "Transient/End Time": 0.05}, output="deck")
        self.assertEqual(results.summary["reduction"]["basis"], "Inverse Steps")
        # of the frequencies below the cut-off of 400 Hz
        self.assertLess(results.summary["reduction"]["estimate"]["frequency_error"], 0.05)

        deck = tj.Deck(
            SOURCE / "tests/study/frame.xml", without=[
                f"Study/Methods/{name}"
                for name in ("full", "reduced interfaces", "own vectors", "other start", "explicit",
                             "dual", "too coarse")
            ])
        deck["Study/Methods/CMS/Sweep/basis/Values"] = ["Craig-Bampton", "Inverse Steps"]
        del deck["Study/Baseline"]
        deck["Transient/End Time"] = 0.2
        deck["Study/Window"] = 0.2
        deck["Study/Repeats"] = 1
        deck["Study/Reference/Set"] = ["Transient/Step=5e-4"]
        deck["Study/Check/Set"] = ["Transient/Step=2.5e-4"]
        rows = deck.study("study")
        errors = {(row["basis"], row["modes"]): row["vibration_error"] for row in rows
                  if row["method"] == "CMS"}
        self.assertEqual(len(errors), 4, f"{rows}")
        for (name, modes), error in errors.items():
            self.assertTrue(0.5 < error / errors["Craig-Bampton", modes] < 2 and error < 0.01,
                            f"{name} with {modes} modes: error {error}")


class Laws(unittest.TestCase):
    def test_a_deck_names_it(self):
        @tj.point_law("Rope")
        def rope(t, d, v, stiffness=tj.Parameter(unit="N/m")):
            """A spring."""
            return -stiffness * d

        def motion(law, **parameters):
            deck = tj.Deck(FRAME, {
                "Transient/End Time": 0.2, "Transient/Step": 1e-3, "Parts/Loads/shaker/Value": 0.0
            }, ["Parts/Starts"])
            if law:
                deck.add("Coupling/Point Laws/guy",
                         {"First": "top beam:5", "Component": "v", "Type": law, law: parameters})
            return deck.run(law or "free")["transient/displacement"]

        @tj.point_law("Yielding Rope", states=1, start=lambda t, d, v, stiffness, damping: d)
        def yielding(t, d, v, x, stiffness=tj.Parameter(unit="N/m"),
                     damping=tj.Parameter(unit="N s/m")):
            """A spring and a dashpot in series."""
            return -stiffness * (d - x), stiffness / damping * (d - x)

        free = motion("")
        size = abs(free).max()
        for python, cpp, parameters in (
            ("Rope", "Spring", {}),
            ("Yielding Rope", "Maxwell", {"damping": "10 kN s/m"}),
        ):
            with self.subTest(cpp):
                moved, truth = (motion(law, stiffness="200 kN/m", **parameters)
                                for law in (python, cpp))
                self.assertGreater(abs(truth - free).max(), 0.01 * size, "the law does not show")
                self.assertLess(abs(moved - truth).max(), 1e-7 * size)

    def test_the_wall_of_a_bore_has_it(self):
        @tj.point_law("Frictionless Wall")
        def wall(t, d, v, stiffness=tj.Parameter(unit="N/m")):
            """A wall without friction: d is the gap."""
            return np.where(d < 0, -stiffness * d, 0.0)

        at_rest = ["Transient", "Reduction", "Substructures"]
        stiff = {"Contact/Law": "Frictionless Wall", "Contact/Frictionless Wall/Stiffness": 1e7}
        own = tj.run(SOURCE / "tests/effects/scene.xml", stiff,
                     [*at_rest, "Contact/Friction", "Contact/Intervals"],
                     output="bore").summary["static"]
        clamped = tj.run(SOURCE / "tests/effects/scene.xml", {}, at_rest,
                         output="clamped").summary["static"]
        self.assertEqual(own["contact_nodes"], clamped["contact_nodes"])
        # Equal walls carry the same weight; in one of the two cases friction carries part of it.
        self.assertAlmostEqual(own["total_normal_force"] / clamped["total_normal_force"], 1.0,
                               delta=0.1)


if __name__ == "__main__":
    unittest.main()
