// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Steps that do not follow the motion end a run; those that do, and models at rest, pass.
#include <gtest/gtest.h>

#include <string>

#include "common/Error.hpp"
#include "tests/unit/transient/Models.hpp"

namespace tooljoint::transient {
namespace {

using namespace testing;

struct NoSamples final : SampleSink {
  void sample(double, const Vector&, const Vector&, const Vector&) override {}
};

TransientOptions steps(double h, double end) {
  TransientOptions o;
  o.integrator = "Generalized-alpha";
  o.end = end;
  o.step = h;
  o.progress = false;
  return o;
}

/// 10 Hz: 100 steps a period, 20, 2.
TEST(StepResolution, refusesStepsThatLoseTheVibration) {
  const double w = 2 * 3.14159265358979 * 10;
  const auto model = oscillator(1.0, 0.0, w * w, 1e-3, 0.0);
  NoSamples sink;
  EXPECT_NO_THROW(integrate(model, steps(1e-3, 1.0), sink));
  EXPECT_NO_THROW(integrate(model, steps(5e-3, 2.0), sink));
  try {
    integrate(model, steps(5e-2, 20.0), sink);
    ADD_FAILURE() << "two steps a period were taken for a result";
  } catch (const ConvergenceError& error) {
    EXPECT_NE(std::string(error.what()).find("do not follow the motion"), std::string::npos) << error.what();
  }
  auto anyway = steps(5e-2, 20.0);
  anyway.own.set("Accept Coarse Steps", true);
  EXPECT_NO_THROW(integrate(model, anyway, sink));
}

/// What is damped out long before a step ends does not move any more.
TEST(StepResolution, passesWhatStandsStillOrCreeps) {
  NoSamples sink;
  EXPECT_NO_THROW(integrate(oscillator(1.0, 0.0, 1e8, 0.0, 0.0), steps(5e-2, 20.0), sink));
  auto creeping = oscillator(1e-6, 1e3, 1e3, 1e-3, -1e-3);
  EXPECT_NO_THROW(integrate(creeping, steps(5e-2, 20.0), sink));
}

}  // namespace
}  // namespace tooljoint::transient
