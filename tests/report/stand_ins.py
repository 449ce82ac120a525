# SPDX-License-Identifier: BSD-3-Clause
"""Substitutes for a run: a pipe, a string of three nodes."""
import numpy as np

from checks import expect
from report import figures, results


class Bar:
    """A straight vertical pipe of `elements` elements instead of a run."""
    def __init__(self, elements=10, length=20.0, outer=0.06, inner=0.05, tension=1e5, torque=-2e3):
        nodes = elements + 1
        self.s = np.linspace(0, length, nodes)
        self.outer = outer
        self.S, self.J = np.pi * (outer**2 - inner**2), np.pi / 2 * (outer**4 - inner**4)
        self.E, self.G = 2.06e11, 8e10
        flat = {
            "young_modulus": self.E, "shear_modulus": self.G, "area": self.S,
            "torsion_constant": self.J, "outer_radius": outer
        }
        self.data = {f"/model/{name}": np.full(elements, value) for name, value in flat.items()}
        self.data["/model/path_curvature"] = np.zeros((elements, 2))
        # theta x z of a node over the length
        turn = elements / length * np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
        self.data["/model/curvature_of_rotations"] = np.broadcast_to(np.hstack((-turn, turn)),
                                                                     (elements, 2, 6))
        self.data["/static/axial_force"], self.data["/static/torque"] = np.full(
            elements, tension), np.full(elements, torque)
        self.data["/static/displacement"] = np.zeros((nodes, 6))

    def get(self, path):
        return self.data.get(path)


def near(what, found, expected, tolerance=1e-12):
    error = np.max(np.abs(np.asarray(found) - expected)) / max(np.max(np.abs(expected)), 1e-300)
    expect(what, error <= tolerance, f"({error:.1e})")


class Still:
    """A string of three nodes instead of a run: vertical, inclined by 30 degrees to the east, by 1
    degree to the south; all nodes move on a circle of `amplitude` [m]."""

    is_string, moves, value, sense = True, True, results.Run.value, results.Run.sense

    def __init__(self, amplitude, figures=None, speed=10.0, orbit=10.0):
        """Turns at `speed` [rad/s]; the circle at `orbit` [rad/s], clockwise looking down the
        hole."""
        self.speed = np.full(200, speed)
        self.s, self.time, self.recorded = np.array([0.0, 500.0,
                                                     1000.0]), np.linspace(0, 2, 200), np.arange(3)
        self.summary = {"transient": {"figures": figures or {}}}
        tilt = np.radians([0.0, 30.0, 1.0])
        # north, east, down
        tangents = np.stack([[0, 0, -np.sin(tilt[2])],
                             np.sin([0, tilt[1], 0]),
                             np.cos(tilt)], axis=1)
        x = np.array([1.0, 2.0, 0.0]) - np.outer(tangents @ [1.0, 2.0, 0.0], [1, 1, 1]) * tangents
        x /= np.linalg.norm(x, axis=1)[:, None]
        self.data = {
            "/model/frame": np.stack([x, np.cross(tangents, x), tangents], axis=2),
            "/model/clearance": np.full(3, 0.05),
        }
        circle = amplitude * np.stack(
            [np.cos(orbit * self.time), np.sin(orbit * self.time)], axis=1)
        self.file = {
            "/transient/displacement": np.concatenate(
                [np.repeat(circle[:, None], 3, axis=1),
                 np.zeros((200, 3, 4))], axis=2)
        }

    def get(self, path):
        return self.data.get(path)

    def rotary(self):
        return self.speed

    def blocks(self, path):
        yield 0, self.file[path]

    def record_velocities(self, orbit):
        motion = self.file["/transient/displacement"]
        self.file["/transient/velocity"] = np.zeros_like(motion)
        self.file["/transient/velocity"][..., 0], self.file["/transient/velocity"][
            ..., 1] = -orbit * motion[..., 1], orbit * motion[..., 0]

    second_half, column, component_at, bit_speed = (results.Run.second_half, results.Run.column,
                                                    lambda self, node: "pipe",
                                                    lambda self: np.full(200, 10.0))
