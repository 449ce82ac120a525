#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the results of `tooljoint campbell` or `tooljoint response`: tools/plot_response.py DIR
[--output FILE.png]

Campbell diagram: frequencies and damping ratios against the rotary speed, forward whirl blue,
backward whirl orange, lines of the excitations, critical speeds marked; for a string also
campbell_shapes.png, its modes against depth. Response: amplitude and phase of every output, largest
amplitudes marked; for a string also response_profile.png, bending moment and distance to the wall
against depth. Needs h5py, numpy and matplotlib; reads only campbell.h5 or response.h5.
"""
import sys

try:
    from plots import rotating
    from report.folder import draw_folder
except ImportError as missing:
    sys.exit(f"{missing}: plot_response.py needs h5py, numpy and matplotlib (Debian: python3-h5py "
             "python3-matplotlib, then /usr/bin/python3).")

if __name__ == "__main__":
    draw_folder(
        __doc__, "folder of tooljoint campbell or tooljoint response", {
            "campbell.h5": {
                "": ("Campbell diagram", rotating.campbell_figure),
                "shapes": ("Modes in the hole", rotating.shapes_figure),
            },
            "response.h5": {
                "": ("Response to a harmonic force", rotating.response_figure),
                "profile": ("Along the string", rotating.profile_figure),
            },
        })
