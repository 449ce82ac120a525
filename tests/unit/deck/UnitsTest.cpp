// SPDX-License-Identifier: BSD-3-Clause
#include "deck/reading/Units.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <map>

#include "common/Constants.hpp"

namespace UnitsTest {

using namespace tooljoint::deck;

using tooljoint::constants::pi;

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

// Inch, foot, pound, standard gravity and US gallon are exact by definition (NIST SP 811, appendix
// B).
INSTANTIATE_TEST_SUITE_P(
    Table, UnitConversion,
    ::testing::Values(
        Quantity{"5 m", "m", 5.0}, Quantity{"12.5 mm", "m", 0.0125}, Quantity{"1 um", "m", 1e-6},
        Quantity{"3 cm", "m", 0.03}, Quantity{"1.2 km", "m", 1200.0},
        Quantity{"100 ft", "m", 30.48}, Quantity{"5 in", "m", 0.127}, Quantity{"-5in", "m", -0.127},
        Quantity{"+5 in", "m", 0.127}, Quantity{"10 N", "N", 10.0}, Quantity{"10 kN", "N", 1e4},
        Quantity{"2 MN", "N", 2e6}, Quantity{"1 lbf", "N", 4.4482216152605},
        Quantity{"20 klbf", "N", 88964.43230521}, Quantity{"3 N m", "N m", 3.0},
        Quantity{"3 kN m", "N m", 3000.0}, Quantity{"3 kNm", "N m", 3000.0},
        Quantity{"1 ft lbf", "N m", 1.3558179483314004},
        Quantity{"1 ft*lbf", "N m", 1.3558179483314004}, Quantity{"7 Pa", "Pa", 7.0},
        Quantity{"7 kPa", "Pa", 7e3}, Quantity{"7 MPa", "Pa", 7e6},
        Quantity{"210 GPa", "Pa", 2.1e11}, Quantity{"1 psi", "Pa", 6894.757293168361},
        Quantity{"135 ksi", "Pa", 135e3 * 6894.757293168361}, Quantity{"2 bar", "Pa", 2e5},
        Quantity{"7850 kg/m3", "kg/m3", 7850.0}, Quantity{"7.85 g/cm3", "kg/m3", 7850.0},
        Quantity{"7.85 g/cc", "kg/m3", 7850.0}, Quantity{"1.2 SG", "kg/m3", 1200.0},
        Quantity{"7850 kg/m^3", "kg/m3", 7850.0}, Quantity{"1 ppg", "kg/m3", 119.82642731689663},
        Quantity{"120 rpm", "rad/s", 4.0 * pi}, Quantity{"3 rad/s", "rad/s", 3.0},
        Quantity{"180 deg/s", "rad/s", pi}, Quantity{"2 rev/min", "rad/s", 2.0 * pi / 30.0},
        Quantity{"5 Hz", "Hz", 5.0}, Quantity{"2 kHz", "Hz", 2000.0},
        Quantity{"90 deg", "rad", pi / 2.0}, Quantity{"1 rad", "rad", 1.0},
        Quantity{"2 s", "s", 2.0}, Quantity{"5 ms", "s", 0.005}, Quantity{"2 min", "s", 120.0},
        Quantity{"0.5 h", "s", 1800.0}, Quantity{"0.03 m3/s", "m3/s", 0.03},
        Quantity{"600 l/min", "m3/s", 0.01}, Quantity{"1 gpm", "m3/s", 6.30901964e-5},
        Quantity{"3 1/s", "1/s", 3.0}, Quantity{"4 N/m", "N/m", 4.0},
        Quantity{"4 kN/m", "N/m", 4000.0}, Quantity{"4 MN/m", "N/m", 4e6},
        Quantity{"4 N s/m", "N s/m", 4.0}, Quantity{"4 kN s/m", "N s/m", 4000.0},
        Quantity{"0.01 kg m", "kg m", 0.01}, Quantity{"10 g m", "kg m", 0.01},
        Quantity{"0.1 1/m", "1/m", 0.1}, Quantity{"3 m2/s", "m2/s", 3.0},
        Quantity{"1 cSt", "m2/s", 1e-6}, Quantity{"1 cP", "Pa s", 1e-3},
        Quantity{"3 deg/30m", "rad/m", 3.0 * pi / 180.0 / 30.0},
        Quantity{"60 ft/h", "m/s", 60.0 * 0.3048 / 3600.0}, Quantity{"9.81 m/s2", "m/s2", 9.81},
        Quantity{"1 m s^-2", "m/s2", 1.0}, Quantity{"1 m/s/s", "m/s2", 1.0},
        Quantity{"2 kN m/(rad)", "N m/rad", 2000.0}, Quantity{"8 kg/(m s)", "Pa s", 8.0},
        Quantity{"100 mm2", "m2", 1e-4}, Quantity{"2 mm4", "m4", 2e-12},
        Quantity{"1e3 mm", "m", 1.0}, Quantity{"1e-3 km", "m", 1.0}, Quantity{"0 in", "m", 0.0},
        Quantity{"5 in", "mm", 127.0},
        // compounds of the oil field; 1 ft lbf = 0.3048 x 4.4482216152605 N m
        Quantity{"1 ft-lbf", "N m", 1.3558179483314004},
        Quantity{"1 ft.lbf", "N m", 1.3558179483314004},
        Quantity{"1 ft-lb", "N m", 1.3558179483314004},
        Quantity{"1 kft-lbf", "N m", 1355.8179483314004},
        Quantity{"1 kft.lb", "N m", 1355.8179483314004},
        Quantity{"1 in-lbf", "N m", 0.11298482902761670}, Quantity{"2 kN.m", "N m", 2000.0},
        Quantity{"2 kN-m", "N m", 2000.0}, Quantity{"10 klb", "N", 44482.216152605},
        Quantity{"10 kip", "N", 44482.216152605}, Quantity{"5 daN", "N", 50.0},
        Quantity{"2 t", "kg", 2000.0}, Quantity{"2 t", "N", 19613.3},
        Quantity{"2 tf", "N", 19613.3}, Quantity{"1.25 sg", "kg/m3", 1250.0},
        Quantity{"10 lb/gal", "kg/m3", 1198.2642731689663},
        Quantity{"75 pcf", "kg/m3", 1201.3847530470105},
        Quantity{"75 lb/ft3", "kg/m3", 1201.3847530470105}, Quantity{"600 lpm", "m3/s", 0.01},
        Quantity{"1 bbl/min", "m3/s", 0.0026497882488}, Quantity{"5 inch", "m", 0.127},
        Quantity{"2 ft/s", "m/s", 0.6096},
        Quantity{"3 \u00b0/30m", "rad/m", 3.0 * pi / 180.0 / 30.0}, Quantity{"2 kg.m", "kg m", 2.0},
        Quantity{"4 s-1", "1/s", 4.0}));

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
        Refusal{"5", "m",
                "has no unit; expected is a number and a unit such as \"m\", \"mm\", \"cm\", "
                "\"km\", \"ft\", \"in\""},
        Refusal{"five in", "m", "does not begin with a number"},
        Refusal{"", "m", "does not begin with a number"},
        Refusal{"in", "m", "does not begin with a number"},
        Refusal{"nan m", "m", "does not begin with a number"},
        Refusal{"inf m", "m", "does not begin with a number"},
        Refusal{"--5 m", "m", "does not begin with a number"},
        Refusal{"1e999 m", "m", "is a number too large or too small for a double"},
        Refusal{"1e308 km", "m", "is a number too large for a double"},
        Refusal{"1,5 m", "m", "has a decimal comma; write a decimal point"},
        Refusal{"5 inchs", "m",
                "has a unit that is not understood: \"inchs\" is not a known unit (did you mean "
                "\"inch\"?)"},
        Refusal{"5 ft-", "m", "has a unit that is not understood: an exponent is missing"},
        Refusal{"5 ft.", "m", "has a unit that is not understood: \".\" is not a unit"},
        Refusal{"5 kip", "kg",
                "has the unit \"kip\", which is not a unit of the expected quantity (kg)"},
        Refusal{"5 tf", "kg",
                "has the unit \"tf\", which is not a unit of the expected quantity (kg)"},
        Refusal{"5 t", "kg/m3",
                "has the unit \"t\", which is not a unit of the expected quantity (kg/m3)"},
        Refusal{"1.2 sg", "N",
                "has the unit \"sg\", which is not a unit of the expected quantity (N)"},
        Refusal{"120 Rpm", "rad/s",
                "has a unit that is not understood: \"Rpm\" is not a known unit (did you mean "
                "\"rpm\"?)"},
        Refusal{"5 m m", "m",
                "has the unit \"m m\", which is not a unit of the expected quantity (m)"},
        Refusal{"5 in", "N",
                "has the unit \"in\", which is not a unit of the expected quantity (N)"},
        Refusal{"2 Hz", "rad/s",
                "has the unit \"Hz\", which is not a unit of the expected quantity (rad/s)"},
        Refusal{"2 rpm", "Hz",
                "has the unit \"rpm\", which is not a unit of the expected quantity (Hz)"},
        Refusal{"2 1/s", "rad/s",
                "has the unit \"1/s\", which is not a unit of the expected quantity (rad/s)"},
        Refusal{"2 1/s", "Hz",
                "has the unit \"1/s\", which is not a unit of the expected quantity (Hz)"},
        Refusal{"1 lbm", "N", "has the unit \"lbm\""},
        Refusal{"5 m5mm", "m", "has the unit \"m5mm\""},
        Refusal{"5 m/", "m", "has a unit that is not understood: the unit \"m/\" ends too early"},
        Refusal{"5 /m", "1/m", "has a unit that is not understood: \"/m\" is not a unit"},
        Refusal{"5 N/m s", "N s/m",
                "has a unit that is not understood: the unit \"N/m s\" is ambiguous"},
        Refusal{"5 m^", "m", "has a unit that is not understood: an exponent is missing"},
        Refusal{"5 m-", "m", "has a unit that is not understood: an exponent is missing"},
        Refusal{"5 m12", "m",
                "has a unit that is not understood: an exponent in the unit \"m12\" is too large"},
        Refusal{"5 (m", "m", "has a unit that is not understood: a \")\" is missing"},
        Refusal{"5 m)", "m", "has a unit that is not understood: \")\" is not understood"},
        Refusal{"5 m/0s", "m/s", "has a unit that is not understood: the number in the unit"},
        Refusal{"5 %", "m", "has a unit that is not understood: \"%\" is not a unit"},
        Refusal{"5 m", "", "stands where a plain number is expected"},
        Refusal{"5 m", "s^x", "must be a plain number in s^x"}));

