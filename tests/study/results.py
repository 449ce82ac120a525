# SPDX-License-Identifier: BSD-3-Clause
"""What a study leaves in its folder, and says of what it found there."""
import csv
import json
import pathlib
import re


def summary(folder):
    return json.loads(pathlib.Path(folder, "summary.json").read_text(encoding="utf-8"))


def rows(folder):
    return {row["label"]: row for row in summary(folder)["study"]}


def table(folder):
    with open(pathlib.Path(folder, "study.csv"), newline="", encoding="utf-8") as text:
        return {row["label"]: row for row in csv.DictReader(text)}


def known(done):
    """How many runs a study says it has from before."""
    match = re.search(r"(\d+) of (\d+) runs are known", done.stdout)
    return int(match.group(1)) if match else 0
