# SPDX-License-Identifier: BSD-3-Clause
"""Published rotors: critical speeds, whirl and unbalance against the published numbers and a dense
solver.

Nelson: H. D. Nelson and J. M. McVaugh, J. Eng. Ind. 98 (1976) 593-600. Friswell: M. I. Friswell, J.
E. T. Penny, S. D. Garvey and A. W. Lees, Dynamics of Rotating Machines (Cambridge University Press,
2010), examples 5.9.1 and 5.9.2, with their frequencies and amplitudes as printed by the ROSS
project (R. Timbo et al., J. Open Source Softw. 5 (2020) 2120; docs/examples/example_05_09_01 and
ross/tests/test_rotor_assembly of that project).
"""
import h5py
import numpy as np
from scipy.linalg import eig

from scenes import (GYROSCOPIC, RPM, close, deck, estimates, expect, lists, modes_at, part, run,
                    table, values)

NELSON = {  # stations, inner and outer radii [cm]
    "x": [
        0, 1.27, 5.08, 7.62, 8.89, 10.16, 10.67, 11.43, 12.70, 13.46, 16.51, 19.05, 22.86, 26.67,
        28.70, 30.48, 31.50, 34.54, 35.81
    ],
    "inner": [0, 0, 0, 0, 0, 0, 1.52, 1.78, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1.52],
    "outer": [
        0.51, 1.02, 0.76, 2.03, 2.03, 3.30, 3.30, 2.54, 2.54, 1.27, 1.27, 1.52, 1.52, 1.27, 1.27,
        3.81, 2.03, 2.03
    ],
    "published": {
        -1: [15470, 46612, 64752],
        1: [17159, 49983, 96457],
    },  # synchronous critical speeds, isotropic bearings [rpm]
}

FRISWELL = {  # rotary speed [rpm]: frequencies [rad/s], backward and forward in turn
    0: [86.65811435, 86.65811435, 274.31285391, 274.31285391, 716.78631221, 716.78631221],
    4000: [85.389467, 87.7958637, 251.78460413, 294.71333087, 600.17936195, 827.07536193],
}

# unbalance of 1e-3 kg m at stations: amplitudes at station 1 [m, rad] at 150, 300 and 450 rad/s
ANISOTROPIC = {
    (3,): {
        "u": [1.14259057e-06, 1.88932819e-04, 4.50376020e-05],
        "v": [3.02252319e-06, 1.50551126e-04, 4.98323245e-05],
        "theta_x": [1.97842812e-05, 5.19405022e-05, 2.80824236e-05],
        "theta_y": [2.02593969e-05, 1.64498124e-05, 1.06100461e-05],
    },
    (3, 4): {
        "u": [4.80337594e-06, 2.31170438e-04, 6.90062268e-05],
        "v": [3.15307288e-06, 1.87793923e-04, 8.08531462e-05],
        "theta_x": [3.79692673e-05, 5.97050225e-05, 5.48105215e-05],
        "theta_y": [4.16812885e-05, 1.38592416e-05, 2.20209089e-05],
    },
}


def symmetric(upper):
    """The matrix with this upper triangle, given by rows."""
    a = np.zeros((4, 4))
    a[np.triu_indices(4)] = upper
    return a + np.triu(a, 1).T


