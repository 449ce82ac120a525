# SPDX-License-Identifier: BSD-3-Clause
"""Results of parts: lengths, positions, forces of connectors, released joints."""
import json
import xml.etree.ElementTree as xml

import h5py
import numpy as np

from checks import expect
from datasets import ROOT, check_datasets, check_motion, near, run, table


def parameter(name, kind, value):
    return xml.Element("Parameter", name=name, type=kind, value=value)


def connector(name, *parameters):
    entry = xml.Element("ParameterList", name=name)
    entry.extend(parameters)
    return entry


def parts_deck():
    """The frame with a spring, a stop, a sliding stop and a slider between its arm and the
    ground."""
    source = ROOT / "tests" / "study" / "frame.xml"
    scene = xml.parse(source)
    root = scene.getroot()
    root.remove(next(child for child in root if child.get("name") == "Study"))
    for file in root.iter("Parameter"):
        if file.get("name") == "File":
            file.set("value", str((source.parent / file.get("value")).resolve()))
    tip = parameter("First", "string", "arm:5")
    stiff = [
        parameter("Gap", "double", "-1e-5"),
        parameter("Stiffness", "double", "1e5"),
        parameter("Smoothing", "double", "1e-6")
    ]
    coupling = xml.SubElement(root, "ParameterList", name="Coupling")
    for kind, entry in [
        ("Springs",
         connector("brace", tip, parameter("Component", "string", "w"),
                   parameter("Stiffness", "double", "1e4"), parameter("Damping", "double", "10"))),
        ("Stops", connector("plug", tip, parameter("Component", "string", "v"), *stiff)),
        ("Sliders",
         connector("brake", tip, parameter("Component", "string", "w"),
                   parameter("Force", "double", "20"))),
    ]:
        xml.SubElement(coupling, "ParameterList", name=kind).append(entry)
    coupling[1].append(
        connector("bumper", tip, parameter("Direction", "Array(double)", "{1, 0, 0}"), *stiff,
                  parameter("Friction", "double", "0.2")))
    scene.write("parts.xml")
    return "parts.xml"


def check_parts(rows, written):
    folder = run(parts_deck(), "parts",
                 "Output/Fields={displacement, velocity, acceleration, normal_force}",
                 "Transient/Sampling Interval=0.001")
    with h5py.File(folder / "results.h5") as file:
        time = file["/transient/time"][:]
        names = [
            name.decode() if isinstance(name, bytes) else name
            for name in file["/model/components"][:]
        ]
        sizes = {
            "n": len(file["/model/part"]), "r": len(file["/model/part"]), "m": len(time),
            "c": len(names)
        }
        check_datasets("parts", file, rows, sizes, written)
        check_motion("parts", file, 0.03, 0.3)
        check_places(file)
        arm = [n.decode() if isinstance(n, bytes) else n
               for n in file["/model/part_names"][:]].index("arm") + 1
        tip = np.flatnonzero((file["/model/part"][:] == arm) & (file["/model/node"][:] == 5))[0]
        d, v = (file[f"/transient/{name}"][:, tip, names.index("w")]
                for name in ("displacement", "velocity"))
        near("parts: the spring force", np.ravel(file["/transient/brace/spring_force"][:]),
             -1e4 * d - 10 * v, 1e-9)
        brake = np.ravel(file["/transient/brake/friction_force"][:])
        expect("parts: the slider brakes",
               np.all(brake * v <= 0) and 10 < np.abs(brake).max() <= 20)
        gap = np.ravel(file["/transient/plug/stop_gap"][:])
        near("parts: the gap of a stop", gap,
             file["/transient/displacement"][:, tip, names.index("v")] - 1e-5, 1e-9)
        expect("parts: stops push",
               np.ravel(file["/transient/plug/stop_force"][:])[gap < 0].min() > 0)
        check_parts_figures(
            json.loads(
                (folder / "summary.json").read_text(encoding="utf-8"))["transient"]["figures"],
            file, names)
        largest = np.abs(file["/transient/displacement"][:]).max(axis=1)
    motion = table(folder / "motion.csv", ["time [s]"] +
                   [f"max_{name} [{'rad' if name.startswith('theta') else 'm'}]" for name in names])
    for c, name in enumerate(names):
        near(f"parts: motion.csv: max_{name}", motion[f"max_{name}"], largest[:, c], 1e-12)


