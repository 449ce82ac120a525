# SPDX-License-Identifier: BSD-3-Clause
"""Curves with fewer points, and spectra."""
from __future__ import annotations

from typing import Any

import numpy as np


def thinned(values: Any, most: int = 1500) -> Any:
    """Every k-th row, so that at most `most` remain; for curves finer than a screen resolves."""
    step = max(1, -(-len(values) // most))
    return values[::step]


def envelope(times: Any, values: Any, most: int = 1200) -> tuple[Any, Any]:
    """Curve of at most `most` points that keeps the extremes of every interval."""
    if len(times) <= most:
        return times, values
    size = -(-2 * len(times) // most)
    count = -(-len(times) // size)
    blocks = np.pad(values, (0, count * size - len(values)), mode="edge").reshape(count, size)
    first = np.arange(count) * size
    at = np.unique(
        np.minimum(np.concatenate([first + blocks.argmin(axis=1), first + blocks.argmax(axis=1)]),
                   len(times) - 1))
    return times[at], values[at]


def stretches(depth: Any, values: Any, most: int = 240) -> tuple[Any, Any, Any]:
    """Values along an increasing depth in at most `most` equal intervals: middle, smallest and
    largest value of each interval that is not empty. If values change from element to element, a
    line through all of them is unreadable."""
    depth, values = np.asarray(depth, float), np.asarray(values, float)
    edges = np.linspace(depth[0], depth[-1], most + 1)
    first = np.unique(np.searchsorted(depth, edges[:-1]))
    count = np.diff(np.append(first, len(depth)))
    least, largest = np.minimum.reduceat(values, first), np.maximum.reduceat(values, first)
    return np.add.reduceat(depth, first) / count, least, largest


def spectrum(values: Any, interval: float) -> tuple[Any, Any]:
    """One-sided power spectral density by Welch's method (1967): Hann windows of a quarter of the
    samples (at least 64), half overlapping, each without its mean. Frequencies [Hz], density
    [unit^2/Hz]; its integral is the variance."""
    values = np.asarray(values, float)
    length = min(len(values), max(64, len(values) // 4))
    if length < 8:
        return np.array([]), np.array([])
    window = np.hanning(length)
    starts = range(0, len(values) - length + 1, max(1, length // 2))
    power = np.zeros(length // 2 + 1)
    for start in starts:
        part = values[start:start + length]
        power += np.abs(np.fft.rfft((part - part.mean()) * window))**2
    power *= 2 * interval / (len(starts) * np.sum(window**2))
    power[0] /= 2
    if length % 2 == 0:
        power[-1] /= 2
    return np.fft.rfftfreq(length, interval), power
