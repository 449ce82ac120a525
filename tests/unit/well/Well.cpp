// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/well/Well.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "deck/Deck.hpp"
#include "tests/support/SourceFolder.hpp"

namespace WellTest {

using namespace tooljoint;
using namespace tooljoint::well;

using constants::pi;

/// The well of a deck whose list Well holds `inside`.
Well fromDeck(const std::string& inside) {
  deck::ListSpec scene("scene", "A scene.");
  scene.requiredList(parameters());
  const deck::Deck deck =
      deck::Deck::parse("<ParameterList name=\"scene\"><ParameterList name=\"Well\">" + inside +
                            "</ParameterList></ParameterList>",
                        "deck.xml", scene);
  return readWell(deck.list().sublist("Well"), deck.folder());
}

std::string errorOf(const std::string& inside) {
  try {
    fromDeck(inside);
  } catch (const DeckError& error) {
    return error.what();
  }
  return "no error";
}

std::string real(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"double\" value=\"" + value + "\"/>";
}
std::string text(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"string\" value=\"" + value + "\"/>";
}
std::string list(const std::string& name, const std::string& inside) {
  return "<ParameterList name=\"" + name + "\">" + inside + "</ParameterList>";
}

TEST(Well, BoreRadiusFollowsTheIntervalsAndTheSmallerCountsWhereTwoMeet) {
  const Well well(straight(100.0), 0.1, {{"hole", 50.0, 100.0, 0.15}, {"casing", 20.0, 50.0, 0.2}});
  EXPECT_EQ(well.boreRadius(10.0), 0.1);
  EXPECT_EQ(well.boreRadius(20.0), 0.1);  // open hole above is narrower
  EXPECT_EQ(well.boreRadius(20.1), 0.2);
  EXPECT_EQ(well.boreRadius(50.0), 0.15);
  EXPECT_EQ(well.boreRadius(99.0), 0.15);
  EXPECT_EQ(well.intervals().front().name, "casing");
}

TEST(Well, RefusesIntervalsThatMakeNoSense) {
  EXPECT_THROW(Well(straight(100.0), 0.1, {{"a", 10.0, 10.0, 0.1}}), DeckError);
  EXPECT_THROW(Well(straight(100.0), 0.1, {{"a", 10.0, 20.0, 0.0}}), DeckError);
  EXPECT_THROW(Well(straight(100.0), 0.1, {{"a", 10.0, 30.0, 0.1}, {"b", 20.0, 40.0, 0.1}}),
               DeckError);
}

TEST(Well, ReadsEveryTrajectoryFromADeck) {
  const Well spiral = fromDeck(
      text("Trajectory", "Helix") + real("Bore Radius", "0.108") +
      list("Helix", real("Radius", "85.1") + text("Angle", "90 deg") + real("Length", "170.2")));
  EXPECT_NEAR(spiral.inclination(0.0) * 180.0 / pi, 51.76, 5e-3);
  EXPECT_EQ(spiral.boreRadius(20.0), 0.108);

  const Well vertical = fromDeck(text("Trajectory", "Vertical") + text("Bore Radius", "10.8 cm") +
                                 list("Vertical", real("Length", "1000")));
  EXPECT_EQ(vertical.inclination(500.0), 0.0);
  EXPECT_NEAR(vertical.boreRadius(1.0), 0.108, 1e-15);

  const Well curved = fromDeck(
      text("Trajectory", "Arc") + real("Bore Radius", "0.1") +
      list("Arc", real("Kick-off Depth", "100") + text("Build Rate", "3 deg/30m") +
                      text("End Inclination", "60 deg")) +
      list("Bore", list("casing", real("From", "0") + real("To", "100") + real("Radius", "0.15"))));
  EXPECT_NEAR(curved.length(), 700.0, 1e-9);
  EXPECT_NEAR(curved.inclination(400.0), pi / 6.0, 1e-12);
  EXPECT_EQ(curved.boreRadius(50.0), 0.15);
  EXPECT_EQ(curved.boreRadius(150.0), 0.1);

  const Well surveyed = fromDeck(
      text("Trajectory", "Survey") + real("Bore Radius", "0.1") +
      list("Survey", text("File", testing_::sourceFolder() + "/tests/unit/well/survey.csv")));
  EXPECT_NEAR(surveyed.length(), 1500.0 * 0.3048, 1e-9);
}

TEST(Well, FaultsNameTheirPlaceInTheDeck) {
  EXPECT_NE(errorOf(text("Trajectory", "Helix") + real("Bore Radius", "0.1")).find("/scene/Well"),
            std::string::npos);
  EXPECT_NE(
      errorOf(text("Trajectory", "Helix") + real("Bore Radius", "0.1") +
              list("Helix", real("Radius", "100") + real("Angle", "2") + real("Length", "100")))
          .find("/scene/Well/Helix: A helix of radius 100 m"),
      std::string::npos);
  EXPECT_NE(errorOf(text("Trajectory", "Arc") + real("Bore Radius", "0.1") +
                    list("Arc", real("End Inclination", "1")))
                .find("either Radius or Build Rate"),
            std::string::npos);
  EXPECT_NE(errorOf(text("Trajectory", "Arc") + real("Bore Radius", "0.1") +
                    list("Arc", real("End Inclination", "0") + real("Radius", "1")))
                .find("the same inclination"),
            std::string::npos);
  EXPECT_NE(errorOf(text("Trajectory", "Survey") + real("Bore Radius", "0.1") +
                    list("Survey", text("File", "none.csv")))
                .find("/scene/Well/Survey/File names a file"),
            std::string::npos);
  EXPECT_NE(errorOf(text("Trajectory", "Spiral") + real("Bore Radius", "0.1")).find("\"Helix\""),
            std::string::npos);
  EXPECT_NE(
      errorOf(text("Trajectory", "Vertical") + real("Bore Radius", "0.1") +
              list("Vertical", real("Length", "10")) +
              list("Bore", list("a", real("From", "5") + real("To", "4") + real("Radius", "0.1"))))
          .find("/scene/Well/Bore: The bore interval \"a\" ends at 4 m"),
      std::string::npos);
}

TEST(Below, IsTheSameHoleFromADepthOn) {
  ArcShape shape;
  shape.kickOffDepth = 100.0;
  shape.radius = 400.0;
  shape.endInclination = 0.5;
  shape.azimuth = 1.0;
  const Well whole(arc(shape), 0.108, {{"casing", 0.0, 150.0, 0.12}, {"shoe", 170.0, 180.0, 0.1}});
  const Well lower = whole.below(120.0);
  EXPECT_DOUBLE_EQ(lower.length(), whole.length() - 120.0);
  for (const double s : {0.0, 12.0, 30.0, 45.0, 55.0, 70.0, 150.0}) {
    EXPECT_EQ(lower.at(s).tangent, whole.at(120.0 + s).tangent) << s;
    EXPECT_EQ(lower.at(s).curvature, whole.at(120.0 + s).curvature) << s;
    EXPECT_EQ(lower.boreRadius(s), whole.boreRadius(120.0 + s)) << s;
    EXPECT_LT(
        (lower.at(s).position - (whole.at(120.0 + s).position - whole.at(120.0).position)).norm(),
        1e-12)
        << s;
  }
  const Well above = whole.below(50.0);
  ASSERT_EQ(above.trajectory().breaks().size(), 1U);
  EXPECT_DOUBLE_EQ(above.trajectory().breaks().front(), 50.0) << "the kick-off point";
}

}  // namespace WellTest
