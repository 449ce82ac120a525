// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Products of a large sparse matrix with several columns: one pass over its entries for eight
/// columns.
#pragma once

#include "common/Types.hpp"

namespace tooljoint::linalg {

/// All entries are zero, or there are none.
bool isZero(const Sparse& A);
/// a_ij = a_ji for all entries, bitwise.
bool isExactlySymmetric(const Sparse& A);
/// A X, with the sums of each row in the order of its entries, as in A * X.
Matrix product(const Sparse& A, const Matrix& X);
/// |A| |X|, with absolute values of the entries.
Matrix absoluteProduct(const Sparse& A, const Matrix& X);

/// B - A X, and its size relative to its terms.
struct Residual {
  Matrix values;         ///< rows x columns
  double backwardError;  ///< linalg::backwardError
};
Residual residualOf(const Sparse& A, const Matrix& X, const Matrix& B);

}  // namespace tooljoint::linalg
