// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The commands of a plan: one for each row, for a scheduler.
#pragma once

#include <string>

#include "cases/Case.hpp"

namespace tooljoint::study {

/// What all rows of a plan have in common.
struct RowCommand {
  std::string program;  ///< file that is to run them
  std::string command;  ///< "study", "map"
  std::string folder;   ///< of the rows
  int ranksPerRow = 0;
  std::string options;  ///< further words, with a blank in front
};

/// "[mpiexec -n K] PROGRAM COMMAND DECK ... --output FOLDER --row ": the number of a row is to
/// follow.
std::string rowCommand(const cases::Case& one, const RowCommand& what);

/// Rank 0 makes the folder and writes a file in it. Collective. FileError.
void writePlan(const std::string& folder, const std::string& name, const std::string& text);

}  // namespace tooljoint::study
