# SPDX-License-Identifier: BSD-3-Clause
"""Figures of a run of a string: the well, the static state, the motion."""
import numpy as np

import plots
from plots import COLOURS, GREY, RPM
from report import results
from report.quantities import fixed

BLUE, ORANGE, GREEN = COLOURS[:3]
PICTURE_ROWS = 240  # of the picture of contact forces over time and depth
JOINT = 15.0  # [m]: longer than a joint of drill pipe (API range 3, with its tool joint)
# rows of the picture per joint of pipe, so that the pipe body between tool joints is visible
RESOLVED = 8
STRETCHES = 100  # intervals of a profile by elements; longer than a joint of pipe
MOST_BARS = 400  # nodes of a profile drawn one by one, at most
FLOOR = 1e-8  # lower limit of a plotted spectrum, as a share of its largest value
DOWN_TO = f"drawn down to {plots.plain(FLOOR)} of the largest value"
EVEN = 1e-3  # smaller relative changes are drawn as a constant, to hide rounding


class Figure:
    """An inline SVG with its caption. Wide figures take two columns of the page, large ones a
    row."""
    def __init__(self, name, made, caption, wide=False, large=False):
        self.name, self.caption, self.size = (name, caption, "wide large"
                                              if large else "wide" if wide else "slender")
        self.svg = plots.inline_svg(made, name, tight=large)


def well(run):
    """Vertical section and map of the well, with the same scale."""
    north, east, down = run.get("/model/position").T
    away = np.hypot(north - north[0], east - east[0])
    depth = down - down[0]
    size = max(np.ptp(away), np.ptp(depth), np.ptp(north), np.ptp(east), 1.0)
    made, axes = plots.figure(plots.SLENDER, 4.2)
    axes.plot(away, depth, color=BLUE)
    axes.set_aspect("equal", adjustable="datalim")
    axes.invert_yaxis()
    axes.set_xlabel("horizontal distance [m]"), axes.set_ylabel("vertical depth [m]")
    found = [Figure("section", made, "Well, vertical section; both axes have one scale.")]
    if max(np.ptp(north), np.ptp(east)) > 1e-3 * size:
        made, axes = plots.figure(plots.SLENDER, 4.2)
        axes.plot(east, north, color=BLUE)
        axes.plot(east[0], north[0], "o", color=GREY, markersize=5)
        axes.set_aspect("equal", adjustable="datalim")
        axes.set_xlabel("east [m]"), axes.set_ylabel("north [m]")
        found.append(Figure("map", made, "Well from above; the dot is the surface."))
    return found


def static_profiles(run):
    limits = run.s[0], run.s[-1]
    sense = results.static_sense(run)
    found = []

    def add(name, label, caption, draw):
        made, axes = plots.profile(label, limits)
        draw(axes)
        found.append(Figure(name, made, caption))

    def forces(values, colour):
        def draw(axes):
            axes.plot(values / 1e3, run.middles, color=colour, linewidth=1.3)
            axes.axvline(0, color=GREY, linewidth=0.6)

        return draw

    def side(axes):
        force = run.get("/static/normal_force") / 1e3
        bars(axes, run.s, force, BLUE, 1.2)
        axes.set_xlim(left=0, right=max(1.08 * force.max(), 1e-3))

    def radial(axes):
        draw_clearance(axes, run.s, run.get("/model/clearance"))
        axes.plot(1e3 * results.lateral(run, run.get("/static/displacement")), run.s, color=GREEN,
                  linewidth=1.1, label="string")
        axes.set_xlim(left=0)
        plots.legend_above(axes, 2)

    add("axial", "effective axial force [kN]", "Static axial force; tension is positive.",
        forces(run.get("/static/axial_force"), ORANGE))
    add("torque", "torque [kN m]", f"Static torque, {results.AGAINST[sense]}.",
        forces(results.static_torque(run, sense), GREEN))
    add("side", "side force [kN]", "Static contact force of each node.", side)
    add("radial", "lateral displacement [mm]",
        "Static distance from the axis of the well, and the clearance.", radial)
    stress = results.von_mises(run, run.get("/static/displacement"))
    if stress is not None:
        add(
            "stress", "von Mises stress [MPa]",
            "Static stress at the outer wall: effective tension, bending, torsion" +
            ("; the largest of each stretch, pale down to the smallest."
             if len(stress) > 4 * STRETCHES else "."), lambda axes:
            (banded(axes, stress / 1e6, run.middles, COLOURS[4]), axes.set_xlim(left=0)))
    add(
        "curvature", "dogleg severity [deg/30 m]", "Curvature of the axis of the string at rest.",
        lambda axes: (axes.plot(
            np.degrees(results.curvature(run, run.get("/static/displacement"))) * 30, run.middles,
            color=COLOURS[5], linewidth=1.1), axes.set_xlim(left=0)))
    return found


