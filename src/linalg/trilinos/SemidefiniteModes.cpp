// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/trilinos/SemidefiniteModes.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "linalg/factor/MumpsFactor.hpp"
#include "linalg/trilinos/EigenChecks.hpp"

namespace tooljoint::linalg {

namespace {

/// An eigenvalue of M below this fraction of the largest one counts as zero (rows scaled to unit
/// diagonal).
constexpr double massless = 1e-13;
/// An eigenvalue of the shift-inverted operator below this fraction of the largest one belongs to
/// an infinite eigenvalue of the pencil.
constexpr double infinite = 1e-13;
/// Largest ratio of a shift and a value, either way: beyond it the value loses more than six
/// digits.
constexpr double reach = 1e6;
/// A value below this part of the first shift may be that of a rigid-body motion.
constexpr double rigid = 1e-9;

/// M = W W'; the number of columns of W is the rank of M.
Matrix root(const Sparse& M, const DofNamer& name) {
  std::vector<Eigen::Index> massive;
  const Vector diagonal = M.diagonal();
  for (Eigen::Index i = 0; i < M.rows(); ++i) {
    if (diagonal[i] > 0) massive.push_back(i);
    if (diagonal[i] < 0)
      throw ModelError("The mass of " + nameOf(name, static_cast<int>(i)) +
                       " is negative: " + formatNumber(diagonal[i]) + ".");
  }
  const auto n = static_cast<Eigen::Index>(massive.size());
  const Matrix dense = M;
  Matrix scaled(n, n);
  const auto size = [&](Eigen::Index i) {
    return std::sqrt(diagonal[massive[static_cast<std::size_t>(i)]]);
  };
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      scaled(i, j) =
          dense(massive[static_cast<std::size_t>(i)], massive[static_cast<std::size_t>(j)]) /
          (size(i) * size(j));
  if (n == 0) return Matrix::Zero(M.rows(), 0);
  const auto spectrum = symmetricPairs(scaled);
  const Vector& values = spectrum.values;
  Eigen::Index first = 0;
  while (first < n && values[first] <= massless * values[n - 1]) ++first;
  if (values[0] < -1e-9 * values[n - 1]) {
    Eigen::Index worst = 0;
    spectrum.vectors.col(0).cwiseAbs().maxCoeff(&worst);
    throw ModelError("The mass matrix is indefinite, most strongly in " +
                     nameOf(name, static_cast<int>(massive[static_cast<std::size_t>(worst)])) +
                     ".");
  }
  Matrix W = Matrix::Zero(M.rows(), n - first);
  for (Eigen::Index i = 0; i < n; ++i)
    W.row(massive[static_cast<std::size_t>(i)]) =
        size(i) * spectrum.vectors.row(i).tail(n - first).cwiseProduct(
                      values.tail(n - first).cwiseSqrt().transpose());
  return W;
}

/// Approximate middle of the spectrum, on a logarithmic scale.
double middle(const Sparse& K, const Sparse& M) {
  double sum = 0;
  int count = 0;
  for (Eigen::Index i = 0; i < K.rows(); ++i)
    if (M.coeff(i, i) > 0 && K.coeff(i, i) != 0.0) {
      sum += std::log(std::abs(K.coeff(i, i)) / M.coeff(i, i));
      ++count;
    }
  return count > 0 ? std::exp(sum / count) : 1.0;
}

/// The dof with the largest displacement in the null vector of A.
int mostMovedByKernel(const Matrix& A) {
  const auto spectrum = symmetricPairs(A);
  Eigen::Index least = 0, dof = 0;
  spectrum.values.cwiseAbs().minCoeff(&least);
  spectrum.vectors.col(least).cwiseAbs().maxCoeff(&dof);
  return static_cast<int>(dof);
}

/// Modes from one shift: W' (K - sigma M)^-1 W y = mu y.
EigenPairs shifted(const Matrix& K, const Sparse& M, const Matrix& W, double sigma, int count,
                   const DofNamer& name) {
  const Matrix A = K - sigma * Matrix(M);
  const DenseLu factor(A);
  if (!(factor.reciprocalCondition() > 1e-18))
    throw SingularPencil(nameOf(name, mostMovedByKernel(A)));
  Matrix answer = factor.solve(W);
  answer += factor.solve(Matrix(W - (K * answer - sigma * (M * answer))));
  Matrix H = W.transpose() * answer;
  H = (0.5 * (H + H.transpose())).eval();
  const auto spectrum = symmetricPairs(H);
  const Vector& mu = spectrum.values;
  const double largest = mu.size() > 0 ? mu.cwiseAbs().maxCoeff() : 0.0;
  std::vector<Eigen::Index> finite;
  for (Eigen::Index i = 0; i < mu.size(); ++i)
    if (std::abs(mu[i]) > infinite * largest) finite.push_back(i);
  std::sort(finite.begin(), finite.end(),
            [&](auto a, auto b) { return sigma + 1 / mu[a] < sigma + 1 / mu[b]; });
  if (count >= 0 && count < static_cast<int>(finite.size()))
    finite.resize(static_cast<std::size_t>(count));
  EigenPairs modes;
  modes.values.resize(static_cast<Eigen::Index>(finite.size()));
  modes.vectors.resize(K.rows(), modes.values.size());
  for (std::size_t j = 0; j < finite.size(); ++j) {
    const auto column = static_cast<Eigen::Index>(j);
    modes.vectors.col(column) = answer * spectrum.vectors.col(finite[j]);
    const auto x = modes.vectors.col(column);
    modes.values[column] = x.dot(K * x) / x.dot(M * x);
  }
  return modes;
}

/// The largest positive value below `end`, 0 if there is none.
double largestBelow(double end, const Vector& values) {
  double largest = 0;
  for (const double value : values)
    if (value < end) largest = std::max(largest, value);
  return largest;
}

/// Modes from the first shift, and again from shifts among the wanted values until each mode comes
/// from a shift within `reach` of its value: very light dofs vibrate decades above the others.
EigenPairs fromShifts(const Matrix& K, const Sparse& M, const Matrix& W, double first, int count,
                      const DofNamer& name) {
  EigenPairs modes = shifted(K, M, W, -first, count, name);
  double end = std::numeric_limits<double>::infinity();
  bool again = count > 0;
  while (true) {
    const double wanted = largestBelow(end, modes.values);
    const bool inReach = wanted <= reach * first && first <= reach * wanted;
    if (wanted == 0.0 || (!again && (inReach || wanted <= rigid * first))) break;
    double begin = wanted / reach;
    if (largestBelow(begin, modes.values) <= rigid * first) begin = 0;
    const EigenPairs better = shifted(K, M, W, -wanted, count, name);
    for (int k = 0; k < std::min(modes.count(), better.count()); ++k) {
      const double size = std::abs(modes.values[k]);
      if (size < begin || size >= end) continue;
      modes.values[k] = better.values[k];
      modes.vectors.col(k) = better.vectors.col(k);
    }
    end = begin;
    again = false;
  }
  return modes;
}

/// Forces, displacements and modal amplitudes are coordinates of one model, so the condition of K -
/// sigma M depends on their units. Of the given units and those with equal masses (powers of two),
/// the better conditioned ones are chosen.
Vector betterScale(const Sparse& K, const Sparse& M, double sigma) {
  const Matrix A = Matrix(K) - sigma * Matrix(M);
  Vector given = Vector::Ones(K.rows()), masses = binaryMassScale(K, M);
  if (A.rows() == 0) return given;
  const auto condition = [&](const Vector& d) {
    return DenseLu(d.asDiagonal() * A * d.asDiagonal()).reciprocalCondition();
  };
  return condition(masses) > condition(given) ? masses : given;
}

}  // namespace

EigenPairs semidefiniteModes(const Sparse& K, const Sparse& M, int count,
                             const EigenOptions& options) {
  if (K.rows() != M.rows())
    throw ModelError("The stiffness and mass matrices of an eigenproblem must have the same size.");
  const Sparse stiffness = symmetricPart(K, "stiffness", options.name),
               mass = symmetricPart(M, "mass", options.name);
  const Vector scale =
      betterScale(stiffness, mass, options.shift.value_or(-middle(stiffness, mass)));
  const Sparse k = scale.asDiagonal() * stiffness * scale.asDiagonal(),
               m = scale.asDiagonal() * mass * scale.asDiagonal();
  const Matrix W = root(m, options.name), dense = k;
  if (W.cols() == 0) {  // no mass: no finite modes
    EigenPairs none;
    none.values.resize(0);
    none.vectors.resize(K.rows(), 0);
    none.method = "no mass";
    return none;
  }
  EigenPairs modes = options.shift ? shifted(dense, m, W, *options.shift, count, options.name)
                                   : fromShifts(dense, m, W, middle(k, m), count, options.name);
  modes.method = "dense, singular mass";
  modes.vectors = (scale.asDiagonal() * modes.vectors).eval();
  applyConventions(modes, mass);
  recomputeErrors(modes, stiffness, mass, options.tolerance, options.orthogonality);
  return modes;
}

bool hasSingularMass(const Sparse& M) {
  const Vector diagonal = M.diagonal();
  if (!(diagonal.array() > 0).all()) return true;
  if (suitsMumps(M)) return !isDefinite(M, massless);
  const Vector scale = diagonal.cwiseSqrt().cwiseInverse();
  const Eigen::SparseMatrix<double> scaled = scale.asDiagonal() * M * scale.asDiagonal();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(scaled);
  return factor.info() != Eigen::Success ||
         (M.rows() > 0 && factor.vectorD().minCoeff() <= massless);
}

bool hasMasslessMotion(const Sparse& M) {
  return (M.diagonal().array() == 0.0).any() || (!suitsMumps(M) && hasSingularMass(M));
}

EigenPairs lowestFiniteModes(const Sparse& K, const Sparse& M, int count,
                             const EigenOptions& options) {
  return hasMasslessMotion(M) ? semidefiniteModes(K, M, count, options)
                              : lowestModes(K, M, count, options);
}

}  // namespace tooljoint::linalg
