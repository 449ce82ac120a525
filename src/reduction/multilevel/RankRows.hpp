// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Long vectors whose rows are distributed over the ranks.
#pragma once

#include "common/Types.hpp"

namespace tooljoint::reduction {

/// Sum of the matrices of all ranks, in rank order; the same on each. Collective.
Matrix sumOverRanks(const Matrix& mine);

/// Consecutive rows of vectors of `size` rows for each rank.
class RankRows {
 public:
  explicit RankRows(Eigen::Index size);
  Eigen::Index first() const { return first_; }
  Eigen::Index count() const { return count_; }
  /// All rows, from the rows of each rank. Collective.
  Matrix all(const Matrix& mine) const;

 private:
  Eigen::Index size_, first_, count_;
};

}  // namespace tooljoint::reduction
