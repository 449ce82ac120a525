// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The relaxation of point forces near few points: what is measured after it, and that it ends where the relaxation of all ends.
#include "transient/PointRelaxation.hpp"

#include <gtest/gtest.h>

#include "Models.hpp"
#include "linalg/BlockFactor.hpp"

namespace tooljoint::transient {
namespace {

constexpr double ca = 4e6, cv = 2e3;  // steps of about 1 ms

/// A chain of 300 masses of 1 kg, of which two stand 0.1 mm above floors, is pressed onto one of them by 1500 N.
struct TwoFloors {
  TwoFloors() : source(testing::springChain(300, 1.0, 0.0, 1e6)), model(withFloors(source)), factor(model.pattern()), residual(Vector::Zero(300)) {
    const Vector q = Vector::Constant(300, 1e-4);
    model.setTime(0.0);
    for (auto& batch : model.points()) batch.look(0.0, 1e-3, q.data());
    model.combine(ca, cv, 1.0, factor.values());
    EXPECT_LT(factor.factor(), 0);
    relaxation.bind(model);
    relaxation.setWeights(Vector::Constant(300, 1 / ca));
    relaxation.setCompliance(factor);
    residual[60] = 1500;
    relaxation.start(q, residual);
    relaxation.guess(0.0, cv, Vector::Zero(300));
    relaxation.solve(factor, nullptr, delta);
  }
  static const model::SecondOrderModel& withFloors(model::SecondOrderModel& chain) {
    model::PointSet set;
    set.name = "floor";
    set.law = std::make_shared<testing::Floor>(2, 1e6, 10.0, 1e5);
    set.rows.resize(2, 300);
    set.rows.insert(0, 60) = set.rows.insert(1, 240) = 1;
    set.offset = Vector::Zero(2);
    set.entities = {61, 241};
    chain.points.push_back(set);
    return chain;
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
  PointRelaxation relaxation;
};

TEST(PointRelaxation, MeasuresAPointAgainWhoseChangeDoesNotTravel) {
  TwoFloors step;
  const double before = step.error();
  ASSERT_GT(before, 1e3 * step.small);
  ASSERT_TRUE(step.relaxation.correct(0.0, cv, step.small, false)) << "one point of 300 positions is few";
  step.relaxation.solveNear(step.factor, 1e9, step.delta);  // nothing is large enough to travel
  EXPECT_EQ(step.relaxation.nearShare(), 0.0);
  EXPECT_LT(step.error(), 1e-3 * before) << "its force is now that of where it is";
}

TEST(PointRelaxation, NearFewPointsEndsWhereAllEnd) {
  TwoFloors all, near;
  for (int iteration = 0; all.error() > all.small; ++iteration) {
    ASSERT_LT(iteration, 50);
    all.relaxation.correct(0.0, cv, all.small, true);
    all.relaxation.solve(all.factor, nullptr, all.delta);
  }
  for (int iteration = 0; near.error() > near.small; ++iteration) {
    ASSERT_LT(iteration, 50);
    ASSERT_TRUE(near.relaxation.correct(0.0, cv, near.small, false));
    near.relaxation.solveNear(near.factor, near.small, near.delta);
    EXPECT_LT(near.relaxation.nearShare(), 0.5) << "a force reaches a few neighbours in a step";
  }
  EXPECT_LT(all.delta[60], -1e-4) << "pressed into the floor";
  EXPECT_LT((all.delta - near.delta).cwiseAbs().maxCoeff(), 1e-10 * all.delta.cwiseAbs().maxCoeff() + 10 * near.small);
}

}  // namespace
}  // namespace tooljoint::transient
