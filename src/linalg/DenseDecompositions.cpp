// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/DenseDecompositions.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace tooljoint::linalg {

namespace {

template <class Solver>
SymmetricPairs pairsOf(const Solver& solver) {
  SymmetricPairs pairs;
  pairs.converged = solver.info() == Eigen::Success;
  if (!pairs.converged) return pairs;
  pairs.values = solver.eigenvalues();
  pairs.vectors = solver.eigenvectors();
  return pairs;
}

template <class Solver>
SingularValues partsOf(const Solver& svd) {
  SingularValues parts;
  parts.values = svd.singularValues();
  if (svd.computeU()) parts.U = svd.matrixU();
  if (svd.computeV()) parts.V = svd.matrixV();
  return parts;
}

}  // namespace

SymmetricPairs symmetricPairs(const Matrix& A) {
  return pairsOf(Eigen::SelfAdjointEigenSolver<Matrix>(A));
}

SymmetricPairs symmetricPairs(const Matrix& A, const Matrix& B) {
  return pairsOf(Eigen::GeneralizedSelfAdjointEigenSolver<Matrix>(A, B));
}

Vector symmetricValues(const Matrix& A) {
  return Eigen::SelfAdjointEigenSolver<Matrix>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

SingularValues jacobiSvd(const Matrix& A, unsigned int parts) {
  return partsOf(Eigen::JacobiSVD<Matrix>(A, parts));
}

SingularValues divideAndConquerSvd(const Matrix& A, unsigned int parts) {
  return partsOf(Eigen::BDCSVD<Matrix>(A, parts));
}

Vector singularValues(const Eigen::MatrixXcd& A) {
  return Eigen::JacobiSVD<Eigen::MatrixXcd>(A).singularValues();
}

DenseLu::DenseLu(const Matrix& A) : lu_(A) {}
Matrix DenseLu::solve(const Matrix& b) const { return lu_.solve(b); }
Vector DenseLu::solve(const Vector& b) const { return lu_.solve(b); }
/// Eigen's estimate loses the NaN of a pivot that is zero.
double DenseLu::reciprocalCondition() const {
  const auto pivots = lu_.matrixLU().diagonal();
  return pivots.allFinite() && (pivots.array() != 0.0).all() ? lu_.rcond() : 0.0;
}

Matrix inverseOf(const Matrix& A) { return A.inverse(); }

Matrix solveSymmetric(const Matrix& A, const Matrix& b) { return A.ldlt().solve(b); }
Vector solveSymmetric(const Matrix& A, const Vector& b) { return A.ldlt().solve(b); }

Vector leastSquares(const Matrix& A, const Vector& b) { return A.colPivHouseholderQr().solve(b); }

}  // namespace tooljoint::linalg
