# SPDX-License-Identifier: BSD-3-Clause
"""Rotors that become unstable at higher speeds: with vibration, because of damping of the shaft;
without vibration, because of a stiffness that decreases with the speed."""
import json
import pathlib

import numpy as np
from scenes import GYROSCOPIC, RPM, close, deck, expect, lists, part, run, values

SWEEP = values(Highest_Speed=200.0, Points=5)


def summary(folder):
    return json.loads(pathlib.Path(folder, "summary.json").read_text(encoding="utf-8"))


def warned(folder, words):
    return any(words in " ".join(warning.split()) for warning in summary(folder)["warnings"])


def response(sweep):
    return lists(
        "Response", sweep + lists("Unbalance", lists("disc", values(Node=1, Moment=1e-3))) +
        lists("Outputs", lists("x", values(Node=1, Component="u"))))


def shaft_damping():
    """Internal damping c_i of the shaft and external damping c_e: m r'' + (c_i + c_e) r' + (k - i
    c_i Omega) r = 0 grows above omega_0 (1 + c_e/c_i)."""
    m, k, inner, outer = 2.0, 5e3, 4.0, 6.0
    part("inner.h5", ["u", "v"], m * np.eye(2), k * np.eye(2), (inner + outer) * np.eye(2), None,
         (("Omega", inner * np.array([[0, 1], [-1, 0]])),))
    limit = np.sqrt(k / m) * (1 + outer / inner)
    for points in (3, 7, 40):
        scene = deck(
            "inner", "inner.h5",
            lists("Campbell", values(Highest_Speed=200.0, Points=points, Modes=2)) +
            response(SWEEP), GYROSCOPIC)
        run("campbell", scene, "inner")
        found = summary("inner")["campbell"]["stability_limits"]
        expect(f"shaft damping, {points} speeds: one limit, where growth begins",
               len(found) == 1 and found[0]["begins"], found)
        close(f"shaft damping, {points} speeds: the limit", found[0]["speed_rpm"] * RPM, limit,
              1e-8)
        expect(f"shaft damping, {points} speeds: it is warned of",
               warned("inner", f"unstable from {limit / RPM:.2f} rpm on"))
    run("response", scene, "inner_response")
    expect("shaft damping: the response of speeds beyond is warned of",
           warned("inner_response", "the state is unstable: a vibration of"))


def divergence():
    """k - Omega^2 m < 0 above 100 rad/s: s = -c/2m + sqrt((c/2m)^2 + Omega^2 - k/m)."""
    m, k, c = 1.0, 1e4, 2.0
    part("away.h5", ["u", "v"], m * np.eye(2), np.diag([k, 1.5 * k]), c * np.eye(2), None,
         (("square", -m * np.diag([1.0, 0.0])),))
    laws = GYROSCOPIC + lists(
        "square",
        values(Form="Speed Power") + lists("Speed Power", values(Exponent=2.0)))
    scene = deck("away", "away.h5",
                 lists("Campbell", SWEEP + values(Modes=2)) + response(SWEEP), laws)
    run("campbell", scene, "away")
    exact = -c / 2 / m + np.sqrt((c / 2 / m)**2 + 200.0**2 - k / m)
    close("divergence: the fastest growth",
          summary("away")["campbell"]["fastest_divergence"], exact, 1e-9)
    expect("divergence: its first speed is told",
           warned("away", f"at 2 of the speeds, at {150 / RPM:.2f} rpm first"))
    run("response", scene, "away_response")
    expect("divergence: the response is warned of",
           warned("away_response", "it is left without vibration as exp("))


def growth():
    shaft_damping()
    divergence()
