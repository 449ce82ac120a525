# SPDX-License-Identifier: BSD-3-Clause
"""Decks in Python: read, changed, written, run; results with units; messages of the program as
exceptions."""
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np
import tooljoint as tj

SOURCE = pathlib.Path(os.environ["TOOLJOINT_SOURCE_DIR"])
FRAME = SOURCE / "xml/frame.xml"
STRING = SOURCE / "tests/effects/scene.xml"
PROGRAM = os.environ.get("TOOLJOINT_PROGRAM")
SHORT = {"Transient/End Time": "0.05 s", "Output/XDMF": False}


def sentence_of_program(*arguments):
    """Output of the program on standard error, without its name and line breaks, and its exit
    code."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True,
                          check=False)
    return re.sub(r"\n {2,}", " ",
                  done.stderr.removeprefix("tooljoint: ").rstrip("\n")), done.returncode


class Decks(unittest.TestCase):
    def test_values_are_read_and_changed(self):
        deck = tj.Deck(FRAME)
        self.assertEqual(deck["Transient/End Time"], 2.0)
        self.assertEqual(deck["Parts/Imported/arm/Retained"], ["5"])
        self.assertAlmostEqual(deck["Parts/Imported/left column/Rotation Angle"], -np.pi / 2)
        self.assertEqual(deck["Transient/Integrator"], "Generalized-alpha")  # a default
        self.assertTrue(deck.gives("Transient/End Time") and not deck.gives("Transient/Integrator"))
        deck["Transient/End Time"] = "250 ms"
        deck["Reduction/Mode Selection/Cut-off Frequency"] = 500
        del deck["Output"]
        self.assertEqual(
            (deck["Transient/End Time"], deck["Reduction/Mode Selection/Cut-off Frequency"]),
            (0.25, 500.0))
        self.assertNotIn("Mud", deck)
        self.assertIn("Parts/Laws/gust", deck)
        for path, sentence in {
                "Mud": '/frame/Mud is not a parameter. Available: the lists "Parts"',
                "Transient/Intgrator": '/frame/Transient/Intgrator is not a parameter. Did you '
                'mean "Integrator"?',
                "Transent/Step": '/frame/Transent is not a list. Did you mean "Transient"?',
                "Transient/End Time/x": "/frame/Transient/End Time is not a list. It is a "
                "parameter",
                "Output": '/frame/Output is not a parameter. It is a list: write <ParameterList '
                'name="Output">.',
        }.items():
            with self.assertRaises(tj.DeckError) as caught:
                deck[path]
            self.assertIn(sentence, str(caught.exception))

    def test_a_deck_stays_in_its_folder_when_the_working_folder_changes(self):
        there = pathlib.Path.cwd()
        with tempfile.TemporaryDirectory() as folder:
            deck = tj.Deck(os.path.relpath(FRAME), set=SHORT)
            try:
                os.chdir(folder)
                deck["Transient/End Time"] = "20 ms"
                deck.check()
                tj.run(deck, set={"Transient/End Time": "10 ms"}, output="short")
                self.assertTrue(pathlib.Path(folder, "short").is_dir())
            finally:
                os.chdir(there)
        self.assertEqual(deck["Transient/End Time"], 0.02)

    def test_a_deck_is_written_and_read_again(self):
        deck = tj.Deck(FRAME)
        deck["Transient/End Time"] = "250 ms"
        deck["Transient/Step"] = 1e-3
        deck["Reduction/Basis"] = "Rubin"
        deck["Parts/Imported/arm/Retained"] = ["4", "5"]
        guy = {
            "First": "top beam:5", "Component": "v", "Type": "Spring",
            "Spring": {"Stiffness": "3 kN/m"}
        }
        deck.add("Coupling/Point Laws/guy", guy)
        with self.assertRaisesRegex(tj.DeckError, 'Did you mean "Stiffness"'):
            deck.add("Coupling/Point Laws/other", {**guy, "Spring": {"Stifness": 3}})
        self.assertNotIn("Coupling/Point Laws/other", deck)
        deck["Coupling/Point Laws/guy/Spring/Stiffness"] = "4 kN/m"
        del deck["Parts/Starts"]
        with tempfile.TemporaryDirectory(dir=".") as folder:
            file = pathlib.Path(folder) / "changed.xml"
            deck.write(file)
            again = tj.Deck(file)
            self.assertEqual(again.to_dict(), deck.to_dict())
            self.assertIn("A portal frame of five parts", file.read_text(encoding="utf-8"))
            with self.assertRaises(tj.FileError):
                deck.write(pathlib.Path(folder) / "nowhere" / "deck.xml")

    @unittest.skipUnless(PROGRAM, "no program")
    def test_a_list_that_was_deleted_is_replaced(self):
        deck = tj.Deck(FRAME)
        deck["Transient/End Time"] = 0.3
        del deck["Transient"]
        deck.add("Transient", {"End Time": 0.1, "Step": 0.002})
        self.assertEqual((deck["Transient/End Time"], deck["Transient/Step"]), (0.1, 0.002))
        deck["Transient/Step"] = 0.001
        self.assertEqual(deck["Transient/Step"], 0.001)

    def test_errors_are_those_of_the_program(self):
        cases = [
            ("unknown parameter", FRAME, {"Transient/End Tim": 1}, (), tj.DeckError),
            ("unknown basis", FRAME, {"Reduction/Basis": "Craig-Bamton"}, (), tj.DeckError),
            ("wrong unit", FRAME, {"Transient/End Time": "3 kg"}, (), tj.DeckError),
            ("two faults", FRAME, {"Transient/End Time": -1,
                                   "Transient/Step": "soon"}, (), tj.DeckError),
            ("no deck", SOURCE / "xml/nowhere.xml", {}, (), tj.FileError),
            ("a mechanism", FRAME, {"Parts/Imported/left column/Fixed": ["nowhere"]}, (),
             tj.DeckError),
            ("too coarse", FRAME,
             {"Transient/Integrator": "RK4", "Transient/Step": 0.05,
              "Transient/End Time": 1}, ("Reduction",), tj.ConvergenceError),
        ]
        for name, file, changes, without, kind in cases:
            with self.subTest(name):
                arguments = ["run", file, "--output", "errors"]
                for path in without:
                    arguments += ["--without", path]
                for path, value in changes.items():
                    arguments += ["--set", f"{path}={tj.lists.text_of(value)}"]
                want, code = sentence_of_program(*arguments)
                with self.assertRaises(kind) as caught:
                    tj.run(file, changes, without, output="errors")
                self.assertEqual(caught.exception.code, code)
                self.assertEqual(str(caught.exception),
                                 want.splitlines()[-1] if kind is tj.ConvergenceError else want)
                self.assertIsInstance(caught.exception, tj.Error)

    def test_lists_of_a_call_have_the_errors_of_a_deck(self):
        part = tj.part("two", np.eye(2), [[2, -1], [-1, 2]], interface=[0])
        for call, words in (
            (lambda: tj.reduce(part),
             "Reduction does not select modes. Give the list \"Mode Selection\" exactly one of"),
            (lambda: tj.reduce(part, modes=1, cut_off_frequency=3), "together. Give exactly one."),
            (lambda: tj.reduce(part, modes=-1),
             "/Reduction/Mode Selection/Modes: value=\"-1\" is out of range"),
            (lambda: tj.reduce(part, "Craig", modes=1), "/Reduction/Basis"),
            (lambda: tj.reduce(part, cut_off_frequency="3 m"),
             "/Reduction/Mode Selection/Cut-off Frequency"),
            (lambda: tj.integrate(part, 1.0, spectral_radus=0.5),
             "Did you mean \"Spectral Radius\"?"),
            (lambda: tj.law("Spring", stiffness="3 kg"), "/Spring/Stiffness"),
            (lambda: tj.law("Sprin"), "Unknown name \"Sprin\". Available: "),
        ):
            with self.subTest(words):
                with self.assertRaises(tj.DeckError) as caught:
                    call()
                self.assertIn(words, str(caught.exception))


class Runs(unittest.TestCase):
    def test_a_run_in_process_has_results_with_units(self):
        results = tj.run(FRAME, SHORT, output="run")
        self.assertEqual((results.summary["status"], str(results.folder)), ("finished", "run"))
        time_ = results["transient/time"]
        self.assertEqual((time_.unit, len(time_)), ("s", 11))
        displacement = results["/transient/displacement"]
        self.assertEqual(displacement.shape, (11, 32, 6))
        self.assertTrue(displacement.long_name)
        self.assertIn("transient/velocity", results.datasets())
        self.assertEqual(len(results.table("motion.csv")), 11)
        with self.assertRaisesRegex(tj.FileError, "has no dataset /transient/nothing"):
            results["transient/nothing"]
        with self.assertRaisesRegex(tj.FileError, "nowhere"):
            tj.read("nowhere")
        self.assertEqual(tj.read("run").summary, results.summary)

    def test_warnings_are_those_of_the_last_call(self):
        for run in range(2):  # new in every call
            results = tj.run(FRAME, SHORT, output="warned")
            self.assertIn("basis does not represent the initial state", "".join(results.warnings))
            self.assertEqual(tj.warnings(), results.warnings)
        tj.couple([tj.part("quiet", [[1.0]], [[1.0]])])
        self.assertEqual(tj.warnings(), [])

    def test_parts_of_a_deck_by_hand_move_as_its_run(self):
        results = tj.run(FRAME, SHORT, ["Reduction"], output="by_hand")
        case = tj.Deck(FRAME, SHORT).at_rest()
        parts, connections = case.parts()
        motion = tj.integrate(tj.synthesise(parts, coupling=connections, all_modes=True), 0.05,
                              sampling_interval=0.005)
        want = np.asarray(results["transient/displacement"])
        model = motion.model
        found = (np.asarray(motion.displacement) @ model.recovery.T.toarray() +
                 model.recovery_offset).reshape(11, -1, 6)
        self.assertLess(abs(found - want).max(), 1e-6 * abs(want).max())

    def test_h5py_may_be_there_too(self):
        import h5py

        results = tj.run(FRAME, SHORT, output="both")
        with h5py.File("both/results.h5") as file:
            self.assertTrue(
                np.array_equal(file["transient/displacement"], results["transient/displacement"]))
            self.assertEqual(file["transient/displacement"].attrs["units"],
                             results["transient/displacement"].unit)
            for path in results.datasets():  # every dataset, of any kind
                self.assertEqual(file[path].shape, results[path].shape, path)

    def test_a_string_runs(self):
        results = tj.run(STRING, {"Transient/End Time": 0.02}, output="string")
        self.assertGreater(results.summary["model"]["free_dofs"], 10)
        self.assertTrue(np.isfinite(np.asarray(results["static/displacement"])).all())
        self.assertEqual(results["model/s"].unit, "m")

    def test_a_map_in_process_has_its_pictures(self):
        deck = tj.Deck(STRING, without=["Transient"])
        weights = ["5 kN", "10 kN"]
        deck.add(
            "Map", {
                "Grid": {
                    "weight": {"Parameter": "Loads/Weight On Bit", "Values": weights},
                    "torque": {
                        "Parameter": "Loads/Torque On Bit",
                        "Values": ["1 kN m", "2 kN m"],
                    },
                },
                "Values": {"top force": {"Key": "static.top_axial_force"}},
            })
        rows = deck.map("map", fresh=True)
        self.assertEqual([row["status"] for row in rows], ["done"] * 4)
        force = np.array([row["top force"] for row in rows]).reshape(2, 2)
        self.assertTrue(np.allclose(force[0] - force[1], 5e3, rtol=0.05),
                        f"{force}: 5 kN more on the bit are 5 kN less at the top")
        self.assertTrue(
            pathlib.Path("map/map_top_force.png").is_file(), f"{sorted(os.listdir('map'))}")

    def test_check_prints_and_refuses(self):
        tj.Deck(FRAME).check()
        with self.assertRaises(tj.DeckError):
            tj.Deck(FRAME, {"Parts/Loads/wind/Law": "gus"}).check()


class Interrupts(unittest.TestCase):
    def test_ctrl_c_ends_a_run_as_it_ends_the_program(self):
        shutil.rmtree("interrupted", ignore_errors=True)

        def interrupt():
            while not list(pathlib.Path(".").glob("interrupted/results.h5*")):
                time.sleep(0.05)
            time.sleep(1.0)  # in the motion
            os.kill(os.getpid(), signal.SIGINT)

        threading.Thread(target=interrupt, daemon=True).start()
        begin = time.perf_counter()
        with self.assertRaisesRegex(KeyboardInterrupt, "--restart"):
            tj.run(FRAME, {"Transient/End Time": 1e3, "Transient/Step": 1e-5}, ["Reduction"],
                   output="interrupted")
        self.assertLess(time.perf_counter() - begin, 20)
        self.assertEqual(tj.read("interrupted").summary["status"], "interrupted")
        self.assertIs(signal.getsignal(signal.SIGINT), signal.default_int_handler)
        with self.assertRaises(KeyboardInterrupt):  # the handler of Python is restored
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(5)

    def test_ctrl_c_in_a_motion(self):
        part = tj.part("mass", [[1.0]], [[1.0]])
        part.model.set_start([1.0], [0.0])
        threading.Timer(1.0, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        with self.assertRaisesRegex(KeyboardInterrupt, "interrupted at t = "):
            tj.integrate(part, 1e6, sampling_interval=100, step=1e-3)


if __name__ == "__main__":
    sys.exit(unittest.main())
