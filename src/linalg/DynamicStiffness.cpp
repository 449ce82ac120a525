// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/DynamicStiffness.hpp"

#include <cmath>

namespace tooljoint::linalg {

namespace {

/// Relative change of an eigenvalue that ends its refinement, and the iterations allowed.
constexpr double refined = 1e-9;
constexpr int mostRefinements = 20;

}  // namespace

DynamicStiffness::DynamicStiffness(const Sparse& M, const Sparse& C, const Sparse& K, Complex s) {
  const ComplexSparse Q = s * s * M.cast<Complex>() + s * C.cast<Complex>() + K.cast<Complex>();
  factors_.compute(Q);
}

Eigen::MatrixXcd DynamicStiffness::solve(const Eigen::MatrixXcd& f) const {
  return factors_.solve(f);
}

Eigen::MatrixXcd DynamicStiffness::solveTransposed(const Eigen::MatrixXcd& c) {
  return factors_.transpose().solve(c);
}

std::optional<DampedMode> refine(const Sparse& M, const Sparse& C, const Sparse& K,
                                 DampedMode mode) {
  for (int i = 0; i < mostRefinements; ++i) {
    const DynamicStiffness Q(M, C, K, mode.s);
    if (Q.singular()) return mode;
    const Eigen::VectorXcd y =
        Q.solve(C.cast<Complex>() * mode.shape + 2.0 * mode.s * (M.cast<Complex>() * mode.shape));
    Eigen::Index k = 0;
    y.cwiseAbs().maxCoeff(&k);
    if (!y.allFinite() || y[k] == 0.0) return std::nullopt;
    const Complex change = mode.shape[k] / y[k];
    mode.s -= change;
    mode.shape = y / y[k];
    if (std::abs(change) <= refined * std::abs(mode.s)) return mode;
  }
  return std::nullopt;
}

}  // namespace tooljoint::linalg
