# SPDX-License-Identifier: BSD-3-Clause
"""Closed forms of the soft string, and the stiff string that tends to it, compared with
`tooljoint torque-drag`: rows of check_torque_drag.py and of docs/validation.md.

Closed forms of straight holes, builds, drops and side bends are those of Sheppard, Wick and Burgess
(1987) and of Aadnoy and Andersen (J. Petroleum Science and Engineering 32, 2001): solutions of
dT/ds = w cos a + k abs(T/R -+ w sin a) upwards, k = mu for pulling, -mu for lowering. Bends in
space use T exp(mu theta) and the weight along the chord, an approximation of Aadnoy, Fazaelizadeh
and Hareland (J. Canadian Petroleum Technology 49(10), 2010).
"""
import math

DENSITY, YOUNG, OUTER, INNER, BORE, MU = 7850.0, 210e9, 0.0635, 0.0543, 0.108, 0.25
LENGTH = 158 * 9.0
AREA = math.pi * (OUTER**2 - INNER**2)
INERTIA = math.pi / 4 * (OUTER**4 - INNER**4)
WEIGHT = DENSITY * 9.81 * AREA
RADIUS = 30.0 / math.radians(3)
PIPE = ["Drillstring/Assembly={158*body}", "Torque and Drag/Count=1",
        "Supports/Bit=none"]  # a pipe without joints, its lower end free across the hole
SOFT = [*PIPE, "Torque and Drag/Stiff String=None"]


def inclined(angle):
    return [
        "Well/Trajectory=Vertical", f"Well/Vertical/Length={LENGTH:g}",
        f"Well/Vertical/Inclination={angle:g} deg"
    ]


def arc(kick_off, start, end, tangent):
    return [
        f"Well/Arc/Kick-off Depth={kick_off:g}", f"Well/Arc/Start Inclination={start:g} deg",
        f"Well/Arc/End Inclination={end:g} deg", f"Well/Arc/Tangent Length={tangent:g}"
    ]


def straight(below, length, inclination, k):
    a = math.radians(inclination)
    return below + WEIGHT * length * (math.cos(a) + k * math.sin(a))


def on_wall(below, start, end, k, weight=WEIGHT):
    """Tension at `end` of an arc with the tension `below` at `start` (angles of the tangent from
    the vertical, upwards), if the wall force q = T/R - w sin a (build) or q = T/R + w sin a (drop)
    keeps its sign. Integrals of dT/da = -w R cos a - k (T - w R sin a) and dT/da = w R cos a + k (T
    + w R sin a)."""
    wr, build = weight * RADIUS, end < start
    if build:
        sine, cosine, rate = wr * (k * k - 1) / (1 + k * k), -2 * k * wr / (1 + k * k), -k
    else:
        sine, cosine, rate = wr * (1 - k * k) / (1 + k * k), -2 * k * wr / (1 + k * k), k
    part = lambda a: sine * math.sin(a) + cosine * math.cos(a)
    return part(end) + (below - part(start)) * math.exp(rate * (end - start))


def bend(below, lower, upper, k):
    """Tension at the upper end of an arc between these inclinations [deg], with at most one change
    of the wall: in a build from the low side to the high side."""
    start, end = math.radians(lower), math.radians(upper)
    side = lambda tension, a: tension / RADIUS - WEIGHT * math.sin(
        a) if end < start else tension / RADIUS + WEIGHT * math.sin(a)
    sense = 1 if side(below, start) > 0 or (side(below, start) == 0
                                            and side(1.0, start) > 0) else -1
    above = on_wall(below, start, end, sense * k)
    if sense > 0 or side(above, end) < 0:
        return above
    near, far = start, end
    for _ in range(200):
        middle = 0.5 * (near + far)
        near, far = (middle,
                     far) if side(on_wall(below, start, middle, -k), middle) < 0 else (near, middle)
    return on_wall(on_wall(below, start, near, -k), near, end, k)


def build_and_hold(k, wob=0.0):
    """Hook load of the pipe in the well of the deck: tangent, build of 3 deg/30 m to 60 deg, 400 m
    vertical."""
    tangent = LENGTH - 400 - RADIUS * math.radians(60)
    return straight(bend(straight(-wob, tangent, 60, k), 60, 0, k), 400, 0, k)


def in_space(k):
    """The same by Aadnoy, Fazaelizadeh and Hareland: T exp(k theta) + w (s2 - s1) (sin a2 - sin
    a1)/(a2 - a1)."""
    tangent, theta = LENGTH - 400 - RADIUS * math.radians(60), math.radians(60)
    return straight(
        straight(0.0, tangent, 60, k) * math.exp(k * theta) + WEIGHT * RADIUS * math.sin(theta),
        400, 0, k)


def turning():
    """Torque off bottom in the same well: mu r times the integral of abs(T/R - w sin a), T = T1 + w
    R (sin a1 - sin a); the argument changes its sign once."""
    tangent = LENGTH - 400 - RADIUS * math.radians(60)
    top = math.radians(60)
    total = WEIGHT * tangent * math.cos(top) + WEIGHT * RADIUS * math.sin(top)
    change = math.asin(min(1.0, total / (2 * WEIGHT * RADIUS)))  # total = 2 w R sin a
    upto = lambda a: total * a + 2 * WEIGHT * RADIUS * math.cos(a)
    inside = upto(change) - upto(0) - (upto(top) -
                                       upto(change)) if change < top else upto(top) - upto(0)
    return MU * OUTER * (WEIGHT * tangent * math.sin(top) + inside)


