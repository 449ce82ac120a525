# SPDX-License-Identifier: BSD-3-Clause
"""The data of the 3-D view: positions, displacements and fields of a thinned motion, as numbers of
16 and 32 bits in base64.

Axes of the view are east, up, south (right-handed, up is y); for parts x, z, -y of the parts.
Displacements are lateral and axial in nodal frames of a string, x, y, z of parts. The motion is
thinned to NUMBERS node-samples, so that a page stays below 5 MB.
"""
import base64

import numpy as np

import plots
from report import results

NODES = 500  # of a string; more are not visible
SAMPLES = 600
NUMBERS = 150_000  # nodes times samples: each takes 8 to 10 bytes, 11 to 14 characters
LARGEST = 32767  # largest integer of 16 bits


def packed(values, kind):
    """Base64 text of an array: "f4", "u4", or "i2" with the scale that restores the values."""
    values = np.ascontiguousarray(values)
    entry = {"kind": kind, "shape": list(values.shape)}
    if kind == "i2":
        entry["scale"] = float(np.abs(values).max(initial=0.0)) / LARGEST or 1.0
        values = np.rint(values / entry["scale"])
    entry["data"] = base64.b64encode(values.astype("<" + kind).tobytes()).decode()
    return entry


def to_view(vectors):
    """Converts north, east, down to east, up, south."""
    return np.stack([vectors[..., 1], -vectors[..., 2], -vectors[..., 0]], axis=-1)


