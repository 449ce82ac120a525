// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The laws of velocity-weakening friction and of drives: forces against their formulas, tangents
/// against differences.
#include <cmath>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "model/laws/PointLawRegistry.hpp"
#include "tests/unit/model/OnePoint.hpp"

namespace DrillingLawsTest {

using namespace tooljoint;
using namespace tooljoint::model;
using namespace tooljoint::model::testing;

std::shared_ptr<const PointLaw> stribeck() {
  Teuchos::ParameterList own;
  own.set("Static Force", 800.0).set("Dynamic Force", 500.0).set("Decay Velocity", 2.0);
  own.set("Viscous Damping", 30.0).set("Slip Velocity", 0.1);
  return PointLawRegistry::instance().make("Stribeck", own, {1, 1});
}

std::shared_ptr<const PointLaw> control(double limit) {
  Teuchos::ParameterList own;
  own.set("Speed", 3.0).set("Proportional Gain", 50.0).set("Integral Gain", 20.0);
  own.set("Initial Force", 7.0).set("Force Limit", limit);
  return PointLawRegistry::instance().make("Speed Control", own, {1, 1});
}

TEST(Stribeck, WeakensFromTheStaticToTheDynamicForce) {
  const auto law = stribeck();
  for (const double v : {0.1, 0.5, 2.0, 40.0})
    EXPECT_NEAR(forces(*law, 0, {0}, {v}, {})[0], -30 * v - (500 + 300 * std::exp(-v / 2.0)), 1e-9);
  EXPECT_NEAR(forces(*law, 0, {0}, {-2.0}, {})[0], -forces(*law, 0, {0}, {2.0}, {})[0], 1e-12);
  EXPECT_DOUBLE_EQ(forces(*law, 0, {0}, {0.0}, {})[0], 0.0);
  // half the slip velocity: 0.5 (3 - 0.25)/2 of the dry friction
  EXPECT_NEAR(forces(*law, 0, {0}, {0.05}, {})[0], -1.5 - 0.6875 * (500 + 300 * std::exp(-0.025)),
              1e-9);
  for (const double v : {-3.0, -0.04, 0.03, 0.7}) expectTangents(*law, {0.1}, {v}, {}, 1e-6, 1e-6);
}

TEST(Stribeck, RefusesFrictionThatGrowsWithSpeed) {
  Teuchos::ParameterList own("here");
  own.set("Static Force", 1.0).set("Dynamic Force", 2.0).set("Decay Velocity", 1.0);
  EXPECT_THROW(PointLawRegistry::instance().make("Stribeck", own, {1, 1}), DeckError);
}

/// All losses are friction or viscous: their sum is the power of the force.
TEST(Stribeck, LosesThePowerOfItsForce) {
  const auto law = stribeck();
  const double v = 1.3, d = 0;
  const auto p = stateful(*law)->powers(0, thePoint, &d, &v, nullptr, nullptr);
  EXPECT_NEAR(p.damping, 30 * v * v, 1e-12);
  EXPECT_NEAR(p.damping + p.friction, -forces(*law, 0, {0}, {v}, {})[0] * v, 1e-9);
}

/// F_0 + k_p (V - v) + k_i (V (t - t_0) - (d - d_0) + x).
TEST(SpeedControl, IntegratesTheSpeedErrorFromItsStart) {
  const auto law = control(1e9);
  const std::vector<double> d0{5.0}, v0{1.0};
  std::vector<double> x(3);
  stateful(*law)->initialState(2.0, d0.data(), v0.data(), x.data());
  EXPECT_NEAR(forces(*law, 2.0, d0, v0, x)[0], 7 + 50 * 2.0, 1e-12);
  EXPECT_NEAR(forces(*law, 2.5, {5.4}, {2.0}, x)[0], 7 + 50 * 1.0 + 20 * (1.5 - 0.4), 1e-12);
  expectTangents(*law, {5.4}, {2.0}, x, 1e-6, 1e-6);
}

/// The force stays within the limit, and the state removes the excess from the integral at the rate
/// (F_max - f)/k_p.
TEST(SpeedControl, HoldsItsLimitAndTheIntegral) {
  const auto law = control(60.0);
  const std::vector<double> d{0.0};
  for (const double v : {0.0, 8.0}) {
    std::vector<double> x(3), f(1), g(1);
    stateful(*law)->initialState(0.0, d.data(), &v, x.data());
    stateful(*law)->forces(0.0, thePoint, d.data(), &v, x.data(), f.data(), g.data());
    const double wanted = 7 + 50 * (3 - v);
    EXPECT_DOUBLE_EQ(f[0], wanted > 0 ? 60.0 : -60.0);
    EXPECT_NEAR(g[0], (f[0] - wanted) / 50, 1e-12);
  }
}

}  // namespace DrillingLawsTest
