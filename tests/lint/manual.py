#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares docs/parameters.md with the output of `tooljoint doc`; --update writes the file
instead."""
import difflib
import pathlib
import subprocess
import sys


def main():
    program, manual = sys.argv[1], pathlib.Path(sys.argv[2])
    printed = subprocess.run([program, "doc"], stdout=subprocess.PIPE, text=True, check=True).stdout
    if "--update" in sys.argv:
        manual.parent.mkdir(parents=True, exist_ok=True)
        manual.write_text(printed, encoding="utf-8")
        return 0
    written = manual.read_text(encoding="utf-8")
    sys.stdout.writelines(
        difflib.unified_diff(written.splitlines(True), printed.splitlines(True), str(manual),
                             "tooljoint doc"))
    if written != printed or not printed.strip():
        print(f"{manual.name} is not what the program prints; `cmake --build BUILD --target "
              "update-docs` writes it.")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
