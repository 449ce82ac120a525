#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Exit codes: check_exit_codes.py PROGRAM MPIEXEC DECK [without-sundials]

Makes the program end in every possible way and compares exit code and message, on one rank and on
two. A failed run must not damage finished results, and an interrupted run must continue to the same
numbers.
"""
import json
import pathlib
import shutil
import signal
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from checks import expect, finish, tooljoint  # noqa: E402

PROGRAM, MPIEXEC, DECK = sys.argv[1:4]
CURVED = str(pathlib.Path(DECK).resolve().parents[2] / "xml" / "helical_170m.xml")
WITHOUT_SUNDIALS = "without-sundials" in sys.argv[4:]


def ends(what, code, sentence, *arguments, ranks=(1, 2)):
    for count in ranks:
        done = tooljoint(*arguments, ranks=count)
        said = done.stderr.count(sentence)
        expect(f"{what}, {count} rank(s): exit code {code}", done.returncode == code,
               f"(found {done.returncode})")
        expect(f"{what}, {count} rank(s): says \"{sentence}\" once", said == 1,
               "" if said == 1 else done.stderr[-600:])


def summary(folder):
    return json.loads(pathlib.Path(folder, "summary.json").read_text(encoding="utf-8"))


def exit_codes():
    free = [
        "--set", "Supports/Top=none", "--set", "Supports/Bit=none", "--without", "Supports/guide",
        "--without", "Contact", "--without", "Transient", "--without", "Reduction", "--without",
        "Substructures"
    ]
    ends("no deck", 1, "DECK is required", "run", ranks=(1,))
    ends("unknown option", 1, "--nonsense", "run", DECK, "--nonsense", ranks=(1,))
    ends("missing deck", 5, "nowhere.xml", "run", "nowhere.xml")
    ends("misspelt parameter", 2, "Did you mean", "run", DECK, "--set", "Contact/Stiffnes=1")
    ends("study without a Study list", 2, "has no Study list", "study", DECK)
    ends("floating string", 3, "The string floats", "run", DECK, "--output", "floating", *free)
    ends("string that slides in a curved well", 3, "The string floats: w is free at all of its",
         "run", CURVED, "--output", "sliding", "--set", "Supports/Top=u v theta_z", "--set",
         "Static/Max Iterations=20", "--without", "Transient", "--without", "Reduction",
         "--without", "Substructures", "--without", "Study", ranks=(1,))
    ends("static state not reached", 4, "The static equilibrium did not converge", "run", DECK,
         "--output", "unconverged", "--set", "Static/Max Iterations=1")
    ends("motion not solved", 4, "Step", "run", DECK, "--output", "lost", "--set",
         "Transient/Step=0.1", "--set", "Transient/Sampling Interval=0.1", "--set",
         "Transient/Generalized-alpha/Max Iterations=2", "--set",
         "Transient/Generalized-alpha/Max Halvings=0")
    pathlib.Path("a_file").write_text("not a folder", encoding="utf-8")
    ends("folder that cannot be made", 5, "a_file", "run", DECK, "--output", "a_file/results")


def template_is_a_deck():
    """The output of `tooljoint template scene` is accepted and runs unchanged."""
    printed = tooljoint("template", "scene")
    pathlib.Path("template.xml").write_text(printed.stdout, encoding="utf-8")
    checked = tooljoint("check", "template.xml")
    expect("the template is a valid deck", printed.returncode == 0 and checked.returncode == 0,
           checked.stderr[-400:])
    done = tooljoint("run", "template.xml", "--output", "template")
    expect("and runs", done.returncode == 0 and summary("template")["status"] == "finished",
           done.stderr[-400:])


def optional_integrators():
    """A build without SUNDIALS lists its integrators, and its message states what is missing and
    how to install it."""
    for name in ("SUNDIALS ARKODE", "SUNDIALS CVODE"):
        asked = ["--set", f"Transient/Integrator={name}"]
        if WITHOUT_SUNDIALS:
            said = (f'this program was built without SUNDIALS, which "{name}" needs. Install '
                    'libsundials-dev and configure with -D TOOLJOINT_SUNDIALS=ON')
            ends(f"{name} in a build without it, check", 2, said, "check", DECK, *asked, ranks=(1,))
            ends(f"{name} in a build without it, run", 2, said, "run", DECK, "--output", "optional",
                 *asked)
        else:
            done = tooljoint("check", DECK, *asked)
            expect(f"{name} is there", done.returncode == 0, done.stderr[-400:])


def failed_run_spoils_nothing():
    tooljoint("run", DECK, "--output", "kept")
    before = {
        path.name: path.read_bytes() for path in pathlib.Path("kept").iterdir()
        if not path.name.endswith(".part")
    }
    done = tooljoint("run", DECK, "--output", "kept", "--set", "Static/Max Iterations=1")
    after = {
        path.name: path.read_bytes() for path in pathlib.Path("kept").iterdir()
        if not path.name.endswith(".part")
    }
    expect("a failed run leaves finished results as they were", done.returncode == 4
           and "results.h5" in before and before == after)


def interrupted_run_goes_on():
    long = [
        "--set", "Transient/End Time=40", "--set", "Output/XDMF=false", "--set",
        "Transient/Checkpoint Interval=0.5"
    ]
    tooljoint("run", DECK, "--output", "whole", *long)
    process = subprocess.Popen([PROGRAM, "run", DECK, "--output", "broken", *long],
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    while process.poll() is None and not pathlib.Path("broken/checkpoint.bin").exists():
        time.sleep(0.005)
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=60)
    expect("an interrupted run ends with 130 and says how to go on", process.returncode == 130
           and "--restart" in said, f"({process.returncode})")
    expect("its summary says interrupted", summary("broken")["status"] == "interrupted")
    done = tooljoint("run", DECK, "--restart", "broken", *long)
    expect("it goes on", done.returncode == 0, done.stderr[-400:])
    lines = [
        pathlib.Path(folder, "motion.csv").read_text(encoding="utf-8").splitlines()
        for folder in ("whole", "broken")
    ]
    expect("and ends with the same numbers", lines[0] == lines[1],
           f"({len(lines[0])} and {len(lines[1])} lines)")


def main():
    for left in ("floating", "sliding", "template", "unconverged", "lost", "kept", "whole",
                 "broken"):  # of an earlier run of this test
        shutil.rmtree(left, ignore_errors=True)
    exit_codes()
    optional_integrators()
    template_is_a_deck()
    failed_run_spoils_nothing()
    interrupted_run_goes_on()
    return finish()


if __name__ == "__main__":
    sys.exit(main())
