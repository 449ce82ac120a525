# SPDX-License-Identifier: BSD-3-Clause
"""Reads the results of a run once, in blocks that fit into memory."""
import json
import math
import pathlib

import h5py
import numpy as np

from report.files import Unreadable, reading, unreadable
from report.quantities import both, fixed

BLOCK = 8_000_000  # numbers of a time series in memory at once
SECOND_HALF = 0.5  # statistics begin after this share of the motion, when its start has decayed
# [m], [rad], [rad/s], rms: smaller values are not vibration. Solver errors are 1e-10 to 1e-7, the
# roughness of a wall is larger.
VIBRATES = 1e-6
STEEP = math.sin(math.radians(3))  # holes closer to the vertical have no useful high side
AGAINST = {
    1: "positive against the rotation", -1: "positive against the rotation",
    0: "positive against a rotation to the right"
}  # torques, by the sense of the rotation
NONE, STILL = "none", f"less than {1e6 * VIBRATES:g} micrometre rms: rounding"
# datasets of a string that a report needs
NEEDED = ("/model/position", "/model/frame", "/model/clearance", "/model/contact_radius",
          "/model/path_curvature", "/model/curvature_of_rotations", "/static/displacement",
          "/static/normal_force", "/static/axial_force", "/static/torque")


def read_summary(folder):
    path = folder / "summary.json"
    with reading(path):
        text = path.read_text(encoding="utf-8")
    try:
        summary = json.loads(text)
    except ValueError:
        raise unreadable(path, "it is cut off, or it is no JSON") from None
    if not isinstance(summary, dict) or "status" not in summary:
        raise Unreadable(f"{path} is no summary of a run: it has no \"status\".")
    return summary


def open_results(path):
    with reading(path):
        return h5py.File(path, "r")


def texts(dataset):
    return [value.decode() if isinstance(value, bytes) else str(value) for value in dataset[:]]


class Folder:
    """Results of a command: summary.json and an HDF5 file, {} and None if they are missing."""
    def __init__(self, folder, summary, file):
        self.folder, self.summary, self.file = folder, summary, file

    def attribute(self, name, default=""):
        value = default if self.file is None else self.file.attrs.get(name, default)
        return value.decode() if isinstance(value, bytes) else value

    def value(self, path):
        """Value of the summary for keys joined by dots; None if the stage did not run."""
        found = self.summary
        for key in path.split("."):
            found = found.get(key) if isinstance(found, dict) else None
        return found

    @property
    def name(self):
        """Name of the deck."""
        return pathlib.Path(
            self.value("deck.file") or self.attribute("deck_file")
            or self.folder.resolve().name).stem


