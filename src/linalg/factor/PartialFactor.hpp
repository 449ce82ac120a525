// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Elimination of the first rows of a symmetric matrix by MUMPS: their factors, and the Schur
/// complement of the others.
#pragma once

#include <memory>

#include "common/Types.hpp"

namespace tooljoint::linalg {

class PartialFactor {
 public:
  PartialFactor();
  ~PartialFactor();
  PartialFactor(PartialFactor&&) noexcept;
  PartialFactor& operator=(PartialFactor&&) noexcept;

  /// Factors A_ii, the first `inner` rows of the symmetric A = [A_ii A_ib; A_bi A_bb], of which the
  /// lower triangle is read. The ordering is kept as long as the pattern is the same and some rows
  /// are left. False if A_ii is not positive definite to working precision. `schur` becomes A_bb -
  /// A_bi A_ii^-1 A_ib, full. On this rank alone. ModelError if memory is not enough, and for other
  /// failures of MUMPS.
  bool factor(const Sparse& A, int inner, Matrix& schur);
  /// A_ii^-1 b, neither refined nor checked.
  Matrix solve(const Matrix& b) const;
  /// Entries of the factors.
  long entries() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tooljoint::linalg