TEST(Units, DeepParenthesesAreRefusedNotFollowed) {
  std::string fault;
  EXPECT_FALSE(parseUnit(std::string(100000, '(') + "m", &fault));
  EXPECT_EQ(fault, "the unit is nested too deeply");
}

/// One unit of the reference table below: its quantity, its spelling, and its value in SI.
struct ReferenceUnit {
  std::string quantity, si, symbol;
  double value;
  std::vector<std::string> synonyms;
};

/// Values from the definitions, written as decimal numbers and not computed from each other. Exact:
/// inch 0.0254 m, foot 0.3048 m, pound 0.45359237 kg, standard gravity 9.80665 m/s2, and so the
/// pound-force 4.4482216152605 N; US gallon 3.785411784e-3 m3 (231 cubic inches); barrel 42 US
/// gallons; bar, minute, hour (NIST SP 811, appendix B.8). psi, ppg and pcf are quotients of these,
/// rounded to 17 digits with 40-digit arithmetic; degree, revolution and rpm are multiples of pi.
const std::vector<ReferenceUnit> referenceUnits = {
    {"length", "m", "m", 1.0, {"meter", "meters", "metre", "metres"}},
    {"length", "m", "mm", 0.001, {}},
    {"length", "m", "cm", 0.01, {}},
    {"length", "m", "km", 1000.0, {}},
    {"length", "m", "ft", 0.3048, {"foot", "feet"}},
    {"length", "m", "in", 0.0254, {"inch", "inches"}},
    {"length", "m", "kft", 304.8, {}},
    {"length", "m", "um", 1e-6, {}},
    {"mass", "kg", "kg", 1.0, {}},
    {"mass", "kg", "g", 0.001, {}},
    {"mass", "kg", "t", 1000.0, {"tonne", "tonnes"}},
    {"mass", "kg", "lbm", 0.45359237, {}},
    {"mass", "kg", "lb", 0.45359237, {"lbs"}},
    {"mass", "kg", "klb", 453.59237, {"klbs"}},
    {"time", "s", "s", 1.0, {"sec", "second", "seconds"}},
    {"time", "s", "ms", 0.001, {}},
    {"time", "s", "us", 1e-6, {}},
    {"time", "s", "min", 60.0, {"minute", "minutes"}},
    {"time", "s", "h", 3600.0, {"hr", "hour", "hours"}},
    {"angle", "rad", "rad", 1.0, {"radian", "radians"}},
    {"angle", "rad", "deg", 0.017453292519943295, {"\u00b0", "degree", "degrees"}},
    {"angle", "rad", "rev", 6.283185307179586, {"r"}},
    {"force", "N", "N", 1.0, {"newton"}},
    {"force", "N", "daN", 10.0, {}},
    {"force", "N", "kN", 1000.0, {}},
    {"force", "N", "MN", 1e6, {}},
    {"force", "N", "lbf", 4.4482216152605, {}},
    {"force", "N", "klbf", 4448.2216152605, {"kip", "kips"}},
    {"force", "N", "tf", 9806.65, {}},
    {"force", "N", "t", 9806.65, {"tonne", "tonnes"}},
    {"force", "N", "lb", 4.4482216152605, {"lbs"}},
    {"force", "N", "klb", 4448.2216152605, {"klbs"}},
    {"force", "N", "kdaN", 1e4, {}},
    {"torque", "N m", "Nm", 1.0, {}},
    {"torque", "N m", "kNm", 1000.0, {}},
    {"pressure", "Pa", "Pa", 1.0, {"pascal"}},
    {"pressure", "Pa", "kPa", 1000.0, {}},
    {"pressure", "Pa", "MPa", 1e6, {}},
    {"pressure", "Pa", "GPa", 1e9, {}},
    {"pressure", "Pa", "bar", 1e5, {}},
    {"pressure", "Pa", "psi", 6894.7572931683613, {"PSI"}},
    {"pressure", "Pa", "ksi", 6894757.2931683613, {"kpsi"}},
    {"power", "W", "W", 1.0, {}},
    {"power", "W", "kW", 1000.0, {}},
    {"density", "kg/m3", "ppg", 119.82642731689663, {"PPG"}},
    {"density", "kg/m3", "pcf", 16.018463373960140, {}},
    {"density", "kg/m3", "sg", 1000.0, {"SG"}},
    {"rotary speed", "rad/s", "rpm", 0.10471975511965977, {"RPM"}},
    {"frequency", "Hz", "Hz", 1.0, {}},
    {"frequency", "Hz", "kHz", 1000.0, {}},
    {"volume", "m3", "l", 0.001, {"liter", "liters", "litre", "litres"}},
    {"volume", "m3", "cc", 1e-6, {}},
    {"volume", "m3", "gal", 3.785411784e-3, {}},
    {"volume", "m3", "bbl", 0.158987294928, {}},
    {"volume flow", "m3/s", "gpm", 6.30901964e-5, {"GPM"}},
    {"volume flow", "m3/s", "lpm", 1.6666666666666667e-5, {}},
    {"kinematic viscosity", "m2/s", "cSt", 1e-6, {}},
    {"dynamic viscosity", "Pa s", "cP", 0.001, {}},
};

