// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/Mesh.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "common/report/Log.hpp"
#include "tests/support/SourceFolder.hpp"
#include "tests/unit/drillstring/Decks.hpp"

namespace MeshTest {

using namespace tooljoint;
using namespace tooljoint::drillstring;
using namespace tooljoint::drillstring::testing;

TEST(Mesh, RepeatsAndNests) {
  const DrillString string = build(
      list("Components", tube("pipe", 9.0, 3, 0.06, 0.05) + tube("joint", 0.5, 1, 0.08, 0.05) +
                             list("single", array("Parts", "pipe, joint")) +
                             list("stand", array("Parts", "3*single"))) +
      array("Assembly", "2*stand, joint"));
  EXPECT_EQ(string.elementCount(), 2 * 3 * 4 + 1);
  EXPECT_NEAR(string.length(), 2 * 3 * 9.5 + 0.5, 1e-12);
  ASSERT_EQ(string.instances.size(), 3u);
  EXPECT_EQ(string.instances[1].path, "stand 2");
  EXPECT_EQ(string.instances[2].path, "joint 1");
  EXPECT_EQ(string.nested.size(), 2u * 9u);
  EXPECT_EQ(string.nested[3].path, "stand 1/single 2");
  EXPECT_EQ(string.nested[4].path, "stand 1/single 2/pipe 1");
  EXPECT_EQ(string.nested[3].firstElement, 4);
  EXPECT_EQ(string.nested[3].lastElement, 7);
}

TEST(Mesh, SegmentsFollowInTheOrderOfTheDeck) {
  const std::string segment = whole("Elements", 2) + real("Inner Radius", "0.02");
  const DrillString string = build(
      list("Components",
           list("tool", list("Segments", list("zulu", segment + real("Length", "1") +
                                                          real("Outer Radius", "0.05")) +
                                             list("alpha", segment + real("Length", "3") +
                                                               real("Outer Radius", "0.07"))))) +
      array("Assembly", "tool"));
  ASSERT_EQ(string.elementCount(), 4);
  EXPECT_EQ(string.elements[0].length(), 0.5);
  EXPECT_EQ(string.elements[3].length(), 1.5);
  EXPECT_EQ(string.elements[3].section().outerRadius(), 0.07);
}

/// Two stands of {pipe of 9 m in 3 elements, joint of 1 m} and a bit with a gauge, hung at a depth.
DrillString hung(double bit) {
  const std::string gauge = real("Gauge Position", "2") + real("Gauge Radius", "0.1");
  const auto settings = readDrillstring(scene(
      list("Components", tube("pipe", 9.0, 3, 0.06, 0.05) + tube("joint", 1.0, 1, 0.08, 0.05) +
                             tube("bit", 2.0, 2, 0.07, 0.03, gauge) +
                             list("stand", array("Parts", "pipe, joint"))) +
      array("Assembly", "2*stand, bit")));
  return buildDrillString(settings, verticalWell(), bit);
}

TEST(Mesh, HangsWithItsBitAtADepthAndIsCutAtTheSurface) {
  const DrillString string =
      hung(13.5);  // of 22 m: all but the last 1.5 m of the first stand is above
  ASSERT_EQ(string.elementCount(), 2 + 4 + 2);
  EXPECT_EQ(string.nodes.front().s, 0.0);
  EXPECT_NEAR(string.length(), 13.5, 1e-12);
  EXPECT_NEAR(string.elements[0].length(), 0.5, 1e-12) << "what is left of a pipe element";
  EXPECT_EQ(string.elements[0].section().outerRadius(), 0.06);
  EXPECT_EQ(string.elements[1].section().outerRadius(), 0.08);
  for (int e = 0; e < string.elementCount(); ++e)
    EXPECT_NEAR(string.nodes[static_cast<std::size_t>(e + 1)].s -
                    string.nodes[static_cast<std::size_t>(e)].s,
                string.elements[static_cast<std::size_t>(e)].length(), 1e-12);
  ASSERT_EQ(string.instances.size(), 3u);
  EXPECT_EQ(string.instances[0].lastElement, 1);
  EXPECT_EQ(string.instances[1].path, "stand 2");
  EXPECT_EQ(string.instances[1].firstElement, 2);
  EXPECT_EQ(string.elements[2].instance, 1);
  EXPECT_EQ(string.nested.front().path, "stand 1/pipe 1");
  EXPECT_EQ(string.nested.front().lastElement, 0);
  EXPECT_TRUE(string.nodes.back().gauge);
  EXPECT_NEAR(string.nodes.back().clearance, 0.008, 1e-12);
}

TEST(Mesh, LeavesNoSliverAtTheSurface) {
  const DrillString string = hung(13.1);  // 0.1 m of a pipe element of 3 m would be left
  EXPECT_EQ(string.elementCount(), 1 + 4 + 2);
  EXPECT_NEAR(string.elements[0].length(), 1.1, 1e-12);
  EXPECT_EQ(string.elements[0].section().outerRadius(), 0.08);
  EXPECT_EQ(string.instances.front().path, "stand 1");
  EXPECT_EQ(string.nested.front().path, "stand 1/joint 1");
  EXPECT_EQ(hung(22.0).elementCount(), 10) << "the whole string";
  EXPECT_EQ(hung(2.0).instances.size(), 1u) << "the bit alone";
  EXPECT_NEAR(hung(0.05).length(), 0.05, 1e-12) << "no neighbour takes the last sliver";
}

std::string filling(const std::string& assembly, const std::string& depth = "") {
  return list("Components", tube("pipe", 9.0, 3, 0.06, 0.05) + tube("joint", 1.0, 1, 0.08, 0.05) +
                                tube("bit", 2.0, 2, 0.07, 0.03) +
                                list("stand", array("Parts", "pipe, joint"))) +
         array("Assembly", assembly) + (depth.empty() ? "" : real("Bit Depth", depth));
}

TEST(Mesh, FillsTheStringUpToTheSurface) {
  const DrillString string = build(filling("fill*stand, bit", "33.5"));
  EXPECT_NEAR(string.length(), 33.5, 1e-12);
  ASSERT_EQ(string.instances.size(), 5u) << "four stands, the uppermost cut, and the bit";
  EXPECT_EQ(string.elementCount(), 2 + 3 * 4 + 2);
  EXPECT_NEAR(build(filling("fill*stand, bit")).length(), 1000.0, 1e-9) << "to the end of the well";
  EXPECT_EQ(build(filling("fill*stand, bit", "32")).instances.size(), 4u)
      << "no sliver of a fourth";
  EXPECT_NEAR(build(filling("5*stand, bit", "33.5")).length(), 33.5, 1e-12) << "cut without a fill";
}

TEST(Mesh, HangsWithoutAFillWhereTheOthersReachTheSurface) {
  const auto settings = readDrillstring(scene(filling("fill*stand, 4*bit")));
  const DrillString string = buildDrillString(settings, verticalWell(), 5.0);
  EXPECT_NEAR(string.length(), 5.0, 1e-12);
  EXPECT_EQ(string.instances.front().path, "bit 2") << "of 8 m of bits the lower 5";
}

/// A tool joint at the end of a pipe above a wider collar: the collar touches first.
TEST(Mesh, LeavesAGaugeBesideAWiderBodyToThatBody) {
  const std::string gauge = real("Gauge Position", "9") + real("Gauge Radius", "0.08");
  const DrillString string = build(list("Components", tube("pipe", 9.0, 3, 0.06, 0.05, gauge) +
                                                          tube("collar", 9.0, 3, 0.09, 0.03)) +
                                   array("Assembly", "2*pipe, collar"));
  EXPECT_TRUE(string.nodes[3].gauge);
  EXPECT_NEAR(string.nodes[3].clearance, 0.028, 1e-12);
  EXPECT_FALSE(string.nodes[6].gauge);
  EXPECT_NEAR(string.nodes[6].clearance, 0.018, 1e-12);
  EXPECT_EQ(string.nodes[6].contactRadius, 0.09);
}

/// The lever arm of friction in the soft string: a joint belongs to its own entry, even if the node
/// belongs to the entry below, or if the body below is wider.
TEST(Mesh, GivesAGaugeToTheEntryItStandsOn) {
  const std::string gauge = real("Gauge Position", "9") + real("Gauge Radius", "0.08");
  for (const double collar : {0.07, 0.09}) {
    const DrillString string =
        build(list("Components", tube("pipe", 9.0, 3, 0.06, 0.05, gauge) +
                                     tube("collar", 9.0, 3, collar, 0.03) +
                                     list("stand", array("Parts", "2*pipe"))) +
              array("Assembly", "stand, collar"));
    EXPECT_EQ(string.instances[0].gaugeRadius, 0.08);
    EXPECT_EQ(string.instances[1].gaugeRadius, 0.0);
  }
}

TEST(Mesh, DropsAGaugeWhoseNodeTheCutRemoves) {
  const std::string gauge = real("Gauge Position", "9") + real("Gauge Radius", "0.1");
  const std::string assembly =
      list("Components", tube("pipe", 9.0, 3, 0.06, 0.05, gauge)) + array("Assembly", "fill*pipe");
  const DrillString string =
      build(assembly + real("Bit Depth", "27.2"));  // 0.2 m of an element of 3 m join the next one
  EXPECT_NEAR(string.elements[0].length(), 3.2, 1e-12);
  EXPECT_FALSE(string.nodes[0].gauge);
  for (std::size_t i = 1; i < string.nodes.size(); ++i)
    EXPECT_EQ(string.nodes[i].gauge, i % 3 == 0) << i;
  EXPECT_TRUE(build(assembly + real("Bit Depth", "27.4")).nodes[1].gauge) << "long enough to stay";
}

TEST(Mesh, RefusesAFillThatCannotBe) {
  const auto refused = [](const std::string& assembly, const std::string& depth,
                          const std::string& words) {
    const std::string error = errorOf(filling(assembly, depth));
    EXPECT_NE(error.find(words), std::string::npos) << error;
  };
  refused("bit, fill*stand", "30", "\"fill*stand\" is not the first entry");
  refused("fill*stand, 20*bit", "30",
          "/Drillstring/Bit Depth is 30 m, but the string below \"fill*stand\" is 40 m long");
  refused("2*stand, bit", "30",
          "/Drillstring/Bit Depth is 30 m, but the Assembly is 22 m long and does not reach");
  refused("fill*stand, bit", "2000", "but the well ends at 1000 m");
  refused("fill*stnd, bit", "30", "Did you mean \"stand\"?");
  EXPECT_NE(errorOf(list("Components", tube("pipe", 9.0, 3, 0.06, 0.05) +
                                           list("stand", array("Parts", "fill*pipe"))) +
                    array("Assembly", "stand"))
                .find("only the first entry of an Assembly"),
            std::string::npos);
}

TEST(Mesh, ClearanceIsTheSmallerOneWhereSectionOrBoreChange) {
  const well::Well well(well::straight(100.0), 0.1, {{"casing", 0.0, 10.0, 0.15}});
  const DrillString string = build(
      list("Components", tube("wide", 10.0, 2, 0.12, 0.05) + tube("thin", 10.0, 2, 0.06, 0.05) +
                             tube("thick", 10.0, 2, 0.08, 0.05)) +
          array("Assembly", "wide, thin, thick, thin"),
      well);
  const std::vector<double> clearances = {0.03, 0.03, 0.03, 0.04, 0.02, 0.02, 0.02, 0.04, 0.04};
  const std::vector<double> radii = {0.12, 0.12, 0.12, 0.06, 0.08, 0.08, 0.08, 0.06, 0.06};
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_NEAR(string.nodes[i].clearance, clearances[i], 1e-15) << i;
    EXPECT_NEAR(string.nodes[i].contactRadius, radii[i], 1e-15) << i;
  }
  EXPECT_EQ(string.nodes[2].component, "wide");
}

