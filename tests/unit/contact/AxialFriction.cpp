// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Friction against the whole sliding velocity, around the wall and along the hole.
#include <gtest/gtest.h>

#include "model/laws/Coulomb.hpp"
#include "model/laws/Friction.hpp"
#include "tests/unit/contact/Samples.hpp"

namespace AxialFrictionTest {

using namespace tooljoint;
using namespace tooljoint::contact;
using namespace tooljoint::contact::testing;

constexpr double omega = 7.0, feed = 0.4, wDot = -0.15;

double turning(double) { return omega; }

class AxialFriction : public ::testing::TestWithParam<const char*> {
 protected:
  ContactPoint p = steelOnRock();
  std::shared_ptr<const model::PointLaw> both =
      law(GetParam())->inMotion(batch({p}), turning, along(feed));
  State around = State(p.clearance + 8e-4, 0.7), state = around.with(0.2, wDot);
};

TEST_P(AxialFriction, HasTheSizeMuNAndOpposesTheVelocity) {
  ASSERT_EQ(both->width(), 4);
  EXPECT_EQ(contactComponents(4), (std::vector<int>{0, 1, 2, 5}));
  const auto f = force(*both, 0.0, state.d, state.v);
  const double r = std::hypot(state.d[0], state.d[1]);
  const double nu = state.d[0] / r, nv = state.d[1] / r;
  const double N = -(f[0] * nu + f[1] * nv), aroundForce = -f[0] * nv + f[1] * nu;
  const double vAround = nu * state.v[1] - nv * state.v[0] + (omega + state.v[3]) * p.contactRadius;
  const double vAlong = feed + wDot, v = std::hypot(vAround, vAlong);
  const double mu =
      model::FrictionCurve(p.muStatic, p.muDynamic, p.regularisationVelocity).value(v);
  EXPECT_GT(N, 100.0);
  EXPECT_NEAR(aroundForce, -mu * N * vAround / v, 1e-9 * N);
  EXPECT_NEAR(f[2], -mu * N * vAlong / v, 1e-9 * N);
  EXPECT_NEAR(f[3], aroundForce * p.contactRadius, 1e-9 * N);
}

TEST_P(AxialFriction, IsTheLawAroundTheWallWhereNothingSlidesAlong) {
  state.v[2] = -feed;
  const auto f = force(*both, 0.0, state.d, state.v),
             alone =
                 force(*law(GetParam())->inMotion(batch({p}), turning), 0.0, around.d, around.v);
  for (const auto& [four, three] : {std::pair{0U, 0U}, {1U, 1U}, {3U, 2U}})
    EXPECT_NEAR(f[four], alone[three], 1e-12 * std::abs(alone[three]));
  EXPECT_EQ(f[2], 0.0);
}

TEST_P(AxialFriction, IsAStraightLineThroughRest) {
  const std::vector<double> still(4, 0.0);
  const auto resting = law(GetParam())
                           ->inMotion(
                               batch({p}), [](double) { return 0.0; }, along(0.0));
  const Answer at = answer(*resting, 0.0, state.d, still);
  const double N = std::hypot(at.f[0], at.f[1]);
  EXPECT_EQ(at.f[2], 0.0);
  EXPECT_NEAR(at.dfdv[10], -N / p.regularisationVelocity, 1e-9 * N / p.regularisationVelocity);
  EXPECT_EQ(at.dfdv[11], 0.0);
}

/// Sliding steadily, the string has the friction of its static state.
TEST_P(AxialFriction, OfSteadySlidingIsThatAtRest) {
  const std::vector<double> still(4, 0.0);
  const auto moving = force(*both, 0.0, state.d, still);
  const auto rest = law(GetParam())->atRest(batch({p}).slidingAt(omega, feed));
  StaticContact::Options options;
  options.sliding = {feed, omega};
  double f[StaticContact::kForces];
  rest->evaluate(options, state.d.data(), f);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(f[i], moving[i], 1e-9 * std::abs(moving[i])) << i;
}

TEST_P(AxialFriction, IsRecorded) {
  const auto f = force(*both, 0.0, state.d, state.v);
  ASSERT_EQ(both->channels().size(), 5u);
  EXPECT_EQ(both->channels()[4].name, "axial_friction");
  EXPECT_EQ(both->channels()[4].unit, "N");
  std::vector<double> values(5);
  both->record(0.0, state.d.data(), state.v.data(), values.data());
  EXPECT_DOUBLE_EQ(values[3], f[3]);
  EXPECT_DOUBLE_EQ(values[4], f[2]);
}

TEST_P(AxialFriction, StaysInPartsAndVariants) {
  const auto f = force(*both, 0.0, state.d, state.v);
  EXPECT_EQ(force(*both->subset({0}), 0.0, state.d, state.v), f);
  EXPECT_EQ(force(*model::atSpeed(both, omega), 0.0, state.d, state.v), f);
  const auto smooth = model::withoutFriction(both);
  ASSERT_EQ(smooth->width(), 4);
  EXPECT_EQ(force(*smooth, 0.0, state.d, state.v)[2], 0.0);
  EXPECT_EQ(smooth->channels().size(), 2u);
}

INSTANTIATE_TEST_SUITE_P(Laws, AxialFriction,
                         ::testing::Values("Nguyen", "Clamped", "Hunt-Crossley"), testName);

}  // namespace AxialFrictionTest
