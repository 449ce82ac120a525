# SPDX-License-Identifier: BSD-3-Clause
"""Walls: no clearance, sharp laws, impacts, grazing, adhesion, combinations, the first contact."""
import math

import numpy as np

from program import FULL
from rows import against, case, judged, statement
from scenes import (COLUMN, GRAVITY, LYING, OUTER, STRESS, U, V, alpha, arkode, reduced,
                    relative_error, rk4, rk4_adaptive, times)
from impacts import BALL, DROP, apexes, ball

MIDDLE = 13  # middle node of column.xml
BORE = 0.108


def gauge(clearance):
    """Settings: a gauge in the middle of the column; the rest of the bore is out of reach."""
    return {
        "Well/Bore Radius": BORE, "Drillstring/Components/pipe/Gauge Position": 6.0,
        "Drillstring/Components/pipe/Gauge Radius": BORE - clearance, "Loads/Weight On Bit": 0.0,
        "Loads/Forces/push/Node": MIDDLE, "Loads/Forces/push/Component": "u",
        "Loads/Forces/push/Value": 2000.0, "Loads/Forces/push/Frequency": 3.0
    }


@case(1, "No clearance at a gauge",
      "clearance 0, 1e-12, 1e-9 m; wall 1e6, 1e8 N/m; three integrators, full and reduced",
      "no NaN; the motion is that on a linear support k_c (no friction), within 0.1 %, or what the "
      "same steps miss there and the gap changes", "the linear support, ARKODE at 1e-9")
def no_clearance(program, short):
    clearances = (0.0,) if short else (0.0, 1e-12, 1e-9)
    for stiffness, step in ((1e6, 1e-3),) if short else ((1e6, 1e-3), (1e8, 1e-3), (1e8, 2e-6)):
        ways = [(f"generalized-alpha {1e3 * step:g} ms", alpha(step))]
        if not short and (stiffness, step) != (1e8, 1e-3):
            ways += [("RK4", rk4()), ("ARKODE 1e-6", arkode(1e-6))]
        for model, more in (("full", {}), ("reduced", reduced(12))):
            common = {
                **times(0.06 if short else 0.4, 0.005), **more, "Damping/Mass Coefficient": 1.0
            }
            spring = {
                f"Coupling/Springs/wall {c}/{key}": value for c in "uv" for key, value in (
                    ("First", str(MIDDLE)),
                    ("Component", c),
                    ("Stiffness", stiffness),
                )
            }

            def on_support(folder, way):
                return program.run(folder, COLUMN, {**gauge(0.01), **common, **way, **spring},
                                   ("Contact",))

            def middle(run):
                return run.nodes(U)[:, MIDDLE - 1]

            def in_gauge(folder, clearance, way):
                return program.run(
                    folder, COLUMN, {
                        **gauge(clearance), **common, **way,
                        **regularised(1e11), "Contact/Stiffness": stiffness
                    })

            tight = arkode(1e-7 if short else 1e-9)  # far below the error of steps of 1 ms
            truth = middle(on_support("c1_truth", tight))
            changed = {
                gap: relative_error(middle(in_gauge("c1_gap", gap, tight)), truth)
                for gap in clearances
            }
            for label, way in ways:
                easy = on_support("c1_easy", way)
                missed = relative_error(middle(easy), truth) if easy.done else 0.0
                for clearance in clearances:
                    run = in_gauge("c1", clearance, way)

                    def measure():
                        found = middle(run)
                        return float(np.abs(truth).max()), float(
                            np.abs(found).max()), relative_error(found, truth)

                    # a step of 1 ms is too long for a wall of 1e8 N/m, and for the support
                    yield judged(run, f"{label}, {model}, {stiffness:.0e} N/m",
                                 f"clearance {clearance:g} m", measure,
                                 max(1e-3, 1.1 * (missed + changed[clearance])), required=easy.done
                                 and (stiffness, step) != (1e8, 1e-3), easy=easy)


def regularised(value):
    return {
        "Contact/Stiffness Regularisation": float(value),
        "Contact/Damping Regularisation": float(value),
    }


