// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/trilinos/DampedPencil.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/Error.hpp"

namespace tooljoint::linalg {

namespace {

/// Largest relative change of a value by Newton's method for which the mode counts as the same.
constexpr double sameValue = 1e-6;

double rowNorm(const Sparse& A) {
  double largest = 0;
  for (int i = 0; i < A.outerSize(); ++i) {
    double row = 0;
    for (Sparse::InnerIterator it(A, i); it; ++it) row += std::abs(it.value());
    largest = std::max(largest, row);
  }
  return largest;
}

void requireOneSize(const Sparse& M, const Sparse& C, const Sparse& K) {
  const auto n = M.rows();
  if (M.cols() != n || C.rows() != n || C.cols() != n || K.rows() != n || K.cols() != n)
    throw ModelError(
        "The mass, damping and stiffness matrices of a quadratic eigenproblem must be square and "
        "of one size.");
}

}  // namespace

ScaledPencil::ScaledPencil(const Sparse& m, const Sparse& c, const Sparse& k,
                           const EnergyRounding& given) {
  requireOneSize(m, c, k);
  scale = binaryMassScale(k, m);
  const auto scaled = [&](const Sparse& A) {
    return Sparse(scale.asDiagonal() * A * scale.asDiagonal());
  };
  M = scaled(m);
  C = scaled(c);
  K = scaled(k);
  singularMass = hasSingularMass(m);
  rounding = [this, given, absolute = Sparse(K.cwiseAbs()),
              fraction = roundingOf(k)](const ComplexVector& phi) {
    if (given) return given(scale.cast<Complex>().cwiseProduct(phi));
    const Vector size = phi.cwiseAbs();
    return fraction * size.dot(absolute * size);
  };
}

bool isZero(const ScaledPencil& pencil, Complex s, const ComplexVector& phi) {
  const double work = std::norm(s) * std::abs(phi.dot(times(pencil.M, phi))) +
                      std::abs(s) * std::abs(phi.dot(times(pencil.C, phi))) +
                      std::abs(phi.dot(times(pencil.K, phi)));
  return work <= pencil.rounding(phi);
}

double roundingOfValue(const ScaledPencil& pencil, Complex distance, const ComplexVector& phi) {
  const Vector size = phi.cwiseAbs();
  return pencil.rounding(phi) /
         (std::norm(distance) *
          std::max(size.dot(pencil.M.cwiseAbs() * size), std::numeric_limits<double>::min()));
}

std::optional<DampedMode> refinedMode(const ScaledPencil& pencil, Complex s,
                                      const ComplexVector& phi) {
  const auto mode = refine(pencil.M, pencil.C, pencil.K, {s, phi});
  return mode && std::abs(mode->s - s) <= sameValue * std::abs(s) ? mode : std::nullopt;
}

QuadraticModes presented(const ScaledPencil& pencil, const DampedModes& found, int count) {
  QuadraticModes modes;
  std::vector<std::size_t> order(found.values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) {
    return std::abs(found.values[a]) < std::abs(found.values[b]);
  });
  order.resize(std::min(order.size(), static_cast<std::size_t>(count)));
  const auto kept = static_cast<Eigen::Index>(order.size());
  modes.values.resize(kept);
  modes.vectors.resize(pencil.size(), kept);
  modes.residuals.resize(kept);
  const double m = rowNorm(pencil.M), c = rowNorm(pencil.C), k = rowNorm(pencil.K);
  for (Eigen::Index j = 0; j < kept; ++j) {
    const Complex s = found.values[order[static_cast<std::size_t>(j)]];
    const ComplexVector& phi = found.vectors[order[static_cast<std::size_t>(j)]];
    const ComplexVector residual =
        s * s * times(pencil.M, phi) + s * times(pencil.C, phi) + times(pencil.K, phi);
    modes.residuals[j] = residual.cwiseAbs().maxCoeff() /
                         ((std::norm(s) * m + std::abs(s) * c + k) * phi.cwiseAbs().maxCoeff());
    ComplexVector shape = pencil.scale.cast<Complex>().cwiseProduct(phi);
    Eigen::Index largest = 0;
    shape.cwiseAbs().maxCoeff(&largest);
    modes.values[j] = s;
    modes.vectors.col(j) = shape / Complex(shape[largest]);
  }
  return modes;
}

}  // namespace tooljoint::linalg
