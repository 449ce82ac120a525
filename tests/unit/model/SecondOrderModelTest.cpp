// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The general model at a time and a state: every term with the value of its law, point forces and
/// their tangent.
#include "model/SecondOrderModel.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "model/laws/Connectors.hpp"

namespace SecondOrderModelTest {

using namespace tooljoint;
using model::DofLabel;
using model::SecondOrderModel;

Matrix numbers(double scale) { return scale * (Matrix(2, 2) << 1.0, 0.3, -0.4, 2.0).finished(); }

/// Two dofs; a spring with damper between d = 0.1 + 2 q_0 - q_1 and the ground.
SecondOrderModel sample() {
  SecondOrderModel m;
  m.componentNames = {"u", "v"};
  m.dofs = {DofLabel::physical(1, 0), DofLabel::physical(1, 1)};
  m.mass = Matrix(Matrix::Identity(2, 2)).sparseView();
  const int square = m.lawIndex({"t^2", [](double t) { return t * t; }});
  m.damping.push_back({"constant", numbers(3.0).sparseView(), 0});
  m.damping.push_back({"growing", numbers(5.0).sparseView(), square});
  m.stiffness.push_back({"constant", numbers(7.0).sparseView(), 0});
  m.stiffness.push_back({"growing", numbers(-2.0).sparseView(), square});
  m.loads.push_back({"weight", Vector::Constant(2, 4.0), 0});
  m.loads.push_back({"growing", Vector::Unit(2, 1), square});
  model::SpringParameters spring;
  spring.stiffness = 50.0;
  spring.cubicStiffness = 300.0;
  spring.damping = 6.0;
  model::PointSet set;
  set.name = "spring";
  set.law = model::springs({spring});
  set.entities = {1};
  set.rows = (Matrix(1, 2) << 2.0, -1.0).finished().sparseView();
  set.offset = Vector::Constant(1, 0.1);
  m.points.push_back(set);
  m.initialDisplacement = m.initialVelocity = Vector::Zero(2);
  return m;
}

TEST(SecondOrderModel, TermsHaveTheValueOfTheirLaw) {
  const auto m = sample();
  m.validate();
  EXPECT_LT((Matrix(m.dampingAt(3.0)) - numbers(3.0 + 9.0 * 5.0)).norm(), 1e-12);
  EXPECT_LT((Matrix(m.stiffnessAt(3.0)) - numbers(7.0 - 9.0 * 2.0)).norm(), 1e-12);
  EXPECT_LT((m.loadAt(3.0) - (Vector(2) << 4.0, 13.0).finished()).norm(), 1e-12);
}

TEST(SecondOrderModel, LawsOfOneNameAreOne) {
  auto m = sample();
  EXPECT_EQ(m.lawIndex(model::ScalarLaw::one()), 0);
  EXPECT_EQ(m.lawIndex({"t^2", [](double t) { return t; }}), 1);
  EXPECT_EQ(m.laws.size(), 2u);
}

/// R' f(offset + R q, R q'), and -R' df/dd R, the stiffness on the left-hand side.
TEST(SecondOrderModel, PointForcesAndTheirStiffness) {
  const auto m = sample();
  const Vector q = (Vector(2) << 0.2, 0.05).finished(), v = (Vector(2) << -0.3, 0.7).finished();
  const double d = 0.1 + 0.4 - 0.05, rate = -0.6 - 0.7,
               f = -50.0 * d - 300.0 * d * d * d - 6.0 * rate;
  EXPECT_LT((m.pointForce(0.0, q, v) - (Vector(2) << 2.0 * f, -f).finished()).norm(), 1e-12);
  const double k = 50.0 + 900.0 * d * d;
  const Matrix expected = k * (Matrix(2, 2) << 4.0, -2.0, -2.0, 1.0).finished();
  EXPECT_LT((Matrix(m.pointStiffness(0.0, q, v)) - expected).norm(), 1e-10);
}

TEST(SecondOrderModel, RefusesWhatDoesNotFitTogether) {
  auto m = sample();
  m.initialVelocity = Vector::Zero(3);
  EXPECT_THROW(m.validate(), ModelError);
  m = sample();
  m.stiffness.own()[0].law = 7;
  EXPECT_THROW(m.validate(), ModelError);
  m = sample();
  m.loads[0].vector[0] = std::nan("");
  EXPECT_THROW(m.validate(), ModelError);
}

TEST(SecondOrderModel, LoadsOnDofsThatNothingDeterminesAreFound) {
  auto m = sample();
  EXPECT_TRUE(m.loadsOnNothing().empty());
  m.mass = Sparse(2, 2);
  m.damping.clear(), m.stiffness.clear();
  EXPECT_TRUE(m.loadsOnNothing().empty()) << "the spring acts on both";
  m.points.clear();
  EXPECT_EQ(m.loadsOnNothing(), (std::vector<int>{0, 1}));
  m.loads = {{"second", Vector::Unit(2, 1), 0}};
  EXPECT_EQ(m.loadsOnNothing(), std::vector<int>{1});
  m.damping.push_back({"couples both", (Matrix(2, 2) << 0, 1, 0, 0).finished().sparseView(), 0});
  EXPECT_TRUE(m.loadsOnNothing().empty());
}

}  // namespace SecondOrderModelTest
