// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/trilinos/ProportionalModes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "common/Constants.hpp"

namespace tooljoint::linalg {

namespace {

using constants::epsilon;

/// Whether a_ij - a_ji is rounding of the entries.
bool isSymmetric(const Sparse& A) {
  const Sparse transposed = A.transpose(), difference = A - transposed;
  const double largest = A.nonZeros() > 0 ? A.coeffs().cwiseAbs().maxCoeff() : 0.0;
  const Vector diagonal = A.diagonal().cwiseAbs();
  for (int i = 0; i < difference.outerSize(); ++i)
    for (Sparse::InnerIterator it(difference, i); it; ++it) {
      const double scale = std::sqrt(diagonal[i] * diagonal[it.col()]);
      if (std::abs(it.value()) > 64.0 * epsilon * (scale > 0.0 ? scale : largest)) return false;
    }
  return true;
}

/// Proportional damping, including none: C = alpha M + beta K to 1e-12 of the size of the rows,
/// which allows for rounding of the entries and of the fit.
struct Proportional {
  double alpha = 0, beta = 0;
  bool isThat(const ScaledPencil& pencil) const {
    const Sparse difference = pencil.C - alpha * pencil.M - beta * pencil.K;
    const Vector size = std::abs(alpha) * pencil.M.diagonal().cwiseAbs() +
                        std::abs(beta) * pencil.K.diagonal().cwiseAbs();
    for (int i = 0; i < difference.outerSize(); ++i)
      for (Sparse::InnerIterator it(difference, i); it; ++it)
        if (std::abs(it.value()) > 1e-12 * std::sqrt(size[i] * size[it.col()])) return false;
    return true;
  }
};

/// Uses only one coefficient if that is enough: the other one would be rounding, and rigid-body
/// motions would have s other than 0.
std::optional<Proportional> proportionalDamping(const ScaledPencil& pencil) {
  const double mm = pencil.M.squaredNorm(), kk = pencil.K.squaredNorm(),
               mk = pencil.M.cwiseProduct(pencil.K).sum();
  const double cm = pencil.C.cwiseProduct(pencil.M).sum(),
               ck = pencil.C.cwiseProduct(pencil.K).sum(), determinant = mm * kk - mk * mk;
  std::vector<Proportional> fits{{0.0, kk > 0 ? ck / kk : 0.0}, {mm > 0 ? cm / mm : 0.0, 0.0}};
  if (determinant > 1e-12 * mm * kk)
    fits.push_back({(cm * kk - ck * mk) / determinant, (ck * mm - cm * mk) / determinant});
  for (const auto& fit : fits)
    if (fit.isThat(pencil)) return fit;
  return std::nullopt;
}

/// Roots with Im s >= 0 of s^2 + c s + lambda = 0; a double zero once.
std::vector<Complex> roots(double c, double lambda) {
  const double square = 0.25 * c * c - lambda;
  if (square < 0) return {Complex(-0.5 * c, std::sqrt(-square))};
  const double far = -(0.5 * c + std::copysign(std::sqrt(square), c));
  if (far == 0.0) return {Complex(0)};
  return {Complex(far), Complex(lambda / far)};
}

}  // namespace

std::optional<DampedModes> proportionalModes(const ScaledPencil& pencil, int count,
                                             const DofNamer& name) {
  if (!isSymmetric(pencil.K)) return std::nullopt;
  const auto damping = proportionalDamping(pencil);
  if (!damping) return std::nullopt;
  EigenOptions options;
  options.name = name;
  const auto n = static_cast<int>(pencil.size());
  const int most = std::min(n, std::max(16 * count, 200));
  for (int asked = std::min(n, count);; asked = std::min(most, 2 * asked)) {
    const EigenPairs pairs = lowestModes(pencil.K, pencil.M, asked, options);
    DampedModes modes;
    std::vector<double> sizes;
    for (int j = 0; j < pairs.count(); ++j) {
      const ComplexVector phi = pairs.vectors.col(j).cast<Complex>();
      const double lambda =
          std::abs(pairs.values[j]) <= pencil.rounding(phi) ? 0.0 : pairs.values[j];
      for (const Complex& s : roots(damping->alpha + damping->beta * lambda, lambda)) {
        modes.values.push_back(s);
        modes.vectors.push_back(phi);
        sizes.push_back(std::abs(s));
      }
    }
    if (asked == n) return modes;
    std::sort(sizes.begin(), sizes.end());
    const double last = std::max(0.0, pairs.values[pairs.count() - 1]),
                 spread = std::abs(damping->alpha) + std::abs(damping->beta) * last;
    const double known = spread > 0 ? std::min(std::sqrt(last), last / spread) : std::sqrt(last);
    if (sizes[static_cast<std::size_t>(count) - 1] <= known) return modes;
    if (asked == most) return std::nullopt;
  }
}

}  // namespace tooljoint::linalg