class Run(Folder):
    """results.h5 and summary.json of a run. Arrays have the shapes of docs/file-formats.md; None
    for missing ones."""
    def __init__(self, folder):
        self.path = folder / "results.h5"
        super().__init__(folder, read_summary(folder), open_results(self.path))
        self.is_string = "/model/s" in self.file
        missing = [
            name for name in (NEEDED if self.is_string else ())
            if name not in self.file and (name.startswith("/model") or "/static" in self.file)
        ]
        if missing:
            raise Unreadable(f"{self.path} has no {', '.join(missing)}: it is damaged or of "
                             "another program. Run the deck again.")
        self.s = self.get("/model/s")
        self.time = self.get("/transient/time")
        self.records = self.time is not None and len(
            self.time) > 1 and "/transient/displacement" in self.file
        chosen = self.get("/transient/node")
        self.moves = self.records and chosen is None  # the motion of all nodes is recorded
        self.recorded = np.arange(
            self.file["/static/displacement"].shape[0]
        ) if chosen is None and self.records else None if chosen is None else chosen - 1

    def get(self, path):
        dataset = self.file.get(path)
        return None if dataset is None else dataset[()]

    @property
    def middles(self):
        """Depths of the middles of the elements [m]."""
        return 0.5 * (self.s[1:] + self.s[:-1])

    def components(self):
        """Entry of the assembly of each element, or None."""
        names = self.file.get("/model/component_names")
        return None if names is None else [
            texts(names)[i - 1] for i in self.get("/model/component")
        ]

    def component_at(self, node):
        """Entry of the assembly that contains a node (from 0); the upper one where two meet."""
        names = self.components()
        return "" if names is None else names[max(0, node - 1)]

    def blocks(self, path):
        """(first sample, samples x ...) of a time series, from the start to the end."""
        data = self.file[path]
        rows = max(1, BLOCK // max(1, math.prod(data.shape[1:])))
        for first in range(0, len(data), rows):
            yield first, data[first:first + rows]

    def column(self, node):
        """Index of a node (from 0) in the motion, which may contain only chosen nodes."""
        return int(np.searchsorted(self.recorded, node))

    def frames(self, most):
        """Numbers of at most `most` samples at equal distances."""
        return np.arange(0, len(self.time), max(1, -(-len(self.time) // most)))

    def rotary(self):
        """Speed imposed at the surface [rad/s] at the samples."""
        speed = self.get("/transient/speed")
        return np.zeros(len(self.time)) if speed is None else speed

    def sense(self, samples=slice(None)):
        """Sense of the rotation in the samples: 1 to the right (clockwise looking down the hole),
        -1 to the left, 0 if it changes or nothing turns."""
        speed = self.rotary()[samples]
        return int(np.any(speed > VIBRATES)) - int(np.any(speed < -VIBRATES))

    def bit_speed(self):
        """Omega + dtheta_z/dt of the bit [rad/s] at the samples, or None."""
        motion = self.get("/transient/motion")
        return motion[:,
                      2] if self.is_string and motion is not None and motion.shape[1] == 5 else None

    def second_half(self):
        start, end = self.time[0], self.time[-1]
        return int(np.searchsorted(self.time, start + SECOND_HALF * (end - start)))


def beside_releases(run, values):
    """`values` (... x elements), with those of the next element for elements directly below
    released joints: the recorded motion of a released node is that of the part above the joint."""
    below = run.get("/model/elements_below_releases")
    if below is not None:
        values = values.copy()
        values[..., below - 1] = values[..., below]
    return values


def curvature(run, displacement):
    """Curvature of the bent string in its elements [1/m]: change of the cross-section axes from
    node to node, a' = a + theta x a, divided by the length. `displacement` is ... x nodes x 6 in
    nodal frames."""
    rotations = displacement[..., 3:6]
    both = np.concatenate((rotations[..., :-1, :], rotations[..., 1:, :]), axis=-1)
    return beside_releases(
        run,
        np.linalg.norm(
            run.get("/model/path_curvature") +
            np.einsum("eac,...ec->...ea", run.get("/model/curvature_of_rotations"), both), axis=-1))


def internal_forces(run, displacement):
    """(effective tension [N], torque [N m]) of the elements in a displacement (... x nodes x 6);
    None for results without sections.

        T = T_s + E S (w' - w_s'),  M = M_s + G J (theta_z' - theta_zs')

    s: static state."""
    if run.get("/model/young_modulus") is None or run.get("/static/axial_force") is None:
        return None
    E, G, S, J = (run.get(f"/model/{name}")
                  for name in ("young_modulus", "shear_modulus", "area", "torsion_constant"))
    change = np.diff(displacement - run.get("/static/displacement"), axis=-2)
    change /= np.diff(run.s)[:, None]
    tension, torque = (beside_releases(run, values)
                       for values in (E * S * change[..., 2], G * J * change[..., 5]))
    return run.get("/static/axial_force") + tension, run.get("/static/torque") + torque


def von_mises(run, displacement):
    """Largest von Mises stress of the elements [Pa] for a displacement (... x nodes x 6); None for
    results without sections.

        sigma^2 = (|T|/S + E kappa R)^2 + 3 (M R/J)^2

    at the outer wall, from effective tension, as for torque and drag
    (docs/guide/torque-drag.md)."""
    forces = internal_forces(run, displacement)
    if forces is None:
        return None
    E, S, J, R = (run.get(f"/model/{name}")
                  for name in ("young_modulus", "area", "torsion_constant", "outer_radius"))
    tension, torque = forces
    axial = np.abs(tension) / S + E * curvature(run, displacement) * R
    return np.sqrt(axial**2 + 3 * (torque * R / J)**2)


def static_sense(run):
    """Sense of the rotation at rest: -1 (to the left) if the surface torque in the summary has the
    sign of the torque in the first element."""
    surface, top = run.value("static.surface_torque"), run.value("static.top_torque")
    return -1 if surface and top and surface * top > 0 else 1


def static_torque(run, sense):
    """Torque of the elements at rest [N m], positive against the rotation, like the surface
    torque."""
    return -sense * run.get("/static/torque")


def lateral(run, displacement):
    """Distance of the nodes from the axis of the well [m]."""
    return np.hypot(displacement[..., 0], displacement[..., 1])


class Motion:
    """Statistics of the recorded nodes over the second half of a motion, and time histories of a
    few of them."""
    def __init__(self, run, chosen=()):
        self.run = run
        self.first = run.second_half()
        self.chosen = [run.column(node) for node in chosen]
        shape = run.file["/transient/displacement"].shape
        total, square = np.zeros(shape[1:]), np.zeros(shape[1:])
        self.histories = np.zeros((shape[0], len(self.chosen), shape[2]))
        self.low, self.high = np.full(shape[1:], np.inf), np.full(shape[1:], -np.inf)
        for start, block in run.blocks("/transient/displacement"):
            self.histories[start:start + len(block)] = block[:, self.chosen]
            self.low, self.high = np.minimum(self.low, block.min(axis=0)), np.maximum(
                self.high, block.max(axis=0))
            kept = block[max(0, self.first - start):]
            total += kept.sum(axis=0)
            square += (kept**2).sum(axis=0)
        count = shape[0] - self.first
        self.mean = total / count
        self.rms = np.sqrt(np.maximum(square / count - self.mean**2, 0.0))
        self.vibrates = self.lateral_rms()[self.chosen] > VIBRATES  # of the chosen nodes
        velocity = run.file.get("/transient/velocity") if self.chosen else None
        # (u', v') of the chosen nodes in the second half, None if they are not recorded
        self.velocities = None if velocity is None else velocity[self.first:, self.chosen, :2]

    def lateral_rms(self):
        """Root mean square of the lateral vibration of the nodes of a string about the mean
        position [m]."""
        return np.hypot(self.rms[:, 0], self.rms[:, 1])


class Contact:
    """Contact forces over the motion: share of time in contact and largest force of each node, and
    a thinned history."""
    def __init__(self, run, most=160):
        self.force, self.duty, self.largest = None, None, None
        if "/transient/normal_force" not in run.file or not run.records:
            return
        at = run.frames(most)
        first = run.second_half()
        touching = np.zeros(len(run.recorded))
        self.largest = np.zeros(len(run.recorded))
        rows = []
        for start, block in run.blocks("/transient/normal_force"):
            rows.append(block[at[(at >= start) & (at < start + len(block))] - start])
            self.largest = np.maximum(self.largest, block.max(axis=0))
            touching += np.count_nonzero(block[max(0, first - start):] > 0, axis=0)
        self.force, self.time = np.concatenate(rows), run.time[at]
        self.duty = touching / (len(run.time) - first)


def differences(values, time):
    """Central differences. For a circle with n samples per turn they are its velocity times sin(2
    pi/n)/(2 pi/n)."""
    return np.gradient(values, time) if len(time) > 1 else np.zeros_like(values)


def precession(u, v, u_rate, v_rate):
    """Mean rate of an orbit about its centre [rad/s], positive from u to v: sum(u v' - v u') /
    sum(u^2 + v^2)."""
    u, v = u - u.mean(), v - v.mean()
    size = np.sum(u**2 + v**2)
    return float(np.sum(u * v_rate - v * u_rate) / size) if size > 0 and len(u) > 2 else 0.0


def sides(run, node):
    """((a, b), matrix that transforms (u, v) of a node to them): the high side of the hole and its
    right side, looking down the hole; north and east in a nearly vertical hole. Both turn clockwise
    from a to b, like the rotation."""
    x, y, tangent = run.get("/model/frame")[node].T
    names, up = (("high side", "right side"),
                 [0, 0, -1]) if np.hypot(*tangent[:2]) > STEEP else (("north", "east"), [1, 0, 0])
    first = up - np.dot(up, tangent) * tangent
    first /= np.linalg.norm(first)
    second = np.cross(tangent, first)
    return names, np.array([[x @ first, y @ first], [x @ second, y @ second]])


def chosen_nodes(run, rms, most=4):
    """At most `most` recorded nodes (from 0) to show, by depth, each with the reason: the largest
    lateral vibration, the largest static side force, above the bit, then quarters of the length; if
    only some nodes are recorded, those with the largest vibration."""
    found = {}
    if not run.moves:
        places = sorted(np.argsort(-rms)[:most])
        return {int(run.recorded[place]): "a recorded depth" for place in places}

    def add(node, why):
        if all(abs(node - other) > max(2, len(run.s) // 100) for other in found):
            found[int(node)] = why

    add(int(np.argmax(rms)), "largest lateral vibration")
    force = run.get("/static/normal_force")
    if force is not None and force.max() > 0:
        add(int(np.argmax(force)), "largest static side force")
    add(max(0, len(run.s) - 4), "above the bit")
    for share, why in ((0.25, "quarter of the length"), (0.5, "middle"),
                       (0.75, "three quarters of the length")):
        if len(found) < most:
            add(int(np.searchsorted(run.s, share * run.s[-1])), why)
    return dict(sorted(found.items()))


def merits(run, motion=None):
    """Figures of merit: rows of (name, value, remark). `motion`: None if no displacements are
    recorded."""
    if motion is None:
        return [*figures_of_bit(run), *figures_along(run, accelerates(run))]
    rms = motion.lateral_rms()
    largest = int(np.argmax(rms))
    node = int(run.recorded[largest])
    name = "Largest lateral vibration" + ("" if run.moves else " of the recorded nodes")
    vibrates = rms[largest] > VIBRATES
    rows = [
        (name, f"{1e3 * rms[largest]:.3g} mm rms",
         f"at {run.s[node]:.1f} m, {run.component_at(node) or f'node {node + 1}'}") if vibrates else
        (name, NONE, STILL)
    ]
    if run.recorded[-1] == len(run.s) - 1:
        axial = motion.rms[-1, 2]
        rows.append(("Axial vibration of the bit",
                     *((f"{1e3 * axial:.3g} mm rms", "") if axial > VIBRATES else (NONE, STILL))))
    return [*figures_of_bit(run), *rows, *figures_along(run, vibrates)]


def span(first, last):
    return f"{first:g} to {last:g} s"


def times_of_merits(run, motion=None):
    """The time windows of the rows of merits()."""
    found = run.value("transient.figures") or {}
    said = [] if found.get("begin") is None else [
        f"Figures of {span(found['begin'], found['end'])} (transient.figures; Output/Figures "
        "chooses the window)"
    ]
    if motion is not None:
        said.append("vibration in mm rms of the second half of the motion, "
                    f"{span(run.time[motion.first], run.time[-1])}")
    text = "; ".join(said)
    return text[:1].upper() + text[1:]


def accelerates(run):
    """Whether a motion without recorded displacements vibrates laterally: more than VIBRATES of
    lateral acceleration [m/s2]."""
    return ((run.value("transient.figures.lateral_acceleration") or {}).get("worst_rms")
            or 0.0) > VIBRATES


def sense_of_figures(run, found):
    """Sense of the rotation in the window of the figures of merit."""
    return run.sense((run.time >= found["begin"]) & (run.time <= found["end"]))


def figures_of_bit(run):
    """Bit speed, weight, torque and penetration from summary.json, over its window."""
    found = run.value("transient.figures") or {}
    rows = []
    speed = found.get("bit_speed_rpm") or {}
    if speed.get("mean") is not None:
        rows.append(("Bit speed", f"{fixed(speed['mean'], 1)} rpm",
                     f"{fixed(speed['min'], 1)} to {fixed(speed['max'], 1)} rpm"))
    if found.get("stick_slip_index") is not None:
        rows.append(("Stick-slip index", fixed(found["stick_slip_index"], 3),
                     f"(max - min) / (2 mean) of the bit speed; stick-slip from 1 on"))
    if found.get("stuck_share") is not None:
        rows.append(("Time the bit is stuck", f"{fixed(100 * found['stuck_share'], 1)} %",
                     f"below {found['stuck_speed_rpm']:.3g} rpm"))
    for name, key, quantity in (
        ("Mean weight on bit", "weight_on_bit", "hook load"),
        ("Mean torque on bit", "torque_on_bit", "torque"),
        ("Rate of penetration", "rate_of_penetration", "penetration"),
        ("Mechanical specific energy", "specific_energy", "pressure"),
    ):
        value = found.get(key)
        spans = isinstance(value, dict)
        mean, ends = (value["mean"], [value.get("min"), value.get("max")]) if spans else (value, [])
        if mean is not None:
            remark = ""
            if key == "torque_on_bit":
                sense = sense_of_figures(run, found)
                mean, *ends = (sense or 1) * np.array([mean, *ends])
                remark = f"; {AGAINST[sense]}"
            si, field = both(mean, quantity)
            rows.append(
                (name, si,
                 field + (f"; {both(min(ends), quantity)[0]} to {both(max(ends), quantity)[0]}"
                          if spans else "") + remark))
    return rows


def figures_along(run, vibrates):
    """Figures of merit of nodes and elements from summary.json; those of the lateral vibration only
    if `vibrates`."""
    found = run.value("transient.figures") or {}
    rows = []
    lateral, whirl, bending = (found.get(key) or {}
                               for key in ("lateral_acceleration", "whirl", "bending"))
    if vibrates and lateral.get("rms") is not None:
        rows.append(("Lateral acceleration", f"{lateral['worst_rms']:.3g} m/s2 rms",
                     f"at {lateral['worst_rms_depth']:.1f} m; {lateral['peak']:.3g} m/s2 at most"))
    if vibrates and whirl.get("worst_backward_share"):
        rows.append(
            ("Backward whirl", f"{fixed(100 * whirl['worst_backward_share'], 1)} % of the time",
             f"at {whirl['worst_backward_share_depth']:.1f} m, mean precession "
             f"{fixed((sense_of_figures(run, found) or 1) * whirl['worst_precession_rpm'], 1)} "
             "rpm; in contact as well at most "
             f"{fixed(100 * whirl['worst_backward_contact_share'], 1)} %"))
    if bending.get("range"):
        rows.append(("Largest range of the bending moment", f"{bending['range'] / 1e3:.3g} kN m",
                     f"at {bending['range_depth']:.1f} m, in a plane that turns with the pipe"))
    if bending.get("damage_per_hour") is not None:
        rows.append(("Fatigue damage", f"{bending['damage_per_hour']:.2e} 1/h",
                     f"at {bending['damage_per_hour_depth']:.1f} m"))
    return rows
