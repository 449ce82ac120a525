// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// LU of a chain of nodes by ranks: the first rank eliminates from the first node, the last rank
/// from the last one, and all of them have the node where they meet. Factors and solutions are
/// those of ChainFactor, bit by bit, whatever the number of ranks.
#pragma once

#include <memory>
#include <vector>

#include "common/Types.hpp"
#include "linalg/blocks/ChainFactor.hpp"
#include "linalg/chains/ChainShare.hpp"

namespace tooljoint::linalg {

/// Matrices have the whole pattern on every rank and values in the rows ChainShare::around() at
/// least. Vectors are whole and alike on all ranks. Every operation is collective.
class DividedChain {
 public:
  /// Symbolic phase for matrices on the pattern of A (compressed).
  DividedChain(std::shared_ptr<const ChainShare> share, const Sparse& A);
  DividedChain(const DividedChain&) = delete;
  DividedChain& operator=(const DividedChain&) = delete;

  /// Whether matrices on the pattern can be factored so. The same on all ranks.
  bool suits() const { return sweeps_ != nullptr; }
  /// False on all ranks: a pivot vanished, or one of the ranks says that it has failed. A is whole
  /// afterwards where there are more than two ranks.
  bool factor(Sparse& A, bool failed = false);
  /// A^-1 b.
  Matrix solve(const Matrix& b) const;
  /// A x, bit by bit as by Tpetra on one rank.
  Matrix multiply(const Sparse& A, const Matrix& x) const;
  /// The rows of A x that are this rank's, sums in the order of the entries. Not collective.
  void multiplyOwn(const Sparse& A, const Matrix& x, Matrix& y) const;
  /// How much the matrix resists the motion that it resists least: |R A v| / |R |A| |v| |, R A C of
  /// order one, v from two inverse iterations; as DirectSolver measures it.
  double resistance(const Sparse& A) const;

  const ChainShare& share() const { return *share_; }

 private:
  /// That of this rank; -1: none.
  int sweep() const;

  std::shared_ptr<const ChainShare> share_;
  ChainFactor chain_;
  std::unique_ptr<BlockFactor::TwoSweeps> sweeps_;
  mutable std::vector<double> mine_, all_;  ///< messages
};

}  // namespace tooljoint::linalg
