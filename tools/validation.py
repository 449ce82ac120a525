#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs all variants of the reference scene and rewrites the tables of docs/validation.md.

    tools/validation.py --program build/release/tooljoint [--end 20] [--work results/validation]
        [--only static,motion,source]

Every table is between two markers in docs/validation.md and names the commands that produced it.
Runs that are already in the work folder are not repeated.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import re
import subprocess
import sys

os.environ.setdefault("TOOLJOINT_REPORT", "off")  # reports of these runs are not needed

PROJECT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(PROJECT / "tests/torque_drag"))
import closed_forms  # noqa: E402
from validation_buckling import buckling_table, vertical_table  # noqa: E402
from validation_motion import (FULL, motion_table, node_table, reference, source_table,
                               speed_windows)  # noqa: E402


def settings(**values):
    arguments = []
    for key, value in values.items():
        arguments += ["--set", f"{key}={value}"]
    return arguments


class Bench:
    def __init__(self, options):
        self.program = options.program
        self.work = pathlib.Path(options.work)
        self.end = options.end
        self.commands = []

    def run(self, name, deck, arguments):
        """Results folder of `tooljoint run` and its summary; the run is made if it is missing."""
        folder = self.work / name
        quoted = [f'"{a}"' if " " in a else a for a in arguments]
        self.commands.append(" ".join(
            ["tooljoint run", f"xml/{deck}.xml", "--output", name, *quoted]))
        if not (folder / "summary.json").exists() or json.loads(
            (folder / "summary.json").read_text())["status"] != "finished":
            print(self.commands[-1], flush=True)
            command = [
                self.program, "run",
                str(PROJECT / f"xml/{deck}.xml"), "--output",
                str(folder), *arguments, "--set", "Output/XDMF=false"
            ]
            done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  text=True, check=False)
            if done.returncode != 0:
                print(done.stdout[-2000:])
                return None
        return json.loads((folder / "summary.json").read_text())

    def torque_drag(self, name, arguments, table="torque_drag.csv"):
        """Rows, as numbers, of one operation in a table of `tooljoint torque-drag` of
        xml/build_hold_1400m.xml."""
        folder = self.work / f"torque_drag_{name}"
        quoted = " ".join(f'--set "{a}"' if " " in a else f"--set {a}" for a in arguments)
        command = (f"tooljoint torque-drag xml/build_hold_1400m.xml --output torque_drag_{name} "
                   f"{quoted}")
        if command not in self.commands:
            self.commands.append(command)
        if not (folder / table).exists():
            print(command, flush=True)
            subprocess.run([
                self.program, "torque-drag",
                str(PROJECT / "xml/build_hold_1400m.xml"), "--output",
                str(folder), *(part for a in arguments for part in ("--set", a))
            ], stdout=subprocess.DEVNULL, check=True)
        with open(folder / table, newline="", encoding="utf-8") as file:
            return [{
                key.split(" [")[0]: value if key == "operation" else float(value) if value else None
                for key, value in row.items()
            } for row in csv.DictReader(file)]

    def compare(self, name, reference, end):
        """eps_t max, eps_t mean, eps_n max and vibration error over 0..end."""
        done = subprocess.run([
            self.program, "compare",
            str(self.work / name),
            str(self.work / reference), "--to",
            str(end), "--json"
        ], stdout=subprocess.PIPE, text=True, check=True)
        errors = json.loads(done.stdout)
        return [
            errors["eps_t"]["max"], errors["eps_t"]["mean"], errors["eps_n"]["max"],
            errors["vibration_error"]
        ]

    def by(self, table):
        """The command that computes a table of many runs, as a code block."""
        self.commands = []
        return f"```\ntools/validation.py --program build/release/tooljoint --only {table}\n```\n"

    def taken(self):
        """The commands since the last call, as a code block."""
        text = "```\n" + "\n".join(self.commands) + "\n```\n"
        self.commands = []
        return text


def kilo(value):
    return f"{value / 1e3:.3f}"


def static_table(bench):
    """Both pre-stress modes and both path modes."""
    rows = [
        "| path | pre-stress | nodes in contact | compressed elements | top force [kN] | last "
        "element force [kN] | last element torque [kN m] | largest contact force [kN] (node) | top "
        "torque [kN m] | torque balance defect [N m] |", "|---|---|---|---|---|---|---|---|---|---|"
    ]
    for path in ("Centre line", "Imposed nodes"):
        for stress in ("Axial and torque", "Full tangent"):
            name = f"static_{path.split()[0]}_{stress.split()[0]}".lower()
            arguments = [
                *FULL, "--without", "Transient", "--set", f"Path/Mode={path}", "--set",
                f"Path/Pre-stress={stress}"
            ]
            summary = bench.run(name, "helical_170m", arguments)
            if summary is None:
                rows.append(f"| {path} | {stress} | did not converge |||||||||")
                continue
            s = summary["static"]
            rows.append(f"| {path} | {stress} | {s['contact_nodes']} | {s['compressed_elements']} "
                        f"| {kilo(s['top_axial_force'])} | {kilo(s['last_element_axial_force'])} | "
                        f"{kilo(s['last_element_torque'])} | {kilo(s['max_normal_force'])} "
                        f"({s['max_normal_force_node']}) | {kilo(s['top_torque'])} | "
                        f"{s['torque_balance_defect']:.4g} |")
    return bench.taken() + "\n" + "\n".join(rows) + "\n"