def shaft_matrices(x, inner, outer, young, density, shear=np.inf):
    """Timoshenko elements (Friswell et al., section 5.4) in one plane, for a solid section with the
    shear coefficient 6 (1 + nu)/(7 + 6 nu): K, M, G."""
    K, M, G = (np.zeros((2 * len(x), 2 * len(x))) for _ in range(3))
    nu = young / (2 * shear) - 1 if np.isfinite(shear) else 0.3
    for e, l in enumerate(np.diff(x)):
        area, inertia = np.pi * (outer[e]**2 - inner[e]**2), np.pi / 4 * (outer[e]**4 - inner[e]**4)
        p = 12 * young * inertia / (6 * (1 + nu) / (7 + 6 * nu) * shear * area * l * l)
        span = slice(2 * e, 2 * e + 4)
        K[span, span] += young * inertia / (l**3 * (1 + p)) * symmetric([
            12, 6 * l, -12, 6 * l, (4 + p) * l * l, -6 * l, (2 - p) * l * l, 12, -6 * l,
            (4 + p) * l * l
        ])
        near, far, turned = 312 + 588 * p + 280 * p * p, 108 + 252 * p + 140 * p * p, (
            8 + 14 * p + 7 * p * p) * l * l
        a, b, c = (44 + 77 * p + 35 * p * p) * l, (26 + 63 * p +
                                                   35 * p * p) * l, (6 + 14 * p + 7 * p * p) * l * l
        moved = density * area * l / (840 * (1 + p)**2) * symmetric(
            [near, a, far, -b, turned, b, -c, near, -a, turned])
        d, turned = (3 - 15 * p) * l, (4 + 5 * p + 10 * p * p) * l * l
        other = (5 * p * p - 5 * p - 1) * l * l
        turn = density * inertia / (30 * l * (1 + p)**2) * symmetric(
            [36, d, -36, d, turned, -d, other, 36, -d, turned])
        M[span, span] += moved + turn
        G[span, span] += 2 * turn
    return K, M, G


def add_disc(matrices, station, mass, diametral, polar):
    """`station` counts from 1."""
    _, M, G = matrices
    at = 2 * station - 2
    M[at, at] += mass
    M[at + 1, at + 1] += diametral
    G[at + 1, at + 1] += polar


def nelson_matrices():
    """A disc at station 5 and isotropic bearings at 11 and 15."""
    matrices = shaft_matrices(*(1e-2 * np.array(NELSON[name]) for name in ("x", "inner", "outer")),
                              2.078e11, 7806.0)
    add_disc(matrices, 5, 1.401, 0.00136, 0.00203)
    for station in (11, 15):
        matrices[0][2 * station - 2, 2 * station - 2] += 4.378e7
    return matrices


def friswell_matrices():
    """A shaft of 1.5 m with discs of 0.07 m at its thirds on isotropic bearings of 1 MN/m at its
    ends, six elements."""
    density, bore, width = 7810.0, 0.025, 0.07
    matrices = shaft_matrices(0.25 * np.arange(7), np.zeros(6), np.full(6, bore), 2.11e11, density,
                              8.12e10)
    for station, radius in ((3, 0.14), (5, 0.175)):
        mass = density * np.pi * (radius**2 - bore**2) * width
        add_disc(matrices, station, mass,
                 mass * (3 * (radius**2 + bore**2) + width**2) / 12,
                 mass * (radius**2 + bore**2) / 2)
    for end in (0, -2):
        matrices[0][end, end] += 1e6
    return matrices


def rotor_part(file, k, m, g, c=None, across=None):
    """Both planes of a rotor as a part with the components u, v, theta_x, theta_y. `across` is the
    stiffness of the plane of v, if it differs."""
    stations = len(k) // 2
    flip = np.diag([1.0, -1.0] * stations)
    K, M, G, C = (np.zeros((4 * stations, 4 * stations)) for _ in range(4))
    along_u = [4 * i + j for i in range(stations) for j in (0, 3)]  # u, theta_y
    along_v = [4 * i + j for i in range(stations) for j in (1, 2)]  # v, -theta_x
    for A, a in ((K, k), (M, m), (C, np.zeros_like(k) if c is None else c)):
        A[np.ix_(along_u, along_u)] = a
        A[np.ix_(along_v, along_v)] = flip @ (across if a is k and across is not None else a) @ flip
    # M r'' - i Omega G r' + K r = 0, r = u + i v: u'' has + Omega G v', v'' has - Omega G u'
    G[np.ix_(along_u, along_v)] = g @ flip
    G[np.ix_(along_v, along_u)] = -flip @ g
    part(file, ["u", "v", "theta_x", "theta_y"], M, K, C, G)


def reduction(modes):
    return lists("Reduction",
                 values(Basis="Craig-Bampton") + lists("Mode Selection", values(Modes=modes)))


