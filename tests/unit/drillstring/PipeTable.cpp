// SPDX-License-Identifier: BSD-3-Clause
// Tables of drill pipe, and the one of API pipe against catalogues.
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "common/Constants.hpp"
#include "tests/support/SourceFolder.hpp"
#include "tests/unit/drillstring/Decks.hpp"

namespace PipeTableTest {

using namespace tooljoint;
using namespace tooljoint::drillstring;
using namespace tooljoint::drillstring::testing;

constexpr double inch = 0.0254, pound = 0.45359237, foot = 0.3048;
constexpr double poundForce = pound * 9.80665;

const std::string api =
    text("Pipe Table", testing_::sourceFolder() + "/xml/components/api_drill_pipe.csv");

DrillString stringOf(const std::string& component) {
  return build(api + array("Assembly", component), verticalWell(1000.0, 0.3));
}

/// Weights with tool joints: API RP 7G (1998), table 9, whose joints are 29.4 ft between the
/// shoulders, with tapers, threads and upsets that are not in the table of joints.
TEST(ApiDrillPipe, HasTheCatalogueWeights) {
  const std::vector<std::pair<std::string, double>> weights{
      {"2.375 in 6.65 G-105 NC26", 6.99},  {"2.875 in 10.40 S-135 NC31", 11.55},
      {"3.5 in 13.30 E-75 NC38", 13.93},   {"4.5 in 16.60 E-75 NC46", 18.37},
      {"4.5 in 20.00 E-75 NC46", 22.09},   {"5 in 19.50 X-95 NC50", 21.45},
      {"5 in 19.50 G-105 NC50", 21.93},    {"5 in 19.50 S-135 NC50", 22.61},
      {"5.5 in 21.90 E-75 5.5 FH", 23.77}, {"5.5 in 24.70 S-135 5.5 FH", 28.92}};
  for (const auto& [name, weight] : weights) {
    const DrillString string = stringOf(name);
    double mass = 0.0;
    for (const Element& element : string.elements)
      mass += element.section().massPerLength() * element.length();
    EXPECT_NEAR(mass / string.length() / pound * foot, weight, 0.02 * weight) << name;
  }
}

/// Loads at which new pipe yields: API RP 7G (1998), tables 2 and 3, in tension [lbf] and torsion
/// [ft lbf]; shear yields at 0.577 of the tensile strength.
TEST(ApiDrillPipe, YieldsAtTheCatalogueLoads) {
  const std::vector<std::tuple<std::string, double, double>> loads{
      {"5 in 19.50 E-75 NC50", 395595.0, 41167.0},
      {"5 in 19.50 X-95 NC50", 501087.0, 52144.0},
      {"5 in 19.50 G-105 NC50", 553833.0, 57633.0},
      {"5 in 19.50 S-135 NC50", 712070.0, 74100.0},
      {"5.5 in 21.90 S-135 5.5 FH", 786809.0, 91278.0},
      {"3.5 in 13.30 S-135 NC38", 488825.0, 33392.0}};
  for (const auto& [name, tension, torque] : loads) {
    const beam::Section body = stringOf(name).elements[3].section();
    ASSERT_TRUE(body.material().yieldStrength.has_value());
    const double strength = *body.material().yieldStrength;
    EXPECT_NEAR(strength * body.area() / poundForce, tension, 1e-4 * tension) << name;
    EXPECT_NEAR(0.577 * strength * body.torsion() / body.outerRadius() / (poundForce * foot),
                torque, 1e-3 * torque)
        << name;
  }
}

TEST(ApiDrillPipe, MakesJointsAndStands) {
  const DrillString string = stringOf("2*5 in 19.50 S-135 NC50 stand, 5 in 19.50 E-75 NC50");
  EXPECT_NEAR(string.length(), 7 * 9.45, 1e-9);
  EXPECT_EQ(string.elementCount(), 7 * 9);
  EXPECT_EQ(string.nested.front().path, "5 in 19.50 S-135 NC50 stand 1/5 in 19.50 S-135 NC50 1");
  const auto& box = string.elements[0];
  EXPECT_NEAR(box.length(), 10 * inch, 1e-12);
  EXPECT_NEAR(box.section().innerRadius(), 1.375 * inch, 1e-12);
}

const std::string header =
    "Name;Length [m];Outer Diameter [in];Inner Diameter [in];Upset Length [mm];Upset Outer "
    "Diameter [in];Upset Inner Diameter [in];Tool Joint Outer Diameter [in];Tool Joint Inner "
    "Diameter [in];Box Length [in];Pin Length [in];Yield Strength [MPa];Tool Joint Yield Strength "
    "[MPa]\n";

/// Message on a user's table.
std::string said(const std::string& table) {
  const std::string file = ::testing::TempDir() + "pipes.csv";
  std::ofstream(file) << table;
  std::string error = errorOf(text("Pipe Table", file) + array("Assembly", "pipe"));
  for (auto at = error.find(file); at != std::string::npos; at = error.find(file))
    error.replace(at, file.size(), "pipes.csv");
  return error;
}

TEST(PipeTable, TakesTablesAsSpreadsheetsWriteThem) {
  EXPECT_EQ(said("# our own\n" + header + "pipe;9,45;5;4,276;150;5,125;3;6,625;3;10;7;931;827\n"),
            "no error");
}

TEST(PipeTable, SaysWhatIsWrongWithARow) {
  const auto row = [](const std::string& cells) { return said(header + cells + "\n"); };
  EXPECT_EQ(row("pipe;9.45;5;5.1;150;5.125;3;6.625;3;10;7;931;827"),
            "pipes.csv:2: Inner Diameter must be below the Outer Diameter.");
  EXPECT_EQ(row("pipe;9.45;5;4.276;150;5.125;3;6.625;3;10;seven;931;827"),
            "pipes.csv:2: Pin Length \"seven\" is not a number.");
  EXPECT_EQ(row("pipe;9.45;5;4.276;150;5.125;3;6.625;3;10;7;-931;827"),
            "pipes.csv:2: Yield Strength \"-931\" must be positive.");
  EXPECT_EQ(row("pipe;0.5;5;4.276;150;5.125;3;6.625;3;10;7;931;827"),
            "pipes.csv:2: box, pin and upsets are longer than the joint (0.5 m).");
  EXPECT_EQ(row("pipe;9.45;5"), "pipes.csv:2: found 3 columns where the header has 13.");
  EXPECT_EQ(row("3*pipe;9.45;5;4.276;150;5.125;3;6.625;3;10;7;931;827"),
            "pipes.csv:2: The name of a component must not hold any of the characters "
            "* , / { }.");
  const std::string good = "pipe;9.45;5;4.276;150;5.125;3;6.625;3;10;7;931;827";
  EXPECT_EQ(row(good + "\n" + good),
            "pipes.csv:3: The component is defined before (pipes.csv:2); rename one of them.");
}

TEST(PipeTable, SaysWhatIsWrongWithTheHeader) {
  const auto with = [](const std::string& old, const std::string& now) {
    std::string changed = header;
    return said(changed.replace(changed.find(old), old.size(), now));
  };
  EXPECT_EQ(with("Outer Diameter [in]", "Outer Diameter [lbf]").substr(0, 70),
            "pipes.csv:1: the column \"Outer Diameter\" has the unit \"lbf\". Expected ");
  EXPECT_EQ(with("Box Length [in]", "Box Lenght [in]").substr(0, 76),
            "pipes.csv:1: the column \"Box Lenght\" is unknown. Did you mean \"Box Length\"? ");
  EXPECT_EQ(with(";Pin Length [in]", ""), "pipes.csv:1: the column \"Pin Length\" is missing.");
  EXPECT_EQ(said("").substr(0, 46), "pipes.csv:1: the table of drill pipe is empty.");
  EXPECT_NE(errorOf(text("Pipe Table", "nowhere.csv") + array("Assembly", "pipe"))
                .find("Drillstring/Pipe Table names a file, but nowhere.csv"),
            std::string::npos);
}

}  // namespace PipeTableTest
