// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Nested dissection of a graph (A. George, SIAM J. Numer. Anal. 10 (1973) 345-363) by Scotch:
/// parts without edges between them, and their separators.
#pragma once

#include <vector>

namespace tooljoint::linalg {

/// An undirected graph: every edge is in the lists of both of its vertices, and no edge joins a
/// vertex to itself.
struct Graph {
  std::vector<int> offsets;     ///< vertices + 1
  std::vector<int> neighbours;  ///< of vertex v: offsets[v] to offsets[v + 1]
  std::vector<int> weights;     ///< of the vertices, > 0

  int size() const { return static_cast<int>(weights.size()); }
};

/// Pieces of a graph, children before parents. A leaf is a part; any other piece is the separator
/// of its two subtrees, possibly empty. An edge joins vertices of one piece, or of a piece and one
/// of its ancestors.
struct Dissection {
  std::vector<std::vector<int>> vertices;  ///< of each piece, increasing
  std::vector<int> parent;                 ///< of each piece; -1 of the root
  std::vector<char> leaf;

  int pieces() const { return static_cast<int>(vertices.size()); }
};

/// Cuts the heaviest part in two until there are `parts`, or fewer if none can be cut any more. The
/// same in every run. Throws Error (Internal) if Scotch fails.
Dissection dissect(const Graph& graph, int parts);

}  // namespace tooljoint::linalg
