// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Times of the stages of a computation on this rank.
#pragma once

#include <chrono>
#include <string>

namespace tooljoint {

/// Wall-clock time from its construction to its destruction counts for the stage `name`, without
/// the time of inner stages, which is counted separately.
class Stage {
 public:
  explicit Stage(std::string name);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

 private:
  std::string name_;
  Stage* outer_;
  std::chrono::steady_clock::time_point start_;
  double inside_ = 0;  ///< time of inner stages [s]
};

/// "constraint modes 3.2 s, factorisation 1.1 s, ...", longest first, without stages below `least`
/// seconds; empty if none is left.
std::string stageTimes(double least = 0.05);

/// Logs the line "times"; nothing if no stage took that long.
void logStageTimes();

}  // namespace tooljoint
