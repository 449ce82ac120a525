// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Manual pages and completions of shells, written from the command line that parses them.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace tooljoint::texts {

/// Formats of `tooljoint doc` that describe the command line.
inline bool isPageFormat(const std::string& format) {
  return format == "man" || format == "bash" || format == "zsh";
}

/// "man": the page tooljoint(1), or that of one command; "bash", "zsh": the completion function.
/// UsageError: no such command, or a command beside a shell.
std::string page(const CLI::App& program, const std::string& command, const std::string& format);

}  // namespace tooljoint::texts
