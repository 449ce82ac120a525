// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How a room that states nonlinear problems has them solved without knowing the solver:
/// the program binds this callback to the NOX driver of src/statics, a test may bind it to
/// anything.
#pragma once

#include <functional>
#include <string>

#include "model/NonlinearProblem.hpp"

namespace tooljoint::model {

/// What decides how much of a Newton step is taken, of at most what stepLimit() of the problem
/// allows.
enum class LineSearch {
  None,      ///< nothing else
  Residual,  ///< halved until the scaled residual decreases
  Work  ///< as far as the forces do work along it: right where they have a potential, however sharp
};

/// A request to a solver. The iteration has converged when max_i |scale_i r_i| <= tolerance
/// and, if updateTolerance > 0, the full Newton step dx has become |dx| <= updateTolerance |x|.
struct SolveRequest {
  std::string what;              ///< for messages: "the static equilibrium, lambda = 1e4 1/m"
  double tolerance = 1e-9;       ///< on the largest scaled residual
  double updateTolerance = 0.0;  ///< relative, 0: off
  int maxIterations = 50;
  LineSearch search = LineSearch::Residual;
};

struct SolveOutcome {
  bool converged = false;
  int iterations = 0;
  double residual = 0.0;  ///< max_i |scale_i r_i| at the end
  double update = 0.0;    ///< |dx|/|x| of the last step
  std::string message;    ///< what went wrong, when it did
};

/// Solves problem(x) = 0 from the start x, overwriting x; never throws for mere non-convergence.
using NonlinearSolver = std::function<SolveOutcome(const NonlinearProblem& problem, Vector& x,
                                                   const SolveRequest& request)>;

}  // namespace tooljoint::model
