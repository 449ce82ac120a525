// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Where a graph of blocks can be divided among ranks: levels of equal distance from one end, in
/// which a block couples to its own level and the two beside it only (Cuthill and McKee 1969,
/// George and Liu 1979).
#pragma once

#include <set>
#include <vector>

namespace tooljoint::transient {

/// Neighbours of each block.
using BlockGraph = std::vector<std::set<int>>;

/// To which rank, or to which cut between two, each block belongs.
struct BlockShares {
  std::vector<int> rank;  ///< per block: the rank that alone holds it; of a block of a cut the
                          ///< lower one of the two that do
  std::vector<char> cut;  ///< per block: it lies in the cut between `rank` and the next one
  /// Whether a rank holds a block.
  bool holds(int asked, int block) const {
    const int of = rank[static_cast<std::size_t>(block)];
    return asked == of || (cut[static_cast<std::size_t>(block)] != 0 && asked == of + 1);
  }
};

/// Shares of about equal work; empty where there are too few levels for so many ranks.
BlockShares divide(const BlockGraph& graph, const std::vector<int>& width,
                   const std::vector<double>& work, int ranks);

}  // namespace tooljoint::transient
