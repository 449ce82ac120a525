#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A string from survey to map: the well of the template gets a survey made here. The string is
computed at rest and in motion, and two results are mapped over rotary speed and weight on bit.
"""
import pathlib

# %% Definitions
import common  # in the folder of this script
import numpy as np
import tooljoint as tj
from tooljoint import plots

TEMPLATE = pathlib.Path(__file__).resolve().parents[2] / "xml/templates/well.xml"


def stations(depth, turn):
    """Measured depth [ft], inclination and azimuth [deg]: vertical to 1500 ft, then built to 30
    degrees while the azimuth turns."""
    at = np.array([0, 1500, 2000, 2500, depth])
    return np.column_stack(
        [at,
         np.interp(at, [1500, 2500], [0, 30]),
         np.interp(at, [1500, depth], [40, 40 + turn])]).round(3)


def well(turn):
    deck = tj.Deck(TEMPLATE)
    del deck["Well/Survey/File"]
    deck["Well/Survey/Depth Unit"] = "ft"
    deck["Well/Survey/Stations"] = stations(3600, turn).ravel()
    deck["Transient/Step"] = "2 ms"
    return deck


# %% At rest in two wells
options = common.options(__doc__)
figure, (wall, moves, cells) = common.figure(3)
for turn in (0, 60):
    deck = well(turn)
    del deck["Transient"]
    results = deck.run(options.output / f"well_{turn}")
    depth, force = results["model/s"], results["static/normal_force"]
    touches = force > 0  # tool joints touch, the pipes between them do not
    wall.plot(force[touches] / 1e3, depth[touches], ".", label=f"azimuth turns by {turn} deg")
    print(f"turn of {turn} deg: {force.sum() / 1e3:.1f} kN on the wall")
wall.set(title="At rest")
plots.profiles((wall, moves), ("normal force [kN]", "largest lateral displacement [mm]"),
               (depth[0], depth[-1]))
wall.legend()

# %% A motion
deck = well(60)
deck["Transient/End Time"] = 0.2 if options.short else 2.0
deck.add("Loads/Unbalance", {"bent joint": {"Node": 60, "Moment": 1.0}})
results = deck.run(options.output / "motion")
displacement = results["transient/displacement"]
lateral = np.hypot(*np.moveaxis(displacement[:, :, :2] - displacement[:1, :, :2], 2, 0))
moves.plot(1e3 * lateral.max(axis=0), results["model/s"])
moves.set(title=f"A bent joint, motion of {results['transient/time'][-1]:g} s")

# %% A map
speeds, weights = (["80 rpm", "120 rpm"],
                   ["5 klbf", "15 klbf"
                    ]) if options.short else ([f"{speed} rpm" for speed in range(60, 181, 30)],
                                              [f"{weight} klbf" for weight in (5, 10, 15, 20)])
del deck["Transient"]
del deck["Rotary Speed"]  # constant speed: the static state has the friction of this speed
deck.add("Rotary Speed", {"Law": "Constant", "Constant": {"Speed": "80 rpm"}})
deck.add(
    "Map", {
        "Grid": {
            "speed": {"Parameter": "Rotary Speed/Constant/Speed", "Values": speeds},
            "weight": {"Parameter": "Loads/Weight On Bit", "Values": weights},
        },
        "Values": {
            "torque": {"Key": "static.top_torque"},
            "contacts": {"Key": "static.contact_nodes"},
        },
    })
rows = deck.map(options.output / "map")
torque = np.array([row["torque"] for row in rows]).reshape(len(speeds), len(weights))
cells.grid(False)
image = cells.pcolormesh(abs(torque.T) / 1e3, cmap=plots.MAP)
cells.set(title="Torque at the top", xlabel="rotary speed", ylabel="weight on bit",
          xticks=np.arange(len(speeds)) + 0.5, yticks=np.arange(len(weights)) + 0.5,
          xticklabels=speeds, yticklabels=weights)
figure.colorbar(image, label="torque [kN m]")
common.save(figure, options, "string_from_survey_to_map")