/// Base units of SI with their exponents: a unit of another quantity would not convert.
TEST(Units, TheTableHasTheValuesOfTheDefinitionsAndNoOthers) {
  const auto& table = unitSymbols();
  ASSERT_EQ(table.size(), referenceUnits.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    const ReferenceUnit& expected = referenceUnits[i];
    EXPECT_EQ(table[i].quantity, expected.quantity);
    EXPECT_EQ(table[i].symbol, expected.symbol);
    EXPECT_EQ(table[i].si, expected.si);
    EXPECT_EQ(table[i].synonyms, expected.synonyms) << expected.symbol;
    EXPECT_NEAR(table[i].unit.factor, expected.value, 4e-16 * expected.value) << expected.symbol;
  }
}

TEST(Units, EverySymbolAndSynonymConvertsAsTheDefinitionSays) {
  for (const ReferenceUnit& expected : referenceUnits) {
    std::vector<std::string> spellings = expected.synonyms;
    spellings.push_back(expected.symbol);
    for (const std::string& spelling : spellings) {
      std::string fault;
      const auto value = toSi("2 " + spelling, expected.si, fault);
      ASSERT_TRUE(value) << spelling << " " << fault;
      EXPECT_NEAR(*value, 2.0 * expected.value, 8e-16 * expected.value) << spelling;
    }
  }
}

