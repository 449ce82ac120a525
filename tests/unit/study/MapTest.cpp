// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The Map list: its grid, refused lists, and the stored data of a point.
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <vector>

#include "common/Error.hpp"
#include "deck/Deck.hpp"
#include "study/Expansion.hpp"
#include "study/map/MapFiles.hpp"
#include "study/map/MapParameters.hpp"
#include "study/map/MapRows.hpp"

namespace MapTest {

using namespace tooljoint;

std::string text(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"string\" value=\"" + value + "\"/>";
}
std::string list(const std::string& name, const std::string& body) {
  return "<ParameterList name=\"" + name + "\">" + body + "</ParameterList>";
}
std::string values(const std::string& all) {
  return "<Parameter name=\"Values\" type=\"Array(string)\" value=\"{" + all + "}\"/>";
}
std::string evenly(const std::string& from, const std::string& to, int count) {
  return text("From", from) + text("To", to) + "<Parameter name=\"Count\" type=\"int\" value=\"" +
         std::to_string(count) + "\"/>";
}

study::MapSettings settingsOf(const std::string& grid) {
  deck::ListSpec scene("Scene", "A scene.");
  scene.list(study::mapParameters());
  const auto body = list(
      "Map", list("Grid", grid) + list("Values", list("torque", text("Key", "static.top_torque"))));
  const auto deck = deck::Deck::parse(list("scene", body), "deck.xml", scene, {});
  return study::readMap(deck.list().sublist("Map"));
}

void refuses(const std::string& grid, const std::string& sentence) {
  try {
    settingsOf(grid);
    FAIL() << "accepted; expected: " << sentence;
  } catch (const DeckError& error) {
    EXPECT_NE(std::string(error.what()).find(sentence), std::string::npos) << error.what();
  }
}

const std::string weight = list("weight", text("Parameter", "Loads/W") + values("5 kN, 10 kN"));

TEST(MapList, EvenlySpacedPointsKeepTheirUnit) {
  const auto s = settingsOf(
      list("speed", text("Parameter", "/Rotary Speed/S") + evenly("60 rpm", "180 rpm", 5)) +
      weight);
  ASSERT_EQ(s.axes.size(), 2u);
  EXPECT_EQ(s.axes[0].dimension.parameter, "Rotary Speed/S");
  EXPECT_EQ(s.axes[0].dimension.values,
            (std::vector<std::string>{"60 rpm", "90 rpm", "120 rpm", "150 rpm", "180 rpm"}));
  EXPECT_EQ(s.axes[0].numbers, (std::vector<double>{60, 90, 120, 150, 180}));
  EXPECT_EQ(s.axes[0].unit, "rpm");
  EXPECT_EQ(s.points(), 10u);
}

TEST(MapList, PointsThatAreNoNumbersHaveNone) {
  const auto s =
      settingsOf(weight + list("basis", text("Parameter", "Reduction/Basis") + values("Rubin, 2")));
  EXPECT_TRUE(s.axes[1].numbers.empty());
  EXPECT_EQ(s.axes[1].unit, "");
}

TEST(MapList, RefusesWhatMakesNoGrid) {
  const auto other = [](const std::string& body) {
    return weight + list("b", text("Parameter", "Mud/Density") + body);
  };
  refuses(other(evenly("60 rpm", "2 rad/s", 3)), "To has the unit \"rad/s\", From has \"rpm\"");
  refuses(other(evenly("slow", "2", 3)), "From is \"slow\", which does not begin with a number");
  refuses(other(text("From", "1")), "needs its points once");
  refuses(other(values("1, 1")), "has the point \"1\" twice");
  refuses(weight + list("b", text("Parameter", "Loads/W") + values("1, 2")),
          "which is on another axis already");
  refuses(weight + list("torque", text("Parameter", "Mud/Density") + values("1, 2")),
          "has the name of an axis");
}

TEST(MapList, TheLastAxisVariesFirst) {
  const study::Dimension a{"a", "X/A", {"1", "2"}}, b{"b", "X/B", {"3", "4", "5"}};
  const auto runs = study::product({a, b}, {}, "Map/Grid");
  ASSERT_EQ(runs.size(), 6u);
  EXPECT_EQ(runs[1].label, "A 1, B 4");
  EXPECT_EQ(runs[3].overrides[0].text, "X/A=2");
  EXPECT_EQ(runs[3].overrides[1].source, "Map/Grid/b");
}

TEST(MapRow, ReadsBackWhatItWrote) {
  study::MapRow row;
  row.status = "failed";
  row.reason = "a \"reason\"\nin two lines";
  row.cpu = 0.1, row.wall = 1.0 / 3.0, row.givenUpAfter = 2.0;
  row.numbers = {{"static.top_torque", 1.0 / 7.0}, {"path.iterations", 5.0}};
  study::MapRow read;
  read.fromJson(row.toJson());
  EXPECT_EQ(read.status, row.status);
  EXPECT_EQ(read.reason, row.reason);
  EXPECT_EQ(read.wall, row.wall);
  EXPECT_EQ(read.givenUpAfter, 2.0);
  EXPECT_EQ(read.numbers, row.numbers);
  EXPECT_EQ(read.number("static.top_torque"), 1.0 / 7.0);
  EXPECT_FALSE(read.number("static"));
  EXPECT_THROW(read.fromJson("{\"status\": 1}"), FileError);
}

TEST(MapRange, LeavesMissingPointsOut) {
  study::MapValue value{"torque", "k", 2.5, std::nullopt};
  std::vector<study::MapRow> rows(4);
  rows[1].numbers["k"] = 3.0, rows[2].numbers["k"] = -1.0, rows[3].numbers["k"] = 2.5;
  auto range = study::rangeOf(value, rows);
  EXPECT_EQ(range.known, 3u);
  EXPECT_EQ(range.unsafe, 1u);
  EXPECT_EQ(range.least, -1.0);
  EXPECT_EQ(range.largestPoint, 1u);
  value.unsafeBelow = 0.0;
  EXPECT_EQ(study::rangeOf(value, rows).unsafe, 2u);
}

}  // namespace MapTest
