# SPDX-License-Identifier: BSD-3-Clause
"""Runs that are stopped by a signal, and their settings."""
import fcntl
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import time

from checks import of_ranks, unwrapped

PROGRAM, MPIEXEC = sys.argv[1:3]
ROOT = pathlib.Path(os.environ["TOOLJOINT_SOURCE_DIR"])
STRING, FRAME = str(ROOT / "tests" / "effects" / "scene.xml"), str(ROOT / "xml" / "frame.xml")
FULL = ["--without", "Reduction", "--without", "Substructures"]


def command(*arguments, ranks=1):
    return ([MPIEXEC, "-np", str(ranks)] if ranks > 1 else []) + [PROGRAM, *arguments]


def run(*arguments, ranks=1, largest=None):
    limit = (lambda: resource.setrlimit(resource.RLIMIT_FSIZE,
                                        (largest, largest))) if largest else None
    done = subprocess.run(command(*arguments, ranks=ranks), stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, check=False, timeout=120,
                          preexec_fn=limit, env=of_ranks(ranks))
    done.stderr = unwrapped(done.stderr)
    return done


def fresh(*folders):
    for folder in folders:
        shutil.rmtree(folder, ignore_errors=True)


def stamp(folder):
    file = pathlib.Path(folder, "checkpoint.bin")
    return file.stat().st_mtime_ns if file.exists() else 0


def children(parent):
    """Processes that a process has started."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        try:
            if entry.name.isdigit() and int((entry / "stat").read_text(encoding="utf-8").rsplit(
                    ")", 1)[1].split()[1]) == parent:
                found.append(int(entry.name))
        except (FileNotFoundError, ProcessLookupError):  # the process has ended
            continue
    return found


def stop(signum, folder, *arguments, ranks=1):
    """Starts a run and sends it a signal as soon as it has written a checkpoint; returns its exit
    code. With several ranks each of them gets the signal: mpiexec forwards it late or never, and a
    short run would end first."""
    before = stamp(folder)
    process = subprocess.Popen(command(*arguments, ranks=ranks), stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL, env=of_ranks(ranks))
    while process.poll() is None and stamp(folder) == before:
        time.sleep(0.002)
    for target in children(process.pid) if ranks > 1 else [process.pid]:
        if process.poll() is None:
            os.kill(target, signum)
    code = process.wait(timeout=60)
    lock = os.open(folder, os.O_RDONLY)  # ranks may run a little longer than their mpiexec
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            break
        except BlockingIOError:
            time.sleep(0.05)
    os.close(lock)
    return code


def left(folder):
    return sorted(path.name for path in pathlib.Path(folder).iterdir()
                  if path.name.startswith("checkpoint") or path.name.endswith(".part"))


def settings(integrator, end, interval):
    name = "Generalized-alpha" if integrator == "Step Tolerance" else integrator
    out = [
        "--set", f"Transient/Integrator={name}", "--set", f"Transient/End Time={end}", "--set",
        f"Transient/Checkpoint Interval={interval}", "--set", "Transient/Progress=false"
    ]
    if integrator == "Step Tolerance":
        out += [
            "--set", "Transient/Generalized-alpha/Step Tolerance=1e-6", "--set",
            "Transient/Step=0.005"
        ]
    if integrator == "RK4":
        out += ["--set", "Transient/Step=1e-5"]
    if integrator == "Generalized-alpha":
        out += ["--set", "Transient/Step=0.001", "--set", "Transient/Step Error Limit=1000"]
    return out
