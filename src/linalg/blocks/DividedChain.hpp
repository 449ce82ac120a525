// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// LU of a chain of nodes whose rows are divided among ranks: each rank eliminates the nodes
/// between its cuts, what is left at the cuts is factored by all of them (BlockFactor).
#pragma once

#include <memory>
#include <vector>

#include "common/Types.hpp"
#include "linalg/blocks/BlockFactor.hpp"
#include "linalg/blocks/ChainShare.hpp"

namespace tooljoint::linalg {

/// Matrices have the whole pattern on every rank; values are read in the rows ChainShare::around()
/// alone. Vectors are whole and alike on all ranks. Every operation is collective.
class DividedChain {
 public:
  /// Symbolic phase for matrices on the pattern of A (compressed): entries couple a node to itself
  /// and to the two beside it only.
  DividedChain(std::shared_ptr<const ChainShare> share, const Sparse& A);

  /// False on all ranks: a pivot vanished, or one of the ranks says that it has failed.
  bool factor(const Sparse& A, bool failed = false);
  /// A^-1 b.
  Matrix solve(const Matrix& b) const;
  /// A x.
  Matrix multiply(const Sparse& A, const Matrix& x) const;
  /// How much the matrix resists the motion that it resists least: |R A v| / |R |A| |v| |, R A C of
  /// order one, v from two inverse iterations; as DirectSolver measures it.
  double resistance(const Sparse& A) const;

  const ChainShare& share() const { return *share_; }

 private:
  struct Entry {
    std::size_t address;  ///< in BlockFactor::values()
    int from;             ///< entry of A
  };

  std::shared_ptr<const ChainShare> share_;
  int interior_ = 0;             ///< rows that this rank alone holds
  int before_ = 0, behind_ = 0;  ///< widths of the cuts to the ranks before and behind
  BlockFactor factor_;
  std::size_t storage_ = 0;
  std::vector<Entry> entries_;
  mutable Vector local_;
};

}  // namespace tooljoint::linalg
