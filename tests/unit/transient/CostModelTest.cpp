// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The predicted cost of a step against counts made by hand.
#include "transient/CostModel.hpp"

#include <gtest/gtest.h>

#include "Models.hpp"

namespace tooljoint::transient::testing {
namespace CostModelTest {

TEST(CostModel, growsWithTheLengthOfAChain) {
  const auto o = options("Generalized-alpha", 1, 1e-3, 0.1);
  const auto one = costModel(springChain(100, 1, 0.1, 100), o);
  const auto ten = costModel(springChain(1000, 1, 0.1, 100), o);
  EXPECT_EQ(one.size, 100);
  EXPECT_NEAR(ten.total() / one.total(), 10, 0.3);
  EXPECT_EQ(one.points, 0);
}

TEST(CostModel, fullMatricesCostTheSquare) {
  const auto o = options("Generalized-alpha", 1, 1e-3, 0.1);
  const auto full = [](int n) {
    Matrix K = Matrix::Constant(n, n, 1.0);
    K.diagonal().array() += 2.0 * n;
    return denseModel(K, Matrix(), K, n);
  };
  const auto small = costModel(full(20), o), large = costModel(full(40), o);
  EXPECT_NEAR(large.solves / small.solves, 4, 0.2);
  EXPECT_NEAR(large.products / small.products, 4, 0.2);
}

TEST(CostModel, countsThePointsThatAreNear) {
  const auto o = options("Generalized-alpha", 1, 1e-3, 0.1);
  auto model = droppedBalls(10, 1e6, 2e3, 7e11);
  model.initialDisplacement.setConstant(-1e-4);
  const double touching = costModel(model, o).points;
  model.initialDisplacement.setConstant(10.0);
  EXPECT_GT(touching, 10 * costModel(model, o).points);
}

TEST(CostModel, explicitStepsSolveWithTheMassMatrixFourTimes) {
  const auto model = springChain(50, 1, 0.1, 100);
  const auto cost = costModel(model, options("RK4", 1, 1e-3, 0.1));
  const auto implicit = costModel(model, options("Generalized-alpha", 1, 1e-3, 0.1));
  EXPECT_DOUBLE_EQ(cost.solves / implicit.solves,
                   4.0 / 3.0);  // two relaxations and the phase correction
}

}  // namespace CostModelTest
}  // namespace tooljoint::transient::testing
