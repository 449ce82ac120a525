// SPDX-License-Identifier: BSD-3-Clause
// Unusual values, and the messages on them.
#include "substructures/drillstring/case/UsualRanges.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "io/TextFile.hpp"
#include "substructures/drillstring/scene/Scene.hpp"
#include "tests/support/SourceFolder.hpp"

namespace UsualRangesTest {

using namespace tooljoint;
using namespace tooljoint::drillstring;

using Sentences = std::vector<std::string>;

Sentences said(const std::string& deck, const std::vector<std::string>& overrides) {
  const std::string file = testing_::sourceFolder() + "/xml/" + deck;
  return unusualValues(deck::Deck::read(file, sceneSpec(), overrides));
}

TEST(UsualRanges, AreThoseOfNumbers) {
  const auto spec = sceneSpec();
  for (const auto& range : usualRanges()) {
    const deck::ListSpec* list = &spec;
    std::istringstream names(range.path);
    std::string name;
    for (std::getline(names, name, '/'); list != nullptr && !names.eof();
         std::getline(names, name, '/'))
      list = list->findList(name);
    ASSERT_NE(list, nullptr) << range.path;
    const auto* parameter = list->findParameter(name);
    ASSERT_NE(parameter, nullptr) << range.path;
    EXPECT_TRUE(parameter->kind == deck::Kind::Real || parameter->kind == deck::Kind::RealArray)
        << range.path;
    EXPECT_LT(range.low, range.high) << range.path;
  }
}

TEST(UsualRanges, ProposeTheUnitThatWasLeftOut) {
  const Sentences expected{
      "--set Mud/Flow Rate=2000: /first_run/Mud/Flow Rate is 2000 m3/s, outside what is usual in "
      "drilling (1e-05 to 0.5 m3/s). Is \"2000 gpm\" or \"2000 lpm\" meant?",
      "--set Loads/Weight On Bit=40: /first_run/Loads/Weight On Bit is 40 N, outside what is usual "
      "in drilling (1000 to 5e+06 N). Is \"40 kN\" or \"40 klbf\" meant?"};
  EXPECT_EQ(said("first_run.xml", {"Mud/Flow Rate=2000", "Loads/Weight On Bit=40"}), expected);
}

TEST(UsualRanges, KnowSpeedsAnglesAndFriction) {
  const Sentences expected{
      "--set Drillstring/Tool Face=45: /first_run/Drillstring/Tool Face is 45 rad, outside what is "
      "usual in drilling (up to 6.3 rad). Is \"45 deg\" meant?",
      "--set Contact/Friction/Static=30: /first_run/Contact/Friction/Static is 30, outside what is "
      "usual in drilling (up to 1.5).",
      "--set Campbell/Highest Speed=300: /first_run/Campbell/Highest Speed is 300 rad/s, outside "
      "what is usual in drilling (up to 250 rad/s). Is \"300 rpm\" or \"300 deg/s\" meant?",
      "--set Torque and Drag/Rotary Speed=60: /first_run/Torque and Drag/Rotary Speed is 60 rad/s, "
      "outside what is usual in drilling (up to 31.5 rad/s). Is \"60 rpm\" or \"60 deg/s\" meant?"};
  auto found =
      said("first_run.xml", {"Drillstring/Tool Face=45", "Contact/Friction/Static=30",
                             "Campbell/Highest Speed=300", "Torque and Drag/Rotary Speed=60"});
  std::sort(found.begin(), found.end());
  auto sorted = expected;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(found, sorted);
  EXPECT_TRUE(said("first_run.xml", {"Torque and Drag/Rotary Speed=400 rpm"}).empty())
      << "with a unit";
}

TEST(UsualRanges, KnowDiameters) {
  std::string text = io::readText(testing_::sourceFolder() + "/xml/first_run.xml");
  text = std::regex_replace(text, std::regex("\"Bore Radius\"[^/]*/"),
                            "\"Bore Diameter\" type=\"double\" value=\"8.5\"/");
  const auto found = unusualValues(deck::Deck::parse(text, "well.xml", sceneSpec()));
  ASSERT_EQ(found.size(), 1U);
  for (const char* part : {"Bore Diameter is 8.5 m, outside what is usual in drilling (0.04 to 1.5 "
                           "m). Is ",
                           "\"8.5 in\""})
    EXPECT_NE(found.front().find(part), std::string::npos) << found.front();
}

TEST(UsualRanges, LookAtEachNumberOfAnArray) {
  const auto found =
      said("bha_motor_1500m.xml", {"Bottom-Hole Assembly/Weight On Bit={0, 50e3, 100}"});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found.front().find("is 100 N, outside"), std::string::npos) << found.front();
}

TEST(UsualRanges, TakeZeroAndBothSigns) {
  EXPECT_EQ(said("first_run.xml", {"Loads/Torque On Bit=0", "Mud/Flow Rate=-0.03"}), Sentences());
}

TEST(UsualRanges, HoldTheScenesOfTheProject) {
  for (const char* deck :
       {"first_run.xml", "stress_170m.xml", "helical_170m.xml", "build_hold_1400m.xml",
        "bha_motor_1500m.xml", "buckling_100m.xml", "extended_reach_5000m.xml",
        "stick_slip_2500m.xml", "vertical_10000m.xml"})
    EXPECT_EQ(said(deck, {}), Sentences()) << deck;
}

}  // namespace UsualRangesTest
