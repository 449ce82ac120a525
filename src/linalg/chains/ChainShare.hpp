// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The share of one rank in work on the rows of a chain of nodes: vectors are whole and alike on
/// all ranks, rows are computed by the rank that has their node, and brought together.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "common/RowRange.hpp"
#include "common/Types.hpp"

namespace tooljoint::linalg {

/// First row of each node that has any, and the number of rows at the end, from the node of each
/// row (ascending).
std::vector<int> firstRows(const std::vector<int>& nodeOf);

class ChainShare {
 public:
  /// That of parallel::rank(), of about as many nodes as the others have. \param first  first row
  /// of each node, and the number of rows at the end. Null on one rank, and where a rank would have
  /// less than `fewestRows`, or less than three nodes. The same decision on all ranks.
  static std::shared_ptr<const ChainShare> of(std::vector<int> first, int fewestRows);

  int ranks() const { return static_cast<int>(begin_.size()) - 1; }
  int rank() const { return rank_; }
  int size() const { return first_.back(); }
  /// First row of each node, and size().
  const std::vector<int>& first() const { return first_; }
  /// First node of a rank; that of the number of ranks is the number of nodes.
  int begin(int rank) const { return begin_[static_cast<std::size_t>(rank)]; }
  /// Rows of this rank.
  RowRange own() const { return rows(begin(rank_), begin(rank_ + 1)); }
  /// And those of the node before and of the node behind them.
  RowRange around() const;

  // Over the ranks of parallel::communicator(); collective, the same result on all of them.
  /// Columns of `size()` rows, of which each rank has its own -> whole columns. Whether one of the
  /// ranks says that it has failed; the columns are then of no use.
  bool gather(double* columns, int count, bool failed = false) const;
  /// Columns of which the first rank has the rows before `row` and the last one those from there
  /// on.
  void gatherEnds(double* columns, int count, int row) const;
  /// What the first and the last rank have, `lengths` numbers of each, one after the other. Whether
  /// one of the ranks says that it has failed.
  bool exchangeEnds(const std::vector<double>& mine, std::array<std::size_t, 2> lengths,
                    std::vector<double>& all, bool failed = false) const;
  /// The values of all rows of a compressed matrix, whose pattern is that of the chain.
  void gatherRows(Sparse& A) const;
  double largest(double value) const;
  bool any(bool value) const { return largest(value ? 1.0 : 0.0) > 0.0; }

 private:
  ChainShare() = default;
  RowRange rows(int beginNode, int endNode) const;

  int rank_ = 0;
  std::vector<int> first_, begin_;
  mutable std::vector<double> mine_, all_, send_, receive_;  ///< messages
  mutable std::vector<int> counts_, places_;
};

}  // namespace tooljoint::linalg
