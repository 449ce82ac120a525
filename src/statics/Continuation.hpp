// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A sequence of Newton solves on one problem, each starting where the one before ended: load
/// steps, sharpened laws, friction in quarters.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "statics/NewtonSolver.hpp"

namespace tooljoint::statics {

/// One stage: `prepare` changes the problem (raises a load, sharpens a law), then it is solved with
/// `options`.
struct Stage {
  std::string name;
  std::function<void()> prepare;
  NewtonOptions options;
};

struct StageReport {
  std::string name;
  NewtonReport newton;
};

struct ContinuationReport {
  bool converged = false;
  std::vector<StageReport>
      stages;  ///< in the order they were run; the last one is the one that failed, if any
  int iterations() const;
  /// "stage "mu = 0.1": 50 Newton iterations were not enough ..." of the stage that failed, or how
  /// many stages converged.
  std::string message() const;
};

/// Runs the stages in order and stops at the first that does not converge; x is then its last
/// iterate.
ContinuationReport runStages(const model::NonlinearProblem& problem, Vector& x,
                             const std::vector<Stage>& stages,
                             const Teuchos::ParameterList* nox = nullptr,
                             const Teuchos::ParameterList* belos = nullptr);

struct RampOptions {
  NewtonOptions newton;
  int increments = 1;  ///< equal increments from 0 to 1 to begin with
  int maxHalvings =
      6;  ///< an increment that fails is halved so often; it grows back by two after two easy ones
};

/// Brings a parameter from 0 to 1: `set(s)` puts the problem at s, then it is solved from the last
/// converged x. An increment that does not converge is taken back and halved; the report names each
/// solve "s = ...".
ContinuationReport runRamp(const model::NonlinearProblem& problem, Vector& x,
                           const std::function<void(double)>& set, const RampOptions& options,
                           const Teuchos::ParameterList* nox = nullptr,
                           const Teuchos::ParameterList* belos = nullptr);

/// Throws ConvergenceError "<what> did not converge: <message> <advice>" unless all stages
/// converged.
void requireConverged(const ContinuationReport& report, const std::string& what,
                      const std::string& advice);

}  // namespace tooljoint::statics
