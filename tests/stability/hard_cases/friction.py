# SPDX-License-Identifier: BSD-3-Clause
"""Friction: strong, at rest, sharp at low speed, reversed, and a moving boundary between stick and
slip."""
import math

import numpy as np

from program import FULL
from rows import Plot, against, case, judged, statement
from scenes import (AREA, DENSITY, GRAVITY, HELICAL, INERTIA, LYING, OUTER, QUANTILES, RPM, SHEAR,
                    STRESS, THETA_Z, U, V, alpha, arkode, bit_quantiles, bit_speed, ensemble,
                    lateral_speed, mean_and_error, models, parts_deck, relative_error, rk4,
                    rk4_adaptive, times)


def whirl(begin):
    """Measures of a run: quantiles of the bit speed [rpm], rms lateral speed [m/s], share of
    backward whirl, penetration into the wall [m]."""
    def measure(run):
        u, v, du, dv = (run.nodes(c, what)[run.time() >= begin]
                        for what in ("displacement", "velocity") for c in (U, V))
        moving = np.hypot(u, v).max(axis=0) > 1e-3
        backward = float(np.mean((u * dv - v * du)[:, moving] < 0))
        clearance = run.data("model/clearance")
        outside = float((np.hypot(u, v).max(axis=0) - clearance)[1:-1].max())
        return [*bit_quantiles(run, begin), lateral_speed(run, begin), backward, outside]

    return measure


@case(4, "Strong friction, hardly any damping",
      "friction 0.5/0.4, damping 0.002 1/s; stress_170m; 16 perturbed runs of three integrators",
      "bounded; backward whirl; quantiles of the bit speed and rms lateral speed of the "
      "integrators agree within 5 % of the 5-95 % range and the 95 % intervals of the ensembles",
      "generalized-alpha 1 ms, full")
def strong_friction(program, short):
    runs, begin, end = (2, 0.1, 0.2) if short else (16, 1.0, 2.5)
    easy = None
    for static, dynamic in ((0.5, 0.4),):
        mu = {"Contact/Friction/Static": static, "Contact/Friction/Dynamic": dynamic}
        mu.update(times(end, 0.005))
        truth, refused, _ = ensemble(program, "c4_truth", {**mu, **rk4_adaptive(1e-4)}, FULL, runs,
                                     whirl(begin))
        if refused:
            yield judged(refused[0], f"friction {static}/{dynamic}", "RK4 adaptive", None, 0.0,
                         required=True)
            continue
        # over 2.5 s steps of 1 ms have an error of a fifth of the motion before it becomes
        # chaotic, and are refused
        ways = [("generalized-alpha 1 ms, full", alpha(1e-3), FULL, short)]
        if not short:
            ways += [(f"generalized-alpha {1e3 * step:g} ms, {model}", alpha(step), without,
                      step < 5e-4) for model, without in (("full", FULL), ("reduced", ()))
                     for step in (1e-3, 5e-4, 2.5e-4) if (model, step) != ("full", 1e-3)]
            ways += [(f"ARKODE {tolerance:g}, full", arkode(tolerance), FULL, tolerance < 1e-3)
                     for tolerance in (1e-3, 1e-4)]
            # steps that the verdict refuses, and schemes with full and without numerical damping:
            # they show the cause of the tails
            ways += [
                (f"generalized-alpha {1e3 * step:g} ms, radius {radius:g}, full, any step error", {
                    **alpha(step, radius), "Transient/Step Error Warning": 5.0,
                    "Transient/Step Error Limit": 5.0
                }, FULL, False) for step in (1e-3, 5e-4, 2.5e-4) for radius in (0.0, 0.8, 1.0)
            ]
        true, true_error = mean_and_error(truth)
        series = {"truth RK4 adaptive": [(q, x) for q, x in zip(QUANTILES, true)]}
        for label, way, without, required in ways:
            found, refused, run = ensemble(program, "c4", {**mu, **way}, without, runs,
                                           whirl(begin))
            easy = easy or run
            variant = f"friction {static}/{dynamic}, {label}"
            if refused:
                yield judged(refused[0], variant, f"{runs} runs", None, 0.0, required=required)
                continue
            mean, error = mean_and_error(found)
            series[label] = [(q, x) for q, x in zip(QUANTILES, mean)]
            spread = true[4] - true[0]
            for i, name in [(i, f"bit speed {q} % [rpm]")
                            for i, q in enumerate(QUANTILES)] + [(5, "rms lateral speed [m/s]")]:
                scale = spread if i < 5 else true[5]
                apart = max(0.0,
                            abs(mean[i] - true[i]) - math.hypot(error[i], true_error[i])) / scale
                yield judged(
                    run, variant, name, lambda: (f"{true[i]:.3g} +- {true_error[i]:.2g}",
                                                 f"{mean[i]:.3g} +- {error[i]:.2g}", apart), 0.05,
                    required=required, easy=easy, motion="any step error" in label)
            yield statement(variant, "share of backward whirl", f"{true[6]:.2f}", f"{mean[6]:.2f}",
                            short or (mean[6] > 0.5 and abs(mean[6] - true[6]) < 0.1))
            deepest, deepest_allowed = found[:, 7].max(), 5e-3
            yield judged(
                run, variant, "deepest in the wall [m]", lambda:
                (f"< {1e3 * deepest_allowed:g} mm", f"{deepest:.2g}",
                 max(0.0, deepest / deepest_allowed - 1.0)), 0.0, required=required,
                motion="any step error" in label)
        if not short:
            yield Plot(f"quantiles_{100 * static:.0f}",
                       f"Bit speed, friction {static}/{dynamic}, {runs} runs", "quantile [%]",
                       "bit speed [rpm]", series)


