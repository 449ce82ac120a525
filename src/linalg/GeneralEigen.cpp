// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/GeneralEigen.hpp"

#include <Eigen/Eigenvalues>
#include <Teuchos_LAPACK.hpp>

namespace tooljoint::linalg {

namespace {

/// Workspace numbers per row: LAPACK needs at least 4, and uses blocks if there are more.
constexpr int workOfARow = 40;

/// Column x + iy of a pair, and its conjugate.
void setPair(const Matrix& V, Eigen::Index j, Eigen::MatrixXcd& vectors) {
  vectors.col(j).real() = vectors.col(j + 1).real() = V.col(j);
  vectors.col(j).imag() = V.col(j + 1);
  vectors.col(j + 1).imag() = -V.col(j + 1);
}

}  // namespace

GeneralPairs generalPairs(Matrix A) {
  const auto n = static_cast<int>(A.rows());
  GeneralPairs pairs;
  pairs.values.resize(n);
  pairs.vectors = Eigen::MatrixXcd::Zero(n, n);
  if (n == 0) return pairs;
  Vector re(n), im(n), work(workOfARow * n);
  Matrix V(n, n);
  int info = 0;
  Teuchos::LAPACK<int, double>().GEEV('N', 'V', n, A.data(), n, re.data(), im.data(), nullptr, 1,
                                      V.data(), n, work.data(), workOfARow * n, &info);
  pairs.converged = info == 0;
  if (!pairs.converged) return pairs;
  pairs.values.real() = re;
  pairs.values.imag() = im;
  for (Eigen::Index j = 0; j < n; ++j) {
    if (im[j] == 0)
      pairs.vectors.col(j).real() = V.col(j);
    else
      setPair(V, j++, pairs.vectors);
  }
  return pairs;
}

GeneralPairs generalPairs(const Eigen::MatrixXcd& A) {
  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(A);
  if (solver.info() != Eigen::Success) return {{}, {}, false};
  return {solver.eigenvalues(), solver.eigenvectors(), true};
}

}  // namespace tooljoint::linalg
