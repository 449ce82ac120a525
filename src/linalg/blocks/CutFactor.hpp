// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Schur complement of a divided matrix at the cut, as one dense matrix that all ranks hold and
/// factor: p - 1 nodes for a chain of p pieces.
#pragma once

#include <memory>
#include <vector>

#include "common/Types.hpp"
#include "linalg/blocks/RankCut.hpp"

namespace tooljoint::linalg {

class CutFactor {
 public:
  explicit CutFactor(std::shared_ptr<const RankCut> cut);

  /// Usage: clear, add the entries of this rank by positions, set the size of each row before its
  /// interior was eliminated, then factor. Collective; false on all ranks if a pivot vanishes
  /// relative to its row, or if a rank has failed before.
  void clear() { sum_.setZero(); }
  double& at(int row, int column) { return sum_(cut_->number(row), cut_->number(column)); }
  double& sizeOf(int row) { return sum_(cut_->number(row), sum_.rows()); }
  bool factor(bool failed);
  /// x at the cut of a complete vector: partial sums -> the solution. Collective.
  void solve(double* x) const;
  /// Inverse by positions, after invert().
  void invert();
  double inverse(int row, int column) const {
    return inverse_(cut_->number(row), cut_->number(column));
  }
  const RankCut& cut() const { return *cut_; }

 private:
  std::shared_ptr<const RankCut> cut_;
  Matrix sum_;  ///< with a column of row sizes; then the factors
  Matrix inverse_;
  std::vector<int> swaps_;
  std::vector<double> workScale_;
  mutable Vector right_;
};

}  // namespace tooljoint::linalg
