// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// From what a run gave to its row: costs, counts, curves, and errors against the reference.
#pragma once

#include <optional>
#include <vector>

#include "app/StudyPlan.hpp"
#include "app/StudyRunner.hpp"
#include "study/Metrics.hpp"
#include "study/Row.hpp"
#include "study/RowStore.hpp"

namespace tooljoint::app {

/// Knows the motion of the reference. On rank 0 only, which alone keeps motions.
class StudyComparison {
 public:
  explicit StudyComparison(const StudyPlan& plan) : plan_(plan) {}

  /// The motion to compare with. `scene` is settled. ConvergenceError when it does not move within
  /// the window: dyn divides by that motion.
  void setReference(const StudyScene& scene, study::RecordedHistory history);
  const study::RecordedHistory& reference() const { return *reference_; }

  /// Everything a first run says goes into its row, the plan of which stays.
  void book(const StudyRun& run, const PreparedModel& prepared, const Execution& execution,
            study::StudyRow& row) const;

 private:
  study::Window window() const { return {plan_.start, plan_.windowEnd}; }
  study::MotionStatistics statisticsOf(const study::RecordedHistory& history) const;
  void curves(study::StudyRow& row, const study::RecordedHistory& history) const;
  void compare(study::StudyRow& row, const study::RecordedHistory& history) const;

  const StudyPlan& plan_;
  std::optional<study::RecordedHistory> reference_;
  std::vector<double> rest_;       ///< measured displacements at rest, nodes x components
  std::vector<double> clearance_;  ///< per node
  std::optional<study::MotionStatistics> statistics_;
};

/// The row as it was planned, with nothing known.
void forget(study::StudyRow& row);

/// What is known of a run before it moves.
void bookModel(const PreparedModel& prepared, study::StudyRow& row);

}  // namespace tooljoint::app
