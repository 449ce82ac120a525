# SPDX-License-Identifier: BSD-3-Clause
"""Every law of the bit and every control of the drive with every integrator, in the full and the
reduced model. Each combination is one motion with a closed ledger, figures of merit, and a run
restarted from its checkpoint with the same numbers."""
import resource
import subprocess

import h5py
import models
import numpy as np
from checks import expect
from program import FULL
from same_numbers import differences

W, THETA_Z = 2, 5
PIECES = ((models.PIPE, 3), (models.COLLAR, 2))
CUTTING = {
    "Law": "Cutting",
    "Cutting": {
        "Blades": 4, "Radius": 0.108, "Specific Energy": 1e7, "Wear Flat": 1e-3,
        "Contact Stress": 1e7
    },
}
SPEED = {
    "Control": "Speed", "Inertia": 1500.0, "Proportional Gain": 2000.0, "Integral Gain": 1000.0
}
BLOCK = {"Block Speed": 5e-3}
DRILLER = {
    "Autodriller": {"Weight On Bit": 150e3, "Proportional Gain": 1e-7, "Integral Gain": 1e-7}
}
# name: law of the bit, drive, weight on bit of Loads [N]; the limits of torque are reached
SCENES = {
    "friction, PI drive at its limit": (
        {
            "Law": "Stribeck",
            "Stribeck": {"Radius": 0.108, "Sticking Speed": 0.1},
        },
        {**SPEED, "Torque Limit": 3400.0},
        60e3,
    ),
    "smooth curve, torque": ({"Law": "Tanh"}, {"Control": "Torque", "Inertia": 1500.0}, 150e3),
    "cutting, matched drive": (CUTTING, {
        "Control": "Impedance Matched", "Inertia": 1500.0, "Tuning Frequency": 0.25, **BLOCK
    }, None),
    "cutting, stiff drive, free hook": (CUTTING, {"Hook": "Constant Load", **BLOCK}, None),
    "penetration, high-pass drive": (
        {"Law": "Tucker-Wang"},
        {"Control": "Impedance Matched", "Inertia": 1500.0, "High-Pass Frequency": 0.2, **BLOCK},
        None,
    ),
    "penetration, autodriller and PI drive": ({"Law": "Tucker-Wang"}, {**SPEED, **DRILLER}, None),
}
# settings, and bounds of the differences from RK4 in the angle and the advance of the bit, relative
# to the change of the motion. Steps of order h^2 have an error of a thousandth of the wave that
# returns from the bit; tolerances of a step add up over hundreds of steps. RK4 adaptive and ARKODE
# have their usual tolerances. A steep law turns small errors of velocities into forces: their
# errors may be ten times that of the advance.
REFERENCE = ("RK4", {"Transient/Integrator": "RK4", "Transient/Step": 1e-4})
HALF = "generalized-alpha, half the step"
INTEGRATORS = (
    ("RK4 adaptive", {"Transient/Integrator": "RK4 adaptive"}, 1e-6, 1e-5),
    ("generalized-alpha", {"Transient/Integrator": "Generalized-alpha",
                           "Transient/Step": 1e-3}, 2e-5, 3e-3),
    (HALF, {"Transient/Integrator": "Generalized-alpha", "Transient/Step": 5e-4}, 5e-6, 8e-4),
    ("generalized-alpha, step by its error", {
        "Transient/Integrator": "Generalized-alpha", "Transient/Step": 5e-3,
        "Transient/Generalized-alpha/Step Tolerance": 1e-7
    }, 3e-4, 6e-2),
    ("ARKODE", {"Transient/Integrator": "SUNDIALS ARKODE"}, 3e-5, 1e-3),
    ("CVODE", {
        "Transient/Integrator": "SUNDIALS CVODE",
        "Transient/SUNDIALS CVODE/Relative Tolerance": 1e-6
    }, 3e-4, 1e-3),
)
OF_EVERY_BIT = ("bit_speed_rpm", "stick_slip_index", "stuck_share", "weight_on_bit",
                "torque_on_bit", "axial_acceleration", "lateral_acceleration", "whirl", "bending")


def deck(program, name, bit, drive, weight):
    loads = {"Gravity": 9.81} if weight is None else {"Gravity": 9.81, "Weight On Bit": weight}
    rotary = {
        "Law": "Exponential",
        "Exponential": {"Initial Speed": 12.0, "Final Speed": 14.0, "Time Constant": 0.3},
    }
    return program.deck(
        name,
        models.string_deck(
            PIECES,
            **{
                "Loads": loads,
                "Rotary Speed": rotary,
                "Damping": {"Mass Coefficient": 0.5},
                "Bit": bit,
                "Top Drive": drive,
                "Substructures": {"Rule": "By component"},
                "Reduction": {"Mode Selection": {"Modes": 6}},
                "Output": {"Compression": 0},  # gives a known file position of a chunk
                "Transient": {
                    "Progress": False, "End Time": 1.0, "Sampling Interval": 0.002,
                    "Checkpoint Interval": 0.1
                },
            }))