@case(5, "Torque below break-away", "load 0.1 to 0.99 of the sliding force, v_r 1e-2 to 1e-5 m/s; "
      "one body on a slider, and a lying string that does not turn",
      "creep as the regularised law has it, v = v_r p / sqrt(1 - p^2) for a share p; "
      "no chatter; energy decays", "share 0.1")
def break_away(program, short):
    mass, force = 10.0, 1000.0
    file = program.part("block", ["v"], [[mass]], [[0.0]])
    ways = [("generalized-alpha 1 ms", alpha(1e-3))]
    if not short:
        ways += [("generalized-alpha 10 ms", alpha(1e-2)), ("ARKODE 1e-6", arkode(1e-6))]
    for label, way in ways:
        for slip in (1e-4,) if short else (1e-2, 1e-3, 1e-5):
            easy = None
            for share in (0.9,) if short else (0.1, 0.5, 0.9, 0.99):
                lists = {
                    "Loads": {
                        "push": {
                            "Part": "block", "Node": 1, "Component": "v", "Value": share * force,
                            "Law": "rise"
                        }
                    },
                    "Laws": {"rise": {"Form": "Ramp", "Ramp": {"Duration": 0.2}}},
                }
                slider = {
                    "Sliders": {
                        "floor": {
                            "First": "block:1", "Component": "v", "Force": force,
                            "Slip Velocity": slip
                        }
                    }
                }
                run = program.run(
                    "c5",
                    parts_deck(program, "c5", {"block": file}, {**times(1.0, 0.01), **way},
                               Parts=lists, Coupling=slider))
                easy = easy or run

                def creep():
                    speed = run.nodes(0, "velocity")[:, 0]
                    return against(slip * share / math.sqrt(1 - share**2), float(speed[-1]))

                yield judged(run, f"block, {label}, v_r {slip:g} m/s",
                             f"share {share:g} of the sliding force", creep, 0.01, required="alpha"
                             in label, easy=easy)
    yield from twisted_string(program, short)


def twisted_string(program, short):
    """A string at rest on the wall, twisted at its end by a share of its friction limit."""
    radius, length = OUTER, 60.0
    hold = 0.3 * DENSITY * AREA * GRAVITY * math.sin(math.radians(80)) * length * radius
    base = {
        "Contact/Damping": 1e5, "Damping/Mass Coefficient": 2.0, "Loads/Forces/twist/Node": 31,
        "Loads/Forces/twist/Component": "theta_z", "Loads/Forces/twist/Start Time": 0.1
    }
    end = 0.5 if short else 2.0
    for slip in (1e-3,) if short else (1e-2, 1e-3, 1e-4):
        for share in (0.5,) if short else (0.2, 0.5, 0.8):
            settings = {
                **base, **times(end, 0.005), "Loads/Forces/twist/Value": share * hold,
                "Contact/Friction/Regularisation Velocity": slip
            }
            truth = program.run("c5_truth", LYING, {**settings, **arkode(1e-6)},
                                (*FULL, "Rotary Speed"))
            for model, more, without in models({**settings, **alpha(1e-3)}):
                run = program.run("c5_string", LYING, more, (*without, "Rotary Speed"))
                variant = f"string, {model}, v_r {slip:g} m/s"
                twist = lambda one: one.nodes(THETA_Z)[:, -1]
                yield judged(
                    run, variant, f"twist of the end, share {share:g}", lambda:
                    (float(twist(truth)[-1]), float(twist(run)[-1]),
                     relative_error(twist(run), twist(truth))), 0.03, required=True, motion=True)
                if run.done and truth.done:
                    swings, true_swings = reversals(run), reversals(truth)
                    yield statement(variant, f"reversals in the second half, share {share:g}",
                                    str(true_swings), str(swings), swings <= true_swings + 2)


