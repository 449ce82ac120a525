# SPDX-License-Identifier: BSD-3-Clause
"""Errors a user can correct: the message states the value found, the expected value and the remedy.

An interrupt (Ctrl-C, or SIGTERM, which mpirun sends instead) ends a long call with
KeyboardInterrupt.
"""

not_finite: dict[str, str] = {}  # point law in Python whose last forces were not finite -> message


class Error(Exception):
    """Any error of the toolkit. `code` is the exit code of the program `tooljoint` for it."""

    code = 70


class UsageError(Error):
    """An invalid call (exit code 1)."""

    code = 1


class DeckError(Error):
    """An invalid deck or parameter, or a file named in a deck that is missing or malformed (exit
    code 2)."""

    code = 2


class ModelError(Error):
    """No model can be built: a floating part, a singular matrix, matrices that do not fit (exit
    code 3)."""

    code = 3


class ConvergenceError(Error):
    """A solver did not converge; the message states the attempts and the remedy (exit code 4).
    Point laws whose forces are not finite are named first."""

    code = 4

    def __init__(self, sentence: str = ""):
        laws = [*not_finite.values()]
        not_finite.clear()
        super().__init__(" ".join([*laws, sentence]))


class FileError(Error):
    """A file is missing, a folder cannot be written, the disk is full (exit code 5)."""

    code = 5
