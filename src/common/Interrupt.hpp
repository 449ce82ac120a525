// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// SIGINT, SIGTERM and SIGHUP set a flag that loops read each step, so that an interrupted run
/// closes its files. (Open MPI turns Ctrl-C into SIGTERM, and SIGKILL a second later: react within
/// half a second.)
#pragma once

namespace tooljoint {

/// Install handlers for these, but not for a SIGHUP that is ignored (nohup); call it after
/// MPI_Init. A second SIGINT, or a SIGTERM more than a second after the first signal, ends the
/// program at once: a solver between two looks at the flag may take minutes. A file that outgrows
/// the limit of the process (SIGXFSZ) is an error of the write, like a full disk.
void installInterruptHandlers();

/// True once a signal has come. Local to this rank.
bool interruptRequested();

/// InterruptedError once a signal has come. For long loops that have nothing to keep. Of several
/// ranks all end with it, as with any error that one of them meets alone (Parallel.hpp).
void stopIfInterrupted();

/// Set or clear the flag as a signal would (tests, embedding programs).
void requestInterrupt(bool requested = true);

}  // namespace tooljoint
