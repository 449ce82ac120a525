// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Inverses of matrices of the size of a point's coordinates, row-major.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "transient/Tuned.hpp"
#include "transient/contact/PointSolve.hpp"

namespace tooljoint::transient {

/// B = A^-1 for A 3 x 3 by cofactors; false if A is singular to rounding.
inline bool invertThree(const double* A, double* B) {
  const double c0 = A[4] * A[8] - A[5] * A[7], c1 = A[5] * A[6] - A[3] * A[8],
               c2 = A[3] * A[7] - A[4] * A[6];
  const double determinant = A[0] * c0 + A[1] * c1 + A[2] * c2;
  const double size = std::abs(A[0] * c0) + std::abs(A[1] * c1) + std::abs(A[2] * c2);
  if (!(std::abs(determinant) > Tuned::rounding * size)) return false;
  const double r = 1.0 / determinant;
  B[0] = r * c0, B[1] = r * (A[2] * A[7] - A[1] * A[8]), B[2] = r * (A[1] * A[5] - A[2] * A[4]);
  B[3] = r * c1, B[4] = r * (A[0] * A[8] - A[2] * A[6]), B[5] = r * (A[2] * A[3] - A[0] * A[5]);
  B[6] = r * c2, B[7] = r * (A[1] * A[6] - A[0] * A[7]), B[8] = r * (A[0] * A[4] - A[1] * A[3]);
  return true;
}

/// The same for up to PointSolve::widest rows.
inline bool invertFew(int n, const double* A, double* B) {
  if (n == 3) return invertThree(A, B);
  constexpr int widest = PointSolve::widest;
  using Rows =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, widest, widest>;
  const Rows matrix = Eigen::Map<const Rows>(A, n, n);
  const Rows inverse = matrix.partialPivLu().inverse();
  if (!inverse.allFinite()) return false;
  std::copy_n(inverse.data(), n * n, B);
  return true;
}

}  // namespace tooljoint::transient
