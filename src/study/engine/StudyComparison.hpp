// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Fills the row of a run from its results: costs, counts, curves, and errors against the
/// reference.
#pragma once

#include <optional>
#include <vector>

#include "study/Metrics.hpp"
#include "study/Row.hpp"
#include "study/RowStore.hpp"
#include "study/engine/StudyPlan.hpp"
#include "study/engine/StudyRunner.hpp"

namespace tooljoint::study {

/// Holds the motion of the reference. On rank 0 only, the only rank with motions.
class StudyComparison {
 public:
  explicit StudyComparison(const StudyPlan& plan) : plan_(plan) {}

  /// Sets the reference motion of a case at rest. ConvergenceError if it does not move within the
  /// window, since the vibration error divides by that motion.
  void setReference(const cases::RestingCase& resting, RecordedHistory history);
  const RecordedHistory& reference() const { return *reference_; }

  /// Writes all results of a first run into its row; the plan of the row remains.
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

/// Resets the row to its plan.
void forget(StudyRow& row);

/// Writes the results of a run that are known before its motion.
void bookModel(const PreparedModel& prepared, StudyRow& row);

}  // namespace tooljoint::study