def draw_clearance(axes, s, clearance):
    """The clearance [mm], pale; if it changes within an interval of depth, as at tool joints, its
    minimum is darker."""
    depth, narrow, wide = plots.stretches(s, 1e3 * clearance, min(STRETCHES, len(s) - 1))
    changes = np.any(wide > 1.001 * narrow)
    axes.fill_betweenx(depth, 0, wide, step="mid", color="#ececec", linewidth=0,
                       label="largest clearance" if changes else "clearance")
    if changes:
        axes.fill_betweenx(depth, 0, narrow, step="mid", color="#d2d2d2", linewidth=0,
                           label="least clearance")


def bars(axes, depth, values, colour, width=1.1):
    """A line from zero for each node; for many nodes the largest value of each interval, which is
    no wider on the page than a line."""
    if len(depth) > MOST_BARS:
        depth, _, values = plots.stretches(depth, values, MOST_BARS)
    axes.hlines(depth, 0, values, color=colour, linewidth=width)


def banded(axes, values, depth, colour):
    """Values along the depth; for many elements the largest value of each interval, and a pale band
    down to the smallest."""
    if len(depth) > 4 * STRETCHES:
        depth, low, values = plots.stretches(depth, values, STRETCHES)
        axes.fill_betweenx(depth, low, values, color=colour, alpha=0.2, linewidth=0)
    axes.plot(values, depth, color=colour, linewidth=1.1)


def draw_bit_speed(axes, time, bit, rotary):
    """Speeds [rad/s] of the bit and at the surface; the axis does not magnify the rounding of a
    steady speed."""
    axes.plot(*plots.envelope(time, RPM * bit), color=BLUE, linewidth=0.8, label="bit")
    axes.plot(*plots.envelope(time, RPM * rotary), color=ORANGE, linewidth=1.4, label="surface")
    low, high = axes.get_ylim()
    if high - low < 0.2:  # rpm
        axes.set_ylim(0.5 * (low + high) - 1, 0.5 * (low + high) + 1)
    plots.legend_above(axes)


def bit_speed(run):
    bit = run.bit_speed()
    if bit is None:
        return []
    made, axes = plots.in_time("speed [rpm]", run.time)
    draw_bit_speed(axes, run.time, bit, run.rotary())
    return [Figure("bit-speed", made, "Rotary speed of the bit and at the surface.", True)]


def surface(run):
    """Torques and hook load over time, as far as they are recorded.

    The plotted torques have one sign, positive against the rotation: /transient/surface_torque is
    against the rotation of each sample (to the right if nothing turns), /transient/torque_on_bit
    against a rotation to the right."""
    found = []
    sense = run.sense() or 1
    signs = {"surface_torque": sense * np.where(run.rotary() < 0, -1, 1), "torque_on_bit": sense}
    against = results.AGAINST[run.sense()]
    for name, label, said, lines in (
        ("torques", "torque [kN m]", f", {against}", (
            ("surface_torque", "at the surface", ORANGE),
            ("torque_on_bit", "of the rock on the bit", BLUE),
        )),
        ("hook-loads", "hook load [kN]", "", (("hook_load", "what the hook carries, without block",
                                               ORANGE),)),
    ):
        recorded = [(signs.get(data, 1) * values, text, colour) for data, text, colour in lines
                    if (values := run.get(f"/transient/{data}")) is not None]
        if not recorded:
            continue
        made, axes = plots.in_time(label, run.time)
        for values, text, colour in recorded:
            axes.plot(*plots.envelope(run.time, values / 1e3), color=colour, linewidth=0.9,
                      label=text)
        low, high = axes.get_ylim()
        least = EVEN * max(abs(low), abs(high), 1.0)
        if high - low < least:
            axes.set_ylim(0.5 * (low + high - least), 0.5 * (low + high + least))
        plots.legend_above(axes)
        found.append(
            Figure(
                name, made, f"{label.split(' [')[0].capitalize()} over time: "
                f"{' and '.join(text for _, text, _ in recorded)}{said}.", True))
    return found