TEST(Mesh, GaugeReplacesTheBodyAtItsNode) {
  const std::string gauge = real("Gauge Position", "1") + real("Gauge Radius", "0.1");
  const DrillString string =
      build(list("Components", tube("collar", 4.0, 4, 0.08, 0.03) +
                                   tube("stabiliser", 2.0, 2, 0.08, 0.03, gauge)) +
            array("Assembly", "collar, stabiliser, collar"));
  for (std::size_t i = 0; i < string.nodes.size(); ++i) {
    EXPECT_EQ(string.nodes[i].gauge, i == 5) << i;
    EXPECT_NEAR(string.nodes[i].clearance, i == 5 ? 0.008 : 0.028, 1e-15) << i;
    EXPECT_NEAR(string.nodes[i].contactRadius, i == 5 ? 0.1 : 0.08, 1e-15) << i;
  }
  EXPECT_EQ(string.nodes[5].component, "stabiliser");
  EXPECT_NEAR(string.elements[4].section().outerRadius(), 0.08, 1e-15);
}

TEST(Mesh, GeneralSectionsAndMaterials) {
  const std::string general = real("Length", "2") + real("Area", "1e-2") +
                              real("Inertia X", "2e-5") + real("Inertia Y", "3e-5") +
                              real("Torsion Constant", "4e-5");
  const DrillString string = build(
      list("Components",
           list("beam", general + list("Material", real("Density", "2700"))) +
               tube("pipe", 1.0, 1, 0.05, 0.0) +
               list("stiff",
                    real("Length", "1") + real("Outer Radius", "0.05") +
                        "<Parameter name=\"Shear Deformation\" type=\"bool\" value=\"false\"/>")) +
      list("Material", real("Density", "8000") + real("Young Modulus", "2e11") +
                           real("Poisson Ratio", "0.25")) +
      array("Assembly", "beam, pipe, stiff"));
  const beam::Section& section = string.elements[0].section();
  EXPECT_EQ(section.area(), 1e-2);
  EXPECT_EQ(section.inertiaX(), 2e-5);
  EXPECT_EQ(section.inertiaY(), 3e-5);
  EXPECT_EQ(section.torsion(), 4e-5);
  EXPECT_FALSE(section.shearDeformable());
  EXPECT_EQ(section.density(), 2700.0);
  EXPECT_EQ(section.youngModulus(), 2e11);
  EXPECT_NEAR(string.nodes[0].clearance, 0.108, 1e-15);
  EXPECT_EQ(string.elements[1].section().density(), 8000.0);
  EXPECT_EQ(string.elements[1].section().material().poissonRatio, 0.25);
  EXPECT_TRUE(string.elements[1].section().shearDeformable());
  EXPECT_FALSE(string.elements[2].section().shearDeformable());
}

