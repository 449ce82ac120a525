// SPDX-License-Identifier: BSD-3-Clause
#include "common/Version.hpp"

#include <Trilinos_version.h>
#include <array>
#include <dlfcn.h>
#include <filesystem>
#include <hdf5.h>
#include <mpi.h>
#include <system_error>

#include "common/Text.hpp"

// The build defines them only for this file.
#ifndef TOOLJOINT_VERSION
#define TOOLJOINT_VERSION "0.1.0"
#endif
#ifndef TOOLJOINT_SUNDIALS
#define TOOLJOINT_SUNDIALS ""
#endif
#ifndef TOOLJOINT_GIT_HASH
#define TOOLJOINT_GIT_HASH "unknown"
#endif

namespace tooljoint {

std::string programVersion() { return TOOLJOINT_VERSION; }

std::string gitHash() { return TOOLJOINT_GIT_HASH; }

std::string trilinosVersion() {
  // TRILINOS_MAJOR_MINOR_VERSION is xxyyzz, read as one decimal number.
  const int number = TRILINOS_MAJOR_MINOR_VERSION;
  return std::to_string(number / 10000) + "." + std::to_string(number / 100 % 100) + "." +
         std::to_string(number % 100);
}

std::string mpiVersion() {
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  const std::string whole(text.data(), static_cast<std::size_t>(length));
  // Open MPI: "Open MPI v4.1.4, package: ..., ident: ..."; other libraries give several lines.
  return trim(whole.substr(0, whole.find_first_of(",\n")));
}

std::string hdf5Version() {
  return std::to_string(H5_VERS_MAJOR) + "." + std::to_string(H5_VERS_MINOR) + "." +
         std::to_string(H5_VERS_RELEASE);
}

std::string sundialsVersion() { return TOOLJOINT_SUNDIALS; }

std::string blasLibrary() {
  Dl_info found{};
  void* product = dlsym(RTLD_DEFAULT, "dgemm_");
  if (product == nullptr || dladdr(product, &found) == 0 || found.dli_fname == nullptr)
    return "unknown";
  std::error_code ignored;
  const auto file = std::filesystem::canonical(found.dli_fname, ignored);
  return (file.parent_path().filename() / file.filename()).string();
}

std::string versionText() {
  return "tooljoint " + programVersion() + " (git " + gitHash() + ")\nTrilinos  " +
         trilinosVersion() + "\nMPI       " + mpiVersion() + "\nHDF5      " + hdf5Version() +
         (sundialsVersion().empty() ? "" : "\nSUNDIALS  " + sundialsVersion()) + "\nBLAS      " +
         blasLibrary() + "\n";
}

}  // namespace tooljoint
