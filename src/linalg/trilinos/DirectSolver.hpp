// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Rank-local sparse direct solver, symmetric or not: long chains of nodes by blocks, matrices of
/// 2000 rows and more with over 18 entries a row by MUMPS, the rest by KLU2 (Amesos2, SerialComm).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>

#include "common/Parallel.hpp"
#include "common/Types.hpp"

namespace tooljoint::linalg {

/// Name of row or column i for messages ("theta_z of node 17"); without one, messages say "dof 17"
/// (counted from 1).
using DofNamer = std::function<std::string(int)>;

/// `name(i)`, or "dof i+1" without a namer.
std::string nameOf(const DofNamer& name, int i);

struct DirectSolverOptions {
  double tolerance = 1e-10;  ///< largest accepted backward error of a solution
  int refinements = 3;       ///< limit of steps of iterative refinement per solve
  double singularTolerance =
      3.6e-15;  ///< relative size of A v below which v is an unresisted motion (16 eps)
  bool checkSingular = true;  ///< search for such a v after each factorisation (two extra solves)
  parallel::Ranks ranks = parallel::Ranks::Own;  ///< All: MUMPS divides its factors among the ranks
};

/// LU factors of one sparse matrix, and checked solutions.
///
/// Every solution is checked: its backward error max_i |b - A x|_i / (|A||x| + |b|)_i is computed
/// with the matrix itself (Oettli and Prager 1964; tiny denominators as in Arioli, Demmel, Duff
/// 1989) and improved by iterative refinement. A ModelError is thrown if it stays above the
/// tolerance. Needs a live Tpetra::ScopeGuard; no object may outlive it. Works alike on every rank,
/// without messages unless all ranks factor together.
class DirectSolver {
 public:
  /// Factors A (square). ModelError: A is not square, an entry is not finite (named), A is singular
  /// to working precision (the dof with the largest displacement in the unresisted motion is
  /// named).
  explicit DirectSolver(const Sparse& A, DofNamer name = {}, DirectSolverOptions options = {});
  ~DirectSolver();
  DirectSolver(DirectSolver&&) noexcept;
  DirectSolver& operator=(DirectSolver&&) noexcept;

  /// Factors another matrix; the ordering is kept if the pattern is the same. Errors as the
  /// constructor.
  void refactor(const Sparse& A);
  /// The same without searching for an unresisted motion: for later matrices of a sequence whose
  /// first one was checked.
  void refactorUnchecked(const Sparse& A);

  /// x with A x = b; b is a vector or the columns of a matrix, with size() rows.
  /// ModelError: b is not finite, or the backward error stays above the tolerance.
  template <class Derived>
  auto solve(const Eigen::MatrixBase<Derived>& b) const {
    using Result = std::conditional_t<Derived::ColsAtCompileTime == 1, Vector, Matrix>;
    return Result(solveColumns(Matrix(b)));
  }

  /// x with A' x = b. The transpose is factored on first use (the transposed solve of KLU2 in
  /// Trilinos 13.2 is wrong).
  template <class Derived>
  auto solveTransposed(const Eigen::MatrixBase<Derived>& b) const {
    using Result = std::conditional_t<Derived::ColsAtCompileTime == 1, Vector, Matrix>;
    return Result(transposed().solveColumns(Matrix(b)));
  }

  /// A^-1 b by the factors only, neither refined nor checked: a preconditioner.
  Matrix apply(const Matrix& b) const;

  int size() const;
  /// Negative eigenvalues of A, if its factors give them: for a symmetric A factored by MUMPS.
  std::optional<int> negativeEigenvalues() const;
  /// Backward error of the last solve (largest of its columns); 0 before the first one.
  double lastResidual() const;
  /// Entries of both factors, for cost reports.
  long factorEntries() const;

 private:
  struct Impl;
  Matrix solveColumns(const Matrix& b) const;
  const DirectSolver& transposed() const;
  std::unique_ptr<Impl> impl_;
};

/// max over rows and columns of |B - A X| / (|A||X| + |B|), the backward error described at
/// DirectSolver.
double backwardError(const Sparse& A, const Matrix& X, const Matrix& B);

}  // namespace tooljoint::linalg
