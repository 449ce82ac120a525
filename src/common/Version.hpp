// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Versions of the program and its libraries, for --version and for the provenance of results.
#pragma once

#include <string>

namespace tooljoint {

std::string programVersion();   ///< "0.1.0"
std::string gitHash();          ///< of the source of this build; "unknown" outside a git checkout
std::string trilinosVersion();  ///< "13.2.0"
std::string mpiVersion();       ///< first line of the version text of the MPI library
std::string hdf5Version();      ///< "1.10.8"
std::string sundialsVersion();  ///< "6.4.1"; "" if built without it
/// File of the BLAS in use with its folder, "openblas-serial/libblas.so.3"; "unknown" if not found.
std::string blasLibrary();

/// All of the above, one a line, as `tooljoint --version` prints it.
std::string versionText();

}  // namespace tooljoint
