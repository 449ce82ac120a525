// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Recorded forces are the acting ones: every channel against the forces of evaluate().
#include <algorithm>
#include <gtest/gtest.h>
#include <map>

#include "tests/unit/contact/Samples.hpp"

namespace RecordsTest {

using namespace tooljoint::contact;
using namespace tooljoint::contact::testing;

class Records : public ::testing::TestWithParam<const char*> {};

/// Values of the channels of a law, by name.
std::map<std::string, std::vector<double>> recorded(const tooljoint::model::PointLaw& law, double t,
                                                    const State& state) {
  const auto channels = law.channels();
  const auto size = static_cast<std::size_t>(law.size());
  std::vector<double> values(channels.size() * size);
  law.record(t, state.d.data(), state.v.data(), values.data());
  std::map<std::string, std::vector<double>> out;
  for (std::size_t c = 0; c < channels.size(); ++c)
    out[channels[c].name].assign(values.begin() + static_cast<std::ptrdiff_t>(c * size),
                                 values.begin() + static_cast<std::ptrdiff_t>((c + 1) * size));
  return out;
}

// F = -F_n n + F_t t with n = (u, v)/r, t = (-v, u)/r: the components of the force of evaluate()
// along -n and t, and its torque.
TEST_P(Records, AreTheForcesThatAct) {
  const ContactPoint p = steelOnRock(), q = steelOnRock(5e4);
  for (const double speed : {9.0, -9.0}) {
    const auto contact =
        law(GetParam())->inMotion(batch({p, q}), [speed](double t) { return speed + t; });
    State state(p.clearance + 8e-4, 0.7);
    const State other(q.clearance + 3e-4, 2.6);
    state.d.insert(state.d.end(), other.d.begin(), other.d.end());
    state.v.insert(state.v.end(), {-0.2, 0.1, 1.3});
    const auto f = force(*contact, 0.5, state.d, state.v);
    const auto record = recorded(*contact, 0.5, state);
    ASSERT_EQ(record.size(), 4u);
    for (std::size_t i = 0; i < 2; ++i) {
      const double u = state.d[3 * i], v = state.d[3 * i + 1], r = std::hypot(u, v);
      const double normal = -(f[3 * i] * u + f[3 * i + 1] * v) / r,
                   tangential = (-f[3 * i] * v + f[3 * i + 1] * u) / r;
      EXPECT_GT(normal, 10.0);
      EXPECT_GT(std::abs(tangential), 1.0);
      EXPECT_LT(tangential * speed, 0.0) << "friction opposes the rotation";
      EXPECT_NEAR(record.at("normal_force")[i], normal, 1e-9 * normal);
      EXPECT_NEAR(record.at("tangential_force")[i], tangential, 1e-9 * std::abs(tangential));
      EXPECT_NEAR(record.at("friction_torque")[i], f[3 * i + 2], 1e-9 * std::abs(f[3 * i + 2]));
      EXPECT_NEAR(record.at("gap")[i], p.clearance - r, 1e-12);
    }
  }
}

TEST_P(Records, HaveTheUnitsOfTheirKind) {
  const std::map<std::string, std::string> units{
      {"normal_force", "N"}, {"gap", "m"}, {"tangential_force", "N"}, {"friction_torque", "N m"}};
  const auto contact =
      law(GetParam())->inMotion(batch({steelOnRock()}), [](double) { return 1.0; });
  for (const auto& channel : contact->channels())
    EXPECT_EQ(channel.unit, units.at(channel.name)) << channel.name;
  ContactPoint smooth = steelOnRock();
  smooth.muStatic = smooth.muDynamic = 0.0;
  EXPECT_EQ(
      law(GetParam())->inMotion(batch({smooth}), [](double) { return 1.0; })->channels().size(),
      2u);
}

INSTANTIATE_TEST_SUITE_P(Laws, Records, ::testing::Values("Nguyen", "Clamped", "Hunt-Crossley"),
                         testName);

// The static law for the sense of rotation `direction`: normal force, friction against the
// rotation, and its torque.
TEST_P(Records, StaticForcesOpposeTheRotation) {
  const ContactPoint p = steelOnRock();
  const auto rest = law(GetParam())->atRest(batch({p}));
  const double r = p.clearance + 8e-4, angle = 2.1;
  const double uv[2] = {r * std::cos(angle), r * std::sin(angle)};
  for (const double direction : {1.0, -1.0}) {
    StaticContact::Options options;
    options.sliding = {0.0, direction};
    double f[StaticContact::kForces], N = 0.0;
    rest->evaluate(options, uv, f);
    rest->normalForce(options, uv, &N);
    EXPECT_GT(N, 10.0);
    EXPECT_NEAR(-(f[0] * uv[0] + f[1] * uv[1]) / r, N, 1e-9 * N);
    EXPECT_NEAR((-f[0] * uv[1] + f[1] * uv[0]) / r, -direction * p.muStatic * N, 1e-9 * N);
    EXPECT_NEAR(f[3], -direction * p.muStatic * N * p.contactRadius, 1e-9 * N);
  }
}

}  // namespace RecordsTest
