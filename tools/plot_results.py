#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the results of a run.

    tools/plot_results.py DIR [--output FILE.png] [--animate FILE.gif|FILE.mp4]

For a string: the well coloured by contact force, profiles of lateral displacement, contact force,
axial force and torque along the measured depth, and the bit speed over time. For a scene of parts,
for each component: displacement at the start and largest displacement of all nodes, and the motion
of the node with the largest motion; recorded forces between parts. --animate also draws the motion:
the lateral displacement of the string in its clearance, or the parts in space with magnified
displacements. Needs h5py, numpy and matplotlib; reads only results.h5.
"""
import pathlib
import sys

try:
    import h5py
    import numpy as np

    import plots
    from plots import COLOURS, GREY, MAP, RPM, plt
    from report import figures, files, folder, scene3d
except ImportError as missing:
    sys.exit(f"{missing}: plot_results.py needs h5py, numpy and matplotlib (Debian: python3-h5py "
             "python3-matplotlib, then /usr/bin/python3).")

BLUE, ORANGE, GREEN = COLOURS[:3]
WALL = "#e2e2e2"
KIND = "folder of a run that ended"
MOST_PICTURES = 200  # of an animation at most
FIELDS = ("velocity", "acceleration", "normal_force")  # of Output/Fields, without the displacement
ALONG = 0.999  # cosine; directions above it count as parallel
LARGEST_SHARE = 0.1  # largest displacement shown, as a share of the size of the scene


def draw_well(made, results):
    """Nodes on the well axis (deviation not to scale), coloured by the static contact force."""
    position, force = results["/model/position"][:], results["/static/normal_force"][:] / 1e3
    axes = plots.space_axes(made, 111)
    axes.plot(*position.T, color="0.8", linewidth=4, zorder=0)
    points = axes.scatter(*position.T, c=force, cmap=MAP, s=8, depthshade=False)
    plots.equal_axes(axes, position)
    made.colorbar(points, ax=axes, location="top", shrink=0.7, pad=0.02,
                  label=plots.label("static contact force", "kN"))


def draw_static(row, results):
    """Profiles along the measured depth."""
    s = results["/model/s"][:]
    middle = 0.5 * (s[1:] + s[:-1])
    displacement = results["/static/displacement"][:]
    radial, contact, axial, torque = row
    plots.profiles(row, [
        plots.label(*pair) for pair in (("lateral displacement", "mm"), ("contact force", "kN"),
                                        ("axial force", "kN"), ("torque", "kN m"))
    ], (s[0], s[-1]))
    figures.draw_clearance(radial, s, results["/model/clearance"][:])
    radial.plot(1e3 * np.hypot(displacement[:, 0], displacement[:, 1]), s, color=BLUE,
                linewidth=1.0, label="string")
    radial.set_xlim(left=0)
    plots.legend_above(radial, 1)
    contact.hlines(s, 0, results["/static/normal_force"][:] / 1e3, color=BLUE, linewidth=1.2)
    contact.set_xlim(left=0)
    for axes, name, colour in ((axial, "axial_force", ORANGE), (torque, "torque", GREEN)):
        axes.plot(results[f"/static/{name}"][:] / 1e3, middle, color=colour, linewidth=1.3)
        axes.axvline(0, color=GREY, linewidth=0.6)


def draw_motion(axes, results):
    time = results["/transient/time"][:]
    plots.whole_ticks(axes, 8, 5)
    figures.draw_bit_speed(axes, time, results["/transient/motion"][:, 2],
                           results["/transient/speed"][:])
    axes.set_xlim(time[0], time[-1])
    axes.set_xlabel(plots.label("time", "s")), axes.set_ylabel(plots.label("speed", "rpm"))


def draw_string(results):
    moves = "/transient/motion" in results
    made = plt.figure(figsize=(12, 8.5 if moves else 5.8), constrained_layout=True)
    plots.headline(
        made, f"String of {results['/model/s'][-1]:.0f} m: static state" +
        (" and speed of the bit" if moves else ""), folder.conditions(results))
    rows = made.subfigures(2 if moves else 1, 1, height_ratios=[2.2, 1] if moves else [1],
                           squeeze=False)[:, 0]
    well, static = rows[0].subfigures(1, 2, width_ratios=[1, 2])
    draw_well(well, results)
    draw_static(static.subplots(1, 4, sharey=True), results)
    if moves:
        draw_motion(rows[1].subplots(), results)
    return made


def texts(dataset):
    return [value.decode() if isinstance(value, bytes) else value for value in dataset[:]]


def recorded(results):
    """Rows (from 0) of the nodes with recorded motion."""
    return results["/transient/node"][:] - 1 if "/transient/node" in results else np.arange(
        len(results["/static/displacement"]))


def draw_nodes(axes, results, start, motion):
    """A component of all recorded nodes, part by part: at the start, and the range of the motion
    (samples x nodes, or None)."""
    part, names = results["/model/part"][:][recorded(results)], texts(results["/model/part_names"])
    row = np.arange(part.size)
    if motion is not None:
        axes.fill_between(row, motion.min(axis=0), motion.max(axis=0), step="mid", color=COLOURS[5],
                          alpha=0.3, linewidth=0, label="range of the motion")
    axes.plot(row, start, "k.", markersize=3, label="start")
    for first in np.flatnonzero(np.diff(part)):
        axes.axvline(first + 0.5, color="0.8", linewidth=0.6)
    axes.set_xticks([row[part == number].mean() for number in np.unique(part)])
    axes.set_xticklabels([names[number - 1] for number in np.unique(part)], fontsize=7, rotation=20)
    axes.set_xlim(-0.5, part.size - 0.5)


def draw_mover(axes, results, start, motion):
    """Time history of the node with the largest motion."""
    column = int(np.abs(motion - start).max(axis=0).argmax())
    node = recorded(results)[column]
    name = texts(results["/model/part_names"])[results["/model/part"][node] - 1]
    axes.plot(*plots.envelope(results["/transient/time"][:], motion[:, column]), color=BLUE,
              linewidth=0.7)
    axes.set_title(f"node {results['/model/node'][node]} of {name}, which moves most", fontsize=7,
                   fontweight="normal", pad=2)


def draw_forces(axes, results, name):
    """A recorded channel of a point law: the largest magnitude over its points."""
    channel = results[name]
    axes.plot(
        *plots.envelope(results["/transient/time"][:],
                        np.abs(channel[:]).reshape(len(channel), -1).max(axis=1)), color=ORANGE,
        linewidth=0.7)
    axes.set_title(f"{name.removeprefix('/transient/')}, largest size over its points", fontsize=7,
                   fontweight="normal", pad=2)
    axes.set_ylabel(plots.label(name.split("/")[-1].replace("_", " "), channel.attrs["units"]))


def draw_parts(results):
    components, units = texts(results["/model/components"]), texts(
        results["/model/component_units"])
    start = results["/static/displacement"][:][recorded(results)]
    motion = results["/transient/displacement"][:] if "/transient/displacement" in results else None
    moving = results.get("/transient", {})
    channels = [
        f"/transient/{law}/{name}" for law in moving if isinstance(moving[law], h5py.Group)
        for name in moving[law]
    ]
    rows, columns = len(components) + len(channels), 1 if motion is None and not channels else 2
    made, axes = plt.subplots(rows, columns, figsize=(5.5 * columns, 1.6 + 1.4 * rows),
                              squeeze=False, constrained_layout=True)
    names = texts(results["/model/part_names"])
    plots.headline(made, f"{len(names)} parts, {start.shape[0]} nodes: displacements",
                   folder.conditions(results))
    for c, (name, unit) in enumerate(zip(components, units)):
        draw_nodes(axes[c, 0], results, start[:, c], None if motion is None else motion[:, :, c])
        axes[c, 0].set_ylabel(plots.label(name, unit))
        axes[c, 0].tick_params(labelbottom=c + 1 == len(components))
        if motion is not None:
            draw_mover(axes[c, 1], results, start[:, c], motion[:, :, c])
            axes[c, 1].set_ylabel(plots.label(name, unit))
        elif columns == 2:
            axes[c, 1].axis("off")
    for row, name in enumerate(channels, len(components)):
        axes[row, 0].axis("off")
        draw_forces(axes[row, 1], results, name)
    axes[len(components) - 1, 0].set_xlabel("nodes, part by part")
    plots.legend_above(axes[0, 0])
    if columns == 2:
        axes[-1, 1].set_xlabel(plots.label("time", "s"))
    return made


def draw(results):
    return draw_parts(results) if "/model/part_names" in results else draw_string(results)


def lateral_names(results):
    """Names of u and v: the nodal frames are carried along the well without spin, from north and
    east if it starts downwards."""
    frame = results.get("/model/frame")
    known = frame is not None and frame[0, 0, 0] > ALONG
    if known:
        return "u, north at the surface", "v, east at the surface"
    return "displacement u", "displacement v"


def moving_string(results, samples):
    """(figure, function of a sample): the lateral displacements of the string in its clearance."""
    s, clearance, rows = results["/model/s"][:], 1e3 * results["/model/clearance"][:], results[
        "/transient/displacement"]
    made, pair = plt.subplots(1, 2, figsize=(6.2, 5.5), sharey=True, constrained_layout=True)
    plots.profiles(pair, [plots.label(name, "mm") for name in lateral_names(results)],
                   (s[0], s[-1]))
    reach = max(1e3 * float(np.abs(rows[samples, :, :2]).max()), 1e-6)
    lines = []
    for axes in pair:
        axes.fill_betweenx(s, -clearance, clearance, step="mid", color=WALL, linewidth=0)
        axes.set_xlim(-1.1 * reach, 1.1 * reach)
        lines += axes.plot([], [], color=BLUE, linewidth=1.0)
    said = folder.conditions(results)

    def show(sample, time):
        for line, values in zip(lines, rows[sample, :, :2].T):
            line.set_data(1e3 * values, s)
        return f"String in its clearance, t = {time:.3f} s", said

    return made, show


def moving_parts(results, samples):
    """(figure, function of a sample): the nodes with known positions in space, displacements
    magnified."""
    position, rows = results["/model/position"][:], results["/model/located"][:] - 1
    links = [pair for pair in results["/model/links"][:] - 1 if np.isin(pair, rows).all()]
    components, motion = texts(results["/model/components"]), results["/transient/displacement"]
    places = [list(np.searchsorted(rows, pair)) for pair in links]
    places += map(list, scene3d.held_edges(position, results["/model/part"][:][rows], places))
    columns = [components.index(name) if name in components else None for name in ("u", "v", "w")]
    move = lambda sample: np.column_stack(
        [motion[sample][rows, c] if c is not None else np.zeros(len(rows))
         for c in columns])  # noqa: E731
    largest = max(float(np.abs(move(sample)).max()) for sample in samples)
    size = float(np.ptp(position, axis=0).max())
    factor = float(f"{LARGEST_SHARE * size / largest:.1g}") if largest > 0 and size > 0 else 1.0
    made = plt.figure(figsize=(6.2, 5.5), constrained_layout=True)
    axes = plots.space_axes(made, 111, ("x", "y", "z"))
    plots.equal_axes(
        axes, np.concatenate([position - LARGEST_SHARE * size, position + LARGEST_SHARE * size]))
    for pair in places:
        axes.plot(*position[pair].T, color="0.8", linewidth=1.0)
    lines = [axes.plot([], [], [], color=BLUE, linewidth=1.4)[0] for _ in places]
    dots, = axes.plot([], [], [], ".", color=ORANGE, markersize=3)
    said = folder.conditions(results)

    def show(sample, time):
        moved = position + factor * move(sample)
        for line, pair in zip(lines, places):
            line.set_data_3d(*moved[pair].T)
        dots.set_data_3d(*moved.T)
        return f"Displacements times {factor:g}, t = {time:.4f} s", said

    return made, show


def animate(results, path):
    """The motion as an animation of at most MOST_PICTURES samples."""
    if "/transient/time" not in results:
        sys.exit("results.h5 has no motion to animate: the run ended with its static state. Run a "
                 "deck with a list Transient (without --without Transient), or leave --animate "
                 "out.")
    if "/transient/displacement" not in results:
        others = [name for name in FIELDS if f"/transient/{name}" in results]
        nodes = ", without Output/Depths and Output/Nodes" if "/transient/node" in results else ""
        sys.exit("results.h5 has a motion without displacements (of the fields it holds "
                 f"{', '.join(others) or 'none'}). Run the deck again with --set "
                 f"\"Output/Fields={{{', '.join(['displacement', *others])}}}\"{nodes}, or leave "
                 "--animate out.")
    if "/transient/node" in results:
        sys.exit("results.h5 has the motion of chosen nodes alone. Take Output/Depths or "
                 "Output/Nodes out and run the deck again, or leave --animate out.")
    time = results["/transient/time"][:]
    samples = np.unique(np.linspace(0, len(time) - 1, min(len(time), MOST_PICTURES)).astype(int))
    parts = "/model/part_names" in results
    if parts and "/model/located" not in results:
        sys.exit("The parts of these results have no positions, so they cannot be drawn in space. "
                 "Give coordinates in their part files, or leave --animate out.")
    made, show = (moving_parts if parts else moving_string)(results, samples)
    title, said = show(samples[0], time[samples[0]])
    plots.headline(made, title, said)

    def draw_sample(number):
        sample = samples[number]
        words = made._suptitle.get_text().split("\n")
        made._suptitle.set_text("\n".join([show(sample, time[sample])[0], *words[1:]]))

    plots.animate(path, made, draw_sample, len(samples))


def main():
    parser = folder.parser(__doc__, KIND, ["results.h5"])
    parser.add_argument(
        "--animate", type=pathlib.Path, metavar="FILE",
        help="the motion as FILE.gif, or as FILE.mp4 where ffmpeg is installed, besides the picture"
    )
    options = parser.parse_args()
    plots.use_style()
    name, results = folder.opened(options.folder, KIND, ["results.h5"])
    with results:
        with files.failing(), files.reading(options.folder / name):
            made = draw(results)
        folder.save(made, options.output or options.folder / "results.png")
        if options.animate:
            try:
                animate(results, options.animate)
            except ValueError as problem:
                sys.exit(f"plot_results.py: {problem}")
            print(f"drawn {options.animate}")


if __name__ == "__main__":
    main()
