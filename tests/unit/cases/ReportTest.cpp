// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a run says of its estimated error.
#include "cases/run/Report.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <string>

namespace tooljoint::cases {
namespace {

TEST(Remarks, tellOfAnEstimateAboveAFifthAndOfFastMotion) {
  estimate::MotionEstimate error;
  error.error = 0.19;
  error.ofEverySecond = 0.18;
  EXPECT_TRUE(remarks(error).empty());
  error.error = 1.5;
  error.ofEverySecond = 1.4;
  ASSERT_EQ(remarks(error).size(), 1u);
  EXPECT_NE(remarks(error).front().find("150 %"), std::string::npos);
  error.error = std::numeric_limits<double>::quiet_NaN();
  error.ofEverySecond.reset();
  EXPECT_EQ(remarks(error).size(), 1u);
  error.error = 0.1;
  error.ofEverySecond = 0.01;
  ASSERT_EQ(remarks(error).size(), 1u);
  EXPECT_NE(remarks(error).front().find("faster than its samples"), std::string::npos);
}

}  // namespace
}  // namespace tooljoint::cases
