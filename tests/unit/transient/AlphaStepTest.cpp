// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Steps of generalized-alpha with contact. With impacts on walls, the state at the end of a step
/// is in equilibrium; along a round wall, the wall carries the centrifugal force.
#include <gtest/gtest.h>
#include <memory>

#include "Models.hpp"
#include "substructures/contact/ContactLaw.hpp"
#include "substructures/contact/Eccentric.hpp"

namespace tooljoint::transient::testing {
namespace AlphaStepTest {

constexpr double massInBore = 10.0;      ///< [kg]
constexpr double speedInBore = 1.0;      ///< [m/s]
constexpr double stiffnessOfWall = 1e7;  ///< [N/m]

/// A chain of 400 consistent masses of 1 kg falls at 1 m/s; two of its nodes meet hard floors, far
/// from each other and at different times.
model::SecondOrderModel chainOntoTwoFloors() {
  constexpr int n = 400;
  auto chain = springChain(n, 1.0, 10.0, 1e6);
  Matrix mass = Matrix::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    mass(i, i) = 4.0 / 6;
    if (i > 0) mass(i, i - 1) = mass(i - 1, i) = 1.0 / 6;
  }
  chain.mass = Sparse(mass.sparseView());
  chain.initialVelocity.setConstant(-1.0);
  model::PointSet set;
  set.name = "floor";
  set.law = std::make_shared<Floor>(2, 1e8, 100.0, 7e11);
  set.rows.resize(2, n);
  set.rows.insert(0, 90) = set.rows.insert(1, 310) = 1;
  set.offset = Vector::Zero(2);
  set.offset << 2e-3, 5.2e-3;
  set.entities = {91, 311};
  chain.points.push_back(set);
  return chain;
}

/// M q'' + C v + K q = F + R'f: impacts act in full on q'' too. M^-1 decreases by 3.7 from node to
/// node, so they act near the floors only.
TEST(AlphaStep, EndsInBalanceWhereWallsAreMetAsImpacts) {
  const auto model = chainOntoTwoFloors();
  const auto& floor = model.points[0];
  Keep samples;
  auto o = options("Generalized-alpha", 0.05, 1e-3, 1e-3);
  o.own.set("Tolerance", 1e-11);
  o.own.set("Spectral Radius", 0.2);
  o.own.set("Phase Correction", false);
  acceptCoarseSteps(o);
  integrate(model, o, samples);
  ASSERT_EQ(samples.q.size(), 51u);
  int hit[2] = {0, 0};
  for (std::size_t i = 1; i < samples.q.size(); ++i) {
    const Vector d = floor.offset + floor.rows * samples.q[i], v = floor.rows * samples.v[i];
    Vector f = Vector::Zero(2);
    floor.law->evaluate(0.0, {0, 1}, d.data(), v.data(), f.data());
    for (int p : {0, 1}) hit[p] += f[p] > 1e3 ? 1 : 0;
    const Vector inertia = model.mass * samples.a[i];
    const Vector residual = inertia + model.dampingAt(0.0) * samples.v[i] +
                            model.stiffnessAt(0.0) * samples.q[i] - floor.rows.transpose() * f;
    EXPECT_LT(residual.cwiseAbs().maxCoeff(),
              1e-7 * std::max(inertia.cwiseAbs().maxCoeff(), f.cwiseAbs().maxCoeff()))
        << "step " << i;
  }
  EXPECT_GT(hit[0], 0);
  EXPECT_GT(hit[1], 0);
}

/// A mass on a round wall without friction, pressed against it by its centrifugal force:
/// k_c G = m v^2 / (j0 + G). Its centre of contact is `offset` beside the node, in x.
model::SecondOrderModel roundTheBore(double offset) {
  contact::ContactPoint wall;
  wall.node = 1;
  wall.clearance = 0.03;
  wall.stiffness = stiffnessOfWall;
  contact::ContactPoints points;
  points.add(wall);
  auto model = denseModel(Vector3(massInBore, massInBore, 1.0).asDiagonal(), Matrix(), Matrix(), 3);
  const double radius =
      0.5 * wall.clearance + std::sqrt(0.25 * wall.clearance * wall.clearance +
                                       massInBore * speedInBore * speedInBore / stiffnessOfWall);
  model.initialDisplacement << radius - offset, 0.0, 0.0;
  model.initialVelocity << 0.0, speedInBore, 0.0;
  model::PointSet set;
  set.name = "wall";
  set.law = contact::makeLaw("Clamped")->inMotion(points, [](double /*t*/) { return 0.0; });
  if (offset != 0) set.law = contact::eccentric(set.law, {Eigen::Vector2d(offset, 0.0)});
  set.rows = Matrix(Matrix::Identity(3, 3)).sparseView();
  set.offset = Vector::Zero(3);
  set.entities = {1};
  model.points = {set};
  return model;
}

/// The acceleration of such a mass is centripetal, so the phase correction must leave it out: the
/// mass would gain speed. The wall turns by 0.033 rad in a step, so the scheme itself misses the
/// angle by (0.033)^2 / 12 of it, up to 5e-4 where it damps. The mass starts in equilibrium, but
/// not in that of the scheme, so the force keeps an undamped vibration of 1.2 %.
TEST(AlphaStep, TheWallCarriesTheCentrifugalForceOfAPointThatSlidesAlongIt) {
  for (const double offset : {0.0, 0.01})
    for (const double radius : {0.2, 0.8, 1.0}) {
      const auto model = roundTheBore(offset);
      const double r = model.initialDisplacement[0] + offset;
      Keep samples;
      auto o = options("Generalized-alpha", 0.2, 1e-3, 1e-3);
      o.own.set("Spectral Radius", radius);
      integrate(model, o, samples);
      for (std::size_t i = 1; i < samples.q.size(); ++i) {
        const double reached = std::hypot(samples.q[i][0] + offset, samples.q[i][1]);
        const double force = stiffnessOfWall * (reached - 0.03);
        EXPECT_NEAR(force, massInBore * speedInBore * speedInBore / r, 0.02 * force)
            << "radius " << radius << ", offset " << offset << ", step " << i;
      }
      const double angle = std::atan2(samples.q.back()[1], samples.q.back()[0] + offset);
      const double whole = 0.2 * speedInBore / r;
      EXPECT_NEAR(std::remainder(angle - whole, 2 * constants::pi), 0.0, 1e-3 * whole);
    }
}

}  // namespace AlphaStepTest
}  // namespace tooljoint::transient::testing
