// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// LU of a sparse matrix with the blocks found in its pattern: the rows of the dofs of a node have
/// equal patterns. A string of beams, whose blocks of six form a chain, costs O(n).
#pragma once

#include <vector>

#include "common/Types.hpp"
#include "linalg/blocks/BlockFactor.hpp"

namespace tooljoint::linalg {

class ChainFactor {
 public:
  /// Whether blocks have three dofs or more on average and no row has more than 18 entries: a chain
  /// of nodes with up to six dofs. Other matrices are left to a general sparse solver.
  static bool isChain(const Sparse& A);

  ChainFactor() = default;
  /// Symbolic phase for matrices on the pattern of A (square, compressed; values do not matter).
  explicit ChainFactor(const Sparse& A);

  bool empty() const { return factor_.empty(); }
  /// Factors A, which has the pattern of the symbolic phase. False if a pivot vanishes.
  bool factor(const Sparse& A);
  /// x := A^-1 x, x of size() entries.
  void solve(double* x) const { factor_.solve(x); }
  /// For two ranks that compute half each: fill() instead of factor(), then the sweeps.
  bool hasTwoSweeps() const { return factor_.hasTwoSweeps(); }
  BlockFactor& blocks() { return factor_; }
  /// Sets the values of rows begin ... end - 1 of A, all others zero.
  void fill(const Sparse& A, int begin, int end);
  /// Entries of both factors.
  long entries() const { return static_cast<long>(storage_); }

 private:
  BlockFactor factor_;
  std::vector<std::size_t> address_;  ///< of each entry of A, in BlockFactor::values()
  std::size_t storage_ = 0;           ///< length of BlockFactor::values()
};

}  // namespace tooljoint::linalg
