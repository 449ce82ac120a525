// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The share of one rank in a model whose motion is computed by several: the blocks of the model
/// stand in levels, each beside its neighbours, so that a string is a row of nodes. Between two
/// ranks lies a cut, the blocks of one level that couple to the next; a rank has what lies between
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
  /// That of parallel::rank() of all ranks; null where the model has fewer levels than it takes.
  /// The same decision on all ranks.
  static std::unique_ptr<RankShare> of(const model::SecondOrderModel& whole);

  /// In positions of pattern(): interior dofs, then those of the cuts; laws, names and points as in
  /// the whole, rows of points of other ranks empty.
  const model::SecondOrderModel& model() const { return model_; }
  /// Divided (BlockPattern::cut()).
  const linalg::BlockPattern& pattern() const { return pattern_; }
  /// Per point set: the points of this rank, increasing.
  const std::vector<std::vector<int>>& points() const { return points_; }
  /// Per dof of model(): its position in the whole model's own pattern.
  const std::vector<int>& numbers() const { return numbers_; }
  /// Dofs of the whole model.
  int wholeSize() const { return static_cast<int>(place_.size()); }

  /// From dofs of the whole to dofs of model().
  Vector pick(const Vector& whole) const;
  /// A vector in dofs of model() from all ranks -> in dofs of the whole, on all ranks. Collective.
  void gather(const Vector& mine, Vector& whole) const;
  /// Arrays of any length, one after the other, with their lengths. Collective.
  static void gatherArrays(const std::vector<double>& mine, std::vector<double>& all,
                           std::vector<int>& lengths);

 private:
  RankShare() = default;

  model::SecondOrderModel model_;
  linalg::BlockPattern pattern_;
  std::vector<std::vector<int>> points_;
  std::vector<int> dofs_, numbers_;  ///< of the whole, per dof of model()
  // gather(): what each rank counts, one rank after the other
  std::vector<int> counted_;          ///< dofs of model() that this rank counts
  std::vector<int> counts_, begins_;  ///< per rank
  std::vector<int> place_;            ///< in the messages of all ranks, of each dof of the whole
  mutable std::vector<double> mine_, all_;
};

}  // namespace tooljoint::transient
