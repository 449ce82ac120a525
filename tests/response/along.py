# SPDX-License-Identifier: BSD-3-Clause
"""Checks of quantities along a string and of the chosen modes: windows of frequencies, shapes,
bending moments, distances to the wall."""
import pathlib

import h5py
import numpy as np

from scenes import SHAFT, close, expect, lists, material, modes_at, run, table, tooljoint, values


def window():
    """A window and a target show the modes of a wide diagram within them at every speed, and its
    critical speeds; shapes are stored with their rows."""
    text = SHAFT.replace('name="Modes" type="int" value="4"',
                         'name="Modes" type="int" value="24"').replace('"{1}"', '"{1, 2}"')
    pathlib.Path("wide.xml").write_text(text, encoding="utf-8")
    run("campbell", "wide.xml", "wide", "Campbell/Points=5")
    wide, critical = table("wide", "campbell"), table("wide", "crossings")
    low, high = 390.0, 840.0  # Hz: one mode enters and another leaves with the speed
    said = run("campbell", "wide.xml", "window", "Campbell/Points=5",
               f"Campbell/Lowest Frequency={low} Hz", f"Campbell/Highest Frequency={high} Hz")
    expect("window: says which critical speeds are not looked for",
           "not looked for: critical speeds outside of 390 to 840 Hz" in said.stdout, said.stdout)
    shown, met = table("window", "campbell"), table("window", "crossings")
    inside = (wide["frequency"] >= low) & (wide["frequency"] <= high) & (np.abs(wide["growth"]) <=
                                                                         np.pi * (high - low))
    for speed in np.unique(wide["speed"]):
        close(f"window at {speed} rad/s: its modes", np.sort(modes_at(shown, speed)["frequency"]),
              np.sort(wide["frequency"][inside & (wide["speed"] == speed)]), 1e-8)
    count = {np.sum(inside & (wide["speed"] == speed)) for speed in np.unique(wide["speed"])}
    expect("window: modes enter and leave it", len(count) > 1 and min(count) > 2, count)
    inside = (critical["frequency"] >= low) & (critical["frequency"] <= high)
    expect("window: it has critical speeds", np.sum(inside) >= 2)
    close("window: its critical speeds", np.sort(met["speed"]), np.sort(critical["speed"][inside]),
          1e-8)
    said = run("campbell", "wide.xml", "target", "Campbell/Points=3",
               "Campbell/Target Frequency=900 Hz", "Campbell/Modes=3", "Campbell/Orders={1}")
    expect("target: modes above all excitations are warned of",
           "Excitations have 0 to 637 Hz, but the modes of the diagram" in said.stderr, said.stderr)
    near = table("target", "campbell")
    for speed in (0.0, 2000.0):
        all_modes = modes_at(wide, speed)["frequency"]
        nearest = all_modes[np.argsort(np.abs(all_modes - 900.0))[:3]]
        found = modes_at(near, speed)["frequency"]
        expect(f"target at {speed} rad/s: {np.sort(nearest)} are followed",
               all(np.min(np.abs(found - f)) < 1e-6 * f for f in nearest), found)
    # pinned at both ends: a mode of n half waves crosses the axis n - 1 times, and its sense of
    # whirl is that of its row
    with h5py.File("window/campbell.h5") as results:
        shapes = results["shapes"]
        length = results["profile/s"][-1]
        x = results["profile/s"][:] / length
        for i in range(len(shapes["mode"])):
            shape = shapes["real"][i] + 1j * shapes["imaginary"][i]
            u, v = shape[:, 0], shape[:, 1]
            if np.max(np.abs(shape[:, :2])) < 1e-3:
                continue  # axial or torsional
            waves = 1 + np.sum(
                np.diff(np.sign(u[1:-1].real if np.max(np.abs(u.real)) > 0.1 else v[1:-1].real)) !=
                0)
            sine = np.sin(waves * np.pi * x)
            expect(
                f"shape {i + 1}: {waves} half waves of a sine, at most 1",
                np.max(np.abs(np.abs(u) - np.abs(u).max() * np.abs(sine))) < 2e-3
                and abs(np.max(np.abs(shape[:, :2])) - 1) < 1e-9)
            if abs(shapes["whirl"][i]) > 0.5:
                expect(f"shape {i + 1}: its whirl is that of its motion",
                       np.sign(np.sum(np.imag(u * np.conj(v)))) == np.sign(shapes["whirl"][i]))
    empty = run("campbell", "wide.xml", "empty", "Campbell/Lowest Frequency=0.1 Hz",
                "Campbell/Highest Frequency=1 Hz")
    expect("window: an empty one says so", "The window of frequencies contains no vibrating mode"
           in empty.stdout + empty.stderr, empty.stderr)


