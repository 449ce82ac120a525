// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/blocks/CutFactor.hpp"

#include <cmath>
#include <utility>

#include "linalg/blocks/BlockKernels.hpp"

namespace tooljoint::linalg {

CutFactor::CutFactor(std::shared_ptr<const RankCut> cut)
    : cut_(std::move(cut)),
      sum_(Matrix::Zero(cut_->total(), cut_->total() + 1)),
      swaps_(static_cast<std::size_t>(cut_->total()), 0),
      workScale_(swaps_.size(), 0.0),
      right_(Vector::Zero(cut_->total())) {}

/// A matrix with NaN or infinite entries cannot be factored.
bool CutFactor::factor(bool failed) {
  if (failed) sum_.setConstant(NAN);
  cut_->sumAll(sum_.data(), static_cast<std::size_t>(sum_.size()));
  if (!sum_.allFinite()) return false;
  const int n = cut_->total();
  const double* sizes = sum_.data() + sum_.rows() * sum_.rows();
  for (int i = 0; i < n; ++i)
    if (!(sizes[i] > 0)) return false;
  return kernel::factorLarge(n, sum_.data(), sizes, workScale_.data(), swaps_.data()) < 0;
}

void CutFactor::solve(double* x) const {
  right_.setZero();
  cut_->collect(x, right_.data());
  cut_->sumAll(right_.data(), static_cast<std::size_t>(right_.size()));
  kernel::solveLarge(cut_->total(), 1, sum_.data(), swaps_.data(), right_.data());
  cut_->spread(right_.data(), x);
}

void CutFactor::invert() {
  const int n = cut_->total();
  inverse_.setIdentity(n, n);
  kernel::solveLarge(n, n, sum_.data(), swaps_.data(), inverse_.data());
}

}  // namespace tooljoint::linalg
