// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Indicators of vibration at and above the cut-off of the basis of a reduced motion.
#include <cmath>
#include <gtest/gtest.h>
#include <utility>

#include "Models.hpp"
#include "common/Constants.hpp"

namespace tooljoint::transient::testing {
namespace BasisLimitsTest {

/// Two modes of one part, free: in the mean over whole periods the kinetic energy of each is a
/// quarter of w^2 q(0)^2. The higher one is above half the cut-off, the lower one below.
TEST(BasisLimits, sayWhatPartOfTheEnergyIsWhereModesEnd) {
  const double low = 20, high = 100;
  auto model =
      denseModel(2 * Matrix::Identity(2, 2), Matrix(),
                 2 * (Vector(2) << low * low, high * high).finished().asDiagonal().toDenseMatrix());
  model.dofs = {model::DofLabel::modal(0, 0), model::DofLabel::modal(0, 1)};
  model.initialDisplacement << 0.3, 0.03;
  const double expected =
      std::pow(high * 0.03, 2) / (std::pow(low * 0.3, 2) + std::pow(high * 0.03, 2));
  for (const auto& [cutOff, share] :
       {std::pair{high, expected}, {2.1 * high, 0.0}, {0.3 * high, 1.0}}) {
    RunHooks hooks;
    hooks.cutOffs = {cutOff};
    Keep samples;
    const double end = 20 * constants::pi / low;
    const auto report = integrate(model, options("RK4", end, 1e-4, 1e-3), samples, hooks);
    EXPECT_NEAR(report.cutOffEnergy, share, 0.01 * share) << cutOff;
  }
  Keep samples;
  EXPECT_EQ(integrate(model, options("RK4", 0.1, 1e-4, 1e-3), samples).cutOffEnergy, 0.0);
}

/// A boundary that swings with q = A cos(W t) drives a missing mode of frequency w, which is at
/// rest at first, to eta = l W^2 A / (w^2 - W^2) (cos W t - cos w t).
TEST(BasisLimits, sayWhatEnergyMissingModesWouldHave) {
  const double mass = 2, frequency = 20, higher = 60, row = 0.7;
  const auto model = oscillator(mass, 0, mass * frequency * frequency, 0.3, 0);
  const double squares = higher * higher - frequency * frequency;
  const double expected =
      std::pow(row * frequency / squares, 2) * (frequency * frequency + higher * higher) / mass;
  for (const char* integrator : {"RK4", "Generalized-alpha"}) {
    RunHooks hooks;
    hooks.missing = {{higher, 0.0, Vector::Constant(1, row)},
                     {higher, 1e4 * higher, Vector::Constant(1, row)}};  // damped: it rests
    Keep samples;
    const double end = 20 * constants::pi / frequency;
    const auto report = integrate(model, options(integrator, end, 1e-4, 1e-3), samples, hooks);
    EXPECT_NEAR(report.missingEnergy, expected, 0.01 * expected) << integrator;
  }
}

}  // namespace BasisLimitsTest
}  // namespace tooljoint::transient::testing