def excitations():
    """Blades, motor and lobes are separate lines with order and offset; critical speeds of the
    overhung disc with them."""
    run("campbell", "overhung.xml", "motor", "Campbell/Blades=5", "Campbell/Motor Speed=20",
        "Campbell/Motor Lobes=4", "Campbell/Orders={}")
    with h5py.File("motor/campbell.h5") as results:
        names = [name.decode() for name in results["excitations"][:]]
        expect("excitations: bit, blades, motor", names == ["bit", "blades", "motor"]
               and np.allclose(results["orders"][:], [1, 5, 0]), names)
        close("excitations: offsets", 2 * np.pi * results["offsets"][:],
              np.array([20.0, 100.0, 80.0]), 1e-12)
    met = table("motor", "crossings")
    close("excitations: a mode has the frequency of the excitation at a critical speed",
          2 * np.pi * met["frequency"], met["order"] * met["speed"] + 2 * np.pi * met["offset"],
          1e-8)
    expect("excitations: bit and blades meet modes", {1.0, 5.0} <= set(met["order"]), met["order"])


def pinned_hz(young, rho, radius, length, waves):
    """Frequencies of a slender pinned beam [Hz]."""
    return np.array([(n * np.pi / length)**2 * np.sqrt(young * radius**2 / (4 * rho)) / (2 * np.pi)
                     for n in waves])


def bending():
    """Bending moment of a slender pinned beam under a harmonic force at its middle: closed form
    along the beam, limit at rest F x/2, reduced model within its estimate."""
    force, length, radius, middle = 10.0, 2.0, 0.005, 21
    loads = lists(
        "Loads",
        lists("middle", values(Node=middle, Component="u", Value=force)) +
        lists("across", values(Node=middle, Component="v", Value=force, Phase="90 deg")))
    response = lists(
        "Response",
        values(Excitation="Harmonic", Highest_Frequency=40.0, Points=21) + loads +
        lists("Outputs", lists("middle", values(Node=middle, Component="u"))))
    reduction = lists("Substructures", values(Rule="By length", Length=0.5)) + lists(
        "Damping", values(Mass_Coefficient=6.0)) + lists("Reduction",
                                                         lists("Mode Selection", values(Modes=6)))
    text = SHAFT.replace('name="Outer Radius" type="double" value="0.1"',
                         f'name="Outer Radius" type="double" value="{radius}"')
    text = text[:text.rindex("</ParameterList>")] + lists("Contact", values(Stiffness=1e7)) + lists(
        "Loads", values(Gravity=0.0)) + response
    pathlib.Path("bending.xml").write_text(text + "</ParameterList>", encoding="utf-8")
    pathlib.Path("bending_reduced.xml").write_text(text + reduction + "</ParameterList>",
                                                   encoding="utf-8")
    run("response", "bending.xml", "bending")
    young, _, rho = material()
    area, inertia = np.pi * radius**2, np.pi * radius**4 / 4
    with h5py.File("bending/response.h5") as results:
        depth, moments, frequency = results["bending/depth"][:], results[
            "bending/moments"][:], results["response/frequency"][:]
        at_middle = int(np.flatnonzero(results["margins/node"][:] == middle)[0])
        left = results["margins/gap"][at_middle] - results["margins/margins"][:, at_middle]
    x = np.minimum(depth, length - depth)
    for row, f in enumerate(frequency):
        # E I w'''' = rho A omega^2 w, w = w'' = 0 at the ends, w' = 0 and a shear force F/2 in the
        # middle
        k = (rho * area * (2 * np.pi * f)**2 / (young * inertia))**0.25
        exact = force / 2 * x if k == 0 else np.abs(
            force / (4 * k) *
            (np.sin(k * x) / np.cos(k * length / 2) + np.sinh(k * x) / np.cosh(k * length / 2)))
        if f == 0.0:
            close("bending: at rest F x/2 from the ends to the middle", moments[row], exact, 1e-9)
        elif np.min(np.abs(f - pinned_hz(young, rho, radius, length, (1, 3)))) > 0.5:
            close(f"bending: along the beam at {f:g} Hz", moments[row], exact,
                  4e-3)  # means over the elements, 40 in all
    rows = table("bending", "response")
    close("bending: the largest of the table is that along the beam", rows["bending_moment"],
          moments.max(axis=1), 1e-12)
    largest = table("bending", "bending")
    close("bending: stress M R/I", largest["stress"], largest["moment"] * radius / inertia, 1e-12)
    close(
        "bending: forces a quarter period apart move the middle in a circle, which takes its "
        "radius from the gap", left, rows["middle_amplitude"], 1e-9)
    run("response", "bending_reduced.xml", "bending_reduced")
    checks = table("bending_reduced", "spot_checks_string")
    for name, rounding in (("moment", 1e-9), ("margin", 1e-12)):
        error, estimate = checks[name + "_error"], checks[name + "_estimate"]
        expect(
            f"bending, reduced: errors of the {name} up to {error.max():.1e} are those estimated",
            np.all(error <= 1.5 * estimate + rounding) and np.all(estimate <= 2 * error + rounding),
            np.c_[error, estimate])
    expect("bending, reduced: there is an error to estimate", checks["moment_error"].max() > 1e-6,
           checks["moment_error"])
    done = tooljoint("report", "bending_reduced", "--output", "bending.html")
    expect(
        "bending: a report of the folder", done.returncode == 0
        and "Bending moment beside that at rest"
        in pathlib.Path("bending.html").read_text(encoding="utf-8"), done.stderr)
