// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

#include "common/Constants.hpp"
#include "substructures/well/ArcChain.hpp"
#include "substructures/well/Trajectory.hpp"

namespace SurveyFileTest {

using namespace tooljoint;
using namespace tooljoint::well;

using constants::degree;

/// A CSV file that is removed at the end of the test.
class CsvFile {
 public:
  explicit CsvFile(const std::string& text) : name_("survey_" + std::to_string(getpid()) + ".csv") {
    std::ofstream(name_) << text;
  }
  ~CsvFile() { std::remove(name_.c_str()); }
  CsvFile(const CsvFile&) = delete;
  CsvFile& operator=(const CsvFile&) = delete;
  const std::string& name() const { return name_; }

 private:
  std::string name_;
};

std::string errorOf(const std::string& text) {
  const CsvFile file(text);
  try {
    readSurvey(file.name());
  } catch (const DeckError& error) {
    std::string message = error.what();
    for (auto at = message.find(file.name()); at != std::string::npos;
         at = message.find(file.name()))
      message.replace(at, file.name().size(), "F");
    return message;
  }
  return "no error";
}

TEST(SurveyFile, WithoutHeaderIsDepthInclinationAzimuthInMetresAndDegrees) {
  const CsvFile file("# a comment\n0, 0, 0\n\n100, 10, 350\r\n+200, 2.5e1, -10\n");
  const auto stations = readSurvey(file.name());
  ASSERT_EQ(stations.size(), 3u);
  EXPECT_DOUBLE_EQ(stations[1].depth, 100.0);
  EXPECT_DOUBLE_EQ(stations[1].inclination, 10.0 * degree);
  EXPECT_DOUBLE_EQ(stations[2].azimuth, -10.0 * degree);
  EXPECT_DOUBLE_EQ(stations[2].inclination, 25.0 * degree);
}

TEST(SurveyFile, RowsMayEndBeforeColumnsOfText) {
  const CsvFile file("MD,Inc,Azi,Comment\n0,0,0,tie-in\n100,10,350\n200,20,340,MWD\n");
  const auto table = readSurveyTable(file.name());
  ASSERT_EQ(table.stations.size(), 3u);
  EXPECT_DOUBLE_EQ(table.stations[1].azimuth, 350.0 * degree);
  ASSERT_EQ(table.remarks.size(), 1u);
  EXPECT_NE(table.remarks[0].find("1 row without its last columns"), std::string::npos);
  EXPECT_NE(errorOf("MD,Inc,Azi,TVD\n0,0,0,0\n100,10,99\n")
                .find("F:3: found 3 columns where 4 are expected (MD, Inc, Azi, TVD; separated by "
                      "commas, semicolons or tabs). Write an empty cell for each missing one."),
            std::string::npos);
  EXPECT_NE(errorOf("0,0,0\n100,10,99\n100,10,99\n").find("Sort the stations by depth"),
            std::string::npos);
}

TEST(SurveyFile, HeaderNamesColumnsInAnyOrderWithUnits) {
  const CsvFile file(
      "Azimuth [deg], TVD, MD (ft), Inclination [rad]\n90, 0, 0, 0\n90, 99, 1000, 0.5\n");
  const auto stations = readSurvey(file.name());
  ASSERT_EQ(stations.size(), 2u);
  EXPECT_DOUBLE_EQ(stations[1].depth, 304.8);
  EXPECT_DOUBLE_EQ(stations[1].inclination, 0.5);
  EXPECT_DOUBLE_EQ(stations[1].azimuth, 90.0 * degree);
}

TEST(SurveyFile, UnitsOfTheDeckApplyWhereTheHeaderHasNone) {
  const CsvFile file("MD, Inc, Azi\n0, 0, 0\n1000, 0.1, 0.2\n");
  const auto stations = readSurvey(file.name(), "ft", "rad");
  EXPECT_DOUBLE_EQ(stations[1].depth, 304.8);
  EXPECT_DOUBLE_EQ(stations[1].inclination, 0.1);
}

/// Each column alone in each unit: 50 gon are 0.785 rad, and an unread unit would give degrees.
TEST(SurveyFile, TheUnitOfEachColumnIsReadFromTheHeader) {
  const auto second = [](const std::string& header, const std::string& row) {
    const CsvFile file(header + "\n0,0,0\n" + row + "\n");
    return readSurvey(file.name())[1];
  };
  EXPECT_DOUBLE_EQ(second("MD, Inc, Azi [rad]", "100,5,0.5").azimuth, 0.5);
  EXPECT_DOUBLE_EQ(second("MD, Inc, Azi [rad]", "100,5,0.5").inclination, 5.0 * degree);
  EXPECT_DOUBLE_EQ(second("MD, Inc [rad], Azi", "100,0.25,5").inclination, 0.25);
  EXPECT_DOUBLE_EQ(second("MD, Inc [rad], Azi", "100,0.25,5").azimuth, 5.0 * degree);
  EXPECT_DOUBLE_EQ(second("MD [ft], Inc, Azi", "100,5,5").depth, 30.48);
  EXPECT_DOUBLE_EQ(second("MD [km], Inc, Azi", "2,5,5").depth, 2000.0);
  EXPECT_DOUBLE_EQ(second("MD (Feet), Inc (Degrees), Azi (Radians)", "100,5,0.5").depth, 30.48);
  EXPECT_DOUBLE_EQ(second("MD (Feet), Inc (Degrees), Azi (Radians)", "100,5,0.5").azimuth, 0.5);
  EXPECT_DOUBLE_EQ(second("MD (Feet), Inc (Degrees), Azi (Radians)", "100,5,0.5").inclination,
                   5.0 * degree);
}

TEST(SurveyFile, SemicolonsWithDecimalCommasAndTabs) {
  for (const std::string separator : {";", "\t"}) {
    const std::string s = separator;
    const CsvFile file("\xEF\xBB\xBFMD" + s + "Inc" + s + "Azi\r\n0" + s + "0" + s + "0\r\n100,5" +
                       s + "2,25" + s + "-7\r\n");
    const auto table = readSurveyTable(file.name());
    ASSERT_EQ(table.stations.size(), 2U);
    EXPECT_DOUBLE_EQ(table.stations[1].depth, 100.5);
    EXPECT_DOUBLE_EQ(table.stations[1].inclination, 2.25 * degree);
    EXPECT_DOUBLE_EQ(table.stations[1].azimuth, -7.0 * degree);
    ASSERT_EQ(table.remarks.size(), 1U);
    EXPECT_EQ(table.remarks[0], file.name() + ": 2 stations, cells separated by " +
                                    (s == ";" ? "semicolons" : "tabs") + ", decimal commas");
  }
}

/// Two stations, the second at 200 m, 10 and 20 degrees, and the message on them.
std::string understood(const std::string& text) {
  const CsvFile file(text);
  const auto table = readSurveyTable(file.name());
  EXPECT_EQ(table.stations.size(), 2U) << text;
  EXPECT_NEAR(table.stations[1].depth, 200.0, 1e-9) << text;
  EXPECT_NEAR(table.stations[1].inclination, 10.0 * degree, 1e-12) << text;
  EXPECT_NEAR(table.stations[1].azimuth, 20.0 * degree, 1e-12) << text;
  return table.remarks.empty() ? "" : table.remarks[0].substr(file.name().size() + 2);
}

TEST(SurveyFile, HeadingsOfServiceCompanies) {
  EXPECT_EQ(understood("M.D. (m.),Inc. (deg.),Azi. (deg.)\n0,0,0\n200,10,20\n"), "");
  EXPECT_EQ(understood("Meas. Depth [m],Hole Inclination [deg],Hole Azimuth\n0,0,0\n200,10,20\n"),
            "");
  EXPECT_EQ(understood("MD,Incl,Azimuth (\xC2\xB0TN)\n0,0,0\n200,10,20\n"), "");
  EXPECT_EQ(understood("MD,Incl,Azi True,Azi Grid\n0,0,0,0\n200,10,20,19\n"),
            "2 stations, azimuth from \"Azi True\"; not read: column \"Azi Grid\"");
  EXPECT_EQ(understood("MD,Incl,Grid_Azimuth\n0,0,0\n200,10,20\n"),
            "2 stations, azimuth from \"Grid_Azimuth\"");
  EXPECT_NE(errorOf("MD,Inc,Azi,Azimuth\n0,0,0,0\n").find("occurs twice"), std::string::npos);
}

TEST(SurveyFile, BlanksBetweenCells) {
  const std::string said = "2 stations, cells separated by blanks";
  EXPECT_EQ(understood("MD INC AZI\n0 0 0\n200 10 20\n"), said);
  EXPECT_EQ(understood("MD [m] INC [deg] AZI [deg]\r\n0 0 0\r\n200  10 20\r\n"), said);
  EXPECT_EQ(understood("  Measured Depth   Inclination  Azimuth\n      0.0   0.0   0.0\n    200.0  "
                       "10.0  20.0\n"),
            said);
  EXPECT_EQ(understood("0 0 0\n200 10 20\n"), said);
  EXPECT_NE(errorOf("Measured Depth Inc Azi\n0 0 0\n200 10 20\n").find("found 3 columns where 4"),
            std::string::npos);
}

TEST(SurveyFile, UnitsInCells) {
  EXPECT_EQ(understood("MD,Inc,Azi\n0 ft,0 deg,0 deg\n656.16797900262467 ft,10deg,20 deg\n"),
            "2 stations, units in the cells");
  EXPECT_NE(errorOf("MD [ft],Inc,Azi\n0,0,0\n200 m,10,20\n")
                .find("F:3: the measured depth \"200 m\" has another unit than the header"),
            std::string::npos);
  EXPECT_NE(errorOf("MD,Inc,Azi\n0,0,0\n200 kg,10,20\n").find("\"200 kg\" is not a finite number"),
            std::string::npos);
}

TEST(SurveyFile, DegreeSignsInHeaderAndCells) {
  for (const std::string degreeSign : {"\xC2\xB0", "\xB0"}) {
    const CsvFile file("MD [ft];Inc [" + degreeSign + "];Azi" + degreeSign + "\n0;0;0\n100;2.5" +
                       degreeSign + ";10 " + degreeSign + "\n");
    const auto stations = readSurvey(file.name(), "m", "rad");
    ASSERT_EQ(stations.size(), 2U);
    EXPECT_DOUBLE_EQ(stations[1].depth, 30.48);
    EXPECT_DOUBLE_EQ(stations[1].inclination, 2.5 * degree);
    EXPECT_DOUBLE_EQ(stations[1].azimuth, 10.0 * degree);
  }
}

TEST(SurveyFile, ARowOfUnitsBelowTheHeader) {
  for (const std::string row : {"ft,rad,-,deg", "[ft],[rad],[-],[\xC2\xB0]", "(ft),(rad),,(deg)"}) {
    const CsvFile file("MD,Inclination,Tool,Azimuth\n" + row + "\n0,0,x,0\n100,0.5,y,90\n");
    const auto stations = readSurvey(file.name());
    ASSERT_EQ(stations.size(), 2U) << row;
    EXPECT_DOUBLE_EQ(stations[1].depth, 30.48);
    EXPECT_DOUBLE_EQ(stations[1].inclination, 0.5);
    EXPECT_DOUBLE_EQ(stations[1].azimuth, 90.0 * degree);
  }
  EXPECT_NE(errorOf("MD,Inc,Azi\nm,furlong,deg\n0,0,0\n1,0,0\n")
                .find("F:2: the unit \"furlong\" of the inclination is unknown"),
            std::string::npos);
  EXPECT_NE(
      errorOf("MD [ft],Inc,Azi\nm,deg,deg\n0,0,0\n1,0,0\n")
          .find("F:2: the unit \"m\" of the measured depth is another one than that of the header"),
      std::string::npos);
  EXPECT_NE(errorOf("MD,Inc,Azi\nkg,deg,deg\n0,0,0\n1,0,0\n")
                .find("the unit \"kg\" of the measured depth is unknown"),
            std::string::npos);
}

TEST(SurveyFile, SaysWhatWasNotRead) {
  const CsvFile file("# exported\n#\nMD,TVD,Inc,Azi,Remarks\n0,0,0,0,start\n,,,,\n100,99,10,0,\n");
  const auto table = readSurveyTable(file.name());
  ASSERT_EQ(table.remarks.size(), 1U);
  EXPECT_EQ(
      table.remarks[0],
      file.name() +
          ": 2 stations; not read: columns \"TVD\", \"Remarks\", 2 comment lines, 1 empty row");
  const CsvFile plain("0,0,0\n100,5,5\n");
  EXPECT_TRUE(readSurveyTable(plain.name()).remarks.empty());
}

TEST(SurveyFile, TextAboveTheHeaderIsNotRead) {
  const CsvFile file(
      "Well: A-1, slot 4\nRKB elevation;25,3;m\n\n# exported\nMD "
      "(ft);Inc;Azi\n0;0;0\n328,1;9;45\n");
  const auto table = readSurveyTable(file.name());
  ASSERT_EQ(table.stations.size(), 2U);
  EXPECT_NEAR(table.stations[1].depth, 328.1 * 0.3048, 1e-9);
  EXPECT_NEAR(table.stations[1].inclination, 9 * M_PI / 180, 1e-12);
  ASSERT_EQ(table.remarks.size(), 1U);
  EXPECT_NE(table.remarks[0].find("2 lines above the header, 1 comment line"), std::string::npos)
      << table.remarks[0];
  // errors name the line of the file; a station above the header is an error
  EXPECT_NE(errorOf("Well A-1\nMD,Inc,Azi\n0,0,0\n100,x,0\n").find("F:4: the inclination \"x\""),
            std::string::npos);
  EXPECT_NE(errorOf("0,0,0\nMD,Inc,Azi\n100,5,0\n").find("F:2: "), std::string::npos);
  EXPECT_NE(errorOf("Well A-1\n0,0,0\n100,5,0\n").find("no column for the measured depth"),
            std::string::npos);
}

TEST(SurveyFile, DecimalCommasAndPointsDoNotMix) {
  const std::string mixed = errorOf("MD;Inc;Azi\n0;0;0\n100,5;1.5;0\n");
  EXPECT_NE(mixed.find("F:3: the inclination \"1.5\" has a decimal point, but there is a decimal "
                       "comma in line 3"),
            std::string::npos)
      << mixed;
  EXPECT_NE(errorOf("MD;Inc;Azi\n0;0;0\n1.234,5;1;0\n").find("\"1.234,5\" is not a finite number"),
            std::string::npos);
  // groups of thousands, as spreadsheets write them: not 1.5 and 3.6 m
  EXPECT_NE(errorOf("MD,Inc,Azi\n0,0,0\n\"1,500\",5,0\n\"3,600\",30,0\n")
                .find("F:3: the measured depth \"1,500\" has a comma, but commas separate"),
            std::string::npos);
}

TEST(SurveyFile, UTF16AndPipesAreRefused) {
  const CsvFile wide(std::string("\xFF\xFEM\0D\0", 6));
  EXPECT_THROW(readSurvey(wide.name()), DeckError);
  const std::string pipe = "survey_pipe_" + std::to_string(getpid());
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(readSurvey(pipe), DeckError);
  std::remove(pipe.c_str());
  EXPECT_THROW(readSurvey("/dev/zero"), DeckError);
}

TEST(SurveyFile, QuotesLittleOfALongCell) {
  const std::string message = errorOf("0,0,0\n100," + std::string(100000, 'x') + ",0\n");
  EXPECT_LT(message.size(), 400U);
}

TEST(SurveyFile, EveryFaultIsReportedWithItsLine) {
  const std::string message = errorOf("0,0,0\n100,10\n90,abc,0\n80,200,0\n70,5,0\n");
  EXPECT_NE(message.find("F:2: found 2 columns"), std::string::npos) << message;
  EXPECT_NE(message.find("F:3: the inclination \"abc\" is not a finite number."), std::string::npos)
      << message;
  EXPECT_NE(message.find("F:4: the inclination must lie between 0 and 180 degrees."),
            std::string::npos)
      << message;
  EXPECT_NE(message.find("F:5: the measured depth does not increase"), std::string::npos)
      << message;
}

TEST(SurveyFile, RefusesWhatIsNotANumber) {
  for (const char* cell : {"12abc", "", "nan", "inf", "1 2", "0x10"})
    EXPECT_NE(errorOf("0,0,0\n100," + std::string(cell) + ",0\n").find("F:2: the inclination"),
              std::string::npos)
        << cell;
}

TEST(SurveyStations, AreThoseOfAFileWithTheSameNumbers) {
  const CsvFile file("0,0,0\n500,2.5,10\n1000,15,30\n");
  const auto read = readSurvey(file.name(), "ft", "deg");
  const auto given = surveyStations({0, 0, 0, 500, 2.5, 10, 1000, 15, 30}, "S", "ft", "deg");
  ASSERT_EQ(given.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(given[i].depth, read[i].depth);
    EXPECT_EQ(given[i].inclination, read[i].inclination);
    EXPECT_EQ(given[i].azimuth, read[i].azimuth);
  }
  EXPECT_NEAR(given[2].depth, 304.8, 1e-12);
  EXPECT_THROW(surveyStations({0, 0, 0}, "S", "m", "deg"), DeckError);
  EXPECT_THROW(surveyStations({0, 0, 0, 10, 190, 0}, "S", "m", "deg"), DeckError);
}

TEST(SurveyFile, OtherFaultsHaveTheirOwnSentence) {
  EXPECT_NE(errorOf("5,0,0\n100,0,0\n").find("F:1: the first station must be at measured depth 0"),
            std::string::npos);
  EXPECT_NE(errorOf("0,0,0\n").find("at least two stations"), std::string::npos);
  EXPECT_NE(errorOf("").find("at least two stations"), std::string::npos);
  EXPECT_NE(errorOf("0,90,0\n10,90,180\n").find("F:2: the hole turns back by 180 degrees"),
            std::string::npos);
  EXPECT_NE(errorOf("0,0,0\n10,0,400\n").find("F:2: the azimuth must lie"), std::string::npos);
  EXPECT_NE(errorOf("MD,Inc\n0,0\n10,0\n").find("no column for the azimuth"), std::string::npos);
  EXPECT_NE(errorOf("MD [furlong],Inc,Azi\n0,0,0\n10,0,0\n")
                .find("the unit \"furlong\" of the measured depth is unknown"),
            std::string::npos);
  EXPECT_NE(errorOf("MD,Inc,Azi,MD\n0,0,0,0\n").find("occurs twice"), std::string::npos);
  EXPECT_THROW(readSurvey("no_such_file.csv"), DeckError);
}

}  // namespace SurveyFileTest
