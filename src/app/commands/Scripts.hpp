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

}  // namespace tooljoint::app
