// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/chains/DividedSolves.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "linalg/SparseProducts.hpp"

namespace tooljoint::linalg {
namespace {

/// Largest backward error of a refined solution for which factors with pivoting inside nodes
/// suffice.
constexpr double chainError = 1e-13;
constexpr int refinementsAtMost = 3;

}  // namespace

DividedSolves::DividedSolves(std::shared_ptr<const ChainShare> share, const Sparse& A)
    : chain_(std::move(share), A) {
  const auto own = chain_.share().own();
  mine_ = A.middleRows(own.begin, own.end - own.begin);
}

std::unique_ptr<DividedSolves> DividedSolves::of(std::shared_ptr<const ChainShare> share,
                                                 Sparse A) {
  A.makeCompressed();
  std::unique_ptr<DividedSolves> solves(new DividedSolves(std::move(share), A));
  return solves->chain_.suits() && solves->chain_.factor(A) ? std::move(solves) : nullptr;
}

std::optional<Matrix> DividedSolves::solve(const Matrix& b) const {
  const auto& share = chain_.share();
  const auto own = share.own();
  const Matrix right = b.middleRows(own.begin, own.end - own.begin);
  Matrix x = chain_.solve(b);
  Residual left = residualOf(mine_, x, right);
  double error = share.largest(left.backwardError);
  constexpr double enough = 4.0 * std::numeric_limits<double>::epsilon();
  for (int k = 0; k < refinementsAtMost && error > enough && std::isfinite(error); ++k) {
    Matrix rest = Matrix::Zero(b.rows(), b.cols());
    rest.middleRows(own.begin, own.end - own.begin) = left.values;
    const Matrix better = x + chain_.solve(rest);
    Residual after = residualOf(mine_, better, right);
    const double now = share.largest(after.backwardError);
    if (!(now < error)) break;
    x = better;
    const bool worthwhile = now < 0.5 * error;
    error = now;
    left = std::move(after);
    if (!worthwhile) break;
  }
  if (!(error <= chainError)) return std::nullopt;
  return x;
}

Matrix DividedSolves::multiply(const Sparse& B, const Matrix& x) const {
  Matrix y(x.rows(), x.cols());
  chain_.multiplyOwn(B, x, y);
  chain_.share().gather(y.data(), static_cast<int>(y.cols()));
  return y;
}

Matrix DividedSolves::ownRows(const Sparse& B, const Matrix& x) const {
  Matrix y = Matrix::Zero(x.rows(), x.cols());
  chain_.multiplyOwn(B, x, y);
  return y;
}

}  // namespace tooljoint::linalg
