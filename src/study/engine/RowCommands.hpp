// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The commands of a plan: one for each row, for a scheduler.
#pragma once

#include <string>

#include "cases/Case.hpp"

namespace tooljoint::study {

/// Common data of all rows of a plan.
struct RowCommand {
  std::string program;  ///< file of the program that runs them
  std::string command;  ///< "study", "map"
  std::string folder;   ///< of the rows
  int ranksPerRow = 0;
  std::string options;  ///< further options, with a leading blank
};

/// "[mpiexec -n K] PROGRAM COMMAND DECK ... --output FOLDER --row "; the number of a row is
/// appended.
std::string rowCommand(const cases::Case& one, const RowCommand& what);

/// Makes the folder and writes a file in it on rank 0. Collective. FileError.
void writePlan(const std::string& folder, const std::string& name, const std::string& text);

}  // namespace tooljoint::study