def nelson():
    """The published rotor, full and reduced, and the same critical speeds from a dense solver."""
    k, m, g = nelson_matrices()
    rotor_part("nelson.h5", k, m, g)
    campbell = lists(
        "Campbell",
        values(Highest_Speed="100000 rpm", Points=26, Modes=6) +
        '<Parameter name="Orders" type="Array(double)" value="{1}"/>')
    critical = {}
    for name, reduced in {"nelson": "", "nelson_reduced": reduction(16)}.items():
        run("campbell", deck(name, "nelson.h5", campbell, GYROSCOPIC, reduced), name)
        crossings = table(name, "crossings")
        critical[name] = {
            sense: crossings["speed"][crossings["whirl"] * sense > 0] / RPM for sense in (-1, 1)
        }
    for sense, published in NELSON["published"].items():
        exact = np.sort([
            np.sqrt(w.real) / RPM for w in eig(k, m - sense * g, right=False)
            if w.real > 0 and abs(w.imag) < 1e-6 * abs(w)
        ])[:3]
        found = critical["nelson"][sense]
        close(
            f"nelson: critical speeds {np.round(found, 1)} of sense {sense:+d} against a dense "
            "solver", found, exact, 1e-8)
        # stations and radii are published to three figures
        close(f"nelson: critical speeds of sense {sense:+d} against the published ones",
              found / published, 1.0, 0.015)
        if len(critical["nelson_reduced"][sense]) == len(exact):
            reduced = critical["nelson_reduced"][sense]
            expect(f"nelson, reduced: {np.round(reduced, 1)}",
                   np.max(np.abs(reduced / exact - 1)) < 1e-3, exact)
    estimates("nelson_reduced")
    unbalance("nelson", k, m, g, 1e-6 * k, 5, 30000.0, 12)


def friswell():
    """The published frequencies of the second rotor at rest and at 4000 rpm; its unbalance
    response, with damped bearings, against a dense solver."""
    k, m, g = friswell_matrices()
    rotor_part("friswell.h5", k, m, g)
    campbell = lists("Campbell", values(Highest_Speed="4000 rpm", Points=9, Modes=6))
    run("campbell", deck("friswell", "friswell.h5", campbell, GYROSCOPIC), "friswell")
    rows = table("friswell", "campbell")
    for speed, published in FRISWELL.items():
        here = modes_at(rows, speed * RPM)
        found = 2 * np.pi * np.sort(here["frequency"])
        close(
            f"friswell at {speed} rpm: {np.round(found, 3)} rad/s against the published "
            "frequencies", found / published, 1.0, 1e-9)
        if speed:
            expect(
                "friswell: backward and forward in turn",
                np.all(
                    np.sign(here["whirl"][np.argsort(here["frequency"])]) == [-1, 1, -1, 1, -1, 1]),
                here["whirl"])
    bearings = np.zeros_like(k)
    bearings[0, 0] = bearings[-2, -2] = 3e3  # example 5.9.5: 3 kN s/m
    unbalance("friswell", k, m, g, bearings, 3, 4000.0, 20)


def anisotropic():
    """The same rotor on bearings of 1 and 0.8 MN/m, example 5.9.2: amplitudes under unbalance as
    printed by ROSS."""
    k, m, g = friswell_matrices()
    softer = k.copy()
    for end in (0, -2):
        softer[end, end] -= 0.2e6
    rotor_part("anisotropic.h5", k, m, g, None, softer)
    for stations, published in ANISOTROPIC.items():
        masses = lists("Unbalance",
                       "".join(lists(f"disc {n}", values(Node=n, Moment=1e-3)) for n in stations))
        outputs = lists("Outputs",
                        "".join(lists(name, values(Node=1, Component=name)) for name in published))
        name = f"anisotropic_{len(stations)}"
        run(
            "response",
            deck(name, "anisotropic.h5",
                 lists("Response",
                       values(Highest_Speed=450.0, Points=4) + masses + outputs), GYROSCOPIC), name)
        rows = table(name, "response")
        for output, amplitudes in published.items():
            found = rows[f"{output}_amplitude"][1:]
            close(
                f"{name}: {output} at 150, 300, 450 rad/s {found} against the published amplitudes",
                found / amplitudes, 1.0, 1e-8)

    campbell = lists(
        "Campbell",
        values(Highest_Speed=450.0, Points=3, Modes=4) +
        '<Parameter name="Orders" type="Array(double)" value="{1}"/>')
    run("campbell", deck("anisotropic", "anisotropic.h5", campbell, GYROSCOPIC), "anisotropic")
    with h5py.File("anisotropic.h5") as f:
        K, M, G = f["stiffness/structure"][:], f["mass"][:], f["damping/gyroscopic"][:]
    crossings = table("anisotropic", "crossings")
    for w, whirl in zip(crossings["speed"], crossings["whirl"]):  # Q(i w) phi = 0 with Omega = w
        phi = np.linalg.svd(K - w**2 * M + 1j * w**2 * G)[2][-1].conj()
        u, v = phi[0::4], phi[1::4]
        close(f"anisotropic: whirl at the critical speed {w:.2f} rad/s", whirl,
              2 * np.sum(np.imag(u * v.conj())) / np.sum(abs(u)**2 + abs(v)**2), 1e-6)