@case(2, "Sharp contact laws",
      "lambda 1e6, 1e7, 1e8, 7e11 1/m; stress_170m, full and reduced, laws Nguyen and Clamped",
      "vibration error against 7e11 1/m of 1e-4 at most, or a tenth of what the laws differ by; "
      "iterations within 10 %", "lambda = 7e11 1/m")
def sharp_laws(program, short):
    end = 0.3 if short else 1.0
    for law in ("Clamped",) if short else ("Clamped", "Nguyen"):
        for model, without in (("full", FULL),) if short else (("full", FULL), ("reduced", ())):
            settings = {**times(end, 0.005), **alpha(1e-3), "Contact/Law": law}
            easy = program.run("c2_easy", STRESS, {**settings, **regularised(7e11)}, without)
            for value in (1e8,) if short else (1e6, 1e7, 1e8):
                run = program.run("c2", STRESS, {**settings, **regularised(value)}, without)
                # the laws themselves differ by the depth 2 / (pi^2 lambda), here relative to the
                # penetration at rest
                sink = easy.summary["static"]["total_normal_force"] / easy.summary["static"][
                    "contact_nodes"] / 1e7
                yield judged(
                    run, f"{law}, {model}", f"lambda {value:g} 1/m", lambda:
                    ("0", "vibration error", program.vibration_error(run, easy, end)),
                    max(1e-4, 0.1 * 2 / (math.pi**2 * value) / sink), required=True, easy=easy,
                    motion=True)
                before, after = (one.motion.get("newton_iterations", 0) for one in (easy, run))
                yield statement(f"{law}, {model}", f"iterations at {value:g} 1/m", str(before),
                                str(after),
                                abs(after - before) <= 0.1 * before)


@case(3, "Blunt contact laws", "lambda 1e3, 3e3, 1e4 1/m; stress_170m, full",
      "runs, and differs from the sharp law by "
      "about 3e3/lambda per cent: another model, no error", "lambda = 7e11 1/m")
def blunt_laws(program, short):
    end = 0.3 if short else 1.0
    settings = {**times(end, 0.005), **alpha(1e-3), "Contact/Law": "Clamped"}
    sharp = program.run("c3_easy", STRESS, {**settings, **regularised(7e11)}, FULL)
    for value in (3e3,) if short else (1e3, 3e3, 1e4):
        run = program.run("c3", STRESS, {**settings, **regularised(value)}, FULL)
        tight = program.run("c3_tight", STRESS, {**settings, **regularised(value), **alpha(2.5e-4)},
                            FULL)

        def measure():
            apart = program.vibration_error(run, sharp, end)
            return (f"differs from the sharp law by {apart:.2g}"
                    ), "error of the step", program.vibration_error(run, tight, end)

        yield judged(run, "Clamped, full, 1 ms against 0.25 ms", f"lambda {value:g} 1/m", measure,
                     0.02, required=True, easy=sharp)


def law_force(law, gap, rate, stiffness, damping, dissipation_, sharpness):
    """Normal force of a contact law as printed in docs/theory.md; positive pushes off the wall."""
    if law == "Hunt-Crossley":
        return np.where(gap > 0, stiffness * gap * np.maximum(0.0, 1 + dissipation_ * rate), 0.0)
    step = np.arctan2(1.0, -math.pi * sharpness * gap) / math.pi
    if law == "Nguyen":
        return step * (stiffness * gap + damping * rate)
    inside = 2 / math.pi * np.arctan(math.pi * sharpness * gap)
    return np.where(gap > 0, np.maximum(0.0, inside * (stiffness * gap + damping * rate)), 0.0)


@case(10, "Adhesive rebound of the printed law",
      "laws Nguyen, Clamped, Hunt-Crossley; damping 1e4 and 1e5 N s/m; stress_170m",
      "the printed law is reproduced, attraction included, and it is said; Clamped and "
      "Hunt-Crossley never pull")