class SoftString:
    """Soft string of Johancsik, Friesen and Dawson (1984) for xml/build_hold_1400m.xml in a
    build-and-hold well."""
    WOB, STAND, JOINT_RADIUS = 50e3, 9.5, 0.084
    WEIGHT = 9.81 * 7850.0 * math.pi * (9.0 * (0.0635**2 - 0.0543**2) + 0.5 *
                                        (0.084**2 - 0.0413**2)) / STAND  # [N/m]

    def __init__(self, kick_off, build_rate, inclination, stands, friction):
        self.curvature = math.radians(build_rate) / 30.0
        self.kick_off, self.inclination = kick_off, math.radians(inclination)
        self.length, self.friction = stands * self.STAND, friction

    def torque(self, bit_torque, climbs, step=0.05):
        """Top torque [N m]. `climbs`: a rotating string climbs the wall until N sqrt(1 + mu^2)
        carries the load q; else N = q."""
        tension, torque, s = -self.WOB, bit_torque, self.length
        per_load = self.friction * self.JOINT_RADIUS / (math.sqrt(1.0 + self.friction**2)
                                                        if climbs else 1.0)
        while s > 1e-9:
            along = s - 0.5 * step - self.kick_off
            angle = min(max(along * self.curvature, 0.0), self.inclination)
            bend = self.curvature if 0.0 < along < self.inclination / self.curvature else 0.0
            torque += per_load * abs(tension * bend - self.WEIGHT * math.sin(angle)) * step
            tension += self.WEIGHT * math.cos(angle) * step
            s -= step
        return torque


def torque_table(bench):
    """Top torque of three wells on four meshes, compared with the torque required by bit and
    friction and with the soft string."""
    rows = [
        "| well | elements per body | top torque by displacements [kN m] | by bit and friction [kN "
        "m] | apart [%] | soft string that climbs [kN m] | soft string [kN m] |",
        "|---|---|---|---|---|---|---|"
    ]
    wells = [
        ("3 deg/30 m from 400 m to 60 deg, 1425 m of pipe", 400, 3, 60, 150, 4.0),
        ("4 deg/30 m from 600 m to 80 deg, 2470 m", 600, 4, 80, 260, 0.0),
        ("10 deg/30 m from 100 m to 88 deg, 570 m", 100, 10, 88, 60, 0.0),
    ]
    for number, (title, kick_off, rate, inclination, stands, bit) in enumerate(wells):
        # mu of eq. (9) of Nguyen et al. 2020 at v = Omega R_c, mu_s = 0.3, mu_d = 0.25, v_r = 0.1
        # m/s
        v, xi = 4.0 * math.pi * SoftString.JOINT_RADIUS, math.sqrt(1.0 - 0.25 / 0.3)
        q = 1.0 / (1.0 + (1.0 - xi) / (2.0 * 0.1 * 0.25) * v)
        soft = SoftString(kick_off, rate, inclination, stands,
                          v / 0.2 * ((1.0 - xi) * q + (1.0 + xi) * q * q))
        for elements in (1, 2, 5, 10):
            arguments = [
                "--without", "Transient", "--set",
                f"Drillstring/Components/body/Elements={elements}"
            ]
            if number > 0:
                arguments += settings(
                    **{
                        "Well/Arc/Kick-off Depth": kick_off,
                        "Well/Arc/Build Rate": f"{rate} deg/30m",
                        "Well/Arc/End Inclination": f"{inclination} deg",
                        "Well/Arc/Tangent Length": 1500,
                        "Drillstring/Assembly": f"{{{stands}*stand}}",
                        "Loads/Torque On Bit": f"{bit:g} kN m"
                    })
            s = bench.run(f"torque_{number + 1}_{elements}", "build_hold_1400m",
                          arguments)["static"]
            top, asked = -s["top_torque"], -s["top_torque_equilibrium"]
            rows.append(f"| {title if elements == 1 else ''} | {elements} | {kilo(top)} | "
                        f"{kilo(asked)} | {100.0 * (top - asked) / asked:.3f} | "
                        f"{kilo(soft.torque(1e3 * bit, True))} | "
                        f"{kilo(soft.torque(1e3 * bit, False))} |")
    return bench.taken() + "\n" + "\n".join(rows) + "\n"


