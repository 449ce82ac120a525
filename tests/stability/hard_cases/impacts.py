# SPDX-License-Identifier: BSD-3-Clause
"""Impacts on walls: balls on stops, impacts of strings, grazing."""
import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from program import FULL
from rows import Plot, against, case, judged, statement
from scenes import (GRAVITY, QUANTILES, STRESS, alpha, arkode, bit_quantiles, ensemble,
                    impulse_rate, lateral_speed, mean_and_error, parts_deck, relative_error, rk4,
                    rk4_adaptive, times)

BALL = 3.0  # [kg]
DROP = 0.02  # [m]


def dissipation(restitution, speed):
    """chi of the Hunt-Crossley law for this coefficient of restitution: P(v) = P(-e v), P(v) =
    v/chi - ln(1 + chi v)/chi^2, from m v dv/dG = -k G (1 + chi v)."""
    if restitution >= 1.0:
        return 0.0
    part = lambda x: x - math.log1p(x)
    x = brentq(lambda x: part(x) - part(-restitution * x), 1e-9, 0.999 / restitution)
    return x / speed


def ball(program, stiffness, chi, height, settings, name="c8_ball", count=1, link=0.0):
    """Balls that fall from `height` onto stops; adjacent ones are linked by springs."""
    K = link * (2 * np.eye(count) - np.eye(count, k=1) - np.eye(count, k=-1))
    K[0, 0], K[-1, -1] = (link, link) if count > 1 else (0.0, 0.0)
    file = program.part(name, ["v"], BALL * np.eye(count), K, loads=[-BALL * GRAVITY] * count)
    starts = {
        f"drop {i}": {"Part": "ball", "Node": i, "Component": "v", "Displacement": float(height)}
        for i in range(1, count + 1)
    }
    stops = {
        f"floor {i}": {
            "First": f"ball:{i}", "Component": "v", "Stiffness": float(stiffness),
            "Damping": float(chi)
        } for i in range(1, count + 1)
    }
    deck = parts_deck(program, name, {"ball": file}, settings, Parts={"Starts": starts},
                      Coupling={"Stops": stops})
    return program.run(name, deck)


def apexes(run, when):
    """Heights y + v^2/2g that the balls reach [m], from the sample nearest to a time of free
    flight."""
    i = int(np.argmin(np.abs(run.time() - when)))
    return run.nodes(0)[i] + run.nodes(0, "velocity")[i]**2 / (2 * GRAVITY)


def rebound(program, stiffness, restitution, settings, step, offset):
    """Run of a ball whose impact is at the share `offset` of a step, and the time of its next
    apex."""
    height = 0.5 * GRAVITY * step**2 * (math.floor(math.sqrt(2 * DROP / GRAVITY) / step) +
                                        offset)**2
    speed = math.sqrt(2 * GRAVITY * height)
    top = speed / GRAVITY * (1 + restitution)
    run = ball(program, stiffness, dissipation(restitution, speed), height,
               {**settings, **times(step * math.ceil(top / step + 2), step)})
    return run, height, top


@case(8, "Stiff walls", "wall 1e8 to 1e12 N/m; steps 0.1 to 5 ms; spectral radius 0 to 1; "
      "restitution 0.5 and 1; the impact anywhere in a step; stress_170m with walls of 1e8 to 5e11 "
      "N/m, no and scaled damping", "impacts make no energy and keep the rebound of the law: "
      "apex within 0.02 e^2; of 16 strings rms lateral speed, impulse per second, and quantiles of "
      "the bit speed (in parts of their range) within 5 % and the 95 % intervals of both "
      "ensembles; longer steps are not refused less often; the static state has the same wall",
      "string on a wall of 1e7 N/m")
def stiff_walls(program, short):
    yield from balls(program, short)
    yield from static_walls(program, short)
    yield from striking_strings(program, short)


