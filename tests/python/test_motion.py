# SPDX-License-Identifier: BSD-3-Clause
"""Motions of reduced models against scipy, and point laws in Python against the same laws in
C++."""
import os
import signal
import threading
import time
import unittest

import beams
import numpy as np
import scipy.integrate
import scipy.sparse as sparse
import tooljoint as tj

CUBIC, LINEAR, DAMPING = 4e8, 3e4, 20.0


@tj.point_law("Tip Spring")
def tip_spring(t, d, v, stiffness=tj.Parameter(unit="N/m"), cubic=tj.Parameter(0.0, "N/m3"),
               damping=tj.Parameter(0.0, "N s/m")):
    """f = -k d - k3 d^3 - c v."""
    return -stiffness * d - cubic * d**3 - damping * v


def synthesis(law=None, load=None):
    """The reduced cantilever with a law and a start at the tip of its right half."""
    left, right, _, _ = beams.halves(tj)
    tip = right.model.position(25, "v")
    if law is not None:
        right.model.add_points("tip", law, sparse.csr_matrix(([1.0], ([0], [tip])),
                                                             (1, len(right))), nodes=[25])
    if load is not None:
        right.model.add_load(np.eye(len(right))[tip], "push", load)
    return tj.synthesise([left, right], modes=4)


def push(t):
    return 800.0 * np.sin(2 * np.pi * 15.0 * t)


END, SAMPLING = 0.2, 2e-3


def tip_motion(model, **parameters):
    return np.asarray(
        tj.integrate(model, END, sampling_interval=SAMPLING, **parameters).at(25, "v"))


