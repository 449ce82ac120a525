// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The cost of the best method at a given error, on lines that are straight in logarithms.
#include "study/SpeedUp.hpp"

#include <gtest/gtest.h>

namespace SpeedUpTest {

using namespace tooljoint;

/// cost = 1/error for "a"; "b" is more expensive and has only one run.
const std::vector<study::CostPoint> points{
    {"a", 1e-1, 10.0}, {"a", 1e-3, 1000.0}, {"b", 1e-2, 500.0}};

TEST(BestCost, IsInterpolatedInLogarithms) {
  EXPECT_NEAR(*study::bestCostAt(1e-2, points), 100.0, 1e-9);  // b reaches it too, at 500
  EXPECT_NEAR(*study::bestCostAt(2e-3, points), 500.0, 1e-9);
}

TEST(BestCost, OfARunIsItsOwnAtItsOwnError) {
  EXPECT_NEAR(*study::bestCostAt(1e-3, points), 1000.0, 1e-9);
}

TEST(BestCost, ALargerErrorThanAllCostsTheCheapest) {
  EXPECT_EQ(*study::bestCostAt(0.9, points), 10.0);
}

TEST(BestCost, IsUnknownBelowAllErrors) { EXPECT_FALSE(study::bestCostAt(1e-4, points)); }

TEST(BestCost, LinesAreNotJoined) {
  const std::vector<study::CostPoint> apart{{"a", 1e-1, 1.0}, {"b", 1e-3, 100.0}};
  EXPECT_EQ(*study::bestCostAt(1e-2, apart), 100.0);  // only b is that accurate
}

TEST(BestCost, AnAccurateAndCheapRunWinsOverTheLineToAWorseOne) {
  const std::vector<study::CostPoint> odd{{"a", 1e-1, 50.0}, {"a", 1e-3, 5.0}};
  EXPECT_EQ(*study::bestCostAt(1e-2, odd), 5.0);
}

TEST(BestCost, AnErrorOfZeroIsAsGoodAsAny) {
  EXPECT_EQ(*study::bestCostAt(1e-9, {{"a", 0.0, 7.0}}), 7.0);
}

}  // namespace SpeedUpTest
