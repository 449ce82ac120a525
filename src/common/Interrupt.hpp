// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// SIGINT, SIGTERM and SIGHUP set a flag that loops check in each step, so that an interrupted run
/// closes its files. (Open MPI turns Ctrl-C into SIGTERM, and SIGKILL a second later: the reaction
/// must take less than half a second.)
#pragma once

namespace tooljoint {

/// Installs handlers for these signals, except for an ignored SIGHUP (nohup); call it after
/// MPI_Init. A second SIGINT, or a SIGTERM more than a second after the first signal, ends the
/// program at once, since a solver may not check the flag for minutes. A file that exceeds the
/// limit of the process (SIGXFSZ) is a write error, like a full disk.
void installInterruptHandlers();

/// True after a signal. Local to this rank.
bool interruptRequested();

/// Throws InterruptedError after a signal, for long loops without results to keep. All ranks end
/// with it, as with any error of a single rank (Parallel.hpp).
void stopIfInterrupted();

/// Sets or clears the flag like a signal (for tests and embedding programs).
void requestInterrupt(bool requested = true);

}  // namespace tooljoint
