# SPDX-License-Identifier: BSD-3-Clause
"""Two inertias on a torsion spring, a drive and a bit: stick-slip, its onset, the limit of the
torque."""
import math

import numpy as np
from scipy.integrate import solve_ivp

import models
from checks import expect
from agreement import near
from scenes import parts_deck

# Two inertias on a torsion spring: the drive J1 and the bit J2 (numbers of the size of
# Navarro-Lopez and Cortes 2007).
J1, J2, STIFFNESS, DAMPING = 2122.0, 374.0, 473.0, 23.2
BIT = models.Friction(static=7467.6, dynamic=4667.25, decay=1 / 0.9, viscous=50.0, width=1e-2)


def two_inertias(program, name, drive, start=(0.0, 0.0), settings=None, bit=BIT):
    """A run of the two inertias as a part; `drive`: parameters of Speed Control, `start`: speeds of
    both."""
    k, c = np.array([[1, -1], [-1, 1]]) * STIFFNESS, np.array([[1, -1], [-1, 1]]) * DAMPING
    part = program.part(name, ["theta_z"], np.diag([J1, J2]), k, c)
    laws = {
        "drive": {
            "Type": "Speed Control", "First": "string:1", "Component": "theta_z",
            "Speed Control": drive
        },
        "bit": {
            "Type": "Stribeck", "First": "string:2", "Component": "theta_z", "Stribeck": {
                "Static Force": bit.static, "Dynamic Force": bit.dynamic,
                "Decay Velocity": bit.decay, "Viscous Damping": bit.viscous,
                "Slip Velocity": bit.width
            }
        },
    }
    starts = {
        f"start {n + 1}":
        {"Part": "string", "Node": n + 1, "Component": "theta_z", "Displacement": a, "Velocity": v}
        for n, (a,
                v) in enumerate(start if isinstance(start[0], tuple) else [(0.0, v) for v in start])
    }
    deck = parts_deck(program, name, {"string": part}, {"Transient/Progress": False},
                      Parts={"Starts": starts}, Coupling={"Point Laws": laws})
    return program.run(name, deck, settings)


def exact(drive, times, start, bit=BIT):
    """The same motion by scipy: angles and speeds of both."""
    V, kp, ki = (drive.get(name, 0.0) for name in ("Speed", "Proportional Gain", "Integral Gain"))
    limit = drive.get("Force Limit", math.inf)
    a0 = start[0]

    def rates(t, y):
        behind = V * t - (y[0] - a0) + y[4]
        wanted = drive.get("Initial Force", 0.0) + kp * (V - y[2]) + ki * behind
        force = min(max(wanted, -limit), limit)
        pipe = STIFFNESS * (y[0] - y[1]) + DAMPING * (y[2] - y[3])
        excess = (force - wanted) / kp if ki else 0.0
        return [y[2], y[3], (force - pipe) / J1, (pipe - bit.torque(y[3])) / J2, excess]

    return solve_ivp(rates, (0.0, times[-1]), [*start, 0.0], method="Radau", rtol=1e-10, atol=1e-11,
                     t_eval=times, max_step=0.05).y


def stick_slip(program):
    """Speed-controlled drive, stick-slip from rest: the motion, its peak, period and share stuck
    against scipy."""
    drive = {"Speed": 4.0, "Proportional Gain": 3000.0, "Integral Gain": 2000.0}
    end, sampling = 30.0, 0.005
    times = np.arange(0, end + 1e-9, sampling)
    truth = exact(drive, times, [0.0] * 4)
    peak, stuck, period = models.cycles(times, truth[3], BIT.width)
    expect("the bit sticks and slips", 0.1 < stuck < 0.9,
           f"stuck {stuck:.3f}, peak {peak:.3f} rad/s, period {period:.3f} s")
    common = {"Transient/End Time": end, "Transient/Sampling Interval": sampling}
    for name, own, bound in (
        ("RK4", {"Transient/Integrator": "RK4", "Transient/Step": 5e-4}, 2e-5),
        ("generalized-alpha", {"Transient/Integrator": "Generalized-alpha",
                               "Transient/Step": 1e-3}, 2e-3),
    ):
        run = two_inertias(program, f"stick_slip_{name}", drive, settings={**common, **own})
        speed = run.nodes(0, "velocity")
        error = np.abs(speed - truth[2:4].T).max() / peak
        near(f"{name}: largest error of the speeds over the peak", error, 0.0, bound)
        found = models.cycles(run.time(), speed[:, 1], BIT.width)
        for what, a, b, tolerance in zip(("peak", "share stuck", "period"), found,
                                         (peak, stuck, period), (bound * peak, 2e-3, 1e-3)):
            near(f"{name}: {what} against {b:.5g}", a, b, tolerance)
        near(f"{name}: the ledger closes", run.motion["energy_residual"], 0.0, 2e-3)