def check_parts_figures(figures, file, names):
    """Norms of displacements and accelerations of the nodes over the second half of the motion."""
    time = file["/transient/time"][:]
    window = time > 0.5 * (time[0] + time[-1]) - 1e-9
    lengths = [c for c, name in enumerate(names) if not name.startswith("theta")]
    for field in ("displacement", "acceleration"):
        size = np.linalg.norm(file[f"/transient/{field}"][window][:, :, lengths], axis=2)
        near(f"parts: figures: {field} rms of the nodes", file[f"/figures/{field}_rms"][:],
             np.sqrt(np.mean(size**2, axis=0)), 1e-9)
        near(f"parts: figures: {field} peak of the nodes", file[f"/figures/{field}_peak"][:],
             size.max(axis=0), 1e-9)
        near(f"parts: figures: {field}", [figures[field]["rms"], figures[field]["peak"]],
             [np.sqrt(np.mean(size**2)), size.max()], 1e-9)
        worst = np.argmax(size.max(axis=0))
        part = file["/model/part_names"][file["/model/part"][worst] - 1]
        expect(
            f"parts: figures: place of the largest {field}",
            figures[field]["peak_part"] == (part.decode() if isinstance(part, bytes) else part)
            and figures[field]["peak_node"] == file["/model/node"][worst])
    force = {
        name: np.maximum(file[f"/transient/{name}/stop_force"][window].reshape(window.sum()), 0)
        for name in ("plug", "bumper")
    }
    for name, values in force.items():
        near(f"parts: figures: force and duty of the {name}", [
            file[f"/figures/{name}/contact_{key}"][0]
            for key in ("duty", "force_mean", "force_peak")
        ], [np.mean(values > 0), values.mean(), values.max()], 1e-9)
    found = figures["contact"]
    near("parts: figures: contact of all stops",
         [found["duty"], found["total_force_mean"], found["force_peak"]], [
             np.mean([values > 0 for values in force.values()]),
             sum(values.mean() for values in force.values()),
             max(values.max() for values in force.values())
         ], 1e-9)
    expect("parts: figures: the stop with the largest force",
           found["force_peak_stop"] == max(force, key=lambda name: force[name].max()))
    expect("parts: figures: stops close and open", 0 < found["duty"] < 1, str(found["duty"]))


def check_places(file):
    """Positions of the frame as in its deck: beams of 4 m along x, an arm of 1.5 m along y, columns
    of 3 m upright."""
    position, links = file["/model/position"][:], file["/model/links"][:]
    expect("parts: every node has its place",
           file["/model/located"][:].tolist() == list(range(1,
                                                            len(file["/model/part"]) + 1)))
    lengths = np.linalg.norm(position[links[:, 0] - 1] - position[links[:, 1] - 1], axis=1)
    near("parts: edges have the lengths of elements", np.unique(lengths.round(9)), [0.375, 0.5],
         1e-9)
    ends = position.max(axis=0) - position.min(axis=0)
    near("parts: the frame has its size", ends, [4, 1.5, 3], 1e-9)
    expect("parts: joined nodes are one",
           len(np.unique(position.round(6), axis=0)) == len(position))


def check_released(rows, written):
    """Below a partly released joint, nodes have the motion of the part above: bending there is that
    of the next element."""
    folder = run(ROOT / "tests" / "effects" / "coupling.xml", "released", "Transient/End Time=0.05",
                 "Output/Figures/Begin=0")
    with h5py.File(folder / "results.h5") as file:
        below = file["/model/elements_below_releases"][:]
        nodes = len(file["/model/s"])
        check_datasets(
            "released joints", file, rows, {
                "n": nodes, "r": nodes, "e": nodes - 1, "m": len(file["/transient/time"]), "p": len(
                    file["/xdmf/time"]), "j": 2
            }, written)
        expect("a hinge at node 5, a slide at node 9", list(below) == [5, 9], below)
        for figure in ("bending_range", "bending_cycles"):
            values = file[f"/figures/{figure}"][:]
            expect(f"{figure} below them is that of the next element",
                   list(values[below - 1]) == list(values[below]) and values[below].min() > 0,
                   values[:11])
