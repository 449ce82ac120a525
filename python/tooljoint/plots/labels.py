# SPDX-License-Identifier: BSD-3-Clause
"""Texts in plots that do not overlap anything."""
from __future__ import annotations

import itertools
import math
from typing import Any, Iterable, Mapping, NamedTuple

import numpy as np
from matplotlib.text import Text

NEAR = (7, 16, 28, 44, 62)  # distances of a text from its point, tried in this order [pixels]
CLEAR = 24.0  # cost of a text at the largest distance that covers nothing
LONGEST = 56  # characters of a line in a legend of two columns
ROW = 0.28  # height of a row of that legend [inch]
SHARED = 1.0  # two boxes with a smaller overlap only touch [pixels]


class Place(NamedTuple):
    """Position of a text [pixels]."""

    cost: float
    left: float
    low: float
    width: float
    height: float
    point: Any
    distance: float


class Labels:
    """Texts beside points, put where they cover the least: other texts, markers and lines.
    The limits of the axes must be final."""
    def __init__(self, axes: Any):
        self.axes = axes
        self.boxes: list[tuple[float, float, float, float]] = []
        self.points: list[Any] = []
        axes.figure.canvas.draw()
        self.renderer = axes.figure.canvas.get_renderer()

    def occupy(self, x: Any, y: Any) -> None:
        """A line through these points: later texts avoid it."""
        pixels = self.axes.transData.transform(np.column_stack([x, y]).astype(float))
        self.points.extend(pixels)
        for a, b in zip(pixels[:-1], pixels[1:]):
            self.points.extend(
                a + (b - a) * f
                for f in np.linspace(0, 1, max(2, int(np.hypot(*(b - a)) / 6)), endpoint=False))

    def find(self, text: str, anchors: Iterable[Any], size: float = 9, weight: str = "normal",
             reach: Iterable[float] = NEAR) -> Place:
        """The best place around one of the anchors (data coordinates)."""
        sample = self.axes.text(0, 0, text, fontsize=size, fontweight=weight)
        box = sample.get_window_extent(self.renderer)
        sample.remove()
        frame = self.axes.get_window_extent(self.renderer)
        points = np.array(self.points) if self.points else np.zeros((0, 2))
        places = []
        for anchor, distance, angle in itertools.product(anchors, reach, range(0, 360, 15)):
            point = self.axes.transData.transform(anchor)
            dx, dy = math.cos(math.radians(angle)), math.sin(math.radians(angle))
            left = point[0] + dx * distance * 1.4 - box.width * (0.5 - 0.5 * dx)
            low = point[1] + dy * distance * 1.4 - box.height * (0.5 - 0.5 * dy)
            cost = self.cost(left, low, box.width, box.height, frame, points) + 0.35 * distance
            places.append(Place(cost, left, low, box.width, box.height, point, distance))
        return min(places, key=lambda place: place.cost)

    def occupied(self, place: Place) -> None:
        self.boxes.append(
            (place.left, place.low, place.left + place.width, place.low + place.height))

    def draw(self, text: str, place: Place, colour: str, size: float = 9,
             weight: str = "normal") -> None:
        """Draws the text at its place, with a thin line to its point if that is far."""
        left, low = place.left, place.low
        inverse = self.axes.transData.inverted()
        self.axes.text(*inverse.transform(
            (left, low)), text, color=colour, fontsize=size, fontweight=weight, va="bottom",
                       ha="left", zorder=6, clip_on=False, linespacing=1.1)
        if place.distance > 20:
            near = (min(max(place.point[0], left),
                        left + place.width), min(max(place.point[1], low), low + place.height))
            self.axes.plot(*zip(inverse.transform(near), inverse.transform(place.point)),
                           color=colour, linewidth=0.5, alpha=0.6, zorder=1)

    def put(self, text: str, anchors: Iterable[Any], colour: str, size: float = 9,
            weight: str = "normal", reach: Iterable[float] = NEAR) -> bool:
        """Draws the text around one of the anchors. False, without a text, if every place would
        cover something."""
        place = self.find(text, anchors, size, weight, reach)
        if place.cost > CLEAR:
            return False
        self.draw(text, place, colour, size, weight)
        self.occupied(place)
        return True

    def cost(self, left: float, low: float, width: float, height: float, frame: Any,
             points: Any) -> float:
        right, top = left + width, low + height
        cost = 0.0
        for x0, y0, x1, y1 in self.boxes:
            overlap = max(0.0,
                          min(right, x1 + 3) - max(left, x0 - 3)) * max(
                              0.0,
                              min(top, y1 + 2) - max(low, y0 - 2))
            cost += 2.0 * overlap
        if len(points):
            inside = (points[:, 0] > left - 3) & (points[:, 0] < right + 3) & (
                points[:, 1] > low - 3) & (points[:, 1] < top + 3)
            cost += 25.0 * np.count_nonzero(inside)
        outside = max(0, frame.x0 - left) + max(0, right - frame.x1) + max(0, frame.y0 - low) + max(
            0, top - frame.y1)
        return cost + 40.0 * outside


