#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Files of a run agree with docs/file-formats.md: check_results.py PROGRAM

Every dataset has the shape and the unit of its row in the table, and every row is written by at
least one run. Velocities are rates of displacements, contact forces are those of the law, tables
and summary agree with the datasets, pictures show the motion in the global frame. The runs are
tests/effects/scene.xml (a string) and tests/study/frame.xml with springs, stops and a slider
(parts).
"""
import json
import pathlib
import sys

import h5py
import numpy as np

import documented

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from checks import expect, finish  # noqa: E402
from datasets import ROOT, check_datasets, check_motion, near, run, table  # noqa: E402
from parts_results import check_parts, check_released  # noqa: E402


def check_string(rows, written):
    folder = run(ROOT / "tests" / "effects" / "scene.xml", "string",
                 "Output/Fields={displacement, velocity, acceleration, normal_force}",
                 "Output/Reduced Bases=true", "Output/XDMF=true", "Output/XDMF Interval=0.05",
                 "Transient/Sampling Interval=0.001", "Output/Figures/S-N Line/Slope=4",
                 "Output/Figures/S-N Line/Stress Range=100 MPa",
                 "Output/Figures/S-N Line/Cycles=1e6", "Output/Figures/Stuck Speed=12")
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    with h5py.File(folder / "results.h5") as file:
        nodes = len(file["/model/s"])
        samples = len(file["/transient/time"])
        pictures = len(file["/xdmf/time"])
        check_datasets("string", file, rows,
                       {"n": nodes, "r": nodes, "e": nodes - 1, "m": samples, "p": pictures},
                       written)
        data = {}
        file.visititems(lambda name, item: data.update({"/" + name: item[:]})
                        if isinstance(item, h5py.Dataset) else None)
        check_motion("string", file, 0.03, 0.3)
    near("samples stand at multiples of the interval", data["/transient/time"],
         1e-3 * np.arange(301), 1e-12)
    near("the rotary speed is that of the deck", data["/transient/speed"],
         4 * np.pi * (1 - np.exp(-data["/transient/time"] / 0.1)), 1e-12)
    near("the motion starts in the static state", data["/transient/displacement"][0],
         data["/static/displacement"], 1e-12)
    check_geometry(data)
    check_contact(data)
    check_tables(folder, data)
    check_summary(summary, data)
    check_figures(summary["transient"]["figures"], folder, data)
    check_bending(summary["transient"]["figures"], data)
    check_pictures(data)


def check_geometry(data):
    frames, position = data["/model/frame"], data["/model/position"]
    near("nodal frames are orthonormal", np.einsum("nij,nik->njk", frames, frames),
         np.broadcast_to(np.eye(3), frames.shape), 1e-12)
    chord = np.diff(position, axis=0) / np.diff(data["/model/s"])[:, None]
    mean = 0.5 * (frames[:-1, :, 2] + frames[1:, :, 2])
    near("the third axis of a frame points along the well", mean, chord, 5e-3)
    expect("depth grows along Z", np.all(np.diff(position[:, 2]) > 0))
    near("the path ends on the axis of the well", data["/path/position"], position, 1e-4)
    # bore 0.109 m down to 10 m, 0.108 m below; outer radius 0.0635 m (pipe, to 18 m), 0.0795 m;
    # gauge 0.107 m at the bit
    s = data["/model/s"]
    bore, body = np.where(s < 10, 0.109, 0.108), np.where(s < 18, 0.0635, 0.0795)
    clearance, radius = bore - body, body
    clearance[-1], radius = 0.001, np.append(body[:-1], 0.107)
    near("clearances are those of bore and body", data["/model/clearance"], clearance, 1e-9)
    near("lever arms are the radii of what touches", data["/model/contact_radius"], radius, 1e-9)
    # 2 pipes and 3 collars of 4 elements, a bit
    outer, inner = np.repeat([0.0635, 0.0795], [8, 13]), np.repeat([0.054, 0.0355], [8, 13])
    near("outer radii", data["/model/outer_radius"], outer, 1e-12)
    near("inner radii", data["/model/inner_radius"], inner, 1e-12)
    near("areas", data["/model/area"], np.pi * (outer**2 - inner**2), 1e-12)
    near("torsion constants", data["/model/torsion_constant"], np.pi / 2 * (outer**4 - inner**4),
         1e-12)
    near("Young's moduli", data["/model/young_modulus"], np.full(21, 206e9), 1e-12)
    near("shear moduli", data["/model/shear_modulus"], np.full(21, 206e9 / 2.6), 1e-12)
    near("components of the elements", data["/model/component"], np.repeat([1, 2, 3], [8, 12, 1]),
         0)
    names = [
        name.decode() if isinstance(name, bytes) else name
        for name in data["/model/component_names"]
    ]
    expect("entries of the assembly", names == ["pipe", "collar", "bit"], names)


def check_contact(data):
    """F_n = (2 k/pi) atan(pi lambda G) G, G = r - clearance > 0 (the law Clamped at rest), with the
    stiffness of the depth interval."""
    s, d = data["/model/s"], data["/static/displacement"]
    penetration = np.hypot(d[:, 0], d[:, 1]) - data["/model/clearance"]
    stiffness = np.where((s >= 12) & (s < 62), 1.2e7, 1e7)
    law = np.where(penetration > 0,
                   2 * stiffness / np.pi * np.arctan(np.pi * 1e6 * penetration) * penetration, 0.0)
    law[[0, -1]] = 0.0  # held ends
    near("static normal forces follow the contact law", data["/static/normal_force"], law, 1e-9)
    near("the motion starts with the static normal forces", data["/transient/normal_force"][0],
         data["/static/normal_force"], 1e-6)
    expect(
        "friction holds the string back",
        np.all(data["/static/tangential_force"] <= 0)
        and data["/static/tangential_force"].min() < -1)
    near("friction torque is friction force times its lever arm", data["/static/friction_torque"],
         data["/static/tangential_force"] * data["/model/contact_radius"], 1e-9)


def check_tables(folder, data):
    nodes = table(folder / "static_nodes.csv", [
        "node", "s [m]", "u [m]", "v [m]", "w [m]", "theta_z [rad]", "r [m]", "clearance [m]",
        "normal_force [N]", "tangential_force [N]", "friction_torque [N m]"
    ])
    d = data["/static/displacement"]
    expect("nodes count from 1", list(nodes["node"]) == list(range(1, len(d) + 1)))
    for name, values in [("s", data["/model/s"]), ("u", d[:, 0]), ("v", d[:, 1]), ("w", d[:, 2]),
                         ("theta_z", d[:, 5]), ("r", np.hypot(d[:, 0], d[:, 1])),
                         ("clearance", data["/model/clearance"]),
                         ("normal_force", data["/static/normal_force"]),
                         ("tangential_force", data["/static/tangential_force"]),
                         ("friction_torque", data["/static/friction_torque"])]:
        near(f"static_nodes.csv: {name}", nodes[name], values, 1e-12)
    elements = table(folder / "static_elements.csv", [
        "element", "s [m]", "axial_force [N]", "torque [N m]", "path_axial_force [N]",
        "path_torque [N m]"
    ])
    near("static_elements.csv: s", elements["s"],
         0.5 * (data["/model/s"][1:] + data["/model/s"][:-1]), 1e-12)
    for name, values in [
        ("axial_force", data["/static/axial_force"]),
        ("torque", data["/static/torque"]),
        ("path_axial_force", data["/path/axial_force"]),
    ]:
        near(f"static_elements.csv: {name}", elements[name], values, 1e-12)
    motion = table(
        folder / "motion.csv",
        ["time [s]", "rotary_speed [rad/s]", "bit_speed [rad/s]", "bit_w [m]", "bit_theta_z [rad]"])
    bit = data["/transient/displacement"][:, -1]
    for name, values in [("time", data["/transient/time"]),
                         ("rotary_speed", data["/transient/speed"]), ("bit_speed", bit_speed(data)),
                         ("bit_w", bit[:, 2]), ("bit_theta_z", bit[:, 5])]:
        near(f"motion.csv: {name}", motion[name], values, 1e-12)


def bit_speed(data):
    """Omega + dtheta_z/dt of the last node."""
    return data["/transient/speed"] + data["/transient/velocity"][:, -1, 5]


def check_summary(summary, data):
    s, d = summary["static"], data["/static/displacement"]
    normal, axial = data["/static/normal_force"], data["/static/axial_force"]
    penetration = (np.hypot(d[:, 0], d[:, 1]) - data["/model/clearance"])[1:-1]
    for key, value in [
        ("top_axial_force", axial[0]),
        ("last_element_axial_force", axial[-1]),
        ("last_element_torque", data["/static/torque"][-1]),
        ("top_torque", data["/static/torque"][0]),
        ("max_normal_force", normal.max()),
        ("max_normal_force_node", np.argmax(normal) + 1),
        ("total_normal_force", normal.sum()),
        ("contact_nodes", np.sum(penetration > 0)),
        ("compressed_elements", np.sum(axial < 0)),
    ]:
        near(f"summary: static.{key}", s[key], value, 1e-9)
    t, rpm = summary["transient"], 30 / np.pi * bit_speed(data)
    for key, value in [("min", rpm.min()), ("max", rpm.max()), ("mean", rpm.mean())]:
        near(f"summary: transient.bit_speed_rpm.{key}", t["bit_speed_rpm"][key], value, 1e-9)
    moving = data["/transient/displacement"][:, 1:-1]
    deepest = (np.hypot(moving[:, :, 0], moving[:, :, 1]) - data["/model/clearance"][1:-1]).max()
    near("summary: transient.max_penetration", t["max_penetration"], deepest, 1e-9)
    near("summary: model.length", summary["model"]["length"], data["/model/s"][-1], 1e-12)


def check_figures(figures, folder, data):
    """Compares figures of merit with the histories of the same run over the second half of the
    motion."""
    time = data["/transient/time"]
    window = time > 0.15 - 1e-9
    near("figures: window", data["/figures/window"], [0.15, 0.3], 1e-9)
    expect("figures: samples", figures["samples"] == np.count_nonzero(window), figures["samples"])
    omega = bit_speed(data)[window]
    index = (omega.max() - omega.min()) / (2 * omega.mean())
    for key, value in [
        ("stick_slip_index", index),
        ("stuck_share", np.mean(np.abs(omega) < 12.0)),
        ("stuck_speed_rpm", 12.0 * 30 / np.pi),
    ]:
        near(f"figures: {key}", figures[key], value, 1e-9)
    d, v, a = (data[f"/transient/{name}"][window]
               for name in ("displacement", "velocity", "acceleration"))
    nodes = table(folder / "figures_nodes.csv", [
        "node", "s [m]", "axial_rms [m/s2]", "axial_peak [m/s2]", "lateral_rms [m/s2]",
        "lateral_peak [m/s2]", "precession [rad/s]", "forward_share", "backward_share",
        "forward_contact_share", "backward_contact_share", "contact_duty", "contact_force_mean [N]",
        "contact_force_peak [N]"
    ])
    for name, size in [
        ("axial", np.abs(a[:, :, 2])),
        ("lateral", np.hypot(a[:, :, 0], a[:, :, 1])),
    ]:
        rms = np.sqrt(np.mean(size**2, axis=0))
        near(f"figures: {name} rms", nodes[f"{name}_rms"], rms, 1e-9)
        near(f"figures: {name} peak", nodes[f"{name}_peak"], size.max(axis=0), 1e-9)
        found = figures[f"{name}_acceleration"]
        near(f"figures: {name} acceleration in the summary",
             [found["rms"], found["peak"], found["worst_rms"]],
             [np.sqrt(np.mean(size**2)), size.max(),
              rms.max()], 1e-9)
        expect(
            f"figures: worst node of the {name} acceleration",
            found["worst_rms_node"] == np.argmax(rms) + 1
            and found["worst_rms_depth"] == data["/model/s"][np.argmax(rms)])
    moment = d[:, :, 0] * v[:, :, 1] - d[:, :, 1] * v[:, :, 0]
    radius = d[:, :, 0]**2 + d[:, :, 1]**2
    total = radius.sum(axis=0)
    near("figures: precession", nodes["precession"],
         np.divide(moment.sum(axis=0), total, out=np.zeros_like(total), where=total > 0), 1e-9)
    whirls = np.abs(moment) >= 0.1 * data["/transient/speed"][window, None] * radius
    touches = data["/transient/normal_force"][window] > 0
    for name, sense in [("forward", moment > 0), ("backward", moment < 0)]:
        near(f"figures: share of {name} whirl", nodes[f"{name}_share"],
             np.mean(sense & whirls, axis=0), 1e-9)
        contact = np.mean(sense & whirls & touches, axis=0)
        expect(f"figures: {name} whirl in contact",
               np.allclose(nodes[f"{name}_contact_share"], contact, atol=1e-12))
    force = data["/transient/normal_force"][window]
    near("figures: contact duty", nodes["contact_duty"], touches.mean(axis=0), 1e-9)
    near("figures: mean contact force", nodes["contact_force_mean"],
         np.maximum(force, 0).mean(axis=0), 1e-9)
    near("figures: largest contact force", [figures["contact"]["force_peak"]], [force.max()], 1e-9)


def section_axes(data, rigidity):
    """Axes of the cross sections on the path, global: they minimise the bending energy sum 2 E I/l
    (a.a + a.b + b.b), where a and b are the angles from the chord of an element to the axes at its
    ends (a natural cubic spline through the nodes)."""
    chord = np.diff(data["/path/position"], axis=0)
    length = np.linalg.norm(chord, axis=1)
    nodes = len(length) + 1
    stiffness, load = np.zeros((nodes, nodes)), np.zeros((nodes, 3))
    for e, k in enumerate(2 * rigidity / length):
        stiffness[e:e + 2, e:e + 2] += k * np.array([[2, 1], [1, 2]])
        load[e:e + 2] += 3 * k * chord[e] / length[e]
    axis = np.linalg.solve(stiffness, load)
    return axis / np.linalg.norm(axis, axis=1)[:, None]


def check_bending(figures, data):
    """The largest range of a rainflow count is that of the whole history; the moment is E I times
    the change of the section axes."""
    time = data["/transient/time"]
    window = time > 0.15 - 1e-9
    frames, d = data["/model/frame"], data["/transient/displacement"][window]
    fourth = data["/model/outer_radius"]**4 - data["/model/inner_radius"]**4
    rigidity = data["/model/young_modulus"] * np.pi / 4 * fourth
    axis = section_axes(data, rigidity)
    moved = axis + np.cross(np.einsum("nij,tnj->tni", frames, d[:, :, 3:]), axis)
    curvature = np.diff(moved, axis=1) / np.diff(data["/model/s"])[:, None]
    mean = [0.5 * (frames[1:, :, k] + frames[:-1, :, k]) for k in (0, 1)]
    moments = [rigidity * np.einsum("tej,ej->te", curvature, across) for across in mean]
    t = time[window]
    angle = 4 * np.pi * (t - 0.1 *
                         (1 - np.exp(-t / 0.1)))[:, None] + 0.5 * (d[:, 1:, 5] + d[:, :-1, 5])
    ranges = [
        np.ptp(
            moments[0] * np.cos(angle + p * np.pi / 4) + moments[1] * np.sin(angle + p * np.pi / 4),
            axis=0) for p in range(4)
    ]
    found = data["/figures/bending_range"]
    # the worst plane is the one with the largest damage, nearly always that with the largest range
    near("figures: bending ranges", found, np.max(ranges, axis=0), 0.02)
    expect(
        "figures: the worst element", figures["bending"]["range"] == found.max()
        and figures["bending"]["range_element"] == np.argmax(found) + 1)
    # at least one cycle, or two half cycles, of the largest range
    stress = found * data["/model/outer_radius"] / (rigidity / data["/model/young_modulus"])
    least = 0.5 * (stress / 100e6)**4 / 1e6 * 3600 / (t[-1] - t[0])
    damage = data["/figures/damage_per_hour"]
    expect(
        "figures: damage",
        np.all(damage >= least * (1 - 1e-9))
        and np.all(damage <= least * 2 * (data["/figures/bending_cycles"] + 1)))


def check_pictures(data):
    """Vectors of the pictures are those of the samples, transformed by the nodal frames."""
    at = np.searchsorted(data["/transient/time"], data["/xdmf/time"] - 1e-9)
    frames = data["/model/frame"]
    near("pictures: displacement in the global frame", data["/xdmf/displacement"],
         np.einsum("nij,tnj->tni", frames, data["/transient/displacement"][at, :, :3]), 1e-9)
    v = data["/transient/velocity"][at]
    near("pictures: speed", data["/xdmf/speed"], np.linalg.norm(v[:, :, :3], axis=2), 1e-9)
    near("pictures: spin", data["/xdmf/spin"], data["/transient/speed"][at, None] + v[:, :, 5],
         1e-9)
    near("pictures: normal force", data["/xdmf/normal_force"], data["/transient/normal_force"][at],
         1e-9)
    near("pictures: position", data["/xdmf/position"], data["/path/position"], 1e-12)


def check_left_turn():
    """The sign of friction at rest is that of a rotation to the right, for both senses of
    rotation."""
    folder = run(ROOT / "tests" / "effects" / "scene.xml", "left",
                 "Rotary Speed/Exponential/Final Speed=-120 rpm", "Transient/End Time=0.002")
    with h5py.File(folder / "results.h5") as file:
        force, radius = file["/static/tangential_force"][:], file["/model/contact_radius"][:]
        expect("friction of a string that turns to the left is positive",
               np.all(force >= 0) and force.max() > 1)
        near("so is its torque", file["/static/friction_torque"][:], force * radius, 1e-9)
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        near("the torque at the surface has the sign of the rotation before it begins",
             file["/transient/surface_torque"][0], summary["static"]["surface_torque"], 1e-9)


def main():
    strings, parts = documented.rows("## results.h5"), documented.rows(
        "**Results of a scene of parts.**")
    written = {"string": set(), "parts": set()}
    check_string(strings, written["string"])
    check_left_turn()
    check_released(strings, written["string"])
    check_parts(parts, written["parts"])
    for title in written:  # written by tests/results/check_recorded.py
        written[title].add("/transient/node")
    for title, rows in (("string", strings), ("parts", parts)):
        expect(f"{title}: every documented dataset is written",
               set(rows) == written[title],
               sorted(set(rows) - written[title]) or "")
    return finish()


if __name__ == "__main__":
    sys.exit(main())
