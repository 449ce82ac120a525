// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Measured logs in CSV and LAS files, and the units in their headers.
#include "deck/tables/LogTable.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "deck/tables/ClockTime.hpp"
#include "deck/tables/ColumnHeading.hpp"
#include "deck/tables/LasFile.hpp"
#include "tests/support/ErrorText.hpp"

namespace LogTableTest {

using namespace tooljoint::deck;

std::vector<LogSignal> read(const std::string& text, const std::vector<WantedColumn>& wanted,
                            const WantedColumn& time = {"", "s", ""}) {
  const auto path = std::filesystem::temp_directory_path() / "tooljoint_log_table_test.txt";
  std::ofstream(path) << text;
  return readLog(path.string(), time, wanted);
}

TEST(UnitFactor, TakesUnitsAsLogsWriteThem) {
  EXPECT_DOUBLE_EQ(*unitFactor("KLBF", "N"), 4448.2216152605);
  EXPECT_DOUBLE_EQ(*unitFactor("kft.lbf", "N m"), 1355.8179483314004);
  EXPECT_DOUBLE_EQ(*unitFactor("KFT-LBF", "N m"), 1355.8179483314004);
  EXPECT_DOUBLE_EQ(*unitFactor("KN.M", "N m"), 1000.0);
  EXPECT_DOUBLE_EQ(*unitFactor("G", "m/s2"), 9.80665);
  EXPECT_DOUBLE_EQ(*unitFactor("MIN", "s"), 60.0);
  EXPECT_DOUBLE_EQ(*unitFactor("RPM", "rad/s"), *unitFactor("rpm", "rad/s"));
  EXPECT_FALSE(unitFactor("", "N"));
  EXPECT_FALSE(unitFactor("kN", "s"));
  EXPECT_FALSE(unitFactor("furlong", "m"));
}

TEST(LogTable, UnitsStandInTheHeaderOrBelowIt) {
  for (const char* head : {"Time [s]; Torque (kN m)\n", "time;torque\ns;kN m\n"}) {
    const auto found = read(std::string(head) + "0;1,5\n1;\n2;2,5\n", {{"torque", "N m", ""}});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].time, (std::vector<double>{0, 2}));
    EXPECT_EQ(found[0].value, (std::vector<double>{1500, 2500}));
  }
}

TEST(LogTable, TheUsualNullOfLoggersIsAGap) {
  const auto found = read("Time [s],x [N]\n0,60\n1,-999.25\n2,-999\n3,-9999\n", {{"x", "N", ""}});
  EXPECT_EQ(found[0].time, (std::vector<double>{0, 2}));
  EXPECT_EQ(found[0].value, (std::vector<double>{60, -999}));
}

TEST(LogTable, WordsForMissingValuesAreGaps) {
  const auto found = read("Time [s],x [N]\n0,60\n1,NaN\n2,null\n3,N/A\n4,-\n5,-999.2500\n6,1e2\n",
                          {{"x", "N", ""}});
  EXPECT_EQ(found[0].time, (std::vector<double>{0, 6}));
  EXPECT_EQ(found[0].value, (std::vector<double>{60, 100}));
  const auto text = tooljoint::errorText([] {
    read("Time [s],x [N]\n0,60\n1,inf\n2,bad\n", {{"x", "N", ""}});
  });
  EXPECT_NE(text.find(":3: the value \"inf\""), std::string::npos) << text;
  EXPECT_NE(text.find(":4: the value \"bad\""), std::string::npos) << text;
}

TEST(LogTable, LinesAboveTheHeaderAreIgnored) {
  for (const std::string above : {"Well A; Rig 7\nStart,2026-11-24 10:00:00\n", "Torque, Well A\n",
                                  "s,kN m\n", "Export of 24.11.2026\n(s),(kN.m)\n"}) {
    const bool units = above.find("(s)") != std::string::npos || above[0] == 's';
    const auto found =
        read(above + (units ? "Time,Torque\n" : "Time [s],Torque [kN m]\n") + "0,1.5\n1,2.5\n",
             {{"torque", "N m", ""}});
    EXPECT_EQ(found[0].time, (std::vector<double>{0, 1})) << above;
    EXPECT_EQ(found[0].value, (std::vector<double>{1500, 2500})) << above;
  }
  const auto text = tooljoint::errorText([] {
    read("Well A\nTime [s],Torque [kN m]\n0,1\n", {{"Torqe", "N m", ""}});
  });
  EXPECT_NE(text.find(":2: the header has no column \"Torqe\". Did you mean \"Torque\"?"),
            std::string::npos)
      << text;
}

TEST(LogTable, RevolutionsPerMinuteHaveSeveralSpellings) {
  constexpr double rpm = 0.10471975511965977;
  for (const char* unit : {"1/min", "rev/min", "c/min", "C/MIN", "r/min", "min-1", "cpm"})
    EXPECT_DOUBLE_EQ(unitFactor(unit, "rad/s").value_or(0.0), rpm) << unit;
  EXPECT_DOUBLE_EQ(*unitFactor("c/s", "rad/s"), 60.0 * rpm);
  EXPECT_FALSE(unitFactor("1/s", "rad/s"));
  EXPECT_FALSE(unitFactor("c/min", "Hz"));
}

