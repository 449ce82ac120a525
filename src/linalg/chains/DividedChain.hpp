// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// LU of a chain of nodes divided among ranks. The first rank eliminates from the first node, the
/// last rank from the last node, and all ranks hold the node where they meet. Factors and solutions
/// are bitwise equal to those of ChainFactor for any number of ranks.
#pragma once

#include <memory>
#include <vector>

#include "common/Types.hpp"
#include "linalg/blocks/ChainFactor.hpp"
#include "linalg/chains/ChainShare.hpp"

namespace tooljoint::linalg {

/// Matrices have the whole pattern on every rank, with values at least in the rows
/// ChainShare::around(). Vectors are complete and equal on all ranks. Every operation is
/// collective.
class DividedChain {
 public:
  /// Symbolic phase for matrices on the pattern of A (compressed).
  DividedChain(std::shared_ptr<const ChainShare> share, const Sparse& A);
  DividedChain(const DividedChain&) = delete;
  DividedChain& operator=(const DividedChain&) = delete;

  /// Whether matrices on the pattern can be factored in this way. The same on all ranks.
  bool suits() const { return sweeps_ != nullptr; }
  /// False on all ranks if a pivot vanishes or a rank has failed. With more than two ranks, A is
  /// complete afterwards.
  bool factor(Sparse& A, bool failed = false);
  /// A^-1 b.
  Matrix solve(const Matrix& b) const;
  /// A x, bitwise as by Tpetra on one rank.
  Matrix multiply(const Sparse& A, const Matrix& x) const;
  /// Rows of A x on this rank, with sums in the order of the entries. Not collective.
  void multiplyOwn(const Sparse& A, const Matrix& x, Matrix& y) const;
  /// Resistance to the least resisted motion: |R A v| / |R |A| |v| |, R A C of order one, v from
  /// two inverse iterations, as in DirectSolver.
  double resistance(const Sparse& A) const;

  const ChainShare& share() const { return *share_; }

 private:
  /// Sweep of this rank; -1: none.
  int sweep() const;

  std::shared_ptr<const ChainShare> share_;
  ChainFactor chain_;
  std::unique_ptr<BlockFactor::TwoSweeps> sweeps_;
  mutable std::vector<double> mine_, all_;  ///< messages
};

}  // namespace tooljoint::linalg
