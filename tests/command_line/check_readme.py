#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the commands of documents word for word: check_readme.py PROGRAM PROJECT [PAGE]

Without PAGE the block "Go on" of README.md; with PAGE a tutorial: its blocks `sh`, one after the
other in one shell. Each line of its blocks `text` must be in the output of the commands before it.

The commands run in a scratch folder that looks like the project. build/release/tooljoint is a
script there that passes its arguments to PROGRAM and shortens motions, maps and studies, so that
every command runs and the test takes seconds instead of minutes. Tutorials are run with the whole
motions, since they show numbers of them.
"""
import json
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from checks import expect, finish  # noqa: E402
from pictured import compare  # noqa: E402

PROGRAM, PROJECT = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
SHORT = {
    "study": [
        "Study/End Time=0.03", "Study/Window=0.015", "Study/Repeats=1", "Study/Pictures=false"
    ],
    "run": ["Transient/End Time=1"],
    "map": ["Transient/End Time=0.1", "Map/Grid/speed/Count=2"],
}

# Pictures of reports -> the reports of the page that they show
PICTURED = {
    "docs/tutorial-first-string.md": dict.fromkeys(("tutorial_report.png", "report_string.png"),
                                                   "results/first/report.html"),
    "docs/tutorial-own-parts.md": {"tutorial_parts.png": "results/parts/report.html"},
}


def block():
    """The lines of the block without their indentation."""
    text = (PROJECT / "README.md").read_text(encoding="utf-8")
    section = re.search(r"^## Go on\n\n((?:    .*\n)+)", text, re.M)
    return [line[4:] for line in section.group(1).splitlines()]


def stage(folder, settings):
    """A folder that looks like the project; its program adds these `settings` to the commands."""
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "build/release").mkdir(parents=True)
    for name in ("tools", "xml"):
        (folder / name).symlink_to(PROJECT / name)
    program = folder / "build/release/tooljoint"
    cases = "".join(f'{name}) set -- "$@"' + "".join(f" --set {shlex.quote(text)}"
                                                     for text in texts) + " ;; "
                    for name, texts in settings.items())
    program.write_text(
        f'#!/bin/bash\ncase "$1" in {cases}esac\nexec {shlex.quote(str(PROGRAM))} "$@"\n',
        encoding="utf-8")
    program.chmod(0o755)


def summary(path):
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {"status": "absent"}


def check_readme(folder):
    lines = block()
    timed = "".join(f"{line}\necho \"@@ $SECONDS s, {number} lines\" >&2\n"
                    for number, line in enumerate(lines, 1))
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", timed], cwd=folder,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    count = done.stderr.count("@@ ")
    expect(
        "every line of the block succeeds", done.returncode == 0 and count == len(lines),
        f"({done.returncode}) ended in: {lines[min(count, len(lines) - 1)]}\n{done.stderr[-1500:]}")
    print(re.sub(r"(?m)^(?!@@ ).*\n", "", done.stderr))
    results = folder / "results"
    left = {path.parent.name: summary(path)["status"] for path in results.glob("*/summary.json")}
    expect("and leaves finished results", left and set(left.values()) == {"finished"}, str(left))
    named = set(re.findall(r"results/(\w+)", "\n".join(lines)))
    expect("in every folder it names", named <= set(left), f"{named} {left}")
    study = summary(results / "s/summary.json").get("study") or []
    expect("all runs of the study are done",
           len(study) > 3 and all(row["status"] == "done" for row in study),
           str([row.get("reason") for row in study]))
    drawn = re.findall(r"plot_results\.py (\S+)", "\n".join(lines))
    expect("the pictures are there", drawn and all(
        (folder / name / "results.png").is_file() for name in drawn), str(drawn))
    compared = re.search(r"window 0 to (\S+) s .*?vibration error ([\d.e+-]+)",
                         " ".join(done.stdout.split()))
    expect("the comparison is that of a reduced and a full run of the same deck",
           compared is not None and float(compared.group(2)) < 0.05, str(compared))


def check_page(folder, page):
    """Checks the blocks of a tutorial. A mark in the output separates the commands before a block
    of text."""
    blocks = re.findall(r"^```(sh|text)\n(.*?)^```$", (PROJECT / page).read_text(encoding="utf-8"),
                        re.M | re.S)
    commands = [text for kind, text in blocks if kind == "sh"]
    reports = sorted(set(PICTURED.get(page, {}).values()))
    keep = "".join(f"[ ! -f {report} ] || cp {report} {report}.kept\n"
                   for report in reports)  # a later command deletes it if reports are off
    script = "".join(f"{text}{keep}echo '@@ {number}'\n" for number, text in enumerate(commands, 1))
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", script], cwd=folder,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    count = len(re.findall(r"^@@ \d+$", done.stdout, re.M))
    expect(
        "every command of the page succeeds", commands and done.returncode == 0
        and count == len(commands), f"({done.returncode}) ended in: "
        f"{commands[min(count, len(commands) - 1)] if commands else 'no block'}\n"
        f"{done.stdout[-1500:]}")
    ran, shown = 0, 0
    for kind, text in blocks:
        if kind == "sh":
            ran += 1
            continue
        printed = " ".join(re.split(r"^@@ \d+$", done.stdout,
                                    flags=re.M)[ran - 1].split()) if 0 < ran <= count else ""
        for line in text.splitlines():
            shown += 1
            expect(f"the commands print: {line.strip()}", " ".join(line.split()) in printed,
                   f"not in: {printed[:1500]}")
    expect("the page shows what they print", shown > 0)
    for picture, report in PICTURED.get(page, {}).items():
        compare(picture, (folder / f"{report}.kept").read_text(encoding="utf-8"))


def main():
    folder = pathlib.Path("project")
    if len(sys.argv) > 3:
        stage(folder, {})
        check_page(folder, sys.argv[3])
    else:
        stage(folder, SHORT)
        check_readme(folder)
    return finish()


if __name__ == "__main__":
    sys.exit(main())
