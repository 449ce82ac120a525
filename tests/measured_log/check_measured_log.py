#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measured logs compared with the motion of a run: check_measured_log.py PROGRAM MPIEXEC SOURCES

A log made from a run has no difference. A scaled and shifted log has the difference computed by
numpy; spectra agree with scipy, peaks with those of a sine. CSV, LAS and wrapped LAS files with
other units give the same numbers, and so do two ranks and a run that is stopped and continued.
Invalid files and decks give a message.
"""
import csv
import json
import pathlib
import shutil
import signal
import subprocess
import sys
import time

import h5py
import numpy as np
from scipy import signal as filters

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from checks import expect, finish, of_ranks, tooljoint  # noqa: E402

PROGRAM, MPIEXEC, SOURCES = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
SCENE = str(SOURCES / "tests/effects/scene.xml")
RPM, POUND_FORCE, FOOT, GRAVITY = np.pi / 30, 4.4482216152605, 0.3048, 9.80665
NODE = 12
COMMON = [
    "--set", "Transient/Sampling Interval=0.001", "--set",
    "Output/Fields={displacement, velocity, acceleration, normal_force}"
]
# name of the list -> column of the log, quantity, unit of the log, its SI value, further settings
COLUMNS = {
    "bit": ("BIT_RPM", "Bit speed", "rpm", RPM, {}),
    "surface": ("RPM", "Surface speed", "rpm", RPM, {}),
    "torque": ("STOR", "Surface torque", "kft-lbf", 1e3 * FOOT * POUND_FORCE, {}),
    "hook": ("HKLD", "Hook load", "klbf", 1e3 * POUND_FORCE, {}),
    "shock": ("LAT", "Acceleration", "g", GRAVITY, {"Node": NODE, "Component": "u"}),
}


def computed(folder):
    """Time and computed signals of a run, from its usual records."""
    with h5py.File(pathlib.Path(folder, "results.h5")) as file:
        data = file["/transient"]
        return data["time"][:], {
            "bit": data["motion"][:, 2], "surface": data["surface_speed"][:],
            "torque": data["surface_torque"][:], "hook": data["hook_load"][:],
            "shock": data["acceleration"][:, NODE - 1, 0]
        }


def parameter(name, value):
    kind = "int" if isinstance(value, int) else "string"
    return f'<Parameter name="{name}" type="{kind}" value="{value}"/>'


def with_log(scene, deck, lists, **more):
    """A copy of a scene with the list; `lists`: name of a column -> its parameters."""
    columns = "".join(
        f'<ParameterList name="{name}">' + "".join(parameter(*pair)
                                                   for pair in content.items()) + "</ParameterList>"
        for name, content in lists.items())
    own = "".join(parameter(key.replace("_", " "), value) for key, value in more.items())
    text = pathlib.Path(scene).read_text(encoding="utf-8")
    end = text.rindex("</ParameterList>")
    pathlib.Path(deck).write_text(
        f'{text[:end]}<ParameterList name="Measured Log">\n{own}\n'
        f'<ParameterList name="Columns">{columns}</ParameterList>\n</ParameterList>\n'
        f'{text[end:]}', encoding="utf-8")
    return deck


def deck(name, file, names=tuple(COLUMNS), **more):
    lists = {
        key: {"Column": COLUMNS[key][0], "Quantity": COLUMNS[key][1], **COLUMNS[key][4]}
        for key in names
    }
    return with_log(SCENE, f"{name}.xml", lists, File=file, **more)


def write_csv(name, times, signals):
    """Units in the header; empty cells where a signal is nan."""
    lines = [
        "# a log",
        "Time [s], " + ", ".join(f"{COLUMNS[key][0]} [{COLUMNS[key][2]}]" for key in signals)
    ]
    for i, t in enumerate(times):
        lines.append(", ".join([repr(float(t))] + [
            "" if np.isnan(values[i]) else repr(float(values[i] / COLUMNS[key][3]))
            for key, values in signals.items()
        ]))
    pathlib.Path(name).write_text("\n".join(lines) + "\n", encoding="utf-8")


def write_las(name, times, signals, wrap=False):
    """Times in minutes and units in capitals, as is common in logs."""
    curves = "\n".join(f" {COLUMNS[key][0]:<8}.{COLUMNS[key][2].upper():<10} : {COLUMNS[key][1]}"
                       for key in signals)
    head = f"""~VERSION INFORMATION
 VERS.   2.0 : CWLS LOG ASCII STANDARD - VERSION 2.0
 WRAP.   {'YES' if wrap else 'NO'} : LINES PER STEP