def lock_up(wob, mu):
    """Distance above the bit in a horizontal hole: F grows by mu w per length up to F* = 2 sqrt(2)
    sqrt(E I w/r), then by mu (w + r F^2/(4 E I)) up to the lock-up criterion of the program, 1 % of
    E S."""
    r = BORE - OUTER
    k, limit = math.sqrt(
        r / (4 * YOUNG * INERTIA * WEIGHT)), 2 * math.sqrt(2 * YOUNG * INERTIA * WEIGHT / r)
    return (limit - wob) / (mu * WEIGHT) + (math.atan(k * 0.01 * YOUNG * AREA) -
                                            math.atan(k * limit)) / (k * mu * WEIGHT)


def soft(run):
    """Rows (what, truth, found, unit, tolerance). `run` returns the rows of torque_drag.csv by
    operation, as numbers, for a name and settings."""
    exact = 1e-6
    found = run("straight", [*SOFT, *inclined(50)])
    for operation, k in (("Trip out", MU), ("Trip in", -MU)):
        yield f"straight hole of 50 deg, {operation}", straight(
            0, LENGTH, 50, k), found[operation]["hook_load"], "N", exact
    yield "the same, Rotate off bottom: torque", MU * OUTER * WEIGHT * LENGTH * math.sin(
        math.radians(50)), found["Rotate off bottom"]["surface_torque"], "N m", exact
    found = run("build", SOFT)
    for operation, k in (("Trip out", MU), ("Trip in", -MU)):
        yield f"vertical, build of 3 deg/30 m to 60 deg, tangent, {operation}", build_and_hold(
            k), found[operation]["hook_load"], "N", exact
    yield "the same, Drill sliding", build_and_hold(
        -MU, 5e4), found["Drill sliding"]["hook_load"], "N", exact
    yield "the same, Rotate off bottom: torque", turning(
    ), found["Rotate off bottom"]["surface_torque"], "N m", exact
    # the approximation neglects friction of the weight within the bend: 0.4 % of this hook load
    yield "the same, Trip out, by the approximation for bends in space", in_space(
        MU), found["Trip out"]["hook_load"], "N", 5e-3
    found = run("drop", [*SOFT, *arc(400, 60, 0, LENGTH)])
    tangent = LENGTH - 400 - RADIUS * math.radians(60)
    for operation, k in (("Trip out", MU), ("Trip in", -MU)):
        truth = straight(bend(straight(0, tangent, 0, k), 0, 60, k), 400, 60, k)
        yield f"drop from 60 deg, vertical below, {operation}", truth, found[operation][
            "hook_load"], "N", exact
    turn = LENGTH / RADIUS
    side = [
        *SOFT, "Well/Trajectory=Survey",
        "Well/Survey/Stations={0, 90, 0, 900, 90, 90, 1800, 90, 180}"
    ]
    found = run("side_bend", side)
    wr = WEIGHT * RADIUS
    yield "horizontal side bend, Trip out: w R sinh(mu phi)", wr * math.sinh(
        MU * turn), found["Trip out"]["hook_load"], "N", exact
    push = -wr * math.sinh(math.asinh(5e4 / wr) + MU * turn)
    yield "the same, Drill sliding: -w R sinh(asinh(W/w R) + mu phi)", push, run(
        "side_bend_pushed",
        [*side, "Torque and Drag/Helical Contact=false"])["Drill sliding"]["hook_load"], "N", exact
    helix = [
        *SOFT, "Well/Trajectory=Helix", "Well/Helix/Radius=300", "Well/Helix/Angle=4",
        "Well/Helix/Length=1500", "Loads/Gravity=1e-6"
    ]
    kappa = 300 * (4 / 1500)**2
    yield "helix almost without weight, Drill sliding: -W exp(mu kappa s)", -5e4 * math.exp(
        MU * kappa * LENGTH), run("helix", helix)["Drill sliding"]["hook_load"], "N", exact
    pushed = run("lock_up", [
        *SOFT, *inclined(90), "Loads/Weight On Bit=220 kN", "Contact/Friction/Static=0.4",
        "Contact/Friction/Dynamic=0.4"
    ])["Drill sliding"]
    # the integration has steps of 3 m
    yield "horizontal hole, mu = 0.4, Drill sliding under 220 kN: lock-up above the bit", lock_up(
        220e3, 0.4), LENGTH - pushed["lock_up_depth"], "m", 3e-3


LIMIT = 1 / math.sqrt(
    1 + MU * MU)  # side force divided by load for a rotating string that climbs the wall

TESTED = ((1, YOUNG), (6, YOUNG / 100), (1, YOUNG / 10), (1, YOUNG / 100))
STEEL_AND_SOFT = tuple(
    (clearance, young) for young in (YOUNG, YOUNG / 100) for clearance in (44.5, 6, 1))


def stiff(run, cases):
    """Ratios of the stiff string to the soft one in the well of the deck: (clearance [mm], Young's
    modulus [Pa], torque off bottom, drag of Trip out)."""
    for clearance, young in cases:
        found = run(f"stiff_{clearance:g}_{young / 1e9:g}", [
            *PIPE, "Torque and Drag/Operations={Trip out, Rotate off bottom}",
            f"Well/Bore Radius={OUTER + 1e-3 * clearance:g}",
            f"Drillstring/Material/Young Modulus={young / 1e9:g} GPa"
        ])
        out, off = found["Trip out"], found["Rotate off bottom"]
        yield clearance, young, off["stiff_surface_torque"] / off["surface_torque"], (
            out["stiff_hook_load"] - off["stiff_hook_load"]) / (out["hook_load"] - off["hook_load"])
