# SPDX-License-Identifier: BSD-3-Clause
"""Decks of bits and drives, and reference motions: independent integrations and characteristic
equations."""
import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import expm
from scipy.optimize import brentq

PIPE = {"Length": 300.0, "Elements": 3, "Outer Radius": 0.0635, "Inner Radius": 0.054}
COLLAR = {"Length": 100.0, "Elements": 1, "Outer Radius": 0.0795, "Inner Radius": 0.0355}
STEEL = {"Density": 7850.0, "Young Modulus": 2.1e11, "Poisson Ratio": 0.3}
BORE = 0.2  # radius of the hole [m]
RPM = math.pi / 30
THETA_Z, W = 5, 2  # components per node
DENSITY, YOUNG, SHEAR = 7850.0, 2.1e11, 2.1e11 / 2.6


def polar(part):
    return math.pi / 2 * (part["Outer Radius"]**4 - part["Inner Radius"]**4)


def area(part):
    return math.pi * (part["Outer Radius"]**2 - part["Inner Radius"]**2)


def impedance(part):
    """zeta = I_p sqrt(rho G) [N m s/rad]."""
    return polar(part) * math.sqrt(DENSITY * SHEAR)


def smoothed_sign(w, width):
    s = np.clip(w / width, -1.0, 1.0)
    return s * (3 - s * s) / 2


class Friction:
    """Torque of a bit that weakens with speed."""
    def __init__(self, static, dynamic, decay, viscous, width):
        self.static, self.dynamic, self.decay = static, dynamic, decay
        self.viscous, self.width = viscous, width

    def torque(self, w):
        dry = self.dynamic + (self.static - self.dynamic) * np.exp(-np.abs(w) / self.decay)
        return self.viscous * w + dry * smoothed_sign(w, self.width)

    def slope(self, w):
        """dT/dw of a bit that slips forward."""
        return self.viscous - (self.static - self.dynamic) / self.decay * math.exp(-w / self.decay)


def string_deck(pieces, **lists):
    """A vertical string without lateral motion; `pieces`: (component, how many)."""
    names = {id(PIPE): "pipe", id(COLLAR): "collar"}
    components, assembly, length = {}, [], 0.0
    for part, count in pieces:
        name = names.get(id(part), f"part {len(components) + 1}")
        components[name] = part
        assembly.append(f"{count}*{name}")
        length += count * part["Length"]
    base = {
        "Well": {"Trajectory": "Vertical", "Vertical": {"Length": length}, "Bore Radius": BORE},
        "Drillstring": {"Assembly": assembly, "Components": components, "Material": STEEL},
        "Supports": {"Dofs": "axial torsional"},
    }
    return {**base, **lists}


class TorsionalString:
    """Linear torsional elements in the frame that turns with Omega(t): an independent
    implementation."""
    def __init__(self, pieces, damping=0.0, inertia=0.0):
        elements = [(part, part["Length"] / part["Elements"]) for part, count in pieces
                    for _ in range(count * part["Elements"])]
        n = len(elements) + 1
        self.K, self.M = np.zeros((n, n)), np.zeros((n, n))
        for e, (part, h) in enumerate(elements):
            at = slice(e, e + 2)
            self.K[at, at] += SHEAR * polar(part) / h * np.array([[1, -1], [-1, 1]])
            self.M[at, at] += DENSITY * polar(part) * h / 6 * np.array([[2, 1], [1, 2]])
        self.C = damping * self.M
        self.M[0, 0] += inertia
        self.inverse = np.linalg.inv(self.M)

    def integrate(self, times, omega, acceleration, bit, kp, ki, torque=0.0):
        """theta_z and its rate at the nodes (samples x nodes) from rest without twist."""
        n = len(self.K)
        total = self.M.sum(axis=1)

        def rates(t, y):
            theta, speed = y[:n], y[n:]
            force = -self.K @ theta - self.C @ speed - acceleration(t) * total
            force[0] += torque - kp * speed[0] - ki * theta[0]
            force[-1] -= bit.torque(omega(t) + speed[-1])
            return np.concatenate([speed, self.inverse @ force])

        found = solve_ivp(rates, (0.0, times[-1]), np.zeros(2 * n), method="DOP853", rtol=1e-9,
                          atol=1e-10, t_eval=times, max_step=0.05)
        return found.y[:n].T, found.y[n:].T


