# SPDX-License-Identifier: BSD-3-Clause
"""Reads and writes files, and makes the messages for failures."""
import contextlib
import csv
import errno
import io
import math
import os
import sys

USAGE, FILES = 1, 5  # exit codes of the program and its tools
AGAIN = "Run the deck again, or restore the file from a copy."
DAMAGE = (OSError, RuntimeError, LookupError, ArithmeticError, AttributeError, TypeError,
          ValueError, csv.Error)  # errors raised by a damaged file during reading and drawing
REASONS = {
    errno.ENOSPC: "the disk is full", errno.EDQUOT: "the quota of the disk is used up",
    errno.EFBIG: "the file would be larger than the limit of the process (ulimit -f)"
}


class Unreadable(Exception):
    """Data are missing or damaged."""


class Unwritable(Exception):
    """A file could not be written; the message gives the reason."""


def fail(sentence, code=FILES):
    print(sentence, file=sys.stderr)
    sys.exit(code)


@contextlib.contextmanager
def failing():
    """Ends with a message if a file cannot be read or written."""
    try:
        yield
    except (Unreadable, Unwritable) as fault:
        fail(fault)


def reason(error):
    """Reason of an OSError in words; empty if the system gives none."""
    return REASONS.get(error.errno) or (os.strerror(error.errno) if error.errno else "")


def unreadable(path, why):
    return Unreadable(f"{path} cannot be read: {why}. {AGAIN}")


@contextlib.contextmanager
def reading(path):
    """Turns errors inside the block into Unreadable with the name of this file."""
    try:
        yield
    except DAMAGE as error:
        why = reason(error) if isinstance(error, OSError) else ""
        raise unreadable(
            getattr(error, "filename", None) or path, why
            or "it is damaged, or not what this program writes") from error


@contextlib.contextmanager
def writing(path):
    """Turns errors inside the block into Unwritable with the name of this file or folder."""
    try:
        yield
    except OSError as error:
        raise Unwritable(
            f"{path} cannot be written: {reason(error) or error}. Make room or name another folder."
        ) from error


def write(path, text):
    """Writes a file completely or leaves the old one. Unwritable."""
    part = path.with_name(path.name + ".part")
    with writing(path):
        try:
            part.write_text(text, encoding="utf-8")
            os.replace(part, path)
        except BaseException:
            with contextlib.suppress(OSError):
                part.unlink()
            raise


def read_rows(path):
    """Rows of a CSV file as lists of texts, the header first. Unreadable if a row is cut off or has
    another number of cells."""
    with reading(path):
        text = path.read_bytes().decode("utf-8")
        rows = list(csv.reader(io.StringIO(text, newline="")))
    if not rows:
        raise unreadable(path, "it is empty")
    if "\0" in text:
        raise unreadable(path, "it holds bytes of zero")
    for number, row in enumerate(rows[1:], 2):
        if len(row) != len(rows[0]):
            raise unreadable(path,
                             f"row {number} has {len(row)} cells, the header has {len(rows[0])}")
    if not text.endswith("\n"):
        raise unreadable(path, "its last row is cut off")
    return rows


class Row(dict):
    """A row of a table by column name: numbers, or texts for cells that are not numbers."""
    def __init__(self, cells, path):
        super().__init__(cells)
        self.path = path

    def __missing__(self, name):
        raise unreadable(self.path, f"it has no column \"{name}\"")


def read_table(path, *needed):
    """A Row for each row of a CSV file; names without their units. Unreadable if a column with a
    unit contains text, or if one of the columns `needed` is missing."""
    def value(text, title, number):
        try:
            return float(text)
        except ValueError:
            if text and title.endswith("]"):
                raise unreadable(
                    path,
                    f"row {number} has \"{text}\" in the column \"{title}\", expected is a number"
                ) from None
            return text

    titles, *rows = read_rows(path)
    found = [
        Row({title.split(" [")[0]: value(text, title, number)
             for title, text in zip(titles, row)}, path) for number, row in enumerate(rows, 2)
    ]
    for name in needed:
        numbers(found, name)
    return found


def numbers(rows, name):
    """A column of a table; nan for empty cells. Unreadable if it contains text."""
    for row in rows:
        if row[name] and not isinstance(row[name], float):
            raise unreadable(row.path,
                             f"the column \"{name}\" has \"{row[name]}\", expected is a number")
    return [math.nan if row[name] == "" else row[name] for row in rows]