TEST(LogTable, UnitsOfTheDeckFillIn) {
  const auto found = read("t,x\n0,1\n1,2\n", {{"x", "N", "klbf"}}, {"t", "s", "min"});
  EXPECT_EQ(found[0].time[1], 60.0);
  EXPECT_DOUBLE_EQ(found[0].value[0], 4448.2216152605);
}

TEST(LogTable, TimesOfDayCountFromTheFirstOne) {
  const auto found =
      read("Time,x [N]\n23:59:58.5,1\n23:59:59,2\n00:00:01,3\n13:00:00,4\n0:00:02,5\n",
           {{"x", "N", ""}});
  EXPECT_EQ(found[0].time, (std::vector<double>{0, 0.5, 2.5, 46801.5, 86403.5}));
  const auto dated = read(
      "Timestamp,x [N]\n2024-02-28 23:00:00,1\n2024-03-01T01:00:00Z,2\n2025/03/01 01:00:00.25,3\n",
      {{"x", "N", ""}});
  EXPECT_EQ(dated[0].time,
            (std::vector<double>{0, 26 * 3600.0, 26 * 3600.0 + 365 * 86400.0 + 0.25}));
  EXPECT_EQ(clockTime("1970-01-02 00:00:01")->seconds, 86401.0);
  EXPECT_EQ(clockTime("2000-03-01 00:00:00")->seconds, 951868800.0);
  EXPECT_EQ(clockTime("1900-01-01 00:00:00")->seconds, -2208988800.0);
  for (const char* other :
       {"", "1:00", "24:00:00", "1:60:00", "1:00:60", "2024-13-01 00:00:00", "12.5"})
    EXPECT_FALSE(clockTime(other)) << other;
  const auto text = tooljoint::errorText([] {
    read("Time,x [N]\n01:00:00,1\n2024-03-01 01:00:01,2\n3,3\n01:00:02,4\n", {{"x", "N", ""}});
  });
  EXPECT_NE(text.find(":3: the value \"2024-03-01 01:00:01\" of the column \"Time\" is not a time "
                      "as in the rows before"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find(":4: the value \"3\""), std::string::npos) << text;
}

TEST(LogTable, TimesOfOtherFormsAreRefusedByTheirForm) {
  for (const std::string form : {"24/11/2026 10:00:00", "24.11.2026 10:00:00", "10:00"}) {
    const auto text = tooljoint::errorText([&] {
      read("Time,x [N]\n" + form + ",1\n", {{"x", "N", ""}});
    });
    EXPECT_NE(text.find(":2: the time \"" + form +
                        "\" of the column \"Time\" has a form that is not read. Write times as "
                        "hh:mm:ss or as YYYY-MM-DD hh:mm:ss."),
              std::string::npos)
        << text;
    EXPECT_EQ(text.find("has no unit"), std::string::npos) << text;
  }
}

constexpr const char* head =
    "~Version\nVERS. 2.0 : x\nWRAP. YES : x\n~Well\nUWI 100091604920W300\nNULL. -999.25 : "
    "x\n~Curve\nTIME.S : t\n"
    "A.M  00 1 : first: of two\nB.KN : second\n~A TIME A B\n";

TEST(LasFile, WrappedLinesAreJoined) {
  const auto las = parseLas(std::string(head) + "0\n1 2\n1\n-999.25 4\n", "log.las");
  ASSERT_EQ(las.curves.size(), 3U);
  EXPECT_EQ(las.curves[1].name, "A");
  EXPECT_EQ(las.curves[1].unit, "M");
  EXPECT_EQ(*las.null, -999.25);
  ASSERT_EQ(las.rows.size(), 2U);
  EXPECT_EQ(las.rows[1].cells, (std::vector<std::string>{"1", "-999.25", "4"}));
  EXPECT_EQ(las.rows[1].line, 14);
  const auto found =
      read(std::string(head) + "0\n1 2\n1\n-999.25 4\n2\n5 6\n", {{"a", "m", ""}, {"B", "N", ""}});
  EXPECT_EQ(found[0].time, (std::vector<double>{0, 2}));
  EXPECT_EQ(found[1].value, (std::vector<double>{2000, 4000, 6000}));
}

TEST(LasFile, TheUsualNullsAreGapsBesideItsOwn) {
  const std::string text =
      "~Version\nVERS. 2.0 : x\nWRAP. NO : x\n~Well\nNULL. -1 : x\n~Curve\nTIME.S : t\nB.KN : b\n"
      "~A\n0 2\n1 -1\n2 -999.25\n3 NaN\n4 3\n";
  EXPECT_EQ(read(text, {{"B", "N", ""}})[0].value, (std::vector<double>{2000, 3000}));
}

TEST(LasFile, FaultsNameTheirLine) {
  try {
    parseLas(std::string(head) + "0\n1 2 3\n", "log.las");
    FAIL();
  } catch (const tooljoint::DeckError& error) {
    EXPECT_STREQ(error.what(),
                 "log.las:13: found 4 values where ~C names 3 curves (values are separated by "
                 "blanks; a value not measured is NULL).");
  }
}

}  // namespace LogTableTest