TEST(Units, DimensionsAreThoseOfTheQuantity) {
  // metre, kilogram, second, radian, cycle
  const std::map<std::string, Dimension> dimensions = {{"length", {1, 0, 0, 0, 0}},
                                                       {"mass", {0, 1, 0, 0, 0}},
                                                       {"time", {0, 0, 1, 0, 0}},
                                                       {"angle", {0, 0, 0, 1, 0}},
                                                       {"force", {1, 1, -2, 0, 0}},
                                                       {"torque", {2, 1, -2, 0, 0}},
                                                       {"pressure", {-1, 1, -2, 0, 0}},
                                                       {"power", {2, 1, -3, 0, 0}},
                                                       {"density", {-3, 1, 0, 0, 0}},
                                                       {"rotary speed", {0, 0, -1, 1, 0}},
                                                       {"frequency", {0, 0, -1, 0, 1}},
                                                       {"volume", {3, 0, 0, 0, 0}},
                                                       {"volume flow", {3, 0, -1, 0, 0}},
                                                       {"kinematic viscosity", {2, 0, -1, 0, 0}},
                                                       {"dynamic viscosity", {-1, 1, -1, 0, 0}}};
  for (const UnitSymbol& symbol : unitSymbols())
    EXPECT_EQ(symbol.unit.dimension, dimensions.at(symbol.quantity)) << symbol.symbol;
}

