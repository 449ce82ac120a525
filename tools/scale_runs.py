# SPDX-License-Identifier: BSD-3-Clause
"""Runs whose time and memory are in docs/scale.md, and chapters of that page."""
import json
import os
import pathlib
import platform
import re
import time

import scale_figures

PROJECT = pathlib.Path(__file__).resolve().parent.parent
FULL = ["--without", "Reduction", "--without", "Substructures"]


def chapter(options, title, text, figure="", note=""):
    """A chapter with a line on its machine; `text` ends with a table."""
    shown = f"![{scale_figures.NAMES[figure]}](figures/{figure}.svg)\n\n" if figure else ""
    own = f"{options.machine}{' ' if note else ''}{note}"
    return f"## {title}\n\n{own}\n\n{shown}{text}"


def measured(options, name, words, ranks=1):
    """{code, wall_s, cpu_s, memory_mb, output} of a run of the program, from the work folder if it
    is there."""
    folder = pathlib.Path(options.work) / name
    record = folder / "row.json"
    if record.exists():
        return json.loads(record.read_text(encoding="utf-8"))
    folder.mkdir(parents=True, exist_ok=True)
    command = [options.program, *words]
    if ranks > 1:
        command = [options.mpiexec, "-n", str(ranks), *command]
    log = folder / "log.txt"
    begin = time.monotonic()
    child = os.fork()
    if child == 0:
        with open(log, "w", encoding="utf-8") as text:
            os.dup2(text.fileno(), 1)
            os.dup2(text.fileno(), 2)
        os.chdir(folder)
        os.execvp(command[0], command)
    _, status, usage = os.wait4(child, 0)
    row = {
        "code": os.waitstatus_to_exitcode(status), "wall_s": time.monotonic() - begin,
        "cpu_s": usage.ru_utime + usage.ru_stime, "memory_mb": usage.ru_maxrss / 1024,
        "output": log.read_text(encoding="utf-8")
    }
    record.write_text(json.dumps(row), encoding="utf-8")
    return row


def seconds(x):
    return f"{x:.3g}" if x < 1000 else f"{x:.0f}"


def table(head, lines):
    return "\n".join(["| " + " | ".join(head) + " |", "|" + "---|" * len(head)] +
                     ["| " + " | ".join(map(str, line)) + " |" for line in lines]) + "\n"


def times(row):
    if row["code"] != 0:
        last = [line for line in row["output"].splitlines() if line.strip()]
        return f"exit code {row['code']}: {last[-1] if last else ''}", "", ""
    return seconds(row["wall_s"]), seconds(row["cpu_s"]), f"{row['memory_mb']:.0f}"


def machine():
    text = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8")
    name = re.search(r"model name\s*: (.*)", text)
    return name.group(1) if name else platform.machine()


def machine_line(options):
    blas = re.search(r"BLAS +(\S+)", os.popen(f"{options.program} --version").read())
    return (f"Machine: {machine()}, {os.cpu_count()} cores; "
            f"{blas.group(1) if blas else 'BLAS unknown'}.")