def gauge_table(bench):
    """Contact forces at the gauges, from static_nodes.csv of the two centre-line runs."""
    rows = ["| node | axial and torque [kN] | full tangent [kN] |", "|---|---|---|"]
    tables = []
    for stress in ("axial", "full"):
        lines = (bench.work / f"static_centre_{stress}" /
                 "static_nodes.csv").read_text().splitlines()
        column = [h.split(" ")[0] for h in lines[0].split(",")].index("normal_force")
        tables.append(
            {int(float(line.split(",")[0])): float(line.split(",")[column]) for line in lines[1:]})
    for node in (86, 130):
        rows.append(
            f"| {node} (stabiliser gauge) | {kilo(tables[0][node])} | {kilo(tables[1][node])} |")
    return "\n".join(rows) + "\n"


def forms_table(bench):
    """Closed forms of the soft string (tests/torque_drag/closed_forms.py)."""
    rows = [
        "| what | closed form | found | apart, over the closed form | the test allows |",
        "|---|---|---|---|---|"
    ]
    for what, truth, found, unit, tolerance in closed_forms.soft(
            lambda name, settings:
        {row["operation"]: row for row in bench.torque_drag(name, settings)}):
        rows.append(f"| {what} | {truth:.8g} {unit} | {found:.8g} {unit} | "
                    f"{abs(found - truth) / abs(truth):.0e} | {tolerance:.0e} |")
    return bench.by("forms") + "\n" + "\n".join(rows) + "\n"


def limit_table(bench):
    """The stiff string compared with the soft one, with and without tool joints, in the well of
    xml/build_hold_1400m.xml."""
    both = "Torque and Drag/Operations={Trip out, Rotate off bottom}"
    pipes = [
        (f"pipe, clearance {clearance:g} mm" + (", E/100" if young < closed_forms.YOUNG else ""),
         f"pipe_{clearance:g}_{young / 1e9:g}", closed_forms.OUTER, [
             *closed_forms.PIPE, both, "Drillstring/Components/body/Elements=3",
             f"Well/Bore Radius={closed_forms.OUTER + 1e-3 * clearance:g}",
             f"Drillstring/Material/Young Modulus={young / 1e9:g} GPa"
         ]) for clearance, young in closed_forms.STEEL_AND_SOFT
    ]
    joints = ["Torque and Drag/Count=1", both, "Drillstring/Components/body/Elements=5"]
    free = [*joints, "Supports/Bit=none"]
    strings = [
        ("string of the deck", "joints", 0.084, joints),
        ("the same, bit free", "free", 0.084, free),
        ("the same, E/10", "free_10", 0.084, [*free, "Drillstring/Material/Young Modulus=21 GPa"]),
        ("the same, E/100", "free_100", 0.084,
         [*free, "Drillstring/Material/Young Modulus=2.1 GPa"]),
    ]
    rows = [
        "| string | torque off bottom, stiff/soft | by contact forces | by the radius of contact | "
        "drag of Trip out, stiff/soft |", "|---|---|---|---|---|"
    ]
    for title, name, radius, arguments in pipes + strings:
        out, off = ({row["operation"]: row for row in bench.torque_drag(name, arguments)}[one]
                    for one in ("Trip out", "Rotate off bottom"))
        profile = bench.torque_drag(name, arguments, "torque_drag_stiff_profile.csv")
        pressed = closed_forms.MU * radius * sum(
            row["contact_force"]
            for row in profile if row["operation"] == "Rotate off bottom") / off["surface_torque"]
        torque = off["stiff_surface_torque"] / off["surface_torque"]
        stiff = out["stiff_hook_load"] - off["stiff_hook_load"]
        drag = stiff / (out["hook_load"] - off["hook_load"])
        rows.append(f"| {title} | {torque:.4f} | {pressed:.4f} | "
                    f"{round(torque - pressed, 4) + 0.0:.4f} | {drag:.4f} |")
    rows.append(f"| limit: 1/sqrt(1 + mu^2), 1 | {closed_forms.LIMIT:.4f} | "
                f"{closed_forms.LIMIT:.4f} | 0 | 1 |")
    return bench.by("limit") + "\n" + "\n".join(rows) + "\n"


