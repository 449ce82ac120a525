// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Steps of generalized-alpha with impacts on walls: the state at their end is in equilibrium.
#include <gtest/gtest.h>

#include "Models.hpp"

namespace tooljoint::transient::testing {
namespace AlphaStepTest {

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

}  // namespace AlphaStepTest
}  // namespace tooljoint::transient::testing
