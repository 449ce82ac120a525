// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/trilinos/DirectSolver.hpp"

#include <Amesos2.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "common/Error.hpp"
#include "common/report/EvaluationCounters.hpp"
#include "linalg/Deterministic.hpp"
#include "linalg/Scientific.hpp"
#include "linalg/SparseProducts.hpp"
#include "linalg/blocks/ChainFactor.hpp"
#include "linalg/factor/MumpsFactor.hpp"
#include "linalg/trilinos/TpetraConversion.hpp"

namespace tooljoint::linalg {

std::string nameOf(const DofNamer& name, int i) {
  return name ? name(i) : "dof " + std::to_string(i + 1);
}

namespace {

void requireSquareAndFinite(const Sparse& A, const DofNamer& name) {
  if (A.rows() != A.cols())
    throw ModelError("A matrix of " + std::to_string(A.rows()) + " rows and " +
                     std::to_string(A.cols()) + " columns cannot be factored: it must be square.");
  for (int row = 0; row < A.rows(); ++row)
    for (Sparse::InnerIterator it(A, row); it; ++it)
      if (!std::isfinite(it.value()))
        throw ModelError("The matrix has an entry that is not finite, in the row of " +
                         nameOf(name, row) + " and the column of " +
                         nameOf(name, static_cast<int>(it.col())) + ".");
}

/// Factors R and C of the equilibrated matrix R A C, with rows and columns of order one; 1 for
/// empty ones.
struct Equilibration {
  Vector rows, columns;

  explicit Equilibration(const Sparse& A)
      : rows(Vector::Zero(A.rows())), columns(Vector::Zero(A.cols())) {
    for (int row = 0; row < A.rows(); ++row)
      for (Sparse::InnerIterator it(A, row); it; ++it)
        columns[it.col()] = std::max(columns[it.col()], std::abs(it.value()));
    columns = columns.unaryExpr([](double m) { return m > 0.0 ? 1.0 / std::sqrt(m) : 1.0; });
    for (int row = 0; row < A.rows(); ++row)
      for (Sparse::InnerIterator it(A, row); it; ++it)
        rows[row] = std::max(rows[row], std::abs(it.value()) * columns[it.col()]);
    rows = rows.unaryExpr([](double m) { return m > 0.0 ? 1.0 / m : 1.0; });
  }
};

/// Backward error of a chain's refined solution above which KLU2 is used: pivots inside the blocks
/// were not enough.
constexpr double chainResidual = 1e-13;
/// Columns solved and checked at once, so that many right-hand sides of a large matrix need little
/// memory besides the solution.
constexpr Eigen::Index blockOfColumns = 64;
/// Rows from which a chain is factored by blocks. For fewer both methods take less than a
/// millisecond.
constexpr int longChain = 600;

/// Amesos2's KLU2 for one matrix; no other class uses Amesos2.
class Klu2 {
 public:
  /// False if KLU2 finds a pivot that is exactly zero.
  bool factor(const Sparse& A) {
    if (matrix_.is_null() || !samePattern(pattern_, A)) {
      map_ = serialMap(static_cast<int>(A.rows()));
      matrix_ = toTpetra(A, map_);
      solver_ = Amesos2::create<tpetra::CrsMatrix, tpetra::MultiVector>("KLU2", matrix_);
      pattern_ = A;
      return attempt([&] { solver_->symbolicFactorization().numericFactorization(); });
    }
    replaceValues(*matrix_, A);
    return attempt([&] { solver_->numericFactorization(); });
  }

  Matrix solve(const Matrix& b) const {
    const auto x = Teuchos::rcp(new tpetra::MultiVector(map_, static_cast<std::size_t>(b.cols())));
    const auto rhs = toTpetra(b, map_);
    solver_->solve(x.ptr(), rhs.ptr());
    return toEigen(*x);
  }

  long entries() const { return static_cast<long>(solver_->getStatus().getNnzLU()); }

 private:
  template <class Work>
  bool attempt(Work&& work) {
    try {
      work();
    } catch (const std::runtime_error&) {  // "KLU2 numeric factorization failed"
      matrix_ = Teuchos::null;             // start anew next time
      return false;
    }
    return true;
  }

  Teuchos::RCP<const tpetra::Map> map_;
  Teuchos::RCP<tpetra::CrsMatrix> matrix_;
  Teuchos::RCP<Amesos2::Solver<tpetra::CrsMatrix, tpetra::MultiVector>> solver_;
  Sparse pattern_;
};

/// Factors of one matrix: by blocks for a long chain of nodes, by MUMPS for a large matrix with
/// much fill, else by KLU2. Pivoting of the block factors is limited to the blocks; KLU2 is used if
/// that is not enough.
class Factors {
 public:
  explicit Factors(parallel::Ranks ranks) : filled_({}, ranks) {}

