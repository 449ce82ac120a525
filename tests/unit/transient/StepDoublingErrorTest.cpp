// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Steps taken a second time as halves: what they measure, and that the run does not notice them.
#include "transient/accuracy/StepDoublingError.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "Models.hpp"
#include "common/Constants.hpp"
#include "transient/accuracy/StepAccuracy.hpp"

namespace tooljoint::transient::testing {
namespace {

/// D of a free vibration with wh radians per step, uncorrected.
double ofVibration(double wh) {
  constexpr double w = 10;
  Keep samples;
  auto o = options("Generalized-alpha", 2000 * wh / w, wh / w, 100 * wh / w);
  o.own.set("Phase Correction", false);
  o.own.set("Spectral Radius", 1.0);
  o.own.set("Tolerance", 1e-12);
  o.own.set("Accept Coarse Steps", true);
  return integrate(oscillator(1.0, 0.0, w * w, 0.3, 0.0), o, samples).stepErrors.stepDoubling;
}

/// Without damping (r = 1) the scheme is the trapezoidal rule, which turns (q, v/w) by 2 atan(wh/2)
/// and keeps its length. A step and its halves end apart by b = |2 atan(wh/2) - 4 atan(wh/4)|; v
/// changes by a = 2 atan(wh/2): over many phases |e_v|^2 : |v|^2 : |dv|^2 = 4 sin^2 b/2 : 1 : 4
/// sin^2 a/2, so D^2 = 4 sin^2(b/2) / (2 sin(a/2)). Of sin^2, which |e_v|^2 follows, the lower
/// three quarters have the mean 1/2 - sin(3 pi/4) / (3 pi/2).
TEST(StepDoublingError, measuresThePhaseThatAStepLoses) {
  for (double wh : {0.05, 0.2, 0.8}) {
    const double a = 2 * std::atan(wh / 2), b = a - 4 * std::atan(wh / 4);
    const double kept = 2 * (0.5 - std::sin(0.75 * constants::pi) / (1.5 * constants::pi));
    const double expected =
        std::sqrt(kept * 4 * std::pow(std::sin(b / 2), 2) / (2 * std::sin(a / 2)));
    EXPECT_NEAR(ofVibration(wh), expected, 0.1 * expected) << wh;
  }
}

TransientReport drop(double tolerance, double end, Keep& samples) {
  auto o = options("Generalized-alpha", end, 1e-3, 0.005);
  o.own.set("Tolerance", tolerance);
  o.own.set("Accept Coarse Steps", true);
  return integrate(droppedBalls(6, 1e6, 2e3, 7e11, 2e4), o, samples);
}

/// The longer the run, the further apart the steps looked at: same motion, same counts, to the last
/// digit.
TEST(StepDoublingError, leavesTheRunAlone) {
  Keep brief, whole;
  const auto first = drop(1e-5, 0.1, brief);
  const auto second = drop(1e-5, 2.0, whole);
  EXPECT_GT(first.stepErrors.stepDoubling, 0.0);
  EXPECT_NE(first.stepErrors.stepDoubling, second.stepErrors.stepDoubling);
  ASSERT_EQ(brief.q.size(), 21u);
  for (std::size_t i = 0; i < brief.q.size(); ++i) {
    EXPECT_EQ(brief.q[i], whole.q[i]) << i;
    EXPECT_EQ(brief.v[i], whole.v[i]) << i;
    EXPECT_EQ(brief.a[i], whole.a[i]) << i;
  }
  EXPECT_GE(first.counters.steps, 100);
}

/// Balls that lie on a wall too stiff for the step have a velocity that depends on its length; no
/// halves differ by it.
TEST(StepDoublingError, contactThatLastsIsNoError) {
  auto model = droppedBalls(10, 1e8, 0, 7e11, 2e5);
  model.loads[0].vector *= 20;
  Keep samples;
  auto o = options("Generalized-alpha", 2.0, 2e-3, 0.01);
  o.own.set("Spectral Radius", 0.2);
  o.own.set("Accept Coarse Steps", true);
  o.own.set("Resolve Impacts", false);
  const auto errors = integrate(model, o, samples).stepErrors;
  EXPECT_GT(samples.v.back().norm(), 0.01);
  EXPECT_GT(errors.local, 1e-3);
  EXPECT_LT(errors.stepDoubling, 1e-4);
}

TEST(StepDoublingError, isWeighedBesideTheLocalError) {
  EXPECT_EQ(assess({0.0, 0.0}), StepVerdict::Good);
  EXPECT_EQ(assess({0.0005, 0.2}), StepVerdict::Good);       // rest
  EXPECT_EQ(assess({0.0062, 0.0258}), StepVerdict::Coarse);  // sticking points
  EXPECT_EQ(assess({0.0105, 0.0378}), StepVerdict::Coarse);
  EXPECT_EQ(assess({0.005, 0.024}), StepVerdict::TooLarge);  // what contact and iterations spoil
  EXPECT_EQ(assess({0.022, 0.025}), StepVerdict::TooLarge);
  EXPECT_EQ(assess({0.003, 0.003}), StepVerdict::Good);
  EXPECT_EQ(assess({0.017, 0.08}), StepVerdict::TooLarge);
  EXPECT_EQ(assess({0.017, 0.005}), StepVerdict::Coarse);
  EXPECT_EQ(assess({0.03, 0.0}), StepVerdict::TooLarge);
}

}  // namespace
}  // namespace tooljoint::transient::testing