def reversals(run):
    """Changes of sign of the speed of the end in the second half of a run."""
    speed = run.nodes(THETA_Z, "velocity")[:, -1]
    late = speed[len(speed) // 2:]
    return int(np.sum(np.diff(np.sign(late[np.abs(late) > 1e-3 * np.abs(speed).max()])) != 0))


@case(6, "Sharp friction at low speed", "v_r 1e-5, 3e-5, 1e-4 m/s; 0.2 to 2 rpm; friction "
      "0.55/0.45; stress_170m and helical_170m, full and reduced, 1 ms",
      "every step of 1 ms converges; the bit turns no "
      "faster than friction and twist allow; the ledger closes", "v_r 0.02 m/s, 2 rpm")
def low_speed(program, short):
    decks = {"stress": STRESS, "helical": HELICAL}
    for name, deck in decks.items():
        end = 1.5 if not short else 0.1 if name == "stress" else 0.3
        settings = {
            **times(end, 0.005), **alpha(1e-3), "Contact/Friction/Static": 0.55,
            "Contact/Friction/Dynamic": 0.45
        }
        easy = program.run("c6_easy", deck,
                           {**settings, "Rotary Speed/Exponential/Final Speed": "2 rpm"}, FULL)
        for model, without in (("full", FULL),) if short else (("full", FULL), ("reduced", ())):
            for slip in (3e-5,) if short else (1e-5, 3e-5, 1e-4):
                for speed in (0.5 if name == "stress" else 1.0,) if short else ((
                        0.2, 0.5, 1.0, 2.0) if model == "full" else (0.5, 2.0)):
                    run = program.run(
                        "c6", deck, {
                            **settings, "Contact/Friction/Regularisation Velocity": slip,
                            "Rotary Speed/Exponential/Final Speed": f"{speed} rpm"
                        }, without)

                    def held():
                        turned = np.abs(run.nodes(THETA_Z) - run.nodes(THETA_Z)[0]).max()
                        unconverged = run.motion["unconverged_steps"]
                        # twice the rotation of the surface, and the twist at its release
                        bound = 2 * speed * RPM * end + 0.5
                        return (
                            f"turn < {bound:.2g} rad, ledger closed",
                            f"turn {turned:.2g} rad, residual {run.motion['energy_residual']:.2g}, "
                            f"{unconverged} unconverged", abs(run.motion["energy_residual"])
                            if turned < bound and unconverged == 0 else math.inf)

                    yield judged(run, f"{name}, {model}, v_r {slip:g} m/s", f"{speed:g} rpm", held,
                                 0.05, required=True, easy=easy)


@case(7, "Reversal, stop and start", "60 rpm forwards, stop, 60 rpm backwards; the changes take "
      "0.02 to 0.5 s; v_r 1e-2 to 1e-3 m/s; lying string, full and reduced",
      "friction changes sign smoothly: the torque at the top is minus what it "
      "was; the ledger closes; no step collapse", "no reversal")
def reversal(program, short):
    end = 1.5 if short else 3.0
    sampling = 0.005
    easy = program.run("c7_easy", LYING, {**times(end, sampling), **alpha(1e-3)}, FULL)
    for slip, changes in ((1e-2, (0.2,)),) if short else ((1e-2, (0.02, 0.1, 0.5)), (1e-3, (0.1,))):
        base = {
            **times(end, sampling), "Contact/Friction/Regularisation Velocity": slip,
            "Damping/Mass Coefficient": 2.0
        }
        for change in changes:
            third = end / 3
            table = {
                "Rotary Speed/Law": "Table",
                "Rotary Speed/Table/Interpolation": "Linear",
                "Rotary Speed/Table/Times": [
                    0.0, 0.3 * third, 0.3 * third + change, third, third + change
                ],
                "Rotary Speed/Table/Speeds": [60 * RPM, 60 * RPM, 0.0, 0.0, -60 * RPM],
            }
            settings = {**base, **table}
            truth = program.run("c7_truth", LYING, {**settings, **arkode(1e-5)},
                                (*FULL, "Rotary Speed/Constant"))
            ways = [(model, more, without)
                    for model, more, without in models({**settings, **alpha(1e-3)})]
            if not short and change == 0.1:
                ways += [(label, {**settings, **way}, FULL) for label, way in (
                    ("RK4 adaptive 1e-3, full", rk4_adaptive(1e-3)),
                    ("ARKODE 1e-4, full", arkode(1e-4)),
                )]
            for model, more, without in ways:
                run = program.run("c7", LYING, more, (*without, "Rotary Speed/Constant"))
                variant = f"{model}, v_r {slip:g} m/s"
                twist = lambda one: one.nodes(THETA_Z)[:, 1] - one.nodes(THETA_Z)[:, 0]
                torque = lambda one: SHEAR * 2 * INERTIA / 2.0 * twist(one)

                def mirrored():
                    found = torque(run)
                    late = run.time() > end - 0.2 * third
                    return f"{-torque(run)[0]:.4g} N m", f"{found[late].mean():.4g} N m", abs(
                        found[late].mean() + found[0]) / abs(found[0])

                if not short:
                    yield judged(run, variant, f"torque after reversal in {change:g} s", mirrored,
                                 0.05, required=True, easy=easy)
                yield judged(run, variant, f"torque at the top, {change:g} s, against ARKODE 1e-5",
                             lambda: ("0", "error", relative_error(torque(run), torque(truth))),
                             0.05, required=True, easy=easy, motion=True)
                if run.done and model in ("full", "reduced"):
                    residual, lost = run.motion[
                        "energy_residual"], run.motion["halved"] + run.motion["rejected"]
                    yield statement(variant, f"ledger and steps, {change:g} s",
                                    "< 5 %, < 10 % of the steps shortened",
                                    f"{residual:.2g}, {lost}",
                                    abs(residual) < 0.05 and lost < 0.1 * run.motion["steps"])


@case(25, "A front between stick and slip", "elements of 4, 2 and 1 m; turned slowly from one end, "
      "v_r 1e-4 and 2e-5 m/s; lying string of 240 m, full and reduced",
      "the slipping part is as long as the quasi-static "
      "string has it, l = sqrt(2 G J theta / t), t the friction torque per length; independent of "
      "the mesh within its size", "the coarsest mesh")
def moving_front(program, short):
    speed, ramp, mu = 0.08, 0.2, 0.3
    end = 0.6 if short else 1.2
    friction_torque = mu / math.sqrt(1 + mu**2) * DENSITY * AREA * GRAVITY * math.sin(
        math.radians(80)) * OUTER
    torsion = SHEAR * 2 * INERTIA
    series = {}
    easy = None
    for slip in (1e-4,) if short else (1e-4, 2e-5):
        for elements in (3,) if short else (3, 6, 12):
            size = 12.0 / elements
            settings = {
                **times(end, 0.005),
                **alpha(1e-3 if elements < 12 else 2.5e-4), "Well/Vertical/Length": 240.0,
                "Drillstring/Assembly": "{20*pipe}", "Well/Bore Radius": OUTER + 5e-5,
                "Contact/Stiffness": 1e8, "Drillstring/Components/pipe/Elements": elements,
                "Contact/Friction/Regularisation Velocity": slip, "Contact/Friction/Dynamic": mu,
                "Contact/Friction/Static": mu, "Static/Friction": "None", "Contact/Damping": 1e5,
                "Rotary Speed/Law": "Ramp", "Rotary Speed/Ramp/Final Speed": speed,
                "Rotary Speed/Ramp/Duration": ramp, "Damping/Mass Coefficient": 0.5
            }
            ways = [way for way in models(settings) if way[0] == "full" or elements == 6]
            if not short and elements == 6:
                ways.append(("ARKODE 1e-5, full", {
                    **{key: settings[key] for key in settings if "Generalized-alpha" not in key},
                    **arkode(1e-5)
                }, FULL))
            for model, more, without in ways:
                run = program.run("c25", LYING, more, (*without, "Rotary Speed/Constant"))
                easy = easy or run

                def front():
                    angle = speed * (end - ramp / 2)
                    length = math.sqrt(2 * torsion * angle / friction_torque)
                    surface = np.cumsum(run.data("transient/speed")) * 0.005
                    turned = run.nodes(THETA_Z)[-1] + surface[-1]
                    # in the slipping part the twist rate decreases linearly: theta = t (l - s)^2 /
                    # 2GJ, so sqrt(theta) is a line that ends at l
                    s = run.data("model/s")
                    part = (turned > 0.05 * angle) & (turned < 0.9 * angle)
                    slope, offset = np.polyfit(s[part], np.sqrt(turned[part]), 1)
                    found = -offset / slope
                    series.setdefault("truth", []).append((size, length))
                    series.setdefault(f"v_r {slip:g} m/s, {model}", []).append((size, found))
                    return against(length, float(found), length)

                yield judged(run, f"{model}, v_r {slip:g} m/s", f"elements of {size:g} m", front,
                             0.05 + size / 240, required=True, easy=easy)
    if not short:
        yield Plot("front", "Length of the slipping part", "element [m]", "length [m]", series)