def kept_nodes(run):
    """At most NODES nodes: both ends, those around gauges and large side forces, and others at
    equal distances."""
    count = len(run.s)
    if count <= NODES:
        return np.arange(count)
    kept = {0, count - 1}
    clearance = run.get("/model/clearance")
    narrow = np.flatnonzero(clearance < 0.6 * np.median(clearance))
    force = run.get("/static/normal_force")
    for node in np.concatenate([np.argsort(-force)[:NODES // 5], narrow[:NODES // 5]]):
        kept.add(int(node))
    even = np.linspace(0, count - 1, NODES - len(kept)).round().astype(int)
    return np.array(sorted(kept | set(even.tolist())))


def samples_of(run, nodes):
    """Numbers of the samples that are played back."""
    return run.frames(max(2, min(SAMPLES, NUMBERS // nodes)))


def taken(dataset, at):
    """Rows `at` (at equal distances) of a dataset."""
    return dataset[::at[1] - at[0]] if len(at) > 1 else dataset[:1]


def colours():
    """64 colours of the colour map, red, green, blue from 0 to 1."""
    return plots.plt.get_cmap(plots.MAP)(np.linspace(0, 1, 64))[:, :3].round(3).tolist()


def field(name, label, unit, static, motion=None):
    """A coloured quantity of nodes: at rest and over the samples; the colour scale covers both."""
    largest = max(float(np.max(static)), float(np.max(motion)) if motion is not None else 0.0)
    if not largest > 0:
        return None
    entry = {
        "name": name, "label": label, "unit": unit, "largest": largest,
        "rest": packed(static, "f4")
    }
    if motion is not None:
        entry["motion"] = packed(motion, "i2")
    return entry


def at_nodes(elements):
    """Values of elements at nodes: the larger one of the adjacent elements."""
    padded = np.concatenate([elements[..., :1], elements, elements[..., -1:]], axis=-1)
    return np.maximum(padded[..., 1:], padded[..., :-1])


def of_string(run):
    """The scene of a string in its well."""
    kept = kept_nodes(run)
    position = run.get("/model/position")
    frames = np.stack([to_view(run.get("/model/frame")[:, :, axis]) for axis in range(3)], axis=1)
    rest = run.get("/static/displacement")
    radius = run.get("/model/contact_radius")
    bore = run.get("/model/clearance") + radius
    at = samples_of(run, len(kept)) if run.moves else None
    motion = taken(run.file["/transient/displacement"], at) if run.moves else None
    stress, force = results.von_mises(run, rest), run.get("/static/normal_force")
    moving_force = taken(
        run.file["/transient/normal_force"],
        at)[:, kept] / 1e3 if run.moves and "/transient/normal_force" in run.file else None
    fields = [
        field("stress", "von Mises stress", "MPa",
              at_nodes(stress)[kept] / 1e6,
              at_nodes(results.von_mises(run, motion))[:, kept] /
              1e6 if run.moves else None) if stress is not None else None,
        field("force", "contact force", "kN", force[kept] / 1e3, moving_force),
        field("displacement", "distance from the axis", "mm",
              1e3 * results.lateral(run, rest)[kept],
              1e3 * results.lateral(run, motion)[:, kept] if run.moves else None)
    ]
    data = {
        "kind": "string",
        "colours": colours(),
        "fields": [entry for entry in fields if entry],
        "position": packed(to_view(position)[kept], "f4"),
        "frames": packed(frames[kept], "f4"),
        "radius": packed(radius[kept], "f4"),
        "bore": packed(bore[kept], "f4"),
        "depth": packed(run.s[kept], "f4"),
        "rest": packed(rest[kept][:, :3], "f4"),
    }
    names = run.components()
    if names is not None:
        data["places"] = [[f"{name} ({run.s[first]:.0f} m)",
                           float(run.s[first])] for name, first in entries(names)][-12:]
    if run.moves:
        data["time"] = packed(run.time[at], "f4")
        data["motion"] = packed(motion[:, kept, :3], "i2")
    return data, describe(run, at, len(kept), len(run.s))


def entries(names):
    """Components with their start; adjacent equal ones are merged."""
    return [(name, element) for element, name in enumerate(names)
            if element == 0 or names[element - 1] != name]


def describe(run, at, shown, nodes):
    text = f"{shown} of {nodes} nodes are drawn." if shown < nodes else ""
    if run.records and not run.moves:
        text += (f" The motion of {len(run.recorded)} chosen nodes is recorded: the picture shows "
                 "the state at rest.")
    if at is not None and len(at) > 1:
        text += (" The motion is played back every "
                 f"{1e3 * (run.time[at[1]] - run.time[at[0]]):.3g} ms ({len(at)} of "
                 f"{len(run.time)} samples).")
    return text.strip()


def translations(run):
    """Columns of the components u, v, w of imported parts; -1 for a missing one."""
    names = results.texts(run.file["/model/components"])
    return [names.index(name) if name in names else -1 for name in ("u", "v", "w")]


def in_space(displacement, columns):
    return np.stack(
        [displacement[..., c] if c >= 0 else np.zeros(displacement.shape[:-1]) for c in columns],
        axis=-1)


def held_edges(position, part, edges):
    """Edges from nodes without edges, which are supports, to the nearest connected node of their
    part."""
    linked = np.unique(np.array(edges, int))
    found = []
    for node in np.setdiff1d(np.arange(len(part)), linked):
        others = linked[part[linked] == part[node]]
        if len(others):
            found.append((int(node),
                          int(others[np.linalg.norm(position[others] - position[node],
                                                    axis=1).argmin()])))
    return found


def of_parts(run):
    """Nodes of imported parts with known positions; otherwise (None, reason)."""
    if "/model/located" not in run.file:
        return None, "The part files give no positions: there is no view in space."
    rows = run.get("/model/located") - 1
    columns = translations(run)
    if max(columns) < 0:
        return None, ("No component of the parts is a translation u, v or w: there is no view in "
                      "space.")
    position = run.get("/model/position")
    step = max(1, -(-len(rows) // 6000))
    rows, position = rows[::step], position[::step]
    number = {row: i for i, row in enumerate(rows)}
    part, links = run.get("/model/part")[rows] - 1, run.get("/model/links")
    edges = [(number[a], number[b]) for a, b in links - 1
             if a in number and b in number] if links is not None else []
    edges += held_edges(position, part, edges) if step == 1 else []
    rest = in_space(run.get("/static/displacement"), columns)[rows]
    at = samples_of(run, len(rows)) if run.moves else None
    motion = in_space(taken(run.file["/transient/displacement"], at),
                      columns)[:, rows] if run.moves else None
    size = 1e3 * np.linalg.norm(
        rest, axis=-1), None if motion is None else 1e3 * np.linalg.norm(motion, axis=-1)
    turn = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])  # x, z up, -y
    data = {
        "kind": "parts",
        "colours": colours(),
        "fields": [
            entry for entry in [field("displacement", "displacement", "mm", *size)] if entry
        ],
        "position": packed(position @ turn.T, "f4"),
        "rest": packed(rest @ turn.T, "f4"),
        "links": packed(np.array(edges, dtype="u4").reshape(-1, 2), "u4"),
        "part": packed(part, "u4"),
    }
    if run.moves:
        data["time"] = packed(run.time[at], "f4")
        data["motion"] = packed(motion @ turn.T, "i2")
    return data, describe(run, at, len(rows), len(run.get("/model/located")))
