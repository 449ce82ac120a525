// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The NOX driver as the solver of nonlinear problems, bound as in the program.
#pragma once

#include "model/NonlinearSolve.hpp"
#include "statics/NewtonSolver.hpp"

namespace tooljoint::testing_ {

inline model::SolveOutcome noxNewton(const model::NonlinearProblem& problem, Vector& x,
                                     const model::SolveRequest& request) {
  statics::NewtonOptions options;
  options.tolerance = request.tolerance;
  options.updateTolerance = request.updateTolerance > 0.0 ? request.updateTolerance : 1.0;
  options.maxIterations = request.maxIterations;
  options.lineSearch = statics::lineSearch(request.search);
  const statics::NewtonReport report = statics::solve(problem, x, options);
  return {report.converged, report.iterations, report.residual, report.update, report.message};
}

}  // namespace tooljoint::testing_