class CuttingString:
    """Axial and torsional elements above a bit of sharp blades, as deviations from steady drilling,
    by the classical Runge-Kutta method; the delay is the root of phi(t) - phi(t - t_n) = 2 pi/n for
    the motion so far."""
    def __init__(self, pieces, damping, inertia, blades, radius, energy, inclination):
        torsion = TorsionalString(pieces, damping, inertia)
        n = len(torsion.K)
        K, M = np.zeros((n, n)), np.zeros((n, n))
        elements = [(part, part["Length"] / part["Elements"]) for part, count in pieces
                    for _ in range(count * part["Elements"])]
        for e, (part, h) in enumerate(elements):
            at = slice(e, e + 2)
            K[at, at] += YOUNG * area(part) / h * np.array([[1, -1], [-1, 1]])
            M[at, at] += DENSITY * area(part) * h / 6 * np.array([[2, 1], [1, 2]])
        self.torsion, self.K, self.M = torsion, K[1:, 1:], M[1:, 1:]
        self.C, self.inverse = damping * self.M, np.linalg.inv(self.M)
        self.pitch, self.weight, self.torque = (2 * math.pi / blades,
                                                blades * radius * inclination * energy,
                                                0.5 * blades * radius**2 * energy)

    def integrate(self, end, step, feed, omega, acceleration, angle, kp, ki):
        """Times, deviations of w and theta_z of the bit, depth of cut of a blade."""
        n, m = len(self.torsion.K), len(self.K)
        start = feed * self.pitch / omega(0.0)
        steps = round(end / step)
        past = round(1.5 * self.pitch / omega(0.0) / step)
        times = step * np.arange(-past, steps + 1)
        U, phi = feed * times, omega(0.0) * times
        total = self.torsion.M.sum(axis=1)

        def depth(t, w, theta, known):
            then = np.interp(angle(t) + theta - self.pitch, phi[:known], U[:known])
            return feed * t + w - then

        def rates(t, y, known):
            w, v, theta, rate = y[:m], y[m:2 * m], y[2 * m:2 * m + n], y[2 * m + n:]
            more = depth(t, w[-1], theta[-1], known) - start
            axial = -self.K @ w - self.C @ v
            axial[-1] -= self.weight * more
            turn = -self.torsion.K @ theta - self.torsion.C @ rate - acceleration(t) * total
            turn[-1] -= self.torque * more
            turn[0] -= kp * rate[0] + ki * theta[0]
            return np.concatenate([v, self.inverse @ axial, rate, self.torsion.inverse @ turn])

        y = np.zeros(2 * m + 2 * n)
        found = np.zeros((steps + 1, 3))
        found[0] = 0, 0, start
        for i in range(steps):
            t, known = i * step, past + i + 1
            a = rates(t, y, known)
            b = rates(t + step / 2, y + step / 2 * a, known)
            c = rates(t + step / 2, y + step / 2 * b, known)
            d = rates(t + step, y + step * c, known)
            y = y + step / 6 * (a + 2 * b + 2 * c + d)
            U[known], phi[known] = feed * (t + step) + y[m - 1], angle(t + step) + y[2 * m + n - 1]
            u, theta = y[m - 1], y[2 * m + n - 1]
            found[i + 1] = u, theta, depth(t + step, u, theta, known + 1)
        return step * np.arange(steps + 1), found


def cycles(t, w, width):
    """Peak speed, share of time stuck, and mean period between releases of a bit."""
    stuck = np.abs(w) < width
    releases = t[1:][stuck[:-1] & ~stuck[1:]]
    if len(releases) < 2:
        return float(w.max()), float(stuck.mean()), math.nan
    whole = (t >= releases[0]) & (t < releases[-1])
    return float(w[whole].max()), float(stuck[whole].mean()), float(np.diff(releases).mean())


class Chatter:
    """m s^2 + c s + k + A (1 - exp(-s tau)) = 0: a mass on a spring that cuts the surface left one
    delay earlier."""
    def __init__(self, mass, damping, stiffness):
        self.m, self.c, self.k = mass, damping, stiffness
        self.natural = math.sqrt(stiffness / mass)

    def critical(self, delay):
        """Smallest A [N/m] of the limit of stability, and its frequency [rad/s]: with s = i w

            k - m w^2 + A (1 - cos w tau) = 0,   c w + A sin w tau = 0."""
        def imaginary(w):
            # A from the real part, in the imaginary one times (1 - cos)
            return self.c * w * (1 - math.cos(w * delay)) + (self.m * w * w - self.k) * math.sin(
                w * delay)

        grid = np.linspace(self.natural * 1.0001, self.natural * 6, 200001)
        values = [imaginary(w) for w in grid]
        found = []
        for a, b, fa, fb in zip(grid, grid[1:], values, values[1:]):
            if fa * fb >= 0:
                continue
            w = brentq(imaginary, a, b, xtol=1e-14)
            if 1 - math.cos(w * delay) < 1e-6:
                continue
            A = (self.m * w * w - self.k) / (1 - math.cos(w * delay))
            if A > 0 and math.sin(w * delay) < 0:
                found.append((A, w))
        return min(found)

    def root(self, A, delay, start):
        """The characteristic root next to `start`, by Newton's method."""
        s = complex(start)
        for _ in range(100):
            f = self.m * s * s + self.c * s + self.k + A * (1 - np.exp(-s * delay))
            df = 2 * self.m * s + self.c + A * delay * np.exp(-s * delay)
            s, change = s - f / df, abs(f / df)
            if change < 1e-12 * abs(s):
                break
        return s

    def rightmost(self, A, delay):
        """The root with the largest real part, from starts around the natural frequency."""
        starts = [
            complex(re, im * self.natural) for re in (-5.0, 0.0, 5.0)
            for im in np.linspace(0.5, 4, 71)
        ]
        roots = [self.root(A, delay, start) for start in starts]
        roots = [s for s in roots if abs(s.imag) > 1e-3 * self.natural]
        return max(roots, key=lambda s: s.real)


