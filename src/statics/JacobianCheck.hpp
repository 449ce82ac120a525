// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Analytic Jacobian against finite differences, for the tests of every nonlinear problem.
#pragma once

#include <string>

#include "common/Types.hpp"
#include "model/NonlinearProblem.hpp"

namespace tooljoint::statics {

struct JacobianError {
  double relative =
      0;  ///< max |analytic - differences| / size of the entry's row and column (see checkJacobian)
  int row = -1;  ///< where it is; -1 when everything is zero
  int column = -1;
  double analytic = 0;          ///< dr_row/dx_column as the problem gives it
  double differences = 0;       ///< the same by differences
  bool patternComplete = true;  ///< false: differences found an entry outside the sparsity pattern

  /// "row w of node 3, column theta_x of node 4: 1.2 analytic, 1.3 by differences (relative error
  /// 0.1)"
  std::string describe(const model::NonlinearProblem& problem) const;
};

/// Central differences of fourth order with step h_j = step * max(|x_j|, typical), column by
/// column, whatever the sparsity pattern says. The error of entry (i, j) is divided by the larger
/// of |analytic|, |differences| and 1e-3 of the largest entries of row i and of column j (geometric
/// mean), so that entries of different units are judged fairly.
JacobianError checkJacobian(const model::NonlinearProblem& problem, const Vector& x,
                            double step = 1e-4, double typical = 1.0);

}  // namespace tooljoint::statics
