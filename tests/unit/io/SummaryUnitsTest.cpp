// SPDX-License-Identifier: BSD-3-Clause
#include "io/summary/SummaryUnits.hpp"

#include <gtest/gtest.h>
#include <set>

#include "io/summary/Summary.hpp"

namespace SummaryUnitsTest {

using namespace tooljoint::io;

TEST(SummaryUnits, OfKeysThatAreDocumented) {
  EXPECT_EQ(unitOfKey("static.top_torque"), "N m");
  EXPECT_EQ(unitOfKey("transient.figures.lateral_acceleration.worst_rms"), "m/s2");
  EXPECT_EQ(unitOfKey("transient.figures.lateral_acceleration.worst_rms_depth"), "m");
  EXPECT_EQ(unitOfKey("transient.figures.lateral_acceleration.worst_rms_node"), "");
  EXPECT_EQ(unitOfKey("transient.figures.stick_slip_index"), "");
  std::multiset<std::string> units;
  for (const auto& key : Summary::keys()) units.insert(unitOfKey(key));
  EXPECT_GE(units.count("N"), 9U);
  EXPECT_GE(units.count("N m"), 10U);
  EXPECT_GE(units.count("m"), 3U);
}

}  // namespace SummaryUnitsTest