TEST(Mesh, WarnsOfABoreNoNodeSees) {
  log::clearWarnings();
  const well::Well well(well::straight(100.0), 0.1, {{"ledge", 4.0, 5.0, 0.07}});
  build(list("Components", tube("pipe", 9.0, 1, 0.06, 0.05)) + array("Assembly", "pipe"), well);
  ASSERT_EQ(log::warnings().size(), 1u);
  EXPECT_NE(log::warnings()[0].find("\"ledge\""), std::string::npos);
}

TEST(MeshErrors, SayWhatIsWrongAndWhere) {
  const std::string pipe = tube("pipe", 9.0, 3, 0.06, 0.05);
  const auto has = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  const auto components = [](const std::string& inside) { return list("Components", inside); };
  has(errorOf(components(pipe) + array("Assembly", "pipes")),
      "/scene/Drillstring/Assembly: The component \"pipes\" is not defined. Did you mean "
      "\"pipe\"?");
  has(errorOf(array("Assembly", "pipe")), "No components are defined");
  has(errorOf(components(pipe) + array("Assembly", "jars")), "is not defined. Known are \"pipe\".");
  std::string stock;  // as in a library
  for (int size = 1; size <= 20; ++size)
    stock += tube(std::to_string(size) + " in collar", 9.0, 1, 0.06, 0.05);
  stock += tube("near-bit Stabiliser", 1.0, 1, 0.06, 0.05);
  has(errorOf(components(stock) + array("Assembly", "my stab")),
      "is not defined. Known with such a name are \"near-bit Stabiliser\".");
  has(errorOf(components(stock) + array("Assembly", "extra long non-magnetic collar, motor")),
      " and 8 more.");
  has(errorOf(components(stock) + array("Assembly", "motor")),
      "None of the 21 known ones has such a name: describe it in Drillstring/Components.");
  has(errorOf(components(pipe) + array("Assembly", "0*pipe")),
      "the number before * must be a whole number from 1 on");
  has(errorOf(components(pipe) + array("Assembly", "x*pipe")),
      "the number before * must be a whole number from 1 on");
  has(errorOf(components(pipe) + array("Assembly", "2*3*pipe")), "is not of the form");
  has(errorOf(components(pipe) + array("Assembly", "2*")), "is not of the form");
  has(errorOf(
          components(pipe + list("a", array("Parts", "b")) + list("b", array("Parts", "pipe, a"))) +
          array("Assembly", "a")),
      "The component contains itself (a > b > a).");
  has(errorOf(components(pipe + list("a", array("Parts", "pipe, jiont"))) + array("Assembly", "a")),
      "/Components/a/Parts: The component \"jiont\" is not defined.");
  has(errorOf(components(pipe) + array("Assembly", "12*pipe"), verticalWell(100.0)),
      "The string is 108 m long, but the well ends at 100 m.");
  has(errorOf(components(pipe) + array("Assembly", "pipe"), verticalWell(100.0, 0.05)),
      "The Outer Radius of pipe 1, 0.06 m, does not fit into the hole of radius 0.05 m at 0 m "
      "(node "
      "1).");
  has(errorOf(components(tube("pipe", 9.0, 3, 0.06, 0.06)) + array("Assembly", "pipe")),
      "/pipe/Inner Radius: 0.06 m must be below the Outer Radius, 0.06 m.");
  has(errorOf(components(pipe) + array("Assembly", "1000000000*pipe"), verticalWell(100.0)),
      "more than 200000 elements");
}