  /// False if a pivot is exactly zero. \param newPattern the pattern differs from that of the
  /// previous matrix
  bool factor(const Sparse& A, bool newPattern) {
    if (newPattern) {
      chain_ = A.rows() >= longChain && ChainFactor::isChain(A) ? ChainFactor(A) : ChainFactor();
    }
    byBlocks_ = !chain_.empty() && chain_.factor(A);
    return byBlocks_ || factorWithPivots(A);
  }

  bool byBlocks() const { return byBlocks_; }
  bool factorWithPivots(const Sparse& A) {
    byBlocks_ = false;
    byMumps_ = suitsMumps(A);
    if (!byMumps_) return sparse_.factor(A);
    return filled_.factor(
        A, isExactlySymmetric(A) ? MumpsFactor::Symmetry::Indefinite : MumpsFactor::Symmetry::None);
  }

  Matrix solve(const Matrix& b) const {
    if (!byBlocks_) return byMumps_ ? filled_.solve(b) : sparse_.solve(b);
    Matrix x = b;
    for (Eigen::Index j = 0; j < x.cols(); ++j) chain_.solve(x.col(j).data());
    return x;
  }

  std::optional<int> negativePivots() const {
    return byBlocks_ || !byMumps_ ? std::nullopt : filled_.negativePivots();
  }

  long entries() const {
    return byBlocks_ ? chain_.entries() : byMumps_ ? filled_.entries() : sparse_.entries();
  }

 private:
  ChainFactor chain_;
  Klu2 sparse_;
  MumpsFactor filled_;
  bool byBlocks_ = false, byMumps_ = false;
};

/// A motion v with the least resistance, from equilibrated coordinates y = C^-1 v.
struct WeakMotion {
  Vector shape;       ///< v, of any size
  double resistance;  ///< |R A v| / |R |A| |v| |, maximum norms
};

/// Inverse iteration y <- (R A C)^-1 y with the factors of A (or of A slightly shifted).
WeakMotion weakestMotion(const Sparse& A, const Factors& factors, const Equilibration& scale,
                         int iterations) {
  Vector y = scatteredNumbers(A.rows(), 1, 20200105);
  for (int k = 0; k < iterations; ++k) {
    Vector next = factors.solve(y.cwiseQuotient(scale.rows)).col(0).cwiseQuotient(scale.columns);
    const double size = next.cwiseAbs().maxCoeff();
    if (!std::isfinite(size) || size == 0.0)
      break;  // overflow: the last finite y already has the right direction
    y = next / size;
  }
  const Vector v = y.cwiseProduct(scale.columns);
  const double reaction = (A * v).cwiseProduct(scale.rows).cwiseAbs().maxCoeff();
  const double participants = (A.cwiseAbs() * v.cwiseAbs()).cwiseProduct(scale.rows).maxCoeff();
  return {v, participants > 0.0 ? reaction / participants : 0.0};
}

[[noreturn]] void throwSingular(const std::string& dof, const std::string& why) {
  throw ModelError("The matrix is singular (" + why +
                   "): nothing resists a motion that is largest at " + dof +
                   ". Hold or connect that degree of freedom, or give it a stiffness.");
}

/// The matrix has an exactly zero pivot: finds the dof by inverse iteration with a small shift, A +
/// s (R C)^-1, and throws.
[[noreturn]] void explainZeroPivot(const Sparse& A, const DofNamer& name, parallel::Ranks ranks) {
  for (int row = 0; row < A.rows(); ++row) {
    double largest = 0.0;
    for (Sparse::InnerIterator it(A, row); it; ++it)
      largest = std::max(largest, std::abs(it.value()));
    if (largest == 0.0) throwSingular(nameOf(name, row), "its row is empty");
  }
  const Equilibration scale(A);
  Sparse diagonal(A.rows(), A.cols());
  diagonal.setIdentity();
  for (int i = 0; i < A.rows(); ++i)
    diagonal.coeffRef(i, i) = 1.0 / (scale.rows[i] * scale.columns[i]);
  for (const double shift : {1e-10, -1e-10, 1e-7, -1e-7}) {
    Factors shifted(ranks);
    if (!shifted.factorWithPivots(Sparse(A + shift * diagonal))) continue;
    const WeakMotion weak = weakestMotion(A, shifted, scale, 4);
    throwSingular(nameOf(name, static_cast<int>(largestEntry(weak.shape))), "zero pivot");
  }
  throw ModelError(
      "The matrix is singular (zero pivot), also after small shifts of its diagonal: several "
      "degrees of freedom are "
      "unconnected.");
}

}  // namespace

struct DirectSolver::Impl {
  Impl(DofNamer n, const DirectSolverOptions& o) : name(std::move(n)), options(o) {}

  DofNamer name;
  DirectSolverOptions options;
  Sparse matrix;
  Factors factors{options.ranks};
  double residual = 0.0;
  std::unique_ptr<DirectSolver> transposed;

