# SPDX-License-Identifier: BSD-3-Clause
"""The style of all plots: in the tools, the reports, the documents, and in scripts that import
`tooljoint.plots`.

Every axis has a label with its unit, depth points downwards, maps have north up and east to the
right, axes of lengths in space have one scale, texts do not overlap, and a figure states its
conditions. The module needs numpy and matplotlib. The program ships with a copy for its own tools,
so that reports need no compiled module.

>>> made, axes = figure()
>>> axes.set_xlabel(label("time", "s"))  # doctest: +ELLIPSIS
Text(..., 'time [s]')
>>> axes.set_ylabel(label("bit speed", "rpm"))  # doctest: +ELLIPSIS
Text(..., 'bit speed [rpm]')
>>> plt.close(made)
"""
import logging as _logging
import os as _os

# If its folder is not writable, matplotlib uses a temporary one and warns during import.
_log = _logging.getLogger("matplotlib")
_level = _log.level
_log.setLevel(_logging.ERROR)

import matplotlib as _matplotlib

if not _os.environ.get("DISPLAY") and not _os.environ.get("MPLBACKEND"):
    _matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib import ticker

_log.setLevel(_level)

from .animation import animate
from .labels import Labels, name_lines, overlaps
from .signals import envelope, spectrum, stretches, thinned
from .space import equal_axes, space_axes
from .style import (COLOURS, GREY, MAP, MARKERS, RPM, SLENDER, STYLE, WIDE, depth_axis, error_band,
                    figure, headline, in_time, label, legend_above, log_log, logarithmic, panels,
                    percent, plain, profile, profiles, shades, square, tick, use_style, whole_ticks)
from .svg import inline_svg, save

__all__ = [
    "COLOURS", "GREY", "Labels", "MAP", "MARKERS", "RPM", "SLENDER", "STYLE", "WIDE", "animate",
    "depth_axis", "envelope", "equal_axes", "error_band", "figure", "headline", "in_time",
    "inline_svg", "label", "legend_above", "log_log", "logarithmic", "name_lines", "np", "overlaps",
    "panels", "percent", "plain", "plt", "profile", "profiles", "save", "shades", "space_axes",
    "spectrum", "square", "stretches", "thinned", "tick", "ticker", "use_style", "whole_ticks"
]
