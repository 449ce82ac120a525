// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Rebounds: a mass that falls on a wall far too stiff for the step comes back as the law says, at
/// every step, spectral radius and place within a step; contact that rests costs no short steps.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <tuple>

#include "Models.hpp"

namespace tooljoint::transient::testing {
namespace {

constexpr double mass = 3, gravity = 9.81, drop = 0.02;

/// A mass that falls from `drop` and some more on a floor.
model::SecondOrderModel fallingMass(double k, double c, double more) {
  auto model = denseModel(Matrix::Constant(1, 1, mass), Matrix(), Matrix::Zero(1, 1));
  model.loads.push_back({"weight", Vector::Constant(1, -mass * gravity), 0});
  model.initialDisplacement[0] = drop + more;
  addFloor(model, k, c, 7e11);
  return model;
}

/// Height of the first apex beside that of the drop, from the energy in free flight at 0.08 s.
double apex(const model::SecondOrderModel& model, const TransientOptions& o) {
  Keep samples;
  integrate(model, o, samples);
  const double q = samples.q.back()[0], v = samples.v.back()[0];
  EXPECT_GT(q, 0.0);
  EXPECT_GT(v * v, 0.0);
  return (q + v * v / (2 * gravity)) / model.initialDisplacement[0];
}

class Rebound : public ::testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(Rebound, IsThatOfAnElasticWall) {
  const auto [h, radius] = GetParam();
  for (double k : {1e7, 1e9, 1e11})
    for (int phase = 0; phase < 5; ++phase) {
      auto o = options("Generalized-alpha", 0.08, h, 0.08);
      o.own.set("Spectral Radius", radius);
      // the fall takes 64 ms: half a step of 5 ms is 2.4 mm more
      const double more = phase * 0.2 * h * std::sqrt(2 * gravity * drop);
      EXPECT_NEAR(apex(fallingMass(k, 0, more), o), 1.0, 0.02) << k << " " << phase;
    }
}

/// k and c for which half of the velocity comes back: e = 0.5 of a spring and a dashpot that push
/// only, with zeta = -ln(e) / sqrt(pi^2 + ln(e)^2) about; the truth is that of steps of 0.1 us.
TEST_P(Rebound, IsThatOfALossyWall) {
  const auto [h, radius] = GetParam();
  for (double zeta : {0.05, 0.2, 0.35}) {
    const double k = 1e9, c = 2 * zeta * std::sqrt(k * mass);
    const double truth = apex(fallingMass(k, c, 0), options("RK4", 0.08, 5e-7, 0.08));
    auto o = options("Generalized-alpha", 0.08, h, 0.08);
    o.own.set("Spectral Radius", radius);
    EXPECT_NEAR(apex(fallingMass(k, c, 0), o), truth, 0.02) << zeta;
  }
}

INSTANTIATE_TEST_SUITE_P(Steps, Rebound,
                         ::testing::Combine(::testing::Values(1e-4, 1e-3, 5e-3),
                                            ::testing::Values(0.0, 0.2, 0.5, 0.8, 1.0)));

/// Once a mass rests on a stiff wall, a slow change of its load needs no short steps.
TEST(Impacts, AtRestStepsAreLongAgain) {
  auto model = fallingMass(1e10, 1e5, 0);
  const int law = model.lawIndex({"breath", [](double t) { return std::sin(20 * t); }});
  model.loads.push_back({"breath", Vector::Constant(1, 0.5 * mass * gravity), law});
  Keep samples;
  const auto first = integrate(model, options("Generalized-alpha", 2.0, 1e-3, 0.1), samples);
  const auto longer = integrate(model, options("Generalized-alpha", 4.0, 1e-3, 0.1), samples);
  EXPECT_LE(longer.counters.steps - first.counters.steps, 2100);
}

}  // namespace
}  // namespace tooljoint::transient::testing
