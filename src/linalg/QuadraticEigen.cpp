// SPDX-License-Identifier: BSD-3-Clause
#include <AnasaziBasicEigenproblem.hpp>
#include <AnasaziBlockKrylovSchurSolMgr.hpp>
#include <AnasaziTpetraAdapter.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/Error.hpp"
#include "linalg/Deterministic.hpp"
#include "linalg/DirectSolver.hpp"
#include "linalg/EigenSolver.hpp"
#include "linalg/FunctionOperator.hpp"
#include "linalg/Scientific.hpp"
#include "linalg/TpetraConversion.hpp"

namespace tooljoint::linalg {

namespace {

using Complex = std::complex<double>;

/// A quadratic pencil and its linearisation inverted at the real shift sigma >= 0.
struct Quadratic {
  Sparse M, C, K;
  double shift = 0;
  std::unique_ptr<DirectSolver> factors;  ///< of K + sigma C + sigma^2 M

  Quadratic(const Sparse& m, const Sparse& c, const Sparse& k, const DofNamer& name) : M(m), C(c), K(k) {
    try {
      factors = std::make_unique<DirectSolver>(K, name);
    } catch (const ModelError&) {  // a free body: near zero, but not at it
      double stiff = 0, mass = 0;
      for (int i = 0; i < K.rows(); ++i) stiff += std::abs(K.coeff(i, i)), mass += M.coeff(i, i);
      shift = mass > 0 && stiff > 0 ? 1e-4 * std::sqrt(stiff / mass) : 1.0;
      factors = std::make_unique<DirectSolver>(Sparse(K + shift * C + shift * shift * M), name);
    }
  }
  Eigen::Index size() const { return M.rows(); }

