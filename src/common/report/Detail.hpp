// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Lines that are printed only with --verbose.
#pragma once

#include <string>

namespace tooljoint::log {

/// Print detail() lines; off at the start of the program.
void setVerbose(bool verbose);
bool verbose();

/// info() if verbose() and not quiet().
void detail(const std::string& line);

}  // namespace tooljoint::log
