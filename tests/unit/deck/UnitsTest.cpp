// SPDX-License-Identifier: BSD-3-Clause
#include "deck/Units.hpp"

#include <cmath>
#include <gtest/gtest.h>

using namespace tooljoint::deck;

namespace {
constexpr double pi = 3.141592653589793238462643383279502884;
}

struct Quantity {
  std::string text, si;
  double value;
  friend std::ostream& operator<<(std::ostream& out, const Quantity& t) { return out << t.text; }
};
class UnitConversion : public ::testing::TestWithParam<Quantity> {};

TEST_P(UnitConversion, IsRightToTheLastDigits) {
  std::string fault;
  const auto value = toSi(GetParam().text, GetParam().si, fault);
  ASSERT_TRUE(value) << fault;
  EXPECT_NEAR(*value, GetParam().value, 4e-16 * std::abs(GetParam().value));
}

// Inch, foot, pound, standard gravity and US gallon are exact by definition (NIST SP 811, appendix B).
INSTANTIATE_TEST_SUITE_P(
    Table, UnitConversion,
    ::testing::Values(
        Quantity{"5 m", "m", 5.0}, Quantity{"12.5 mm", "m", 0.0125}, Quantity{"3 cm", "m", 0.03}, Quantity{"1.2 km", "m", 1200.0},
        Quantity{"100 ft", "m", 30.48}, Quantity{"5 in", "m", 0.127}, Quantity{"-5in", "m", -0.127},
        Quantity{"+5 in", "m", 0.127}, Quantity{"10 N", "N", 10.0}, Quantity{"10 kN", "N", 1e4}, Quantity{"2 MN", "N", 2e6},
        Quantity{"1 lbf", "N", 4.4482216152605}, Quantity{"20 klbf", "N", 88964.43230521}, Quantity{"3 N m", "N m", 3.0},
        Quantity{"3 kN m", "N m", 3000.0}, Quantity{"3 kNm", "N m", 3000.0}, Quantity{"1 ft lbf", "N m", 1.3558179483314004},
        Quantity{"1 ft*lbf", "N m", 1.3558179483314004}, Quantity{"7 Pa", "Pa", 7.0}, Quantity{"7 kPa", "Pa", 7e3},
        Quantity{"7 MPa", "Pa", 7e6}, Quantity{"210 GPa", "Pa", 2.1e11}, Quantity{"1 psi", "Pa", 6894.757293168361},
        Quantity{"2 bar", "Pa", 2e5}, Quantity{"7850 kg/m3", "kg/m3", 7850.0}, Quantity{"7.85 g/cm3", "kg/m3", 7850.0},
        Quantity{"7850 kg/m^3", "kg/m3", 7850.0}, Quantity{"1 ppg", "kg/m3", 119.82642731689663},
        Quantity{"120 rpm", "rad/s", 4.0 * pi}, Quantity{"3 rad/s", "rad/s", 3.0}, Quantity{"180 deg/s", "rad/s", pi},
        Quantity{"2 rev/min", "rad/s", 2.0 * pi / 30.0}, Quantity{"5 Hz", "Hz", 5.0}, Quantity{"2 kHz", "Hz", 2000.0},
        Quantity{"90 deg", "rad", pi / 2.0}, Quantity{"1 rad", "rad", 1.0}, Quantity{"2 s", "s", 2.0},
        Quantity{"5 ms", "s", 0.005}, Quantity{"2 min", "s", 120.0}, Quantity{"0.5 h", "s", 1800.0},
        Quantity{"0.03 m3/s", "m3/s", 0.03}, Quantity{"600 l/min", "m3/s", 0.01}, Quantity{"1 gpm", "m3/s", 6.30901964e-5},
        Quantity{"3 1/s", "1/s", 3.0}, Quantity{"4 N/m", "N/m", 4.0}, Quantity{"4 kN/m", "N/m", 4000.0},
        Quantity{"4 MN/m", "N/m", 4e6}, Quantity{"4 N s/m", "N s/m", 4.0}, Quantity{"4 kN s/m", "N s/m", 4000.0},
        Quantity{"0.01 kg m", "kg m", 0.01}, Quantity{"10 g m", "kg m", 0.01}, Quantity{"0.1 1/m", "1/m", 0.1},
        Quantity{"3 m2/s", "m2/s", 3.0}, Quantity{"1 cSt", "m2/s", 1e-6}, Quantity{"1 cP", "Pa s", 1e-3},
        Quantity{"3 deg/30m", "rad/m", 3.0 * pi / 180.0 / 30.0}, Quantity{"60 ft/h", "m/s", 60.0 * 0.3048 / 3600.0},
        Quantity{"9.81 m/s2", "m/s2", 9.81}, Quantity{"1 m s^-2", "m/s2", 1.0}, Quantity{"1 m/s/s", "m/s2", 1.0},
        Quantity{"2 kN m/(rad)", "N m/rad", 2000.0}, Quantity{"8 kg/(m s)", "Pa s", 8.0}, Quantity{"100 mm2", "m2", 1e-4},
        Quantity{"2 mm4", "m4", 2e-12}, Quantity{"1e3 mm", "m", 1.0}, Quantity{"1e-3 km", "m", 1.0}, Quantity{"0 in", "m", 0.0},
        Quantity{"5 in", "mm", 127.0}));

