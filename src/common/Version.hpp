// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Versions of the program and of what it stands on, for --version and for the provenance of
/// results.
#pragma once

#include <string>

namespace tooljoint {

std::string programVersion();  ///< "0.1.0"
std::string gitHash();  ///< of the source this was built from; "unknown" outside a git checkout
std::string trilinosVersion();  ///< "13.2.0"
std::string mpiVersion();       ///< first line of the MPI library's own version text
std::string hdf5Version();      ///< "1.10.8"
std::string sundialsVersion();  ///< "6.4.1"; "" where the program is built without it
/// File of the BLAS in use with its folder, "openblas-serial/libblas.so.3"; "unknown" without one.
std::string blasLibrary();

/// All of the above, one a line, as `tooljoint --version` prints it.
std::string versionText();

}  // namespace tooljoint
