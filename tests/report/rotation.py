# SPDX-License-Identifier: BSD-3-Clause
"""Signs and senses of rotations in the quantities of a report."""
import re
from unittest import mock

import numpy as np

import plots
from checks import expect
from report import figures, quantities, results
from stand_ins import Bar, Still, near


def sides():
    run = Still(1e-3)
    for node, names, first, second in (
        (0, ("north", "east"), [1, 0, 0], [0, 1, 0]),
        (1, ("high side", "right side"), [0, np.sqrt(0.75), -0.5], [-1, 0, 0]),
        (2, ("north", "east"), None, None),
    ):
        found, turned = results.sides(run, node)
        frame = run.data["/model/frame"][node]
        expect(
            f"node {node} has the sides {names}", found == names
            and np.allclose(turned @ turned.T, np.eye(2)) and np.linalg.det(turned) > 0,
            (found, turned))
        if first is not None:
            near("they point there, looking down the hole", turned @ frame[:, :2].T,
                 np.array([first, second], float), 1e-12)


def rounding():
    """Without vibration there are no orbits, spectra and whirl, and no number is minus zero."""
    figures_ = {
        "begin": 1.0, "end": 2.0, "stick_slip_index": 0.0, "stuck_share": 0.25,
        "stuck_speed_rpm": 4.77, "weight_on_bit": {"mean": 444822.16152605, "min": 4e5,
                                                   "max": 5e5}, "torque_on_bit": {"mean": None},
        "rate_of_penetration": 0.3048 / 360, "specific_energy": 6894757.293,
        "lateral_acceleration": {"rms": 1.0, "worst_rms": 2.0, "worst_rms_depth": 3.0,
                                 "peak": 4.0}, "whirl": {
                                     "worst_backward_share": 0.5, "worst_backward_share_depth": 6.0,
                                     "worst_precession_rpm": -0.2,
                                     "worst_backward_contact_share": 0.0
                                 }, "bending": {"range": None, "damage_per_hour": None}
    }
    for amplitude, moves in ((1e-10, False), (1e-3, True)):
        run = Still(amplitude, figures_)
        motion = results.Motion(run, (0, 1))
        rows = {
            name: " ".join((value, remark)) for name, value, remark in results.merits(run, motion)
        }
        drawn = [
            figure.name for part in (figures.orbits, figures.spectra)
            for figure in part(run, motion, {0: "top", 1: "middle"})
        ] + [figure.name for figure in figures.vibration(run, motion)]
        expect(f"an amplitude of {amplitude} m {'is' if moves else 'is no'} vibration",
               drawn == (["orbit-1", "orbit-2", "lateral-spectrum", "rms"] if moves else []), drawn)
        expect("and has figures of merit so", ("Backward whirl" in rows) ==
               ("Lateral acceleration" in rows) == moves ==
               (not rows["Largest lateral vibration"].startswith("none")), rows)
        expect("numbers are not minus zero",
               not any(re.search(r"-0(?![.\d])|-0\.0+(?!\d)", text) for text in rows.values()),
               rows)
        expect("the bit is stuck as the program says",
               rows["Time the bit is stuck"] == "25.0 % below 4.77 rpm", rows)
        expect("weight, penetration and energy in both units", [
            rows[key]
            for key in ("Mean weight on bit", "Rate of penetration", "Mechanical specific energy")
        ] == ["444.8 kN 100.0 klbf; 400.0 kN to 500.0 kN", "3.05 m/h 10.0 ft/h", "6.9 MPa 1.0 ksi"]
               and "Mean torque on bit" not in rows, rows)
    without = [name for name, _, _ in results.merits(run)]
    expect(
        "without displacements figures of the summary stay", "Lateral acceleration" in without
        and "Backward whirl" in without and not any("vibration" in name for name in without),
        without)
    run.summary["transient"]["figures"]["lateral_acceleration"]["worst_rms"] = 1e-9
    expect(
        "those of rounding do not", not {"Lateral acceleration", "Backward whirl"}
        & {name for name, _, _ in results.merits(run)})
    expect(
        "a table says of which time it is",
        results.times_of_merits(run, motion).startswith("Figures of 1 to 2 s (")
        and "second half of the motion, 1.00503 to 2 s" in results.times_of_merits(run, motion),
        results.times_of_merits(run, motion))
    expect("numbers that round to zero have no sign", [
        quantities.fixed(-0.04, 1),
        quantities.fixed(-1.26, 1),
        quantities.plain(-0.0),
        quantities.percent(-0.0)
    ] == ["0.0", "-1.3", "0", "0 %"])


