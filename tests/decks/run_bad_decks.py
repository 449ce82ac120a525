#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs every bad deck of a folder through `tooljoint check` and compares exit code and message.

The first XML comment of a deck gives the expected message:

    <!-- expect(2): deck.xml:7: /Scene/Contact/Stiffnes is not a parameter.
         expect(2): Did you mean "Stiffness"?
         set: Contact/Stiffness=1e6
         args: \\-\\-quiet -->

Each `expect(code):` line is text that stderr must contain (runs of blanks count as one); all codes
must be equal. `set: PATH=VALUE` adds `--set PATH=VALUE`; `args:` adds words as a shell would split
them, where `\\-\\-` stands for the two hyphens XML forbids in a comment. A deck that cannot hold a
comment (empty, no XML at all) has the same lines in a file NAME.xml.expect beside it. Only *.xml
directly in the folder are decks; files that they name may be in subfolders.
"""
import argparse
import concurrent.futures
import os
import pathlib
import re
import shlex
import subprocess
import sys


def read_expectations(deck):
    """(exit code, sentences, further arguments) of a deck; raises ValueError with a sentence."""
    aside = deck.with_name(deck.name + ".expect")
    if aside.exists():
        text = aside.read_text(encoding="utf-8")
    else:
        comment = re.search(r"<!--(.*?)-->", deck.read_text(encoding="utf-8", errors="replace"),
                            re.S)
        text = comment.group(1) if comment else ""
    codes, sentences, arguments = set(), [], []
    for line in (one.strip() for one in text.splitlines()):
        if match := re.fullmatch(r"expect\((\d+)\):\s*(\S.*)", line):
            codes.add(int(match.group(1)))
            sentences.append(match.group(2))
        elif match := re.fullmatch(r"set:\s*(\S.*)", line):
            arguments += ["--set", match.group(1)]
        elif match := re.fullmatch(r"args:\s*(\S.*)", line):
            arguments += shlex.split(match.group(1))
        elif re.match(r"(expect|set|args)\b.*:", line):
            raise ValueError(f"cannot read the line \"{line}\"")
    if len(codes) != 1:
        raise ValueError("has no line `expect(CODE): sentence`"
                         if not codes else f"expects several exit codes {sorted(codes)}")
    if codes == {0}:
        raise ValueError("expects exit code 0, so it is not a bad deck")
    return codes.pop(), sentences, arguments


def squeeze(text):
    return re.sub(r"\s+", " ", text).strip()


def check(program, deck):
    """Complaints about one deck; empty if it behaves as expected."""
    try:
        code, sentences, arguments = read_expectations(deck)
    except ValueError as problem:
        return [str(problem)]
    try:
        run = subprocess.run([program, "check", str(deck), *arguments], capture_output=True,
                             text=True, errors="replace",
                             timeout=60 * float(os.environ.get("TOOLJOINT_TIME_FACTOR", "1")))
    except subprocess.TimeoutExpired:
        return ["did not end within 60 s"]
    complaints = []
    if run.returncode != code:
        complaints.append(f"exit code {run.returncode}, expected {code}")
    seen = squeeze(run.stderr)
    complaints += [
        f"stderr does not say: {sentence}" for sentence in sentences
        if squeeze(sentence) not in seen
    ]
    if complaints:
        complaints.append("stderr was:\n" + (run.stderr.rstrip() or "(empty)"))
    return complaints


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="the tooljoint program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--at-least", type=int, default=1,
                        help="fail if the folder has fewer decks")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()

    decks = sorted(options.folder.glob("*.xml"))
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        outcomes = list(pool.map(lambda deck: check(options.program, deck), decks))
    width = max((len(deck.name) for deck in decks), default=0)
    failed = 0
    for deck, complaints in zip(decks, outcomes):
        print(f"{deck.name:<{width}}  {'FAILED' if complaints else 'ok'}")
        failed += bool(complaints)
        for complaint in complaints:
            print("    " + complaint.replace("\n", "\n      "))
    print(f"\n{len(decks)} bad decks, {failed} not answered as they should.")
    if len(decks) < options.at_least:
        print(f"At least {options.at_least} bad decks are expected in {options.folder}.")
        return 1
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