TEST(MeshErrors, Gauges) {
  const auto has = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  const auto gauged = [](const std::string& position, const std::string& radius) {
    return list("Components",
                tube("stab", 2.0, 2, 0.08, 0.03,
                     real("Gauge Position", position) + real("Gauge Radius", radius))) +
           array("Assembly", "2*stab");
  };
  has(errorOf(gauged("0.9", "0.1")),
      "The Gauge Position 0.9 m is not at a node of the component; the nearest is at 1 m.");
  has(errorOf(gauged("3", "0.1")), "is not at a node of the component; the nearest is at 2 m.");
  has(errorOf(gauged("1", "0.11")),
      "The Gauge Radius 0.11 m does not fit into the hole of radius 0.108 m at 1 m (node 2).");
  has(errorOf(gauged("1", "0.07")), "is below the outer radius of the body");
  has(errorOf(list("Components", tube("stab", 2.0, 2, 0.08, 0.03, real("Gauge Position", "1"))) +
              array("Assembly", "stab")),
      "Gauge Radius is missing");
  EXPECT_EQ(errorOf(gauged("1", "0.108")), "no error");
  std::string many = gauged("1", "0.07");
  many.replace(many.find("2*stab"), 1, "30");
  const std::string message = errorOf(many);
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 10) << message;
  has(message, "20 more errors follow.");
}

