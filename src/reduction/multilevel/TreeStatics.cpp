// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/multilevel/TreeStatics.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/Error.hpp"
#include "common/report/StageTimes.hpp"

namespace tooljoint::reduction {

namespace {

/// Columns per block: needs a few vectors of the part for each.
constexpr int blockOfColumns = 64;
/// Error in the energy norm at which the iteration ends, and the largest accepted one if rounding
/// stops it earlier.
constexpr double enough = 1e-12, accepted = 1e-7;
constexpr int mostIterations = 60;

Vector dots(const Matrix& A, const Matrix& B) {
  return A.cwiseProduct(B).colwise().sum().transpose();
}

/// Solves K X = B; returns the largest error of its columns, |X - K^-1 B|_K / |X|_K. The factors
/// are positive definite. If K is not (a buckled interior), it has few directions of negative
/// curvature, each of which costs one more iteration.
double solve(const Sparse& K, const TreeFactor& factor, const Matrix& B, Matrix& X) {
  X = factor.solve(B);
  Matrix R = B - K * X;
  Matrix Z = factor.solve(R), P = Z;
  Vector rho = dots(R, Z);
  double error = 0.0, best = 1e300;
  Matrix found = X;
  for (int i = 0; i < mostIterations; ++i) {
    const Vector energy = dots(X, B).cwiseAbs();
    error = 0.0;
    for (Eigen::Index j = 0; j < rho.size(); ++j)
      if (energy[j] != 0.0) {
        const double each = std::sqrt(std::abs(rho[j]) / energy[j]);
        if (!(each <= error)) error = each;  // true also if `each` is not a number
      }
    if (error < best) best = error, found = X;
    if (error <= enough || (best <= accepted && error > 10.0 * best)) break;
    const Matrix KP = K * P;
    const Vector curvature = dots(P, KP);
    Vector step(rho.size()), turn(rho.size());
    for (Eigen::Index j = 0; j < rho.size(); ++j)
      step[j] = curvature[j] != 0.0 ? rho[j] / curvature[j] : 0.0;
    X += P * step.asDiagonal();
    R -= KP * step.asDiagonal();
    Z = factor.solve(R);
    const Vector next = dots(R, Z);
    for (Eigen::Index j = 0; j < rho.size(); ++j) turn[j] = rho[j] > 0.0 ? next[j] / rho[j] : 0.0;
    P = Z + P * turn.asDiagonal();
    rho = next;
  }
  X = found;
  return best;
}

double largestRowSum(const Sparse& K) {
  double norm = 0.0;
  for (int i = 0; i < K.outerSize(); ++i) {
    double row = 0.0;
    forEachInRow(K, i, [&](int, double value) { row += std::abs(value); });
    norm = std::max(norm, row);
  }
  return norm;
}

/// [1; phi], row by row.
Sparse withIdentity(const Partition& p, const Matrix& phi) {
  const int boundary = sizeOf(p.boundary);
  std::vector<int> interiorRow(at(p.size), -1), boundaryRow(at(p.size), -1);
  for (int i = 0; i < sizeOf(p.interior); ++i) interiorRow[at(p.interior[at(i)])] = i;
  for (int j = 0; j < boundary; ++j) boundaryRow[at(p.boundary[at(j)])] = j;
  Sparse vectors(p.size, boundary);
  vectors.reserve(boundary + (phi.array() != 0.0).count());
  for (int row = 0; row < p.size; ++row) {
    vectors.startVec(row);
    if (boundaryRow[at(row)] >= 0) {
      vectors.insertBack(row, boundaryRow[at(row)]) = 1.0;
      continue;
    }
    for (int j = 0; j < boundary; ++j)
      if (const double value = phi(interiorRow[at(row)], j); value != 0.0)
        vectors.insertBack(row, j) = value;
  }
  vectors.finalize();
  return vectors;
}

}  // namespace

ConstraintModes treeConstraintModes(const PartView& part, const TreeFactor& factor) {
  const Stage stage("constraint modes");
  const Partition& p = part.partition();
  const Sparse& K = part.symmetricInteriorStiffness();
  const int boundary = sizeOf(p.boundary);
  const double norm = largestRowSum(K);
  Matrix phi(K.rows(), boundary);
  ConstraintModes modes;
  modes.residuals = Vector::Zero(boundary);
  for (int first = 0; first < boundary; first += blockOfColumns) {
    const int count = std::min(blockOfColumns, boundary - first);
    const std::vector<int> outer(p.boundary.begin() + first, p.boundary.begin() + first + count);
    const Matrix KIC = block(part.symmetricStiffness(), p.interior, outer);
    Matrix X;
    const double error = solve(K, factor, -KIC, X);
    if (!(error <= accepted))
      throw ModelError(part.who() + "its interior is a mechanism with its " +
                       std::to_string(boundary) +
                       " interface and retained dofs fixed, or nearly one: its static shapes do "
                       "not converge. Retain more dofs there, or cut the part elsewhere.");
    const Matrix defect = K * X + KIC;
    for (int j = 0; j < count; ++j) {
      const double scale = norm * X.col(j).cwiseAbs().maxCoeff() + KIC.col(j).cwiseAbs().maxCoeff();
      if (scale > 0.0) modes.residuals[first + j] = defect.col(j).cwiseAbs().maxCoeff() / scale;
    }
    phi.middleCols(first, count) = X;
  }
  modes.vectors = withIdentity(p, phi);
  return modes;
}

}  // namespace tooljoint::reduction
