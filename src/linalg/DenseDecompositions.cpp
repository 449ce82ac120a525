// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/DenseDecompositions.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Teuchos_LAPACK.hpp>
#include <algorithm>
#include <limits>

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

/// Number of columns of U or V.
Eigen::Index columnsOf(SingularVectors which, Eigen::Index full, Eigen::Index thin) {
  return which == SingularVectors::Full ? full : which == SingularVectors::Thin ? thin : 0;
}

char jobOf(SingularVectors which) {
  return which == SingularVectors::Full ? 'A' : which == SingularVectors::Thin ? 'S' : 'N';
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

SingularValues singularValues(Matrix A, SingularVectors left, SingularVectors right) {
  const Eigen::Index m = A.rows(), n = A.cols(), k = std::min(m, n);
  SingularValues parts;
  parts.U.setIdentity(m, columnsOf(left, m, k));
  Matrix Vt = Matrix::Identity(columnsOf(right, n, k), n);
  parts.values.setConstant(k, std::numeric_limits<double>::quiet_NaN());
  if (k > 0 && A.allFinite()) {
    const auto asInt = [](Eigen::Index i) { return std::max(1, static_cast<int>(i)); };
    Vector found(k), work(1);
    int info = 0;
    const auto call = [&](int size) {
      Teuchos::LAPACK<int, double>().GESVD(
          jobOf(left), jobOf(right), asInt(m), asInt(n), A.data(), asInt(m), found.data(),
          parts.U.data(), asInt(m), Vt.data(), asInt(Vt.rows()), work.data(), size, nullptr, &info);
    };
    call(-1);  // workspace query
    work.resize(static_cast<Eigen::Index>(work[0]));
    call(static_cast<int>(work.size()));
    if (info == 0) parts.values = found;
  }
  parts.V = Vt.transpose();
  return parts;
}

/// Those of [Re A, -Im A; Im A, Re A], in which each occurs twice.
Vector singularValues(const Eigen::MatrixXcd& A) {
  Matrix both(2 * A.rows(), 2 * A.cols());
  both << A.real(), -A.imag(), A.imag(), A.real();
  const Vector twice = singularValues(both).values;
  return twice(Eigen::seq(0, Eigen::last, 2));
}

DenseLu::DenseLu(const Matrix& A) : lu_(A) {}
Matrix DenseLu::solve(const Matrix& b) const { return lu_.solve(b); }
Vector DenseLu::solve(const Vector& b) const { return lu_.solve(b); }
/// Eigen's estimate does not return the NaN of a zero pivot.
double DenseLu::reciprocalCondition() const {
  const auto pivots = lu_.matrixLU().diagonal();
  return pivots.allFinite() && (pivots.array() != 0.0).all() ? lu_.rcond() : 0.0;
}

Matrix inverseOf(const Matrix& A) { return A.inverse(); }

Matrix solveSymmetric(const Matrix& A, const Matrix& b) { return A.ldlt().solve(b); }
Vector solveSymmetric(const Matrix& A, const Vector& b) { return A.ldlt().solve(b); }

Vector leastSquares(const Matrix& A, const Vector& b) { return A.colPivHouseholderQr().solve(b); }

}  // namespace tooljoint::linalg
