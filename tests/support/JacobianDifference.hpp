// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// An analytic Jacobian against central differences.
#pragma once

#include <algorithm>

#include "model/NonlinearProblem.hpp"

namespace tooljoint::testing_ {

/// Largest |J - differences| of any entry over the largest entry of its row.
inline double jacobianError(const model::NonlinearProblem& problem, const Vector& x, double step) {
  Sparse analytic;
  problem.jacobian(x, analytic);
  const Matrix jacobian(analytic);
  Matrix difference(problem.size(), problem.size());
  Vector moved = x;
  Vector ahead;
  Vector behind;
  for (int j = 0; j < problem.size(); ++j) {
    moved(j) = x(j) + step;
    problem.residual(moved, ahead);
    moved(j) = x(j) - step;
    problem.residual(moved, behind);
    moved(j) = x(j);
    difference.col(j) = (ahead - behind) / (2.0 * step);
  }
  double worst = 0.0;
  for (int i = 0; i < problem.size(); ++i)
    worst = std::max(worst, (jacobian.row(i) - difference.row(i)).cwiseAbs().maxCoeff() /
                                difference.row(i).cwiseAbs().maxCoeff());
  return worst;
}

}  // namespace tooljoint::testing_