def damped():
    """The same rotor on bearings of 1 and 2 MN/m with 1 kN s/m, 1 kg m at station 1, 50 rad/s: the
    major axis of the orbits of stations 1 and 2 as printed by ROSS [m]."""
    k, m, g = friswell_matrices()
    stiffer, bearings = k.copy(), np.zeros_like(k)
    for end in (0, -2):
        stiffer[end, end] += 1e6
        bearings[end, end] = 1e3
    rotor_part("damped.h5", k, m, g, bearings, stiffer)
    outputs = lists(
        "Outputs", "".join(
            lists(f"{name}{n}", values(Node=n, Component=name)) for n in (1, 2) for name in "uv"))
    scene = deck(
        "damped", "damped.h5",
        lists(
            "Response",
            values(Highest_Speed=50.0, Points=2) +
            lists("Unbalance", lists("end", values(Node=1, Moment=1.0))) + outputs), GYROSCOPIC)
    run("response", scene, "damped")
    rows = table("damped", "response")
    for station, published in (
        (1, [2.74183e-3, 4.91340990e-05]),
        (2, [2.52877e-3, 4.58914054e-05]),
    ):
        u, v = (rows[f"{name}{station}_amplitude"][-1] *
                np.exp(1j * rows[f"{name}{station}_phase"][-1]) for name in "uv")
        turn = -np.angle(u * u + v * v) / 2  # phase up to the instant of the largest distance
        axis = np.real(np.array([u, v]) * np.exp(1j * turn))
        # the published axis comes from a picture, which its own test checks to 1e-4; the smaller
        # component agrees in all digits
        close(f"damped: major axis at station {station} {axis} against the published one",
              np.abs(axis) / published, 1.0, 1e-4)


def unbalance(name, k, m, g, c, station, last, modes):
    """Unbalance of a disc: M r'' + C r' - i Omega G r' + K r = m e Omega^2 exp(i Omega t), from a
    dense solver."""
    rotor_part(f"{name}_damped.h5", k, m, g, c)
    moment = 2e-4
    response = lists(
        "Response",
        values(Highest_Speed=f"{last} rpm", Points=41) +
        lists("Unbalance", lists("disc", values(Node=station, Moment=moment))) + lists(
            "Outputs",
            lists("x", values(Node=station, Component="u")) +
            lists("end", values(Node=1, Component="v"))))
    for scene, reduced in (
        (f"{name}_unbalance", ""),
        (f"{name}_unbalance_reduced", reduction(modes)),
    ):
        run("response", deck(scene, f"{name}_damped.h5", response, GYROSCOPIC, reduced), scene)
        rows = table(scene, "response")
        force = np.zeros(len(k))
        force[2 * station - 2] = moment
        r = np.array(
            [np.linalg.solve(k - w**2 * (m - g) + 1j * w * c, w**2 * force) for w in rows["speed"]])
        # peaks are at least a hundred times the static response
        tolerance = 1e-6 if not reduced else 5e-3
        close(f"{scene}: motion of the disc along x",
              rows["x_amplitude"] * np.exp(1j * rows["x_phase"]), r[:, 2 * station - 2], tolerance)
        close(f"{scene}: motion of the end along y, a quarter turn behind",
              rows["end_amplitude"] * np.exp(1j * rows["end_phase"]), -1j * r[:, 0], tolerance)
        peaks = table(scene, "peaks")
        expect(f"{scene}: it has a peak", len(peaks["speed"]) > 0)