  void factor(const Sparse& A, bool checkSingular) {
    requireSquareAndFinite(A, name);
    count("factorisations");
    transposed.reset();
    const bool newPattern = !samePattern(matrix, A);
    if (newPattern) {
      matrix = A;
      matrix.makeCompressed();
    } else {
      std::copy_n(A.valuePtr(), A.nonZeros(), matrix.valuePtr());
    }
    if (matrix.rows() == 0) return;
    if (!factors.factor(matrix, newPattern)) explainZeroPivot(matrix, name, options.ranks);
    if (!checkSingular) return;
    const WeakMotion weak = weakestMotion(matrix, factors, Equilibration(matrix), 2);
    if (!(weak.resistance > options.singularTolerance))
      throwSingular(nameOf(name, static_cast<int>(largestEntry(weak.shape))),
                    "to working precision: relative resistance " + scientific(weak.resistance));
  }

  /// x, with the backward error after iterative refinement in `residual`.
  Matrix refined(const Matrix& b) {
    Matrix x = factors.solve(b);
    Residual left = residualOf(matrix, x, b);
    residual = left.backwardError;
    // x <- x + A^-1 (b - A x) as long as it improves
    constexpr double enough = 4.0 * std::numeric_limits<double>::epsilon();
    for (int k = 0; k < options.refinements && residual > enough && std::isfinite(residual); ++k) {
      const Matrix better = x + factors.solve(left.values);
      Residual after = residualOf(matrix, better, b);
      if (!(after.backwardError < residual)) break;
      x = better;
      const bool worthwhile = after.backwardError < 0.5 * residual;
      residual = after.backwardError;
      left = std::move(after);
      if (!worthwhile) break;
    }
    return x;
  }

  Matrix solve(const Matrix& b) {
    if (b.rows() != matrix.rows())
      throw ModelError("A right-hand side of " + std::to_string(b.rows()) +
                       " rows was given to a matrix of " + std::to_string(matrix.rows()) +
                       " rows.");
    for (Eigen::Index j = 0; j < b.cols(); ++j)
      for (Eigen::Index i = 0; i < b.rows(); ++i)
        if (!std::isfinite(b(i, j)))
          throw ModelError("The right-hand side is not finite in the row of " +
                           nameOf(name, static_cast<int>(i)) + ".");
    residual = 0.0;
    if (b.size() == 0) return b;
    Matrix x(b.rows(), b.cols());
    double worst = 0.0;
    for (Eigen::Index j = 0; j < b.cols(); j += blockOfColumns) {
      const auto count = std::min<Eigen::Index>(blockOfColumns, b.cols() - j);
      x.middleCols(j, count) = checked(b.middleCols(j, count));
      worst = std::max(worst, residual);
    }
    residual = worst;
    return x;
  }

  Matrix checked(const Matrix& b) {
    Matrix x = refined(b);
    if (factors.byBlocks() && !(residual <= std::min(options.tolerance, chainResidual))) {
      if (!factors.factorWithPivots(matrix)) explainZeroPivot(matrix, name, options.ranks);
      x = refined(b);
    }
    if (!(residual <= options.tolerance))
      throw ModelError("A linear system was not solved: its backward error is " +
                       scientific(residual) + " where " + scientific(options.tolerance) +
                       " is allowed; the matrix is too badly conditioned or scaled.");
    return x;
  }
};

DirectSolver::DirectSolver(const Sparse& A, DofNamer name, DirectSolverOptions options)
    : impl_(std::make_unique<Impl>(std::move(name), options)) {
  impl_->factor(A, options.checkSingular);
}

DirectSolver::~DirectSolver() = default;
DirectSolver::DirectSolver(DirectSolver&&) noexcept = default;
DirectSolver& DirectSolver::operator=(DirectSolver&&) noexcept = default;

void DirectSolver::refactor(const Sparse& A) { impl_->factor(A, impl_->options.checkSingular); }
void DirectSolver::refactorUnchecked(const Sparse& A) { impl_->factor(A, false); }
Matrix DirectSolver::apply(const Matrix& b) const {
  return size() == 0 ? b : impl_->factors.solve(b);
}
Matrix DirectSolver::solveColumns(const Matrix& b) const { return impl_->solve(b); }
int DirectSolver::size() const { return static_cast<int>(impl_->matrix.rows()); }
std::optional<int> DirectSolver::negativeEigenvalues() const {
  return impl_->factors.negativePivots();
}
double DirectSolver::lastResidual() const { return impl_->residual; }
long DirectSolver::factorEntries() const { return size() == 0 ? 0 : impl_->factors.entries(); }

const DirectSolver& DirectSolver::transposed() const {
  if (!impl_->transposed) {
    const Sparse transpose = impl_->matrix.transpose();
    impl_->transposed = std::make_unique<DirectSolver>(transpose, impl_->name, impl_->options);
  }
  return *impl_->transposed;
}

}  // namespace tooljoint::linalg