~WELL INFORMATION
# MNEM.UNIT  DATA : DESCRIPTION
 STRT.MIN  {times[0] / 60!r} : START
 NULL.     -999.25 : NOT MEASURED
 WELL.     A.B: C : WELL
~CURVE INFORMATION
 ETIM.MIN  : Elapsed time
{curves}
~OTHER
 not read: anything
~A  ETIM
"""
    rows = []
    for i, t in enumerate(times):
        cells = [repr(float(t) / 60)] + [
            "-999.2500" if np.isnan(values[i]) else repr(float(values[i] / COLUMNS[key][3]))
            for key, values in signals.items()
        ]
        rows.append("\n".join([cells[0], " ".join(cells[1:4]), " ".join(cells[4:])]).rstrip(
        ) if wrap else " ".join(cells))
    pathlib.Path(name).write_text(head + "\n".join(rows) + "\n", encoding="utf-8")


def run(folder, scene, ranks=1):
    done = tooljoint("run", scene, "--output", folder, *COMMON, ranks=ranks)
    expect(f"the run {folder} ends well", done.returncode == 0, done.stderr[-400:])
    return done


def found(folder):
    measured = json.loads(pathlib.Path(folder,
                                       "summary.json").read_text(encoding="utf-8"))["measured"]
    return {row["name"]: row for row in measured["columns"]}


def near(what, value, expected, tolerance, scale=None):
    size = abs(expected) if scale is None else scale
    expect(f"{what}: {value:.8g} against {expected:.8g}", abs(value - expected) <= tolerance * size)


def of_itself():
    run("plain", SCENE)
    times, signals = computed("plain")
    write_csv("itself.csv", times, signals)
    done = run("itself", deck("itself", "itself.csv"))
    rows = found("itself")
    for name, row in rows.items():
        size = np.abs(signals[name]).max()
        expect(
            f"{name}: a log of the run itself differs by nothing ({row['largest_difference']:.1e})",
            row["largest_difference"] <= 1e-12 * size and row["samples"] == len(times), row)
        near(f"{name}: both have one index", row["computed_index"], row["measured_index"], 1e-9)
        near(f"{name}: (max - min)/(2 mean)", row["computed_index"],
             np.ptp(signals[name]) / (2 * abs(signals[name].mean())), 1e-9)
    expect("a string without a speed law at its top turns with the rotary speed",
           rows["surface"]["computed_max"] > 0)
    expect("the lines of the log say so", "stick-slip index" in done.stdout
           and "computed less measured" in done.stdout, done.stdout[-600:])
    # at rest hook load and torque are those of the static state, the start of the motion
    static = json.loads(pathlib.Path("plain/summary.json").read_text(encoding="utf-8"))["static"]
    near("hook load at the start", signals["hook"][0], static["hook_load"], 1e-6)
    near("surface torque at the start", signals["torque"][0], -static["top_torque"], 1e-6)
    return times, signals


def shifted(times, signals):
    """x -> 1.1 x + c at times late by 5 s, at every third sample and with gaps: numpy gives the
    differences, scipy the spectra."""
    offsets = {"bit": 2.0, "surface": -1.0, "torque": 300.0, "hook": -5e3, "shock": 0.5}
    changed = {key: 1.1 * values + offsets[key] for key, values in signals.items()}
    for values in changed.values():
        values[50:60] = np.nan
    some = slice(0, None, 3)
    write_csv("shifted.csv", times[some] + 5.0,
              {key: values[some] for key, values in changed.items()})
    write_las("shifted.las", times[some] + 5.0,
              {key: values[some] for key, values in changed.items()})
    write_las("wrapped.las", times[some] + 5.0,
              {key: values[some] for key, values in changed.items()}, wrap=True)
    window = {"Time_Offset": "-5 s", "Begin": "0.02 s", "End": "0.28 s"}
    run("shifted", deck("shifted", "shifted.csv", **window))
    rows = found("shifted")
    inside = (times >= 0.02 - 1e-9) & (times <= 0.28 + 1e-9)
    for name, row in rows.items():
        at = np.zeros(len(times), bool)
        at[some] = True
        at &= inside & ~np.isnan(changed[name])
        difference = (signals[name] - changed[name])[at]
        size = np.abs(signals[name]).max()
        expect(f"{name}: gaps are left out", row["samples"] == at.sum(),
               f"{row['samples']} {at.sum()}")
        near(f"{name}: mean difference", row["mean_difference"], difference.mean(), 1e-9, size)
        near(f"{name}: rms difference", row["rms_difference"], np.sqrt((difference**2).mean()),
             1e-9, size)
        near(f"{name}: largest difference", row["largest_difference"],
             np.abs(difference).max(), 1e-9, size)
        measured = changed[name][at]
        near(f"{name}: index of the measured", row["measured_index"],
             np.ptp(measured) / (2 * abs(measured.mean())), 1e-9)
    for other in ("shifted.las", "wrapped.las"):
        name = other.replace(".", "_")
        run(name, deck(name, other, **window))
        also = found(name)
        wrong = [(name, key) for name, row in rows.items() for key, value in row.items()
                 if key != "column" and isinstance(value, float)
                 and abs(also[name][key] - value) > 1e-9 * max(
                     abs(value),
                     np.abs(signals[name]).max() if "peak_hz" not in key and key not in
                     ("begin", "end") else 1.0)]
        expect(f"{other}: the numbers of the CSV file", not wrong, str(wrong))
    return rows, window


def spectra(times, signals):
    """Sines of known amplitude on a line of the spectrum; densities agree with scipy."""
    frequency, amplitude = 8 / 0.15, 3.0 * RPM  # 8 periods in a segment of 150 samples
    sine = {"bit": 12.0 + amplitude * np.sin(2 * np.pi * frequency * times)}
    write_csv("sine.csv", times, sine)
    run("sine", deck("sine", "sine.csv", names=("bit",)))
    row = found("sine")["bit"]
    with h5py.File("sine/results.h5") as file:
        group = file["/measured/bit"]
        axis, density = group["measured_frequency"][:], group["measured_spectrum"][:]
        own_axis, own = group["computed_frequency"][:], group["computed_spectrum"][:]
    length = 2 * (len(axis) - 1)
    expect(f"segments of {length} samples overlap by their halves three times",
           length * 2 <= len(times) < 2.2 * length, len(times))
    near("the peak stands at the frequency", row["measured_peak_hz"], frequency, 1e-6)
    near("with the amplitude of the sine", row["measured_peak_amplitude"], amplitude, 1e-6)
    near("the power under the density is that of the sine",
         density.sum() * axis[1], amplitude**2 / 2, 1e-6)
    for name, axis, found_density, values in (
        ("measured", axis, density, sine["bit"]),
        ("computed", own_axis, own, signals["bit"]),
    ):
        f, expected = filters.welch(values, fs=1 / (times[1] - times[0]), window="hann",
                                    nperseg=length, noverlap=length // 2, detrend="constant")
        expect(
            f"the spectrum of the {name} signal is scipy's",
            np.allclose(axis, f)
            and np.allclose(found_density, expected, rtol=1e-7, atol=1e-9 * expected.max()))
    with open("sine/measured_peaks.csv", encoding="utf-8", newline="") as text:
        peaks = [line for line in csv.DictReader(text) if line["signal"] == "measured"]
    near("the table of peaks begins with it", float(peaks[0]["amplitude"]), amplitude, 1e-6)


def ranks_and_restart(rows, window):
    run("two", deck("shifted", "shifted.csv", **window), ranks=2)
    for name, row in found("two").items():
        wrong = [
            key for key, value in rows[name].items()
            if isinstance(value, float) and "peak_hz" not in key and abs(row[key] - value) > 1e-6 *
            max(abs(value), abs(rows[name]["computed_max"]))
        ]
        expect(f"{name}: two ranks have the numbers of one", not wrong, str(wrong))
    long = ["--set", "Transient/End Time=6", "--set", "Transient/Checkpoint Interval=0.2", *COMMON]
    whole = tooljoint("run", "shifted.xml", "--output", "whole", *long)
    expect("a longer run ends well", whole.returncode == 0, whole.stderr[-300:])
    stopped = None
    for _ in range(5):  # on a busy machine a run may end before its signal
        shutil.rmtree("halted", ignore_errors=True)
        process = subprocess.Popen([PROGRAM, "run", "shifted.xml", "--output", "halted", *long],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                   env=of_ranks(1))
        while process.poll() is None and not pathlib.Path("halted/checkpoint.bin").exists():
            time.sleep(0.002)
        process.send_signal(signal.SIGTERM)
        stopped = process.wait()
        if stopped == 130:
            break
    changed = tooljoint("run", "shifted.xml", "--restart", "halted", *long, "--set",
                        "Measured Log/Columns/bit/Quantity=Surface speed")
    expect("a run that was stopped does not go on with another comparison", changed.returncode == 2
           and "Measured Log/Columns/bit/Quantity was" in changed.stderr, changed.stderr)
    done = tooljoint("run", "shifted.xml", "--restart", "halted", *long)
    expect("a run that was stopped and goes on compares all of the motion", stopped == 130
           and done.returncode == 0 and found("halted") == found("whole"),
           f"({stopped}) {done.stderr[-300:]}")


def refused(title, sentence, content, *arguments, file="bad.csv", scene=None):
    if content is not None:
        pathlib.Path(file).write_bytes(content if isinstance(content, bytes) else content.encode())
    scene = scene or deck("bad", file, names=("bit",))
    for command in (["check"], ["run", "--output", "refused"]):
        done = tooljoint(command[0], scene, *command[1:], *arguments)
        expect(f"{title}: {command[0]} refuses it with the sentence", done.returncode == 2
               and sentence in done.stderr, f"({done.returncode}) {done.stderr[-500:]}")


def bad_files(times):
    good = "Time [s], BIT_RPM [rpm]\n" + "\n".join(f"{t:.3f}, 120" for t in times) + "\n"
    las = ("~V\nVERS. 2.0 : v\nWRAP. NO : w\n~W\nNULL. -999.25 : n\n~C\nTIME.S : t\n"
           "BIT_RPM.RPM : b\n~A\n")
    refused("no file", "The measured log", None, file="nowhere.csv")
    refused("an empty file", "is empty", "")
    refused(
        "another column", 'bad.csv:1: the header has no column "BIT_RPM". Did you mean "BIT RPM2"? '
        'Columns: "Time", "BIT RPM2".', good.replace("BIT_RPM", "BIT RPM2"))
    refused("a column twice", 'occurs more than once',
            "Time [s], BIT_RPM [rpm], bit_rpm [rpm]\n0, 1, 1\n1, 1, 1\n")
    refused("no unit", 'bad.csv:1: the column "BIT_RPM" has no unit.',
            good.replace("BIT_RPM [rpm]", "BIT_RPM"))
    refused("another quantity",
            'has the unit "kN", which is not a unit of the compared quantity (rad/s)',
            good.replace("[rpm]", "[kN]"))
    refused("two units",
            'has the unit "rpm", the deck gives "rad/s". Leave out the one of the deck.', good,
            "--set", "Measured Log/Columns/bit/Unit=rad/s")
    refused(
        "no time",
        'the header has no column "Time". Name the column of the time in Measured Log/Time Column.',
        good.replace("Time", "Date"))
    refused("text for a number",
            'bad.csv:4: the value "fast" of the column "BIT_RPM" is not a finite number.',
            "Time [s], BIT_RPM [rpm]\n0, 1\n0.1, 2\n0.2, fast\n")
    refused("times that fall", 'bad.csv:4: the time "0.05" does not increase',
            "Time [s], BIT_RPM [rpm]\n0, 1\n0.1, 2\n0.05, 3\n")
    refused("a row that is short", "bad.csv:3: found 1 cells where the header has 2.",
            "Time [s], BIT_RPM [rpm]\n0, 1\n0.1\n0.2, 1\n")
    refused("one value", 'the column "BIT_RPM" has 1 values, at least two are needed.',
            "Time [s], BIT_RPM [rpm]\n0, 1\n0.1,\n")
    refused("decimal points and commas",
            "has a decimal comma, but there is a decimal point in line 2",
            "Time [s]; BIT_RPM [rpm]\n0.0; 1\n0,1; 2\n")
    refused("another file altogether", "holds bytes of zero", b"\x00\x01\x02")
    refused("another time", "has 0 samples of the column \"BIT_RPM\" from 0 to 0.3 s", good,
            "--set", "Measured Log/Time Offset=10")
    refused("LAS 3.0", 'bad.las:2: the version is "3.0", read are 2.0 and 1.2.',
            las.replace("VERS. 2.0", "VERS. 3.0") + "0 1\n1 2\n", file="bad.las")
    refused("LAS without WRAP", "bad.las:8: the section ~V has no WRAP.",
            las.replace("WRAP. NO : w\n", "") + "0 1\n1 2\n", file="bad.las")
    refused("LAS without data", "the section ~A with the data is missing.", las.replace("~A\n", ""),
            file="bad.las")
    refused("LAS with a value too many", "bad.las:11: found 3 values where ~C names 2 curves",
            las + "0 1\n0.1 2 3\n", file="bad.las")
    refused("LAS that was cut", "The file was cut.",
            las.replace("WRAP. NO", "WRAP. YES") + "0 1\n0.1\n", file="bad.las")
    refused("LAS without ~V", 'the first section is "~C"', "~C\nTIME.S : t\n~A\n0\n",
            file="bad.las")
    refused("a curve that is none",
            'bad.las:8: found "BIT_RPM RPM b", expected is "MNEMONIC.UNIT  DATA : DESCRIPTION".',
            las.replace("BIT_RPM.RPM : b", "BIT_RPM RPM b") + "0 1\n1 2\n", file="bad.las")
    pathlib.Path("good.csv").write_text(good, encoding="utf-8")
    refused("no motion", "the deck has no Transient list", None, "--without", "Transient",
            file="good.csv")
    refused("no column", "/Columns names no column", None,
            scene=with_log(SCENE, "none.xml", {}, File="good.csv"))
    refused("no law of the bit", "is constant without a law of the bit. Add the list Bit.", None,
            "--set", "Measured Log/Columns/bit/Quantity=Weight on bit", file="good.csv")
    refused("no node", 'is "Velocity", which needs the Node of the measurement.', None, "--set",
            "Measured Log/Columns/bit/Quantity=Velocity", file="good.csv")
    refused("a node too many", 'is "Bit speed", which has no Node. Leave it out.', None, "--set",
            "Measured Log/Columns/bit/Node=3", file="good.csv")
    done = tooljoint("run", "itself.xml", "--output", "refused", "--set",
                     "Measured Log/Columns/shock/Node=999")
    expect("a node that is not there ends with its path", done.returncode == 2
           and "Measured Log/Columns/shock/Node is 999" in done.stderr, done.stderr)
    checked = tooljoint("check", "itself.xml")
    said = " ".join(checked.stdout.split())
    expect(
        "check says what will be compared", checked.returncode == 0
        and "yes measured log itself.csv, 0 to 0.3 s: BIT_RPM with bit speed," in said
        and "LAT with acceleration u of node 12 (tooljoint run)" in said, said[-400:])


def of_parts():
    """The node of a frame: a log of the run gives no difference."""
    deck_of_parts = str(SOURCES / "xml/frame.xml")
    short = ["--set", "Transient/End Time=0.2"]
    done = tooljoint("run", deck_of_parts, "--output", "frame", *short)
    with h5py.File("frame/results.h5") as file:
        times, moved, nodes = file["/transient/time"][:], file["/transient/displacement"][:], file[
            "/model/node"][:]
        names = [name.decode() for name in file["/model/part_names"][:]]
        part = names[int(file["/model/part"][:][0]) - 1]
    pathlib.Path("frame.csv").write_text(
        "t [ms]; X [um]\n" +
        "\n".join(f"{1e3 * t!r}; {1e6 * x!r}"
                  for t, x in zip(map(float, times), map(float, moved[:, 0, 0]))) + "\n",
        encoding="utf-8")
    column = {
        "Column": "X", "Quantity": "Displacement", "Part": part, "Node": int(nodes[0]),
        "Component": "u"
    }
    text = pathlib.Path(deck_of_parts).read_text(encoding="utf-8").replace(
        'value="frame/', f'value="{SOURCES}/xml/frame/')
    pathlib.Path("frame_scene.xml").write_text(text, encoding="utf-8")
    done = tooljoint(
        "run",
        with_log("frame_scene.xml", "frame_measured.xml", {"corner": column}, File="frame.csv"),
        "--output", "frame_measured", *short)
    expect("parts: the run ends well", done.returncode == 0, done.stderr[-400:])
    row = found("frame_measured")["corner"]
    expect(
        "parts: the log of a node differs by nothing",
        row["largest_difference"] <= 1e-12 * max(np.abs(moved[:, 0, 0]).max(), 1e-30)
        and row["samples"] == len(times), row)


TIMES, SIGNALS = of_itself()
ROWS, WINDOW = shifted(TIMES, SIGNALS)
spectra(TIMES, SIGNALS)
bad_files(TIMES)
of_parts()
ranks_and_restart(ROWS, WINDOW)
sys.exit(finish())
