#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Quantities computed in a report against closed forms: check_quantities.py

Stresses, curvatures, precession, spectra, envelopes, units, the deck with its overrides, best and
worst points of maps, and the numbers of the 3-D view.
"""
import base64
import pathlib
import re
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tests" / "support")]
from checks import expect, finish  # noqa: E402
import plot_map  # noqa: E402
import plots  # noqa: E402
from report import (checks, deck, figures, of_map, of_run, quantities, results, scene3d,
                    tables)  # noqa: E402
from stand_ins import Bar, near  # noqa: E402
from rotation import rounding, sides, torques, torques_at_rest, whirls  # noqa: E402


def stresses():
    rest = np.zeros((11, 6))
    bar = Bar(torque=0.0)
    near("tension alone: sigma = T/S", results.von_mises(bar, rest),
         bar.data["/static/axial_force"] / bar.S)
    bar = Bar(tension=0.0)
    near("torsion alone: sigma = sqrt(3) M R/J", results.von_mises(bar, rest),
         np.sqrt(3) * 2e3 * bar.outer / bar.J)
    # theta_x = -kappa s turns the tangent into y: a bend of curvature kappa
    bar, bent = Bar(tension=0.0, torque=0.0), rest.copy()
    bent[:, 3] = -1e-3 * bar.s
    near("the curvature of a bend", results.curvature(bar, bent), 1e-3)
    near("bending alone: sigma = E kappa R", results.von_mises(bar, bent), bar.E * 1e-3 * bar.outer)
    bent[:, 4], bent[:, 3] = 1e-3 * bar.s, 0
    near("bending in the other plane", results.von_mises(bar, bent), bar.E * 1e-3 * bar.outer)
    stretched = rest.copy()
    stretched[:, 2] = 2e-4 * bar.s
    near("stretching: sigma = E w'", results.von_mises(bar, stretched), bar.E * 2e-4)
    twisted = rest.copy()
    twisted[:, 5] = 1e-3 * bar.s
    near("twisting: sigma = sqrt(3) G theta' R", results.von_mises(bar, twisted),
         np.sqrt(3) * bar.G * 1e-3 * bar.outer)
    near("many samples at once", results.von_mises(bar, np.stack([stretched, rest])),
         np.stack([np.full(10, bar.E * 2e-4), np.zeros(10)]))


def motions():
    time = np.arange(4000) * 5e-3
    for rate in (12.0, -3.0):
        u, v = 1.0 + 0.3 * np.cos(rate * time), 0.3 * np.sin(rate * time)
        # its centre is that of 38 and 9.5 turns
        near(f"an orbit that turns with {rate} rad/s",
             results.precession(u, v, -rate * v, rate * (u - 1.0)), rate, 1e-3)
        found = results.precession(u, v, results.differences(u, time), results.differences(v, time))
        near("central differences find less of it", found, rate * np.sinc(rate * time[1] / np.pi),
             1e-3)
    to_and_fro = results.precession(np.cos(7 * time), 0 * time, -7 * np.sin(7 * time), 0 * time)
    expect("a motion to and fro does not turn", abs(to_and_fro) < 1e-12, to_and_fro)
    for frequency, amplitude in ((6.0, 2.0), (31.5, 0.1)):
        f, power = plots.spectrum(5.0 + amplitude * np.sin(2 * np.pi * frequency * time), time[1])
        near(f"the spectrum of {frequency} Hz peaks there", f[power.argmax()], frequency, 0.02)
        near("its integral is the variance", np.trapz(power, f), amplitude**2 / 2, 1e-2)
    noise = np.random.default_rng(3).normal(0, 1.5, 200_000)
    f, power = plots.spectrum(noise, 0.01)
    # 200,000 numbers: 0.5 %
    near("white noise has the density 2 dt sigma^2", power[1:-1].mean(), 2 * 0.01 * 1.5**2, 0.02)
    spikes = np.zeros(100_000)
    spikes[[777, 50_123]] = 9.0, -7.0
    shown = plots.envelope(np.arange(100_000.0), spikes)[1]
    expect("thinned curves keep their extremes",
           len(shown) <= 1200 and shown.max() == 9 and shown.min() == -7, f"({len(shown)})")


def touching():
    """Tool joints touch the wall along the whole string except for an interval without contact: the
    picture is white there and only there."""
    s = np.arange(241) * 4.7244  # two elements per joint of pipe
    middles, joints = 0.5 * (s[1:] + s[:-1]), np.arange(241) % 2 == 1
    radius = np.where(joints, 0.0841, 0.0635)
    lifted = (s > 500) & (s < 560)
    picture = figures.contact_picture(s, middles, radius,
                                      np.where(joints & ~lifted, 1e3, 0.0)[None, :])
    white = (np.flatnonzero(picture[:, 0] == 0) + 0.5) * s[-1] / len(picture)
    expect("tool joints that touch leave no white rows between them",
           len(white) > 2 and white.min() > 495 and white.max() < 565, white)
    picture = figures.contact_picture(s, middles, np.full(241, 0.0841),
                                      np.where(np.arange(241) % 4 == 0, 1e3, 0.0)[None, :])
    expect("without tool joints each node counts",
           len(picture) == figures.PICTURE_ROWS and (picture == 0).any())
    few = slice(0, 12)
    picture = figures.contact_picture(s[few], middles[:11], radius[few],
                                      np.where(joints[few], 1e3, 0.0)[None, :])
    expect("a short string shows its pipe bodies",
           len(picture) == figures.PICTURE_ROWS and 0.3 < (picture == 0).mean() < 0.7,
           (picture == 0).mean())


def recorded():
    """The table of docs/report.md is within the limits of reports: at most 10 s and 5 MB for 20 s
    of motion."""
    rows = re.findall(
        r"^\| (?:`tooljoint new`|(xml/\S+)) \| (\d+) \| (\d+) \| \d+ MB \| (\S+) s \| (\S+) s \| "
        r"(\S+) MB \|$", (ROOT / "docs/report.md").read_text(encoding="utf-8"), re.M)
    expect("docs/report.md has times and sizes of reports of decks that are there",
           len(rows) >= 5 and all((ROOT / row[0]).exists() for row in rows), rows)
    expect(
        "none is longer or larger than it may be",
        all(0 < float(cpu) <= float(wall) <= 10 and 0 < float(size) < 5
            for *_, cpu, wall, size in rows), rows)


def many_nodes():
    """Five kilometres of nodes are drawn as a few hundred lines, with the largest values."""
    s, values = np.linspace(0, 5000, 5001), np.zeros(5001)
    values[[777, 4321]] = 9.0, 7.0
    made, axes = plots.figure()
    figures.bars(axes, s, values, "black")
    lines = axes.collections[0].get_segments()
    expect(
        "bars keep the largest values of many nodes",
        len(lines) <= figures.MOST_BARS and sorted(line[1][0] for line in lines)[-2:] == [7.0, 9.0],
        len(lines))
    plots.plt.close(made)


def pictures():
    plots.use_style()
    made, axes = plots.figure()
    axes.plot([0, 1], [0.00125, 0.00375])
    axes.set_yticks([0.00125, 0.00375]), axes.set_ylabel("a [m]"), axes.set_title("1.23456")
    text = plots.inline_svg(made, "one")
    expect("numbers of a plot keep their digits",
           all(f">{word}<" in text for word in ("0.00125", "0.00375", "1.23456", "a [m]")))
    expect("coordinates are shortened", not re.search(r'd="[^"]*\d\.\d{3}', text))
    expect(
        "ids of a plot are its own",
        set(re.findall(r'id="(.*?)-', text)) == {"one"}
        and len(re.findall(r'url\(#(?!one-)', text)) == 0)
    expect("a plot takes the width that there is",
           re.match(r"<svg(?![^>]* (width|height)=)[^>]*viewBox", text) is not None, text[:200])


def units():
    expect("forces in klbf",
           quantities.both(444822.16152605, "hook load") == ("444.8 kN", "100.0 klbf"),
           quantities.both(444822.16152605, "hook load"))
    expect("side forces in lbf",
           quantities.both(4448.2216152605, "side force") == ("4.45 kN", "1000 lbf"),
           quantities.both(4448.2216152605, "side force"))
    expect("torques in kft lbf",
           quantities.both(1355.8179483314, "torque") == ("1.36 kN m", "1.00 kft lbf"),
           quantities.both(1355.8179483314, "torque"))
    expect("lengths in feet", quantities.both(304.8, "length") == ("304.8 m", "1000 ft"))
    expect("shares in percent", [quantities.percent(x) for x in (-0.0123, 1e-9, 0.0, 0.996, 1.87)
                                 ] == ["-1.2 %", "< 0.0001 %", "0 %", "100 %", "187 %"],
           quantities.percent(1e-9))
    expect(
        "no value is a dash",
        quantities.both(None, "length")[0] == quantities.both(float("nan"), "length")[0] ==
        quantities.plain(None) == quantities.percent(None) == "-")


def scenes():
    text = """<ParameterList name="a"><Parameter name="x" type="double" value="1"/>
    <ParameterList name="Loads">
      <Parameter name="Weight On Bit" type="double" value="40000"/></ParameterList>
      <ParameterList name="Mud"><Parameter name="Density" type="string" value="1.2 g/cm3"/>
      </ParameterList></ParameterList>"""
    whole = deck.read(text, "Loads/Torque On Bit=3 kN m\nx=2\n")
    expect("overrides are in the deck", whole["x"] == "2"
           and whole["Loads"]["Torque On Bit"] == "3 kN m", whole)
    expect("a title names the conditions",
           deck.conditions(whole) == "WOB 40 kN, TOB 3 kN m, mud 1.2 g/cm3", deck.conditions(whole))
    for law, parameter, words in (
        ("Exponential", "Final Speed", "up to 60 rpm"),
        ("Ramp", "Final Speed", "ramp to 60 rpm"),
        ("Harmonic", "Mean Speed", "60 rpm on average"),
        ("Constant", "Speed", "60 rpm"),
    ):
        turns = {
            "Rotary Speed": {"Law": law, law: {parameter: str(2 * np.pi)}},
            "Loads": {"Weight On Bit": "25 klbf"},
        }
        expect(f"a title names the speed of the law {law}",
               deck.conditions(turns) == f"{words}, WOB 25 klbf", deck.conditions(turns))
        expect("and leaves it out where it varies",
               deck.conditions(turns, {f"Rotary Speed/{law}/{parameter}"}) == "WOB 25 klbf")
    expect("lists that are taken out are gone", "Mud" not in deck.read(text, "!Mud\n"))
    expect("parameters stand before lists",
           [row[1] for row in deck.rows(whole)
            ] == ["x", "Loads", "Weight On Bit", "Torque On Bit", "Mud", "Density"])
    expect("no deck is an empty one", deck.read("<no", "") == {})
    expect(
        "texts are escaped", "<b>" not in tables.of_deck([(0, "<b>", "<b>")])
        and "<b>" not in tables.table(("<b>",), [("<b>",)]))


def judged():
    summary = {
        "static": {"residual": 1e-9, "torque_balance_defect": -3.0, "torque_scale": 1000.0},
        "transient": {
            "energy_residual": None, "step_error": 0.1, "unconverged_steps": 0, "steps": 0
        },
    }
    measured = {name: value for name, value, _ in checks.measured(summary)}
    expect(
        "checks of stages that did not run are left out", measured == {
            "balance of torque": 0.003, "residual of the static state": 1e-9, "step error": 0.1
        }, measured)
    expect("the worst check is the one closest to its bound",
           checks.worst(summary)[0] == "step error" and checks.worst({}) is None)

    class Parts:
        is_string, value, time = False, results.Run.value, None

        def __init__(self, residual):
            self.summary = {"transient": {"energy_residual": residual}}

    for residual, bad in ((0.02, 2), (-0.02, 2), (0.005, 0)):
        expect(f"the card of the energy has the bound of its check: {residual}",
               of_run.headline(Parts(residual)).count("card bad") == bad)


def mapped():
    """Best and worst points of a grid of 2 x 3 with a missing point."""
    grid = np.array([[4.0, 1.0, np.nan], [2.0, 9.0, 6.0]])

    class Grid:
        rows = [None] * grid.size

        def __init__(self, above=None, below=None):
            self.values = [{"name": "x", "unsafe_above": above, "unsafe_below": below}]
            self.grid = {"x": grid}

    for limits, wanted, safe in (
        ((5.0, None), [("best", 1), ("worst", 4)], 3),
        ((None, 3.0), [("best", 4), ("worst", 1)], 3),
        ((7.0, 1.5), [("least", 1), ("largest", 4)], 3),
        ((None, None), [("least", 1), ("largest", 4)], None),
    ):
        made = Grid(*limits)
        found = of_map.safe(made)
        expect(f"best and worst points of the limits {limits}",
               of_map.extremes(made.values[0], grid) == wanted,
               of_map.extremes(made.values[0], grid))
        expect(f"safe points of the limits {limits}",
               (found if safe is None else int(found.sum())) == safe, found)
    expect("a value no point has is without extremes",
           of_map.extremes(Grid().values[0], np.full((2, 2), np.nan)) == [])
    made, axes = plots.figure()
    plot_map.hatch(axes, np.array([0.0, 1, 2, 3]), np.array([0.0, 10]),
                   np.array([[1, 0], [1, 0], [0, 0], [1, 1]], bool))
    box = axes.patches[0].get_path().get_extents()
    expect(
        "the hatched region ends with the unsafe cells",
        np.allclose(box.get_points(), [[-0.5, -5], [3.5, 15]])
        and len(axes.patches[0].get_path().to_polygons()) == 3)
    plots.plt.close(made)


def view():
    axes = scene3d.to_view(np.eye(3))  # of north, east, down
    expect("the view is right-handed: east, up, south",
           np.array_equal(axes, [[0, 0, -1], [1, 0, 0], [0, -1, 0]]) and np.linalg.det(axes) == 1)
    values = np.array([[1.5, -0.25], [0.0, -3.0]])
    entry = scene3d.packed(values, "i2")
    back = np.frombuffer(base64.b64decode(entry["data"]), "<i2").reshape(
        entry["shape"]) * entry["scale"]
    near("numbers of 16 bits are right to half a step", back, values, 0.51 / scene3d.LARGEST)
    expect("zeros stay zeros", scene3d.packed(np.zeros(3), "i2")["scale"] == 1.0)
    near("a node has the larger value of its elements", scene3d.at_nodes(np.array([1.0, 3.0, 2.0])),
         [1, 3, 3, 2])
    bar = np.column_stack([np.arange(5.0), np.zeros((5, 2))])
    found = scene3d.held_edges(bar, np.array([0, 0, 0, 1, 1]), [(1, 2)])
    expect("a held node is joined to the nearest node of its part", found == [(0, 1)], found)


def released():
    """Below a released joint, results have the motion of the part above: the first element there is
    shown with the values of the next one."""
    bar, bent = Bar(), np.zeros((11, 6))
    bent[:, 2], bent[:, 3], bent[:, 5] = 1e-5 * bar.s, -1e-3 * bar.s, 1e-4 * bar.s
    smooth = results.von_mises(bar, bent)
    bent[5:, 2:] += 0.05  # the part below node 6 moves apart from the recorded motion of the node
    expect("a joint that opens is seen as a stress",
           results.von_mises(bar, bent)[5 - 1] > 2 * smooth[5 - 1])
    bar.data["/model/elements_below_releases"] = np.array([5])
    near("but not where it is released", results.von_mises(bar, bent), smooth)
    motion = np.stack([bent, 2 * bent])
    near("nor in a motion", results.curvature(bar, motion)[1], 2e-3)


def main():
    for part in (stresses, released, motions, sides, rounding, whirls, torques, torques_at_rest,
                 touching, recorded, many_nodes, pictures, units, scenes, judged, mapped, view):
        part()
    return finish()


if __name__ == "__main__":
    sys.exit(main())
