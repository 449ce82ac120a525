// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Commands that a Python script beside the program does.
#pragma once

#include <string>
#include <vector>

namespace tooljoint::app {

/// Runs a script with arguments on rank 0. `what` begins the sentence of a failure: "The report was
/// not written". UsageError and FileError as the script ends; FileError when it cannot be started.
/// Collective.
void runScript(const std::string& name, const std::string& what,
               const std::vector<std::string>& arguments);

/// `tooljoint paraview`: options of the command line, as texts; empty: the default of the script.
struct ParaviewOptions {
  std::string folder;    ///< of a run
  std::string output;    ///< folder of the files
  std::string magnify;   ///< factor of the displacements
  std::string pictures;  ///< of the motion, at most
};

/// Writes what a run left for ParaView: polydata files and their times. Errors as runScript().
void paraview(const ParaviewOptions& options);

}  // namespace tooljoint::app
