// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a command line is told that holds words or options no command takes.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tooljoint::app {

/// A sentence with what was probably meant and what there is. \param unknown at least one word
std::string describeUnknown(const CLI::App& program, const std::vector<std::string>& unknown);

}  // namespace tooljoint::app
