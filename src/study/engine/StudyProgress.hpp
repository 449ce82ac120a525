// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a study says while it runs: which run is done, what it gave, how long the rest will take.
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
  /// \param groups of ranks that work at a time
  StudyProgress(const StudyPlan& plan, int groups)
      : plan_(plan), groups_(groups), wall_(plan.runs.size(), 0.0) {}

  /// "run 3 of 40  label: what it gave; about 2 min left", once for every finished run of a method.
  /// \param timed repeats done of each run, -1 for one that failed \param wall seconds this one
  /// took
  void report(std::size_t run, const StudyRow& row, const std::vector<int>& timed, double wall);

 private:
  const StudyPlan& plan_;
  int groups_;
  std::vector<double> wall_;  ///< last time of each run [s]; 0: not seen yet
  double spent_ = 0.0;
  double executed_ = 0.0;
};

}  // namespace tooljoint::study
