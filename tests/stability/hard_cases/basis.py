# SPDX-License-Identifier: BSD-3-Clause
"""Reduced models beyond their basis: impacts shorter than the periods of its modes, initial states
outside of it."""
import math

from rows import Plot, case, judged, statement
from scenes import alpha, arkode, parts_deck, planar_beam, reduced, times

FACTOR = 3.0  # ratio of the true error to its estimate
WARNED_FACTOR = 5.0  # if the run prints that the estimate "can be a fifth of the error"


def two_beams(program, name, elements):
    """Two cantilever halves of one slender beam, joined in the middle: the files for a deck and
    their joint."""
    K, M = planar_beam(elements, 1.0, 1000.0, 2.0)
    file = program.part(name, ["v", "theta_z"], M, K, 0.2 * M + 2e-6 * K,
                        sets={"near": [1], "far": [elements + 1]})
    return {"left": {"File": file, "Fixed": ["near"]}, "right": file}, {
        "Joints": ["left:far = right:near"],
    }


def estimates(program, run, full, end, points):
    """Measures a row: the true and the estimated error, and their ratio if the true one is above 1
    %."""
    def said():
        true, guess = program.vibration_error(
            run, full, end), run.summary["reduction"]["estimate"]["motion_error"]
        points.append((true, guess))
        times = f", {guess / true:.2g} times as large" if guess > FACTOR * true > 0 else ""
        return (f"{true:.2g}", f"estimate {guess:.2g}{times}",
                0.0 if true < 0.01 else true / guess if guess > 0 else math.inf)

    return said


def factor(run):
    return WARNED_FACTOR if any(
        "can be a fifth of the error" in warning for warning in run.warnings()) else FACTOR


@case(27, "A reduced model beyond its basis",
      "tip of a beam of two parts on stops of 1e3 to 1e8 N/m; 0 to 16 modes a part",
      "the error estimate says so: at least a third of the true error wherever that is above 1 %, "
      "a fifth where the run warns of that; without it the energy at the cut-off does, or of modes "
      "that are missing", "soft stop")
def beyond_basis(program, short):
    elements, end = 16, 0.5
    files, joint = two_beams(program, "c27", elements)
    lists = {
        **joint,
        "Loads": {
            "push": {
                "Part": "right", "Node": elements + 1, "Component": "v", "Value": -40.0,
                "Law": "pulse"
            }
        },
        "Laws": {
            "pulse": {
                "Form": "Table",
                "Table": {"Times": [0.0, 0.05, 0.1], "Values": [0.0, 1.0, 0.0]},
            }
        },
    }
    series = {}
    for stiffness in (1e6,) if short else (1e3, 1e5, 1e6, 1e8):
        stop = {
            "Stops": {
                "stop": {
                    "First": f"right:{elements + 1}", "Component": "v", "Gap": 0.002,
                    "Stiffness": stiffness
                }
            }
        }
        settings = {**times(end, 0.001), **alpha(1e-4)}
        full = program.run(
            "c27_full", parts_deck(program, "c27_full", files, settings, Parts=lists,
                                   Coupling=stop))
        for modes in (0, 2) if short else (0, 1, 2, 4, 8, 16):
            more = {**settings, **reduced(modes), "Reduction/Error Estimate": "Transient"}
            run = program.run("c27",
                              parts_deck(program, "c27", files, more, Parts=lists, Coupling=stop))
            points = series.setdefault(f"stop {stiffness:.0e} N/m", [])
            said = estimates(program, run, full, end, points)
            yield judged(run, f"stop {stiffness:.0e} N/m", f"{modes} modes", said, factor(run),
                         easy=full)
            if run.done:
                if modes > 0:
                    where, key = "at the cut-off", "cut_off_energy"
                else:
                    where, key = "of missing modes", "missing_energy"
                error, share = points[-1][0], run.summary["transient"][key]
                yield statement(f"stop {stiffness:.0e} N/m",
                                f"{modes} modes: kinetic energy {where}",
                                "above 1 % with an error of 20 %, below with one of 2 %",
                                f"{share:.2g}, error {error:.2g}",
                                share > 0.01 if error > 0.2 else share < 0.01 or error > 0.02)
    if not short:
        series["truth"] = [(1e-6, 1e-6), (10.0, 10.0)]
        yield Plot("estimate", "Estimated beside true error of the reduced motion",
                   "vibration error", "estimate", series, "xy")


@case(31, "A start outside the basis", "velocity, or displacement, of one node in the interior of "
      "a part; 0 to 16 modes; with and without Start State Vectors",
      "the misfit is said; the error estimate is at least a third of the error, and may "
      "be larger; Start State Vectors put the start into the basis", "the full model")
def outside_basis(program, short):
    elements, end = 16, 0.2
    files, joint = two_beams(program, "c31", elements)
    series = {}
    for what, value in (("Velocity", 1.0),) if short else (
        ("Velocity", 1.0),
        ("Displacement", 1e-3),
    ):
        lists = {
            **joint, "Starts": {
                "kick": {"Part": "left", "Node": elements // 2 + 1, "Component": "v", what: value}
            }
        }
        settings = {**times(end, 2e-4),
                    **arkode(1e-8)}  # a single displaced node excites all frequencies
        full = program.run("c31_full", parts_deck(program, "c31_full", files, settings,
                                                  Parts=lists))
        for vectors in (False, True):
            for modes in (2,) if short else (0, 2, 4, 8, 16):
                more = {
                    **settings, **reduced(modes), "Reduction/Error Estimate": "Transient",
                    "Reduction/Start State Vectors": vectors
                }
                run = program.run("c31", parts_deck(program, "c31", files, more, Parts=lists))
                variant = f"{what.lower()} of one node{', Start State Vectors' if vectors else ''}"
                said = estimates(program, run, full, end, series.setdefault(variant, []))
                yield judged(run, variant, f"{modes} modes", said, FACTOR, easy=full)
                if run.done:
                    misfit = run.summary["reduction"].get("start_misfit")
                    warned = any(
                        "does not represent the initial state" in w for w in run.warnings())
                    good = misfit is not None and warned == (misfit > 0.01)
                    good = good and (not vectors or misfit < 1e-6)
                    yield statement(
                        variant, f"{modes} modes: the misfit",
                        "said above 1 %" if not vectors else "none",
                        f"{misfit:.2g}, {'said' if warned else 'no word'}"
                        if misfit is not None else "not measured", good)
    if not short:
        series["truth"] = [(1e-6, 1e-6), (10.0, 10.0)]
        yield Plot("start", "Estimated beside true error of a start outside the basis",
                   "vibration error", "estimate", series, "xy")
