// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Share of one rank in work on the rows of a chain of nodes. All ranks hold equal, complete
/// vectors; each computes the rows of its nodes, and the rows are then gathered.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "common/RowRange.hpp"
#include "common/Types.hpp"

namespace tooljoint::linalg {

/// First row of each node with rows, and the number of rows at the end, from the node of each row
/// (ascending).
std::vector<int> firstRows(const std::vector<int>& nodeOf);

class ChainShare {
 public:
  /// Share of parallel::rank(); all ranks have about equally many nodes. \param first first row of
  /// each node, and the number of rows at the end. Null on one rank, and if a rank would have less
  /// than `fewestRows` or less than three nodes. The same decision on all ranks.
  static std::shared_ptr<const ChainShare> of(std::vector<int> first, int fewestRows);

  int ranks() const { return static_cast<int>(begin_.size()) - 1; }
  int rank() const { return rank_; }
  int size() const { return first_.back(); }
  /// First row of each node, and size().
  const std::vector<int>& first() const { return first_; }
  /// First node of a rank; the number of nodes for rank = ranks().
  int begin(int rank) const { return begin_[static_cast<std::size_t>(rank)]; }
  /// Rows of this rank.
  RowRange own() const { return rows(begin(rank_), begin(rank_ + 1)); }
  /// The same with the rows of the adjacent nodes on both sides.
  RowRange around() const;

  // Over the ranks of parallel::communicator(); collective, with the same result on all ranks.
  /// Columns of `size()` rows with the own rows of each rank -> complete columns. True if one of
  /// the ranks has failed; the columns are then invalid.
  bool gather(double* columns, int count, bool failed = false) const;
  /// The same for columns with the rows before `row` on the first rank and the others on the last
  /// rank.
  void gatherEnds(double* columns, int count, int row) const;
  /// Data of the first and the last rank, `lengths` numbers of each, one after the other. True if
  /// one of the ranks has failed.
  bool exchangeEnds(const std::vector<double>& mine, std::array<std::size_t, 2> lengths,
                    std::vector<double>& all, bool failed = false) const;
  /// The values of all rows of a compressed matrix with the pattern of the chain.
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
