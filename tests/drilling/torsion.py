# SPDX-License-Identifier: BSD-3-Clause
"""Torsion of a string between a drive and a bit with speed-dependent friction: roots of the line
without a mesh, and an independent motion."""
import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from models import DENSITY, SHEAR


class Drive:
    """J theta'' + k_p theta' + k_i theta of the deviation from the set speed."""
    def __init__(self, kp, ki, inertia):
        self.kp, self.ki, self.inertia = kp, ki, inertia

    def over_angle(self, s):
        return self.inertia * s * s + self.kp * s + self.ki


class Line:
    """Uniform pieces from the top down; rho I_p (theta_tt + a theta_t) = G I_p (1 + b d/dt)
    theta_zz with the damping coefficients a of the mass and b of the stiffness."""
    def __init__(self, pieces, mass=0.0, stiffness=0.0):
        """`pieces`: length, outer and inner radius [m]."""
        self.pieces = [
            (length, math.pi / 2 * (outer**4 - inner**4)) for length, outer, inner in pieces
        ]
        self.mass, self.stiffness = mass, stiffness

    def torque_over_angle(self, s, slope, drive):
        """Residual of drive and string at the top, above a bit of the slope dT/domega; 0 at a
        root."""
        wave = np.sqrt(DENSITY * (s * s + self.mass * s) / (SHEAR * (1 + self.stiffness * s)))
        below = slope * s
        for length, polar in reversed(self.pieces):
            own, t = SHEAR * polar * (1 + self.stiffness * s) * wave, np.tanh(wave * length)
            below = own * (below + own * t) / (own + below * t)
        return below + drive.over_angle(s)

    def root(self, slope, drive, start):
        """The root next to `start` by Newton's method, or None."""
        s = complex(start)
        for _ in range(30):
            h = 1e-6 * abs(s)
            f, ahead, behind = (self.torque_over_angle(x, slope, drive) for x in (s, s + h, s - h))
            change = f * 2 * h / (ahead - behind)
            s -= change
            if abs(change) < 1e-11 * abs(s):
                return s
        return None

    def roots(self, slope, drive, highest):
        """Vibrating roots up to `highest` [rad/s], the largest real part first; starts are the
        eigenvalues of lumped masses."""
        lumped = LumpedString(self, min(50.0, 3200.0 / highest))
        starts = [s for s in lumped.eigenvalues(slope, drive) if 1e-3 < s.imag < highest]
        roots = [s for s in (self.root(slope, drive, start) for start in starts) if s is not None]
        return sorted(roots, key=lambda s: -s.real)

    def rightmost(self, slope, drive, highest):
        return self.roots(slope, drive, highest)[0]

    def critical_slope(self, drive, highest):
        """dT/domega [N m s/rad] below which steady drilling is unstable."""
        return brentq(lambda slope: self.rightmost(slope, drive, highest).real, -400.0, 0.0,
                      xtol=1e-6)


class LumpedString:
    """A line as masses and springs, much shorter than the waves; from rest, in the frame of the set
    speed."""
    def __init__(self, line, longest):
        """Masses at most `longest` apart; shorter pieces in a row are one spring."""
        springs, masses, compliance, inertia, way = [], [0.0], 0.0, 0.0, 0.0
        for i, (length, polar) in enumerate(line.pieces):
            count = math.ceil(length / longest)
            for k in range(count):
                compliance += length / count / (SHEAR * polar)
                inertia += DENSITY * polar * length / count
                way += length / count
                last = i + 1 == len(line.pieces) and k + 1 == count
                if way < 0.7 * longest and not last:
                    continue
                springs.append(1 / compliance)
                masses[-1] += 0.5 * inertia
                masses.append(0.5 * inertia)
                compliance, inertia, way = 0.0, 0.0, 0.0
        self.springs, self.masses, self.line = np.array(springs), np.array(masses), line

    def eigenvalues(self, slope, drive):
        """Eigenvalues of the motion about steady drilling above a bit of the slope dT/domega."""
        n = len(self.masses)
        K, M = np.zeros((n, n)), np.diag(self.masses)
        for i, spring in enumerate(self.springs):
            K[i:i + 2, i:i + 2] += spring * np.array([[1, -1], [-1, 1]])
        C = self.line.mass * M + self.line.stiffness * K
        M[0, 0] += drive.inertia
        C[0, 0] += drive.kp
        C[-1, -1] += slope
        K[0, 0] += drive.ki
        inverse = np.linalg.inv(M)
        return np.linalg.eigvals(
            np.block([[np.zeros((n, n)), np.eye(n)], [-inverse @ K, -inverse @ C]]))

    def motion(self, times, omega, acceleration, bit, drive):
        """Speed of the bit."""
        n, inertia = len(self.masses), self.masses.copy()
        inertia[0] += drive.inertia

        def rates(t, y):
            angle, speed = y[::2], y[1::2]  # interleaved, so that the Jacobian is banded
            through = self.springs * (np.diff(angle) + self.line.stiffness * np.diff(speed))
            force = -acceleration(t) * inertia - self.line.mass * self.masses * speed
            force[:-1] += through
            force[1:] -= through
            force[0] -= drive.kp * speed[0] + drive.ki * angle[0]
            force[-1] -= bit.torque(omega(t) + speed[-1])
            both = np.empty(2 * n)
            both[::2], both[1::2] = speed, force / inertia
            return both

        found = solve_ivp(rates, (0.0, times[-1]), np.zeros(2 * n), method="LSODA", lband=3,
                          uband=3, rtol=1e-7, atol=1e-8, t_eval=times, max_step=0.05)
        return omega(times) + found.y[-1]
