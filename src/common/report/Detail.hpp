// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What only somebody asks for who wants to know more: lines of --verbose.
#pragma once

#include <string>

namespace tooljoint::log {

/// Print detail() lines; off at the start of the program.
void setVerbose(bool verbose);
bool verbose();

/// info() where verbose() and not quiet().
void detail(const std::string& line);

}  // namespace tooljoint::log
