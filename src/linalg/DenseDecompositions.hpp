// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Decompositions of dense matrices behind plain functions, because every source that instantiates
/// one of Eigen's takes seconds longer to compile.
#pragma once

#include <Eigen/LU>

#include "common/Types.hpp"

namespace tooljoint::linalg {

/// Eigenvalues in increasing order, with their vectors in the columns.
struct SymmetricPairs {
  Vector values;
  Matrix vectors;
  bool converged = true;  ///< of the QR iteration
};
/// A x = lambda x, x' x = 1. Reads the lower triangle.
SymmetricPairs symmetricPairs(const Matrix& A);
/// A x = lambda B x, x' B x = 1; B is positive definite. Reads the lower triangles.
SymmetricPairs symmetricPairs(const Matrix& A, const Matrix& B);
/// The eigenvalues of symmetricPairs(A).
Vector symmetricValues(const Matrix& A);

/// A = U diag(values) V', values decreasing.
struct SingularValues {
  Vector values;
  Matrix U, V;  ///< as many columns as were requested
};
/// Thin: min(rows, columns) vectors; Full: a whole orthogonal matrix.
enum class SingularVectors { None, Thin, Full };
/// By LAPACK (GESVD). The values are NaN if A contains NaN or the iteration does not converge.
SingularValues singularValues(Matrix A, SingularVectors left = SingularVectors::None,
                              SingularVectors right = SingularVectors::None);
/// Singular values, decreasing.
Vector singularValues(const Eigen::MatrixXcd& A);

/// A = P' L U with partial pivoting.
class DenseLu {
 public:
  DenseLu() = default;
  explicit DenseLu(const Matrix& A);
  Matrix solve(const Matrix& b) const;
  Vector solve(const Vector& b) const;
  /// Estimate of 1 / cond(A) in the 1-norm; 0 if A is singular.
  double reciprocalCondition() const;

 private:
  Eigen::PartialPivLU<Matrix> lu_;
};
/// A^-1 of a matrix of any size.
Matrix inverseOf(const Matrix& A);

/// A^-1 b of a symmetric matrix, by L D L' with pivoting. Reads the lower triangle.
Matrix solveSymmetric(const Matrix& A, const Matrix& b);
Vector solveSymmetric(const Matrix& A, const Vector& b);
/// The x of smallest |A x - b|, by QR with column pivoting.
Vector leastSquares(const Matrix& A, const Vector& b);

}  // namespace tooljoint::linalg