class CoupledChatter:
    """One axial and one torsional element above a bit of n blades that cuts (T. Richard, C. Germay
    and E. Detournay 2007). With A = n a zeta eps, B = n a^2 eps/2, the advance V and the speed
    Omega of steady drilling, d = (1 - exp(-s tau)) (w - V/Omega theta) is the change of the depth
    of cut, and

        1 + A (1 - exp(-s tau)) G(s) = 0,
        G = 1/(m s^2 + c s + k) - V/Omega B/A 1/(I s^2 + c_t s + k_t)."""
    def __init__(self, axial, torsional, slope, torque_over_force):
        """`axial`, `torsional`: mass, damping, stiffness; `slope`: V/Omega [m/rad];
        `torque_over_force`: B/A [m]."""
        self.axial, self.torsional, self.gain = axial, torsional, slope * torque_over_force
        self.natural = [math.sqrt(one[2] / one[0]) for one in (axial, torsional)]

    def over(self, s, delay):
        """(1 - exp(-s tau)) G(s), which is -1/A at a root."""
        def of(one):
            return 1 / (one[0] * s * s + one[1] * s + one[2])

        return (1 - np.exp(-s * delay)) * (of(self.axial) - self.gain * of(self.torsional))

    def critical(self, delay):
        """Smallest A [N/m] of the limit of stability, and its frequency [rad/s]."""
        def imaginary(w):
            return (1 / self.over(1j * w, delay)).imag

        grid = np.linspace(0.05 * min(self.natural), 8 * max(self.natural), 400001)
        values = (1 / self.over(1j * grid, delay)).imag
        found = []
        for i in np.flatnonzero(values[:-1] * values[1:] < 0):
            w = brentq(imaginary, grid[i], grid[i + 1], xtol=1e-13)
            A = -float((1 / self.over(1j * w, delay)).real)
            if A > 0 and abs(imaginary(w)) < 1e-6 * A:
                found.append((A, w))
        return min(found)

    def rightmost(self, A, delay):
        """The vibrating root with the largest real part, by Newton's method from starts about both
        natural frequencies."""
        roots = []
        for start in (complex(re, im) for re in (-2.0, 0.0, 2.0)
                      for im in np.linspace(0.3 * min(self.natural), 5 * max(self.natural), 121)):
            s = start
            for _ in range(60):
                h = 1e-6 * abs(s)
                f, slope = 1 / self.over(s, delay) + A, (1 / self.over(s + h, delay) -
                                                         1 / self.over(s - h, delay)) / (2 * h)
                change = f / slope
                s -= change
                if not abs(s.real) < 10 * max(self.natural):
                    break  # away from the vibrating roots
                if abs(change) < 1e-11 * abs(s):
                    roots.append(s)
                    break
        return max((s for s in roots if s.imag > 0.1 * min(self.natural)), key=lambda s: s.real)


def drive_root(length, speed, zeta, kp, ki, inertia, start):
    """s of the pipe with a free end below a drive: zeta tanh(s L/c) + k_p + k_i/s + J s = 0."""
    s = complex(start)

    def f(z):
        return zeta * np.tanh(z * length / speed) + kp + ki / z + inertia * z

    for _ in range(100):
        h = 1e-6 * abs(s)
        change = f(s) / ((f(s + h) - f(s - h)) / (2 * h))
        s -= change
        if abs(change) < 1e-12 * abs(s):
            break
    return s


class TanhBit:
    """T = W b0 [tanh(b1 w) + b2 w/(1 + b3 w^2)] with the constants of COPPE."""
    def __init__(self, weight, b0=0.0239, b1=1.91, b2=8.5, b3=5.47):
        self.force, self.b1, self.b2, self.b3 = weight * b0, b1, b2, b3

    def torque(self, w):
        return self.force * (np.tanh(self.b1 * w) + self.b2 * w / (1 + self.b3 * w * w))


