# SPDX-License-Identifier: BSD-3-Clause
"""Long strings, fast spin-up, too large steps."""
import math

import numpy as np
from scipy.linalg import expm

from program import FULL
from rows import Plot, against, case, judged, statement
from scenes import (HELICAL, LYING, STRESS, THETA_Z, U, V, alpha, arkode, models, parts_deck,
                    relative_error, rk4, rk4_adaptive, times)


@case(17, "Long strings", "60 m to 10 km of pipe, 1e3 to 1e5 dofs; full and reduced",
      "O(n) work in a step; the static residual at rounding", "1 km")
def long_strings(program, short):
    series, shortest = {}, {}
    for length, pipes in ((60, 5), (240, 20)) if short else ((240, 20), (1008, 84), (10008, 834)):
        settings = {
            "Well/Vertical/Length": float(length), "Drillstring/Assembly": f"{{{pipes}*pipe}}",
            "Drillstring/Components/pipe/Elements": 24, "Well/Vertical/Inclination": "5 deg",
            **times(0.1, 0.01), **alpha(1e-3)
        }
        for model, more, without in models(settings)[:1 if length > 5000 else 2]:
            run = program.run("c17", LYING, more, without, seconds=1200)
            dofs = run.summary.get("model", {}).get("free_dofs") or 0

            def linear():
                cost = run.motion["cpu_s"] / run.motion["newton_iterations"] / dofs
                series.setdefault(model, []).append((dofs, 1e9 * cost))
                first = shortest.setdefault(model, cost)
                return f"at most 3 x {1e9 * first:.3g} ns", (
                    f"{1e9 * cost:.3g} ns per iteration and dof"), cost / first

            yield judged(run, f"work of a step, {model}", f"{length} m, {dofs} dofs", linear, 3.0,
                         required=True)
            yield judged(
                run, f"static residual, {model}", f"{length} m", lambda:
                ("1e-8", f"{run.summary['static']['residual']:.2g}", run.summary["static"][
                    "residual"]), 1e-8, required=True)
    if not short:
        yield Plot("length", "Work of an iteration per dof", "dofs", "[ns]", series, "xy")


@case(21, "Spin-up with large angular acceleration", "400 rpm in 1 ms to 0.1 s, with and without "
      "gravity's contact; steps 0.1 to 2 ms; full and reduced",
      "the twist is that of ARKODE on the same model; the end state that "
      "of the slow limit; the ledger closes (the skew part does no work)", "spin-up in 0.5 s")
def spin_up(program, short):
    speed, end = 400 * math.pi / 30, 0.6
    series = {}
    for contact in (False,) if short else (False, True):
        base = {
            "Loads/Gravity": 9.81 if contact else 0.0, "Damping/Mass Coefficient": 0.5,
            "Rotary Speed/Law": "Ramp", "Rotary Speed/Ramp/Final Speed": speed
        }
        gone = ("Rotary Speed/Constant",) if contact else ("Rotary Speed/Constant", "Contact")
        easy = program.run(
            "c21_easy", LYING,
            {**base, **times(end, 0.005), **alpha(1e-3), "Rotary Speed/Ramp/Duration": 0.5},
            (*FULL, *gone))
        for duration in (0.01,) if short else (1e-3, 1e-2, 0.1) if not contact else (1e-2,):
            settings = {**base, **times(end, 0.005), "Rotary Speed/Ramp/Duration": duration}
            truths = {
                model: program.run(f"c21_truth_{model}", LYING, more, (*without, *gone))
                for model, more, without in models({**settings, **arkode(1e-6)})
            }
            ways = [(f"step {1e3 * step:g} ms", alpha(step))
                    for step in ((1e-3,) if short else (1e-4, 1e-3, 2.5e-3))]
            if not short:
                ways.append(("RK4 adaptive 1e-3", rk4_adaptive(1e-3)))
            for label, way in ways:
                for model, more, without in models({**settings, **way}):
                    if label != "step 1 ms" and model == "reduced":
                        continue
                    run = program.run("c21", LYING, more, (*without, *gone))
                    variant = f"{'on the wall' if contact else 'free'}, {model}, {label}"

                    def twist():
                        a, b = (one.nodes(THETA_Z)[:, -1] for one in (run, truths[model]))
                        found = relative_error(a, b)
                        if model == "full":
                            series.setdefault(variant, []).append((duration, found))
                        return float(np.abs(b).max()), float(np.abs(a).max()), found

                    yield judged(run, variant, f"twist of the end, in {1e3 * duration:g} ms", twist,
                                 0.05, easy=easy, motion=True)
                    if run.done and label != "step 2.5 ms":
                        residual = run.motion["energy_residual"]
                        yield statement(
                            variant, f"ledger, in {1e3 * duration:g} ms", "below 5 %, or said",
                            f"{residual:.2g}",
                            abs(residual) < 0.05 or any("nergy" in w for w in run.warnings()))
    if not short:
        yield Plot("spin_up", "Error of the twist after a spin-up to 400 rpm", "duration [s]",
                   "relative error", series, "xy")


