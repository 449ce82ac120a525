# SPDX-License-Identifier: BSD-3-Clause
"""Runs the program on decks with overrides, and writes decks and part files for it."""
import json
import os
import pathlib
import resource
import shutil
import subprocess
import xml.etree.ElementTree as ElementTree

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[3]
TIME_FACTOR = float(os.environ.get("TOOLJOINT_TIME_FACTOR",
                                   "1"))  # programs with sanitizers take longer
FULL = ("Reduction", "Substructures")  # without these lists the full model runs
NAMED = ("Loads/Forces/", "Loads/Unbalance/", "Coupling/Springs/", "Drillstring/Components/"
         )  # lists with names chosen by the user
QUIET = {"Output/XDMF": "false", "Output/CSV": "false"}
COUNTERS = (("steps", "steps"), ("newton_iterations", "iterations"),
            ("factorisations", "factorisations"), ("halved", "halved"), ("rejected", "rejected"),
            ("right_hand_sides", "right-hand sides"))
# first words of warnings unrelated to the accuracy of a motion or of its start
OTHER_WARNINGS = ("The annulus", "No node of the string", "The output folder",
                  "The mass matrix is singular", "The checkpoint", "There are",
                  "The static state is unstable", "The bit has not settled", "The bit made",
                  "Path/Pre-stress")


class NoResult(Exception):
    """A run needed for a comparison has no results."""


class Run:
    """Results of a command: exit code, final message, summary.json and results.h5."""
    def __init__(self, folder, code, output, cpu):
        self.folder, self.code, self.output, self.cpu = folder, code, output, cpu
        path = folder / "summary.json"
        self.summary = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
        self.motion = self.summary.get("transient") or {}

    @property
    def done(self):
        return self.code == 0

    def sentence(self):
        """The message of a refusal."""
        text = self.summary.get("message") or ""
        if not text:
            lines = [line for line in self.output.splitlines() if line.strip()]
            begin = max((i for i, line in enumerate(lines) if not line.startswith("  ")), default=0)
            text = " ".join(lines[begin:]) or "no word"  # with its wrapped lines
        return " ".join(text.split())

    def warnings(self):
        """Warnings on the accuracy of the result."""
        return [
            " ".join(w.split()) for w in self.summary.get("warnings") or []
            if not w.startswith(OTHER_WARNINGS) and "has no stiffness" not in w
        ]

    def work(self):
        """CPU time of the motion [s], or of the command without a motion."""
        return self.motion.get("cpu_s") or self.cpu

    def counters(self):
        """Uses of each strategy of the step."""
        used = {label: self.motion[key] for key, label in COUNTERS if self.motion.get(key)}
        return {**used, **(self.motion.get("strategies") or {})}

    def data(self, name):
        if not self.done:
            raise NoResult(f"{self.folder.name} ended with {self.code}: {self.sentence()}")
        with h5py.File(self.folder / "results.h5", "r") as file:
            return file[name][()]

    def time(self):
        return self.data("transient/time")

    def nodes(self, component, what="displacement"):
        """Samples x nodes."""
        return self.data(f"transient/{what}")[:, :, component]


class Program:
    """The program under test; every run has its own folder in the work folder."""
    def __init__(self, executable, work, mpiexec="mpiexec"):
        self.executable, self.mpiexec = str(pathlib.Path(executable).resolve()), mpiexec
        self.work = pathlib.Path(work).resolve()
        self.work.mkdir(parents=True, exist_ok=True)

    def command(self, *arguments, ranks=1):
        parallel = [self.mpiexec, "-np", str(ranks)] if ranks > 1 else []
        return [*parallel, self.executable, *map(str, arguments)]

    def overrides(self, settings, without):
        return ([x for name in without for x in ("--without", name)] +
                [x for path, value in settings.items() for x in ("--set", f"{path}={text(value)}")])

    def run(self, name, deck, settings=None, without=(), command="run", ranks=1, seconds=900,
            extra=()):
        """Runs a command on a deck; `settings` are overrides; a run that exceeds `seconds` has the
        code -1."""
        folder = self.work / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        settings = dict(settings or {})
        named = {path: settings.pop(path) for path in list(settings) if path.startswith(NAMED)}
        if named:
            deck = self.with_lists(name, deck, named)
        quiet = QUIET if command == "run" else {}
        call = self.command(command, deck, "--output", folder, *extra,
                            *self.overrides({**quiet, **settings}, without), ranks=ranks)
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        try:
            done = subprocess.run(call, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                  check=False, timeout=seconds * TIME_FACTOR, cwd=self.work)
            code, output = done.returncode, done.stdout
        except subprocess.TimeoutExpired:
            code, output = -1, f"no end within {seconds} s"
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return Run(folder, code, output, after.ru_utime - before.ru_utime)

    def vibration_error(self, run, reference, end):
        """`tooljoint compare` over 0 to `end`; infinite if there is nothing to compare."""
        done = subprocess.run(
            self.command("compare", run.folder, reference.folder, "--to", end, "--json"),
            stdout=subprocess.PIPE, text=True, check=False)
        return json.loads(done.stdout)["vibration_error"] if done.returncode == 0 else float("inf")

    def deck(self, name, lists):
        """Writes a deck from nested dictionaries."""
        path = self.work / f"{name}.xml"
        path.write_text(parameter_list(name, lists), encoding="utf-8")
        return path

    def with_lists(self, name, deck, settings):
        """A copy of a deck with parameters in lists with names chosen by the user, which --set does
        not make; the deck must not name files."""
        tree = ElementTree.parse(deck)
        for path, value in settings.items():
            *lists, last = path.split("/")
            at = tree.getroot()
            for one in lists:
                found = at.find(f"ParameterList[@name='{one}']")
                at = ElementTree.SubElement(at, "ParameterList",
                                            name=one) if found is None else found
            for old in at.findall(f"Parameter[@name='{last}']"):
                at.remove(old)
            ElementTree.SubElement(at, "Parameter", name=last, type=kind(value), value=text(value))
        copy = self.work / f"{name}.xml"
        tree.write(copy)
        return copy

    def part(self, name, components, M, K, C=None, loads=None, sets=None, labels=None):
        """Writes a part file with dense matrices; nodes count from 1 unless `labels` are given."""
        width = len(components)
        content = {
            "format": "tooljoint part 1",
            "components": list(components),
            "dofs": labels or [[i // width + 1, components[i % width]] for i in range(len(M))],
            "mass": rows(M),
            "stiffness": rows(K),
            "interfaces": sets or {},
        }
        if C is not None:
            content["damping"] = rows(C)
        if loads is not None:
            content["loads"] = [float(x) for x in loads]
        path = self.work / f"{name}.json"
        path.write_text(json.dumps(content), encoding="utf-8")
        return path.name


def rows(matrix):
    return [[float(x) for x in row] for row in np.atleast_2d(matrix)]


def text(value):
    """A value in the form for --set."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, (list, tuple)):
        return "{" + ", ".join(text(x) for x in value) + "}"
    return str(value)


def kind(value):
    if isinstance(value, (list, tuple)):
        return f"Array({kind(value[0])})"
    return {bool: "bool", int: "int", float: "double", str: "string"}[type(value)]


def parameter_list(name, lists, indent=""):
    lines = [f'{indent}<ParameterList name="{name}">']
    for key, value in lists.items():
        if isinstance(value, dict):
            lines.append(parameter_list(key, value, indent + "  "))
        else:
            lines.append(
                f'{indent}  <Parameter name="{key}" type="{kind(value)}" value="{text(value)}"/>')
    return "\n".join(lines + [f"{indent}</ParameterList>"])
