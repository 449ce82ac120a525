# SPDX-License-Identifier: BSD-3-Clause
"""Output of torque and drag: tables, refusals, an interrupted command that continues."""
import json
import pathlib
import shutil
import signal
import subprocess
import sys
import time

import h5py

from checks import expect, tooljoint
from runs import DECK, SOURCES, near, rows, run


def announced():
    """`tooljoint check` describes the computations of torque-drag."""
    done = tooljoint("check", DECK, "--set", "Torque and Drag/Depths={400, 800}", "--set",
                     "Torque and Drag/Operations={Trip in}", "--set",
                     "Torque and Drag/Stiff String=All Depths")
    plain = " ".join(tooljoint("check", DECK).stdout.split())
    for text in (
            "torque and drag by default: 20 depths, 7 operations, the stiff string at the deepest "
            "(tooljoint torque-drag)",
            "bottom-hole assembly by default: 1 hole, 1 weight on bit, 1 tool face (tooljoint bha)",
            "buckling by default: up to 50 kN on the bit, crookedness 0.02 of the clearance, jumps "
            "where states become unstable (tooljoint buckling)",
            "no campbell no Campbell list: give its Highest Speed",
            "no response no Response list: give its Highest Speed or Highest Frequency, and "
            "Outputs", "no map no Map list: give its Grid and Values"):
        expect(f"check of a deck without their lists: {text}", text in plain, plain[-800:])
    expect(
        "check: depths, operations and the stiff string",
        "2 depths, 1 operation, the stiff string at all of them" in " ".join(done.stdout.split()),
        done.stdout[-600:] + done.stderr)


def tables_and_refusals():
    depths = run("some", "Torque and Drag/Depths={400, 800}",
                 "Torque and Drag/Operations={Trip in}", "Torque and Drag/Block Weight=100 kN")
    expect("a row for each depth and operation",
           [float(row["bit_depth"]) for row in depths] == [400, 800], depths)
    bare = run("bare", "Torque and Drag/Depths={400, 800}", "Torque and Drag/Operations={Trip in}")
    near("the block hangs on the hook",
         float(depths[0]["hook_load"]) - float(bare[0]["hook_load"]), 1e5, 1e-9)
    profile = rows("some", "torque_drag_profile.csv")
    expect("the profile is that of the deepest bit",
           float(profile[0]["depth"]) == 800 and float(profile[-1]["depth"]) == 0, profile[0])
    two = run("ranks", "Torque and Drag/Depths={400, 800}", "Torque and Drag/Operations={Trip in}",
              ranks=2)
    expect("two ranks give the same table", two == bare)
    for name, words, arguments in (
        ("frame", "string in its well", ["torque-drag",
                                         str(SOURCES / "xml/frame.xml")]),
        ("no friction", "Add the list Contact", ["torque-drag", DECK, "--without", "Contact"]),
        ("no weight", "Add the list Loads", ["torque-drag", DECK, "--without", "Loads"]),
        ("too deep", "longer string",
         ["torque-drag", DECK, "--set", "Torque and Drag/Depths={9000}"]),
        ("a depth twice", "holds 500 m twice",
         ["torque-drag", DECK, "--set", "Torque and Drag/Depths={500, 500}"]),
        ("an operation twice", 'holds "Trip in" twice',
         ["torque-drag", DECK, "--set", "Torque and Drag/Operations={Trip in, Trip in}"]),
    ):
        done = tooljoint(*arguments)
        expect(f"refused: {name}", done.returncode == 2 and words in done.stderr,
               f"{done.returncode} {done.stderr}")


