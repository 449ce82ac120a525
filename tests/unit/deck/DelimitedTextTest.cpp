// SPDX-License-Identifier: BSD-3-Clause
#include "deck/tables/DelimitedText.hpp"

#include <gtest/gtest.h>

#include "common/Error.hpp"

namespace tooljoint::deck {
namespace DelimitedTextTest {

using Cells = std::vector<std::string>;

TEST(DelimitedText, TheFirstLineDecidesTheSeparator) {
  EXPECT_EQ(splitDelimited("a;b,c\n1;2\n").separator, ';');
  EXPECT_EQ(splitDelimited("a\tb,c\n").separator, '\t');
  EXPECT_EQ(splitDelimited("# no; header\na,b c\n1;2,3\n").separator, ',');
  EXPECT_EQ(splitDelimited("\"a;b\",c\n").separator, ',');
  const auto rows = splitDelimited("a;b\n 1,5 ;2\r\n\n3;\n").rows;
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[1].cells, (Cells{"1,5", "2"}));
  EXPECT_EQ(rows[2].cells, (Cells{"3", ""}));
  EXPECT_EQ(rows[2].line, 4);
}

TEST(DelimitedText, QuotedCellsMayHoldSeparatorsAndQuotes) {
  const auto rows = splitDelimited("\"a, b\",\"say \"\"no\"\"\", \"c\"\n").rows;
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].cells, (Cells{"a, b", "say \"no\"", "c"}));
}

TEST(DelimitedText, CountsWhatIsNotRead) {
  const auto text = splitDelimited("# one\na;b\n;;\n  \n#two\n1;2\n");
  EXPECT_EQ(text.comments, 2);
  EXPECT_EQ(text.emptyRows, 1);
  EXPECT_EQ(text.rows.size(), 2U);
}

TEST(DelimitedText, SkipsAByteOrderMarkAndReadsDegreeSignsOfLatin1) {
  const auto rows = splitDelimited("\xEF\xBB\xBFMD;Inc [\xB0];Azi [\xC2\xB0]\n").rows;
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].cells, (Cells{"MD", "Inc [\u00b0]", "Azi [\u00b0]"}));
}

TEST(DelimitedText, RefusesUtf16) {
  EXPECT_THROW(splitDelimited(std::string("\xFF\xFEM\0D\0", 6)), DeckError);
}

TEST(CellNumber, TakesAPointOrAComma) {
  EXPECT_EQ(cellNumber("1,25")->value, 1.25);
  EXPECT_TRUE(cellNumber("1,25")->comma);
  EXPECT_EQ(cellNumber("+1.25e2")->value, 125.0);
  EXPECT_TRUE(cellNumber("-1.25")->point);
  EXPECT_FALSE(cellNumber("12")->comma || cellNumber("12")->point);
  for (const char* bad : {"", "1.234,5", "1,2,3", "12abc", "nan", "inf", "1 2", "+-1", "0x10", ","})
    EXPECT_FALSE(cellNumber(bad)) << bad;
}

TEST(DecimalMarks, AreOfOneKindAndDoNotSeparateCells) {
  const auto comma = *cellNumber("1,5"), point = *cellNumber("1.5"), whole = *cellNumber("15");
  DecimalMarks marks(';');
  EXPECT_EQ(marks.fault(whole, 2), "");
  EXPECT_EQ(marks.fault(comma, 3), "");
  EXPECT_TRUE(marks.commas());
  EXPECT_EQ(marks.fault(point, 4),
            " has a decimal point, but there is a decimal comma in line 3. Write one of them, and "
            "no groups of thousands.");
  DecimalMarks separated(',');
  EXPECT_EQ(separated.fault(point, 3), "");
  EXPECT_NE(separated.fault(comma, 4).find("commas separate the cells"), std::string::npos);
}

}  // namespace DelimitedTextTest
}  // namespace tooljoint::deck
