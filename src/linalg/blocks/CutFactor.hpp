// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What the ranks of a divided matrix have left at the cut, as one dense matrix that all of them
/// hold and factor alike: of a chain of p pieces, p - 1 nodes.
#pragma once

#include <memory>
#include <vector>

#include "common/Types.hpp"
#include "linalg/blocks/RankCut.hpp"

namespace tooljoint::linalg {

class CutFactor {
 public:
  explicit CutFactor(std::shared_ptr<const RankCut> cut);

  /// Start with zero, add the entries of this rank by positions, and the size of each row before
  /// its interior was eliminated, then factor. Collective; false on all ranks where a pivot
  /// vanishes beside its row, or when one of them says that it has failed before.
  void clear() { sum_.setZero(); }
  double& at(int row, int column) { return sum_(cut_->number(row), cut_->number(column)); }
  double& sizeOf(int row) { return sum_(cut_->number(row), sum_.rows()); }
  bool factor(bool failed);
  /// x at the cut of a whole vector: partial sums -> the solution. Collective.
  void solve(double* x) const;
  /// The inverse, by positions, after invert().
  void invert();
  double inverse(int row, int column) const {
    return inverse_(cut_->number(row), cut_->number(column));
  }
  const RankCut& cut() const { return *cut_; }

 private:
  std::shared_ptr<const RankCut> cut_;
  Matrix sum_;  ///< and a column with the sizes of its rows; then the factors
  Matrix inverse_;
  std::vector<int> swaps_;
  std::vector<double> workScale_;
  mutable Vector right_;
};

}  // namespace tooljoint::linalg
