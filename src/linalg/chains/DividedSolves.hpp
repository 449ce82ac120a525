// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Checked solutions with a chain that all ranks have, each rank computing its rows.
#pragma once

#include <memory>
#include <optional>

#include "common/Types.hpp"
#include "linalg/chains/DividedChain.hpp"

namespace tooljoint::linalg {

/// Vectors are whole and alike on all ranks. Every operation is collective.
class DividedSolves {
 public:
  /// Factors A; nothing on all ranks where a pivot vanishes.
  static std::unique_ptr<DividedSolves> of(std::shared_ptr<const ChainShare> share, Sparse A);

  /// A^-1 b, refined and with the backward error of DirectSolver; nothing on all ranks where it
  /// stays above 1e-13. Of b the rows of this rank are read alone.
  std::optional<Matrix> solve(const Matrix& b) const;
  /// B x, and the rows of it that are this rank's, the others zero.
  Matrix multiply(const Sparse& B, const Matrix& x) const;
  Matrix ownRows(const Sparse& B, const Matrix& x) const;

 private:
  DividedSolves(std::shared_ptr<const ChainShare> share, const Sparse& A);

  DividedChain chain_;
  Sparse mine_;  ///< rows of A
};

}  // namespace tooljoint::linalg
