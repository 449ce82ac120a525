// SPDX-License-Identifier: BSD-3-Clause
#include "deck/reading/Value.hpp"

#include <gtest/gtest.h>

namespace ValueTest {

using namespace tooljoint::deck;

struct Good {
  std::string type, text;
  Value value;
  friend std::ostream& operator<<(std::ostream& out, const Good& t) { return out << t.text; }
};
class GoodValue : public ::testing::TestWithParam<Good> {};

TEST_P(GoodValue, IsReadWhole) {
  std::string fault;
  const auto value = parseValue(GetParam().type, GetParam().text, fault);
  ASSERT_TRUE(value) << fault;
  EXPECT_EQ(*value, GetParam().value);
  EXPECT_EQ(typeOf(*value), GetParam().type);
}

INSTANTIATE_TEST_SUITE_P(
    Table, GoodValue,
    ::testing::Values(Good{"double", "1", 1.0}, Good{"double", "-2.5e-3", -2.5e-3},
                      Good{"double", ".5", 0.5}, Good{"double", "5.", 5.0},
                      Good{"double", " 7 ", 7.0}, Good{"double", "+7", 7.0},
                      Good{"double", "1E6", 1e6}, Good{"double", "0", 0.0}, Good{"int", "42", 42},
                      Good{"int", "-1", -1}, Good{"int", "+3", 3}, Good{"int", " 3 ", 3},
                      Good{"int", "2147483647", 2147483647}, Good{"bool", "true", true},
                      Good{"bool", "false", false}, Good{"string", "", std::string()},
                      Good{"string", " a ", std::string(" a ")},
                      Good{"Array(double)", "{1, 2.5}", std::vector<double>{1.0, 2.5}},
                      Good{"Array(double)", "{}", std::vector<double>{}},
                      Good{"Array(double)", " { 1 } ", std::vector<double>{1.0}},
                      Good{"Array(int)", "{1,2,-3}", std::vector<int>{1, 2, -3}},
                      Good{"Array(string)", "{5*pipe, last pipe , bit}",
                           std::vector<std::string>{"5*pipe", "last pipe", "bit"}}));

struct Bad {
  std::string type, text, fault;
  friend std::ostream& operator<<(std::ostream& out, const Bad& t) { return out << t.text; }
};
class BadValue : public ::testing::TestWithParam<Bad> {};

TEST_P(BadValue, IsRefusedWithAReason) {
  std::string fault;
  EXPECT_FALSE(parseValue(GetParam().type, GetParam().text, fault));
  EXPECT_EQ(fault, GetParam().fault);
}

INSTANTIATE_TEST_SUITE_P(
    Table, BadValue,
    ::testing::Values(
        Bad{"double", "", "is empty; a number is expected"},
        Bad{"double", "   ", "is empty; a number is expected"},
        Bad{"double", "abc", "is not a number"},
        Bad{"double", "12abc", "is not a number: \"abc\" is left over"},
        Bad{"double", "1,5", "is not a number: write a decimal point, not a comma"},
        Bad{"double", "1 2", "is not a number: \"2\" is left over"},
        Bad{"double", "1d5", "is not a number: \"d5\" is left over"},
        Bad{"double", "0x10", "is not a number: \"x10\" is left over"},
        Bad{"double", "1e", "is not a number: \"e\" is left over"},
        Bad{"double", "nan", "is not a finite number"},
        Bad{"double", "NaN", "is not a finite number"},
        Bad{"double", "inf", "is not a finite number"},
        Bad{"double", "-infinity", "is not a finite number"},
        Bad{"double", "1e400", "is too large or too small for a double"},
        Bad{"double", "++1", "is not a number"}, Bad{"double", "+-1", "is not a number"},
        Bad{"double", "- 1", "is not a number"},
        Bad{"double", "120 rpm",
            "is not a number. A quantity with a unit is written type=\"string\" value=\"120 rpm\""},
        Bad{"double", "5in",
            "is not a number. A quantity with a unit is written type=\"string\" value=\"5in\""},
        Bad{"int", "", "is empty; a whole number is expected"},
        Bad{"int", "abc", "is not a whole number"}, Bad{"int", "3.7", "is not a whole number"},
        Bad{"int", "3.0", "is not a whole number"}, Bad{"int", "1e3", "is not a whole number"},
        Bad{"int", "3 nodes", "is not a whole number: \" nodes\" is left over"},
        Bad{"int", "9999999999", "is too large for an int"},
        Bad{"bool", "True", "is not a bool: write \"true\""},
        Bad{"bool", "1", "is not a bool: write \"true\""},
        Bad{"bool", "yes", "is not a bool: write \"true\""},
        Bad{"bool", "0", "is not a bool: write \"false\""},
        Bad{"bool", "off", "is not a bool: write \"false\""},
        Bad{"bool", "", "is not a bool: write \"true\" or \"false\""},
        Bad{"bool", "TRUEE", "is not a bool: write \"true\" or \"false\""},
        Bad{"bool", " true", "is not a bool: write \"true\""},
        Bad{"Array(double)", "1, 2", "is not an array: write the entries in braces, \"{1, 2}\""},
        Bad{"Array(double)", "", "is not an array: write \"{a, b, c}\""},
        Bad{"Array(double)", "[1, 2]", "is not an array: write \"{a, b, c}\""},
        Bad{"Array(double)", "{1, 2", "is not an array: write \"{a, b, c}\""},
        Bad{"Array(double)", "{{1}, {2}}",
            "is not a plain array: braces stand once around all entries"},
        Bad{"Array(double)", "{1,,2}", "has an empty entry (number 2)"},
        Bad{"Array(double)", "{1, 2,}", "has an empty entry (number 3)"},
        Bad{"Array(double)", "{1, 12abc}",
            "has the entry \"12abc\" (number 2), which is not a number: \"abc\" is left over"},
        Bad{"Array(double)", "{nan}",
            "has the entry \"nan\" (number 1), which is not a finite number"},
        Bad{"Array(double)", "{5 in}",
            "has the entry \"5 in\" (number 1), which is not a number. Quantities with a unit are "
            "written "
            "type=\"Array(string)\""},
        Bad{"Array(int)", "{1, 2.5}",
            "has the entry \"2.5\" (number 2), which is not a whole number"},
        Bad{"Array(string)", "{a,,b}", "has an empty entry (number 2)"},
        Bad{"Array(string)", "a, b", "is not an array: write the entries in braces, \"{a, b}\""}));

struct Meant {
  std::string typed, meant;
  friend std::ostream& operator<<(std::ostream& out, const Meant& t) { return out << t.typed; }
};
class MeantType : public ::testing::TestWithParam<Meant> {};

TEST_P(MeantType, IsGuessed) { EXPECT_EQ(meantType(GetParam().typed), GetParam().meant); }

INSTANTIATE_TEST_SUITE_P(Table, MeantType,
                         ::testing::Values(Meant{"Double", "double"}, Meant{"float", "double"},
                                           Meant{"real", "double"}, Meant{"integer", "int"},
                                           Meant{"long long", "int"}, Meant{"boolean", "bool"},
                                           Meant{"String", "string"}, Meant{"text", "string"},
                                           Meant{"array(double)", "Array(double)"},
                                           Meant{"Array(float)", "Array(double)"},
                                           Meant{"Array( int )", "Array(int)"},
                                           Meant{"duoble", "double"}, Meant{"matrix", ""}));

TEST(Value, AnUnknownTypeIsNamedWithTheKnownOnes) {
  std::string fault;
  EXPECT_FALSE(parseValue("Double", "1", fault));
  EXPECT_EQ(fault,
            "has the unknown type \"Double\". Available: \"double\", \"int\", \"bool\", "
            "\"string\", "
            "\"Array(double)\", \"Array(int)\", "
            "\"Array(string)\". Did you mean type=\"double\"?");
}

}  // namespace ValueTest
