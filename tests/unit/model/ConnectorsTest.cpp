// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Springs, stops and frictions at points: force against closed form, tangents against differences,
/// powers against the work of the force, records against evaluate().
#include "model/laws/Connectors.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

namespace ConnectorsTest {

using namespace tooljoint;
using namespace tooljoint::model;

constexpr double kStiffness = 3e3, kCubic = 4e5, kDamping = 20.0;

SpringParameters spring() {
  SpringParameters s;
  s.stiffness = kStiffness;
  s.cubicStiffness = kCubic;
  s.damping = kDamping;
  return s;
}

StopParameters stop(double friction) {
  StopParameters s;
  s.gap = 0.01;
  s.stiffness = 2e5;
  s.damping = 0.7;
  s.smoothing = 1e-3;
  s.friction = friction;
  s.slipVelocity = 0.05;
  return s;
}

FrictionParameters friction() {
  FrictionParameters s;
  s.force = 40.0;
  s.slipVelocity = 0.03;
  return s;
}

std::vector<double> forces(const model::PointLaw& law, const std::vector<double>& d,
                           const std::vector<double>& v) {
  std::vector<int> active(static_cast<std::size_t>(law.size()));
  std::iota(active.begin(), active.end(), 0);
  std::vector<double> f(d.size());
  law.evaluate(0.0, active, d.data(), v.data(), f.data());
  return f;
}

/// Tangents of a batch of one point against central differences of its forces.
void expectTangents(const model::PointLaw& law, const std::vector<double>& d,
                    const std::vector<double>& v) {
  const std::size_t w = d.size();
  std::vector<double> f(w), K(w * w), C(w * w);
  law.evaluateWithTangent(0.0, {0}, d.data(), v.data(), f.data(), K.data(), C.data());
  for (std::size_t i = 0; i < w; ++i)
    EXPECT_NEAR(f[i], forces(law, d, v)[i], 1e-12 * std::abs(f[i]));
  const double h = 1e-7;
  for (std::size_t column = 0; column < w; ++column)
    for (const bool position : {true, false}) {
      auto dBefore = d, dAfter = d, vBefore = v, vAfter = v;
      (position ? dBefore : vBefore)[column] -= h;
      (position ? dAfter : vAfter)[column] += h;
      const auto before = forces(law, dBefore, vBefore), after = forces(law, dAfter, vAfter);
      for (std::size_t row = 0; row < w; ++row) {
        const double difference = (after[row] - before[row]) / (2.0 * h),
                     exact = (position ? K : C)[row * w + column];
        EXPECT_NEAR(exact, difference, 1e-5 * std::abs(difference) + 1e-3)
            << row << " " << column << " " << position;
      }
    }
}

/// d(stored)/dt + damping + friction = -f . v.
void expectPowerBalance(const model::PointLaw& law, const std::vector<double>& d,
                        const std::vector<double>& v) {
  const auto f = forces(law, d, v);
  const auto power = law.power(0.0, {0}, d.data(), v.data());
  auto before = d, after = d;
  const double h = 1e-7;
  double work = 0.0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    before[i] -= h * v[i];
    after[i] += h * v[i];
    work += f[i] * v[i];
  }
  const double storing = (law.power(0.0, {0}, after.data(), v.data()).stored -
                          law.power(0.0, {0}, before.data(), v.data()).stored) /
                         (2.0 * h);
  EXPECT_NEAR(storing + power.damping + power.friction, -work, 1e-6 * (std::abs(work) + 1.0));
  EXPECT_GE(power.damping, 0.0);
  EXPECT_GE(power.friction, 0.0);
}

std::vector<double> records(const model::PointLaw& law, const std::vector<double>& d,
                            const std::vector<double>& v) {
  std::vector<double> out(law.channels().size() * static_cast<std::size_t>(law.size()));
  law.record(0.0, d.data(), v.data(), out.data());
  return out;
}

TEST(Springs, PullBackLinearlyCubicallyAndAgainstTheVelocity) {
  const auto law = springs({spring()});
  const double d = 0.07, v = -1.3;
  EXPECT_NEAR(forces(*law, {d}, {v})[0], -kStiffness * d - kCubic * d * d * d - kDamping * v,
              1e-10);
  expectTangents(*law, {d}, {v});
  expectPowerBalance(*law, {d}, {v});
  EXPECT_NEAR(law->power(0.0, {0}, &d, &v).stored,
              0.5 * kStiffness * d * d + 0.25 * kCubic * d * d * d * d, 1e-10);
  EXPECT_NEAR(law->power(0.0, {0}, &d, &v).damping, kDamping * v * v, 1e-10);
}

