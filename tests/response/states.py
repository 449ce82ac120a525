# SPDX-License-Identifier: BSD-3-Clause
"""Campbell diagrams whose static state depends on the speed: a shaft under the weight of a cutting
bit, strings on the wall, and a shaft with an unchanged state."""
import pathlib

import numpy as np

from scenes import (RPM, SHAFT, SHORTER, SOURCES, close, estimates, expect, lists, material,
                    modes_at, run, table, tooljoint, values)

EACH = "Campbell/Static State=Each Speed"


def shaft():
    """If nothing depends on the speed, the diagram equals that of a single state."""
    pathlib.Path("states_shaft.xml").write_text(SHAFT, encoding="utf-8")
    run("campbell", "states_shaft.xml", "states_shaft_one")
    run("campbell", "states_shaft.xml", "states_shaft_each", EACH)
    one, each = table("states_shaft_one", "campbell"), table("states_shaft_each", "campbell")
    for name in ("speed", "mode", "frequency", "whirl"):
        close(f"each speed, nothing changes: {name}", each[name], one[name], 1e-9)
    close("each speed, nothing changes: critical speeds",
          table("states_shaft_each", "crossings")["speed"],
          table("states_shaft_one", "crossings")["speed"], 1e-6)


def bit():
    """A pinned shaft between a block that moves at v and a cutting bit of n blades: the weight W =
    n a zeta eps d with d = 2 pi v/(n Omega) per blade compresses it, so its frequencies rise with
    the speed: (rho S + rho I q^2) w_f w_b = E I q^4/(1 + phi) - W q^2 of forward and backward
    whirl."""
    length, radius, blades, speed, zeta, energy = 20.0, 0.1, 3, 0.01, 0.6, 60e6
    loads = lists("Loads", values(Gravity=0.0)) + lists("Top Drive", values(Block_Speed=speed))
    law = lists(
        "Bit",
        values(Law="Cutting") +
        lists("Cutting",
              values(Radius=radius, Blades=blades, Inclination=zeta, Specific_Energy=energy)))
    text = SHAFT.replace('name="Length" type="double" value="2"',
                         f'name="Length" type="double" value="{length}"').replace(
                             'value="4000"', 'value="20"').replace('value="{1}"', 'value="{1, 2}"')
    text = text.replace(
        'name="Highest Speed"',
        'name="Lowest Speed" type="double" value="4"/><Parameter name="Highest Speed"')
    pathlib.Path("states_bit.xml").write_text(
        text[:text.rindex("</ParameterList>")] + loads + law + "</ParameterList>", encoding="utf-8")
    run("campbell", "states_bit.xml", "states_bit", EACH, "Campbell/Points=5")
    young, nu, rho = material()
    area, inertia, shear = np.pi * radius**2, np.pi * radius**4 / 4, young / (2 * (1 + nu))
    rows, states, met = table("states_bit",
                              "campbell"), table("states_bit",
                                                 "states"), table("states_bit", "crossings")
    weight = blades * radius * zeta * energy * 2 * np.pi * speed / (blades * states["speed"])
    close(f"each speed, bit: weights on bit {np.round(weight)} N", -states["last_axial_force"],
          weight, 1e-8)

    def product(waves, load):
        q = waves * np.pi / length
        return (young * inertia * q**4 /
                (1 + young * inertia * q**2 /
                 (0.9 * shear * area)) - load * q**2) / (rho * area + rho * inertia * q**2)

    for at, load in zip(states["speed"], weight):
        pairs = np.sort(2 * np.pi * modes_at(rows, at)["frequency"]).reshape(-1, 2)
        found = pairs[:, 0] * pairs[:, 1]
        exact = np.array([product(waves, load) for waves in range(1, len(found) + 1)])
        # the rest is due to torque, and to shear in the mass matrix; the weight itself is 7 % of
        # the first frequency at 4 rad/s
        expect(f"each speed, bit at {at:g} rad/s: {np.sqrt(found)} rad/s",
               np.max(np.abs(found / exact - 1)) < 2e-4, np.sqrt(exact))
    rise = modes_at(rows, 20.0)["frequency"][0] / modes_at(rows, 4.0)["frequency"][0]
    expect(f"each speed, bit: the first frequency rises by {rise:.3f}", rise > 1.05)
    for order in (1.0, 2.0):
        here = met["speed"][met["order"] == order]
        expect(f"each speed, bit: two critical speeds of order {order:g}", len(here) == 2, here)
        exact = product(
            order, blades * radius * zeta * energy * 2 * np.pi * speed / (blades * np.mean(here)))
        close(f"each speed, bit: critical speeds of order {order:g}", order**2 * here[0] * here[1],
              exact, 2e-4)
    expect("each speed, bit: critical speeds are refined", np.all(met["refined"] == 1))
    driller = [
        "!Top Drive/Block Speed", "Top Drive/Autodriller/Weight On Bit=1 MN",
        "Top Drive/Autodriller/Proportional Gain=1e-7", "Top Drive/Autodriller/Integral Gain=1e-8",
        "Supports/Top=u v theta_z", "Transient/End Time=1", "Campbell/Points=3",
        "Campbell/Highest Speed=40", EACH
    ]
    done = tooljoint(
        "campbell", "states_bit.xml", "--output", "refused",
        *(word for one in driller
          for word in (("--without", one[1:]) if one.startswith("!") else ("--set", one))))
    expect("each speed: a weight that is not reached at one of them", done.returncode == 2
           and "at 382 rpm" in done.stderr, f"{done.returncode} {done.stderr[-300:]}")


