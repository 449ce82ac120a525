# SPDX-License-Identifier: BSD-3-Clause
"""Beam-column of constant section on supports, as in textbooks, for comparison with `tooljoint
bha`.

x is measured from the bit up the hole, v across it; the bit is at x = 0 on the axis. With the
compression P, the load q along v and the transverse force Q of fixed direction, the system

    v' = theta,  theta' = M/(E I),  M' = Q - P theta,  Q' = q,  v(0) = M(0) = 0

is linear in theta(0), Q(0) and the reactions of the supports. A slick end lies on the wall from the
tangency point x = L on: v = wall, theta = wall', M = E I wall'' there; the last condition gives L.
"""
import numpy as np
from scipy.optimize import brentq


class Beam:
    """`load(x)` q [N/m], `compression(x)` P [N], `wall(x)` distance of the axis of the hole from
    that at the bit [m]."""
    def __init__(self, rigidity, load, compression, wall=lambda x: 0.0):
        self.rigidity, self.load, self.compression, self.wall = rigidity, load, compression, wall

    def march(self, state, start, end):
        """State (v, theta, M, Q) and its derivatives with respect to the unknowns (columns), from
        start to end by Runge-Kutta 4. Steps of 0.1 m are a hundredth of the bending length of the
        beam; their error is about 1e-8."""
        steps = max(1, int(np.ceil((end - start) / 0.1)))
        h = (end - start) / steps

        def slope(x, y):
            rate = np.array([
                y[1], y[2] / self.rigidity, y[3] - self.compression(x) * y[1],
                np.zeros_like(y[0])
            ])
            rate[3, 0] = self.load(x)
            return rate

        for i in range(steps):
            x = start + i * h
            k1 = slope(x, state)
            k2 = slope(x + h / 2, state + h / 2 * k1)
            k3 = slope(x + h / 2, state + h / 2 * k2)
            k4 = slope(x + h, state + h * k3)
            state = state + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        return state

    def solve(self, events, length, end):
        """Unknowns theta(0), Q(0), reactions.
        `events`: (x, kind, value): "support" at the distance v = value from the axis of the hole,
        "kink" that turns the part above by value, "force" on the string. At x = length: v = 0, M =
        0 from the axis (end "hinge"), or v = end off the axis and along the wall (a number)."""
        events = sorted(events)
        supports = [e for e in events if e[1] == "support"]
        unknowns = 2 + len(supports)
        state = np.zeros((4, 1 + unknowns))
        state[1, 1] = state[3, 2] = 1.0
        rows, right = [], []
        x, column = 0.0, 3
        for place, kind, value in events:
            state = self.march(state, x, place)
            x = place
            if kind == "support":
                rows.append(state[0, 1:].copy())
                right.append(value + self.wall(place) - state[0, 0])
                state[3, column] += 1.0
                column += 1
            elif kind == "kink":
                state[1, 0] += value
            else:
                state[3, 0] += value
        state = self.march(state, x, length)
        step = 1e-3
        slope, bend = (self.wall(length + step) - self.wall(length - step)) / (2 * step), (
            self.wall(length + step) - 2 * self.wall(length) + self.wall(length - step)) / step**2
        offset, second, target = (0.0, 2, 0.0) if end == "hinge" else (end, 1, slope)
        rows += [state[0, 1:].copy(), state[second, 1:].copy()]
        right += [offset + self.wall(length) - state[0, 0], target - state[second, 0]]
        found = np.linalg.solve(np.array(rows), np.array(right))
        moment = state[2, 0] + state[2, 1:] @ found - self.rigidity * bend
        return {
            "tilt": found[0], "bit": found[1], "reactions": list(found[2:]), "excess": moment,
            "length": length
        }

    def slick(self, events, wall, longest=60.0):
        """The same, without contact above the events up to the lowest tangency point."""
        def excess(length):
            return self.solve(events, length, wall)["excess"]

        low = max((place for place, _, _ in events), default=0.0) + 0.5
        while low < longest and excess(low) * excess(low + 0.5) > 0:
            low += 0.5
        return self.solve(events, brentq(excess, low, low + 0.5, xtol=1e-9), wall)