def whirls():
    """Captions of orbits that rotate with the string and against it, to the right and to the left,
    with recorded velocities and without."""
    for speed, orbit, said in (
        (10.0, 10.0,
         "mean precession 95.5 rpm, 1.00 of the surface speed; clockwise is forward, positive"),
        (-10.0, -10.0,
         "mean precession 95.5 rpm, 1.00 of the surface speed; anticlockwise is forward, positive"),
        (-10.0, 70.0, "mean precession -668.5 rpm, -7.00 of the surface speed; anticlockwise is "
         "forward, positive"),
        (0.0, -10.0, "mean precession -95.5 rpm; clockwise is positive"),
    ):
        run = Still(1e-3, speed=speed, orbit=orbit)
        run.record_velocities(orbit)
        captions = [
            figure.caption
            for figure in figures.orbits(run, results.Motion(run, (0, 1)), {0: "top", 1: "middle"})
        ]
        expect(
            f"an orbit of {orbit} rad/s at {speed} rad/s says how it is seen and how it turns",
            len(captions) == 2
            and all(f"looking down the hole; {said};" in text for text in captions), captions)
    run = Still(1e-3, orbit=70.0)
    caption = figures.orbits(run, results.Motion(run, (0,)), {0: "top"})[0].caption
    expect(
        "without velocities it says what the samples resolve", "from displacements alone" in caption
        and "; 62.5 samples a turn of the surface" in caption, caption)
    run.speed = np.linspace(-5.0, 10.0, 200)
    expect("a rotation that changes its sense has none, in its second half it has one",
           (run.sense(), run.sense(slice(100, None)), Still(1e-3, speed=0.0).sense()) == (0, 1, 0))


def torques():
    """Torques are plotted with one sign, positive against the rotation, although the program
    records the torque on bit against a rotation to the right."""
    for sense in (1, -1):
        run = Still(
            1e-3, {
                "begin": 1.0, "end": 2.0, "torque_on_bit": {
                    "mean": sense * 2000.0,
                    "min": min(sense * 1500.0, sense * 2500.0),
                    "max": max(sense * 1500.0, sense * 2500.0),
                }
            }, sense * 10.0)
        run.speed[0] = 0.0  # at that point the surface torque is against a rotation to the right
        run.data["/transient/torque_on_bit"] = np.full(200, sense * 2000.0)
        run.data["/transient/surface_torque"] = np.where(np.arange(200) > 0, 5000.0, sense * 5000.0)
        drawn = []
        with mock.patch.object(
                plots, "envelope",
                lambda time, values, drawn=drawn: drawn.append(values) or (time, values)):
            caption = figures.surface(run)[0].caption
        near("torques at the surface and on the bit have one sign", drawn,
             np.array([np.full(200, 5.0), np.full(200, 2.0)]))
        expect("and the caption says so",
               caption.endswith("of the rock on the bit, positive against the rotation."), caption)
        row = results.figures_of_bit(run)
        expect("so has the mean torque on bit", [
            (one[1], one[2].partition("; ")[2]) for one in row
        ] == [("2.00 kN m", "1.50 kN m to 2.50 kN m; positive against the rotation")], row)


def torques_at_rest():
    """The static torque has the sign of the surface torque for both senses of rotation."""
    for sense in (1, -1):
        bar = Bar(torque=-sense * 2e3)  # resists a rotation of this sense
        bar.summary = {"static": {"surface_torque": 2e3, "top_torque": -sense * 2e3}}
        bar.value = lambda path, bar=bar: results.Run.value(bar, path)
        near("the static torque is against the rotation",
             results.static_torque(bar, results.static_sense(bar)), np.full(10, 2e3))
