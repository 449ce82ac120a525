// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <unistd.h>

#include "substructures/well/Trajectory.hpp"

using namespace tooljoint;
using namespace tooljoint::well;

namespace {

const double degree = 3.14159265358979323846 / 180.0;

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
    for (auto at = message.find(file.name()); at != std::string::npos; at = message.find(file.name()))
      message.replace(at, file.name().size(), "F");
    return message;
  }
  return "no error";
}

}  // namespace

TEST(SurveyFile, WithoutHeaderIsDepthInclinationAzimuthInMetresAndDegrees) {
  const CsvFile file("# a comment\n0, 0, 0\n\n100, 10, 350\r\n+200, 2.5e1, -10\n");
  const auto stations = readSurvey(file.name());
  ASSERT_EQ(stations.size(), 3u);
  EXPECT_DOUBLE_EQ(stations[1].depth, 100.0);
  EXPECT_DOUBLE_EQ(stations[1].inclination, 10.0 * degree);
  EXPECT_DOUBLE_EQ(stations[2].azimuth, -10.0 * degree);
  EXPECT_DOUBLE_EQ(stations[2].inclination, 25.0 * degree);
}

TEST(SurveyFile, HeaderNamesColumnsInAnyOrderWithUnits) {
  const CsvFile file("Azimuth [deg], TVD, MD (ft), Inclination [rad]\n90, 0, 0, 0\n90, 99, 1000, 0.5\n");
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

TEST(SurveyFile, EveryFaultIsReportedWithItsLine) {
  const std::string message = errorOf("0,0,0\n100,10\n90,abc,0\n80,200,0\n70,5,0\n");
  EXPECT_NE(message.find("F:2: found 2 columns"), std::string::npos) << message;
  EXPECT_NE(message.find("F:3: the inclination \"abc\" is not a finite number."), std::string::npos) << message;
  EXPECT_NE(message.find("F:4: the inclination must lie between 0 and 180 degrees."), std::string::npos) << message;
  EXPECT_NE(message.find("F:5: the measured depth does not increase"), std::string::npos) << message;
}

TEST(SurveyFile, RefusesWhatIsNotANumber) {
  for (const char* cell : {"12abc", "", "nan", "inf", "1 2", "0x10"})
    EXPECT_NE(errorOf("0,0,0\n100," + std::string(cell) + ",0\n").find("F:2: the inclination"), std::string::npos) << cell;
}

TEST(SurveyFile, OtherFaultsHaveTheirOwnSentence) {
  EXPECT_NE(errorOf("5,0,0\n100,0,0\n").find("F:1: the first station must be at measured depth 0"), std::string::npos);
  EXPECT_NE(errorOf("0,0,0\n").find("at least two stations"), std::string::npos);
  EXPECT_NE(errorOf("").find("at least two stations"), std::string::npos);
  EXPECT_NE(errorOf("0,90,0\n10,90,180\n").find("F:2: the hole turns back by 180 degrees"), std::string::npos);
  EXPECT_NE(errorOf("0,0,0\n10,0,400\n").find("F:2: the azimuth must lie"), std::string::npos);
  EXPECT_NE(errorOf("MD,Inc\n0,0\n10,0\n").find("no column for the azimuth"), std::string::npos);
  EXPECT_NE(errorOf("MD [furlong],Inc,Azi\n0,0,0\n10,0,0\n").find("the unit \"furlong\" of the measured depth is not known"),
            std::string::npos);
  EXPECT_NE(errorOf("MD,Inc,Azi,MD\n0,0,0,0\n").find("stands twice"), std::string::npos);
  EXPECT_THROW(readSurvey("no_such_file.csv"), DeckError);
}
