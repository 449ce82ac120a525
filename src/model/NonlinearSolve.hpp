// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Callback by which a room solves its nonlinear problems without knowledge of the solver. The
/// program binds it to the NOX driver of src/statics, a test to any other solver.
#pragma once

#include <functional>
#include <string>

#include "model/NonlinearProblem.hpp"

namespace tooljoint::model {

/// Criterion for the length of a Newton step, up to the stepLimit() of the problem.
enum class LineSearch {
  None,      ///< no other criterion
  Residual,  ///< halved until the scaled residual decreases
  Work  ///< as far as the forces do work along it: suited to forces with a potential, even sharp
        ///< ones
};

/// A request to a solver. The iteration has converged if max_i |scale_i r_i| <= tolerance and, for
/// updateTolerance > 0, the full Newton step satisfies |dx| <= updateTolerance |x|.
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
  std::string message;    ///< reason for a failure
};

/// Solves problem(x) = 0 from the start x, overwriting x; does not throw if it does not converge.
using NonlinearSolver = std::function<SolveOutcome(const NonlinearProblem& problem, Vector& x,
                                                   const SolveRequest& request)>;

}  // namespace tooljoint::model
