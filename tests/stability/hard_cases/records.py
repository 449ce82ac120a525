# SPDX-License-Identifier: BSD-3-Clause
"""Restarts at any time, with other numbers of ranks; long runs at rest and of stationary motion."""
import contextlib
import math
import os
import signal
import subprocess
import time

import h5py
import numpy as np

from program import FULL, QUIET, ROOT, Run
from rows import Plot, case, judged, statement
from scenes import LYING, THETA_Z, U, V, alpha, arkode, bit_speed, models, rk4, rk4_adaptive, times

LIVELY = ROOT / "tests/effects/scene.xml"


def interrupted(program, deck, settings, without, after, ranks):
    """A run stopped by a signal some time after its first checkpoint and continued on other ranks;
    None if it ended before the signal."""
    folder = program.work / "c26"
    subprocess.run(["rm", "-rf", str(folder)], check=True)
    options = program.overrides({**QUIET, **settings}, without)
    process = subprocess.Popen(
        program.command("run", deck, "--output", folder, *options, ranks=ranks[0]),
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=program.work)
    while process.poll() is None and not (folder / "checkpoint.bin").exists():
        time.sleep(0.001)
    time.sleep(after)
    target = process.pid
    if ranks[0] > 1:  # a signal to a rank: mpiexec takes seconds to forward it
        children = subprocess.run(["pgrep", "-P", str(process.pid)], stdout=subprocess.PIPE,
                                  text=True, check=False).stdout.split()
        target = int(children[0]) if children else target
    with contextlib.suppress(ProcessLookupError):
        os.kill(target, signal.SIGTERM)
    if process.wait() == 0:
        return None
    done = subprocess.run(
        program.command("run", deck, "--restart", folder, *options, ranks=ranks[1]),
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, cwd=program.work)
    return Run(folder, done.returncode, done.stdout, 0.0)


def farthest(run, whole):
    """Largest difference of the samples divided by their largest value."""
    worst = 0.0
    own, other = (one.folder / "results.h5" for one in (run, whole))
    with h5py.File(own, "r") as a, h5py.File(other, "r") as b:
        for name in ("transient/time", "transient/displacement", "transient/velocity"):
            x, y = a[name][()], b[name][()]
            if x.shape != y.shape:
                return math.inf
            worst = max(worst, float(np.abs(x - y).max() / np.abs(y).max()))
    return worst


@case(26, "Restart anywhere, with other ranks", "interrupted 0 to 1 s after the first checkpoint; "
      "five integrators; 1, 2 ranks; lying string, full and reduced",
      "bitwise with the same ranks, 1e-10 with others (of "
      "a divided motion in contact, the tolerance of its steps)", "the run that is not interrupted")
def restart(program, short):
    settings = {
        "generalized-alpha 1 ms": {
            **alpha(1e-3), **times(40.0, 0.01), "Transient/Checkpoint Interval": 1.0
        }
    }
    if not short:
        settings.update({
            "Step Tolerance 1e-6": {
                **alpha(4e-3, Step_Tolerance=1e-6),
                **times(40.0, 0.02), "Transient/Checkpoint Interval": 1.0
            },
            "RK4": {**rk4(1e-4), **times(4.0, 0.01), "Transient/Checkpoint Interval": 0.1},
            "RK4 adaptive": {
                **rk4_adaptive(1e-2), **times(1.0, 0.01), "Transient/Checkpoint Interval": 0.05
            },
            "ARKODE 1e-4": {
                **arkode(1e-4), **times(2.0, 0.01), "Transient/Checkpoint Interval": 0.2
            },
        })
    for label, way in settings.items():
        for model, more, without in models(way):
            if (model == "reduced" and label != "generalized-alpha 1 ms"
                    or short and model == "full"):
                continue
            whole = program.run("c26_whole", LYING, more, without)
            cases = [(0.0, (1, 1))] if short else [(0.0, (1, 1)), (0.2, (1, 1)), (0.1, (1, 2)),
                                                   (0.1, (2, 1))]
            for after, ranks in cases if label.startswith("generalized") else cases[:2]:
                run = interrupted(program, LYING, more, without, after, ranks)
                if run is None:
                    continue  # the run was over before its signal
                bound = 0.0 if ranks[0] == ranks[1] else 1e-10
                yield judged(
                    run, f"{label}, {model}",
                    f"stopped {after:g} s after a checkpoint, ranks {ranks[0]} then {ranks[1]}",
                    lambda: ("0", "largest difference", farthest(run, whole)), bound,
                    required="ARKODE" not in label)


# Scenes of `tolerances`; those with whirl also run with shorter steps, and with fewer tolerances.
CALM = "helical_170m", "build_hold_1400m", "frame"
WHIRLING = "stress_170m", "inclined_1000m", "vertical_1000m"


