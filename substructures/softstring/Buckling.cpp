// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/softstring/Buckling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "substructures/softstring/SoftString.hpp"

namespace tooljoint::softstring {
namespace {

/// Wu and Juvkam-Wold 1992: F = factor (E I w^2)^(1/3) in a vertical hole.
constexpr double verticalSinusoidal = 2.55, verticalHelical = 5.55;
/// Growth factor of the trial load in the root search; roots closer than this are not separated.
constexpr double growth = 1.05;
/// Upper end of the load search, as a multiple of the limits of a horizontal hole and of a bend
/// without weight.
constexpr double most = 1e3;

/// Least F > 0 with F^2 = factor^2 (E I/r) N(F).
double leastRoot(const well::WellPoint& point, double weight, double ratio, double factor) {
  const auto excess = [&](double F) {
    return F * F - factor * factor * ratio * sideForce(point, -F, weight);
  };
  const double scale =
      factor * std::sqrt(ratio * std::abs(weight)) + ratio * point.curvature.norm();
  double low = 0.0, high = 1e-4 * scale;
  while (excess(high) < 0.0 && high < most * scale) low = high, high *= growth;
  if (excess(high) < 0.0) return std::numeric_limits<double>::infinity();
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(middle) < 0.0 ? low : high) = middle;
  }
  return high;
}

/// The larger of the limits in a vertical hole and in an inclined or bent hole.
double limit(const well::WellPoint& point, double weight, double stiffness, double clearance,
             double vertical, double factor) {
  if (!(clearance > 0.0)) return std::numeric_limits<double>::infinity();
  return std::max(vertical * std::cbrt(stiffness * weight * weight),
                  leastRoot(point, weight, stiffness / clearance, factor));
}

}  // namespace

double helicalLimit(const well::WellPoint& point, double weight, double stiffness,
                    double clearance) {
  return limit(point, weight, stiffness, clearance, verticalHelical, 2.0 * std::sqrt(2.0));
}

BucklingLimits bucklingLimits(const well::WellPoint& point, double weight, double stiffness,
                              double clearance) {
  return {limit(point, weight, stiffness, clearance, verticalSinusoidal, 2.0),
          helicalLimit(point, weight, stiffness, clearance)};
}

double helicalSideForce(double compression, double stiffness, double clearance) {
  return clearance * compression * compression / (4.0 * stiffness);
}

}  // namespace tooljoint::softstring