def balls(program, short):
    series = {"truth": []}
    steps = (1e-3,) if short else (1e-4, 5e-4, 1e-3, 2e-3, 5e-3)
    for restitution in (1.0, 0.5) if short else (1.0, 0.5):
        for radius in (0.2,) if short else (0.0, 0.2, 0.8, 1.0):
            for stiffness in (1e9,) if short else (1e8, 1e10, 1e12):
                for step in steps:
                    worst = None
                    for offset in (0.3,) if short else (0.02, 0.6):
                        run, height, top = rebound(program, stiffness, restitution,
                                                   alpha(step, radius), step, offset)
                        row = judged(
                            run, f"ball, e {restitution:g}, radius {radius:g}, {stiffness:.0e} N/m",
                            f"step {1e3 * step:g} ms",
                            lambda: against(restitution**2,
                                            float(apexes(run, top)[0]) / height, 1.0), 0.02)
                        if worst is None or row.failed or not row.deviation <= worst.deviation:
                            worst = row
                    if restitution == 1.0 and worst.verdict != "refused":
                        series.setdefault(f"radius {radius:g}, {stiffness:.0e} N/m", []).append(
                            (1e3 * step, float(worst.found or "nan")))
                    yield worst
    if not short:
        series["truth"] = [(1e3 * step, 1.0) for step in steps]
        yield Plot("rebound", "Rebound of a ball from an elastic wall", "step [ms]",
                   "apex / drop height", series, "x")
        for label, way in (
            ("RK4, 2 us", rk4(2e-6)),
            ("RK4 adaptive 1e-4", rk4_adaptive(1e-4)),
            ("ARKODE 1e-5", arkode(1e-5)),
        ):
            for restitution in (1.0, 0.3):
                run, height, top = rebound(program, 1e9, restitution, way, 1e-3, 0.35)
                yield judged(
                    run, f"ball, e {restitution:g}, 1e+09 N/m", label,
                    lambda: against(restitution**2,
                                    float(apexes(run, top)[0]) / height, 1.0), 0.02)


def static_walls(program, short):
    for stiffness in (1e9,) if short else (1e8, 1e9, 1e10, 1e11, 1e12):
        run = program.run("c8_static", STRESS, {"Contact/Stiffness": stiffness},
                          (*FULL, "Transient"))
        yield judged(
            run, "stress_170m, static state", f"wall {stiffness:g} N/m", lambda:
            ("residual below 1e-9", f"{run.summary['static']['residual']:.2g}", run.summary[
                "static"]["residual"]), 1e-9)


# References of strings on stiff walls, by the stiffness of the wall [N/m]: equal steps [s] without
# numerical damping, about a fifteenth of the impact duration of a node of 60 kg, pi sqrt(m / k),
# and the number of runs of an ensemble: 16, but 4 for the stiffest wall, where one takes half an
# hour.
TRUTHS = {1e8: (1e-4, 16), 3e9: (2e-5, 16), 2e10: (1e-5, 16), 5e11: (2e-6, 4)}
TRUTH_SECONDS = 5400
STRING_MEASURES = ("rms lateral speed [m/s]", "impulse per second [N]",
                   *(f"bit speed {q} % [rpm]" for q in QUANTILES))


def striking(begin):
    return lambda run: [
        lateral_speed(run, begin),
        impulse_rate(run, begin), *bit_quantiles(run, begin)
    ]


