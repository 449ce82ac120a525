# SPDX-License-Identifier: BSD-3-Clause
"""Published rotors: critical speeds, whirl and unbalance against the published numbers and a dense solver.

Nelson: H. D. Nelson and J. M. McVaugh, J. Eng. Ind. 98 (1976) 593-600. Friswell: M. I. Friswell, J. E. T. Penny, S. D. Garvey and A. W. Lees, Dynamics of Rotating
Machines (Cambridge University Press, 2010), example 5.9.1, with the frequencies that the ROSS project prints of it (R. Timbo et al., J. Open Source Softw. 5 (2020) 2120;
docs/examples/example_05_09_01 of that project).
"""
import numpy as np
from scipy.linalg import eig

from scenes import GYROSCOPIC, RPM, close, deck, estimates, expect, lists, modes_at, part, run, table, values

NELSON = {  # stations, inner and outer radii [cm]
    "x": [0, 1.27, 5.08, 7.62, 8.89, 10.16, 10.67, 11.43, 12.70, 13.46, 16.51, 19.05, 22.86, 26.67, 28.70, 30.48, 31.50, 34.54, 35.81],
    "inner": [0, 0, 0, 0, 0, 0, 1.52, 1.78, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1.52],
    "outer": [0.51, 1.02, 0.76, 2.03, 2.03, 3.30, 3.30, 2.54, 2.54, 1.27, 1.27, 1.52, 1.52, 1.27, 1.27, 3.81, 2.03, 2.03],
    "published": {-1: [15470, 46612, 64752], 1: [17159, 49983, 96457]},  # synchronous critical speeds, isotropic bearings [rpm]
}

FRISWELL = {  # rotary speed [rpm]: frequencies [rad/s], backward and forward in turn
    0: [86.65811435, 86.65811435, 274.31285391, 274.31285391, 716.78631221, 716.78631221],
    4000: [85.389467, 87.7958637, 251.78460413, 294.71333087, 600.17936195, 827.07536193],
}


def shaft_matrices(x, inner, outer, young, density, shear=np.inf):
    """Rayleigh elements in one plane, with the shear modulus as a softer spring (coefficient 6 (1 + nu)/(7 + 6 nu) of a solid section, nu = 0.3): K, M, G."""
    K, M, G = (np.zeros((2 * len(x), 2 * len(x))) for _ in range(3))
    for e, l in enumerate(np.diff(x)):
        area, inertia = np.pi * (outer[e]**2 - inner[e]**2), np.pi / 4 * (outer[e]**4 - inner[e]**4)
        phi = 12 * young * inertia / (6 * 1.3 / 8.8 * shear * area * l * l)
        turn = density * inertia / (30 * l) * np.array([[36, 3 * l, -36, 3 * l], [3 * l, 4 * l * l, -3 * l, -l * l], [-36, -3 * l, 36, -3 * l], [3 * l, -l * l, -3 * l, 4 * l * l]])
        span = slice(2 * e, 2 * e + 4)
        K[span, span] += young * inertia / (l**3 * (1 + phi)) * np.array([[12, 6 * l, -12, 6 * l], [6 * l, (4 + phi) * l * l, -6 * l, (2 - phi) * l * l], [-12, -6 * l, 12, -6 * l],
                                                                          [6 * l, (2 - phi) * l * l, -6 * l, (4 + phi) * l * l]])
        M[span, span] += turn + density * area * l / 420 * np.array([[156, 22 * l, 54, -13 * l], [22 * l, 4 * l * l, 13 * l, -3 * l * l], [54, 13 * l, 156, -22 * l], [-13 * l, -3 * l * l, -22 * l, 4 * l * l]])
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
    matrices = shaft_matrices(*(1e-2 * np.array(NELSON[name]) for name in ("x", "inner", "outer")), 2.078e11, 7806.0)
    add_disc(matrices, 5, 1.401, 0.00136, 0.00203)
    for station in (11, 15):
        matrices[0][2 * station - 2, 2 * station - 2] += 4.378e7
    return matrices


def friswell_matrices():
    """A shaft of 1.5 m with discs of 0.07 m at its thirds on isotropic bearings of 1 MN/m at its ends, six elements."""
    density, bore, width = 7810.0, 0.025, 0.07
    matrices = shaft_matrices(0.25 * np.arange(7), np.zeros(6), np.full(6, bore), 2.11e11, density, 8.12e10)
    for station, radius in ((3, 0.14), (5, 0.175)):
        mass = density * np.pi * (radius**2 - bore**2) * width
        add_disc(matrices, station, mass, mass * (3 * (radius**2 + bore**2) + width**2) / 12, mass * (radius**2 + bore**2) / 2)
    for end in (0, -2):
        matrices[0][end, end] += 1e6
    return matrices


def rotor_part(file, k, m, g, c=None):
    """Both planes of a rotor as a part with the components u, v, theta_x, theta_y."""
    stations = len(k) // 2
    flip = np.diag([1.0, -1.0] * stations)
    K, M, G, C = (np.zeros((4 * stations, 4 * stations)) for _ in range(4))
    along_u = [4 * i + j for i in range(stations) for j in (0, 3)]  # u, theta_y
    along_v = [4 * i + j for i in range(stations) for j in (1, 2)]  # v, -theta_x
    for A, a in ((K, k), (M, m), (C, np.zeros_like(k) if c is None else c)):
        A[np.ix_(along_u, along_u)] = a
        A[np.ix_(along_v, along_v)] = flip @ a @ flip
    # M r'' - i Omega G r' + K r = 0, r = u + i v: u'' has + Omega G v', v'' has - Omega G u'
    G[np.ix_(along_u, along_v)] = g @ flip
    G[np.ix_(along_v, along_u)] = -flip @ g
    part(file, ["u", "v", "theta_x", "theta_y"], M, K, C, G)