def name_lines(labels: Labels, lines: Mapping[str, Any], size: float = 9) -> bool:
    """Names each line (name -> Line2D) beside it. If one of the names has no free place, all are in
    a legend below the axes instead, in the order of the lines; the result is then False."""
    names = {name: wrapped(name) for name in lines}
    before, found = len(labels.boxes), {}
    for name, line in lines.items():
        found[name] = labels.find(names[name], line.get_xydata(), size, "bold")
        if found[name].cost > CLEAR:
            del labels.boxes[before:]
            texts = [wrapped(each, LONGEST) for each in lines]
            made = labels.axes.figure
            made.set_figheight(made.get_figheight() + ROW * -(-len(texts) // 2))
            labels.axes.legend(lines.values(), texts, loc="upper left", bbox_to_anchor=(0.0, -0.12),
                               ncol=2, borderaxespad=0.0, fontsize=8)
            return False
        labels.occupied(found[name])
    for name, line in lines.items():
        labels.draw(names[name], found[name], line.get_color(), size, "bold")
    return True


def wrapped(name: str, width: int = 24) -> str:
    """Long names on two lines, broken at a comma or a blank near the middle.

    >>> wrapped("Generalized-alpha, full, stopped early")
    'Generalized-alpha,\\nfull, stopped early'
    """
    breaks = [i for i, c in enumerate(name) if c == " "]
    if len(name) <= width or not breaks:
        return name
    at = min(breaks, key=lambda i: abs(i - len(name) / 2) - (9 if name[i - 1] == "," else 0))
    return name[:at] + "\n" + name[at + 1:]


def overlaps(made: Any) -> list[str]:
    """Texts of a figure that overlap or are cut off at its edge, one line each. Not checked:
    rotated texts, whose boxes are larger than the texts, and texts whose place is reserved by
    another one (a title for its conditions)."""
    made.canvas.draw()
    renderer, hidden, faults = made.canvas.get_renderer(), undrawn(made), []
    seen = [
        text for text in made.findobj(Text) if text.get_visible() and text.get_in_layout()
        and text.get_text().strip() and text.get_rotation() % 90 == 0 and text not in hidden
    ]
    boxes = [(text.get_text().strip(), text.get_window_extent(renderer)) for text in seen]
    for text, box in boxes:
        if (box.x0 < -SHARED or box.y0 < -SHARED or box.x1 > made.bbox.x1 + SHARED
                or box.y1 > made.bbox.y1 + SHARED):
            faults.append(f"\"{text}\" is cut off")
    for (text, a), (other, b) in itertools.combinations(boxes, 2):
        across, down = min(a.x1, b.x1) - max(a.x0, b.x0), min(a.y1, b.y1) - max(a.y0, b.y0)
        if across > SHARED and down > SHARED:
            faults.append(f"\"{text}\" lies on \"{other}\"")
    return faults


def undrawn(made: Any) -> set[Any]:
    """Texts that exist but are not drawn: of hidden axes, and of ticks beyond the limits of an
    axis."""
    hidden: set[Any] = set()
    for axes in made.axes:
        if not axes.get_visible():
            hidden.update(axes.findobj(Text))
        for name in ("xaxis", "yaxis", "zaxis"):
            axis = getattr(axes, name, None)
            if axis is None:
                continue
            drawn = axis._update_ticks() if axes.axison else []
            if not axes.axison:
                hidden.update(axis.findobj(Text))
            for tick in {*axis.get_major_ticks(), *axis.get_minor_ticks()} - set(drawn):
                hidden.update((tick.label1, tick.label2))
    return hidden