def joint_length(s, radius):
    """Largest distance [m] between adjacent nodes that touch first, being wider than their
    neighbours; 0 without such a pattern of tool joints."""
    above, own, below = radius[:-2], radius[1:-1], radius[2:]
    apart = np.diff(s[1:-1][(own >= above) & (own >= below) & (own > np.minimum(above, below))])
    return max(apart[apart <= JOINT], default=0.0)


def contact_picture(s, middles, radius, force):
    """Contact force over depth (rows of equal intervals) and time: the largest force of the nodes
    whose part of the string is in a row.

    Pipe bodies between tool joints seldom touch. Rows shorter than a joint of pipe, but too long to
    resolve it, would contain a pipe body in one place and a tool joint in another; such rows are
    made as long as a joint."""
    rows, joint = PICTURE_ROWS, joint_length(s, radius)
    if joint * rows < RESOLVED * (s[-1] - s[0]):
        rows = min(rows, int((s[-1] - s[0]) / joint)) if joint > 0 else rows
    edges = np.linspace(s[0], s[-1], rows + 1)
    first, last = np.searchsorted(middles, edges[:-1],
                                  side="right"), np.searchsorted(middles, edges[1:], side="left")
    return np.array([force[:, a:b + 1].max(axis=1) for a, b in zip(first, last)])


def contact(run, found):
    if found.force is None or not found.largest.max() > 0:
        return []
    s = run.s
    shares = contact_shares(run, found)
    if not run.moves:
        return shares
    made, axes = plots.figure(plots.WIDE, 3.2)
    picture = contact_picture(s, run.middles, run.get("/model/contact_radius"), found.force)
    shown = axes.imshow(np.ma.masked_less_equal(picture / 1e3, 0), aspect="auto", cmap=plots.MAP,
                        extent=(found.time[0], found.time[-1], s[-1], s[0]),
                        interpolation="nearest")
    axes.grid(False)
    axes.set_xlabel("time [s]"), axes.set_ylabel("measured depth [m]")
    made.colorbar(shown, ax=axes, label="contact force [kN]")
    return [
        Figure(
            "contact", made, "Contact force over the motion, the largest of each "
            f"{(s[-1] - s[0]) / len(picture):.2g} m of depth; white: no contact.", True), *shares
    ]


def contact_shares(run, found):
    """Share of time in contact of the recorded nodes."""
    s, limits = run.s[run.recorded], (run.s[0], run.s[-1])
    made, axes = plots.profile("share of time in contact [%]", limits)
    bars(axes, s, 100 * found.duty, BLUE)
    axes.set_xlim(0, 100)
    duty = Figure("duty", made, "Share of the second half of the motion in contact.")
    made, axes = plots.profile("largest contact force [kN]", limits)
    bars(axes, s, found.largest / 1e3, ORANGE)
    axes.set_xlim(left=0)
    return [duty, Figure("largest", made, "Largest contact force of each node in the motion.")]


def vibration(run, motion):
    """Vibration along the string."""
    found = []
    for name, label, values, colour, caption in (
        ("rms", "lateral vibration [mm rms]", 1e3 * motion.lateral_rms(), GREEN,
         "Lateral vibration about the mean position, second half of the motion."),
        ("twist", "torsional vibration [deg rms]", np.degrees(motion.rms[:, 5]), COLOURS[4],
         "Torsional vibration about the mean twist, second half of the motion."),
    ):
        if values.max() <= (1e3 if name == "rms" else np.degrees(1)) * results.VIBRATES:
            continue
        made, axes = plots.profile(label, (run.s[0], run.s[-1]))
        axes.plot(values, run.s[run.recorded], color=colour, linewidth=1.1,
                  **({} if run.moves else {"marker": "o", "markersize": 4, "linestyle": ":"}))
        axes.set_xlim(left=0)
        found.append(Figure(name, made, caption))
    return found


def whirl(run, motion, number, turned):
    """Text of a caption on the mean precession of a chosen node: positive in the sense of the
    rotation. `turned`: result of results.sides."""
    half = slice(motion.first, None)
    time = run.time[half]
    a, b = turned @ motion.histories[half, number, :2].T
    rates = [results.differences(values, time) for values in (a, b)
             ] if motion.velocities is None else turned @ motion.velocities[:, number].T
    sense, speed = run.sense(half), np.abs(run.rotary()[half]).mean()
    turn = (sense or 1) * results.precession(a, b, *rates)
    ratio = f", {fixed(turn / speed, 2)} of the surface speed" if speed > 0 else ""
    forward = {
        1: "clockwise is forward, positive", -1: "anticlockwise is forward, positive",
        0: "clockwise is positive"
    }[sense]
    coarse = ""
    if motion.velocities is None and len(time) > 1:
        turns = (f"; {2 * np.pi / speed / np.median(np.diff(time)):.3g} samples a turn of the "
                 "surface") if speed > 0 else ""
        coarse = ("; from displacements alone, without velocity in Output/Fields: 1 % too small "
                  f"at 26 samples a turn of the orbit, 10 % at 8{turns}")
    return f"mean precession {fixed(RPM * turn, 1)} rpm{ratio}; {forward}{coarse}"


