# SPDX-License-Identifier: BSD-3-Clause
"""Functions shared by the scripts that check the program: run it, print results, exit."""
import os
import re
import subprocess
import sys

FAULTS = []
TIME_FACTOR = float(os.environ.get("TOOLJOINT_TIME_FACTOR",
                                   "1"))  # programs with sanitizers take longer


def of_ranks(ranks):
    """Environment of a run. A single rank without mpiexec starts faster if Open MPI makes no daemon
    and no folders. Failed ranks have already met in MPI_Finalize, so mpiexec need not wait a second
    for them."""
    single = {"OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_orte_create_session_dirs": "0"}
    return {**os.environ, **(single if ranks == 1 else {"OMPI_MCA_odls_base_sigkill_timeout": "0"})}


COLUMNS = 100  # width of a printed line


def wide(text):
    """Lines wider than COLUMNS. A single word may be longer than a line, for example a path."""
    return [line for line in text.splitlines() if len(line) > COLUMNS and " " in line.strip()]


def unwrapped(text):
    """Warnings and errors with their wrapped lines joined."""
    return re.sub(r"\n {2,}(?=\S)", " ", text)


def tooljoint(*arguments, ranks=1, seconds=240):
    """Runs the program of the first argument of the script, on more ranks with the mpiexec of the
    second; its `stderr` is unwrapped()."""
    command = ([sys.argv[2], "-np", str(ranks)] if ranks > 1 else []) + [sys.argv[1], *arguments]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          check=False, timeout=seconds * TIME_FACTOR, env=of_ranks(ranks))
    # mpiexec mixes simultaneous output of ranks
    own = [
        line for line in wide(done.stderr if ranks == 1 else "")
        if line.startswith(("warning:", "tooljoint:", "  "))
    ]
    if own:
        expect(
            f"tooljoint {' '.join(map(str, arguments))}: warnings and errors have at most "
            f"{COLUMNS} columns", False, "\n".join(own))
    done.stderr = unwrapped(done.stderr)
    return done


def expect(what, condition, shown=""):
    """Records a fault if `condition` does not hold; `shown` is the value found."""
    print(f"{'ok    ' if condition else 'FAILED'} {what} {'' if condition else shown}", flush=True)
    if not condition:
        FAULTS.append(what)


def finish():
    """Lists the faults; the exit code of the script."""
    print(f"\n{len(FAULTS)} failed" + "".join("\n  " + fault for fault in FAULTS))
    return 1 if FAULTS else 0
