#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks `tooljoint campbell` and `tooljoint response`: rotors against closed forms and a published
rotor, a string scene reduced against full, the limit at rest, windows of frequencies, bending
moments, refusals, ranks.

    check_response.py PROGRAM MPIEXEC SOURCES rotors|string
"""
import pathlib
import re
import subprocess
import sys

import numpy as np
from scipy.linalg import eig

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from along import bending, excitations, window  # noqa: E402
from growth import growth  # noqa: E402
from rotors import anisotropic, damped, friswell, nelson, reduction  # noqa: E402
import states  # noqa: E402
from scenes import (GYROSCOPIC, RPM, SHAFT, SHORTER, SOURCES, close, deck, estimates, expect, lists,
                    material, modes_at, part, run, table, tooljoint, values)  # noqa: E402
from checks import finish  # noqa: E402
from refusals import STRING, refusals  # noqa: E402


def laval():
    """A disc at the middle of a massless shaft, damped: amplitude and phase of the unbalance at all
    speeds, critical speed."""
    m, k, c, moment = 12.0, 3e6, 900.0, 4e-3
    omega0, ratio = np.sqrt(k / m), c / (2 * np.sqrt(k * m))
    part("laval.h5", ["u", "v"], m * np.eye(2), k * np.eye(2), c * np.eye(2))
    scene = deck(
        "laval", "laval.h5",
        lists(
            "Campbell",
            values(Highest_Speed=1000.0, Points=11) +
            '<Parameter name="Orders" type="Array(double)" value="{1}"/>') + lists(
                "Response",
                values(Highest_Speed=1000.0, Points=101) +
                lists("Unbalance", lists("disc", values(Node=1, Moment=moment, Phase=0.3))) + lists(
                    "Outputs",
                    lists("x", values(Node=1, Component="u")) +
                    lists("y", values(Node=1, Component="v")))))
    done = run("response", scene, "laval_response")
    expect("laval: it is said that nothing follows the speed", 'law "Omega"'
           in done.stdout + done.stderr)
    expect("laval: speeds are printed in rpm, a plain number is rad/s",
           "amplitudes from 0 to 9549.3 rpm" in done.stdout, done.stdout)
    rows = table("laval_response", "response")
    w = rows["speed"]
    exact = moment * w**2 * np.exp(0.3j) / (k - m * w**2 + 1j * w * c)
    close("laval: motion along x at all speeds", rows["x_amplitude"] * np.exp(1j * rows["x_phase"]),
          exact, 1e-12)
    close("laval: motion along y, a quarter turn behind",
          rows["y_amplitude"] * np.exp(1j * rows["y_phase"]), -1j * exact, 1e-12)
    # d|x|/dw = 0 of w^2/sqrt((w0^2-w^2)^2+(2 z w0 w)^2): w = w0/sqrt(1-2 z^2)
    close("laval: speed of the largest amplitude",
          table("laval_response", "peaks")["speed"], omega0 / np.sqrt(1 - 2 * ratio**2), 1e-6)
    # below a motor the disc turns at w + 300 rad/s
    run("response", scene, "laval_motor", "Response/Motor Speed=300")
    rows = table("laval_motor", "response")
    v = rows["speed"] + 300
    close("laval: below a motor", rows["x_amplitude"] * np.exp(1j * rows["x_phase"]),
          moment * v**2 * np.exp(0.3j) / (k - m * v**2 + 1j * v * c), 1e-12)
    close("laval: below a motor, frequency", 2 * np.pi * rows["frequency"], v, 1e-12)
    close("laval: below a motor, speed of the largest amplitude",
          table("laval_motor", "peaks")["speed"], omega0 / np.sqrt(1 - 2 * ratio**2) - 300, 1e-6)
    run("campbell", scene, "laval_campbell")
    crossings = table("laval_campbell", "crossings")
    close("laval: critical speed", crossings["speed"], omega0 * np.sqrt(1 - ratio**2), 1e-9)
    close("laval: damping ratio", crossings["damping"], ratio, 1e-9)
    expect("laval: two planes of the same value do not whirl", np.all(crossings["whirl"] == 0.0))


def neighbours():
    """A wide and a narrow resonance between the points of the sweep, whose flanks meet: both are
    found once, for any choice of points."""
    K = np.array([[2.0e5, -1.2e4], [-1.2e4, 2.05e5]])
    squares, shapes = np.linalg.eigh(K)
    rates = 2 * np.pi * np.array([2.2, 0.1])  # half widths [rad/s] of 69 and 73.6 Hz
    w = 2 * np.pi * np.linspace(20, 120, 400001)
    size = np.abs(sum(shapes[0, k]**2 / (squares[k] - w**2 + 2j * rates[k] * w) for k in range(2)))
    exact = size[1:-1][(size[1:-1] > size[:-2]) & (size[1:-1] >= size[2:])]
    part("neighbours.h5", ["u", "v"], np.eye(2), K, shapes @ np.diag(2 * rates) @ shapes.T)
    for points in range(6, 40, 6):
        scene = deck(
            "neighbours", "neighbours.h5",
            lists(
                "Response",
                values(Excitation="Harmonic", Highest_Frequency=120.0, Lowest_Frequency=20.0,
                       Points=points) +
                lists("Loads", lists("push", values(Node=1, Component="u"))) +
                lists("Outputs", lists("x", values(Node=1, Component="u")))))
        run("response", scene, "neighbours")
        peaks = table("neighbours", "peaks")["amplitude"]
        expect(f"neighbours: largest amplitudes of {points} points",
               len(peaks) == 2 and np.allclose(peaks, exact, rtol=1e-5), f"{peaks} {exact}")


def overhung():
    """A disc at the end of a massless cantilever: the gyroscopic moment splits its modes, forward
    and backward."""
    m, diametral, polar, length, bending = 8.0, 0.05, 0.1, 0.4, 5e4
    k = bending / length**3 * np.array([[12, -6 * length], [-6 * length, 4 * length**2]])
    flip = np.diag([1.0, -1.0])
    K, M, G = np.zeros((6, 6)), np.diag([m, m, m, diametral, diametral, polar]), np.zeros((6, 6))
    K[np.ix_([0, 4], [0, 4])] = k
    K[np.ix_([1, 3], [1, 3])] = flip @ k @ flip
    K[2, 2], K[5, 5] = 1e9, 1e7
    G[3, 4], G[4, 3] = polar, -polar
    part("overhung.h5", ["u", "v", "w", "theta_x", "theta_y", "theta_z"], M, K, None, G)
    scene = deck("overhung", "overhung.h5",
                 lists("Campbell", values(Highest_Speed=600.0, Points=13, Modes=4)), GYROSCOPIC)
    run("campbell", scene, "overhung")
    rows = table("overhung", "campbell")
    # r = u + i v, q = theta_y - i theta_x, exp(i w t): K - w^2 M + w Omega diag(0, I_p); w < 0 is
    # backward
    for speed in (0.0, 300.0, 600.0):
        companion = np.block([
            [np.zeros((2, 2)), np.eye(2)],
            [np.linalg.solve(np.diag([m, diametral]), k),
             np.diag([0, polar * speed / diametral])],
        ])
        w = np.linalg.eigvals(companion).real
        w = w[np.argsort(np.abs(w))]
        here = modes_at(rows, speed)
        order = np.argsort(here["frequency"])
        close(f"overhung at {speed} rad/s: frequencies", 2 * np.pi * here["frequency"][order],
              np.abs(w), 1e-9)
        if speed > 0:
            expect(f"overhung at {speed} rad/s: forward and backward",
                   np.array_equal(np.round(here["whirl"][order], 6), np.sign(w)),
                   here["whirl"][order])
    close("overhung: modes are followed through the splitting", rows["mac"], 1.0, 0.11)
    start, end = modes_at(rows, 50.0), modes_at(rows, 600.0)
    whirls = {mode: whirl for mode, whirl in zip(start["mode"], np.sign(start["whirl"]))}
    expect("overhung: a track keeps its sense of whirl",
           whirls == {mode: whirl for mode, whirl in zip(end["mode"], np.sign(end["whirl"]))})
    crossings = table("overhung", "crossings")
    # w = o Omega: det(k - w^2 (M -+ diag(0, I_p)/o)) = 0
    for at in range(len(crossings["speed"])):
        order, sense = crossings["order"][at], np.sign(crossings["whirl"][at])
        inertia = np.diag([m, diametral - sense * polar / order])
        critical = np.sqrt(np.array([v.real
                                     for v in eig(k, inertia, right=False) if v.real > 0])) / order
        expect(f"overhung: critical speed {crossings['speed'][at]:.3f} rad/s of order {order:g}",
               np.min(np.abs(critical / crossings["speed"][at] - 1)) < 1e-8, critical)
    expect("overhung: forward and backward critical speeds of the first mode with 1x",
           np.sum(crossings["order"] == 1) >= 2)


def bearing():
    """A rotor in a bearing of stiffness k_0 + k_1 Omega (Speed Table) + k_2 Omega^2 (Speed Power):
    critical speed of a quadratic equation."""
    m, k0, k1, k2 = 20.0, 2e6, 3e3, 4.0
    part("bearing.h5", ["u", "v"], m * np.eye(2), k0 * np.eye(2), None, None,
         (("table", k1 * np.eye(2)), ("square", k2 * np.eye(2))))
    laws = (GYROSCOPIC + lists(
        "table",
        values(Form="Speed Table") + lists(
            "Speed Table", '<Parameter name="Speeds" type="Array(double)" value="{0, 1000}"/>'
            '<Parameter name="Values" type="Array(double)" value="{0, 1000}"/>')) +
            lists("square",
                  values(Form="Speed Power") + lists("Speed Power", values(Exponent=2.0))))
    campbell = lists(
        "Campbell",
        values(Highest_Speed=900.0, Points=7, Modes=2) +
        '<Parameter name="Orders" type="Array(double)" value="{1}"/>')
    done = run("campbell", deck("bearing", "bearing.h5", campbell, laws), "bearing")
    expect("bearing: no word of a table that holds all speeds", "beyond" not in done.stderr,
           done.stderr)
    short = deck("short_table", "bearing.h5", campbell, laws.replace("{0, 1000}", "{0, 800}", 1))
    done = run("campbell", short, "short_table")
    expect("bearing: speeds beyond a table are warned of",
           'beyond the table of the law "table" (0 to 7639 rpm)' in done.stderr, done.stderr)
    exact = (k1 + np.sqrt(k1**2 + 4 * (m - k2) * k0)) / (2 * (m - k2))  # m w^2 = k0 + k1 w + k2 w^2
    close("bearing: critical speed of a stiffness that follows the speed",
          table("bearing", "crossings")["speed"], exact, 1e-9)
    done = tooljoint("campbell",
                     deck("speedless", "bearing.h5", campbell, laws.replace(GYROSCOPIC, "")))
    expect("bearing: without a law Omega it says what to add", done.returncode == 2
           and 'no law of time "Omega"' in done.stderr, done.stderr)


def transfer():
    """Transfer functions of a chain between walls: closed form and reciprocity."""
    m, k, c = 2.0, 5e4, 30.0
    chain = 2 * np.eye(3) - np.eye(3, k=1) - np.eye(3, k=-1)
    part("chain.h5", ["u"], m * np.eye(3), k * chain, c * np.eye(3))
    ends = lists("Loads", "".join(lists(f"at {n}", values(Node=n, Component="u")) for n in (1, 3)))
    wanted = lists("Outputs",
                   "".join(lists(f"node {n}", values(Node=n, Component="u")) for n in (1, 3)))
    scene = deck(
        "chain", "chain.h5",
        lists("Response",
              values(Excitation="Transfer", Highest_Frequency=60.0, Points=61) + ends + wanted))
    run("response", scene, "chain")
    rows = table("chain", "response")
    for a, b in ((1, 1), (1, 3), (3, 1)):
        exact = [
            np.linalg.inv(k * chain - w**2 * m * np.eye(3) + 1j * w * c * np.eye(3))[a - 1, b - 1]
            for w in 2 * np.pi * rows["frequency"]
        ]
        name = f"node {a}:at {b}"
        close(f"transfer function {name}",
              rows[name + "_amplitude"] * np.exp(1j * rows[name + "_phase"]), np.array(exact),
              1e-12)
    run("response", scene, "chain_loads", "Response/Excitation=Harmonic",
        "Response/Loads/at 1/Value=2", "Response/Loads/at 3/Phase=90 deg")
    loads = table("chain_loads", "response")
    sum_of = 2 * rows["node 1:at 1_amplitude"] * np.exp(
        1j * rows["node 1:at 1_phase"]) + 1j * rows["node 1:at 3_amplitude"] * np.exp(
            1j * rows["node 1:at 3_phase"])
    close("harmonic loads add with their phases",
          loads["node 1_amplitude"] * np.exp(1j * loads["node 1_phase"]), sum_of, 1e-12)
    # near 0 Hz the rigid motion of a free chain is large and masks the error of a few modes
    links = np.diff(np.eye(12), axis=0)
    free = 1e12 * links.T @ np.diag(k * (1 + 0.3 * np.sin(range(1, 12)))) @ links
    turn = np.array([[0.8, 0.6], [-0.6, 0.8]]) @ np.diag([1, 0.7]) @ np.array([[0.8, -0.6],
                                                                               [0.6, 0.8]])
    free = np.kron(free, turn)
    part("free.h5", ["u", "v"], m * np.eye(24), free, 1e-9 * free)
    one = lists("Loads", lists("at", values(Node=6, Component="u"))) + lists(
        "Outputs", lists("o", values(Node=6, Component="u")))
    sweep = values(Excitation="Transfer", Lowest_Frequency=2e5, Highest_Frequency=3e7, Points=31)
    done = run("response", deck("free", "free.h5", lists("Response", sweep + one), "",
                                reduction(4)), "free")
    rows = table("free", "response")
    poor = np.sum(rows["o:at_estimate"] > 0.2 * rows["o:at_amplitude"])
    expect("free: errors between the resonances are warned of",
           f"At {poor} of 31 points the estimated error" in done.stderr, f"{poor} {done.stderr}")
    expect("free: rounding of its motions at rest does not grow", "unstable" not in done.stderr,
           done.stderr)
    done = tooljoint("response", "free.xml", "--without", "Reduction", "--set",
                     "Response/Lowest Frequency=0", "--output", "free_at_rest")
    expect("free: it has no response at 0 Hz", done.returncode == 3
           and "(Response/Lowest Frequency)" in done.stderr, done.stderr)


def motor():
    """A narrow resonance at Order Omega + Motor Order Omega_m; with order 0 the frequency is the
    same at all speeds."""
    m, k, c = 2.0, 5e4, 0.2
    part("motor.h5", ["u"], m * np.eye(1), k * np.eye(1), c * np.eye(1))
    scene = deck(
        "motor", "motor.h5",
        lists(
            "Response",
            values(Excitation="Harmonic", Highest_Speed=60.0, Points=4, Order=2.0, Motor_Speed=20.0)
            + lists("Loads", lists("push", values(Node=1, Component="u"))) +
            lists("Outputs", lists("x", values(Node=1, Component="u")))))

    def exact(w):
        return 1 / np.abs(k - w**2 * m + 1j * w * c)

    peak = np.sqrt(k / m - 0.5 * (c / m)**2)  # 158.1 rad/s
    for name, order, motor, settings in (
        ("bit", 2, 2, ()),
        ("given", 2, 5, ("Response/Motor Order=5",)),
        ("lobes", 0, 5, ("Response/Order=0", "Response/Motor Order=5")),
    ):
        run("response", scene, f"motor_{name}", *settings)
        rows = table(f"motor_{name}", "response")
        close(f"motor, {name}: amplitude", rows["x_amplitude"],
              exact(order * rows["speed"] + motor * 20), 1e-9)
        if order:
            close(f"motor, {name}: the resonance between the points",
                  table(f"motor_{name}", "peaks")["speed"], (peak - motor * 20) / order, 1e-5)
        else:
            expect("motor: one frequency has no peak",
                   not pathlib.Path("motor_lobes/peaks.csv").exists())
    for words, settings in (
        ("without Motor Speed", ["Response/Motor Speed=0", "Response/Motor Order=3"]),
        ("nothing vibrates", ["Response/Order=0"]),
    ):
        done = tooljoint("response", scene, "--output", "refused",
                         *(word for one in settings for word in ("--set", one)))
        expect(f"motor: refused, {words}", done.returncode == 2 and words in done.stderr,
               done.stderr)


def shaft():
    """A spinning pinned Rayleigh shaft as a string: (rho S + rho I q^2) w^2 - 2 rho I q^2 Omega w -
    (E I q^4) = 0, with shear flexibility as a softer spring."""
    pathlib.Path("shaft.xml").write_text(SHAFT, encoding="utf-8")
    run("campbell", "shaft.xml", "shaft")
    rows = table("shaft", "campbell")
    young, nu, rho = material()
    radius, length, beta = 0.1, 2.0, 0.9
    area, inertia, shear = np.pi * radius**2, np.pi * radius**4 / 4, young / (2 * (1 + nu))
    for speed in (0.0, 2000.0, 4000.0):
        found = modes_at(rows, speed)
        lateral = np.abs(found["whirl"]) > 0.5 if speed > 0 else np.ones_like(found["whirl"], bool)
        exact = []
        for n in (1, 2):
            q = n * np.pi / length
            stiff = young * inertia * q**4 / (1 + young * inertia * q**2 /
                                              (shear * area * beta))  # bending and shear in series
            half = 2 * rho * inertia * q**2 * speed / (2 * (rho * area + rho * inertia * q**2))
            root = np.sqrt(half**2 + stiff / (rho * area + rho * inertia * q**2))
            exact += [root - half, root + half]
        sizes = np.sort(2 * np.pi * found["frequency"][lateral])
        # 40 elements; the mass matrix has the deflection of bending alone
        close(f"shaft at {speed} rad/s: {np.round(sizes, 2)}", sizes / np.sort(exact)[:len(sizes)],
              1.0, 2e-4)


def walls():
    """Unbalance of the shaft, applied by the scene and by the analysis, and the remaining distance
    to a wall."""
    contact = lists("Contact", values(Stiffness=1e7))
    response = lists(
        "Response",
        values(Highest_Speed=300.0, Points=4) + "UNBALANCE" + lists(
            "Outputs",
            lists("middle", values(Node=21, Component="u")) +
            lists("slope", values(Node=11, Component="theta_y"))))
    mass = values(Node=21, Moment=0.05, Phase=0.4)
    for name, text in (
        ("walls", contact + response.replace("UNBALANCE", lists("Unbalance", lists("a", mass)))),
        ("walls_scene", contact + response.replace("UNBALANCE", "") +
         lists("Loads",
               values(Gravity=0.0) + lists("Unbalance", lists("a", mass)))),
    ):
        pathlib.Path(f"{name}.xml").write_text(
            SHAFT[:SHAFT.rindex("</ParameterList>")] + text + "</ParameterList>", encoding="utf-8")
        run("response", f"{name}.xml", name)
    ours, scene = table("walls", "response"), table("walls_scene", "response")
    close("walls: unbalance of the scene and of the analysis", scene["middle_amplitude"],
          ours["middle_amplitude"], 1e-12)
    close("walls: its phase", scene["middle_phase"][1:], ours["middle_phase"][1:], 1e-9)
    expect("walls: the middle moves", ours["middle_amplitude"][-1] > 1e-7, ours["middle_amplitude"])
    close("walls: the circle of the middle and what it leaves are the clearance",
          ours["contact_margin"] + ours["middle_amplitude"], 0.9, 1e-12)
    done = run("response", "walls.xml", "walls_resonant", "Response/Highest Speed=2000",
               "Response/Points=8")
    expect("walls: without damping the amplitude has no bound", "Modes have no damping: at 101 Hz"
           in done.stderr, done.stderr)
    margins, peaks = table("walls_resonant", "margins"), table("walls_resonant", "peaks")
    largest = peaks["amplitude"][peaks["output"] == 1].max()
    close("walls: the least margin is that of the largest amplitude between the points",
          margins["margin"][margins["node"] == 21], 0.9 - largest, 1e-9)
    expect("walls: that is behind the wall", largest > 1.0, largest)
    shear = 2 * (1 + material()[1]) * 0.1**2 / (4 * 0.9)  # E I/(G S beta): the section rotates less
    close("walls: the turn of the section at the quarter of a sine",
          peaks["amplitude"][peaks["output"] == 2],
          largest * np.pi / 2 * np.cos(np.pi / 4) / (1 + shear * (np.pi / 2)**2), 1e-3)
    expect("walls: the middle is nearest", np.all(ours["contact_node"][1:] == 21),
           ours["contact_node"])


def turning():
    """A response at 0 rpm of a turning shaft gives a warning, one at a given speed does not. The
    shaft does not bend, so no moment is printed."""
    loads = lists("Loads", lists("middle", values(Node=21, Component="u")))
    response = lists(
        "Response",
        values(Excitation="Harmonic", Highest_Frequency="5 Hz", Points=3) + loads +
        lists("Outputs", lists("middle", values(Node=21, Component="u"))))
    pathlib.Path("still.xml").write_text(
        SHAFT[:SHAFT.rindex("</ParameterList>")] + response + "</ParameterList>", encoding="utf-8")
    along = [f"Response/{role}/middle/Component=w" for role in ("Loads", "Outputs")]
    for name, speed in (("still", []), ("turning", ["Response/Rotary Speed=120 rpm", *along])):
        done = run("response", "still.xml", name, *speed)
        expect(f"{name}: a response at 0 rpm of a shaft that turns is warned of",
               ("is that of 0 rpm" in " ".join(
                   (done.stdout + done.stderr).split())) == (not speed), done.stdout[-600:])
        expect(f"{name}: the bending moment is said where there is one",
               ("bending moment" in done.stdout) == (name == "still"), done.stdout[-600:])


def critical_speeds(reduced, settings):
    """Critical speeds of a string: the difference between reduced and full model is the estimate.
    The estimate is of first order in the error, which is 1e-6 and less here; rounding and the
    tolerance of the crossings are below 1e-9."""
    done = tooljoint("campbell", "string.xml", "--output", "string_full", "--without", "Reduction",
                     "--without", "Substructures",
                     *(word for one in settings for word in ("--set", one)))
    expect("critical speeds of the full model", done.returncode == 0, done.stderr)
    full, few = table("string_full", "crossings"), table(reduced, "crossings")
    expect(
        f"{len(few['speed'])} critical speeds, as many as of the full model",
        len(few["speed"]) == len(full["speed"]) > 15
        and np.array_equal(few["order"], full["order"]), full["speed"])
    apart = np.abs(few["frequency"] / full["frequency"] - 1)
    expect(
        f"apart by {apart.min():.1e} to {apart.max():.1e}, as estimated",
        np.all(np.abs(apart - few["estimate"]) <= 0.05 * few["estimate"] + 1e-9)
        and apart.max() > 1e-7, np.c_[full["speed"] / RPM, apart, few["estimate"]])


def string():
    """The reference scene with half of its string: limit at rest, spot checks within the estimates,
    ranks."""
    text = pathlib.Path(STRING).read_text(encoding="utf-8").replace(
        "components/helical_170m.xml", str(SOURCES / "xml/components/helical_170m.xml"))
    text = re.sub('("Assembly".*value=)"[^"]*"', f'\\1"{SHORTER}"', text)
    loads = lists("Loads", lists("bit", values(Node=67, Component="w", Value="5 kN")))
    outputs = lists(
        "Outputs",
        lists("bit", values(Node=67, Component="w")) +
        lists("pipe", values(Node=12, Component="u")))
    response = lists(
        "Response",
        values(Excitation="Harmonic", Highest_Speed="120 rpm", Order=3.0, Points=5) + loads +
        outputs)
    pathlib.Path("string.xml").write_text(
        text[:text.rindex("</ParameterList>")] + response + "</ParameterList>", encoding="utf-8")
    run("response", "string.xml", "string_response")
    checks = table("string_response", "spot_checks")
    good = np.abs(checks["error"] -
                  checks["estimate"]) <= 0.5 * checks["error"] + 1e-9 * checks["full"]
    expect("string: the error of the response is the one estimated", np.all(good),
           np.c_[checks["full"], checks["error"], checks["estimate"]])
    # a smooth start: neither speed nor acceleration at t = 0
    ramp = [
        "Rotary Speed/Law=Ramp", "Rotary Speed/Ramp/Final Speed=120 rpm",
        "Rotary Speed/Ramp/Duration=1"
    ]
    campbell = [
        *ramp, "Campbell/Highest Speed=120 rpm", "Campbell/Points=2", "Campbell/Modes=4",
        "Campbell/Orders={1}", "Campbell/Friction=Sliding"
    ]
    run("campbell", "string.xml", "string", *campbell)
    estimates("string")
    done = tooljoint("modes", "string.xml", "--count", "16", "--time", "0", "--output",
                     "string_modes", *(word for one in ramp for word in ("--set", one)))
    expect("string: modes ends well", done.returncode == 0, done.stderr)
    smoothly = [*campbell[:-2], "Campbell/Modes=8", "Campbell/Spot Checks=0"]  # orders 1, 2 and 3
    run("campbell", "string.xml", "string_smooth", *smoothly)
    critical_speeds("string_smooth", smoothly)
    smooth = modes_at(table("string_smooth", "campbell"), 120 * RPM)
    sliding = modes_at(table("string", "campbell"), 120 * RPM)
    expect("string: friction damps what slides",
           np.abs(smooth["damping"][0] - sliding["damping"][0]) > 1e-3 * smooth["damping"][0],
           (smooth["damping"], sliding["damping"]))
    still = table("string_modes", "damped_modes")
    vibrating = still["coupled_im"] > 1e-6 * still["coupled"]
    rows = modes_at(table("string", "campbell"), 0.0)
    apart = [
        np.min(
            np.abs(still["coupled_im"][vibrating] - f) +
            np.abs(still["coupled_damping"][vibrating] - d))
        for f, d in zip(rows["frequency"], rows["damping"])
    ]
    expect("string: the modes at rest are those of `modes` at Omega = 0",
           np.max(apart) < 1e-6, apart)
    run("campbell", "string.xml", "string_2", *campbell, "Campbell/Spot Checks=0", ranks=2)
    alone, two = table("string", "campbell"), table("string_2", "campbell")
    close("string: two ranks give the same table", two["frequency"], alone["frequency"], 1e-9)


def pictures():
    """Both kinds of results are drawn; a folder with neither gives a message."""
    for folder, name in (
        ("nelson", "campbell"),
        ("laval_response", "response"),
        ("chain", "response"),
        ("bending", "response"),
        ("window", "campbell"),
        (".", None),
    ):
        done = subprocess.run(
            [sys.executable, str(SOURCES / "tools/plot_response.py"), folder],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
        drawn = name is not None and (pathlib.Path(folder) / f"{name}.png").stat().st_size > 10000
        if folder in ("bending", "window"):
            drawn = drawn and (pathlib.Path(folder) /
                               f"{name}_{'shapes' if name == 'campbell' else 'profile'}.png"
                               ).stat().st_size > 10000
        expect(f"picture of {folder}",
               (done.returncode == 0 and drawn) if name else "neither campbell.h5" in done.stderr,
               done.stderr)


if sys.argv[4] == "rotors":
    for check in (laval, neighbours, overhung, excitations, bearing, nelson, friswell, anisotropic,
                  damped, transfer, motor, shaft, window, walls, turning, bending, growth,
                  states.states, pictures, refusals):
        check()
else:
    string()
    states.wall()
sys.exit(finish())
