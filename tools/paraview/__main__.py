#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the results of a run for ParaView: python3 tools/paraview DIR [--output FOLDER] [--magnify
FACTOR] [--pictures COUNT]

DIR is the folder of a run. FOLDER (DIR/paraview) receives string.pvd with a .vtp file for each
picture and wall.vtp for a string in its well, or parts.pvd for parts. Points are moved by FACTOR
times the displacement, and the wall is drawn at FACTOR times the clearance, so that contact is
shown as contact; all fields keep their true values. Needs numpy, h5py and matplotlib. Exit codes: 0
done, 1 wrong usage, 5 nothing to show, or a file that cannot be read or written.
"""
import argparse
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[0] = str(HERE.parent)

from report.files import (USAGE, Unreadable, fail, failing, reading, write,
                          writing)  # noqa: E402: from the parent folder

MOST_PICTURES = 200

try:
    import numpy as np

    from paraview import scenes, vtp
    from report.results import Run
except ImportError as missing:
    fail(f"{missing}: files for ParaView need numpy and h5py (Debian: python3-h5py, then "
         "/usr/bin/python3).")


class Arguments(argparse.ArgumentParser):
    def error(self, message):
        fail(message, USAGE)


def pictures(scene, most):
    """Samples that are shown: all, or at most `most` at equal distances, including the first and
    the last."""
    return np.unique(
        np.linspace(0,
                    len(scene.times) - 1, min(len(scene.times), most)).round().astype(int))


def write_all(scene, folder, magnification, most):
    """Writes all files of a scene; the largest displacement [m] and the number of pictures."""
    with writing(folder):
        folder.mkdir(parents=True, exist_ok=True)
        for old in (*folder.glob(f"{scene.name}_*.vtp"), *folder.glob(f"{scene.name}.pvd")):
            old.unlink()
    largest, files = 0.0, []
    for number, sample in enumerate(pictures(scene, most)):
        moved = scene.displacement(sample)
        largest = max(largest, float(np.linalg.norm(moved, axis=1).max()))
        text = vtp.polydata(scene.position + magnification * moved, scene.kinds, scene.axes,
                            scene.point_fields(sample), scene.cell_fields(sample),
                            {"TimeValue": scene.times[sample], "magnification": magnification})
        files.append((scene.times[sample], f"{scene.name}_{number:04d}.vtp"))
        write(folder / files[-1][1], text)
    if scene.name == "string":
        points, quads = scene.wall(magnification)
        write(
            folder / "wall.vtp",
            vtp.polydata(points, {"Polys": quads}, scene.axes,
                         field_data={"magnification": magnification}))
    write(folder / f"{scene.name}.pvd", vtp.collection(files))
    return largest, len(files)


def main():
    parser = Arguments(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
                       prog="paraview")
    parser.add_argument("folder", type=pathlib.Path, help="folder of a run")
    parser.add_argument("--output", type=pathlib.Path, help="output folder (default: DIR/paraview)")
    parser.add_argument("--magnify", type=float, default=1.0,
                        help="factor of the displacements (default 1)")
    parser.add_argument("--pictures", type=int, default=MOST_PICTURES,
                        help=f"pictures of the motion, at most (default {MOST_PICTURES})")
    options = parser.parse_args()
    if not (math.isfinite(options.magnify) and options.magnify > 0):
        fail(
            f"--magnify is {options.magnify}, expected a number above 0; 1 shows displacements as "
            "they are.", USAGE)
    if options.pictures < 1:
        fail(f"--pictures is {options.pictures}, expected at least 1.", USAGE)
    folder = options.output or options.folder / "paraview"
    with failing(), reading(options.folder / "results.h5"):
        if not (options.folder / "results.h5").is_file():
            raise Unreadable(
                f"{options.folder} holds no results.h5. Name the results folder of a run.")
        scene = scenes.of_run(Run(options.folder))
        largest, count = write_all(scene, folder, options.magnify, options.pictures)
    print(f"paraview    {folder / scene.name}.pvd: {count} picture{'s' if count > 1 else ''}" +
          (f", and {folder / 'wall.vtp'}" if scene.name == "string" else ""))
    better = scenes.suggestion(scene, largest)
    print(f"            largest displacement {largest:.3g} m, shown times {options.magnify:g}" +
          (f"; --magnify {better:g} shows it clearly" if better >= 2 * options.magnify else ""))
    return 0


if __name__ == "__main__":
    sys.exit(main())
