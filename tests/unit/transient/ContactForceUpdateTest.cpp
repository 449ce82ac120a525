// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The relaxation of point forces near few points: the evaluated points, and agreement of its
/// result with that of the full relaxation.
#include "transient/contact/ContactForceUpdate.hpp"

#include <gtest/gtest.h>

#include "Models.hpp"
#include "linalg/blocks/BlockFactor.hpp"
#include "transient/Tuned.hpp"

namespace tooljoint::transient {
namespace ContactForceUpdateTest {

constexpr double ca = 4e6, cv = 2e3;  // steps of about 1 ms

/// With floors this far below two masses of a chain of 300.
const model::SecondOrderModel& withFloors(model::SecondOrderModel& chain, double damping,
                                          double lambda, double clearance) {
  model::PointSet set;
  set.name = "floor";
  set.law = std::make_shared<testing::Floor>(2, 1e6, damping, lambda);
  set.rows.resize(2, 300);
  set.rows.insert(0, 60) = set.rows.insert(1, 240) = 1;
  set.offset = Vector::Constant(2, clearance);
  set.entities = {61, 241};
  chain.points.push_back(set);
  return chain;
}

/// A chain of 300 masses of 1 kg, two of them 0.1 mm above floors, is pressed onto one floor by
/// 1500 N.
struct TwoFloors {
  TwoFloors()
      : source(testing::springChain(300, 1.0, 0.0, 1e6)),
        model(withFloors(source, 10.0, 1e5, 0.0)),
        factor(model.pattern()),
        residual(Vector::Zero(300)) {
    const Vector q = Vector::Constant(300, 1e-4);
    model.setTime(0.0);
    for (auto& batch : model.points()) batch.look(0.0, 1e-3, q.data());
    model.combine(ca, cv, 1.0, factor.values());
    EXPECT_LT(factor.factor(), 0);
    relaxation.bind(model, strategies);
    relaxation.setWeights(Vector::Constant(300, 1 / ca));
    relaxation.setCompliance(factor);
    residual[60] = 1500;
    relaxation.start(q, residual);
    const Vector none = Vector::Zero(300);
    relaxation.guess(0.0, cv, none);
    relaxation.solve(factor, nullptr, delta);
  }
  double error() {
    double force = 0;
    return relaxation.evaluate(0.0, cv, delta, small, force);
  }

  static constexpr double small = 1e-12;
  model::SecondOrderModel source;
  CompiledModel model;
  linalg::BlockFactor factor;
  Vector residual, delta = Vector::Zero(300);
  Strategies strategies;
  ContactForceUpdate relaxation;
};

TEST(ContactForceUpdate, MeasuresAPointAgainWhoseChangeDoesNotTravel) {
  TwoFloors step;
  const double before = step.error();
  ASSERT_GT(before, 1e3 * step.small);
  ASSERT_TRUE(step.relaxation.correct(0.0, cv, step.small, false))
      << "two points of 300 positions are few";
  step.relaxation.solveNear(step.factor, 1e9, step.delta);  // no value is above the bound
  EXPECT_EQ(step.relaxation.reached(), 0U);
  EXPECT_DOUBLE_EQ(step.relaxation.nearShare(), 2 * Tuned::positionsPerPoint / 300.0);
  EXPECT_LT(step.error(), 1e-3 * before) << "its force is now that of where it is";
}

TEST(ContactForceUpdate, SaysThatLittleIsLeftOfTheForceExpected) {
  TwoFloors step;
  step.relaxation.guess(0.0, cv, Vector::Constant(300, -1e-3 * cv));  // both on the floor
  step.delta.setConstant(1e-2);                                       // and far above it
  step.error();
  EXPECT_GT(step.relaxation.wrongShare(), 100);
}

TEST(ContactForceUpdate, NearFewPointsEndsWhereAllEnd) {
  TwoFloors all, near;
  all.error();
  EXPECT_NEAR(all.relaxation.wrongShare(), 1.0, 0.02) << "next to none of the force was expected";
  for (int iteration = 0; all.error() > all.small; ++iteration) {
    ASSERT_LT(iteration, 50);
    all.relaxation.correct(0.0, cv, all.small, true);
    all.relaxation.solve(all.factor, nullptr, all.delta);
  }
  EXPECT_LT(all.relaxation.wrongShare(), 1e-6);
  for (int iteration = 0; near.error() > near.small; ++iteration) {
    ASSERT_LT(iteration, 50);
    ASSERT_TRUE(near.relaxation.correct(0.0, cv, near.small, false));
    near.relaxation.solveNear(near.factor, near.small, near.delta);
    EXPECT_LT(near.relaxation.reached(), near.delta.size() / 2U)
        << "a force reaches a few neighbours in a step";
  }
  EXPECT_LT(all.delta[60], -1e-4) << "pressed into the floor";
  EXPECT_LT((all.delta - near.delta).cwiseAbs().maxCoeff(),
            1e-10 * all.delta.cwiseAbs().maxCoeff() + 10 * near.small);
}

/// The same chain with strongly damping floors 0.1 mm below it: a mass pressed onto them comes to
/// rest within the first micrometre. The second floor is met although it is not active, or (`seen`)
/// is active from the start.
struct SoftFloors {
  explicit SoftFloors(bool seen)
      : source(testing::springChain(300, 1.0, 0.0, 1e6)),
        model(withFloors(source, 1e4, 1e7, 1e-4)),
        factor(model.pattern()),
        residual(Vector::Zero(300)) {
    auto& floors = model.points()[0];
    Vector q = Vector::Zero(300);
    model.setTime(0.0);
    floors.look(0.0, 1e-3, q.data());
    q[60] = -1;
    if (seen) q[240] = -1;
    floors.addMissed(q.data());
    model.combine(ca, cv, 1.0, factor.values());
    EXPECT_LT(factor.factor(), 0);
    relaxation.bind(model, strategies);
    relaxation.setWeights(Vector::Constant(300, 1 / ca));
    relaxation.impacts().set(model, 1e-3, 0.5);
    relaxation.setCompliance(factor);
    residual[60] = residual[240] = 1500;
    relaxation.start(none, residual);
    relaxation.guess(0.0, cv, none);
    relaxation.solve(factor, nullptr, delta);
    settle(relaxation.evaluate(0.0, cv, delta, small, force));
  }
  /// Iterates near few points until all have converged; returns the number of iterations.
  int settle(double error) {
    int count = 0;
    for (; error > small && count < 60; ++count) {
      EXPECT_TRUE(relaxation.correct(0.0, cv, small, false));
      relaxation.solveNear(factor, small, delta);
      error = relaxation.evaluate(0.0, cv, delta, small, force);
    }
    EXPECT_LE(error, small);
    return count;
  }