def tolerances(program, short):
    """20 s of shipped scenes for several tolerances of Newton's method: its remaining error must
    not generate energy. In whirling strings steps of 1 ms generate 0.1 to 1 % of energy at any
    tolerance; steps of 0.25 ms, with 0.07 % at most, show the effect of the tolerance alone."""
    end = 1.0 if short else 20.0

    def motion(scene, tolerance, changes):
        run = program.run("c28_tolerance", ROOT / f"xml/{scene}.xml", {
            "Transient/Generalized-alpha/Tolerance": float(tolerance), **changes, **times(
                end, 0.05)
        })

        def made():
            residual = run.motion["energy_residual"]
            return "no energy made", f"energy residual {residual:.2g}", max(0.0, -residual)

        label = ", ".join([scene, *changes.values()])
        return judged(run, label, f"{end:g} s, tolerance {tolerance:.0e}", made, 1e-3)

    if short:
        yield motion("helical_170m", 1e-3, {})
        return
    for scene in CALM:
        for tolerance in np.logspace(-1, -12, 12):
            yield motion(scene, tolerance, {})
    for scene in WHIRLING:
        for step in ("0.25 ms", "1 ms"):
            for tolerance in np.logspace(-2, -12, 6):
                yield motion(scene, tolerance, {"Transient/Step": step})


@case(28, "600 s", "a turning string at rest (damped by 0.5 1/s; with 0.1 1/s friction makes it "
      "unstable): generalized-alpha steps of 1 and 5 ms, spectral radius 0 to 1; 60 s of RK4; a "
      "shaken string; 20 s of six scenes for tolerances of Newton's method of 1e-1 to 1e-12",
      "no drift of energy or position at rest; statistics of the shaken string do not "
      "change from third to third; no tolerance makes energy", "10 s")
def long_runs(program, short):
    yield from tolerances(program, short)
    end = 20.0 if short else 600.0
    ways = [("generalized-alpha 5 ms, radius 0.8", alpha(5e-3), end, "both")]
    if not short:
        ways += [
            ("generalized-alpha 5 ms, radius 1", alpha(5e-3, 1.0), end, "full"),
            ("generalized-alpha 5 ms, radius 0", alpha(5e-3, 0.0), end, "full"),
            ("generalized-alpha 1 ms, radius 0.8", alpha(1e-3), 100.0, "full"),
            ("RK4, 0.1 ms", rk4(1e-4), 10.0, "full"),
        ]
    for label, way, last, which in ways:
        for model, more, without in models(
            {**way,
             **times(last, 0.5), "Damping/Mass Coefficient": 0.5})[:1 if which == "full" else 2]:
            run = program.run("c28", LYING, more, without)

            def drift():
                at = run.data("transient/displacement")
                return 0.0, float(np.abs(at - at[0]).max()), float(np.abs(at - at[0]).max())

            # without numerical damping friction amplifies the fastest vibration of the contact
            yield judged(run, f"at rest, {label}, {model}", f"{last:g} s: change of place [m, rad]",
                         drift, 1e-6, required="radius 1" not in label)
            if run.done:
                residual = run.motion["energy_residual"]
                yield statement(f"at rest, {label}, {model}", f"{last:g} s: energy residual", "0",
                                f"{residual:.2g}",
                                abs(residual) < 1e-3)
    # With 25 kg m the string rubs irregularly in spite of this damping. With 2 kg m its motion
    # becomes periodic, and its three thirds agree for any dissipation of the scheme. An irregular
    # motion scatters at random: quantiles of thirds of 18 s by up to 0.1 of the range, of 180 s by
    # up to 0.05; the bounds are at least twice that.
    shaken, end = {"Loads/Unbalance/collar/Moment": 25.0,
                   "Damping/Mass Coefficient": 0.5}, 60.0 if short else 600.0
    for model, more, without in models({**shaken, **alpha(1e-3),
                                        **times(end, 0.02)})[:1 if short else 2]:
        run = program.run("c28_shaken", LIVELY, more, without)

        def stationary():
            speeds, clock = bit_speed(run, 0.0), run.time()
            edges = np.linspace(0.1 * end, end, 4)
            thirds = [
                np.percentile(speeds[(clock >= a) & (clock <= b)], (5, 25, 50, 75, 95))
                for a, b in zip(edges, edges[1:])
            ]
            return "the same", "largest change of a quantile over the range", float(
                np.ptp(thirds, axis=0).max() / (thirds[0][4] - thirds[0][0]))

        yield judged(run, f"shaken, {model}",
                     f"{end:g} s: quantiles of the bit speed in three thirds", stationary,
                     0.3 if short else 0.1, required=True)
        if run.done:
            residual = run.motion["energy_residual"]
            yield judged(run, f"shaken, {model}", f"{end:g} s: energy residual", lambda:
                         ("below 5 %", f"{residual:.2g}", abs(residual)), 0.05, required=True)