TEST(Units, ASymbolOfMassAndForceIsReadAsWhatIsAskedFor) {
  std::string fault;
  EXPECT_EQ(toSi("3 t", "kg", fault), 3000.0);
  EXPECT_EQ(toSi("3 t", "N", fault), 3.0 * 9806.65);
  EXPECT_EQ(toSi("3 lb/ft", "kg/m", fault), 3.0 * (0.45359237 / 0.3048));
  EXPECT_NEAR(toSi("3 lb/ft", "N/m", fault).value_or(0.0), 3.0 * 14.593902937206365, 3e-14);
  EXPECT_FALSE(parseUnit("t")->dimension == parseUnit("t", nullptr, Reading::Force)->dimension);
}

TEST(Units, OfferedUnitsAllMeasureWhatIsAsked) {
  for (const char* si : {"m", "N", "N m", "Pa", "kg/m3", "rad/s", "Hz", "rad", "s", "m3/s", "1/s",
                         "N/m", "N s/m", "kg m", "1/m", "m2/s", "kg", "m2", "m4"}) {
    const auto offered = unitsLike(si);
    EXPECT_FALSE(offered.empty()) << si;
    for (const std::string& unit : offered) {
      std::string fault;
      EXPECT_TRUE(toSi("1 " + unit, si, fault)) << si << " offers " << unit << " but " << fault;
    }
  }
}

}  // namespace UnitsTest
