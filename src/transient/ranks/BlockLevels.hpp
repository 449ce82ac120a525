// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Division of a graph of blocks among ranks: levels of equal distance from one end. A block
/// couples only to its own level and the two adjacent ones (Cuthill and McKee 1969, George and Liu
/// 1979).
#pragma once

#include <set>
#include <vector>

namespace tooljoint::transient {

/// Neighbours of each block.
using BlockGraph = std::vector<std::set<int>>;

/// Rank of each block, or cut between two ranks.
struct BlockShares {
  std::vector<int> rank;  ///< per block: the only rank that holds it; for a block of a cut, the
                          ///< lower of its two ranks
  std::vector<char> cut;  ///< per block: whether it is in the cut of `rank` and the next one
  /// Whether a rank holds a block.
  bool holds(int asked, int block) const {
    const int of = rank[static_cast<std::size_t>(block)];
    return asked == of || (cut[static_cast<std::size_t>(block)] != 0 && asked == of + 1);
  }
};

/// Shares of about equal work; empty if there are too few levels for so many ranks.
BlockShares divide(const BlockGraph& graph, const std::vector<int>& width,
                   const std::vector<double>& work, int ranks);

}  // namespace tooljoint::transient
