// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Multifrontal factors by MUMPS (Amestoy, Duff, L'Excellent and Koster 2001), for matrices whose
/// factors fill: solids and shells. On this rank alone or divided among all, with an ordering that
/// MUMPS chooses.
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

  /// `memory` [MB]: what the factors may take at most; without it, what Linux says is free. All
  /// calls, the last of them the destructor's, are collective where all ranks factor together.
  explicit MumpsFactor(std::optional<long> memory = {},
                       parallel::Ranks ranks = parallel::Ranks::Own);
  ~MumpsFactor();
  MumpsFactor(MumpsFactor&&) noexcept;
  MumpsFactor& operator=(MumpsFactor&&) noexcept;

  /// Factors A; the ordering is kept while pattern and symmetry are the same. Of a symmetric A only
  /// the lower triangle is read. False: a pivot is zero, or not positive where A is Definite.
  /// ModelError naming the memory when it does not suffice, and for other failures of MUMPS.
  bool factor(const Sparse& A, Symmetry symmetry);
  /// A^-1 b, neither refined nor checked; columns in blocks.
  Matrix solve(const Matrix& b) const;
  /// Entries of the factors.
  long entries() const;
  /// Negative eigenvalues of A (Sylvester); none without factors of a symmetric A.
  std::optional<int> negativePivots() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// So many rows with so many entries, more than those of a string, that its factors by KLU2 would
/// fill much more.
bool suitsMumps(const Sparse& A);

/// x'(A - tolerance diag(A)) x > 0 for all x and symmetric A with a positive diagonal: no pivot of
/// A is below that part of its diagonal.
bool isDefinite(const Sparse& A, double tolerance);

}  // namespace tooljoint::linalg