class Motions(unittest.TestCase):
    def test_a_start_outside_the_basis_is_warned_of(self):
        def warned(start, **parameters):
            left, right, _, _ = beams.halves(tj)
            right.model.set_start(np.zeros(len(right)), start(right))
            tj.synthesise([left, right], modes=4, **parameters)
            return [
                sentence for sentence in tj.warnings()
                if "does not represent the initial state" in sentence
            ]

        def one_node(part):
            return np.eye(len(part))[part.model.position(20, "v")]

        self.assertIn("Start State Vectors", "".join(warned(one_node)))
        self.assertEqual(warned(one_node, start_state_vectors=True), [])
        self.assertEqual(warned(lambda part: np.zeros(len(part))), [])

    def test_python_law_is_the_law_in_cpp_and_that_of_scipy(self):
        parameters = dict(stiffness=LINEAR, damping=DAMPING)
        cpp = synthesis(tj.law("Spring", cubic_stiffness=CUBIC, **parameters), push)
        python = synthesis(tj.law("Tip Spring", cubic=CUBIC, **parameters), push)
        fine = dict(step=5e-5)
        one, other = tip_motion(cpp, **fine), tip_motion(python, **fine)
        size = abs(one).max()
        self.assertGreater(CUBIC * size**2, 0.1 * LINEAR, "the cubic term does not show")
        # The same steps; Newton iterates to 1e-9, with tangents by differences in one of them.
        self.assertLess(
            abs(one - other).max(), 1e-7 * size,
            "the law in Python moves otherwise than the one in C++")

        model = cpp.model
        M, K, C = model.mass.toarray(), model.stiffness().toarray(), model.damping().toarray()
        row = model.recovery[list(model.recovery_nodes).index(25) * 2].toarray().ravel()
        inverse = np.linalg.inv(M)

        def rates(t, y):
            q, v = np.split(y, 2)
            d, w = row @ q, row @ v
            f = model.load(t) + row * (-LINEAR * d - CUBIC * d**3 - DAMPING * w)
            return np.r_[v, inverse @ (f - K @ q - C @ v)]

        times = np.arange(len(one)) * SAMPLING
        truth = scipy.integrate.solve_ivp(rates, (0, END), np.zeros(2 * len(model)), "DOP853",
                                          times, rtol=1e-10, atol=1e-14)
        exact = row @ truth.y[:len(model)]
        # Generalised-alpha is of second order: half the step gives a quarter of the error.
        coarser = (tip_motion(python, step=step) for step in (2e-4, 1e-4))
        errors = [abs(each - exact).max() / size for each in (*coarser, other)]
        self.assertLess(errors[2], 2e-3, f"errors {errors}")
        for coarse, better in zip(errors, errors[1:]):
            self.assertTrue(3.0 < coarse / better < 5.0, f"errors {errors}: not of second order")
        self.assertLess(
            abs(tip_motion(python, integrator="RK4", step=2e-5) - exact).max(), 1e-6 * size)

    def test_motion_has_units_and_recovers_interior_nodes(self):
        both = synthesis(tj.law("Spring", stiffness=LINEAR), push)
        motion = tj.integrate(both, END, sampling_interval=SAMPLING, step=1e-4)
        self.assertEqual(
            [motion.time.unit,
             motion.at(7, "v", "acceleration").unit,
             motion.at(7, "theta").unit], ["s", "m/s2", "rad"])
        self.assertEqual(motion.velocity.unit, "m kg^0.5/s, m/s, rad/s")
        self.assertEqual(len(motion.model.dof_units), motion.displacement.shape[1])
        full = tj.couple([*both.unreduced])
        reference = tj.integrate(full, END, sampling_interval=SAMPLING, step=1e-4)
        found, want = np.asarray(motion.at(7, "v")), np.asarray(reference.at(
            7, "v"))  # node 7 is inside the left half
        self.assertLess(abs(found - want).max(), 0.01 * abs(want).max())
        self.assertEqual(motion.report["integrator"], "Generalized-alpha")
        energy = motion.report["energy"]
        self.assertLess(abs(energy["residual"]), 0.05)
        given = energy["initial"] + energy["loads"] + energy["drive"] + energy["circulatory"]
        taken = energy["friction"] + energy["contact_damping"] + sum(energy["damping"].values())
        self.assertAlmostEqual(given - taken,
                               energy["kinetic"] + energy["strain"] + energy["contact"],
                               delta=0.05 * (abs(given) + abs(taken)))
        with self.assertRaisesRegex(tj.ModelError, "no v of node 99"):
            motion.at(99, "v")

    def test_tangent_given_is_that_of_differences(self):
        def slopes(t, d, v, stiffness, cubic, damping):
            return (-stiffness - 3 * cubic * d**2)[:, None, None], np.full((len(d), 1, 1), -damping)

        def energy(t, d, v, stiffness, cubic, damping):
            return [float(sum(stiffness * d**2 / 2 + cubic * d**4 / 4)), float(sum(damping * v**2))]

        tj.point_law("Tip Spring Exact", tangent=slopes, power=energy)(tip_spring)
        given = dict(stiffness=LINEAR, cubic=CUBIC, damping=DAMPING)
        one = tip_motion(synthesis(tj.law("Tip Spring Exact", **given), push), step=1e-4)
        other = tip_motion(synthesis(tj.law("Tip Spring", **given), push), step=1e-4)
        self.assertLess(abs(one - other).max(), 1e-7 * abs(one).max())

    def test_energies_of_a_law_without_a_function_of_its_power(self):
        given = dict(stiffness=LINEAR, damping=DAMPING)
        reports = [
            tj.integrate(synthesis(law, push), END, sampling_interval=SAMPLING,
                         step=1e-4).report["energy"]
            for law in (tj.law("Spring", cubic_stiffness=CUBIC, **given),
                        tj.law("Tip Spring", cubic=CUBIC, **given))
        ]
        for name in ("contact", "contact_damping", "residual"):
            self.assertAlmostEqual(reports[0][name], reports[1][name],
                                   delta=1e-6 * abs(reports[0]["loads"]), msg=name)

        @tj.point_law("Shaken")
        def shaken(t, d, v):
            return 1e3 * np.sin(20 * t) - 4e4 * d

        mass = tj.part("mass", [[1.0]], [[0.0]])
        mass.model.add_points("base", tj.law("Shaken"), [[1.0]])
        energy = tj.integrate(mass, 1.0, sampling_interval=0.01, step=2e-4).report["energy"]
        self.assertLess(abs(energy["residual"]), 0.01)

        @tj.point_law("Wall")
        def wall(t, d, v):
            return np.where(d < -0.01, -1e6 * (d + 0.01), 0.0)

        ball = tj.part("ball", [[1.0]], [[0.0]])
        ball.model.add_points("wall", tj.law("Wall"), [[1.0]])
        ball.model.set_start([0.0], [-1.0])
        bounce = tj.integrate(ball, 0.05, sampling_interval=0.001, step=2e-5)
        # 10 ms of flight, half a period of contact, then the same speed backwards
        back = 0.01 + np.pi / 1e3
        self.assertAlmostEqual(float(bounce.velocity[-1, 0]), 1.0, delta=1e-3)
        self.assertAlmostEqual(float(bounce.displacement[-1, 0]), -0.01 + (0.05 - back), delta=1e-4)

    def test_a_law_with_states_is_that_in_cpp(self):
        def relaxed(t, d, v, stiffness, damping):
            return d

        def energy(t, d, v, x, rates, stiffness, damping):
            return [float(sum(stiffness * (d - x)**2 / 2)), float(sum(damping * rates**2))]

        def creep(t, d, v, x, stiffness, damping):
            force = -stiffness * (d - x)
            return force, -force / damping

        tj.point_law("Creep", states=1, start=relaxed, power=energy)(creep)
        given = dict(stiffness=LINEAR,
                     damping=0.1 * LINEAR * END)  # relaxes in a tenth of the motion
        for integrator, step, same in (("Generalized-alpha", 2e-4, 1e-7), ("RK4", 4e-5, 1e-10)):
            reports, tips = zip(
                *((motion.report["energy"], np.asarray(motion.at(25, "v")))
                  for motion in (tj.integrate(synthesis(law, push), END, sampling_interval=SAMPLING,
                                              integrator=integrator, step=step)
                                 for law in (tj.law("Maxwell", **given),
                                             tj.law("Creep", **given)))))
            with self.subTest(integrator):
                self.assertLess(
                    abs(tips[0] - tips[1]).max(),
                    same * abs(tips[0]).max(), "the law in Python moves otherwise")
                self.assertGreater(
                    abs(tips[0] -
                        tip_motion(synthesis(None, push), step=step, integrator=integrator)).max(),
                    0.01 * abs(tips[0]).max(), "the law does nothing")
                for name in ("contact", "contact_damping", "residual"):
                    self.assertAlmostEqual(reports[0][name], reports[1][name],
                                           delta=1e-6 * abs(reports[0]["loads"]), msg=name)

        # Without `power` the work of its forces counts as damping.
        tj.point_law("Creep Unsaid", states=1, start=relaxed)(creep)
        unsaid = tj.integrate(synthesis(tj.law("Creep Unsaid", **given), push), END,
                              sampling_interval=SAMPLING, step=1e-4).report["energy"]
        said = tj.integrate(synthesis(tj.law("Creep", **given), push), END,
                            sampling_interval=SAMPLING, step=1e-4).report["energy"]
        self.assertLess(abs(unsaid["residual"]), 1e-3)
        self.assertAlmostEqual(unsaid["contact_damping"], said["contact"] + said["contact_damping"],
                               delta=1e-3 * abs(said["loads"]))

    def test_a_law_with_two_states_of_a_point(self):
        @tj.point_law("Two Creeps", states=2)
        def both(t, d, v, x, first=LINEAR, second=2 * LINEAR, time=0.1):
            stretch = d[:, None] - x
            return -(stretch @ [first, second]), stretch / [time, 2 * time]

        def motion(*laws):
            mass = tj.part("mass", [[1.0]], [[0.0]])
            for number, law in enumerate(laws):
                mass.model.add_points(f"link {number}", law, [[1.0]])
            mass.model.set_start([0.0], [1.0])
            return np.asarray(
                tj.integrate(mass, 0.3, sampling_interval=0.01, step=1e-4).displacement)

        cpp = motion(tj.law("Maxwell", stiffness=LINEAR, damping=0.1 * LINEAR),
                     tj.law("Maxwell", stiffness=2 * LINEAR, damping=0.4 * LINEAR))
        self.assertLess(abs(motion(tj.law("Two Creeps")) - cpp).max(), 1e-7 * abs(cpp).max())

    def test_calls_of_laws_with_states_that_make_no_sense(self):
        for wrong, sentence in (
            (dict(states=-1), "-1 states"),
            (dict(width=0), "width 0"),
            (dict(start=push), "no states to start"),
            (dict(states=1, tangent=push), "leave tangent out"),
        ):
            with self.assertRaisesRegex(tj.UsageError, sentence):
                tj.point_law("Senseless", **wrong)

        @tj.point_law("Forgets Rates", states=1)
        def forgetful(t, d, v, x):
            return -d

        with self.assertRaisesRegex(tj.ModelError,
                                    "Forgets Rates.*return a pair, forces and rates"):
            tip_motion(synthesis(tj.law("Forgets Rates")), step=1e-3)

    def test_laws_of_two_coordinates(self):
        seen = []

        @tj.point_law("Skew", width=2)
        def skew(t, d, v, stiffness=tj.Parameter(100.0, "N/m")):
            seen.append(d.shape)
            return -stiffness * d @ np.array([[2.0, 1.0], [1.0, 3.0]])

        law = tj.law("Skew", points=2)
        self.assertEqual((law.size, law.width), (2, 2))
        force = law.force(0.0, [1.0, 0.0, 0.0, 1.0], np.zeros(4))
        self.assertEqual(force.tolist(), [-200.0, -100.0, -100.0, -300.0])
        self.assertEqual(seen, [(2, 2)])
        # as stiffness of a model: the frequencies are those of the matrix
        part = tj.part("plane", np.eye(4), np.zeros((4, 4)), component_names=("u", "v"))
        part.model.add_points("skew", law, np.eye(4))
        want = np.sqrt(
            np.sort(np.repeat(np.linalg.eigvalsh(100 * np.array([[2.0, 1.0], [1.0, 3.0]])),
                              2))) / (2 * np.pi)
        found = tj.modes(part, 4).frequency
        self.assertTrue(np.allclose(found, want, rtol=1e-8), f"{found} against {want}")

    def test_an_exception_in_a_law_comes_out_with_its_cause(self):
        @tj.point_law("Broken")
        def broken(t, d, v):
            if t > 0.01:
                raise ValueError("no force beyond 10 ms")
            return 0 * d

        @tj.point_law("Wrong Shape")
        def wrong(t, d, v):
            return np.zeros(7)

        with self.assertRaisesRegex(
                tj.ModelError,
                'The point law "Broken" raised ValueError: no force beyond 10 ms') as caught:
            tip_motion(synthesis(tj.law("Broken")), step=1e-3)
        self.assertIsInstance(caught.exception.__cause__, ValueError)
        with self.assertRaisesRegex(
                tj.ModelError,
                'The point law "Wrong Shape" returned 7 values at t = 0 s; expected are 1 forces'):
            tip_motion(synthesis(tj.law("Wrong Shape")), step=1e-3)
        with self.assertRaises(
                tj.ModelError) as caught:  # the cause of the last call is not the cause of this one
            tj.part("no matrix", "mass", np.eye(2))
        self.assertIsNone(caught.exception.__cause__)

    def test_a_law_that_returns_no_numbers_is_named(self):
        def motion(name, law, integrator="Generalized-alpha", **options):
            tj.point_law(name, **options)(law)
            mass = tj.part("mass", [[1.0]], [[1.0]])
            mass.model.add_points("link", tj.law(name), [[1.0]])
            mass.model.set_start([1.0], [0.0])
            return tj.integrate(mass, 0.1, integrator=integrator, step="1 ms",
                                sampling_interval=0.01)

        def late(value):
            return lambda t, d, v: value * d if t > 0.05 else -d

        with self.assertRaisesRegex(tj.ModelError,
                                    '^The point law "Complex" returned complex numbers'):
            motion("Complex", late(1j))
        for value in (None, 1j, np.ones(3), "text"):
            mass = tj.part("mass", [[1.0]], [[1.0]])
            mass.model.add_load([1.0], "load", lambda t, value=value: value)
            with self.assertRaisesRegex(
                    tj.ModelError,
                    'The law of time "load" returned something else than the real numbers'):
                tj.integrate(mass, 0.1, step="1 ms")
        mass = tj.part("mass", [[1.0]], [[1.0]])
        mass.model.add_load([1.0], "gap", lambda t: np.nan if t > 0.05 else 1.0)
        with self.assertRaisesRegex(
                tj.ModelError,
                r'^The law of time "gap" returned nan at t = 0\.05\S* s; expected are '
                'finite numbers'):
            tj.integrate(mass, 0.1, step="1 ms")
        with self.assertRaisesRegex(
                tj.ModelError,
                r'^The point law "None" returned None at t = 0\.05\S* s; expected are \d+ forces'):
            motion("None", lambda t, d, v: None if t > 0.05 else -d)
        for integrator in ("Generalized-alpha", "RK4"):
            for value in (np.nan, np.inf):
                with self.subTest(integrator, value=value), self.assertRaisesRegex(
                        tj.ConvergenceError,
                        fr'^The point law "No Number" returned {value} at t = 0\.05\S* s, where d '
                        r'is 0\.99\S* m and v -0\.\d+ m/s; expected are finite numbers\. '):
                    motion("No Number", late(value), integrator)
        with self.assertRaisesRegex(tj.ConvergenceError,
                                    '^The point law "No Rate" returned nan at t = '):
            motion("No Rate", lambda t, d, v, x: (-d, np.nan + x), states=1)
        # A rejected trial is not an error, and calls are independent.
        motion("In Bounds", lambda t, d, v: np.where(abs(d) < 1.5, -d, np.nan))
        self.assertEqual(str(tj.ConvergenceError("Another one.")), "Another one.")


