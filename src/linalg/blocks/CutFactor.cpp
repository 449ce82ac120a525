// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/blocks/CutFactor.hpp"

#include <cmath>
#include <utility>

namespace tooljoint::linalg {

CutFactor::CutFactor(std::shared_ptr<const RankCut> cut)
    : cut_(std::move(cut)),
      sum_(Matrix::Zero(cut_->total(), cut_->total())),
      factor_(cut_->total()),
      right_(Vector::Zero(cut_->total())),
      solution_(right_) {}

/// A row without an entry, or a pivot that is lost in the rounding of its row, is no matrix one can
/// solve with; what is not a number is neither.
bool CutFactor::factor(bool failed) {
  if (failed) sum_.setConstant(NAN);
  cut_->sumAll(sum_.data(), static_cast<std::size_t>(sum_.size()));
  if (!sum_.allFinite()) return false;
  for (Eigen::Index i = 0; i < sum_.rows(); ++i)
    if (sum_.row(i).isZero(0.0)) return false;
  factor_.compute(sum_);
  const auto pivots = factor_.matrixLU().diagonal();
  return pivots.allFinite() && (pivots.array() != 0.0).all();
}

void CutFactor::solve(double* x) const {
  right_.setZero();
  cut_->collect(x, right_.data());
  cut_->sumAll(right_.data(), static_cast<std::size_t>(right_.size()));
  solution_.noalias() = factor_.permutationP() * right_;
  factor_.matrixLU().triangularView<Eigen::UnitLower>().solveInPlace(solution_);
  factor_.matrixLU().triangularView<Eigen::Upper>().solveInPlace(solution_);
  cut_->spread(solution_.data(), x);
}

void CutFactor::invert() { inverse_ = factor_.inverse(); }

}  // namespace tooljoint::linalg