  static constexpr double small = 1e-11;
  const Vector none = Vector::Zero(300);
  model::SecondOrderModel source;
  CompiledModel model;
  linalg::BlockFactor factor;
  Vector residual, delta = Vector::Zero(300);
  Strategies strategies;
  ContactForceUpdate relaxation;
  double force = 0;
};

TEST(ContactForceUpdate, GoesOnWhereItWasWhenAPointWasMissed) {
  SoftFloors all(true), later(false);
  auto& floors = later.model.points()[0];
  ASSERT_EQ(floors.active(), std::vector<int>{0});
  EXPECT_LT(later.delta[240], -2e-4) << "through a floor that is not looked at";
  ASSERT_TRUE(floors.addMissed(later.delta.data()));
  const Vector before = later.delta;
  later.force = 0;
  const double error = later.relaxation.join(0.0, cv, later.delta, later.small, later.force);
  EXPECT_EQ(before, later.delta);
  EXPECT_GT(later.force, 1e3 / ca) << "the force of the floor where the point is now";
  EXPECT_NEAR(error, later.force, 1e-3 * later.force) << "of which none has acted yet";
  EXPECT_GT(later.settle(error), 0);
  EXPECT_LT((all.delta - later.delta).cwiseAbs().maxCoeff(),
            1e-9 * all.delta.cwiseAbs().maxCoeff());
}

TEST(ContactForceUpdate, TakesNothingForAnImpactThatHasComeToRest) {
  SoftFloors step(false);
  auto& floors = step.model.points()[0];
  EXPECT_NEAR(step.delta[60], -1e-4, 1e-6);
  ASSERT_TRUE(floors.addMissed(step.delta.data()));
  step.settle(step.relaxation.join(0.0, cv, step.delta, step.small, step.force));
  // Within the micrometre a floor of 1e6 N/m is as steep as one of 1e9, which 1 kg would meet as an
  // impact in a step of 1 ms.
  const Vector q = step.delta, v = cv * step.delta;
  floors.evaluateWithTangent(0.0, q.data(), v.data());
  EXPECT_LT(floors.dfdd()[0], -1e8);
  EXPECT_FALSE(floors.isScaled());
}

/// Whether a mass of 1 kg, pressed onto a floor of this stiffness by 100 N, counts as an impact at
/// its expected final depth.
bool isImpact(double stiffness, double depth) {
  auto source = testing::springChain(1, 1.0, 0.0, 1e3);
  testing::addFloor(source, stiffness, 1e4, 1e9);
  CompiledModel model(source);
  model.setTime(0.0);
  auto& floor = model.points()[0];
  const Vector q = Vector::Constant(1, -depth), none = Vector::Zero(1),
               residual = Vector::Constant(1, 100.0), approach = Vector::Constant(1, -0.1);
  floor.look(0.0, 1e-3, q.data());
  linalg::BlockFactor factor(model.pattern());
  model.combine(ca, cv, 1.0, factor.values());
  EXPECT_LT(factor.factor(), 0);
  Strategies strategies;
  ContactForceUpdate relaxation;
  relaxation.bind(model, strategies);
  relaxation.setWeights(Vector::Constant(1, 1 / ca));
  relaxation.impacts().set(model, 1e-3, 0.5);
  relaxation.setCompliance(factor);
  const Vector start = q - approach / cv;  // with v = -0.1 m/s it ends at q
  relaxation.start(start, residual);
  relaxation.guess(0.0, cv, approach);
  floor.evaluateWithTangent(0.0, q.data(), approach.data());
  EXPECT_LT(floor.dfdd()[0], -2 * ca) << "steeper than the mass";
  return floor.isScaled();
}

TEST(ContactForceUpdate, TellsAStiffWallFromWhereASoftOneBegins) {
  EXPECT_TRUE(isImpact(1e9, 1e-6));
  EXPECT_TRUE(isImpact(1e9, 1e-10));
  EXPECT_FALSE(isImpact(1e6, 1e-10))
      << "it damps by 1 kN within a nanometre, but is no stiffer than 1e6 N/m beyond";
}

}  // namespace ContactForceUpdateTest
}  // namespace tooljoint::transient
