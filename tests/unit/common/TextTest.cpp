// SPDX-License-Identifier: BSD-3-Clause
#include "common/Text.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace TextTest {

using namespace tooljoint;

TEST(EditDistance, CountsInsertionsDeletionsSubstitutionsAndSwaps) {
  EXPECT_EQ(editDistance("", ""), 0U);
  EXPECT_EQ(editDistance("abc", ""), 3U);
  EXPECT_EQ(editDistance("Stiffnes", "Stiffness"), 1U);
  EXPECT_EQ(editDistance("Step", "Stop"), 1U);
  EXPECT_EQ(editDistance("Setp", "Step"), 1U);
  EXPECT_EQ(editDistance("kitten", "sitting"), 3U);
}

struct Guess {
  std::string typed, meant;
  friend std::ostream& operator<<(std::ostream& out, const Guess& t) { return out << t.typed; }
};
class Closest : public ::testing::TestWithParam<Guess> {};

TEST_P(Closest, FindsWhatAPersonMeant) {
  const std::vector<std::string> names = {
      "Stiffness", "Damping", "End Time", "Sampling Interval", "Young Modulus", "WOB", "Step"};
  EXPECT_EQ(closest(GetParam().typed, names), GetParam().meant);
}

INSTANTIATE_TEST_SUITE_P(
    Table, Closest,
    ::testing::Values(Guess{"Stiffnes", "Stiffness"}, Guess{"stiffness", "Stiffness"},
                      Guess{"Sitffness", "Stiffness"}, Guess{"EndTime", "End Time"},
                      Guess{"end_time", "End Time"}, Guess{"END-TIME", "End Time"},
                      Guess{"Stepp", "Step"}, Guess{"wob", "WOB"}, Guess{"Young", "Young Modulus"},
                      Guess{"Young Modulus E", "Young Modulus"}, Guess{"Dampng", "Damping"},
                      Guess{"Viscosity", ""}, Guess{"", ""}, Guess{"Zz", ""}));

TEST(Closest, OfEquallyCloseNamesTheFirstWins) { EXPECT_EQ(closest("ab", {"ac", "ad"}), "ac"); }

TEST(Closest, HasNoGuessWithoutCandidates) { EXPECT_EQ(closest("Step", {}), ""); }

TEST(FormatNumber, IsTheShortestTextThatReadsBack) {
  EXPECT_EQ(formatNumber(0.1), "0.1");
  EXPECT_EQ(formatNumber(20.0), "20");
  EXPECT_EQ(formatNumber(2.1e11), "2.1e+11");
  EXPECT_EQ(formatNumber(-0.001), "-0.001");
  EXPECT_EQ(formatNumber(std::nextafter(1.0, 2.0)), "1.0000000000000002");
  EXPECT_EQ(formatNumber(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(formatNumber(-std::numeric_limits<double>::infinity()), "-inf");
  EXPECT_EQ(formatNumber(std::numeric_limits<double>::quiet_NaN()), "nan");
  EXPECT_EQ(formatNumber(-7), "-7");
}

TEST(Text, TrimsSplitsAndJoins) {
  EXPECT_EQ(trim("  a b\t\n"), "a b");
  EXPECT_EQ(trim(" \n "), "");
  EXPECT_EQ(split("a//b", '/'), (std::vector<std::string>{"a", "", "b"}));
  EXPECT_EQ(split("", '/'), (std::vector<std::string>{""}));
  EXPECT_EQ(join({"a", "b"}, ", "), "a, b");
  EXPECT_EQ(quotedList({"a", "b"}), "\"a\", \"b\"");
  EXPECT_EQ(quotedList({}), "");
  EXPECT_EQ(lower("RK4 Adaptive"), "rk4 adaptive");
}

TEST(Text, QuotesAtMost200Characters) {
  EXPECT_EQ(inQuotes("a"), "\"a\"");
  EXPECT_EQ(inQuotes(std::string(200, 'x')), "\"" + std::string(200, 'x') + "\"");
  EXPECT_EQ(inQuotes(std::string(100000, 'x')), "\"" + std::string(197, 'x') + "...\"");
  EXPECT_EQ(quotedList({std::string(300, 'x')}).size(), 202U);
  std::string umlauts;
  for (int i = 0; i < 200; ++i) umlauts += "\u00e4";  // two bytes each: none is cut in two
  EXPECT_EQ(excerpt(umlauts, 10), "\u00e4\u00e4\u00e4...");
}

TEST(Text, BytesThatAreNoCharactersAreEscaped) {
  EXPECT_EQ(printable("a \u00e4\u20ac\U0001f600 b"), "a \u00e4\u20ac\U0001f600 b");
  EXPECT_EQ(printable(std::string("\x1b[2J\0\x7f\n", 7)), "\\x1b[2J\\x00\\x7f\\x0a");
  EXPECT_EQ(printable("\xff\xc3(\xe2\x82"), "\\xff\\xc3(\\xe2\\x82");
  EXPECT_EQ(printable("\xc2\x9b"), "\\xc2\\x9b") << "a control character of Latin 1";
  EXPECT_EQ(inQuotes(std::string("\x01\xfe", 2)), "\"\\x01\\xfe\"");
  EXPECT_EQ(excerpt(std::string(100, '\x01'), 10), "\\x01\\x0...");
}

TEST(Text, IsQuotedForAShellWhereItMustBe) {
  EXPECT_EQ(inShellQuotes("results/a-1.xml"), "results/a-1.xml");
  EXPECT_EQ(inShellQuotes("End Time=2"), "'End Time=2'");
  EXPECT_EQ(inShellQuotes("it's $5"), "'it'\\''s $5'");
  EXPECT_EQ(inShellQuotes(""), "''");
}

TEST(Text, CountsHaveThreeDigits) {
  EXPECT_EQ(countText(999999), "999999");
  EXPECT_EQ(countText(1.23456e9), "1.23e+09");
  EXPECT_EQ(countText(1e300), "1e+300");
}

TEST(Text, ALongTextIsComparedWithNoTable) {
  EXPECT_EQ(closest(std::string(5000000, 'x'), {"Stiffness", "Friction"}), "");
}

}  // namespace TextTest
