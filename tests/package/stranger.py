#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the commands of docs/first-report.md word for word: from the packages to a report of a
user's own well.

    stranger.py PACKAGES      in an empty Debian 12 (target `clean-root`): made by mmdebstrap, the
                              packages of the folder PACKAGES installed by apt. Needs root and the
                              network.

check_debian.py runs the commands after the installation on the unpacked packages.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "support"))
from checks import expect, finish  # noqa: E402

PAGE = HERE.parents[1] / "docs/first-report.md"
MOST = 10  # commands
SUITE = "bookworm"
INSTALL, OPEN = "sudo apt install", "xdg-open"


def page():
    """(commands, survey) of the page."""
    text = PAGE.read_text(encoding="utf-8")
    block = lambda kind: re.search(rf"^```{kind}\n(.*?)^```", text, re.M | re.S).group(
        1)  # noqa: E731
    return block("sh").splitlines(), block("text")


def script(commands):
    """A shell script that ends at the first failing command; instead of opening the page it checks
    that the page exists."""
    lines = [command.replace(OPEN, "test -s") for command in commands]
    return "set -eu\n" + "".join(f"echo '@@ {line}'\n{line}\n" for line in lines)


def installation(commands):
    return next(i for i, command in enumerate(commands) if command.startswith(INSTALL))


def before_installation():
    """Commands that make the packages."""
    commands, _ = page()
    return commands[:installation(commands)]


def behind_installation():
    """Commands after the installation, at most the ten that the page promises, and the survey."""
    commands, survey = page()
    expect(f"the page has at most {MOST} commands", len(commands) <= MOST, str(len(commands)))
    return commands[installation(commands) + 1:], survey


def installed(folder):
    """Names of the files that the page installs from the folder with its packages."""
    commands, _ = page()
    pattern = commands[installation(commands)].removeprefix(INSTALL).strip()
    return sorted(path.name for path in pathlib.Path(folder).glob(pattern))


def judge(done, home):
    """Checks the final result of a new user."""
    expect("every command of the page succeeds", done.returncode == 0,
           done.stdout[-600:] + done.stderr[-600:])
    if done.returncode:
        return
    folder = home / "my_well/results/my_well"
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    expect("the run is finished", summary["status"] == "finished")
    deepest = [line for line in page()[1].splitlines() if line][-1].split(",")[0]
    expect("the string hangs in the well of the survey",
           abs(summary["model"]["length"] - float(deepest)) < 0.01,
           f"{summary['model']['length']} {deepest}")
    report = (folder / "report.html").read_text(encoding="utf-8")
    expect("the report shows it", "<svg" in report and "Hook load" in report)
    screen = done.stdout.split("@@ tooljoint run")[-1]
    expect("the last screen says where the report is", "\nhook load" in screen
           and "open        results/my_well/report.html" in screen, screen[-800:])


def on_files(environment, home):
    """The commands with the programs that `environment` finds, in the folder `home`."""
    commands, survey = behind_installation()
    shutil.rmtree(home, ignore_errors=True)
    home.mkdir()
    (home / "survey.csv").write_text(survey, encoding="utf-8")
    done = subprocess.run(["bash", "-c", script(commands)], cwd=home, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, check=False, timeout=240,
                          env={**environment, "HOME": str(home)})
    judge(done, home)


def in_clean_root(packages):
    """The same in an empty Debian; its apt installs the packages with all dependencies and
    recommendations."""
    if os.geteuid() != 0 or not shutil.which("mmdebstrap"):
        sys.exit("The clean root needs root and mmdebstrap (Debian: mmdebstrap).")
    names = ("tooljoint", "libtooljoint-dev", "python3-tooljoint")
    found = {name: sorted(pathlib.Path(packages).glob(f"{name}_*.deb")) for name in names}
    if not all(found.values()):
        sys.exit(f"{packages} lacks one of {', '.join(names)}. Make them with: cpack --config "
                 f"build/release/CPackConfig.cmake -B {packages}")
    newest = [files[-1] for files in found.values()]
    root = pathlib.Path("clean_root").resolve()
    if not (root / "etc/debian_version").is_file():
        shutil.rmtree(root, ignore_errors=True)
        done = subprocess.run(["mmdebstrap", "--variant=minbase", "--mode=root", SUITE, root],
                              check=False)
        expect("an empty Debian 12", done.returncode == 0)
    for package in newest:
        shutil.copy(package, root / "tmp")
    tests = pathlib.Path(__file__).resolve().parent
    shutil.copytree(tests, root / "tmp/client", dirs_exist_ok=True)
    shutil.copy(tests.parent / "python/check_installed.py", root / "tmp")

    def inside(text, **options):
        within = (f"mount --bind /proc {root}/proc && mount --bind /dev {root}/dev && exec chroot "
                  f"{root} /bin/bash -c \"$0\"")
        return subprocess.run(
            ["unshare", "-m", "--propagation", "private", "bash", "-c", within, text], text=True,
            check=False, **options)

    done = inside("apt-get update && DEBIAN_FRONTEND=noninteractive apt-get install -y cmake g++ "
                  f"{' '.join(f'/tmp/{package.name}' for package in newest)}")
    expect("apt installs the packages", done.returncode == 0)
    ranks = "export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1; "
    for what, text in (
        ("a client is built with the headers and runs", "cmake -S /tmp/client -B /tmp/client_build "
         "&& cmake --build /tmp/client_build && /tmp/client_build/client"),
        ("Python imports its package and computes",
         "python3 /tmp/check_installed.py /usr/lib/python3/dist-packages"),
    ):
        expect(what, inside(ranks + text).returncode == 0)
    commands, survey = behind_installation()
    home = root / "root/stranger"
    shutil.rmtree(home, ignore_errors=True)
    home.mkdir(parents=True)
    (home / "survey.csv").write_text(survey, encoding="utf-8")
    environment = ("export HOME=/root/stranger OMPI_ALLOW_RUN_AS_ROOT=1 "
                   "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1; cd; ")
    judge(inside(environment + script(commands), stdout=subprocess.PIPE, stderr=subprocess.PIPE),
          home)


if __name__ == "__main__":
    in_clean_root(sys.argv[1])
    sys.exit(finish())
