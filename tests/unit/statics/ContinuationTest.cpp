// SPDX-License-Identifier: BSD-3-Clause
#include "statics/Continuation.hpp"

#include <gtest/gtest.h>

#include "Problems.hpp"
#include "common/Error.hpp"

namespace tooljoint::statics {
namespace {

using testing::ContactChain;
using testing::DenseProblem;

TEST(Continuation, SharpeningAContactLawInStages) {
  ContactChain chain(40, 100.0, 1e3);
  const auto sharpen = [&](double lambda) {
    return Stage{
        "lambda " + std::to_string(lambda), [&chain, lambda] { chain.sharpness = lambda; }, {}};
  };
  Vector x = Vector::Zero(40);
  const ContinuationReport report =
      runStages(chain, x, {sharpen(1e3), sharpen(1e4), sharpen(1e6), sharpen(7e11)});
  EXPECT_TRUE(report.converged) << report.message();
  ASSERT_EQ(report.stages.size(), 4U);
  Vector r;
  chain.residual(x, r);
  EXPECT_LT(r.cwiseAbs().maxCoeff(), 1e-8 * chain.load);
  // without the stages the same problem and options fail
  Vector y = Vector::Zero(40);
  EXPECT_FALSE(solve(chain, y).converged);
}

TEST(Continuation, StopsAtTheFirstStageThatFails) {
  ContactChain chain(10, 100.0, 1e3);
  NewtonOptions hopeless;
  hopeless.maxIterations = 1;
  int prepared = 0;
  Vector x = Vector::Zero(10);
  const ContinuationReport report = runStages(chain, x,
                                              {{"first", [&] { ++prepared; }, {}},
                                               {"second", [&] { chain.load *= 3.0; }, hopeless},
                                               {"third", [&] { ++prepared; }, {}}});
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.stages.size(), 2U);
  EXPECT_EQ(prepared, 1);
  EXPECT_NE(report.message().find("\"second\""), std::string::npos) << report.message();
  EXPECT_THROW(requireConverged(report, "It", ""), ConvergenceError);
}

/// x^2 = target, full steps, Newton allowed few iterations: large increments of the target fail.
struct Ramp {
  double target = 0.0;
  DenseProblem problem{1,
                       [this](const Vector& x) -> Vector {
                         return Vector::Constant(1, std::atan(20.0 * (x[0] - target)));
                       },
                       [this](const Vector& x) -> Matrix {
                         return Matrix::Constant(
                             1, 1, 20.0 / (1.0 + std::pow(20.0 * (x[0] - target), 2)));
                       }};
};

TEST(Continuation, RampHalvesIncrementsThatFail) {
  Ramp ramp;
  RampOptions options;
  options.newton.lineSearch = NewtonOptions::FullStep;  // diverges for |x - target| above 0.0695
  Vector x = Vector::Zero(1);
  const auto set = [&](double s) { ramp.target = s; };
  const ContinuationReport report = runRamp(ramp.problem, x, set, options);
  EXPECT_TRUE(report.converged) << report.message();
  EXPECT_NEAR(x[0], 1.0, 1e-10);
  EXPECT_DOUBLE_EQ(ramp.target, 1.0);
  EXPECT_GE(report.stages.size(), 16U);
  EXPECT_FALSE(report.stages.front().newton.converged);
  // too few halvings: the report says where it ended, x is the last converged state
  options.maxHalvings = 2;
  x.setZero();
  const ContinuationReport failed = runRamp(ramp.problem, x, set, options);
  EXPECT_FALSE(failed.converged);
  EXPECT_EQ(x[0], 0.0);
  EXPECT_NE(failed.message().find("s = 0.25"), std::string::npos) << failed.message();
}

TEST(Continuation, RampWithEasyIncrementsTakesThemAll) {
  Ramp ramp;
  RampOptions options;
  options.increments = 4;
  Vector x = Vector::Zero(1);
  const ContinuationReport report = runRamp(
      ramp.problem, x, [&](double s) { ramp.target = s; }, options);
  EXPECT_TRUE(report.converged) << report.message();
  EXPECT_EQ(report.stages.size(), 4U);
  EXPECT_EQ(report.stages[1].name, "s = 0.5");
}

}  // namespace
}  // namespace tooljoint::statics
