// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Share of one rank in a model whose motion is divided among ranks. The blocks of the model are
/// arranged in levels that couple only to adjacent levels, so a string is a row of nodes. Two ranks
/// share a cut: the blocks of one level that couple to the next. A rank holds the blocks between
/// its two cuts, and both cuts. A chain is cut at single nodes.
///
/// Every entry of a matrix, load and row of the recovery, and every point, belongs to one rank.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "linalg/blocks/BlockSparse.hpp"
#include "model/SecondOrderModel.hpp"

namespace tooljoint::transient {

class RankShare {
 public:
  /// The share of parallel::rank(); null if the model has too few levels for all ranks. All ranks
  /// decide alike.
  static std::unique_ptr<RankShare> of(const model::SecondOrderModel& whole);

  /// In positions of pattern(): interior dofs, then those of the cuts. Laws, names and points are
  /// those of the whole model; rows of points of other ranks are empty.
  const model::SecondOrderModel& model() const { return model_; }
  /// Pattern with a cut (BlockPattern::cut()).
  const linalg::BlockPattern& pattern() const { return pattern_; }
  /// Per point set: the points of this rank, increasing.
  const std::vector<std::vector<int>>& points() const { return points_; }
  /// Per dof of model(): its position in the pattern of the whole model.
  const std::vector<int>& numbers() const { return numbers_; }
  /// Dofs of the whole model.
  int wholeSize() const { return static_cast<int>(place_.size()); }

  /// From dofs of the whole model to dofs of model().
  Vector pick(const Vector& whole) const;
  /// A vector in dofs of model() from all ranks -> in dofs of the whole model, on all ranks.
  /// Collective.
  void gather(const Vector& mine, Vector& whole) const;
  /// Concatenates arrays of any length, with their lengths. Collective.
  static void gatherArrays(const std::vector<double>& mine, std::vector<double>& all,
                           std::vector<int>& lengths);

 private:
  RankShare() = default;

  model::SecondOrderModel model_;
  linalg::BlockPattern pattern_;
  std::vector<std::vector<int>> points_;
  std::vector<int> dofs_, numbers_;  ///< in the whole model, per dof of model()
  // gather(): entries counted by each rank, one rank after the other
  std::vector<int> counted_;          ///< dofs of model() counted by this rank
  std::vector<int> counts_, begins_;  ///< per rank
  std::vector<int> place_;            ///< of each dof of the whole: its place in all messages
  mutable std::vector<double> mine_, all_;
};

}  // namespace tooljoint::transient
