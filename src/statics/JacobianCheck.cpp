// SPDX-License-Identifier: BSD-3-Clause
#include "statics/JacobianCheck.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/Scientific.hpp"

namespace tooljoint::statics {

JacobianError checkJacobian(const model::NonlinearProblem& problem, const Vector& x, double step,
                            double typical) {
  const int n = problem.size();
  Sparse sparse(n, n);
  problem.jacobian(x, sparse);
  const Matrix analytic(sparse);
  Matrix differences(n, n);
  Vector r(n);
  const auto at = [&](int j, double h) -> Vector {
    Vector moved = x;
    moved[j] += h;
    problem.residual(moved, r);
    return r;
  };
  for (int j = 0; j < n; ++j) {
    // dr/dx_j = (8 (r(+h) - r(-h)) - (r(+2h) - r(-2h))) / 12 h + O(h^4)
    const double h = step * std::max(std::abs(x[j]), typical);
    differences.col(j) =
        (8.0 * (at(j, h) - at(j, -h)) - (at(j, 2.0 * h) - at(j, -2.0 * h))) / (12.0 * h);
  }
  Matrix pattern = Matrix::Zero(n, n);
  for (int row = 0; row < n; ++row)
    for (Sparse::InnerIterator it(sparse, row); it; ++it) pattern(row, it.col()) = 1.0;

  const Matrix larger = analytic.cwiseAbs().cwiseMax(differences.cwiseAbs());
  const Vector rowMax = larger.rowwise().maxCoeff(),
               columnMax = larger.colwise().maxCoeff().transpose();
  JacobianError worst;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double size = std::max(larger(i, j), 1e-3 * std::sqrt(rowMax[i] * columnMax[j]));
      const double error = size > 0.0 ? std::abs(analytic(i, j) - differences(i, j)) / size : 0.0;
      if (pattern(i, j) == 0.0 && error > 1e-3) worst.patternComplete = false;
      if (error > worst.relative || !std::isfinite(error)) {
        worst.relative = error;
        worst.row = i;
        worst.column = j;
        worst.analytic = analytic(i, j);
        worst.differences = differences(i, j);
        if (!std::isfinite(error)) return worst;
      }
    }
  return worst;
}

std::string JacobianError::describe(const model::NonlinearProblem& problem) const {
  if (row < 0) return "the Jacobian agrees with its differences exactly";
  return "row " + problem.unknownName(row) + ", column " + problem.unknownName(column) + ": " +
         linalg::scientific(analytic) + " analytic, " + linalg::scientific(differences) +
         " by differences (relative error " + linalg::scientific(relative) + ")" +
         (patternComplete ? "" : "; differences found entries outside the sparsity pattern");
}

}  // namespace tooljoint::statics
