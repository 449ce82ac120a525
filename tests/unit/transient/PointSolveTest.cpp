// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// One point against its compliance: balances of sharp contact with friction that falls with speed,
/// from states around touching and sticking.
#include "transient/contact/PointSolve.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>
#include <random>

#include "Models.hpp"
#include "substructures/contact/ContactLaw.hpp"
#include "transient/compiled/CompiledModel.hpp"

namespace tooljoint::transient {
namespace PointSolveTest {

/// A node of 100 kg and 0.6 kg m^2 in a bore that turns with 0.1 rad/s, friction 0.4 falling to 0.3
/// within `velocity`.
model::SecondOrderModel nodeInBore(double velocity) {
  auto source = testing::denseModel(Eigen::Vector3d(100, 100, 0.6).asDiagonal(), Matrix(),
                                    Matrix::Identity(3, 3), 3);
  contact::ContactPoints points;
  points.add({1, 0.028, 0.08, 1e7, 1e4, 7e11, 7e11, 0.4, 0.3, velocity});
  model::PointSet set;
  set.name = "contact";
  set.law = contact::makeLaw("Nguyen")->inMotion(points, [](double) { return 0.1; });
  set.rows = Matrix(Matrix::Identity(3, 3)).sparseView();
  set.offset = Vector::Zero(3);
  set.entities = {1};
  source.points.push_back(set);
  return source;
}

/// |y - free - G phi| in units of 1/sqrt(G_ii), relative to |free| + |y|.
double imbalance(const PointSolve& problem, const PointSolve::Local& y,
                 const PointSolve::Local& phi) {
  const PointSolve::Local scale = problem.G.diagonal().cwiseSqrt().cwiseInverse();
  const auto size = [&](const PointSolve::Local& x) { return x.cwiseProduct(scale).norm(); };
  return size(y - problem.free - problem.G * phi) / (size(problem.free) + size(y));
}

/// Steps of 1 ms from within 0.2 mm of the wall, with speeds from rest to a few v_r and more.
Strategies strategies;  ///< all of them

PointSolve randomProblem(std::mt19937& random, double velocity) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const double h = 1e-3, angle = 3 * uniform(random), radius = 0.028 + 2e-4 * uniform(random);
  const Eigen::Vector3d mass(100, 100, 0.6);
  PointSolve problem;
  problem.strategies = &strategies;
  problem.P = PointSolve::LocalMatrix::Zero(3, 3);
  problem.f0 = PointSolve::Local::Zero(3);
  problem.d = Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), 0);
  const double slip = velocity * std::pow(10.0, 1.5 * uniform(random)) *
                      (uniform(random) > 0 ? 1 : -1),
               inwards = 0.02 * uniform(random);
  problem.v =
      Eigen::Vector3d(inwards * std::cos(angle) - slip * std::sin(angle),
                      inwards * std::sin(angle) + slip * std::cos(angle), 0.01 * uniform(random));
  Eigen::Matrix3d S = (4e6 * mass).asDiagonal();
  const Eigen::Vector3d unit = mass.cwiseSqrt() * 2e3;
  S(0, 1) = S(1, 0) = 0.3 * uniform(random) * unit[0] * unit[1];
  S(0, 2) = S(2, 0) = 0.3 * uniform(random) * unit[0] * unit[2];
  problem.G = S.inverse();
  problem.free =
      h * Eigen::Vector3d(0.02 * uniform(random), 0.02 * uniform(random), 0.02 * uniform(random));
  return problem;
}

/// All but one in three thousand, for which the step can still use Newton's method for the whole
/// model and shorter steps; without the path it is one in a thousand.
TEST(PointSolve, findsABalanceOfSharpContactAndFallingFriction) {
  for (const double velocity : {0.1, 1e-3, 1e-4}) {
    const auto source = nodeInBore(velocity);
    CompiledModel model(source);
    std::mt19937 random(7);
    int touching = 0, lost = 0;
    for (int k = 0; k < 30000; ++k) {
      const PointSolve problem = randomProblem(random, velocity);
      PointSolve::Local y = PointSolve::Local::Zero(3), phi;
      ASSERT_TRUE(problem.solve(model.points()[0], 0.0, 2e3, y, phi));
      touching += phi.norm() > 1.0 ? 1 : 0;
      lost += imbalance(problem, y, phi) > 1e-8 ? 1 : 0;
    }
    EXPECT_GT(touching, 5000) << velocity;
    EXPECT_LE(lost, 10) << velocity;
  }
}

/// Nodes that hit the wall with enough damping to reverse within the step come to rest where the
/// law switches, within 1e-12 m. This balance is accurate only to the rounding of the position, and
/// is accepted.
TEST(PointSolve, takesABalanceKnownToRoundingForOne) {
  const auto source = nodeInBore(0.1);
  CompiledModel model(source);
  PointBatch& batch = model.points()[0];
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  constexpr int count = 1000;
  long most = 0;
  for (int k = 0; k < count; ++k) {
    const double speed = 0.02 + 0.1 * uniform(random), angle = 6 * uniform(random),
                 thrown = 1e4 * speed / 4e8;  // c v / (ca m)
    const Eigen::Vector3d outwards(std::cos(angle), std::sin(angle), 0);
    PointSolve problem;
    problem.strategies = &strategies;
    problem.P = PointSolve::LocalMatrix::Zero(3, 3);
    problem.f0 = PointSolve::Local::Zero(3);
    problem.d = (0.028 - 1e-5) * outwards;
    problem.v = speed * outwards;
    problem.G = (4e6 * Eigen::Vector3d(100, 100, 0.6)).cwiseInverse().asDiagonal();
    problem.free = (1e-5 + thrown * (0.1 + 0.8 * uniform(random))) * outwards;
    PointSolve::Local y = problem.free, phi;
    const long before = batch.evaluations();
    ASSERT_TRUE(problem.solve(batch, 0.0, 2e3, y, phi));
    most = std::max(most, batch.evaluations() - before);
    ASSERT_LT(imbalance(problem, y, phi), 1e-5);
    ASSERT_LT(std::abs((problem.d + y).head(2).norm() - 0.028), 1e-9)
        << "it stays where the law switches";
    ASSERT_GT(phi.norm(), 1.0);
  }
  EXPECT_LT(most, 1000);
}

}  // namespace PointSolveTest
}  // namespace tooljoint::transient
