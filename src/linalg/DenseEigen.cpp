// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/Error.hpp"
#include "linalg/ComplexProduct.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "linalg/GeneralEigen.hpp"
#include "linalg/Scientific.hpp"
#include "linalg/trilinos/EigenChecks.hpp"
#include "linalg/trilinos/EigenSolver.hpp"

namespace tooljoint::linalg {

EigenPairs symmetricModes(const Matrix& K, const Matrix& M, const DofNamer& name) {
  const Sparse k = symmetricPart(K.sparseView(0.0, 0.0), "stiffness", name),
               m = symmetricPart(M.sparseView(0.0, 0.0), "mass", name);
  if (k.rows() != m.rows())
    throw ModelError("The stiffness and mass matrices of an eigenproblem must have the same size.");
  definitePivots(m, name);
  EigenPairs modes;
  modes.method = "dense symmetric pencil (Cholesky, tridiagonal QR)";
  if (k.rows() == 0) {
    modes.vectors.resize(0, 0);
    return modes;
  }
  const auto pairs = symmetricPairs(Matrix(k), Matrix(m));
  if (!pairs.converged)
    throw ConvergenceError("The QR iteration of a dense symmetric eigenproblem did not converge.");
  modes.values = pairs.values;
  modes.vectors = pairs.vectors;
  applyConventions(modes, m);
  recomputeErrors(modes, k, m, 1e-8, 1e-8);
  return modes;
}

namespace {

double maxNorm(const Matrix& A) {
  return A.size() == 0 ? 0.0 : A.cwiseAbs().rowwise().sum().maxCoeff();
}

/// Order: |Im s|, then Re s, then the negative imaginary part first; values that agree to rounding
/// are equal.
bool comesFirst(const std::complex<double>& a, const std::complex<double>& b, double rounding) {
  if (std::abs(std::abs(a.imag()) - std::abs(b.imag())) > rounding)
    return std::abs(a.imag()) < std::abs(b.imag());
  if (std::abs(a.real() - b.real()) > rounding) return a.real() < b.real();
  return a.imag() < b.imag();
}

/// Largest residual of an eigenvalue, max |Q(s) phi| / (|s|^2 |M| + |s| |C| + |K|), Q(s) = s^2 M +
/// s C + K; number of refinements for larger residuals.
constexpr double mostResidual = 1e-8;
constexpr int mostIterations = 3;

struct QuadraticPencil {
  QuadraticPencil(const Matrix& mass, const Matrix& damping, const Matrix& stiffness)
      : M(mass), C(damping), K(stiffness) {}

  double residual(std::complex<double> s, const Eigen::VectorXcd& phi) const {
    const Eigen::VectorXcd r = s * s * times(M, phi) + s * times(C, phi) + times(K, phi);
    const double size = std::norm(s) * normM + std::abs(s) * normC + normK;
    return size > 0.0 ? r.cwiseAbs().maxCoeff() / size : 0.0;
  }
  /// y = Q(s)^-1 Q'(s) phi, s <- s - phi_k / y_k (Ruhe, SIAM J. Numer. Anal. 10 (1973) 674-689).
  /// The QR iteration loses digits of eigenvalues far below the largest one (strong damping).
  void refine(std::complex<double>& s, Eigen::VectorXcd& phi) const {
    const Eigen::MatrixXcd Q = s * s * M + s * C + K;
    const Eigen::VectorXcd y = Q.partialPivLu().solve(times(C, phi) + 2.0 * s * times(M, phi));
    Eigen::Index k = 0;
    y.cwiseAbs().maxCoeff(&k);
    if (!y.allFinite() || y[k] == 0.0) return;  // Q(s) is singular: s is the eigenvalue
    s -= phi[k] / y[k];
    phi = y / y[k];
  }

  const Matrix &M, &C, &K;
  const double normM = maxNorm(M), normC = maxNorm(C), normK = maxNorm(K);
};

}  // namespace

QuadraticModes dampedModes(const Matrix& M, const Matrix& C, const Matrix& K) {
  const auto n = M.rows();
  if (M.cols() != n || C.rows() != n || C.cols() != n || K.rows() != n || K.cols() != n)
    throw ModelError(
        "The mass, damping and stiffness matrices of a quadratic eigenproblem must be square and "
        "of one size.");
  if (!M.allFinite() || !C.allFinite() || !K.allFinite())
    throw ModelError("A matrix of a quadratic eigenproblem has an entry that is not finite.");
  QuadraticModes modes;
  if (n == 0) return modes;
  const QuadraticPencil pencil{M, C, K};
  const Eigen::FullPivLU<Matrix> mass(M);
  if (!mass.isInvertible())
    throw ModelError("The mass matrix of a quadratic eigenproblem is singular.");
  // s = gamma mu balances the blocks: mu [x; y] = [0 I; -M^-1 K / gamma^2, -M^-1 C / gamma] [x; y],
  // y = mu x
  const Matrix stiff = mass.solve(K), damp = mass.solve(C);
  const double gamma =
      std::max({std::sqrt(maxNorm(stiff)), maxNorm(damp), std::numeric_limits<double>::min()});
  Matrix A = Matrix::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  A.bottomLeftCorner(n, n) = -stiff / (gamma * gamma);
  A.bottomRightCorner(n, n) = -damp / gamma;
  const auto pairs = generalPairs(A);
  if (!pairs.converged)
    throw ConvergenceError("The QR iteration of a quadratic eigenproblem did not converge.");

  std::vector<Eigen::Index> order(static_cast<std::size_t>(2 * n));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  const auto& mu = pairs.values;
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return comesFirst(mu[a], mu[b], 0.0); });
  // An insertion sort keeps conjugates and repeated values that are equal up to rounding in a
  // defined order.
  for (std::size_t i = 1; i < order.size(); ++i)
    for (std::size_t j = i; j > 0 && comesFirst(mu[order[j]], mu[order[j - 1]], 1e-11); --j)
      std::swap(order[j], order[j - 1]);

  modes.values.resize(2 * n);
  modes.vectors.resize(n, 2 * n);
  modes.residuals.resize(2 * n);
  for (Eigen::Index j = 0; j < 2 * n; ++j) {
    const Eigen::Index from = order[static_cast<std::size_t>(j)];
    std::complex<double> s = gamma * mu[from];
    // The larger one of x and y = mu x is the more accurate shape.
    const Eigen::VectorXcd top = pairs.vectors.col(from).head(n),
                           bottom = pairs.vectors.col(from).tail(n);
    Eigen::VectorXcd phi = std::abs(mu[from]) > 1.0 ? bottom : top;
    Eigen::Index largest = 0;
    phi.cwiseAbs().maxCoeff(&largest);
    phi /= phi[largest];
    double residual = pencil.residual(s, phi);
    for (int i = 0; i < mostIterations && residual > mostResidual; ++i) {
      pencil.refine(s, phi);
      residual = pencil.residual(s, phi);
    }
    modes.values[j] = s;
    modes.vectors.col(j) = phi;
    modes.residuals[j] = residual;
    if (!(modes.residuals[j] <= mostResidual))
      throw ConvergenceError("An eigenvalue of a quadratic eigenproblem has a residual of " +
                             scientific(modes.residuals[j]) + ".");
  }
  return modes;
}

}  // namespace tooljoint::linalg
