# SPDX-License-Identifier: BSD-3-Clause
"""Animated figures."""
from __future__ import annotations

import os
import pathlib
from typing import Any, Callable

from matplotlib import animation

RATE = 25  # pictures per second
DPI = 100


def animate(path: str | os.PathLike, made: Any, draw: Callable[[int], None], count: int,
            rate: int = RATE) -> None:
    """Writes `count` pictures of a figure as a GIF (by Pillow) or an MP4 (by the program ffmpeg),
    depending on the extension of `path`; draw(i) sets the figure to picture i.

    ValueError for another extension, no pictures, or an MP4 without ffmpeg."""
    ending = pathlib.Path(path).suffix.lower()
    if count < 1:
        raise ValueError(
            f"{path}: there are no pictures to animate; found {count}, expected at least 1.")
    writers = {".gif": animation.PillowWriter, ".mp4": animation.FFMpegWriter}
    if ending not in writers:
        raise ValueError(f"{path} ends with \"{ending}\"; animations are written as .gif or .mp4. "
                         "Change the name.")
    if not writers[ending].isAvailable():
        package = "ffmpeg" if ending == ".mp4" else "python3-pil"
        raise ValueError(
            f"{path} needs {package} (Debian: {package}), which is not installed. Install it" +
            (", or write a .gif." if ending == ".mp4" else "."))
    writer = writers[ending](fps=rate)
    with writer.saving(made, str(path), DPI):
        for number in range(count):
            draw(number)
            writer.grab_frame()
