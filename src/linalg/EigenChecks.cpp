// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/EigenChecks.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/Error.hpp"
#include "linalg/Deterministic.hpp"
#include "linalg/Scientific.hpp"

namespace tooljoint::linalg {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

using ColumnSparse = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;
using Ldlt = Eigen::SimplicialLDLT<ColumnSparse, Eigen::Lower, Eigen::AMDOrdering<int>>;

/// Negative pivots of L D L' = A without pivoting; -1 when a pivot vanished or the factors do not reproduce A.
int negativePivots(const Sparse& A) {
  Ldlt ldlt;
  ldlt.compute(ColumnSparse(A));
  if (ldlt.info() != Eigen::Success) return -1;
  const Vector d = ldlt.vectorD();
  if (!d.allFinite() || (d.array() == 0.0).any()) return -1;
  const Vector b = scatteredNumbers(A.rows(), 1, 7);
  const Vector x = ldlt.solve(b);
  if (!x.allFinite() || backwardError(A, x, b) > 1e-8) return -1;
  return static_cast<int>((d.array() < 0.0).count());
}

}  // namespace

Sparse symmetricPart(const Sparse& A, const std::string& what, const DofNamer& name) {
  if (A.rows() != A.cols()) throw ModelError("The " + what + " matrix of an eigenproblem must be square.");
  Vector rowMax = Vector::Zero(A.rows());
  for (int row = 0; row < A.rows(); ++row)
    for (Sparse::InnerIterator it(A, row); it; ++it) {
      if (!std::isfinite(it.value()))
        throw ModelError("The " + what + " matrix has an entry that is not finite, between " + nameOf(name, row) + " and " +
                         nameOf(name, static_cast<int>(it.col())) + ".");
      rowMax[row] = std::max(rowMax[row], std::abs(it.value()));
    }
  const Sparse transpose = A.transpose();
  const Sparse difference = A - transpose;
  for (int row = 0; row < A.rows(); ++row)
    for (Sparse::InnerIterator it(difference, row); it; ++it)
      if (std::abs(it.value()) > 1e-9 * std::sqrt(std::max(rowMax[row], epsilon) * std::max(rowMax[it.col()], epsilon)))
        throw ModelError("The " + what + " matrix of a symmetric eigenproblem is not symmetric between " + nameOf(name, row) +
                         " and " + nameOf(name, static_cast<int>(it.col())) + ": give its symmetric part.");
  return 0.5 * (A + transpose);
}

void requirePositiveDefinite(const Sparse& M, const DofNamer& name) {
  Ldlt ldlt;
  ldlt.compute(ColumnSparse(M));
  const auto refuse = [&](int dof) {
    throw ModelError("The mass matrix of an eigenproblem must be positive definite, and it is not at " + nameOf(name, dof) +
                     ": give that degree of freedom a mass, or condense it first.");
  };
  const Vector diagonal = M.diagonal();
  for (int i = 0; i < M.rows(); ++i)
    if (!(diagonal[i] > 0.0)) refuse(i);
  if (ldlt.info() != Eigen::Success) refuse(static_cast<int>(largestEntry(-diagonal)));
  // Pivot i belongs to row p_i of M; a pivot that is rounding beside the diagonal is zero.
  const Vector d = ldlt.vectorD();
  for (int i = 0; i < M.rows(); ++i) {
    const int dof = ldlt.permutationPinv().indices()[i];
    if (!(d[i] > 4.0 * epsilon * diagonal[dof])) refuse(dof);
  }
}

double eigenvalueScale(const Sparse& K, const Sparse& M) {
  return M.rows() == 0 ? 0.0 : Vector(K.diagonal().cwiseAbs().cwiseQuotient(M.diagonal())).maxCoeff();
}

void applyConventions(EigenPairs& modes, const Sparse& M) {
  std::vector<int> order(static_cast<std::size_t>(modes.values.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return modes.values[a] < modes.values[b]; });
  EigenPairs sorted = modes;
  for (std::size_t j = 0; j < order.size(); ++j) {
    const auto column = static_cast<Eigen::Index>(j);
    sorted.values[column] = modes.values[order[j]];
    Vector phi = modes.vectors.col(order[j]);
    phi /= std::sqrt(phi.dot(M * phi));
    if (phi[largestEntry(phi)] < 0.0) phi = -phi;
    sorted.vectors.col(column) = phi;
  }
  modes = std::move(sorted);
}

void recomputeErrors(EigenPairs& modes, const Sparse& K, const Sparse& M, double tolerance, double orthogonality) {
  const Matrix MPhi = M * modes.vectors;
  const Matrix R = K * modes.vectors - MPhi * modes.values.asDiagonal();
  const Matrix size = modes.vectors.cwiseAbs();
  const Sparse absK = K.cwiseAbs(), absM = M.cwiseAbs();
  const Matrix KSize = absK * size, MSize = absM * size;
  modes.residuals.resize(modes.values.size());
  for (Eigen::Index j = 0; j < modes.values.size(); ++j)
    modes.residuals[j] = R.col(j).norm() / (KSize.col(j).norm() + std::abs(modes.values[j]) * MSize.col(j).norm());
  const Matrix gram = modes.vectors.transpose() * MPhi - Matrix::Identity(modes.count(), modes.count());
  modes.orthogonality = modes.count() == 0 ? 0.0 : gram.cwiseAbs().maxCoeff();
  for (Eigen::Index j = 0; j < modes.residuals.size(); ++j)
    if (!(modes.residuals[j] <= tolerance))
      throw ConvergenceError("Mode " + std::to_string(j + 1) + " (" + modes.method + ") has a residual of " +
                             scientific(modes.residuals[j]) + " where " + scientific(tolerance) +
                             " is allowed: tighten the solver's own tolerance or raise its number of blocks and restarts.");
  if (!(modes.orthogonality <= orthogonality))
    throw ConvergenceError("The modes (" + modes.method + ") are orthogonal with respect to the mass matrix only to " +
                           scientific(modes.orthogonality) + " where " + scientific(orthogonality) + " is allowed.");
}

int keepWholePairs(const Vector& values, int count, double tolerance, double floor) {
  int keep = count;
  while (keep > 0 && keep < values.size()) {
    const double last = values[keep - 1], next = values[keep];
    if (next - last > std::max(tolerance * std::max(std::abs(last), std::abs(next)), floor)) break;
    ++keep;
  }
  return keep;
}

void truncate(EigenPairs& modes, int count) {
  modes.values.conservativeResize(count);
  modes.vectors.conservativeResize(Eigen::NoChange, count);
  modes.residuals.conservativeResize(std::min<Eigen::Index>(count, modes.residuals.size()));
}

int eigenvaluesBelow(const Sparse& K, const Sparse& M, double bound) {
  // A pivot may vanish by accident: move the bound by a few roundings of the spectrum and count again.
  const double step = 4.0 * epsilon * std::max(eigenvalueScale(K, M), std::abs(bound));
  for (const int k : {0, -1, 1, -4, 4, -16, 16}) {
    const int negative = K.rows() == 0 ? 0 : negativePivots(Sparse(K - (bound + k * step) * M));
    if (negative >= 0) return negative;
  }
  throw ConvergenceError("The eigenvalues below " + scientific(bound) + " could not be counted: K - lambda M has no stable LDL' factors there.");
}

}  // namespace tooljoint::linalg