struct Refusal {
  std::string text, si, fault;
  friend std::ostream& operator<<(std::ostream& out, const Refusal& t) { return out << t.text; }
};
class UnitRefusal : public ::testing::TestWithParam<Refusal> {};

TEST_P(UnitRefusal, SaysWhy) {
  std::string fault;
  EXPECT_FALSE(toSi(GetParam().text, GetParam().si, fault));
  EXPECT_EQ(fault.substr(0, GetParam().fault.size()), GetParam().fault) << fault;
}

INSTANTIATE_TEST_SUITE_P(
    Table, UnitRefusal,
    ::testing::Values(
        Refusal{"5", "m", "has no unit; expected is a number and a unit such as \"m\", \"mm\", \"cm\", \"km\", \"ft\", \"in\""},
        Refusal{"five in", "m", "does not begin with a number"}, Refusal{"", "m", "does not begin with a number"},
        Refusal{"in", "m", "does not begin with a number"}, Refusal{"nan m", "m", "does not begin with a number"},
        Refusal{"inf m", "m", "does not begin with a number"}, Refusal{"--5 m", "m", "does not begin with a number"},
        Refusal{"1e999 m", "m", "is a number too large or too small for a double"},
        Refusal{"1e308 km", "m", "is a number too large for a double"},
        Refusal{"1,5 m", "m", "has a decimal comma; write a decimal point"},
        Refusal{"5 inch", "m", "has a unit that is not understood: \"inch\" is not a known unit (did you mean \"in\"?)"},
        Refusal{"120 RPM", "rad/s", "has a unit that is not understood: \"RPM\" is not a known unit (did you mean \"rpm\"?)"},
        Refusal{"5 m m", "m", "has the unit \"m m\", which does not measure what is asked for here (m)"},
        Refusal{"5 in", "N", "has the unit \"in\", which does not measure what is asked for here (N)"},
        Refusal{"2 Hz", "rad/s", "has the unit \"Hz\", which does not measure what is asked for here (rad/s)"},
        Refusal{"2 rpm", "Hz", "has the unit \"rpm\", which does not measure what is asked for here (Hz)"},
        Refusal{"2 1/s", "rad/s", "has the unit \"1/s\", which does not measure what is asked for here (rad/s)"},
        Refusal{"2 1/s", "Hz", "has the unit \"1/s\", which does not measure what is asked for here (Hz)"},
        Refusal{"1 lbm", "N", "has the unit \"lbm\""}, Refusal{"5 m5mm", "m", "has the unit \"m5mm\""},
        Refusal{"5 m/", "m", "has a unit that is not understood: the unit \"m/\" ends too early"},
        Refusal{"5 /m", "1/m", "has a unit that is not understood: \"/m\" is not a unit"},
        Refusal{"5 N/m s", "N s/m", "has a unit that is not understood: the unit \"N/m s\" is ambiguous"},
        Refusal{"5 m^", "m", "has a unit that is not understood: an exponent is missing"},
        Refusal{"5 m-", "m", "has a unit that is not understood: an exponent is missing"},
        Refusal{"5 m12", "m", "has a unit that is not understood: an exponent in the unit \"m12\" is too large"},
        Refusal{"5 (m", "m", "has a unit that is not understood: a \")\" is missing"},
        Refusal{"5 m)", "m", "has a unit that is not understood: \")\" is not understood"},
        Refusal{"5 m/0s", "m/s", "has a unit that is not understood: the number in the unit"},
        Refusal{"5 %", "m", "has a unit that is not understood: \"%\" is not a unit"},
        Refusal{"5 m", "", "stands where a plain number is expected"}, Refusal{"5 m", "s^x", "must be a plain number in s^x"}));

TEST(Units, DeepParenthesesAreRefusedNotFollowed) {
  std::string fault;
  EXPECT_FALSE(parseUnit(std::string(100000, '(') + "m", &fault));
  EXPECT_EQ(fault, "the unit is nested too deeply");
}

TEST(Units, EverySymbolOfTheTableReadsAsItself) {
  for (const UnitSymbol& symbol : unitSymbols()) {
    const auto unit = parseUnit(symbol.symbol);
    ASSERT_TRUE(unit) << symbol.symbol;
    EXPECT_DOUBLE_EQ(unit->factor, symbol.unit.factor) << symbol.symbol;
    EXPECT_EQ(unit->dimension, symbol.unit.dimension) << symbol.symbol;
  }
}

TEST(Units, OfferedUnitsAllMeasureWhatIsAsked) {
  for (const char* si : {"m", "N", "N m", "Pa", "kg/m3", "rad/s", "Hz", "rad", "s", "m3/s", "1/s", "N/m", "N s/m", "kg m", "1/m",
                         "m2/s", "kg", "m2", "m4"}) {
    const auto offered = unitsLike(si);
    EXPECT_FALSE(offered.empty()) << si;
    for (const std::string& unit : offered) {
      std::string fault;
      EXPECT_TRUE(toSi("1 " + unit, si, fault)) << si << " offers " << unit << " but " << fault;
    }
  }
}