def stopped(folder, how, settings):
    """Stops a command by a signal after two depths; returns its exit code and the number of stored
    depths."""
    arguments = [part for setting in settings for part in ("--set", setting)]
    command = subprocess.Popen([sys.argv[1], "torque-drag", DECK, "--output", folder, *arguments],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    kept = pathlib.Path(folder, "cache")
    while command.poll() is None and (not kept.is_dir()
                                      or len(list(kept.glob("depths_*.json"))) < 2):
        time.sleep(0.02)
    command.send_signal(how)
    return command.wait(), len(list(kept.glob("depths_*.json")))


def resumed():
    """A stopped command continues: finished depths are not computed again, and the tables are those
    of an uninterrupted command."""
    settings = ("Torque and Drag/Count=6", "Torque and Drag/Stiff String=All Depths",
                "Torque and Drag/Operations={Trip out, Drill rotating}")
    whole = run("whole", *settings)
    arguments = [part for setting in settings for part in ("--set", setting)]
    for how in (signal.SIGTERM, signal.SIGKILL):
        folder = f"stopped_{how.name}"
        shutil.rmtree(folder, ignore_errors=True)  # remains of an interrupted test
        code, left = stopped(folder, how, settings)
        expect(f"{how.name}: it stops with some depths done",
               code == (130 if how == signal.SIGTERM else -9) and 2 <= left < 6, f"{code} {left}")
        done = tooljoint("torque-drag", DECK, "--output", folder, *arguments)
        expect(
            f"{how.name}: they are known",
            f"{left} of 6 depths are known from before" in done.stdout
            and done.stdout.count("stiff string, bit at") == 6 - left, done.stdout[-800:])
        expect(f"{how.name}: the same table", rows(folder) == whole)
    done = tooljoint("torque-drag", DECK, "--output", "stopped_SIGKILL", *arguments, ranks=2)
    expect("all are known to two ranks", "6 of 6 depths" in done.stdout
           and rows("stopped_SIGKILL") == whole, done.stdout[-800:])
    done = tooljoint("torque-drag", DECK, "--output", "stopped_SIGKILL", *arguments, "--set",
                     "Loads/Weight On Bit=60 kN")
    expect(
        "another deck: all depths are computed, and that is said",
        "depths of another deck" in " ".join(done.stdout.split())
        and done.stdout.count("stiff string, bit at") == 6, done.stdout[-800:])
    done = tooljoint("torque-drag", DECK, "--output", "stopped_SIGTERM", *arguments, "--fresh")
    expect("--fresh forgets them", "known" not in done.stdout
           and done.stdout.count("stiff string, bit at") == 6, done.stdout[-800:])


def files():
    """torque_drag.h5 and summary.json have the numbers of the tables, and may be in one folder with
    the results of a run."""
    done = tooljoint("run", DECK, "--output", "files", "--without", "Transient")
    expect("the static state is found", done.returncode == 0, done.stderr)
    run_summary = json.loads(pathlib.Path("files/summary.json").read_text(encoding="utf-8"))
    expect("the figures of a run are null in torque_drag",
           run_summary["torque_drag"]["rows"] is None)
    table = run("files", "Torque and Drag/Count=2", "Torque and Drag/Yield Strength=931 MPa")
    summary = json.loads(pathlib.Path("files/summary.json").read_text(encoding="utf-8"))
    expect(
        "the figures of the run stay", summary["static"] == run_summary["static"]
        and pathlib.Path("files/results.h5").is_file())
    expect("its files and these are listed",
           {"results.h5", "torque_drag.h5", "torque_drag.csv"} <= set(summary["files"]),
           summary["files"])
    own = summary["torque_drag"]
    deepest = [row for row in table if float(row["bit_depth"]) == own["bit_depth"]]
    expect("two depths", own["depths"] == 2 and own["missing"] == 0 and own["locked_up"] == 0,
           {key: own[key] for key in ("depths", "missing", "locked_up")})
    wrong = [(row["operation"], name) for row, found in zip(deepest, own["rows"]) for name in row
             if name not in ("bit_depth", "operation") and (
                 found[name] is not None if row[name] == "" else found[name] is None
                 or abs(found[name] - float(row[name])) > 1e-8 * abs(float(row[name])))]
    expect("rows of the summary are those of the table",
           len(own["rows"]) == len(deepest) == 7 and not wrong, wrong[:5])
    with h5py.File("files/torque_drag.h5") as file:
        names = [name for name in table[0] if name != "operation"]
        expect(
            "a dataset for each column, with its unit",
            all(file[f"/rows/{name}"].attrs["units"] and file[f"/rows/{name}"].attrs["long_name"]
                for name in names))
        for name in names:
            known = [True] * len(table) if name == "bit_depth" else file[f"/known/{name}"][()] == 1
            same = all((row[name] != "") == bool(k) and abs(float(row[name] or 0) - value) <= 1e-8 *
                       abs(value) for row, k, value in zip(table, known, file[f"/rows/{name}"][()]))
            expect(f"torque_drag.h5, {name}", same)
        tension = file["/profile/Trip out/tension"][()]
        line = [
            row for row in rows("files", "torque_drag_profile.csv")
            if row["operation"] == "Trip out"
        ]
        expect(
            "the profile is that of the table",
            len(tension) == len(line)
            and abs(tension[-1] - float(line[-1]["tension"])) < 1e-6 * abs(tension[-1]))
        expect(
            "and that of the stiff string",
            len(file["/profile/Trip out/stiff/contact_force"]) == len(
                file["/profile/Trip out/stiff/tension"]) + 1)
    again = tooljoint("run", DECK, "--output", "files", "--without", "Transient")
    expect("a run that comes after takes the folder for itself", again.returncode == 0
           and not pathlib.Path("files/torque_drag.csv").exists(), again.stderr)
