// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Checked solutions with a chain held by all ranks, each rank computing its own rows.
#pragma once

#include <memory>
#include <optional>

#include "common/Types.hpp"
#include "linalg/chains/DividedChain.hpp"

namespace tooljoint::linalg {

/// Vectors are complete and equal on all ranks. Every operation is collective.
class DividedSolves {
 public:
  /// Factors A; null on all ranks if a pivot vanishes.
  static std::unique_ptr<DividedSolves> of(std::shared_ptr<const ChainShare> share, Sparse A);

  /// A^-1 b, refined and with the backward error of DirectSolver; empty on all ranks if that stays
  /// above 1e-13. Only the rows of this rank are read from b.
  std::optional<Matrix> solve(const Matrix& b) const;
  /// B x; its rows on this rank, the others zero.
  Matrix multiply(const Sparse& B, const Matrix& x) const;
  Matrix ownRows(const Sparse& B, const Matrix& x) const;

 private:
  DividedSolves(std::shared_ptr<const ChainShare> share, const Sparse& A);

  DividedChain chain_;
  Sparse mine_;  ///< rows of A
};

}  // namespace tooljoint::linalg
