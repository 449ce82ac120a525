// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Log of a run: plain lines on rank 0 only.
#pragma once

#include <string>
#include <vector>

namespace tooljoint::log {

/// Suppresses info() lines; warnings are still printed and collected.
void setQuiet(bool quiet);
bool quiet();

/// One line on standard output, rank 0 only. Not collective: any rank may call it, only rank 0
/// prints.
void info(const std::string& line);

/// "warning: line" on standard error, rank 0 only. Collected on every rank that calls it, for the
/// summary; a repeated sentence is neither printed nor collected again.
void warn(const std::string& line);

/// The distinct warnings of this rank so far, in the order of their appearance.
const std::vector<std::string>& warnings();
void clearWarnings();

/// Receives every warning during its lifetime, also those that are not printed again. Not nested.
class Hearing {
 public:
  Hearing();
  ~Hearing();
  Hearing(const Hearing&) = delete;
  Hearing& operator=(const Hearing&) = delete;
  const std::vector<std::string>& lines() const { return lines_; }

 private:
  std::vector<std::string> lines_;
};

}  // namespace tooljoint::log
