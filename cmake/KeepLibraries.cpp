// SPDX-License-Identifier: BSD-3-Clause
// For builds with sanitizers: libraries stay loaded, so that a report of leaks at the end of a
// process names the library a block was allocated in, and suppressions by library apply. Open MPI
// unloads its components before.
extern "C" int dlclose(void* /*handle*/) noexcept { return 0; }
