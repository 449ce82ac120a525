#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Output of the program: the last screen of a run, the progress of a motion, colours on terminals
only, --quiet and --verbose.

    check_terminal.py PROGRAM
"""
import json
import os
import pathlib
import pty
import re
import shlex
import subprocess
import sys
import threading

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests" / "support"), str(ROOT / "tools")]
from checks import TIME_FACTOR, expect, finish, of_ranks, tooljoint  # noqa: E402
from report import checks  # noqa: E402

SCENE = str(ROOT / "tests/effects/scene.xml")
TWO_PARTS = str(ROOT / "xml/templates/parts.xml")
FRAME = str(ROOT / "xml/frame.xml")
os.environ.pop("TOOLJOINT_REPORT", None)  # these runs write a report
COLOURS = re.compile(r"\x1b\[[0-9]+m")
NAMES = ("hook load", "surface torque", "largest side force", "bit speed", "worst check", "speed")


def on_terminal(*arguments, **environment):
    """(exit code, text) of the program with output and errors on a terminal."""
    outer, inner = pty.openpty()
    shown = []

    def read():
        while True:
            try:
                data = os.read(outer, 65536)
            except OSError:  # the other end is closed
                return
            if not data:
                return
            shown.append(data)

    reader = threading.Thread(target=read)
    reader.start()
    inherited = {
        name: value for name, value in of_ranks(1).items() if name not in ("NO_COLOR", "TERM")
    }
    done = subprocess.run([sys.argv[1], *arguments], stdin=inner, stdout=inner, stderr=inner,
                          check=False, timeout=120 * TIME_FACTOR,
                          env={**inherited, "TERM": "xterm", **environment})
    os.close(inner)
    reader.join()
    os.close(outer)
    return done.returncode, b"".join(shown).decode().replace("\r\n", "\n")


def run(folder, *words, deck=SCENE):
    return ["run", deck, "--output", folder, *words]


def value(text, name):
    """The first number after a name of the last screen."""
    found = re.search(rf"^{name} +(-?[\d.e+-]+)", text, re.M)
    return float(found.group(1)) if found else None


def last_screen():
    """The numbers are those of summary.json, the verdict is that of the report."""
    done = tooljoint(*run("plain", "--set", "Transient/End Time=0.3"))
    expect("a run succeeds", done.returncode == 0, done.stderr[-300:])
    summary = json.loads(pathlib.Path("plain/summary.json").read_text(encoding="utf-8"))
    screen = done.stdout[done.stdout.index("\nhook load"):]
    expect("six numbers in this order",
           [name for name in NAMES if value(screen, name) is not None or name == "worst check"
            ] == list(NAMES), screen)
    static, motion = summary["static"], summary["transient"]
    for name, wanted, half in (
        ("hook load", static["hook_load"] / 1e3, 0.05),
        ("surface torque", static["surface_torque"] / 1e3, 0.005),
        ("largest side force", static["max_normal_force"] / 1e3, 0.005),
        ("bit speed", motion["bit_speed_rpm"]["mean"], 0.05),
    ):
        found = value(screen, name)
        expect(f"{name} is that of the summary", found is not None
               and abs(found - wanted) <= 1.01 * half, f"{found} {wanted}")
    torques = []
    for sense in (1, -1):
        done = tooljoint(*run("turned", "--without", "Transient", "--without", "Reduction",
                              "--without", "Substructures", "--set",
                              f"Rotary Speed/Exponential/Final Speed={120 * sense} rpm", "--set",
                              f"Loads/Torque On Bit={500 * sense}"))
        torques.append(value(done.stdout, "surface torque"))
    expect("a string that turns the other way has the same torque against its rotation",
           torques[0] == torques[1] and torques[0] > 0, f"{torques}")
    name, worst, bound = checks.worst(summary)
    expect(
        "the worst check is that of the report",
        f"{'met' if worst <= bound else 'NOT MET'}" in screen
        and f"{name} {worst:.2g}, bound {bound:g}" in screen, f"{name} {worst} {screen}")
    expect("it says where the report is", "open        plain/report.html in a browser" in screen,
           screen)
    expect("and what to try next", re.search(r"^next        \S", screen, re.M) is not None, screen)
    expect(
        "with a command that stands on one line",
        all(
            line.startswith(("next        tooljoint ", "next        the run again with ",
                             "            tooljoint ", "              --"))
            for line in screen[screen.index("\nnext  "):].strip().splitlines()), screen[-300:])
    expect("no colours in a pipe", not COLOURS.search(done.stdout + done.stderr))
    expect("no bar in a pipe", "\r" not in done.stderr)
    rest = tooljoint(*run("rest", "--without", "Transient", "--set", "Output/Report=false"))
    expect(
        "at rest: no motion, no report, and torque-drag next", rest.returncode == 0
        and "bit speed" not in rest.stdout.split("hook load")[-1]
        and "tooljoint report rest" in rest.stdout and "tooljoint torque-drag" in rest.stdout,
        rest.stdout[-600:])
    parts = tooljoint(*run("parts", "--set", "Transient/End Time=0.02", "--set",
                           "Output/Report=false", deck=FRAME))
    expect(
        "parts: their displacement, and no hook load", parts.returncode == 0
        and "displacement  " in parts.stdout and "hook load" not in parts.stdout,
        parts.stdout[-600:])
    told = tooljoint(*run("told", "--set", "Transient/End Time=0.02 s", "--set",
                          "Output/Report=false", deck=TWO_PARTS))
    command = re.search(r"^next +tooljoint (run .*?)\n +tooljoint compare", told.stdout,
                        re.M | re.S)
    again = tooljoint(*shlex.split(command.group(1).replace("\\\n", " "))) if command else told
    expect("the full model that it suggests runs as printed", command is not None
           and again.returncode == 0, told.stdout[-400:] + again.stderr)


def terminals():
    """A progress bar with rate and remaining time, and colours on terminals."""
    words = run("shown", "--set", "Transient/Progress=true", "--set", "Transient/End Time=60",
                "--set", "Output/Report=false")
    code, text = on_terminal(*words)
    expect("on a terminal: the run succeeds", code == 0, text[-400:])
    expect("with a bar that is drawn over itself", "\r\x1b[Ktransient [" in text
           and "100 %" in text, text[-800:])
    expect("with the rate of the motion",
           re.search(r"\d+ steps, [\d.e+-]+ x real time", text) is not None, text[-800:])
    expect("and the time that remains",
           re.search(r"[\d.]+ (s|min|h) left\)", text) is not None, text[-800:])
    expect("with colours", "\x1b[1mhook load" in text
           and ("\x1b[32mmet" in text or "\x1b[31mNOT MET" in text), text[-800:])
    code, text = on_terminal(*words, NO_COLOR="1")
    expect("NO_COLOR takes the colours away", code == 0 and not COLOURS.search(text)
           and "hook load" in text, text[-400:])
    code, text = on_terminal(*words, NO_COLOR="")
    expect("an empty NO_COLOR does not", code == 0 and "\x1b[1mhook load" in text, text[-400:])
    code, text = on_terminal(*words, TERM="dumb")
    expect("nor has a terminal without them colours", code == 0 and not COLOURS.search(text),
           text[-400:])
    code, text = on_terminal("run", "nowhere.xml")
    expect("errors are marked", code == 5 and "\x1b[31mtooljoint:\x1b[0m " in text,
           f"{code} {text}")


def words():
    """--quiet and --verbose."""
    quiet = tooljoint(*run("quiet", "--quiet", "--set", "Transient/End Time=0.05"))
    expect(
        "--quiet prints nothing", quiet.returncode == 0 and quiet.stdout == ""
        and pathlib.Path("quiet/report.html").is_file(), quiet.stdout)
    expect("but warnings", all(line.startswith("warning: ") for line in quiet.stderr.splitlines()),
           quiet.stderr)
    failed = tooljoint("run", "nowhere.xml", "-q")
    expect("and errors", failed.returncode == 5 and failed.stderr.startswith("tooljoint: "),
           failed.stderr)
    verbose = tooljoint(*run("verbose", "--verbose", "--set", "Transient/End Time=0.05", "--set",
                             "Output/Report=false"))
    expect(
        "--verbose prints the counters of the motion and the memory", verbose.returncode == 0
        and "counters    steps " in verbose.stdout and "memory  " in verbose.stdout,
        verbose.stdout[-800:])
    usual = tooljoint(*run("usual", "--without", "Reduction", "--without", "Substructures", "--set",
                           "Transient/End Time=0.05", "--set", "Output/Report=false"))
    diagnostics = ("counters    ", "iterations", "residual", "balance of torque", "multiplications",
                   "negative pivot", "energy balance")
    shown = " ".join(usual.stdout.split())
    expect("a usual run prints no diagnostics", usual.returncode == 0
           and not any(words in shown for words in diagnostics), usual.stdout)
    energy = json.loads(pathlib.Path("verbose/summary.json").read_text(
        encoding="utf-8"))["transient"]["energy_residual"]
    shown = " ".join(verbose.stdout.split())
    wanted = ("path iterations ", " iterations, residual ", " by the balance of torque, defect ",
              " multiplications)", f"energy balance closes to {energy:.2g} of",
              " unconverged_steps ")
    expect("--verbose prints them", all(words in shown for words in wanted), verbose.stdout)
    expect(
        "a full model has torque and drag next, in the folder of the run",
        re.search(r"^next        tooljoint torque-drag \S+ (\\\n +)?--output usual ", usual.stdout,
                  re.M) is not None, usual.stdout[-600:])
    both = tooljoint(*run("both", "--quiet", "--verbose"))
    expect("both exclude each other", both.returncode == 1 and "--quiet" in both.stderr,
           both.stderr)
    alone = tooljoint()
    expect(
        "tooljoint alone says what to type", alone.returncode == 1
        and all(f"tooljoint {word}" in alone.stderr
                for word in ("new", "check", "run", "template", "doc"))
        and "report.html" in alone.stderr, alone.stderr)


last_screen()
terminals()
words()
sys.exit(finish())
