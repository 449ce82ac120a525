// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A real matrix, sparse or dense, times a complex vector or complex columns.
#pragma once

#include <complex>

#include "common/Types.hpp"

namespace tooljoint::linalg {

/// A x by two real products, with as many columns as x. A product of mixed types would copy A as
/// complex.
template <class Real2D, class Columns>
Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Columns::ColsAtCompileTime> times(
    const Real2D& A, const Eigen::MatrixBase<Columns>& x) {
  using Real = Eigen::Matrix<double, Eigen::Dynamic, Columns::ColsAtCompileTime>;
  Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Columns::ColsAtCompileTime> y(A.rows(),
                                                                                    x.cols());
  y.real() = A * Real(x.real());
  y.imag() = A * Real(x.imag());
  return y;
}

}  // namespace tooljoint::linalg
