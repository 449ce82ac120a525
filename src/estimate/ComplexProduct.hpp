// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A real sparse matrix times complex columns.
#pragma once

#include "common/Types.hpp"

namespace tooljoint::estimate {

/// A x, by two real products: a product of mixed types would copy A as complex.
inline Eigen::MatrixXcd times(const Sparse& A, const Eigen::MatrixXcd& x) {
  Eigen::MatrixXcd y(A.rows(), x.cols());
  y.real() = A * Matrix(x.real());
  y.imag() = A * Matrix(x.imag());
  return y;
}

}  // namespace tooljoint::estimate
