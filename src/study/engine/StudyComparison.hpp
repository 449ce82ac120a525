// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// From what a run gave to its row: costs, counts, curves, and errors against the reference.
#pragma once

#include <optional>
#include <vector>

#include "study/Metrics.hpp"
#include "study/Row.hpp"
#include "study/RowStore.hpp"
#include "study/engine/StudyPlan.hpp"
#include "study/engine/StudyRunner.hpp"

namespace tooljoint::study {

/// Knows the motion of the reference. On rank 0 only, which alone keeps motions.
class StudyComparison {
 public:
  explicit StudyComparison(const StudyPlan& plan) : plan_(plan) {}

  /// The motion to compare with, of a case at rest. ConvergenceError when it does not move within
  /// the window: vibration error divides by that motion.
  void setReference(const cases::RestingCase& resting, RecordedHistory history);
  const RecordedHistory& reference() const { return *reference_; }

  /// Everything a first run says goes into its row, the plan of which stays.
  void book(const StudyRun& run, const PreparedModel& prepared, const Execution& execution,
            StudyRow& row) const;

 private:
  Window window() const { return {plan_.start, plan_.windowEnd}; }
  MotionStatistics statisticsOf(const RecordedHistory& history) const;
  void curves(StudyRow& row, const RecordedHistory& history) const;
  void compare(StudyRow& row, const RecordedHistory& history) const;

  const StudyPlan& plan_;
  std::optional<RecordedHistory> reference_;
  std::vector<double> rest_;       ///< measured displacements at rest, nodes x components
  std::vector<double> clearance_;  ///< per node
  std::optional<MotionStatistics> statistics_;
};

/// The row as it was planned, with nothing known.
void forget(StudyRow& row);

/// What is known of a run before it moves.
void bookModel(const PreparedModel& prepared, StudyRow& row);

}  // namespace tooljoint::study
