# SPDX-License-Identifier: BSD-3-Clause
"""Points, cells and fields of a run in space: a string and its well, or parts."""
import numpy as np

from report import results
from report.files import Unreadable

SECTORS = 24  # points around the wall
# largest displacement at the suggested magnification, as a share of the size of the scene
SIZE_SHARE = 0.1


class Scene:
    """A run in space.
    `position` n x 3 [m]; `kinds`: cells by kind; at a sample: displacement(i), point_fields(i),
    cell_fields(i)."""
    def __init__(self, run):
        self.run = run
        self.times = run.time if run.moves else np.zeros(1)

    def row(self, name, sample):
        """A field of the nodes at a sample of the motion, or of the static state; None if it was
        not recorded."""
        if not self.run.moves:
            return self.run.get(f"/static/{name}")
        dataset = self.run.file.get(f"/transient/{name}")
        return None if dataset is None else dataset[sample]


class String(Scene):
    """A string in its well: north, east, down."""

    name, axes = "string", ("north", "east", "down")

    def __init__(self, run):
        super().__init__(run)
        self.frames = run.get("/model/frame")
        path = run.get("/path/position")
        self.position = run.get("/model/position") if path is None else path
        last = len(self.position) - 1
        self.kinds = {"Lines": np.column_stack([np.arange(last), np.arange(1, last + 1)])}

    def turned(self, nodal):
        """Vectors of the nodes, transformed from nodal frames to north, east, down."""
        return np.einsum("nij,nj->ni", self.frames, nodal[:, :3])

    def displacement(self, sample):
        return self.turned(self.row("displacement", sample))

    def at_nodes(self, elements):
        """The larger value of the elements adjacent to a node."""
        return np.maximum(np.append(elements, elements[-1]), np.insert(elements, 0, elements[0]))

    def point_fields(self, sample):
        fields = {
            "displacement [m]": self.displacement(sample),
            "clearance [m]": self.run.get("/model/clearance"),
            "measured_depth [m]": self.run.s,
        }
        velocity, force, radius = self.row("velocity", sample), self.row(
            "normal_force", sample), self.run.get("/model/outer_radius")
        if velocity is not None:
            fields["velocity [m/s]"] = self.turned(velocity)
            speed = self.run.file.get("/transient/speed")
            fields["spin [rad/s]"] = velocity[:, 5] + (0.0 if speed is None else speed[sample])
        if force is not None:
            fields["contact_force [N]"] = force
        if radius is not None:
            fields["radius [m]"] = self.at_nodes(radius)
        return fields

    def cell_fields(self, sample):
        fields = {}
        displacement = self.row("displacement", sample)
        forces, stress = results.internal_forces(self.run, displacement), results.von_mises(
            self.run, displacement)
        if forces is not None:
            fields["axial_force [N]"], fields["torque [N m]"] = forces
        if stress is not None:
            fields["von_mises_stress [Pa]"] = stress
        return fields

    def wall(self, magnification):
        """(points, quadrilaterals) of the bore. The clearance is magnified like the displacements,
        so nodes in contact are drawn on the wall."""
        angle = 2 * np.pi * np.arange(SECTORS) / SECTORS
        contact, clearance = self.run.get("/model/contact_radius"), self.run.get("/model/clearance")
        radius = (contact + magnification * clearance)[:, None, None]
        x, y = self.frames[:, None, :, 0], self.frames[:, None, :, 1]
        points = self.position[:, None, :] + radius * (np.cos(angle)[None, :, None] * x +
                                                       np.sin(angle)[None, :, None] * y)
        first = SECTORS * np.arange(len(self.position) - 1)[:, None] + np.arange(SECTORS)[None, :]
        after = SECTORS * np.arange(len(self.position) -
                                    1)[:, None] + (np.arange(SECTORS)[None, :] + 1) % SECTORS
        quads = np.stack([first, after, after + SECTORS, first + SECTORS], axis=-1)
        return points.reshape(-1, 3), quads.reshape(-1, 4)


class Parts(Scene):
    """Parts with positions, in the common frame of the deck."""

    name, axes = "parts", ("x", "y", "z")

    def __init__(self, run):
        super().__init__(run)
        located = run.get("/model/located")
        if located is None or not len(located):
            raise Unreadable(f"The parts of {run.folder} have no positions, so they cannot be "
                             "shown in space. Give coordinates in their part files "
                             "(docs/file-formats.md).")
        self.rows = located - 1
        self.position = run.get("/model/position")
        links = run.get("/model/links")
        links = np.zeros((0, 2), int) if links is None else links - 1
        links = links[np.isin(links, self.rows).all(axis=1)]
        lines = np.searchsorted(self.rows, links)
        alone = np.setdiff1d(np.arange(len(self.rows)), lines)
        self.kinds = {
            name: corners for name, corners in (("Verts", alone[:, None]), ("Lines", lines))
            if len(corners)
        }
        names = results.texts(run.file["/model/components"])
        self.columns = [[names.index(each) if each in names else None for each in group]
                        for group in (("u", "v", "w"), ("theta_x", "theta_y", "theta_z"))]

    def vectors(self, values, group):
        return np.column_stack([
            values[self.rows, c] if c is not None else np.zeros(len(self.rows))
            for c in self.columns[group]
        ])

    def displacement(self, sample):
        return self.vectors(self.row("displacement", sample), 0)

    def point_fields(self, sample):
        displacement, velocity = self.row("displacement", sample), self.row("velocity", sample)
        fields = {
            "displacement [m]": self.vectors(displacement, 0),
            "rotation [rad]": self.vectors(displacement, 1),
            "part": self.run.get("/model/part")[self.rows],
            "node": self.run.get("/model/node")[self.rows],
        }
        if velocity is not None:
            fields["velocity [m/s]"] = self.vectors(velocity, 0)
        return fields

    def cell_fields(self, _):
        return {}


def of_run(run):
    """The scene of a run; Unreadable if its nodes have no positions in space."""
    if run.get("/static/displacement") is None:
        raise Unreadable(
            f"{run.folder} holds no static state: the run ended before it. Run the deck again.")
    if run.records and not run.moves:
        raise Unreadable(f"{run.folder} holds the motion of {len(run.recorded)} chosen nodes, not "
                         "of all. Take Output/Depths or Output/Nodes out and run the deck again.")
    if run.time is not None and not run.moves and len(run.time) > 1:
        raise Unreadable(f"{run.folder} has no displacements of its motion. Add displacement to "
                         "Output/Fields and run the deck again.")
    return String(run) if run.is_string else Parts(run)


def suggestion(scene, largest):
    """The magnification at which the largest displacement is a tenth of the size of the scene."""
    size = float(np.ptp(scene.position, axis=0).max())
    return float(
        f"{max(1.0, SIZE_SHARE * size / largest):.1g}") if largest > 0 and size > 0 else 1.0