def adhesion(program, short):
    sharpness, stiffness, chi = 7e11, 1e7, 0.5
    for damping in (1e5,) if short else (1e4, 1e5):
        for law in ("Nguyen", "Clamped", "Hunt-Crossley"):
            settings = {
                **times(0.5 if short else 2.0, 0.001),
                **alpha(2.5e-4 if not short else 1e-3), "Contact/Law": law
            }
            if law == "Hunt-Crossley":
                settings["Contact/Hunt-Crossley/Dissipation"] = chi
            else:
                settings["Contact/Damping"] = damping
            run = program.run("c10", STRESS, settings,
                              (*FULL, *(("Contact/Damping",) if law == "Hunt-Crossley" else ())))
            variant = (f"{law}, damping {damping:g} N s/m"
                       if law != "Hunt-Crossley" else f"{law}, {chi} s/m")

            def reproduced():
                u, v, du, dv = (run.nodes(c, what) for what in ("displacement", "velocity")
                                for c in (U, V))
                radius = np.sqrt(u**2 + v**2 + 1e-18)
                exact = law_force(law, radius - run.data("model/clearance"),
                                  (u * du + v * dv) / radius, stiffness, damping, chi, sharpness)
                free = [i for i in range(u.shape[1]) if np.ptp(u[:, i]) > 0]
                force = run.data("transient/normal_force")
                wrong = np.abs(force - exact)[:, free].max()
                return float(exact[:, free].min()), float(force[:, free].min()), float(
                    wrong / np.abs(exact).max())

            yield judged(run, variant, "smallest normal force [N]", reproduced, 1e-6, required=True)
            if run.done:
                least = float(run.data("transient/normal_force").min())
                if law == "Nguyen":
                    said = [
                        line for line in run.output.splitlines()
                        if any(word in line.lower() for word in ("attract", "pull", "adhes"))
                    ]
                    yield statement(variant, "the attraction is said", "a sentence",
                                    said[0].strip() if said else "no word", bool(said))
                else:
                    yield statement(variant, "never pulls", ">= 0", f"{least:.3g} N", least >= 0.0)


@case(24, "All contacts gained and lost at once",
      "40 linked balls on walls of 1e5 to 1e9 N/m; a lying string thrown off the wall by 1.5 to 10 "
      "times its weight",
      "at most 20 iterations in a step; the motion is that of one ball, or of ARKODE, within 5 %",
      "one ball")
def all_at_once(program, short):
    step, count = 1e-3, 40
    height = DROP
    speed = math.sqrt(2 * GRAVITY * height)
    for stiffness in (1e7,) if short else (1e5, 1e7, 1e9):
        settings = {**alpha(step, Max_Iterations=20), **times(0.2, step)}
        easy = ball(program, stiffness, 0.0, height, settings, "c24_ball")
        run = ball(program, stiffness, 0.0, height, settings, "c24_balls", count, 1e4)

        def measure():
            top = 2 * speed / GRAVITY + math.pi * math.sqrt(BALL / stiffness)
            found = apexes(run, top) / height
            worst = found[np.argmax(np.abs(found - 1))]
            return against(1.0, float(worst))

        yield judged(run, f"{count} balls, Max Iterations 20", f"wall {stiffness:g} N/m", measure,
                     0.05, required=True, easy=easy)
        if not short:
            for label, way in (
                ("RK4 adaptive 1e-4", rk4_adaptive(1e-4)),
                ("ARKODE 1e-5", arkode(1e-5)),
            ):
                run = ball(program, stiffness, 0.0, height, {**way, **times(0.2, step)},
                           "c24_balls", count, 1e4)
                yield judged(run, f"{count} balls, {label}", f"wall {stiffness:g} N/m", measure,
                             0.05, required=True, easy=easy)
    throw = {}
    nodes = 31
    for factor in (3.0,) if short else (1.5, 3.0, 10.0):
        weight = 27.5 * GRAVITY * 2.0  # weight of the pipe of an element
        throw = {
            f"Loads/Forces/n{i}/{key}": value for i in range(2, nodes)
            for key, value in (("Node", i), ("Component", "u"), ("Value", factor * weight),
                               ("Start Time", 0.05), ("End Time", 0.1))
        }
        end = 0.4
        truth = program.run("c24_truth", LYING, {**throw, **times(end, 0.005), **arkode(1e-6)},
                            FULL)
        for model, without in (("full", FULL),) if short else (("full", FULL), ("reduced", ())):
            run = program.run("c24", LYING,
                              {**throw, **times(end, 0.005), **alpha(step, Max_Iterations=20)},
                              without)
            yield judged(run, f"string, {model}, Max Iterations 20",
                         f"thrown with {factor:g} times its weight", lambda:
                         ("0", "vibration error", program.vibration_error(run, truth, end)), 0.05,
                         motion=True, required=True)


