// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Belos GMRES or CG on rank-local systems, preconditioned with a direct factor that may belong to
/// an older matrix.
#pragma once

#include <memory>
#include <type_traits>

#include "common/Types.hpp"
#include "linalg/trilinos/DirectSolver.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::linalg {

struct KrylovOptions {
  enum Method { Gmres, Cg };  ///< Cg for symmetric positive definite matrices (and factors)
  Method method = Gmres;
  double tolerance = 1e-10;  ///< of the preconditioned residual, relative to the one at the start
  double backwardError =
      1e-10;  ///< of the solution, recomputed as in DirectSolver; up to two restarts improve it
  int maxIterations = 200;  ///< of one Belos run
  const Teuchos::ParameterList* belos =
      nullptr;  ///< laid over the parameters of the Belos solver manager
};

/// Solves A x = b for a sequence of similar matrices A with few factorisations.
class KrylovSolver {
 public:
  /// Factors A as preconditioner. Errors as DirectSolver.
  explicit KrylovSolver(const Sparse& A, DofNamer name = {}, KrylovOptions options = {});
  ~KrylovSolver();
  KrylovSolver(KrylovSolver&&) noexcept;
  KrylovSolver& operator=(KrylovSolver&&) noexcept;

  /// Another matrix of the same size; the factor stays as it is.
  void update(const Sparse& A);
  /// Factors the current matrix.
  void refactor();

  /// x with A x = b, b a vector or columns. ConvergenceError: Belos did not converge, or the
  /// recomputed backward error is above the limit, whatever Belos says.
  template <class Derived>
  auto solve(const Eigen::MatrixBase<Derived>& b) const {
    using Result = std::conditional_t<Derived::ColsAtCompileTime == 1, Vector, Matrix>;
    return Result(solveColumns(Matrix(b)));
  }

  int lastIterations() const;   ///< Belos iterations of the last solve, restarts included
  double lastResidual() const;  ///< backward error of the last solve

 private:
  struct Impl;
  Matrix solveColumns(const Matrix& b) const;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tooljoint::linalg