TEST(Springs, RecordTheForceOfEachPoint) {
  auto other = spring();
  other.stiffness *= 2.0;
  const auto law = springs({spring(), other});
  const std::vector<double> d{0.02, -0.03}, v{0.4, 0.1};
  EXPECT_EQ(records(*law, d, v), forces(*law, d, v));
  ASSERT_EQ(law->channels().size(), 1u);
  EXPECT_EQ(law->channels()[0].unit, "N");
}

/// f = k p (1 + chi p') with the penetration p = -(d + gap), smooth within the smoothing length,
/// never pulling.
TEST(Stops, PushInThePenetrationOnly) {
  const auto law = stops({stop(0.0)});
  EXPECT_EQ(forces(*law, {-0.0089}, {0.0})[0], 0.0);
  const double d = -0.014, v = -0.2;
  EXPECT_NEAR(forces(*law, {d}, {v})[0], 2e5 * 0.004 * (1.0 + 0.7 * 0.2), 1e-9);
  EXPECT_EQ(forces(*law, {d}, {2.0})[0], 0.0) << "it never pulls";
  const double inside = -0.0104;  // p = 0.0004: (p + s)^2 / 4 s
  EXPECT_NEAR(forces(*law, {inside}, {0.0})[0], 2e5 * 0.0014 * 0.0014 / 0.004, 1e-9);
  for (const double at : {-0.0095, inside, -0.0108, d}) {
    expectTangents(*law, {at}, {v});
    expectPowerBalance(*law, {at}, {v});
    expectPowerBalance(*law, {at}, {0.6});
  }
}

TEST(Stops, RecordTheirForceAndTheDistanceLeft) {
  const auto law = stops({stop(0.0), stop(0.0)});
  const std::vector<double> d{-0.014, 0.005}, v{-0.2, 0.3};
  const auto f = forces(*law, d, v), out = records(*law, d, v);
  EXPECT_GT(f[0], 0.0);
  EXPECT_EQ(out, (std::vector<double>{f[0], f[1], -0.004, 0.015}));
  EXPECT_EQ(law->channels()[0].unit, "N");
  EXPECT_EQ(law->channels()[1].unit, "m");
  double gap[2];
  law->clearanceLeft({0, 1}, d.data(), gap);
  EXPECT_NEAR(gap[1], 0.014, 1e-15) << "the distance up to the smoothed edge";
}

/// -mu f v_t / sqrt(|v_t|^2 + v_r^2) in the plane of the stop.
TEST(SlidingStops, RubAgainstTheSlip) {
  const auto law = slidingStops({stop(0.3)}, 2);
  const std::vector<double> d{-0.014, 0.1, 0.2}, v{-0.2, 0.4, -0.3};
  const auto f = forces(*law, d, v);
  const double normal = 2e5 * 0.004 * 1.14, slip = std::sqrt(0.25 + 0.05 * 0.05);
  EXPECT_NEAR(f[0], normal, 1e-9);
  EXPECT_NEAR(f[1], -0.3 * normal * 0.4 / slip, 1e-9);
  EXPECT_NEAR(f[2], 0.3 * normal * 0.3 / slip, 1e-9);
  expectTangents(*law, d, v);
  expectPowerBalance(*law, d, v);
  const auto out = records(*law, d, v);
  ASSERT_EQ(out.size(), 3u);
  EXPECT_NEAR(out[0], f[0], 1e-12 * normal);
  EXPECT_NEAR(out[2], std::hypot(f[1], f[2]), 1e-9) << "the size of the friction force";
}

/// -F v / sqrt(v^2 + v_r^2).
TEST(Frictions, HoldBackWithTheirForce) {
  const auto law = frictions({friction()});
  const double v = -0.4;
  EXPECT_NEAR(forces(*law, {0.0}, {v})[0], 40.0 * 0.4 / std::sqrt(0.16 + 9e-4), 1e-10);
  expectTangents(*law, {0.1}, {v});
  expectTangents(*law, {0.1}, {0.01});
  expectPowerBalance(*law, {0.1}, {v});
  EXPECT_EQ(records(*law, {0.1}, {v}), forces(*law, {0.1}, {v}));
  EXPECT_EQ(law->channels()[0].unit, "N");
}

}  // namespace ConnectorsTest
