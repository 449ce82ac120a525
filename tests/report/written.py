# SPDX-License-Identifier: BSD-3-Clause
"""Reports written by the checks, and their contents."""
import base64
import json
import pathlib
import re
import resource
import shutil
import sys

import numpy as np

from checks import TIME_FACTOR, expect, tooljoint

ROOT = pathlib.Path(__file__).resolve().parents[2]
STRING, FRAME, STUDY, MAP = (str(ROOT / path)
                             for path in ("tests/effects/scene.xml", "xml/frame.xml",
                                          "tests/study/study.xml", "xml/map_helical_170m.xml"))
EFFECTS = ROOT / "tests" / "effects"
STRESS = str(ROOT / "xml/stress_170m.xml")
LARGEST, SECONDS = 5_000_000, 10.0
NAMESPACES = ("http://www.w3.org/",)
RUN = {
    "section", "map", "axial", "torque", "side", "radial", "stress", "curvature", "bit-speed",
    "torques", "hook-loads", "contact", "duty", "largest", "rms", "twist", "orbit-1",
    "lateral-spectrum", "bit-spectrum"
}
WITHOUT_MOTION = {"section", "map", "axial", "torque", "side", "radial", "stress", "curvature"}


def run(folder, deck, *arguments):
    shutil.rmtree(folder, ignore_errors=True)
    done = tooljoint("run", deck, "--output", folder, *arguments)
    if done.returncode != 0:
        sys.exit(f"the run {folder} failed:\n{done.stderr}")
    return done


def report(folder, *arguments):
    """Runs the command; (output, CPU seconds of the command and its script), which do not depend on
    parallel tests."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = tooljoint("report", folder, *arguments)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def figures(text):
    return set(re.findall(r'<figure id="([^"]+)"', text))


def page(title, folder, wanted, seconds=SECONDS):
    """Writes the report of a folder and reads it."""
    done, took = report(folder)
    path = pathlib.Path(folder, "report.html")
    expect(f"{title}: a report takes less than {SECONDS:.0f} s", done.returncode == 0
           and path.is_file() and took < seconds * TIME_FACTOR,
           f"({done.returncode}, {took:.1f} s) {done.stderr}")
    if not path.is_file():
        return path, ""
    size = path.stat().st_size
    expect(
        f"{title}: the command says how large it is",
        re.search(rf": {f'{size / 1e3:.0f} kB' if size < 1e6 else f'{size / 1e6:.1f} MB'}$",
                  done.stdout, re.M), done.stdout)
    text = path.read_text(encoding="utf-8")
    print(f"       {title}: {took:.1f} s of CPU, {path.stat().st_size / 1e6:.2f} MB, "
          f"{len(figures(text))} figures")
    expect(f"{title}: every figure is there", wanted <= figures(text),
           sorted(wanted - figures(text)))
    expect(
        f"{title}: every figure is a picture with axes",
        text.count("<figure ") == len(figures(text)) == len(
            re.findall(r"<figure [^>]*>.{0,300}?<svg", text, re.S)))
    expect(f"{title}: below {LARGEST / 1e6:.0f} MB",
           path.stat().st_size < LARGEST,
           path.stat().st_size)
    outside = {
        link for link in re.findall(r"https?://[^\s\"'<>)]+", text)
        if not link.startswith(NAMESPACES)
    }
    expect(f"{title}: no address outside", not outside, sorted(outside)[:5])
    expect(f"{title}: no number is missing", not re.search(r">\s*(nan|inf|None)\b", text),
           re.findall(r".{40}>\s*(?:nan|inf|None)\b", text)[:3])
    return path, text


def numbers(entry):
    values = np.frombuffer(base64.b64decode(entry["data"]),
                           "<" + entry["kind"]).astype(float).reshape(entry["shape"])
    return values * entry.get("scale", 1.0)


def scene_of(text):
    return json.loads(re.search(r"<script>const SCENE = (.*?);</script>", text, re.S).group(1))


def near(what, found, expected, tolerance):
    error = np.abs(found - expected).max() if found.shape == expected.shape else np.inf
    expect(what, error <= tolerance, f"({error:.2e} > {tolerance:.2e})")
