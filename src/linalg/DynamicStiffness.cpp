// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/DynamicStiffness.hpp"

#include <algorithm>
#include <cmath>

namespace tooljoint::linalg {

namespace {

/// Relative change of an eigenvalue at which its refinement ends, and the iteration limit.
constexpr double refined = 1e-9;
constexpr int mostRefinements = 20;
/// Rounds of equilibration; each halves the exponent of the ratio of sizes.
constexpr int equilibrations = 8;

}  // namespace

DynamicStiffness::DynamicStiffness(const Sparse& M, const Sparse& C, const Sparse& K, Complex s) {
  const ComplexSparse Q = s * s * M.cast<Complex>() + s * C.cast<Complex>() + K.cast<Complex>();
  equilibrate(Q);
  factors_.compute(rows_.asDiagonal() * Q * columns_.asDiagonal());
}

/// Repeated scaling of rows and columns by the roots of their largest entries (D. Ruiz, report
/// RAL-TR-2001-034), rounded to powers of two, which changes no digit.
void DynamicStiffness::equilibrate(const ComplexSparse& Q) {
  rows_ = columns_ = Vector::Ones(Q.rows());
  Vector inRow(Q.rows()), inColumn(Q.rows());
  for (int round = 0; round < equilibrations; ++round) {
    inRow.setZero();
    inColumn.setZero();
    for (int j = 0; j < Q.outerSize(); ++j)
      for (ComplexSparse::InnerIterator it(Q, j); it; ++it) {
        const double size = std::abs(it.value()) * rows_[it.row()] * columns_[j];
        inRow[it.row()] = std::max(inRow[it.row()], size);
        inColumn[j] = std::max(inColumn[j], size);
      }
    const auto factor = [](double size) {
      return size > 0.0 && std::isfinite(size) ? std::exp2(-std::round(0.5 * std::log2(size)))
                                               : 1.0;
    };
    rows_ = rows_.cwiseProduct(inRow.unaryExpr(factor));
    columns_ = columns_.cwiseProduct(inColumn.unaryExpr(factor));
  }
}

Eigen::MatrixXcd DynamicStiffness::solve(const Eigen::MatrixXcd& f) const {
  return columns_.asDiagonal() * factors_.solve(rows_.asDiagonal() * f);
}

double DynamicStiffness::logDeterminant() const {
  return factors_.logAbsDeterminant().real() - rows_.array().log().sum() -
         columns_.array().log().sum();
}

Eigen::MatrixXcd DynamicStiffness::solveTransposed(const Eigen::MatrixXcd& c) {
  return rows_.asDiagonal() * factors_.transpose().solve(columns_.asDiagonal() * c);
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