def onset(program):
    """Both sides of the speed at which steady drilling loses stability: growth of a small
    disturbance against the eigenvalue."""
    drive = {"Proportional Gain": 3000.0, "Integral Gain": 2000.0}

    def rightmost(omega):
        A = np.zeros((4, 4))
        A[0, 2] = A[1, 3] = 1
        A[2] = np.array([-STIFFNESS - 2000.0, STIFFNESS, -DAMPING - 3000.0, DAMPING]) / J1
        A[3] = np.array([STIFFNESS, -STIFFNESS, DAMPING, -DAMPING - BIT.slope(omega)]) / J2
        values = np.linalg.eigvals(A)
        return values[np.argmax(values.real)]

    low, high = 1.0, 12.0
    while high - low > 1e-6:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if rightmost(middle).real > 0 else (low, middle)
    for factor in (0.95, 1.05):
        omega = factor * low
        torque = float(BIT.torque(omega))
        twist = torque / STIFFNESS
        own = {**drive, "Speed": omega, "Initial Force": torque}
        run = two_inertias(
            program, f"onset_{factor}", own, ((0.0, omega), (-twist, omega + 1e-5)), {
                "Transient/End Time": 40.0, "Transient/Sampling Interval": 0.01,
                "Transient/Integrator": "RK4", "Transient/Step": 2e-3
            })
        s = rightmost(omega)
        t, w = run.time(), run.nodes(0, "velocity")[:, 1] - omega
        late = t > 10
        columns = np.column_stack([
            np.exp(s.real * t[late]) * np.cos(s.imag * t[late]),
            np.exp(s.real * t[late]) * np.sin(s.imag * t[late])
        ])
        fit, *_ = np.linalg.lstsq(columns, w[late], rcond=None)
        rest = w[late] - columns @ fit
        near(f"{omega:.3f} rad/s: the disturbance is the mode of s = {s.real:+.4f} {s.imag:+.3f}i",
             np.linalg.norm(rest) / np.linalg.norm(w[late]), 0.0, 1e-3)
    expect("growth below the critical speed, decay above",
           rightmost(0.95 * low).real > 0 > rightmost(1.05 * low).real, f"critical {low:.4f} rad/s")


def torque_limit(program):
    """The torque limit of a drive, and its integral, which stops at the limit: against scipy."""
    drive = {
        "Speed": 4.0, "Proportional Gain": 3000.0, "Integral Gain": 2000.0, "Force Limit": 7600.0
    }
    times = np.arange(0, 10.0 + 1e-9, 0.01)
    truth = exact(drive, times, [0.0] * 4)
    run = two_inertias(
        program, "torque_limit", drive, settings={
            "Transient/End Time": 10.0, "Transient/Sampling Interval": 0.01,
            "Transient/Integrator": "RK4", "Transient/Step": 5e-4
        })
    near("largest error of the speeds",
         np.abs(run.nodes(0, "velocity") - truth[2:4].T).max(), 0.0, 2e-3)
    free = exact({**drive, "Force Limit": math.inf}, times, [0.0] * 4)
    expect("the limit was reached", np.abs(free[2] - truth[2]).max() > 0.5, "")
