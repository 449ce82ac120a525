// SPDX-License-Identifier: BSD-3-Clause
// The string of Nguyen et al. 2020, section 5, against the numbers of the paper.
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

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
  // at a change of section the smaller clearance is used: upset above, joint below
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

const std::string apiLibrary =
    text("Library", testing_::sourceFolder() + "/xml/components/api_pipes.xml");

/// lb/ft of a component of the library.
double weightOf(const std::string& component) {
  const DrillString string =
      build(apiLibrary + array("Assembly", component), verticalWell(1000.0, 0.3));
  double mass = 0.0;
  for (const Element& element : string.elements)
    mass += element.section().massPerLength() * element.length();
  constexpr double poundPerFoot = 0.45359237 / 0.3048;
  return mass / string.length() / poundPerFoot;
}

TEST(ApiLibrary, IsBuiltIn) {
  const auto lengthWith = [](const std::string& library) {
    return build(library + array("Assembly", "2*5 in stand"), verticalWell(1000.0, 0.3)).length();
  };
  EXPECT_EQ(lengthWith(text("Library", "api_pipes")), lengthWith(apiLibrary));
}

TEST(ApiLibrary, BuildsAString) {
  const DrillString string = build(
      apiLibrary +
      array(
          "Assembly",
          "2*5 in stand, 5 in HWDP stand, 2*8 in collar, under-gauge stabiliser, 3*6.5 in collar, "
          "string stabiliser, 6.5 in collar, near-bit stabiliser, 8.5 in PDC bit"));
  EXPECT_EQ(string.nested.front().path, "5 in stand 1/5 in drill pipe 1");
  EXPECT_TRUE(string.nodes.back().gauge);
  EXPECT_NEAR(string.nodes.back().clearance, 0.108 - 4.25 * 0.0254, 1e-12);
}

/// Weights with tool joints of grade E, API RP 7G, table 8, and of heavy-weight pipe, from
/// catalogues: their tapers and threads, and the lengths of upsets, are not those of the library.
/// Weights of collars, table 13, are rounded to a pound.
TEST(ApiLibrary, HasTheCatalogueWeights) {
  const std::vector<std::pair<std::string, double>> pipes{
      {"2.375 in stand", 6.99},      {"2.875 in stand", 10.87},    {"3.5 in stand", 13.93},
      {"3.5 in 15.50 stand", 16.54}, {"4 in stand", 15.04},        {"4.5 in stand", 18.37},
      {"4.5 in 20.00 stand", 22.09}, {"5 in stand", 20.85},        {"5.5 in stand", 23.77},
      {"5.5 in 24.70 stand", 26.33}, {"6.625 in stand", 27.15},    {"3.5 in HWDP stand", 23.4},
      {"4 in HWDP stand", 29.9},     {"4.5 in HWDP stand", 41.1},  {"5 in HWDP stand", 50.1},
      {"5.5 in HWDP stand", 57.8},   {"6.625 in HWDP stand", 71.3}};
  for (const auto& [name, weight] : pipes)
    EXPECT_NEAR(weightOf(name), weight, 0.025 * weight) << name;
  const std::vector<std::pair<std::string, double>> collars{
      {"3.125 in collar", 22}, {"4.125 in collar", 35}, {"4.75 in collar", 47},
      {"6.25 in collar", 83},  {"6.5 in collar", 92},   {"6.75 in collar", 101},
      {"7.25 in collar", 119}, {"8 in collar", 150},    {"9.5 in collar", 217},
      {"11 in collar", 299}};
  for (const auto& [name, weight] : collars) EXPECT_NEAR(weightOf(name), weight, 0.6) << name;
}

}  // namespace ReferenceTest