def orbits(run, motion, chosen):
    """The path of the string axis in the bore at the chosen nodes that vibrate, in the second half
    of the motion, looking down the hole."""
    found = []
    clearance = run.get("/model/clearance")
    half = slice(motion.first, None)
    for number, (node, why) in enumerate(chosen.items()):
        if not motion.vibrates[number]:
            continue
        (up, right), turned = results.sides(run, node)
        a, b = 1e3 * turned @ motion.histories[half, number, :2].T
        made, axes = plots.figure(plots.SLENDER, 3.0)
        gap = 1e3 * clearance[node]
        largest = max(np.abs(a).max(), np.abs(b).max(), 1e-3)
        if gap < 20 * largest:
            angle = np.linspace(0, 2 * np.pi, 120)
            axes.plot(gap * np.cos(angle), gap * np.sin(angle), color=GREY, linewidth=1.2)
            largest = max(largest, gap)
        axes.plot(plots.thinned(b, 2500), plots.thinned(a, 2500), color=BLUE, linewidth=0.6)
        axes.plot(b[-1], a[-1], "o", color=ORANGE, markersize=4)
        plots.square(axes, 1.08 * largest)
        axes.set_xlabel(f"{right} [mm]"), axes.set_ylabel(f"{up} [mm]")
        circle = "" if gap < 20 * largest else (f"; the clearance of {gap:.0f} mm is out of the "
                                                "picture")
        found.append(
            Figure(
                f"orbit-{number + 1}", made, f"Orbit at {run.s[node]:.1f} m, {why}, second half of "
                "the motion, looking down the hole; "
                f"{whirl(run, motion, number, turned)}{circle}."))
    return found


def frequency_axes(label):
    made, axes = plots.figure(plots.WIDE, 2.4)
    axes.set_yscale("log")
    axes.set_xlabel("frequency [Hz]"), axes.set_ylabel(label)
    return made, axes


def draw_density(axes, frequency, power, **line):
    """A line of a spectrum; the vertical axis ends at FLOOR times the largest value of all
    lines."""
    if len(frequency) > 2 and power[1:].max() > 0:
        axes.plot(frequency[1:], power[1:], linewidth=0.9, **line)
        top = max(drawn.get_ydata().max() for drawn in axes.lines)
        axes.set_ylim(FLOOR * top, 3 * top)
        plots.logarithmic(axes.yaxis)


def draw_spectrum(axes, values, interval, **line):
    draw_density(axes, *plots.spectrum(values, interval), **line)


def spectra(run, motion, chosen):
    """Spectra of the lateral motion of the chosen nodes and of the bit speed, where they
    vibrate."""
    half = slice(motion.first, None)
    interval = float(np.median(np.diff(run.time)))
    found = []
    if motion.vibrates.any():
        made, axes = frequency_axes("lateral displacement [mm²/Hz]")
        for number, node in enumerate(chosen):
            if motion.vibrates[number]:
                up = 1e3 * motion.histories[half, number, :2] @ results.sides(run, node)[1][0]
                draw_spectrum(axes, up, interval, color=COLOURS[number],
                              label=f"{run.s[node]:.0f} m, {results.sides(run, node)[0][0]}")
        if axes.lines:
            plots.legend_above(axes, 3)
            found.append(
                Figure(
                    "lateral-spectrum", made, "Spectra of the lateral displacement at the nodes "
                    f"of the orbits, second half of the motion, {DOWN_TO}.", True))
        else:
            plots.plt.close(made)
    bit = run.bit_speed()
    if bit is not None and np.std(bit[half]) > results.VIBRATES:
        made, axes = frequency_axes("bit speed [rpm²/Hz]")
        draw_spectrum(axes, RPM * bit[half], interval, color=BLUE)
        if axes.lines:
            found.append(
                Figure("bit-spectrum", made,
                       f"Spectrum of the bit speed, second half of the motion, {DOWN_TO}.", True))
        else:
            plots.plt.close(made)
    return found
