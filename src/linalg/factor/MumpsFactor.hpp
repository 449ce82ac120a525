// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Multifrontal factors by MUMPS (Amestoy, Duff, L'Excellent and Koster 2001), for matrices with
/// much fill: solids and shells. On this rank alone or divided among all, with an ordering chosen
/// by MUMPS.
#pragma once

#include <memory>
#include <optional>

#include "common/Parallel.hpp"
#include "common/Types.hpp"

namespace tooljoint::linalg {

class MumpsFactor {
 public:
  /// L U, L D L' with pivots of order one and two, or L D L' with D > 0 (no pivoting).
  enum class Symmetry { None, Indefinite, Definite };

  /// `memory` [MB]: limit for the factors; by default the memory that Linux reports free. All
  /// calls, including the destructor's, are collective if all ranks factor together.
  explicit MumpsFactor(std::optional<long> memory = {},
                       parallel::Ranks ranks = parallel::Ranks::Own);
  ~MumpsFactor();
  MumpsFactor(MumpsFactor&&) noexcept;
  MumpsFactor& operator=(MumpsFactor&&) noexcept;

  /// Factors A; the ordering is kept as long as pattern and symmetry are the same. Only the lower
  /// triangle of a symmetric A is read. False if a pivot is zero, or not positive for a Definite A.
  /// ModelError naming the memory if it is not enough, and for other failures of MUMPS.
  bool factor(const Sparse& A, Symmetry symmetry);
  /// A^-1 b, neither refined nor checked; columns are solved in blocks.
  Matrix solve(const Matrix& b) const;
  /// Entries of the factors.
  long entries() const;
  /// Negative eigenvalues of A (Sylvester); empty without factors of a symmetric A.
  std::optional<int> negativePivots() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether A has so many rows, with more entries than those of a string, that its factors by KLU2
/// would have much more fill.
bool suitsMumps(const Sparse& A);

/// Whether x'(A - tolerance diag(A)) x > 0 for all x: no pivot of A is below that part of its
/// diagonal. A is symmetric with a positive diagonal.
bool isDefinite(const Sparse& A, double tolerance);

}  // namespace tooljoint::linalg