TEST(ComponentErrors, AreAllReported) {
  const std::string message =
      errorOf(list("Components",
                   list("a", text("Description", "nothing else")) + list("b", real("Length", "1")) +
                       list("c", real("Length", "1") + real("Area", "1") + real("Inertia X", "1")) +
                       list("d", real("Length", "1") + array("Parts", "a")) +
                       list("e", list("Segments", list("s", real("Outer Radius", "1")))) +
                       list("f*", real("Length", "1") + real("Outer Radius", "0.1"))) +
              array("Assembly", "a"));
  // the segment without Length fails in phase 2: nothing else is checked
  EXPECT_NE(message.find("/e/Segments/s/Length"), std::string::npos) << message;
  const std::string rest =
      errorOf(list("Components",
                   list("a", text("Description", "nothing else")) + list("b", real("Length", "1")) +
                       list("c", real("Length", "1") + real("Area", "1") + real("Inertia X", "1")) +
                       list("d", real("Length", "1") + array("Parts", "a")) +
                       list("f*", real("Length", "1") + real("Outer Radius", "0.1")) +
                       list("g", real("Outer Radius", "0.1")) + list("h", list("Segments", ""))) +
              array("Assembly", "3*"));
  for (const char* part :
       {"/Components/a: A component is given by exactly one of", "/b: The section is missing",
        "/c: A general section also needs Inertia Y, Torsion Constant.",
        "/d: A component is given by exactly one of", "/f*: The name of a component must not hold",
        "/g: The segment has no Length.", "/h/Segments: The list is empty",
        "/Assembly: \"3*\" is not of the form"})
    EXPECT_NE(rest.find(part), std::string::npos) << part << " not in\n" << rest;
}

TEST(ComponentErrors, ANameMayBeDefinedOnlyOnce) {
  const std::string library =
      text("Library", testing_::sourceFolder() + "/xml/components/helical_170m.xml");
  const std::string message = errorOf(
      library + list("Components", tube("bit", 1.0, 1, 0.08, 0.03)) + array("Assembly", "bit"));
  EXPECT_NE(message.find("/Drillstring/Components/bit: The component is defined before ("),
            std::string::npos)
      << message;
  EXPECT_NE(message.find("helical_170m.xml:"), std::string::npos) << message;
}

TEST(ComponentErrors, LibraryThatIsMissingIsAFaultOfTheDeck) {
  const std::string message = errorOf(text("Library", "none.xml") + array("Assembly", "bit"));
  EXPECT_NE(message.find("/scene/Drillstring/Library"), std::string::npos) << message;
}

}  // namespace MeshTest