@case(22, "Steps ten and a hundred times too large",
      "steps of 0.5 to 100 ms; stress_170m, helical_170m and the lying string, full and reduced",
      "an error above 20 % is warned of, one above 50 % refused; a step of 1 ms is accepted; "
      "smooth motion converges with the order of the scheme", "1 ms")
def large_steps(program, short):
    series = {}
    end = 0.6 if short else 2.0
    for name, deck in (("lying", LYING),) if short else (
        ("stress_170m", STRESS),
        ("helical_170m", HELICAL),
        ("lying", LYING),
    ):
        tweak = {
            "Rotary Speed/Constant/Speed": "120 rpm", "Loads/Forces/shake/Node": 20,
            "Loads/Forces/shake/Component": "v", "Loads/Forces/shake/Value": 2000.0,
            "Loads/Forces/shake/Frequency": 3.0
        } if name == "lying" else {}
        for model, more, without in models({**tweak, **times(end, 0.1)}):
            truth = program.run("c22_truth", deck, {**more, **alpha(5e-5)}, without)
            easy = program.run("c22_easy", deck, {**more, **alpha(1e-3)}, without)
            for step in (1e-3, 2e-2) if short else (5e-4, 1e-3, 2.5e-3, 5e-3, 1e-2, 2.5e-2, 5e-2,
                                                    1e-1):
                run = program.run("c22", deck, {**more, **alpha(step)}, without)

                def wrong():
                    found = program.vibration_error(run, truth, end)
                    series.setdefault(f"{name}, {model}", []).append((1e3 * step, found))
                    # impacts are integrated in shorter steps than those of the deck
                    return "0", f"vibration error, {run.motion['steps']} steps", found

                yield judged(run, f"{name}, {model}", f"step {1e3 * step:g} ms", wrong, 0.05,
                             required=step <= 1e-3, easy=easy, motion=True)
    yield from orders(program, short)
    if not short:
        yield Plot("steps", "Error of the steps that are accepted", "step [ms]", "vibration error",
                   series, "xy")


def orders(program, short):
    """Two coupled oscillators of 8 and 30 rad/s in free vibration: error against exp(A t) for
    several steps, and its order."""
    K, c, end, sampling = np.array([[500.0, -430.0], [-430.0, 480.0]]), 0.5, 1.6, 0.032
    file = program.part("orders", ["u", "v"], np.eye(2), K, C=c * np.eye(2))
    start = {"pull": {"Part": "mass", "Node": 1, "Component": "u", "Displacement": 0.01}}
    generator = np.block([[np.zeros((2, 2)), np.eye(2)], [-K, -c * np.eye(2)]])
    steps = (4e-3, 2e-3) if short else (1.6e-2, 8e-3, 4e-3, 2e-3, 1e-3)
    ways = {
        "generalized-alpha, radius 0.8": (2, lambda step: alpha(step, Tolerance=1e-10)),
        "generalized-alpha, radius 0.8, uncorrected": (
            2, lambda step: alpha(step, Tolerance=1e-10, Phase_Correction=False)),
        "generalized-alpha, radius 1, uncorrected": (
            2, lambda step: alpha(step, 1.0, Tolerance=1e-10, Phase_Correction=False)),
        "RK4": (4, rk4),
    }
    series = {}
    for label in ("generalized-alpha, radius 0.8", "RK4") if short else ways:
        (order, way), errors = ways[label], []
        for step in steps:
            settings = {
                **times(end, sampling), **way(step), "Transient/Step Error Warning": 5.0,
                "Transient/Step Error Limit": 5.0
            }
            run = program.run(
                "c22_orders",
                parts_deck(program, "c22_orders", {"mass": file}, settings,
                           Parts={"Starts": start}))
            exact = np.array([(expm(generator * t) @ [0.01, 0, 0, 0])[:2] for t in run.time()])
            errors.append(relative_error(run.data("transient/displacement")[:, 0, :2], exact))
        series[label] = list(zip([1e3 * step for step in steps], errors))
        found = math.log(errors[-2] / errors[-1]) / math.log(2)
        yield statement(label, "order of the last two steps", f"at least {order}",
                        f"{found:.3g}, error {errors[-1]:.2g}", found > order - 0.1)
    if not short:
        yield Plot("orders", "Orders of convergence: two oscillators", "step [ms]",
                   "relative error", series, "xy")
