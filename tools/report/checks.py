# SPDX-License-Identifier: BSD-3-Clause
"""Checks of a run, from its summary.json."""

ENERGY = 1e-2  # allowed numerical gain or loss, as a share of the energy supplied
# name, key of the value in a summary, bound
CHECKS = (
    ("balance of torque",
     lambda s: abs(s["static"]["torque_balance_defect"]) / s["static"]["torque_scale"], 1e-2),
    ("residual of the static state", lambda s: s["static"]["residual"], 1e-8),
    ("balance of energy", lambda s: abs(s["transient"]["energy_residual"]), ENERGY),
    ("step error", lambda s: s["transient"]["step_error"], 5e-2),
    ("share of steps that did not converge",
     lambda s: s["transient"]["unconverged_steps"] / s["transient"]["steps"], 1e-3),
)


def measured(summary):
    """(name, value, bound) of the checks of this run; stages that did not run have none."""
    found = []
    for name, measure, bound in CHECKS:
        try:
            found.append((name, float(measure(summary)), bound))
        except (TypeError, KeyError, ZeroDivisionError):
            continue
    return found


def worst(summary):
    """The check closest to its bound, or None."""
    return max(measured(summary), key=lambda check: check[1] / check[2], default=None)
