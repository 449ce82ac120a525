// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Motions of a straight beam that Hermite elements represent exactly, and integrals along it:
/// closed forms for element matrices.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "common/Types.hpp"

namespace tooljoint::testing_ {

/// c_0 + c_1 z + c_2 z^2 + c_3 z^3.
struct Cubic {
  std::array<double, 4> c{};
  double value(double z) const { return c[0] + z * (c[1] + z * (c[2] + z * c[3])); }
  double slope(double z) const { return c[1] + z * (2.0 * c[2] + 3.0 * z * c[3]); }
  double curvature(double z) const { return 2.0 * c[2] + 6.0 * z * c[3]; }
};

/// u, v cubic, w and theta_z linear in z; theta_y = u', theta_x = -v'.
struct PolynomialMotion {
  Cubic u, v, w, twist;

  /// u, v, w, theta_x, theta_y, theta_z at z.
  Eigen::Matrix<double, 6, 1> at(double z) const {
    Eigen::Matrix<double, 6, 1> d;
    d << u.value(z), v.value(z), w.value(z), -v.slope(z), u.slope(z), twist.value(z);
    return d;
  }
  /// Six dofs per node.
  Vector dofs(const std::vector<double>& z) const {
    Vector d(6 * static_cast<Eigen::Index>(z.size()));
    for (std::size_t i = 0; i < z.size(); ++i)
      d.segment<6>(6 * static_cast<Eigen::Index>(i)) = at(z[i]);
    return d;
  }
};

/// Two motions with nothing in common, for bilinear forms.
inline PolynomialMotion firstMotion() {
  return {{{0.3, -0.2, 0.11, 0.07}},
          {{-0.1, 0.4, -0.05, 0.09}},
          {{0.2, -0.6, 0.0, 0.0}},
          {{0.5, 0.3, 0.0, 0.0}}};
}
inline PolynomialMotion secondMotion() {
  return {{{-0.7, 0.1, 0.21, -0.04}},
          {{0.6, 0.15, 0.12, 0.03}},
          {{-0.3, 0.25, 0.0, 0.0}},
          {{0.1, -0.8, 0.0, 0.0}}};
}

/// int_a^b f dz, exact for polynomials up to degree 7 (Gauss with four points).
inline double integral(double a, double b, const std::function<double(double)>& f) {
  const std::array<double, 2> x{std::sqrt(3.0 / 7.0 - 2.0 / 7.0 * std::sqrt(1.2)),
                                std::sqrt(3.0 / 7.0 + 2.0 / 7.0 * std::sqrt(1.2))};
  const std::array<double, 2> w{(18.0 + std::sqrt(30.0)) / 36.0, (18.0 - std::sqrt(30.0)) / 36.0};
  double sum = 0.0;
  for (std::size_t i = 0; i < 2; ++i)
    for (const double sign : {-1.0, 1.0})
      sum += w[i] * f(0.5 * (a + b) + 0.5 * (b - a) * sign * x[i]);
  return 0.5 * (b - a) * sum;
}

}  // namespace tooljoint::testing_