@case(29, "Nothing touches, then one touch", "12 m of pipe shaken in a bore that it never reaches, "
      "or reaches at one node; clearance 1e-3 to 1e-1 of the bore",
      "free: the numbers of the run without a wall to 1e-9 "
      "(ARKODE 1e-4); touching: those of ARKODE within 5 %, and of the law that acts at every gap "
      "within 0.5 %", "no wall")
def first_touch(program, short):
    end = 0.5
    shaken = {
        "Loads/Weight On Bit": 0.0, "Loads/Forces/push/Node": MIDDLE,
        "Loads/Forces/push/Component": "u", "Loads/Forces/push/Value": 3000.0,
        "Loads/Forces/push/Frequency": 2.0, "Damping/Mass Coefficient": 1.0, **times(end, 0.0025)
    }
    ways = [("generalized-alpha 0.5 ms", alpha(5e-4))]
    if not short:
        ways += [("RK4", rk4()), ("ARKODE 1e-5", arkode(1e-5))]
    for model, more in (("full", {}), ("reduced", reduced(12))):
        settings = {**shaken, **more}
        # with a wall within reach the default step of RK4 in a reduced model is another one
        ways = [(label, rk4(2e-4) if (label, model) == ("RK4", "reduced") else way)
                for label, way in ways]
        free = {
            label: program.run(f"c29_free_{i}", COLUMN, {**settings, **way}, ("Contact",))
            for i, (label, way) in enumerate(ways)
        }
        easy = free[ways[0][0]]
        reach = float(np.hypot(easy.nodes(U), easy.nodes(V)).max())
        for share in (1.5,) if short else (1.001, 1.5, 10.0):
            for label, way in ways:
                run = program.run("c29", COLUMN,
                                  {**settings, **way, "Well/Bore Radius": OUTER + share * reach})
                yield judged(
                    run, f"{label}, {model}", f"clearance {share:g} of the largest displacement",
                    lambda: ("0", "largest difference over the motion",
                             float(
                                 np.abs(
                                     run.data("transient/displacement") - free[label].data(
                                         "transient/displacement")).max() / reach)),
                    1e-4 if "ARKODE" in label else 1e-9, required=True, easy=easy)
        for share in (0.8,) if short else (0.99, 0.8, 0.5):
            touch = {"Well/Bore Radius": OUTER + share * reach, "Contact/Damping": 1e3}
            tight = "1e-5" if short else "1e-6"
            truth = program.run("c29_truth", COLUMN, {**settings, **touch, **arkode(tight)})
            for label, way in ways:
                run = program.run("c29", COLUMN, {**settings, **way, **touch})
                yield judged(
                    run, f"{label}, {model}", f"clearance {share:g} of it, against ARKODE {tight}",
                    lambda: ("0", "vibration error", program.vibration_error(run, truth, end)),
                    0.05, motion=True, required=True, easy=easy)
            undamped = {
                **settings, **touch, **ways[0][1], "Contact/Damping": 0.0, **regularised(9e9)
            }
            every = program.run("c29_every", COLUMN, {**undamped, "Contact/Law": "Nguyen"})
            same = program.run("c29_same", COLUMN, undamped)
            yield judged(
                every, f"{ways[0][0]}, {model}",
                f"clearance {share:g} of it, the law that acts at every gap", lambda:
                ("0", "vibration error", program.vibration_error(every, same, end)), 5e-3,
                required=True)
