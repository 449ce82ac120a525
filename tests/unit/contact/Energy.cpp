// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "tests/unit/contact/Samples.hpp"

namespace EnergyTest {

using namespace tooljoint::contact;
using namespace tooljoint::contact::testing;

double turning(double) { return 7.0; }

class Energy : public ::testing::TestWithParam<const char*> {};

/// Both sides of d(stored)/dt + damping + friction - drive = -(force . velocity).
struct Balance {
  std::vector<double> force;
  tooljoint::model::PointLaw::Power power;
  double storing = 0.0, work = 0.0;  ///< d(stored)/dt by central differences, force . velocity [W]

  Balance(const tooljoint::model::PointLaw& law, const std::vector<int>& points, const State& state)
      : force(tooljoint::contact::testing::force(law, 0.0, state.d, state.v)),
        power(law.power(0.0, points, state.d.data(), state.v.data())) {
    const double h = 2e-7;
    std::vector<double> before = state.d, after = state.d;
    for (std::size_t i = 0; i < force.size(); ++i) {
      work += force[i] * state.v[i];
      before[i] -= h * state.v[i];
      after[i] += h * state.v[i];
    }
    storing = (law.power(0.0, points, after.data(), state.v.data()).stored -
               law.power(0.0, points, before.data(), state.v.data()).stored) /
              (2.0 * h);
  }
  double losses() const { return storing + power.damping + power.friction - power.drive; }
};

TEST_P(Energy, PowersBalance) {
  const auto contact = law(GetParam())->inMotion(batch({steelOnRock(), steelOnRock(5e4)}), turning);
  for (const double G : {-1e-2, -1e-4, 1e-4, 1.5e-3}) {
    for (const double angle : {0.3, 2.9}) {
      State state(0.0285 + G, angle);
      state.d.insert(state.d.end(), {0.0285 + 2e-4, 1e-3, 0.0});
      state.v.insert(state.v.end(), {-0.4, 0.2, -3.0});
      const Balance found(*contact, {0, 1}, state);
      const auto& power = found.power;
      const double scale = std::abs(found.storing) + power.damping + std::abs(power.friction) +
                           std::abs(power.drive) + 1.0;
      EXPECT_NEAR(found.losses(), -found.work, 1e-6 * scale)
          << GetParam() << " " << G << " " << angle;
      EXPECT_NEAR(driveOf(*contact, 0.0, state.d, state.v), power.drive, 1e-9 * scale);
      if (std::string(GetParam()) != "Nguyen") {
        EXPECT_GE(power.stored, 0.0);
        EXPECT_GE(power.damping, 0.0);
        EXPECT_GE(power.friction, 0.0);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, Energy, ::testing::Values("Nguyen", "Clamped", "Hunt-Crossley"),
                         testName);

// The same with friction along the hole: the block feeds it
TEST_P(Energy, PowersOfFrictionAlongTheHoleBalance) {
  const auto contact = law(GetParam())->inMotion(batch({steelOnRock()}), turning, along(0.4));
  const State state = State(0.0285 + 1.5e-3, 0.3).with(0.1, -0.15);
  const Balance found(*contact, {0}, state);
  EXPECT_NEAR(found.losses(), -found.work, 1e-6 * std::abs(found.work));
  EXPECT_NEAR(driveOf(*contact, 0.0, state.d, state.v), found.power.drive,
              1e-9 * found.power.drive);
  EXPECT_GT(std::abs(found.force[2] * 0.4), 1e-3 * found.power.drive) << "the block takes part";
}

// The closed form against quadrature of F_n dG, from the wall inwards and outwards.
TEST_P(Energy, StoredEnergyIsTheIntegralOfTheElasticForce) {
  for (const double lambda : {2e3, 1e5}) {
    ContactPoint p = steelOnRock(lambda);
    p.damping = 0.0;
    p.muStatic = p.muDynamic = 0.0;
    const auto contact = law(GetParam())->inMotion(batch({p}), turning);
    const auto rest = law(GetParam())->atRest(batch({p}));
    const std::vector<double> v = {0.0, 0.0, 0.0};
    for (const double G : {-1e-2, -3e-4, -1e-7, 1e-7, 3e-4, 1e-2}) {
      // Simpson in G = x^3 steps, so that the knee at the wall is resolved
      const int n = 4000;
      double sum = 0.0;
      const double edge = std::cbrt(G);
      for (int i = 0; i <= n; ++i) {
        const double x = edge * i / n;
        const double uv[2] = {p.clearance + x * x * x, 0.0};
        double N = 0.0;
        rest->normalForce({}, uv, &N);
        sum +=
            (i == 0 || i == n ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0)) * N * 3.0 * x * x * edge / n / 3.0;
      }
      const std::vector<double> d = {p.clearance + G, 0.0, 0.0};
      EXPECT_NEAR(contact->power(0.0, {0}, d.data(), v.data()).stored, sum,
                  1e-6 * std::abs(sum) + 1e-15)
          << GetParam() << " " << lambda << " " << G;
    }
  }
}

}  // namespace EnergyTest