  /// [x; y] -> ([0 1; -K -C] - sigma [1 0; 0 M])^-1 [x; M y], so that s = sigma + 1/nu, y = s x.
  Matrix inverse(const Matrix& z) const {
    const auto n = size();
    const Matrix x = z.topRows(n), y = z.bottomRows(n);
    Matrix out(2 * n, z.cols());
    out.topRows(n) = -factors->solve(M * y + C * x + shift * (M * x));
    out.bottomRows(n) = x + shift * out.topRows(n);
    return out;
  }
};

double rowNorm(const Sparse& A) {
  double largest = 0;
  for (int i = 0; i < A.outerSize(); ++i) {
    double row = 0;
    for (Sparse::InnerIterator it(A, i); it; ++it) row += std::abs(it.value());
    largest = std::max(largest, row);
  }
  return largest;
}

/// The `wanted` values nearest the shift; complex vectors x of the quadratic problem. A restart may cut a conjugate pair and then stalls: later
/// attempts have larger bases. False when none converged.
bool krylov(const Quadratic& q, int wanted, int attempt, std::vector<Complex>& values, Eigen::MatrixXcd& vectors) {
  using Problem = Anasazi::BasicEigenproblem<double, tpetra::MultiVector, tpetra::Operator>;
  using Manager = Anasazi::BlockKrylovSchurSolMgr<double, tpetra::MultiVector, tpetra::Operator>;
  const int n = static_cast<int>(2 * q.size());
  const auto map = serialMap(n);
  const Teuchos::RCP<tpetra::Operator> inverse = Teuchos::rcp(new FunctionOperator(map, [&](const Matrix& z) { return q.inverse(z); }));
  const int block = 4;
  Teuchos::ParameterList list;
  list.set("Which", "LM");
  list.set("Block Size", block);
  list.set("Num Blocks", std::min(n / block - 1, (1 << attempt) * std::max(2 * wanted, wanted + 40) / block + 1));
  list.set("Maximum Restarts", 50);
  list.set("Convergence Tolerance", 1e-11);
  list.set("Verbosity", 0);
  const auto problem = Teuchos::rcp(new Problem(inverse, toTpetra(scatteredNumbers(n, block, 23 + static_cast<std::uint64_t>(attempt)), map)));
  problem->setHermitian(false);
  problem->setNEV(wanted);
  bool converged = false;
  try {
    if (!problem->setProblem()) throw std::logic_error("it refused the eigenproblem.");
    converged = Manager(problem, list).solve() == Anasazi::Converged;
  } catch (const Error&) {
    throw;
  } catch (const std::exception& stopped) {
    throw ConvergenceError(std::string("Anasazi BlockKrylovSchur stopped in a quadratic eigenproblem: ") + stopped.what());
  }
  const auto& solution = problem->getSolution();
  if (!converged) return false;
  const Matrix columns = toEigen(*solution.Evecs).topRows(q.size());
  values.clear();
  vectors.resize(q.size(), solution.numVecs);
  for (int j = 0; j < solution.numVecs; ++j) {
    const auto z = static_cast<std::size_t>(j);
    const Complex nu(solution.Evals[z].realpart, solution.Evals[z].imagpart);
    values.push_back(q.shift + 1.0 / nu);
    // index 0: real; 1, -1: columns j and j+1 are the real and imaginary part of a pair, of which this is the first, the second
    if (solution.index[z] == 0) vectors.col(j) = columns.col(j).cast<Complex>();
    if (solution.index[z] == 1) vectors.col(j) = columns.col(j).cast<Complex>() + Complex(0, 1) * columns.col(j + 1).cast<Complex>();
    if (solution.index[z] == -1) vectors.col(j) = vectors.col(j - 1).conjugate();
  }
  return true;
}

}  // namespace

QuadraticModes lowestDampedModes(const Sparse& M, const Sparse& C, const Sparse& K, int count, const DofNamer& name) {
  const auto n = M.rows();
  if (M.cols() != n || C.rows() != n || C.cols() != n || K.rows() != n || K.cols() != n)
    throw ModelError("The mass, damping and stiffness matrices of a quadratic eigenproblem must be square and of one size.");
  if (count < 0 || count > n)
    throw ModelError(std::to_string(count) + " damped modes were asked for, but the eigenproblem has " + std::to_string(n) + " dofs.");
  std::vector<Complex> values;
  Eigen::MatrixXcd vectors;
  const int wanted = 2 * count + 4;
  bool found = false;
  if (n >= 100 && 6 * count <= n) {
    const Quadratic quadratic(M, C, K, name);
    for (int attempt = 0; attempt < 3 && !found; ++attempt) found = krylov(quadratic, wanted, attempt, values, vectors);
  }
  if (!found) {
    constexpr int largestDense = 1500;
    if (n > largestDense)
      throw ConvergenceError("The " + std::to_string(count) + " damped modes nearest zero of " + std::to_string(n) +
                             " dofs were not found by Anasazi BlockKrylovSchur in three attempts. Ask for fewer or more of them.");
    const auto all = dampedModes(Matrix(M), Matrix(C), Matrix(K));
    values.assign(all.values.data(), all.values.data() + all.values.size());
    vectors = all.vectors;
  }
  // One of each conjugate pair, by |s|.
  std::vector<Eigen::Index> order;
  for (std::size_t j = 0; j < values.size(); ++j)
    if (values[j].imag() >= 0) order.push_back(static_cast<Eigen::Index>(j));
  const auto value = [&](Eigen::Index j) { return values[static_cast<std::size_t>(j)]; };
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return std::abs(value(a)) < std::abs(value(b)); });
  if (static_cast<int>(order.size()) > count) order.resize(static_cast<std::size_t>(count));

  QuadraticModes modes;
  const auto kept = static_cast<Eigen::Index>(order.size());
  modes.values.resize(kept);
  modes.vectors.resize(n, kept);
  modes.residuals.resize(kept);
  const double m = rowNorm(M), c = rowNorm(C), k = rowNorm(K);
  for (Eigen::Index j = 0; j < kept; ++j) {
    const Complex s = value(order[static_cast<std::size_t>(j)]);
    Eigen::VectorXcd phi = vectors.col(order[static_cast<std::size_t>(j)]);
    Eigen::Index largest = 0;
    phi.cwiseAbs().maxCoeff(&largest);
    phi /= Complex(phi[largest]);
    const Eigen::VectorXcd residual = s * s * (M * phi) + s * (C * phi) + K * phi;
    modes.values[j] = s;
    modes.vectors.col(j) = phi;
    modes.residuals[j] = residual.cwiseAbs().maxCoeff() / (std::norm(s) * m + std::abs(s) * c + k);
    if (!(modes.residuals[j] <= 1e-8))
      throw ConvergenceError("Damped mode " + std::to_string(j + 1) + " has a residual of " + scientific(modes.residuals[j]) + ".");
  }
  return modes;
}

}  // namespace tooljoint::linalg