class Threads(unittest.TestCase):
    def test_the_gil_is_released_in_a_motion(self):
        model = synthesis(tj.law("Spring", stiffness=LINEAR), None)
        count, ended = 0, False

        def work():
            nonlocal ended
            tj.integrate(model, 2.0, sampling_interval=0.1, step=2e-5)
            ended = True

        thread = threading.Thread(target=work)
        thread.start()
        begin = time.perf_counter()
        while not ended:
            time.sleep(1e-3)
            count += 1
        wall = time.perf_counter() - begin
        thread.join()
        self.assertGreater(wall, 0.1, "the motion is too short to tell")
        self.assertGreater(count, 20,
                           f"this thread ran {count} times in {wall:.2f} s beside a motion")

    def test_calls_of_several_threads_run_one_after_the_other(self):
        model = synthesis(tj.law("Tip Spring", stiffness=LINEAR), push)
        want = tip_motion(model, step=1e-3)
        found = [None] * 4

        def work(k):
            found[k] = tip_motion(model, step=1e-3)

        threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join(60)
        for one in found:
            self.assertTrue(np.array_equal(one, want))
        with self.assertRaises(KeyboardInterrupt):  # Python handles signals again
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(5)

    def test_a_function_may_call_the_toolkit(self):
        inner = tj.part("inner", [[1.0]], [[4.0]])

        @tj.point_law("Inner Frequency")
        def law(t, d, v):
            return -np.asarray(tj.modes(inner, 1).frequency)[0] * (2 * np.pi)**2 * d  # 1 / pi Hz

        mass = tj.part("mass", [[1.0]], [[0.0]])
        mass.model.add_points("law", tj.law("Inner Frequency"), [[1.0]])
        self.assertAlmostEqual(float(tj.modes(mass, 1).frequency[0]),
                               np.sqrt(4 * np.pi) / (2 * np.pi), places=8)


if __name__ == "__main__":
    unittest.main()
