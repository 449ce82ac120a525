// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The error of a command line with words or options that no command takes.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tooljoint::texts {

/// A sentence with what was probably meant and what there is. \param unknown at least one word
std::string describeUnknown(const CLI::App& program, const std::vector<std::string>& unknown);

}  // namespace tooljoint::texts