class PenetrationBit:
    """Weight and torque after Tucker and Wang 2003 with the constants of Ritto, Soize and Sampaio
    2009; as a divisor Z^2 is at least 0.01."""
    A1, A2, A3, A4, A5, E, FLOOR = 3.429e-3, 5.672e-8, 1.374e-4, 9.537e6, 1.475e3, 2.0, 1e-2

    def factor(self, w):
        """1/(a2 Z^2), the slope of the weight over the advance."""
        return 1 / (self.A2 * np.maximum(w * w / (w * w + self.E**2), self.FLOOR))

    def weight(self, v, w):
        return v * self.factor(w) - self.A3 * np.sqrt(w * w +
                                                      self.E**2) / self.A2 + self.A1 / self.A2

    def torque(self, v, w):
        return v * self.A4 * w / (w * w + self.E**2) + self.A5 * w / np.sqrt(w * w + self.E**2)


class PenetratingString:
    """Axial and torsional elements above a bit whose weight and torque depend on its rates, below a
    PI drive and a block that advances steadily."""
    def __init__(self, pieces, damping, inertia):
        self.torsion = TorsionalString(pieces, damping, inertia)
        self.axial = CuttingString(pieces, damping, inertia, 1, 1.0, 1.0, 1.0)

    def integrate(self, times, feed, omega, acceleration, kp, ki, bit):
        """Rates of w and theta_z of the bit and theta_z of the top, from steady drilling at the
        speed of the start."""
        turn, axial = self.torsion, self.axial
        n, m = len(turn.K), len(axial.K)
        total = turn.M.sum(axis=1)
        weight, torque = bit.weight(feed, omega(0.0)), bit.torque(feed, omega(0.0))

        def rates(t, y):
            w, v, theta, rate = y[:m], y[m:2 * m], y[2 * m:2 * m + n], y[2 * m + n:]
            speed = omega(t) + rate[-1]
            force = -axial.K @ w - axial.C @ v
            force[-1] -= bit.weight(feed + v[-1], speed) - weight
            moment = -turn.K @ theta - turn.C @ rate - acceleration(t) * total
            moment[-1] -= bit.torque(feed + v[-1], speed) - torque
            moment[0] -= kp * rate[0] + ki * theta[0]
            return np.concatenate([v, axial.inverse @ force, rate, turn.inverse @ moment])

        found = solve_ivp(rates, (0.0, times[-1]), np.zeros(2 * (n + m)), method="Radau", rtol=1e-8,
                          atol=1e-10, t_eval=times, max_step=0.05)
        return found.y[2 * m - 1], found.y[-1], found.y[2 * m]


class DrillerLoop:
    """One axial element between the lines of an autodriller and a bit of the slope D = dW/dv: exact
    linear motion."""
    def __init__(self, part, line, slope, kp, ki, mass):
        k = YOUNG * area(part) / part["Length"]
        M = DENSITY * area(part) * part["Length"] / 6 * np.array([[2.0, 1.0], [1.0, 2.0]])
        M[0, 0] += mass
        K = k * np.array([[1.0, -1.0], [-1.0, 1.0]])
        inverse = np.linalg.inv(M)
        # states: w_1, w_2, their rates, block x, integral e; forces f = -line (w_1 - x) and -D w_2'
        A = np.zeros((6, 6))
        A[:2, 2:4] = np.eye(2)
        A[2:4, :2] = -inverse @ (K + np.diag([line, 0.0]))
        A[2:4, 3] = -inverse @ np.array([0.0, slope])
        A[2:4, 4] = inverse @ np.array([line, 0.0])
        A[4] = [kp * line, 0, 0, 0, -kp * line, ki]
        A[5] = [line, 0, 0, 0, -line, 0]
        self.A, self.kp, self.line, self.slope = A, kp, line, slope
        self.stiffness = k * line / (k + line)

    def motion(self, times, lack):
        """Measured weight beyond that of the start, and x' of the block, for a set point that is
        `lack` higher."""
        b = np.array([0, 0, 0, 0, self.kp * lack, lack])
        step = expm((times[1] - times[0]) * np.block([[self.A, b[:, None]], [np.zeros((1, 7))]]))
        y = np.zeros((7, len(times)))
        y[6] = 1.0
        for i in range(1, len(times)):
            y[:, i] = step @ y[:, i - 1]
        y = y[:6]
        rate = self.A[4] @ y + b[4]
        return -self.line * (y[0] - y[4]), rate

    def poles(self, ki):
        """s^2 + s k (k_p + 1/D) + k k_i = 0, the loop without masses."""
        return np.roots([1.0, self.stiffness * (self.kp + 1 / self.slope), self.stiffness * ki])