def reduction(modes):
    return lists("Reduction", values(Basis="Craig-Bampton") + lists("Mode Selection", values(Modes=modes)))


def nelson():
    """The published rotor, whole and reduced, and the same critical speeds from a dense solver."""
    k, m, g = nelson_matrices()
    rotor_part("nelson.h5", k, m, g)
    campbell = lists("Campbell", values(Highest_Speed="100000 rpm", Points=26, Modes=6) + '<Parameter name="Orders" type="Array(double)" value="{1}"/>')
    critical = {}
    for name, reduced in {"nelson": "", "nelson_reduced": reduction(16)}.items():
        run("campbell", deck(name, "nelson.h5", campbell, GYROSCOPIC, reduced), name)
        crossings = table(name, "crossings")
        critical[name] = {sense: crossings["speed"][crossings["whirl"] * sense > 0] / RPM for sense in (-1, 1)}
    for sense, published in NELSON["published"].items():
        exact = np.sort([np.sqrt(w.real) / RPM for w in eig(k, m - sense * g, right=False) if w.real > 0 and abs(w.imag) < 1e-6 * abs(w)])[:3]
        found = critical["nelson"][sense]
        close(f"nelson: critical speeds {np.round(found, 1)} of sense {sense:+d} against a dense solver", found, exact, 1e-8)
        # stations and radii are published to three figures
        close(f"nelson: critical speeds of sense {sense:+d} against the published ones", found / published, 1.0, 0.015)
        if len(critical["nelson_reduced"][sense]) == len(exact):
            reduced = critical["nelson_reduced"][sense]
            expect(f"nelson, reduced: {np.round(reduced, 1)}", np.max(np.abs(reduced / exact - 1)) < 1e-3, exact)
    estimates("nelson_reduced")
    unbalance("nelson", k, m, g, 1e-6 * k, 5, 30000.0, 12)


def friswell():
    """The published frequencies of the second rotor at rest and at 4000 rpm; its unbalance response, with damped bearings, against a dense solver."""
    k, m, g = friswell_matrices()
    rotor_part("friswell.h5", k, m, g)
    campbell = lists("Campbell", values(Highest_Speed="4000 rpm", Points=9, Modes=6))
    run("campbell", deck("friswell", "friswell.h5", campbell, GYROSCOPIC), "friswell")
    rows = table("friswell", "campbell")
    for speed, published in FRISWELL.items():
        here = modes_at(rows, speed * RPM)
        found = 2 * np.pi * np.sort(here["frequency"])
        # the published elements have the deflection of shear in their masses too: 3e-5 of the sixth frequency
        close(f"friswell at {speed} rpm: {np.round(found, 3)} rad/s against the published frequencies", found / published, 1.0, 5e-5)
        if speed:
            expect("friswell: backward and forward in turn", np.all(np.sign(here["whirl"][np.argsort(here["frequency"])]) == [-1, 1, -1, 1, -1, 1]), here["whirl"])
    bearings = np.zeros_like(k)
    bearings[0, 0] = bearings[-2, -2] = 3e3  # example 5.9.5: 3 kN s/m
    unbalance("friswell", k, m, g, bearings, 3, 4000.0, 20)


def unbalance(name, k, m, g, c, station, last, modes):
    """Unbalance of a disc: M r'' + C r' - i Omega G r' + K r = m e Omega^2 exp(i Omega t), from a dense solver."""
    rotor_part(f"{name}_damped.h5", k, m, g, c)
    moment = 2e-4
    response = lists("Response", values(Highest_Speed=f"{last} rpm", Points=41) + lists("Unbalance", lists("disc", values(Node=station, Moment=moment))) +
                     lists("Outputs", lists("x", values(Node=station, Component="u")) + lists("end", values(Node=1, Component="v"))))
    for scene, reduced in ((f"{name}_unbalance", ""), (f"{name}_unbalance_reduced", reduction(modes))):
        run("response", deck(scene, f"{name}_damped.h5", response, GYROSCOPIC, reduced), scene)
        rows = table(scene, "response")
        force = np.zeros(len(k))
        force[2 * station - 2] = moment
        r = np.array([np.linalg.solve(k - w**2 * (m - g) + 1j * w * c, w**2 * force) for w in rows["speed"]])
        tolerance = 1e-6 if not reduced else 5e-3  # peaks are a hundred times the static response and more
        close(f"{scene}: motion of the disc along x", rows["x_amplitude"] * np.exp(1j * rows["x_phase"]), r[:, 2 * station - 2], tolerance)
        close(f"{scene}: motion of the end along y, a quarter turn behind", rows["end_amplitude"] * np.exp(1j * rows["end_phase"]), -1j * r[:, 0], tolerance)
        peaks = table(scene, "peaks")
        expect(f"{scene}: it has a peak", len(peaks["speed"]) > 0)
