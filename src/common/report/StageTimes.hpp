// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How long the stages of a computation take on this rank.
#pragma once

#include <chrono>
#include <string>

namespace tooljoint {

/// Wall-clock time from its construction to its destruction counts for the stage `name`, but for
/// the stages inside it, which count for themselves.
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
  double inside_ = 0;  ///< seconds of inner stages
};

/// "constraint modes 3.2 s, factorisation 1.1 s, ...", longest first, stages below `least` seconds
/// left out; empty when none is left.
std::string stageTimes(double least = 0.05);

/// The line "times" of the log; none where no stage took as long.
void logStageTimes();

}  // namespace tooljoint
