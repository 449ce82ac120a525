// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/softstring/Buckling.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "common/Constants.hpp"

namespace tooljoint::softstring {
namespace BucklingTest {

using constants::degree;
constexpr double weight = 300.0, EI = 1.2e6, r = 0.045;

TEST(Buckling, OfAStraightInclinedHole) {
  for (const double inclination : {20.0, 60.0, 90.0}) {
    const auto point = well::straight(100, inclination * degree, 1.0)->at(50);
    const auto limits = bucklingLimits(point, weight, EI, r);
    const double F = 2 * std::sqrt(EI * weight * std::sin(inclination * degree) / r);
    EXPECT_NEAR(limits.sinusoidal, F, 1e-9 * F);
    EXPECT_NEAR(limits.helical, std::sqrt(2.0) * F, 1e-9 * F);
  }
}

TEST(Buckling, OfAVerticalHole) {
  const auto limits = bucklingLimits(well::straight(100)->at(50), weight, EI, r);
  EXPECT_NEAR(limits.sinusoidal, 2.55 * std::cbrt(EI * weight * weight), 1e-6);
  EXPECT_NEAR(limits.helical, 5.55 * std::cbrt(EI * weight * weight), 1e-6);
}

/// Horizontal turn: curvature and weight are orthogonal, N^2 = w^2 + (F kappa)^2, so that F^2
/// solves a quadratic equation.
TEST(Buckling, OfATurn) {
  well::WellPoint point;
  point.tangent = Vector3::UnitX();
  point.curvature = Vector3(0, 1.0 / 600, 0);
  const double c = 4 * EI / r, k = point.curvature.norm();
  const double square =
      0.5 * (c * c * k * k + std::sqrt(std::pow(c * k, 4) + 4 * c * c * weight * weight));
  const auto limits = bucklingLimits(point, weight, EI, r);
  EXPECT_NEAR(limits.sinusoidal, std::sqrt(square), 1e-9 * std::sqrt(square));
}

/// A build presses a compressed string against the low side by F kappa: N = w sin + F kappa.
TEST(Buckling, IsLaterInABuild) {
  const double inclination = 60 * degree, kappa = 1.0 / 800;
  well::WellPoint point;
  point.tangent = Vector3(std::sin(inclination), 0, std::cos(inclination));
  point.curvature = kappa * Vector3(std::cos(inclination), 0, -std::sin(inclination));
  const double c = 4 * EI / r, side = weight * std::sin(inclination);
  const double F = 0.5 * (c * kappa + std::sqrt(c * c * kappa * kappa + 4 * c * side));
  EXPECT_NEAR(bucklingLimits(point, weight, EI, r).sinusoidal, F, 1e-9 * F);
}

/// Mud presses a lighter string against the upper side with the same force as an equal weight.
TEST(Buckling, OfALightStringInHeavyMud) {
  const auto point = well::straight(100, 60 * degree)->at(50);
  const auto heavy = bucklingLimits(point, weight, EI, r),
             light = bucklingLimits(point, -weight, EI, r);
  EXPECT_NEAR(light.sinusoidal, heavy.sinusoidal, 1e-9 * heavy.sinusoidal);
  EXPECT_NEAR(light.helical, heavy.helical, 1e-9 * heavy.helical);
}

TEST(Buckling, NeedsClearance) {
  const auto point = well::straight(100, 1.0)->at(50);
  EXPECT_TRUE(std::isinf(bucklingLimits(point, weight, EI, 0.0).sinusoidal));
}

TEST(Buckling, HelicalSideForceIsThatOfTheEnergyOfAHelix) {
  EXPECT_NEAR(helicalSideForce(2e5, EI, r), r * 4e10 / (4 * EI), 1e-9);
}

}  // namespace BucklingTest
}  // namespace tooljoint::softstring
