// SPDX-License-Identifier: BSD-3-Clause
// The string of Nguyen et al. 2020, section 5, against the numbers of the paper.
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "substructures/contact/ContactParameters.hpp"
#include "substructures/drillstring/ContactNodes.hpp"
#include "tests/support/SourceFolder.hpp"
#include "tests/unit/drillstring/Decks.hpp"

namespace ReferenceTest {

using namespace tooljoint;
using namespace tooljoint::drillstring;
using namespace tooljoint::drillstring::testing;

using constants::pi;

DrillString reference() {
  const std::string inside =
      text("Library", testing_::sourceFolder() + "/xml/components/helical_170m.xml") +
      array("Assembly",
            "5*pipe, last pipe, 3*collar, stabiliser, 4*collar, stabiliser, 3*collar, bit") +
      list("Material", real("Density", "7900") + real("Young Modulus", "2.03e11") +
                           real("Poisson Ratio", "0.3"));
  return build(inside, well::Well(well::helix(85.1, 0.5 * pi, 170.2), 0.108));
}

const Node& node(const DrillString& string, int number) {
  return string.nodes.at(static_cast<std::size_t>(number - 1));
}

TEST(ReferenceString, HasTheMeshOfThePaper) {
  const DrillString string = reference();
  EXPECT_EQ(string.elementCount(), 162);
  EXPECT_EQ(string.nodeCount(), 163);
  EXPECT_NEAR(string.length(), 170.2, 1e-10);
  const std::vector<std::pair<int, double>> places = {
      {3, 3.6}, {21, 23.6}, {44, 49.5}, {82, 87.7}, {147, 154.7}};
  for (const auto& [number, s] : places) EXPECT_NEAR(node(string, number).s, s, 1e-10) << number;
}

TEST(ReferenceString, HasGaugesAtTheStabilisersAndTheBit) {
  const DrillString string = reference();
  std::vector<int> gauges;
  for (int i = 1; i <= string.nodeCount(); ++i)
    if (node(string, i).gauge) gauges.push_back(i);
  EXPECT_EQ(gauges, (std::vector<int>{86, 130, 163}));
  for (const int i : gauges) {
    EXPECT_EQ(node(string, i).clearance, 0.0);
    EXPECT_EQ(node(string, i).contactRadius, 0.108);
  }
}

// Table 2 of the paper
TEST(ReferenceString, HasThePublishedClearances) {
  const DrillString string = reference();
  EXPECT_NEAR(node(string, 3).clearance, 0.0445, 1e-15);
  EXPECT_NEAR(node(string, 3).contactRadius, 0.0635, 1e-15);
  EXPECT_NEAR(node(string, 44).clearance, 0.027, 1e-15);  // between the joint halves
  EXPECT_NEAR(node(string, 44).contactRadius, 0.081, 1e-15);
  EXPECT_NEAR(node(string, 147).clearance, 0.0285, 1e-15);
  EXPECT_NEAR(node(string, 147).contactRadius, 0.0795, 1e-15);
  // where the section changes the smaller clearance counts: upset above, joint below
  EXPECT_NEAR(node(string, 7).s, 9.2, 1e-12);
  EXPECT_NEAR(node(string, 7).clearance, 0.027, 1e-15);
}

TEST(ReferenceString, KnowsItsComponents) {
  const DrillString string = reference();
  ASSERT_EQ(string.instances.size(), 19u);
  EXPECT_EQ(string.instances[0].component, "pipe");
  EXPECT_EQ(string.instances[4].path, "pipe 5");
  EXPECT_EQ(string.instances[5].path, "last pipe 1");
  EXPECT_EQ(string.instances[18].component, "bit");
  int next = 0;
  for (std::size_t i = 0; i < string.instances.size(); ++i) {
    EXPECT_EQ(string.instances[i].firstElement, next);
    for (int e = next; e <= string.instances[i].lastElement; ++e)
      EXPECT_EQ(string.elements[static_cast<std::size_t>(e)].instance, static_cast<int>(i));
    next = string.instances[i].lastElement + 1;
  }
  EXPECT_EQ(next, 162);
  ASSERT_EQ(string.nested.size(), 29u);
  EXPECT_EQ(string.nested[3].path, "pipe 1/tool joint half 2");
  EXPECT_EQ(string.nested[3].firstElement, 7);
}

TEST(ReferenceString, TouchesAtEveryNodeButTheHeldEnds) {
  const DrillString string = reference();
  contact::ContactSettings settings;
  settings.values.stiffness = 1e7;
  const auto points = contactPoints(settings, string, SupportSettings().held(string.nodeCount()));
  ASSERT_EQ(points.size(), 161);
  EXPECT_EQ(points.node.front(), 2);
  EXPECT_EQ(points.node.back(), 162);
  EXPECT_NEAR(points.clearance[42], 0.027, 1e-15);
}

TEST(ReferenceString, HasTheMaterialOfTheDeck) {
  const DrillString string = reference();
  EXPECT_EQ(string.elements[0].section().density(), 7900.0);
  EXPECT_EQ(string.elements[0].section().youngModulus(), 2.03e11);
  EXPECT_EQ(string.elements[0].section().innerRadius(), 0.054);
  EXPECT_NEAR(string.elements[0].length(), 1.8, 1e-15);
}

TEST(ApiLibrary, BuildsAStringAndHasTheCatalogueWeights) {
  const std::string inside =
      text("Library", testing_::sourceFolder() + "/xml/components/api_pipes.xml") +
      array(
          "Assembly",
          "2*5 in stand, 5 in HWDP stand, 2*8 in collar, under-gauge stabiliser, 3*6.5 in collar, "
          "string stabiliser, 6.5 in collar, near-bit stabiliser, 8.5 in PDC bit");
  const DrillString string = build(inside);
  const auto weight = [&](const std::string& component) {  // kg/m of the first occurrence
    for (const auto* group : {&string.instances, &string.nested})
      for (const Instance& instance : *group) {
        if (instance.component != component) continue;
        double mass = 0.0, length = 0.0;
        for (int e = instance.firstElement; e <= instance.lastElement; ++e) {
          const Element& element = string.elements[static_cast<std::size_t>(e)];
          mass += element.section().massPerLength() * element.length();
          length += element.length();
        }
        return mass / length;
      }
    return 0.0;
  };
  const double poundPerFoot = 0.45359237 / 0.3048;
  EXPECT_NEAR(weight("5 in drill pipe") / poundPerFoot, 20.9,
              0.8);  // approximate weight with tool joints, API RP 7G
  EXPECT_NEAR(weight("5 in HWDP") / poundPerFoot, 49.3, 2.0);
  EXPECT_NEAR(weight("6.5 in collar") / poundPerFoot, 92.0, 1.0);
  EXPECT_NEAR(weight("8 in collar") / poundPerFoot, 150.0, 1.0);
  EXPECT_EQ(string.nested.front().path, "5 in stand 1/5 in drill pipe 1");
  EXPECT_TRUE(string.nodes.back().gauge);
  EXPECT_NEAR(string.nodes.back().clearance, 0.108 - 4.25 * 0.0254, 1e-12);
}

}  // namespace ReferenceTest
