// SPDX-License-Identifier: BSD-3-Clause
#include "deck/PrintedUnits.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "common/Error.hpp"

namespace PrintedUnitsTest {

using namespace tooljoint::deck;

namespace PrintedUnitsTest {

/// Units of the field for the length of a test.
struct InField {
  InField() { printIn(PrintedSystem::Field); }
  ~InField() { printIn(PrintedSystem::Usual); }
};

TEST(PrintedUnits, UsualOnesAreThoseNamed) {
  EXPECT_EQ(printed(12345.678, "kN", 4), "12.35 kN");
  EXPECT_EQ(printed(0.0123, "mm", 3), "12.3 mm");
  EXPECT_EQ(printed(0.1, "N m"), "0.1 N m");
  EXPECT_EQ(printed(10012.4, "m", 4), "10012 m") << "no 1.001e+04 m";
  EXPECT_EQ(printed(-10012.6, "m", 4), "-10013 m");
  EXPECT_EQ(printed(9999.7, "m", 4), "10000 m");
  EXPECT_EQ(printed(1.0e9, "m", 4), "1e+09 m");
  EXPECT_EQ(PrintedUnit("deg/30 m").name(), "deg/30 m");
  EXPECT_NEAR(PrintedUnit("deg/30 m")(std::acos(-1.0) / 180.0 / 10.0), 3.0, 1e-13);
}

// 1 ft = 0.3048 m, 1 lbf = 4.4482216152605 N, exact (NIST SP 811, appendix B.8)
TEST(PrintedUnits, FieldUnitsAreExact) {
  const InField field;
  EXPECT_EQ(printed(3048.0, "m", 5), "10000 ft");
  EXPECT_EQ(printed(4448.2216152605, "kN", 5), "1 klbf");
  EXPECT_EQ(printed(4448.2216152605, "N"), "1000 lbf");
  EXPECT_NEAR(PrintedUnit("kN m").factor(), 1355.8179483314004, 1e-10);
  EXPECT_NEAR(PrintedUnit("MPa").factor(), 6894.757293168361, 1e-9);
  EXPECT_NEAR(PrintedUnit("kg/m3").factor(), 119.82642731689663, 1e-11);
  EXPECT_EQ(PrintedUnit("rpm").name(), "rpm");
  EXPECT_EQ(PrintedUnit("").name(), "");
}

TEST(PrintedUnits, EveryPairMeasuresTheSame) {
  for (const auto& unit : fieldUnits()) {
    EXPECT_GT(unit.factor(), 0.0) << unit.field;
    const InField field;
    EXPECT_EQ(PrintedUnit(unit.usual).name(), unit.field);
    EXPECT_EQ(PrintedUnit(unit.usual).factor(), unit.factor());
  }
}

TEST(PrintedUnits, AWrongNameIsRefused) {
  EXPECT_EQ(printedSystemOf("field"), PrintedSystem::Field);
  try {
    printedSystemOf("fields");
    FAIL();
  } catch (const tooljoint::UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("Did you mean \"field\"?"), std::string::npos);
  }
}

}  // namespace PrintedUnitsTest

}  // namespace PrintedUnitsTest
