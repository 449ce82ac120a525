// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A part divided into substructures and the separators between them, as a tree.
#pragma once

#include <vector>

#include "common/Index.hpp"

namespace tooljoint::reduction {

/// A substructure (leaf) or a separator. Dofs are numbered as in the original matrices.
struct TreePiece {
  std::vector<int> dofs;      ///< increasing
  std::vector<int> boundary;  ///< dofs of ancestors coupled with its subtree, in the order of
                              ///< elimination
  int parent = -1;
  std::vector<int> children;
  std::vector<int> path;  ///< from the root to this piece
  bool leaf = false;
  int owner = 0;  ///< the rank that works on it; everyRank: all ranks
};

struct SubstructureTree {
  static constexpr int everyRank = -1;

  std::vector<TreePiece> pieces;  ///< children before parents
  std::vector<int> pieceOf;       ///< of every dof
  std::vector<int> rowOf;         ///< of every dof: its position in TreePiece::dofs

  int dofs() const { return sizeOf(pieceOf); }
  int leaves() const;
  int separatorDofs() const;
  /// True if this rank works on the piece.
  bool mine(int piece) const;
};

/// Divides the graph of K and M into `parts` leaves, fewer if it cannot be divided further; dofs of
/// one group stay together. Subtrees are distributed to the ranks by their number of dofs; the
/// pieces above them belong to every rank. Every rank passes the same and gets the same. \param
/// groups  group number of every dof, 0 to the number of groups - 1
SubstructureTree cutIntoTree(const Sparse& K, const Sparse& M, const std::vector<int>& groups,
                             int parts);

}  // namespace tooljoint::reduction
