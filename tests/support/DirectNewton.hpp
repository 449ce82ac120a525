// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A plain Newton iteration with a direct factorisation, so that tests of the physics do not depend
/// on the solvers of the library.
#pragma once

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>

#include "model/NonlinearSolve.hpp"

namespace tooljoint::testing_ {

inline model::SolveOutcome directNewton(const model::NonlinearProblem& problem, Vector& x,
                                        const model::SolveRequest& request) {
  model::SolveOutcome outcome;
  const Vector scale = problem.residualScale();
  Vector r;
  problem.residual(x, r);
  outcome.residual = scale.cwiseProduct(r).lpNorm<Eigen::Infinity>();
  Sparse jacobian;
  double merit = scale.cwiseProduct(r).norm();
  while (outcome.residual > request.tolerance && outcome.iterations < request.maxIterations) {
    problem.jacobian(x, jacobian);
    Eigen::SparseLU<Eigen::SparseMatrix<double, Eigen::ColMajor, int>> lu;
    lu.compute(Eigen::SparseMatrix<double, Eigen::ColMajor, int>(jacobian));
    if (lu.info() != Eigen::Success) {
      outcome.message = "singular Jacobian";
      return outcome;
    }
    const Vector dx = lu.solve(-r);
    double factor = problem.stepLimit(x, dx);
    Vector next;
    double size = 0.0;
    for (int halvings = 0;; ++halvings, factor *= 0.5) {
      next = x + factor * dx;
      problem.residual(next, r);
      size = scale.cwiseProduct(r).norm();
      if (request.search == model::LineSearch::None || size < (1.0 - 1e-4 * factor) * merit ||
          halvings == 12)
        break;
    }
    x = next;
    ++outcome.iterations;
    merit = size;
    outcome.residual = scale.cwiseProduct(r).lpNorm<Eigen::Infinity>();
    outcome.update = dx.norm() / std::max(x.norm(), 1e-300);
    if (!std::isfinite(size)) {
      outcome.message = "the residual is not finite";
      return outcome;
    }
  }
  outcome.converged = outcome.residual <= request.tolerance;
  return outcome;
}

}  // namespace tooljoint::testing_