def wall():
    """The reference scene with half of its string and friction that weakens with the speed,
    reduced: at each speed the modes are those of a deck that turns at this speed from the start;
    spot checks; ranks."""
    scene = str(SOURCES / "xml/helical_170m.xml")
    settings = [
        f"Drillstring/Assembly={SHORTER}", "!Path/Pre-stress", "Static/Friction=Sliding Speed",
        "Rotary Speed/Law=Constant", "Contact/Friction/Regularisation Velocity=0.5",
        "Campbell/Lowest Speed=20 rpm", "Campbell/Highest Speed=120 rpm", "Campbell/Points=2",
        "Campbell/Modes=4", "Campbell/Friction=Sliding", "Campbell/Orders={}"
    ]
    run("campbell", scene, "states_wall", *settings, "Rotary Speed/Constant/Speed=60 rpm",
        "Campbell/Spot Checks=2", EACH)
    estimates("states_wall")
    rows, states = table("states_wall", "campbell"), table("states_wall", "states")
    rubbing = states["top_torque"] - states["last_torque"]
    expect("each speed, wall: the torque of friction follows the speed",
           np.ptp(rubbing) > 0.01 * np.max(np.abs(rubbing)), rubbing)
    for rpm in (20, 120):
        folder = f"states_wall_{rpm}"
        run("campbell", scene, folder, *settings, f"Rotary Speed/Constant/Speed={rpm} rpm",
            "Campbell/Spot Checks=0")
        alone, here = modes_at(table(folder, "campbell"), rpm * RPM), modes_at(rows, rpm * RPM)
        for name in ("frequency", "damping"):
            apart = [np.min(np.abs(here[name] - value)) for value in alone[name]]
            expect(f"each speed, wall: {name} at {rpm} rpm is that of the deck that turns at it",
                   np.max(apart) < 1e-7 * np.max(np.abs(alone[name])), (alone[name], here[name]))
    run("campbell", scene, "states_wall_2", *settings, "Rotary Speed/Constant/Speed=60 rpm",
        "Campbell/Spot Checks=0", EACH, ranks=2)
    close("each speed, wall: two ranks give the same table",
          table("states_wall_2", "campbell")["frequency"], rows["frequency"], 1e-8)


def drive():
    """A torque at the end of a shaft turned by a PI controller: G J theta'' = -rho J omega^2 theta,
    G J theta'(0) = Z theta(0) with Z = K_i + i omega K_p - omega^2 I. The deck has no motion."""
    length, radius, inertia, proportional, integral = 2000.0, 0.06, 1500.0, 800.0, 300.0
    sweep = lists("Loads", lists("t", values(Node=201, Component="theta_z"))) + lists(
        "Outputs",
        lists("bit", values(Node=201, Component="theta_z")) +
        lists("top", values(Node=1, Component="theta_z")))
    added = (lists(
        "Top Drive",
        values(Control="Speed", Inertia=inertia, Proportional_Gain=proportional,
               Integral_Gain=integral)) + lists(
                   "Response",
                   values(Excitation="Transfer", Rotary_Speed=1.0, Lowest_Frequency="0 Hz",
                          Highest_Frequency="1.1 Hz", Points=23) + sweep))
    text = SHAFT.replace('name="Length" type="double" value="2"',
                         f'name="Length" type="double" value="{length}"').replace(
                             'value="40"', 'value="200"').replace('value="0.1"',
                                                                  f'value="{radius}"')
    text = text.replace(
        'name="Supports">',
        'name="Supports"><Parameter name="Dofs" type="string" value="torsional"/>').replace(
            'value="u v w theta_z"', 'value="none"').replace('value="u v"', 'value="none"')
    pathlib.Path("states_drive.xml").write_text(
        text[:text.rindex("</ParameterList>")] + added + "</ParameterList>", encoding="utf-8")
    run("response", "states_drive.xml", "states_drive")
    rows = table("states_drive", "response")
    young, nu, rho = material()
    shear, polar, omega = young / (2 *
                                   (1 + nu)), np.pi * radius**4 / 2, 2 * np.pi * rows["frequency"]
    k = np.maximum(omega, 1e-9) * np.sqrt(rho / shear)
    slope = (integral + 1j * omega * proportional - omega**2 * inertia) / (
        shear * polar * k)  # b/a of theta = a cos(k x) + b sin(k x)
    top = 1 / (shear * polar * k * (slope * np.cos(k * length) - np.sin(k * length)))
    for name, exact in (
        ("top", top),
        ("bit", top * (np.cos(k * length) + slope * np.sin(k * length))),
    ):
        found = rows[f"{name}:t_amplitude"] * np.exp(1j * rows[f"{name}:t_phase"])
        expect(
            f"response of a shaft on a PI drive, {name}: {np.abs(found / exact - 1).max():.1e} "
            "from theory",
            np.abs(found / exact - 1).max() < 1e-3, np.c_[rows["frequency"],
                                                          np.abs(found),
                                                          np.abs(exact)])


def refusals():
    done = tooljoint("campbell", "laval.xml", "--output", "refused", "--set", EACH)
    expect("refused: each speed of parts", done.returncode == 2
           and "the same at all speeds" in done.stderr, f"{done.returncode} {done.stderr[-400:]}")


def states():
    for check in (shaft, bit, drive, refusals):
        check()
