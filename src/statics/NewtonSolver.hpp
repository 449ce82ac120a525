// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Newton's method for square nonlinear problems: NOX on a Thyra model evaluator, Belos GMRES for
/// the steps, preconditioned with a rank-local direct factor.
#pragma once

#include <string>
#include <vector>

#include "common/Types.hpp"
#include "model/NonlinearSolve.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::statics {

struct NewtonMemory;

struct NewtonOptions {
  enum LineSearch {
    LimitedStep,   ///< x + s dx with s the step limit of the problem, independent of the residual
    Backtracking,  ///< x + s dx with s = step limit, s/2, s/4 ... until the scaled residual
                   ///< decreases (Armijo)
    CriticalPoint  ///< x + s dx with r(x + s dx)' dx about 0: the least potential along dx, if r
                   ///< has one
  };
  double tolerance = 1e-8;        ///< accepted largest scaled residual max_i |scale_i r_i| ...
  double updateTolerance = 1e-8;  ///< ... together with the largest full Newton step |dx| / |x|
  int maxIterations = 50;
  LineSearch lineSearch = Backtracking;
};

/// Line search for the request of model::SolveRequest.
NewtonOptions::LineSearch lineSearch(model::LineSearch asked);

/// Result of a solve. Only `converged` means success.
struct NewtonReport {
  bool converged = false;
  int iterations = 0;
  double residual = 0;  ///< max_i |scale_i r_i| at the returned x
  double rounding =
      0;              ///< rounding error of it, if it stays above its tolerance because of rounding
  double update = 0;  ///< |dx| / |x| of the last full Newton step
  std::vector<double> history;  ///< max_i |scale_i r_i| at the start and after each iteration
  std::string message;          ///< one sentence: converged in ..., or why not
  int factorisations = 0;
  int linearIterations = 0;   ///< Belos iterations, all steps
  int halvings = 0;           ///< by the line search, all steps
  double linearResidual = 0;  ///< largest true linear residual |J dx + F| / |F| of all steps
};

/// Solves problem.residual(x) = 0 from the given x, which is overwritten with the last iterate,
/// converged or not. Failures (singular Jacobian, residual not finite, no convergence) are not
/// thrown: the report gives the reason. Errors thrown by the problem itself are passed on. The same
/// on every rank, without messages unless the problem is a DividedProblem. `nox` (a NOX parameter
/// list) and `belos` (a list of Thyra::BelosLinearOpWithSolveFactory: "Solver Type", "Solver
/// Types") override the parameters set here; ModelError if Belos refuses them. `memory` may be that
/// of an earlier solve.
NewtonReport solve(const model::NonlinearProblem& problem, Vector& x,
                   const NewtonOptions& options = {}, const Teuchos::ParameterList* nox = nullptr,
                   const Teuchos::ParameterList* belos = nullptr, NewtonMemory* memory = nullptr);
}  // namespace tooljoint::statics
