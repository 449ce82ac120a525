// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Runs one case of a study and times its parts.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cases/Case.hpp"
#include "cases/ReducedCase.hpp"
#include "estimate/ModeComparison.hpp"
#include "study/RowStore.hpp"
#include "transient/Transient.hpp"

namespace tooljoint::study {

/// The model of a run, full or reduced, before its motion. Times are CPU seconds of all threads,
/// summed over the ranks, and wall seconds.
struct PreparedModel {
  std::shared_ptr<const cases::RestingCase> rest;
  coupling::Coupling full;       ///< of a full run
  cases::ReducedCase reduction;  ///< of a reduced one
  bool reduced = false;
  std::string basis;
  long modes = 0;
  double setupCpu = 0.0, setupWall = 0.0;  ///< reduction and coupling
  ModeErrors modeErrors;                   ///< the cost of this comparison is in no time
  std::string notCompared;                 ///< why requested `modeErrors` are missing

  const model::SecondOrderModel& model() const { return reduced ? reduction.model() : full.model; }
};

struct ExecutionOptions {
  std::string title;                      ///< of the progress bar; empty: none
  bool record = true;                     ///< keep the motion
  double perturbation = 0.0;              ///< size of the change of the initial displacements [m]
  std::optional<double> timeLimit;        ///< CPU time after which the run is given up [s]
  transient::SampleSink* sink = nullptr;  ///< also receives the motion, if not null
};

/// Results of one motion. Times as above, without the recovery of the recorded motion, which is the
/// same for every method.
struct Execution {
  transient::TransientReport report;
  RecordedHistory history;
  double cpu = 0.0, wall = 0.0;            ///< of the motion, without recording it
  double setupCpu = 0.0, setupWall = 0.0;  ///< of the conversion to kernel form
  long missedNodes = 0;
  double maxPenetration = 0.0;
  std::optional<double> estimatedVibration;  ///< if Reduction/Error Estimate includes the
                                             ///< transient; its time is not in `cpu` and `wall`
};

/// A run that exceeded its time limit.
struct TimeLimitError : ConvergenceError {
  using ConvergenceError::ConvergenceError;
};

/// All calls are collective.
class StudyRunner {
 public:
  /// Computes the state at rest, and reduces the case if its deck requests it. With `frequencies`
  /// above 0 as many coupled modes of a reduced model are compared with those of the full one,
  /// which are computed once for all runs with the same full model. Throws the errors of the
  /// stages.
  PreparedModel prepare(const cases::Case& scene, int frequencies);

  /// Integrates its motion. Throws the errors of transient::integrate, InterruptedError, and
  /// TimeLimitError.
  Execution move(const cases::Case& scene, const PreparedModel& prepared,
                 const ExecutionOptions& options) const;

  /// Predicted CPU time of the motion of the case [s], from its first samples; none if these fail.
  /// The rest may cost more, for example after the start of contact.
  std::optional<double> predictedCpu(const cases::Case& scene, const PreparedModel& prepared) const;

 private:
  struct FullModes {
    coupling::Coupling whole;
    linalg::EigenPairs modes;
  };
  ModeErrors compare(const cases::Case& scene, const PreparedModel& prepared, int frequencies);
  std::map<std::string, FullModes> fullModes_;
};

}  // namespace tooljoint::study