def striking_strings(program, short):
    """Ensembles are compared, because the motion is chaotic, and so are its means over a second or
    two."""
    end, begin = (0.15, 0.0) if short else (2.0, 0.5)
    easy = program.run("c8_easy", STRESS, {**times(end, 0.0025), **alpha(1e-3)}, FULL)
    for stiffness, (tight, runs) in TRUTHS.items():
        if short and stiffness != 3e9:
            continue
        runs = 2 if short else runs
        for damping in ("none",) if short else ("none", "scaled"):
            wall = {
                "Contact/Law": "Clamped", "Contact/Stiffness": stiffness,
                **times(end, 0.0025), "Contact/Damping": 0.0 if damping == "none" else 1e4 *
                math.sqrt(stiffness / 1e7)
            }
            # references with the same model exclude the error of the basis
            models = (("full", FULL),) if short else (("full", FULL), ("reduced", ()))
            # no limits that would shorten the steps
            way = {
                **alpha(tight, 1.0), "Transient/Step Error Warning": 5.0,
                "Transient/Step Error Limit": 5.0
            }
            truths, refused = {}, []
            for model, without in models:
                truths[model], refused, _ = ensemble(program, f"c8_truth_{model}", {**wall, **way},
                                                     without, runs, striking(begin), TRUTH_SECONDS)
                if refused:
                    break
            if refused:
                yield judged(refused[0], f"string, {stiffness:.0e} N/m, damping {damping}",
                             f"truth, {model}", None, 0.05, required=True)
                continue
            ways = [(f"{1e3 * step:g} ms", f"radius {radius:g}, full", alpha(step, radius), FULL)
                    for radius in ((0.2,) if short else (0.2, 0.8))
                    for step in ((1e-3,) if short else (5e-4, 1e-3, 2.5e-3))]
            if not short:
                ways.append(("1 ms", "radius 0.8, reduced", alpha(1e-3), ()))
                if stiffness == 1e8:  # another integrator; RK4 resolves only this wall
                    ways.append(("tolerance 0.01", "RK4 adaptive, full", rk4_adaptive(1e-2), FULL))
            shares = {}
            for step, name, way, without in ways:
                found, refused, last = ensemble(program, "c8", {**wall, **way}, without, runs,
                                                striking(begin))
                variant = f"string, {stiffness:.0e} N/m, damping {damping}, {name}"
                shares.setdefault((variant, name), []).append(
                    (step, len(refused) / (len(found) + len(refused))))
                if len(found) < 2:
                    yield judged(refused[-1], variant, f"step {step}, {runs} runs", None, 0.05,
                                 easy=easy)
                    continue
                (true, true_error), (mean, error) = mean_and_error(
                    truths["full" if without else "reduced"]), mean_and_error(found)
                scales = [*true[:2], *[true[-1] - true[2]] * len(QUANTILES)]
                said = f"{len(refused)} of {len(found) + len(refused)} refused" if refused else ""
                run = last if last.done else program.run("c8", STRESS, {**wall, **way}, without)
                for i, measure in enumerate(STRING_MEASURES):
                    apart = max(
                        0.0,
                        abs(mean[i] - true[i]) - math.hypot(error[i], true_error[i])) / scales[i]
                    yield judged(
                        run, variant, f"{step}, {measure}", lambda:
                        (f"{true[i]:.3g} +- {true_error[i]:.2g}",
                         f"{mean[i]:.3g} +- {error[i]:.2g}", apart), 0.05, easy=easy, note=said,
                        motion=True)
            for (variant, name), share in shares.items():
                if len(share) > 1:
                    yield statement(
                        variant, "share of refused runs by step", "does not fall",
                        ", ".join(f"{step}: {part:.2g}" for step, part in share),
                        all(later >= part - 0.3 for (_, part), (_, later) in zip(share, share[1:])))


@case(9, "Grazing impact",
      "amplitude beyond the gap by -1e-2 to 1e-2 of it; steps of 1 and 4 ms; three integrators",
      "no failure; the motion on either side is that of the exact oscillator",
      "an oscillator without a stop")
def grazing(program, short):
    omega, amplitude, wall, end = 10.0, 0.01, 1e6, 2.0
    file = program.part("grazing", ["v"], [[1.0]], [[omega**2]])
    ways = [("generalized-alpha 1 ms", alpha(1e-3))]
    if not short:
        ways += [
            ("generalized-alpha 4 ms", alpha(4e-3)),
            ("RK4, 50 us", rk4(5e-5)),
            ("ARKODE 1e-6", arkode(1e-6)),
        ]
    for label, way in ways:
        settings = {**times(end, 0.004), **way}
        starts = {
            "Starts": {
                "pull": {"Part": "mass", "Node": 1, "Component": "v", "Displacement": amplitude}
            }
        }
        easy = program.run("c9_easy",
                           parts_deck(program, "c9_easy", {"mass": file}, settings, Parts=starts))
        for beyond in (-1e-6, 1e-3) if short else (-1e-2, -1e-6, -1e-12, 1e-12, 1e-6, 1e-4, 1e-3,
                                                   1e-2):
            gap = amplitude * (1 - beyond)
            stop = {
                "Stops": {
                    "floor": {"First": "mass:1", "Component": "v", "Gap": gap, "Stiffness": wall}
                }
            }
            run = program.run(
                "c9",
                parts_deck(program, "c9", {"mass": file}, settings, Parts=starts, Coupling=stop))

            def measure():
                push = lambda y: wall * (-gap - y) if y < -gap else 0.0
                force = lambda t, y: (y[1], -omega**2 * y[0] + push(y[0]))
                exact = solve_ivp(force, (0, end), (amplitude, 0.0), "DOP853", run.time(),
                                  rtol=1e-11, atol=1e-13, max_step=5e-4).y[0]
                free = amplitude * np.cos(omega * run.time())
                return (f"differs from no stop by {relative_error(exact, free):.2g}", "error",
                        relative_error(run.nodes(0)[:, 0], exact))

            yield judged(run, label, f"beyond by {beyond:g}", measure, 0.02, required=True,
                         easy=easy, motion=True)
