// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Runs one scene of a study and times its parts.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/Scene.hpp"
#include "app/Stages.hpp"
#include "study/RowStore.hpp"
#include "transient/Transient.hpp"

namespace tooljoint::app {

struct ExecutionOptions {
  std::string title;               ///< of the progress bar; empty: none
  bool record = true;              ///< keep the motion
  double perturbation = 0.0;       ///< size of the change of the initial displacements [m]
  std::optional<double> timeLimit; ///< CPU time after which the run is given up [s]
};

/// What one run gave. Times are CPU seconds of all threads, summed over the ranks, and wall seconds; the transient's are without the recovery of
/// the recorded motion, which is the same work for every method.
struct Execution {
  transient::TransientReport report;
  study::RecordedHistory history;
  double cpu = 0.0, wall = 0.0;
  double setupCpu = 0.0, setupWall = 0.0;
  std::string basis;
  long modes = 0;
  long missedNodes = 0;
  double maxPenetration = 0.0;
  std::optional<double> estimatedDyn;  ///< where Reduction/Error Estimate asks for that of the transient; its time is not in `cpu` and `wall`
};

/// A run that took more than its time.
struct TimeLimitError : ConvergenceError {
  using ConvergenceError::ConvergenceError;
};

/// Static states are computed once for all scenes that share them. All calls are collective.
class StudyRunner {
 public:
  /// Path and static state of the scene; those of an earlier scene when Substructures, Reduction and Transient alone differ.
  std::shared_ptr<const StaticStage> statics(const Scene& scene);

  /// Throws what the stages throw, InterruptedError, and ConvergenceError when the time limit is reached.
  Execution execute(const Scene& scene, const ExecutionOptions& options);

 private:
  std::map<std::string, std::shared_ptr<const StaticStage>> settled_;
};

}  // namespace tooljoint::app
