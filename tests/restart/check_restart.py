#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs that are stopped and continued: check_restart.py PROGRAM MPIEXEC PART [without-sundials]

PART is "analyses" (tables of stopped commands), "bits" (laws of the bit and of the top drive),
"integrators" (every integrator, full and reduced models, strings and imported parts: stopped by
SIGTERM, continued, killed, continued) or "folders" (full disks, other ranks, two runs in one
folder, damaged and foreign files). A stopped and continued run ends with samples, tables, pictures
and figures that are bitwise equal to those of an uninterrupted run.
"""
import functools
import hashlib
import pathlib
import shutil
import signal
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from checks import expect, finish, of_ranks  # noqa: E402
from same_numbers import differences  # noqa: E402
from stopped import (FRAME, FULL, ROOT, STRING, command, fresh, left, run, settings, stamp,
                     stop)  # noqa: E402
from analyses import analyses  # noqa: E402

PART = sys.argv[3]
INTEGRATORS = ["RK4", "RK4 adaptive", "Generalized-alpha", "Step Tolerance"]
if "without-sundials" not in sys.argv[4:]:
    INTEGRATORS += ["SUNDIALS ARKODE", "SUNDIALS CVODE"]


@functools.lru_cache(maxsize=None)
def whole_run(deck, options):
    """Folder of the uninterrupted run, made once for all comparisons."""
    folder = f"whole_{hashlib.sha1(repr((deck, options)).encode()).hexdigest()[:12]}"
    fresh(folder)
    done = run("run", deck, "--output", folder, *options)
    if done.returncode != 0:
        raise RuntimeError(f"the whole run of {deck}: {done.stderr[-400:]}")
    return folder


def interrupted_twice(title, deck, options, ranks=(1, 1, 1), tolerance=0.0, but=None):
    """Stopped by SIGTERM, continued and killed, continued: the numbers of an uninterrupted run.
    `but`: first parts of names of values that agree only within rounding."""
    whole = whole_run(deck, tuple(options))
    for _ in range(5):  # on a busy machine a run may end before its signal
        fresh("halted")
        codes = [
            stop(signal.SIGTERM, "halted", "run", deck, "--output", "halted", *options,
                 ranks=ranks[0])
        ]
        if stamp("halted") > 0:
            codes.append(
                stop(signal.SIGKILL, "halted", "run", deck, "--restart", "halted", *options,
                     ranks=ranks[1]))
        if stamp("halted") > 0:
            break
    done = run("run", deck, "--restart", "halted", *options, ranks=ranks[2])
    if done.returncode != 0:
        return expect(f"{title}: stopped {codes}, goes on", False, done.stderr[-400:])
    wrong = [
        one for one in differences(whole, "halted", tolerance)
        if but is None or not one.startswith(but)
    ]
    expect(f"{title}: stopped {codes}, the same numbers",
           len(codes) == 2 and 0 not in codes and not wrong, "; ".join(wrong[:6]))
    return expect(f"{title}: nothing of the checkpoint is left",
                  left("halted") == [], str(left("halted")))


def integrators():
    string = {
        "RK4": (0.1, 0.01), "RK4 adaptive": (0.02, 0.002), "Generalized-alpha": (8, 0.4),
        "Step Tolerance": (10, 0.5), "SUNDIALS ARKODE": (0.3, 0.02), "SUNDIALS CVODE": (0.3, 0.02)
    }
    frame = {
        "RK4": (0.1, 0.01), "RK4 adaptive": (0.1, 0.01), "Generalized-alpha": (10, 1),
        "Step Tolerance": (20, 1), "SUNDIALS ARKODE": (2, 0.1), "SUNDIALS CVODE": (2, 0.1)
    }
    for integrator in INTEGRATORS:
        for model, without in (("reduced", []), ("full", FULL)):
            interrupted_twice(f"{integrator}, {model} string", STRING,
                              [*settings(integrator, *string[integrator]), *without])
            interrupted_twice(f"{integrator}, {model} frame", FRAME,
                              [*settings(integrator, *frame[integrator]), *without[:2]])


def bits():
    """State beyond the model: delay lines of a bit, the integral of a drive at its limit, block and
    integral of an autodriller."""
    def overrides(*pairs):
        return [word for pair in pairs for word in ("--set", pair)]

    drive = overrides("Top Drive/Control=Speed", "Top Drive/Inertia=1000",
                      "Top Drive/Proportional Gain=2000", "Top Drive/Integral Gain=2000",
                      "Top Drive/Torque Limit=3 kN m")
    cutting = [
        "--without", "Loads/Torque On Bit", "--without", "Loads/Weight On Bit",
        *overrides("Bit/Law=Cutting", "Bit/Cutting/Blades=4", "Bit/Cutting/Radius=0.1",
                   "Bit/Cutting/Wear Flat=1 mm", "Top Drive/Block Speed=0.001",
                   "Contact/Friction/Axial=true")
    ]
    friction = [
        "--without", "Loads/Torque On Bit",
        *overrides("Bit/Law=Stribeck", "Bit/Stribeck/Radius=0.1")
    ]
    hoist = [
        *cutting, *overrides("Rotary Speed/Law=Constant", "Rotary Speed/Constant/Speed=60 rpm",
                             "Top Drive/Autodriller/Weight On Bit=20 kN",
                             "Top Drive/Autodriller/Proportional Gain=1e-7",
                             "Top Drive/Autodriller/Integral Gain=1e-7")
    ]
    for title, own in (
        ("cutting bit", cutting),
        ("friction at the bit", friction),
        ("autodriller", hoist),
    ):
        for integrator, end, interval in (("Generalized-alpha", 8, 0.4), ("RK4", 0.1, 0.01)):
            for model, without in (("reduced", []), ("full", FULL)):
                interrupted_twice(f"{title} and drive, {integrator}, {model}", STRING,
                                  [*settings(integrator, end, interval), *drive, *own, *without])


LONG = tuple(settings("Generalized-alpha", 8, 0.4))


def full_disk():
    for title, deck in (("string", STRING), ("frame", FRAME)):
        fresh("full")
        whole = whole_run(deck, LONG)
        half = int(0.6 * pathlib.Path(whole, "results.h5").stat().st_size)
        done = run("run", deck, "--output", "full", *LONG, largest=half)
        expect(f"{title}: a full disk ends with 5 and a sentence", done.returncode == 5
               and "File too large" in done.stderr, f"{done.returncode} {done.stderr[-300:]}")
        expect(f"{title}: and leaves a checkpoint", stamp("full") > 0)
        done = run("run", deck, "--restart", "full", *LONG, largest=half)
        expect(f"{title}: as full as before, the same end", done.returncode == 5,
               f"{done.returncode} {done.stderr[-300:]}")
        done = run("run", deck, "--restart", "full", *LONG)
        wrong = differences(whole, "full") if done.returncode == 0 else [done.stderr[-300:]]
        expect(f"{title}: with room again it goes on to the same numbers", not wrong,
               "; ".join(wrong[:6]))

    fresh("full")
    table = (*settings("Generalized-alpha", 40, 10), "--set", "Transient/Sampling Interval=0.001",
             "--set", "Output/Fields={}", "--set", "Output/XDMF=false", "--set",
             "Output/Compression=1")
    whole = whole_run(STRING, table)
    sizes = [pathlib.Path(whole, name).stat().st_size for name in ("results.h5", "motion.csv")]
    expect("a table larger than the results", sizes[1] > 1.2 * sizes[0], str(sizes))
    done = run("run", STRING, "--output", "full", *table, largest=int(0.95 * sizes[1]))
    expect("a table beyond the limit of the process ends with 5 and a sentence",
           done.returncode == 5 and "motion.csv cannot be written: File too large" in done.stderr,
           f"{done.returncode} {done.stderr[-300:]}")
    done = run("run", STRING, "--restart", "full", *table)
    wrong = differences(whole, "full") if done.returncode == 0 else [done.stderr[-300:]]
    expect("and goes on without it to the same numbers", not wrong, "; ".join(wrong[:6]))


def other_ranks():
    for title, deck in (("string", STRING), ("frame", FRAME)):
        interrupted_twice(f"{title} on 1, 2 and 1 ranks", deck, LONG, ranks=(1, 2, 1))
    interrupted_twice("string on 2, 1 and 2 ranks", STRING, LONG, ranks=(2, 1, 2))
    interrupted_twice("frame divided among 2, 3 and 2 ranks", FRAME,
                      [*LONG, "--set", "Transient/Ranks=Divide"], ranks=(2, 3, 2), tolerance=1e-6)
    # its static state on two ranks differs from that on one in the last digits
    options = [
        "--set", "Transient/End Time=12", "--set", "Transient/Checkpoint Interval=0.4", "--set",
        "Transient/Progress=false", "--set", "Transient/Ranks=Divide"
    ]
    interrupted_twice("string with a law of the bit divided among 2, 4 and 1 ranks",
                      str(ROOT / "xml" / "stick_slip_2500m.xml"), options, ranks=(2, 4, 1),
                      tolerance=1e-6, but="figures/axial")


def two_runs_in_one_folder():
    """Another run in the folder of an interrupted one, failed or not, keeps the pair of checkpoint
    and samples."""
    other = {
        STRING: ["--set", "Contact/Stiffness=2e7"],
        FRAME: ["--set", "Parts/Loads/shaker/Value=600"],
    }
    for title, deck in (("string", STRING), ("frame", FRAME)):
        fresh("shared", "spare")
        whole = whole_run(deck, LONG)
        size = pathlib.Path(whole, "results.h5").stat().st_size
        code = stop(signal.SIGHUP, "shared", "run", deck, "--output", "shared", *LONG)
        expect(f"{title}: run A is interrupted", code == 130, str(code))
        shutil.copytree("shared", "spare")
        failing = run("run", deck, "--output", "shared", *LONG, *other[deck],
                      largest=int(0.8 * size))
        expect(f"{title}: run B fails later", failing.returncode == 5, str(failing.returncode))
        expect(
            f"{title}: and says where A is now",
            "shared/interrupted; that run goes on with --restart shared/interrupted"
            in failing.stdout + failing.stderr, failing.stderr[-300:])
        joined = run("run", deck, "--restart", "shared", *LONG)
        expect(
            f"{title}: A does not go on from B", joined.returncode == 2
            and "does not belong to the run of this deck" in joined.stderr,
            f"{joined.returncode} {joined.stderr[-300:]}")
        done = run("run", deck, "--restart", "shared/interrupted", *LONG)
        wrong = differences(whole,
                            "shared/interrupted") if done.returncode == 0 else [done.stderr[-300:]]
        expect(f"{title}: A goes on from where it is now", not wrong, "; ".join(wrong[:6]))
        # the checkpoint of A with the samples of B, and without samples
        for name in ("results.h5", "results.h5.part"):
            pathlib.Path("spare", name).unlink(missing_ok=True)
        none = run("run", deck, "--restart", "spare", *LONG)
        expect(f"{title}: a checkpoint without samples is refused", none.returncode == 5
               and "not the samples before it" in none.stderr,
               f"{none.returncode} {none.stderr[-300:]}")
        shutil.copy("shared/results.h5", "spare/results.h5.part")
        foreign = run("run", deck, "--restart", "spare", *LONG)
        expect(f"{title}: so are the samples of B", foreign.returncode == 5
               and "belongs to another run" in foreign.stderr,
               f"{foreign.returncode} {foreign.stderr[-300:]}")


def restart_killed_early():
    """A restart that is killed, or fails, before its own first checkpoint keeps its starting
    checkpoint."""
    fresh("early")
    whole = whole_run(STRING, LONG)
    stop(signal.SIGKILL, "early", "run", STRING, "--output", "early", *LONG)
    for _ in range(2):
        process = subprocess.Popen(command("run", STRING, "--restart", "early",
                                           *LONG), stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL, env=of_ranks(1))
        while process.poll() is None and not pathlib.Path("early/checkpoint.h5").exists():
            time.sleep(0.001)
        process.kill()
        process.wait()
    done = run("run", STRING, "--restart", "early", *LONG)
    wrong = differences(whole, "early") if done.returncode == 0 else [done.stderr[-300:]]
    expect("after restarts that came to nothing it still goes on to the same numbers", not wrong,
           "; ".join(wrong[:6]))


def elsewhere():
    """--output with --restart: the folder of the interrupted run is not changed."""
    fresh("from", "to")
    whole = whole_run(STRING, LONG)
    stop(signal.SIGTERM, "from", "run", STRING, "--output", "from", *LONG)
    before = {path.name: path.read_bytes() for path in pathlib.Path("from").iterdir()}
    done = run("run", STRING, "--restart", "from", "--output", "to", *LONG)
    wrong = differences(whole, "to") if done.returncode == 0 else [done.stderr[-300:]]
    expect("a restart into another folder ends with the same numbers", not wrong,
           "; ".join(wrong[:6]))
    expect("and changes nothing in the first",
           before == {path.name: path.read_bytes() for path in pathlib.Path("from").iterdir()})


def other_decks():
    """A checkpoint restarts only its own run, and the message names the difference."""
    fresh("deck", "kept")
    shutil.copytree(ROOT / "xml" / "frame", "deck/frame")
    shutil.copy(FRAME, "deck/frame.xml")
    stop(signal.SIGTERM, "kept", "run", "deck/frame.xml", "--output", "kept", *LONG)
    before = {path.name: path.read_bytes() for path in pathlib.Path("kept").iterdir()}
    changes = {
        "Transient/End Time was 8 and is 9": ["--set", "Transient/End Time=9"],
        "Parts/Loads/wind/Value was 2000 and is 2001": ["--set", "Parts/Loads/wind/Value=2001"],
        "Reduction/Mode Selection/Cut-off Frequency was 400 and is 300": [
            "--set", "Reduction/Mode Selection/Cut-off Frequency=300"
        ],
        "Reduction was list and is not given": ["--without", "Reduction"],
        "Output/Fields was": ["--set", "Output/Fields={displacement}"],
    }
    for ranks, refused in ((1, list(changes.items())), (2, list(changes.items())[:1])):
        for sentence, change in refused:
            done = run("run", "deck/frame.xml", "--restart", "kept", *LONG, *change, ranks=ranks)
            expect(f"refused on {ranks} rank(s): {sentence}", done.returncode == 2
                   and done.stderr.count(sentence) == 1, f"{done.returncode} {done.stderr[-400:]}")
    matrix = next(pathlib.Path("deck/frame/beam").glob("*.mtx"))
    matrix.write_text(matrix.read_text(encoding="utf-8") + "\n", encoding="utf-8")
    done = run("run", "deck/frame.xml", "--restart", "kept", *LONG)
    expect(
        "refused: a part file has changed", done.returncode == 2
        and f"Parts/Imported/middle beam/File/{matrix.name} has changed" in done.stderr,
        f"{done.returncode} {done.stderr[-400:]}")
    shutil.copytree(ROOT / "xml" / "frame", "deck/frame", dirs_exist_ok=True)
    after = {path.name: path.read_bytes() for path in pathlib.Path("kept").iterdir()}
    expect("what is refused changes nothing in the folder", before == after)
    whole = (pathlib.Path("kept") / "checkpoint.bin").read_bytes()
    middle = len(whole) // 2
    for what, damaged in (
        ("a bit", whole[:middle] + bytes([whole[middle] ^ 16]) + whole[middle + 1:]),
        ("a byte more", whole + b"\0"),
        ("a byte less", whole[:-1]),
    ):
        (pathlib.Path("kept") / "checkpoint.bin").write_bytes(damaged)
        for ranks in (1, 2) if what == "a bit" else (1,):
            done = run("run", "deck/frame.xml", "--restart", "kept", *LONG, ranks=ranks)
            expect(f"refused on {ranks} rank(s): {what} of the checkpoint", done.returncode == 5
                   and done.stderr.count("is damaged") == 1,
                   f"{done.returncode} {done.stderr[-400:]}")
    (pathlib.Path("kept") / "checkpoint.bin").write_bytes(whole)
    done = run("run", "deck/frame.xml", "--restart", "kept", *LONG, "--set",
               "Transient/Checkpoint Interval=0.5", "--set", "Output/Compression=3")
    expect("what changes no number may change", done.returncode == 0, done.stderr[-400:])
    done = run("run", "deck/frame.xml", "--restart", "kept", *LONG)
    expect("a finished run holds no checkpoint", done.returncode == 5
           and "holds no checkpoint.bin" in done.stderr, f"{done.returncode} {done.stderr[-400:]}")


def other_contents():
    """Files of a string that have changed: survey and library."""
    fresh("contents", "kept")
    pathlib.Path("contents").mkdir()
    for name in ("survey.csv",):
        pathlib.Path("contents", name).write_text(
            "depth [m],inclination [deg],azimuth [deg]\n0,40,10\n60,60,10\n", encoding="utf-8")
    well = [
        "--set", "Well/Trajectory=Survey", "--set", "Well/Survey/File=survey.csv", "--without",
        "Well/Arc"
    ]
    shutil.copy(STRING, "contents/scene.xml")
    code = stop(signal.SIGTERM, "kept", "run", "contents/scene.xml", "--output", "kept", *LONG,
                *well)
    expect("a string along a survey is interrupted", code == 130, str(code))
    pathlib.Path("contents", "survey.csv").write_text(
        "depth [m],inclination [deg],azimuth [deg]\n0,40,10\n60,60.001,10\n", encoding="utf-8")
    done = run("run", "contents/scene.xml", "--restart", "kept", *LONG, *well)
    expect(
        "refused: the survey has changed", done.returncode == 2
        and "the content of the file of Well/Survey/File has changed" in done.stderr,
        f"{done.returncode} {done.stderr[-400:]}")


def results_larger_than_the_disk():
    """The longest motion that a deck may request, all fields recorded: 0.4 to 0.6 TB. The test is
    left out on a disk with more free space."""
    longest = [
        "--set", "Transient/Sampling Interval=0.005", "--set", "Transient/End Time=4.9e5", "--set",
        "Output/Fields={displacement, velocity, acceleration, normal_force}"
    ]
    if shutil.disk_usage(".").free > 0.39e12:
        return print("left out: the disk has more room than the largest results")
    for title, deck in (("string", STRING), ("frame", FRAME)):
        fresh("room")
        for ranks in (1, 2):
            done = run("run", deck, "--output", "room", *longest, ranks=ranks)
            expect(f"{title}: results larger than the disk are refused, {ranks} rank(s)",
                   done.returncode == 5 and done.stderr.count("has room for") == 1,
                   f"{done.returncode} {done.stderr[-300:]}")


if __name__ == "__main__":
    if PART == "integrators":
        integrators()
    elif PART in ("analyses", "bits"):
        {"analyses": analyses, "bits": bits}[PART]()
    else:
        for part in (results_larger_than_the_disk, full_disk, other_ranks, two_runs_in_one_folder,
                     restart_killed_early, elsewhere, other_decks, other_contents):
            part()
    sys.exit(finish())
