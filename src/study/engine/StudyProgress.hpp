// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Progress messages of a study: finished runs, their results, and the remaining time.
#pragma once

#include <string>
#include <vector>

#include "study/Row.hpp"
#include "study/engine/StudyPlan.hpp"

namespace tooljoint::study {

/// "40 s", "12 min" or "3.5 h".
std::string duration(double seconds);

class StudyProgress {
 public:
  /// \param groups  number of groups of ranks that work at the same time
  StudyProgress(const StudyPlan& plan, int groups)
      : plan_(plan), groups_(groups), wall_(plan.runs.size(), 0.0) {}

  /// "run 3 of 40  label: its result; about 2 min left", once for every finished run of a method.
  /// \param timed  repeats done of each run, -1 for a failed run
  /// \param wall   seconds of this run
  void report(std::size_t run, const StudyRow& row, const std::vector<int>& timed, double wall);

 private:
  const StudyPlan& plan_;
  int groups_;
  std::vector<double> wall_;  ///< last time of each run [s]; 0: not run yet
  double spent_ = 0.0;
  double executed_ = 0.0;
};

}  // namespace tooljoint::study
