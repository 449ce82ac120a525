# SPDX-License-Identifier: BSD-3-Clause
"""Results of a study in its folder, and its messages on earlier results."""
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
    """Number of earlier runs reported by a study."""
    match = re.search(r"(\d+) of (\d+) runs are known", done.stdout)
    return int(match.group(1)) if match else 0
