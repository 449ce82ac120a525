// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How a room that states nonlinear problems asks for them to be solved without knowing the solver: the program binds
/// this callback to the NOX driver of src/statics, a test may bind it to anything.
#pragma once

#include <functional>
#include <string>

#include "model/NonlinearProblem.hpp"

namespace tooljoint::model {

/// What is asked of a solver. The iteration has converged when |scale .* r| <= tolerance, or, if updateTolerance > 0,
/// when |dx| <= updateTolerance |x| for the full Newton step dx.
struct SolveRequest {
  std::string what;              ///< for messages: "the static equilibrium, lambda = 1e4 1/m"
  double tolerance = 1e-9;       ///< on the scaled residual norm
  double updateTolerance = 0.0;  ///< relative, 0: off
  int maxIterations = 50;
  bool backtracking = true;      ///< false: full Newton steps (stepLimit() of the problem still holds)
};

struct SolveOutcome {
  bool converged = false;
  int iterations = 0;
  double residual = 0.0;  ///< |scale .* r| at the end
  double update = 0.0;    ///< |dx|/|x| of the last step
  std::string message;    ///< what went wrong, when it did
};

/// Solves problem(x) = 0 from the start x, overwriting x; never throws for mere non-convergence.
using NonlinearSolver = std::function<SolveOutcome(const NonlinearProblem& problem, Vector& x, const SolveRequest& request)>;

}  // namespace tooljoint::model