def goes_on(program, name, path, whole, settings, without):
    """The run on a disk that is full when the second chunk of a field is written, after nine tenths
    of the motion, and then continued with free space."""
    folder = program.work / f"{name}_halted"
    size = int(0.85 * (whole.folder / "results.h5").stat().st_size)
    own = program.overrides({"Output/XDMF": "false", "Output/CSV": "false", **settings}, without)
    calls = [
        subprocess.run(program.command("run", path, how, folder, *own), stdout=subprocess.PIPE,
                       stderr=subprocess.STDOUT, text=True, check=False, preexec_fn=limit)
        for how, limit in (
            ("--output", lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))),
            ("--restart", None),
        )
    ]
    if [call.returncode for call in calls] != [5, 0]:
        return [f"exit codes {[call.returncode for call in calls]}: {calls[-1].stdout[-200:]}"]
    return differences(whole.folder, folder)


def moved(run):
    return [run.nodes(component)[:, -1] - run.nodes(component)[0, -1] for component in (THETA_Z, W)]


def forces(run, gives_weight):
    with h5py.File(run.folder / "results.h5") as file:
        return [
            file[f"transient/{name}"][:]
            for name in ("torque_on_bit", *(["weight_on_bit"] if gives_weight else []))
        ]


def figures_of(run, gives_weight):
    """Names of figures of merit that are missing or implausible."""
    found = run.motion["figures"]
    missing = [name for name in OF_EVERY_BIT if found.get(name) is None]
    missing += [
        name for name in ("specific_energy", "rate_of_penetration")
        if (found.get(name) is not None) != gives_weight
    ]
    if abs(found["begin"] - 0.5) > 1e-9 or abs(found["end"] - 1.0) > 1e-9:
        missing.append(f"window {found['begin']} to {found['end']}")
    return missing


def combinations(program, sundials=True):
    integrators = [
        one for one in INTEGRATORS if sundials or "SUNDIALS" not in one[1]["Transient/Integrator"]
    ]
    for place, (title, (bit, drive, weight)) in enumerate(SCENES.items()):
        path = deck(program, f"combination_{place}", bit, drive, weight)
        for model, without in (("full", FULL), ("reduced", ())):
            true, errors = None, {}
            for number, (integrator, settings, *bounds) in enumerate((REFERENCE, *integrators)):
                name, what = (f"combination_{place}_{model}_{number}",
                              f"{title}, {model}, {integrator}")
                run = program.run(name, path, settings, without)
                if not run.done:
                    expect(what, False, f"{run.code} {run.sentence()}")
                    continue
                expect(f"{what}: the ledger closes",
                       abs(run.motion["energy_residual"]) < 1e-4,
                       str(run.motion["energy_residual"]))
                wrong = figures_of(run, weight is None)
                expect(f"{what}: figures of merit", not wrong, str(wrong))
                if integrator != HALF:  # the same scheme continues with the other step
                    wrong = goes_on(program, name, path, run, settings, without)
                    expect(f"{what}: goes on from its checkpoint to the same numbers", not wrong,
                           "; ".join(wrong[:4]))
                if true is None:
                    true, true_forces = moved(run), forces(run, weight is None)
                    continue
                worst = max(
                    np.abs(a - b).max() / np.ptp(b)
                    for a, b in zip(forces(run, weight is None), true_forces))
                expect(
                    f"{what}: error of the forces of the bit over their change {worst:.1e} within "
                    f"{10 * bounds[1]:.0e}", worst <= 10 * bounds[1])
                errors[integrator] = found = [
                    np.abs(a - b).max() / max(np.ptp(b), 1e-6) for a, b in zip(moved(run), true)
                ]
                expect(
                    f"{what}: errors of angle and advance {found[0]:.1e}, {found[1]:.1e} within "
                    f"{bounds[0]:.0e}, {bounds[1]:.0e}",
                    all(error <= bound for error, bound in zip(found, bounds)))
            whole, half = (errors.get(name, [np.nan])[0] for name in ("generalized-alpha", HALF))
            expect(f"{title}, {model}: half the step has a quarter of the error",
                   0.2 < half / whole < 0.3, f"{whole:.2e} and {half:.2e}")