def crossings_table(bench):
    """Critical speeds of xml/helical_170m.xml, full and with modes up to two cut-off
    frequencies."""
    found = {}
    for name, arguments in (
        ("full", FULL),
        ("200", []),
        ("20", ["--set", "Reduction/Mode Selection/Cut-off Frequency=20 Hz"]),
    ):
        folder = bench.work / f"crossings_{name}"
        if not (folder / "crossings.csv").exists():
            subprocess.run([
                bench.program, "campbell",
                str(PROJECT / "xml/helical_170m.xml"), "--output",
                str(folder), *arguments, "--set", "Campbell/Highest Speed=120 rpm", "--set",
                "Campbell/Points=2", "--set", "Campbell/Modes=8", "--set", "Campbell/Spot Checks=0"
            ], stdout=subprocess.DEVNULL, check=True)
        with open(folder / "crossings.csv", newline="", encoding="utf-8") as file:
            found[name] = [{
                key.split(" [")[0]: float(value) if value else None for key, value in row.items()
            } for row in csv.DictReader(file)]
    rows = [
        "| order | full model [rpm] | modes up to 200 Hz: apart | estimate | up to 20 Hz: apart | "
        "estimate |", "|---|---|---|---|---|---|"
    ]
    for full, *reduced in zip(found["full"], found["200"], found["20"]):
        cells = [
            f"{abs(one['frequency'] / full['frequency'] - 1):.2e} | {one['estimate']:.2e}"
            for one in reduced
        ]
        rows.append(
            f"| {full['order']:g} | {full['speed'] * 30 / math.pi:.4f} | {' | '.join(cells)} |")
    return bench.by("crossings") + "\n" + "\n".join(rows) + "\n"


def modes_table(bench):
    """Undamped modes of beams and of a frame, bending modes in pairs, compared with closed forms
    and scipy's dense solver."""
    import numpy
    import scipy.linalg
    import structures

    length, radius, steel = 10.0, 0.05, structures.STEEL
    wave = radius / 2.0 * math.sqrt(steel["E"] / steel["rho"]) / (
        2.0 * math.pi * length**2)  # f = (beta L)^2 sqrt(E I/(rho A)) / (2 pi L^2)
    frame = structures.frame(5, 3)
    dense = numpy.sqrt(
        scipy.linalg.eigh(frame.K.toarray(), frame.M.toarray(), eigvals_only=True,
                          subset_by_index=[0, 11])) / (2.0 * math.pi)
    cases = [
        ("free_beam", "free beam, 40 elements", structures.beam(40),
         [wave * b**2 for b in (4.730041, 7.853205, 10.995608) for _ in range(2)], 6),
        ("pinned_beam", "pinned beam, 40 elements", structures.pinned_beam(40),
         [wave * (n * math.pi)**2 for n in (1, 2, 3) for _ in range(2)], 0),
        ("frame", "square frame of five storeys", frame, list(dense), 0),
    ]
    rows = [
        "| structure | dofs | rigid-body modes | frequencies [Hz] | closed form or scipy [Hz] | "
        "largest relative difference |", "|---|---|---|---|---|---|"
    ]
    for name, title, structure, exact, rigid in cases:
        folder = bench.work / f"modes_{name}"
        folder.mkdir(parents=True, exist_ok=True)
        structure.write(folder / "part.h5")
        deck = structures.deck(folder / "scene.xml", {"part": "part.h5"})
        subprocess.run([
            bench.program, "modes",
            str(deck), "--count",
            str(rigid + len(exact)), "--output",
            str(folder / "out")
        ], stdout=subprocess.DEVNULL, check=True)
        with open(folder / "out/modes.csv", newline="", encoding="utf-8") as table:
            found = [
                float(next(value for key, value in row.items() if key.split(" ")[0] == "full"))
                for row in csv.DictReader(table)
            ]
        elastic = found[rigid:]
        worst = max(abs(f - e) / e for f, e in zip(elastic, exact))
        listed = lambda values: ", ".join(f"{v:.4f}" for v in values[::2])
        rows.append(f"| {title} | {structure.M.shape[0]} | {sum(1 for f in found if f == 0.0)} | "
                    f"{listed(elastic)} | {listed(exact)} | {worst:.1e} |")
    return "\n" + "\n".join(rows) + "\n"


TABLES = {
    "static": static_table, "modes": modes_table, "torque": torque_table, "forms": forms_table,
    "limit": limit_table, "crossings": crossings_table, "buckling": buckling_table,
    "vertical": vertical_table, "gauges": gauge_table, "motion": motion_table,
    "speed": speed_windows, "nodes": node_table, "source": source_table
}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True, help="the tooljoint program")
    parser.add_argument("--work", default="results/validation", help="folder for the runs")
    parser.add_argument("--end", type=float, default=20.0, help="simulated time [s]")
    parser.add_argument("--only", default=",".join(TABLES), help="tables to write")
    options = parser.parse_args()
    bench = Bench(options)
    page = PROJECT / "docs/validation.md"
    text = page.read_text(encoding="utf-8")
    for name in options.only.split(","):
        table = TABLES[name](bench)
        print(table, flush=True)
        marked = re.compile(rf"(<!-- table {name} -->\n).*?(<!-- end -->)", re.S)
        if not marked.search(text):
            sys.exit(f"{page} has no place for the table \"{name}\".")
        text = marked.sub(lambda match: match.group(1) + table + match.group(2), text)
        page.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
