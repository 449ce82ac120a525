// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Products and factors of large dense matrices by BLAS and LAPACK (Teuchos).
#pragma once

#include "common/Types.hpp"

namespace tooljoint::linalg {

/// A' B.
Matrix transposedTimes(const Matrix& A, const Matrix& B);
/// C += factor A B.
void addProduct(double factor, const Matrix& A, const Matrix& B, Matrix& C);
/// C += A B'.
void addTransposedProduct(const Matrix& A, const Matrix& B, Matrix& C);
/// C -= Y' Y, both triangles.
void subtractSquare(const Matrix& Y, Matrix& C);

/// A = L L'.
class DenseCholesky {
 public:
  /// False if A is not positive definite to working precision. Reads the lower triangle.
  bool factor(Matrix A);
  /// L^-1 B and L^-T B, in place.
  void solveLower(Matrix& B) const;
  void solveUpper(Matrix& B) const;
  /// A^-1 B.
  Matrix solve(Matrix B) const;
  int size() const { return static_cast<int>(L_.rows()); }
  /// L L'.
  Matrix product() const;

 private:
  Matrix L_;  ///< lower triangle
};

}  // namespace tooljoint::linalg
