# SPDX-License-Identifier: BSD-3-Clause
"""tooljoint.plots, and the figures of tools/plot_results.py and tools/plot_study.py: labels with
units, depth downwards, one scale in space, titles with conditions, no overlapping texts."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest
from unittest import mock

import h5py
import numpy as np
from PIL import Image
from tooljoint import plots
from tooljoint.plots import rotating

SOURCE = pathlib.Path(os.environ["TOOLJOINT_SOURCE_DIR"])
sys.path.insert(0, str(SOURCE / "tools"))
import plot_results  # noqa: E402
import plot_study  # noqa: E402
import redraw_studies  # noqa: E402
import scale_blocks  # noqa: E402
import scale_figures  # noqa: E402
import strategies_figure  # noqa: E402

DECK = """<ParameterList name="well"><ParameterList name="Loads">
  <Parameter name="Weight On Bit" type="double" value="40000"/></ParameterList></ParameterList>"""
# Machado, Oliveira and Fernandes (2009), severity 1, on linear RGB.
DEUTERANOPE = np.array([[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413],
                        [-0.011820, 0.042940, 0.968881]])
PROTANOPE = np.array([
    [0.152286, 1.052583, -0.204868],
    [0.114503, 0.786281, 0.099216],
    [-0.003882, -0.048116, 1.051998],
])
XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
WHITE = XYZ.sum(axis=1)
JUST_NOTICEABLE = 2.3  # in CIE Lab (Mahy et al. 1994)


def string(file, nodes=21, moves=True):
    """Results of a string in a well that builds to the north, in an open HDF5 file."""
    s = np.linspace(0, 1000, nodes)
    middle = 0.5 * (s[1:] + s[:-1])
    angle = 1e-3 * s
    file.attrs["deck_text"], file.attrs["deck_file"], file.attrs["overrides"] = DECK, "well.xml", ""
    file["/model/s"], file["/model/clearance"] = s, np.full(nodes, 0.03)
    file["/model/position"] = 1000 * np.column_stack(
        [1 - np.cos(angle), np.zeros(nodes), np.sin(angle)])
    file["/static/displacement"] = np.full((nodes, 6), 0.01)
    file["/static/normal_force"] = 1e3 * (1 + np.cos(0.02 * s))
    file["/static/axial_force"], file["/static/torque"] = 1e3 * (200 - 0.2 * middle), np.full(
        nodes - 1, -4e3)
    if moves:
        time = np.linspace(0, 1, 12)
        file["/transient/time"], file["/transient/speed"] = time, np.full(12, 4 * np.pi)
        bit = 4 * np.pi + np.sin(20 * time)
        file["/transient/motion"] = np.column_stack(
            [time, np.full(12, 4 * np.pi), bit, 0 * time, 0 * time])
        file["/transient/displacement"] = 0.01 * np.tile(
            np.cos(20 * time)[:, None, None], (1, nodes, 6))
    return file


def memory():
    return h5py.File("plots.h5", "w", driver="core", backing_store=False)


class Style(unittest.TestCase):
    def setUp(self):
        plots.use_style()
        self.addCleanup(plots.plt.close, "all")

    def check(self, made):
        """Checks of every figure."""
        self.assertEqual(plots.overlaps(made), [])
        for axes in made.axes:
            for axis in (axes.xaxis, axes.yaxis):
                text = axis.get_label_text()
                if axes.axison and "depth" in text or "time" in text:
                    self.assertRegex(text, r"\[.+\]$")


class Start(unittest.TestCase):
    def test_a_home_that_cannot_be_written_is_no_matter(self):
        given = {
            name: value for name, value in os.environ.items()
            if not name.startswith(("MPLCONFIG", "XDG_"))
        }
        done = subprocess.run([sys.executable, "-c", "import plot_map, plot_study, plot_results"],
                              cwd=SOURCE / "tools", env={**given, "HOME": "/proc/nowhere"},
                              capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))


class Axes(Style):
    def test_labels_have_units(self):
        self.assertEqual(
            [plots.label(*pair) for pair in (("torque", "kN m"), ("modes",), ("share", "1"))],
            ["torque [kN m]", "modes", "share"])

    def test_depth_points_downwards(self):
        made, axes = plots.profile(plots.label("torque", "kN m"), (0, 1500))
        self.assertEqual(axes.get_ylim(), (1500, 0))
        self.assertEqual(axes.get_ylabel(), "measured depth [m]")
        self.check(made)

    def test_space_has_one_scale(self):
        for points in ([[0, 0, 0], [100, 30, 800]], [[5, 5, 0], [5, 5, 1000]]):
            made = plots.plt.figure()
            axes = plots.space_axes(made, 111)
            plots.equal_axes(axes, points)
            made.canvas.draw()
            for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
                low, high = sorted(axis.get_view_interval())
                self.assertGreaterEqual(sum(low <= tick <= high for tick in axis.get_ticklocs()), 2,
                                        "an axis has one number")
            self.check(made)
            spans = np.abs([
                np.subtract(*axes.get_xlim()),
                np.subtract(*axes.get_ylim()),
                np.subtract(*axes.get_zlim())
            ])
            np.testing.assert_allclose(axes._box_aspect / spans, (axes._box_aspect / spans)[0])
            self.assertGreater(axes.get_zlim()[0],
                               axes.get_zlim()[1], "depth does not point downwards")
            self.assertEqual(
                [axes.get_xlabel(), axes.get_ylabel(),
                 axes.get_zlabel()], ["north [m]", "east [m]", "depth [m]"])

    def logarithmic(self, low, x=plots.plain, y=plots.percent):
        """Tick labels of axes whose y reaches from `low` to 1."""
        made, axes = plots.figure()
        axes.plot([0.01, 100], [low, 1])
        plots.error_band(axes, [0.01, 100], [0.5 * low, 0.5], [2 * low, 1.0])
        plots.log_log(axes, x, y)
        made.canvas.draw()
        self.assertEqual(len(axes.collections), 1)
        self.check(made)
        return [text.get_text() for text in axes.get_xticklabels()
                ], [text.get_text() for text in axes.get_yticklabels()]

    def test_logarithmic_ticks_are_plain_numbers(self):
        across, up = self.logarithmic(1e-4)
        self.assertIn("0.1", across)
        self.assertIn("10 %", up)

    def test_an_axis_has_one_way_of_writing(self):
        for y in (plots.percent, plots.plain):
            up = self.logarithmic(1e-7, y=y)[1]
            self.assertTrue(all(text.startswith("10") and "%" not in text for text in up), up)
        self.assertIn("10⁻¹", up)
        self.assertTrue(all("%" in text for text in self.logarithmic(1e-4)[1]))

    def test_a_title_says_the_conditions(self):
        made, axes = plots.figure()
        axes.plot([0, 1]), axes.set_xlabel("time [s]")
        plots.headline(made, "A string", "120 rpm, WOB 40 kN; " * 20)
        self.check(made)
        texts = [text.get_text() for text in made.texts]
        self.assertEqual(texts[0].split("\n")[0], "A string")
        self.assertIn("WOB 40 kN", texts[1])

    def test_colours_differ_for_all_eyes(self):
        def lab(name, seen):
            rgb = np.array(plots.plt.matplotlib.colors.to_rgb(name))
            linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055)**2.4)
            x, y, z = np.cbrt(np.maximum(XYZ @ np.clip(seen @ linear, 0, 1) / WHITE, 0.008856))
            return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])

        for seen in (np.eye(3), DEUTERANOPE, PROTANOPE):
            found = [lab(name, seen) for name in plots.COLOURS[:6]]
            distances = [np.linalg.norm(a - b) for i, a in enumerate(found) for b in found[:i]]
            self.assertGreater(min(distances), 3 * JUST_NOTICEABLE)


class Names(Style):
    def lines(self, count, apart):
        made, axes = plots.plt.subplots(figsize=(7, 5), constrained_layout=True)
        lines = {
            f"a method with a long name, number {i}":
            axes.plot([0, 1, 2], [i * apart, i * apart + 0.1, i * apart])[0] for i in range(count)
        }
        axes.set_ylim(-1, max(4, 1.2 * count * apart)), axes.set_xlim(0, 2.5)
        labels = plots.Labels(axes)
        for line in lines.values():
            labels.occupy(*line.get_data())
        return made, axes, plots.name_lines(labels, lines)

    def test_names_stand_beside_lines_with_room(self):
        made, axes, beside = self.lines(3, 2)
        self.assertTrue(beside)
        self.assertEqual(len(axes.texts), 3)
        self.check(made)

    def test_names_of_crowded_lines_stand_in_a_legend(self):
        made, axes, beside = self.lines(14, 0.02)
        self.assertFalse(beside)
        self.assertEqual(len(axes.get_legend().get_texts()), 14)
        self.check(made)

    def test_overlaps_are_found(self):
        made, axes = plots.figure()
        axes.text(0.5, 0.5, "one"), axes.text(0.51, 0.5, "two"), axes.text(3.0, 0.5, "out")
        self.assertEqual(len(plots.overlaps(made)), 2)


class Results(Style):
    def test_the_picture_of_a_string(self):
        with memory() as file:
            made = plot_results.draw(string(file))
        self.check(made)
        space, radial, contact, axial, torque, speed = [
            axes for axes in made.axes if axes.get_label() != "<colorbar>"
        ]
        self.assertEqual(space.get_zlabel(), "depth [m]")
        for axes, text in ((radial, "lateral displacement [mm]"), (contact, "contact force [kN]"),
                           (axial, "axial force [kN]"), (torque, "torque [kN m]")):
            self.assertEqual(axes.get_xlabel(), text)
            self.assertGreater(*axes.get_ylim())
        self.assertLess(np.ptp(torque.get_xlim()), 5,
                        "the torque is drawn on the scale of the axial force")
        self.assertEqual((speed.get_xlabel(), speed.get_ylabel()), ("time [s]", "speed [rpm]"))
        self.assertIn("WOB 40 kN", made.texts[1].get_text())

    def test_a_static_state_alone(self):
        with memory() as file:
            self.check(plot_results.draw(string(file, moves=False)))

    def test_an_even_speed_is_no_picture_of_rounding(self):
        with memory() as file:
            whole = string(file)
            del whole["/transient/motion"]
            whole["/transient/motion"] = np.column_stack([
                np.linspace(0, 1, 12),
                np.full((12, 2), 4 * np.pi) + 1e-12 * np.sin(np.arange(24)).reshape(12, 2),
                np.zeros((12, 2))
            ])
            made = plot_results.draw(whole)
        self.check(made)
        self.assertGreater(np.ptp(made.axes[-1].get_ylim()), 1)

    def test_lateral_directions_have_names(self):
        with memory() as file:
            whole = string(file)
            self.assertEqual(plot_results.lateral_names(whole),
                             ("displacement u", "displacement v"))
            whole["/model/frame"] = np.tile(np.eye(3), (21, 1, 1))
            self.assertEqual(plot_results.lateral_names(whole),
                             ("u, north at the surface", "v, east at the surface"))

    def test_what_an_animation_lacks(self):
        with memory() as file:
            with self.assertRaisesRegex(
                    SystemExit, "ended with its static state. Run a deck with a list Transient"):
                plot_results.animate(string(file, moves=False), pathlib.Path("motion.gif"))
        with memory() as file:
            whole = string(file)
            whole["/transient/velocity"] = whole["/transient/displacement"][:]
            del whole["/transient/displacement"]
            with self.assertRaisesRegex(
                    SystemExit, r'it holds velocity\). Run the deck again with --set '
                    r'"Output/Fields={displacement, velocity}"'):
                plot_results.animate(whole, pathlib.Path("motion.gif"))
            del whole["/transient/velocity"]
            with self.assertRaisesRegex(
                    SystemExit,
                    r'it holds none\). Run the deck again with --set "Output/Fields={displacement}"'
            ):
                plot_results.animate(whole, pathlib.Path("motion.gif"))

    def test_animations(self):
        with memory() as file:
            plot_results.animate(string(file), pathlib.Path("motion.gif"))
        with Image.open("motion.gif") as shown:
            self.assertEqual(shown.n_frames, 12)
        if shutil.which("ffmpeg"):
            with memory() as file:
                plot_results.animate(string(file), pathlib.Path("motion.mp4"))
            probe = [
                "ffprobe", "-v", "error", "-count_frames", "-show_entries",
                "stream=codec_type,nb_read_frames", "-of", "csv=p=0", "motion.mp4"
            ]
            self.assertEqual(
                subprocess.run(probe, capture_output=True, text=True, check=True).stdout.strip(),
                "video,12")
        made, axes = plots.figure()
        for name, said in (("motion.avi", r"\.gif or \.mp4"), ("motion", r"\.gif or \.mp4")):
            with self.assertRaisesRegex(ValueError, said):
                plots.animate(name, made, lambda number: None, 2)
        with self.assertRaisesRegex(ValueError, "at least 1"):
            plots.animate("motion.gif", made, lambda number: None, 0)
        with mock.patch.object(plots.plt.matplotlib.animation.FFMpegWriter, "isAvailable",
                               return_value=False), self.assertRaisesRegex(ValueError, "ffmpeg"):
            plots.animate("motion.mp4", made, lambda number: None, 2)


class Campbell(Style):
    def draw(self, whirl, damping):
        """A diagram of two modes over four speeds; the lines of excitations leave it close to one
        another."""
        with memory() as file:
            speed = np.tile(np.linspace(0, 200, 4) / plots.RPM, 2)
            rows = {
                "mode": np.repeat([1.0, 2.0],
                                  4), "speed": speed, "frequency": np.repeat([0.1, 0.48], 4),
                "damping": np.repeat(damping, 4), "whirl": np.repeat(whirl, 4)
            }
            for name, values in rows.items():
                file[f"campbell/{name}"] = values
            file["excitations"] = ["1x", "2x", "3x", "blades"]
            file["orders"], file["offsets"] = [1.0, 2.0, 3.0, 5.0], np.zeros(4)
            made = rotating.campbell_figure(file)
        self.check(made)
        return made.axes[0], [text.get_text() for text in made.axes[0].get_legend().get_texts()]

    def test_the_legend_has_what_is_drawn(self):
        self.assertEqual(self.draw([0.0, 0.0], [0.02, 0.03])[1], ["in a line, axial, torsional"])
        self.assertEqual(
            self.draw([1.0, -1.0], [0.02, -0.03])[1], ["forward whirl", "backward whirl", "grows"])

    def test_modes_that_grow_are_marked(self):
        for damping, marked in (([0.02, -0.03], 4), ([0.02, 1e-12], 0)):
            crosses = [
                line for line in self.draw([1.0, 1.0], damping)[0].lines
                if line.get_marker() == "x" and len(line.get_xdata())
            ]
            self.assertEqual(sum(len(line.get_xdata()) for line in crosses), marked)


class Response(Style):
    def test_an_amplitude_of_zero_leaves_the_axis_to_the_others(self):
        with memory() as file:
            for name, values in {
                    "speed": [0.0, 10.0, 20.0], "frequency": [0.0, 1.6, 3.2],
                    "x_amplitude": [0.0, 1e-3, 2e-3], "x_phase": [0.0, 0.1, 0.2]
            }.items():
                file[f"response/{name}"] = values
            file["response/x_amplitude"].attrs["units"] = "m"
            made = rotating.response_figure(file)
        self.check(made)
        low, high = made.axes[0].get_ylim()
        self.assertTrue(1e-4 < low < 1e-3 and 2e-3 < high < 1e-2, (low, high))


DECK = ('<ParameterList name="well"><ParameterList name="Loads"><Parameter name="Weight On Bit" '
        'type="string" value="40 kN"/></ParameterList></ParameterList>')


class Studies(Style):
    def study(self, count):
        """A study of `count` methods with nearly the same speed and error."""
        folder = pathlib.Path(f"study_{count}")
        folder.mkdir(exist_ok=True)
        head = ("line,label,kind,model,sweep,status,vibration_error,cpu_per_simulated_s "
                "[s],cpu_spread,reduced_dofs,modes,frequency_error,setup_cpu [s]")
        rows = [
            f'"method {i}, with a long name","method {i}, with a long name, Step {step} '
            f'ms",method,full,,done,{step ** 2 * (1e-3 + 1e-5 * i)},{0.1 / step},0.5,100,,,'
            for i in range(count) for step in (1, 2)
        ]
        (folder / "study.csv").write_text("\n".join([head, *rows, ""]), encoding="utf-8")
        with h5py.File(folder / "study.h5", "w") as file:
            file.attrs.update({
                "machine": "a machine", "deck_name": "well", "self_error": 1e-5,
                "window_begin": 0.0, "window_end": 2.0, "deck_text": DECK
            })
            whole = string(file, moves=False)
            file["profile/s"], file["profile/radius"], file["profile/clearance"] = whole[
                "/model/s"][:], np.full(21, 0.01), np.full(21, 0.03)
            for name in ("normal_force", "axial_force", "torque"):
                file[f"profile/{name}"] = whole[f"/static/{name}"][:]
        return plot_study.Study(folder)

    def test_speed_against_error_of_few_and_of_crowded_lines(self):
        for count, legend in ((2, False), (30, True)):
            made = plot_study.draw_speed(self.study(count))
            self.check(made)
            self.assertEqual(made.axes[0].get_legend() is not None, legend)
            self.assertTrue(
                re.search(r"WOB 40 kN; a machine.*bands: to the longest of the repeats",
                          made.texts[1].get_text(), re.S))
            bands = [
                band.get_paths()[0].vertices[:, 0] for band in made.axes[0].collections
                if band.get_paths()
            ]
            self.assertEqual(
                sum(abs(x.max() - 0.15) < 1e-9 and abs(x.min() - 0.05) < 1e-9 for x in bands),
                count, "a line has no band to 1.5 times its time")

    def test_figures_of_record_are_drawn_from_tables(self):
        made = redraw_studies.speed("stress")
        self.check(made)
        self.assertIn("WOB 10 kN", made.texts[1].get_text())
        self.assertEqual(made.axes[0].get_ylabel(), "vibration error, 0 to 3 s")
        made = redraw_studies.variants("frame")
        self.assertEqual(
            [axes.get_ylabel() for axes in made.axes],
            2 * ["vibration error of the motion"] + 2 * ["largest error of 20 frequencies"])
        shown = dict(
            zip([line.get_label() for line in made.axes[1].lines],
                [line.get_xydata()[0].tolist() for line in made.axes[1].lines]))
        self.assertEqual(shown["Guyan"], [30, 0.037])

    def test_the_figure_of_strategies_has_the_runs_of_its_page(self):
        page = ("Machine: a machine.\n\n| left out | verdict |\n|---|---|\n| One |  |\n\n"
                "| case | step [us] | One | Two |\n|---|---|---|---|\n| a | 88 | 1.51 | - |\n"
                "| b | 90 | 0.50, differs by 5 % | refused |\n")
        made = strategies_figure.draw(page)
        self.check(made)
        shown = {line.get_label(): line.get_xydata().tolist() for line in made.axes[0].lines}
        self.assertEqual(
            [shown[f"{what} (1)"] for what in ("same motion", "motion differs", "refused")],
            [[[1.51, 0]], [[0.5, 0]], [[1.51 * 1.25, 1]]])
        self.assertIn("2 cases of docs/strategies.md; a machine", made.texts[1].get_text())

    def test_the_page_of_scale_says_from_which_size_parts_are_faster(self):
        page = (SOURCE / "docs/scale.md").read_text(encoding="utf-8")
        cut = scale_figures.table_with(scale_figures.tables(page), "largest estimate")
        lines = [(int(row["dofs"]), int(row["ranks"]), row["wall [s]"], "", "", "",
                  row["whole: wall [s]"]) for row in cut]
        self.assertIn(scale_blocks.faster_from(lines), " ".join(page.split()))
        lines = [(10, 1, "1", "", "", "", "2"), (20, 1, "3", "", "", "", "2"),
                 (30, 1, "1", "", "", "", "2"), (10, 2, "3", "", "", "", "2"),
                 (40, 2, "1", "", "", "", "")]
        self.assertEqual(
            scale_blocks.faster_from(lines),
            "The parts take less time than the whole on 1 rank from 30 "
            "dofs on, on 2 ranks at no size up to 10 dofs.")

    def test_profiles_of_the_static_state(self):
        made = plot_study.draw_static(self.study(2))
        self.check(made)
        self.assertIn("WOB 40 kN", made.texts[1].get_text(),
                      "a figure says under which conditions it holds")
        self.assertEqual([axes.get_xlabel() for axes in made.axes], [
            "lateral displacement [mm]", "contact force [kN]", "axial force [kN]", "torque [kN m]"
        ])
        self.assertGreater(*made.axes[0].get_ylim())


if __name__ == "__main__":
    unittest.main()
