// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Impacts and friction with known outcome.
#include <gtest/gtest.h>

#include "../../unit/transient/Models.hpp"
#include "common/Constants.hpp"
#include "substructures/contact/ContactLaw.hpp"

namespace tooljoint::transient::testing {
namespace ImpactTest {

/// A mass m meets a spring-damper stop at speed v: while they touch, m q'' + c q' + k q = 0, q(0) =
/// 0, q'(0) = -v. It leaves at half a damped period with speed v exp(-pi zeta / sqrt(1 - zeta^2)),
/// the law pulling on rebound as printed in the source.
TEST(Impact, reboundSpeedOfADampedStop) {
  const double m = 2, k = 5e5, c = 150, v = 0.4, gap = 0.01;
  auto model = denseModel(scalar(m), Matrix(), Matrix());
  model.initialDisplacement[0] = gap;
  model.initialVelocity[0] = -v;
  addFloor(model, k, c, 7e11);
  const double omega = std::sqrt(k / m), zeta = c / (2 * m * omega);
  const double expected = v * std::exp(-constants::pi * zeta / std::sqrt(1 - zeta * zeta));
  for (const auto& [integrator, step] :
       {std::pair<std::string, double>{"RK4", 2e-6}, {"Generalized-alpha", 5e-6}}) {
    Keep samples;
    const auto report = integrate(model, options(integrator, 0.06, step, 0.01), samples);
    EXPECT_NEAR(samples.v.back()[0], expected, 2e-3 * v) << integrator;
    EXPECT_NEAR(report.energy.contactDamping, 0.5 * m * (v * v - expected * expected),
                2e-3 * m * v * v)
        << integrator;
  }
}

/// A block on a rough conveyor (the wall turning under it): slides until it moves with the belt;
/// the time is v / (mu g).
TEST(Impact, frictionSpinsARotorUpAtConstantTorque) {
  // Weight presses a free rotor against the bore; friction mu N R accelerates it against its
  // inertia.
  const double mass = 10, inertia = 0.02, radius = 0.1, clearance = 0.01, k = 1e6, mu = 0.2;
  auto model = denseModel(Vector(Eigen::Vector3d(mass, mass, inertia)).asDiagonal(),
                          Vector(Eigen::Vector3d(2000, 2e6, 0)).asDiagonal(),
                          Vector(Eigen::Vector3d(0, 1e9, 0)).asDiagonal(), 3);
  model.componentNames = {"u", "v", "theta_z"};
  model.loads.push_back({"weight", Vector::Unit(3, 0) * mass * 9.81, 0});
  const double sink = mass * 9.81 / k;
  model.initialDisplacement[0] = clearance + sink;
  contact::ContactPoints points;
  points.add({1, clearance, radius, k, 100, 1e9, 1e9, mu, mu, 1e-4});
  model::PointSet set;
  set.name = "contact";
  set.law = contact::makeLaw("Clamped")->inMotion(points, [](double) { return 30.0; });
  set.rows.resize(3, 3);
  set.rows.setIdentity();
  set.offset = Vector::Zero(3);
  set.entities = {1};
  model.points.push_back(set);
  // theta_z'' = -mu N R / I until theta_z' = -30 rad/s: the string stands still under the drive,
  // then sticks.
  const double rate = mu * mass * 9.81 * radius / inertia;
  Keep samples;
  const auto report = integrate(model, options("Generalized-alpha", 0.6, 1e-3, 0.05), samples);
  EXPECT_EQ(report.counters.unconvergedSteps, 0);
  for (std::size_t s = 0; s < samples.time.size(); ++s)
    EXPECT_NEAR(samples.v[s][2], -std::min(30.0, rate * samples.time[s]), 0.15)
        << "at " << samples.time[s];
}

}  // namespace ImpactTest
}  // namespace tooljoint::transient::testing
