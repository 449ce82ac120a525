// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/trilinos/Krylov.hpp"

#include <BelosLinearProblem.hpp>
#include <BelosPseudoBlockCGSolMgr.hpp>
#include <BelosPseudoBlockGmresSolMgr.hpp>
#include <BelosTpetraAdapter.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <utility>

#include "common/Error.hpp"
#include "linalg/Scientific.hpp"
#include "linalg/trilinos/FunctionOperator.hpp"

namespace tooljoint::linalg {

using LinearProblem = Belos::LinearProblem<double, tpetra::MultiVector, tpetra::Operator>;
using Manager = Belos::SolverManager<double, tpetra::MultiVector, tpetra::Operator>;

struct KrylovSolver::Impl {
  KrylovOptions options;
  Sparse matrix;
  DirectSolver factors;
  Teuchos::RCP<const tpetra::Map> map;
  int iterations = 0;
  double residual = 0.0;

  Impl(const Sparse& A, DofNamer name, KrylovOptions options_)
      : options(options_),
        matrix(A),
        factors(A, std::move(name)),
        map(serialMap(static_cast<int>(A.rows()))) {}

  Teuchos::RCP<Manager> manager(const Teuchos::RCP<LinearProblem>& problem) const {
    const auto list = Teuchos::parameterList();
    list->set("Convergence Tolerance", options.tolerance);
    list->set("Maximum Iterations", options.maxIterations);
    list->set("Verbosity", 0);
    if (options.method == KrylovOptions::Gmres)
      list->set("Num Blocks",
                std::max(1, std::min(static_cast<int>(matrix.rows()), options.maxIterations)));
    if (options.belos != nullptr) list->setParameters(*options.belos);
    if (options.method == KrylovOptions::Cg)
      return Teuchos::rcp(
          new Belos::PseudoBlockCGSolMgr<double, tpetra::MultiVector, tpetra::Operator>(problem,
                                                                                        list));
    return Teuchos::rcp(
        new Belos::PseudoBlockGmresSolMgr<double, tpetra::MultiVector, tpetra::Operator>(problem,
                                                                                         list));
  }

  /// One Belos run for A dx = r from zero; false when Belos says it did not converge.
  bool run(const Matrix& r, Matrix& dx) {
    const Teuchos::RCP<tpetra::Operator> A = Teuchos::rcp(
        new FunctionOperator(map, [this](const Matrix& x) { return Matrix(matrix * x); }));
    const Teuchos::RCP<tpetra::Operator> inverse = Teuchos::rcp(
        new FunctionOperator(map, [this](const Matrix& x) { return factors.solve(x); }));
    const auto rhs = toTpetra(r, map), x = toTpetra(Matrix(Matrix::Zero(r.rows(), r.cols())), map);
    const auto problem = Teuchos::rcp(new LinearProblem(A, x, rhs));
    problem->setLeftPrec(inverse);
    if (!problem->setProblem()) throw std::logic_error("Belos refused the linear problem.");
    const auto solver = manager(problem);
    const bool converged = solver->solve() == Belos::Converged;
    iterations += solver->getNumIters();
    dx = toEigen(*x);
    return converged;
  }

  Matrix solve(const Matrix& b) {
    if (b.rows() != matrix.rows())
      throw ModelError("A right-hand side of " + std::to_string(b.rows()) +
                       " rows was given to a matrix of " + std::to_string(matrix.rows()) +
                       " rows.");
    if (!b.allFinite())
      throw ModelError("The right-hand side of an iterative solve is not finite.");
    iterations = 0;
    residual = 0.0;
    Matrix x = Matrix::Zero(b.rows(), b.cols());
    if (b.size() == 0 || b.isZero(0.0)) return x;
    bool converged = false;
    constexpr int runs = 3;
    for (int k = 0; k < runs; ++k) {
      Matrix dx;
      try {
        converged = run(b - matrix * x, dx);
      } catch (const Error&) {
        throw;
      } catch (const std::exception& stopped) {
        throw ConvergenceError(std::string("Belos stopped: ") + stopped.what());
      }
      if (!dx.allFinite()) break;
      x += dx;
      residual = backwardError(matrix, x, b);
      // Belos' own verdict is not asked: only the solution counts.
      if (residual <= options.backwardError) return x;
    }
    throw ConvergenceError("Belos did not solve a linear system of " +
                           std::to_string(matrix.rows()) + " dofs: backward error " +
                           scientific(residual) + " where " + scientific(options.backwardError) +
                           " is allowed, after " + std::to_string(iterations) + " iterations in " +
                           std::to_string(runs) + " runs (Belos says " +
                           (converged ? "converged" : "not converged") +
                           "). Factor the current matrix, or allow more iterations.");
  }
};

KrylovSolver::KrylovSolver(const Sparse& A, DofNamer name, KrylovOptions options)
    : impl_(std::make_unique<Impl>(A, std::move(name), options)) {}
KrylovSolver::~KrylovSolver() = default;
KrylovSolver::KrylovSolver(KrylovSolver&&) noexcept = default;
KrylovSolver& KrylovSolver::operator=(KrylovSolver&&) noexcept = default;

void KrylovSolver::update(const Sparse& A) {
  if (A.rows() != impl_->matrix.rows() || A.cols() != impl_->matrix.cols())
    throw ModelError("The matrix of an iterative solver may not change its size.");
  impl_->matrix = A;
}
void KrylovSolver::refactor() { impl_->factors.refactor(impl_->matrix); }
Matrix KrylovSolver::solveColumns(const Matrix& b) const { return impl_->solve(b); }
int KrylovSolver::lastIterations() const { return impl_->iterations; }
double KrylovSolver::lastResidual() const { return impl_->residual; }

}  // namespace tooljoint::linalg
