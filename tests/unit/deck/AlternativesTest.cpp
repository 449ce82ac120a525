// SPDX-License-Identifier: BSD-3-Clause
// Diameters beside radii, and units that depend on another parameter.
#include <gtest/gtest.h>

#include "SmallScene.hpp"
#include "deck/Manual.hpp"
#include "deck/Template.hpp"

namespace AlternativesTest {

using namespace tooljoint;
using namespace tooljoint::deck;
using namespace tooljoint::deck::test;

ListSpec tubes() {
  ListSpec tube("tube", "A tube.");
  tube.radius("Outer Radius", Required{}, Range::positive(), "Outer radius.")
      .radius("Inner Radius", Optional{}, Range::nonNegative(), "Inner radius.")
      .text("Component", Optional{}, "Direction of the load.")
      .real("Value", "N or N m", Optional{}, Range::any(), "Load.")
      .unitBy("Component", [](const std::string& component) {
        return component == "theta" ? "N m" : component == "u" ? "N" : "";
      });
  return ListSpec("scene", "Tubes.").namedLists(tube);
}

Deck parsed(const std::string& tube, const std::vector<std::string>& overrides = {}) {
  return Deck::parse("<ParameterList name=\"s\">\n<ParameterList name=\"a\">\n" + tube +
                         "\n</ParameterList>\n</ParameterList>\n",
                     "deck.xml", tubes(), overrides);
}

std::string fault(const std::string& tube, const std::vector<std::string>& overrides = {}) {
  return messageOf([&] { parsed(tube, overrides); });
}

TEST(Radius, IsHalfOfTheDiameter) {
  const Deck deck = parsed(parameter("Outer Diameter", "string", "5 in") + "\n" +
                           parameter("Inner Diameter", "double", "0.1"));
  const auto& list = deck.list().sublist("a");
  EXPECT_DOUBLE_EQ(list.get<double>("Outer Radius"), 0.0635);
  EXPECT_DOUBLE_EQ(list.get<double>("Inner Radius"), 0.05);
  EXPECT_FALSE(list.isParameter("Outer Diameter"));
  EXPECT_TRUE(deck.gives("a/Outer Radius"));
  EXPECT_EQ(deck.where("a/Inner Radius"),
            "deck.xml:4: /s/a/Inner Diameter");  // what the deck holds
  EXPECT_EQ(deck.given("a/Outer Radius", "m").text(0.0254), "2 in");
  EXPECT_EQ(deck.given("a/Outer Radius", "m").name, "Outer Diameter");
  EXPECT_EQ(deck.given("a/Inner Radius", "m").text(0.05), "0.1 m");
  EXPECT_DOUBLE_EQ(parsed(parameter("Outer Radius", "double", "0.1"), {"a/Inner Diameter=3 cm"})
                       .list()
                       .sublist("a")
                       .get<double>("Inner Radius"),
                   0.015);
}

TEST(Given, IsTheUnitOfTheDeckOrSi) {
  const auto given = [](const std::string& radius) {
    return parsed(parameter("Outer Radius", "string", radius)).given("a/Outer Radius", "m");
  };
  EXPECT_EQ(given("3 in").text(0.1539875), "6.0625 in");
  EXPECT_EQ(given("+3.5e1 mm").text(0.1), "100 mm");
  EXPECT_EQ(given("3 ft").text(168.65), "553.31 ft");  // computed: 553.3136483 ft
  EXPECT_EQ(given("3 ft").text(0.3048 * 10312.625), "10312.625 ft");
  EXPECT_EQ(given("3 ft").text(0.3048 / 3.0 * 370371.0), "123457 ft");
  EXPECT_EQ(given("3 m").text(100000.0 / 0.3), "333333 m");
  EXPECT_EQ(given("3 m").text(0.0), "0 m");
  EXPECT_EQ(given("3in").name, "Outer Radius");
  const Deck plain = parsed(parameter("Outer Radius", "double", "0.1"));
  EXPECT_EQ(plain.given("a/Outer Radius", "m").text(0.3048 / 3), "0.1016 m");
  EXPECT_EQ(plain.given("a/Inner Radius", "m").text(1), "1 m") << "not given";
  EXPECT_EQ(parsed(parameter("Outer Radius", "double", "0.1"), {"a/Outer Radius=1 ft"})
                .given("a/Outer Radius", "m")
                .text(0.6096),
            "2 ft");
}

TEST(Radius, AndDiameterExcludeEachOther) {
  EXPECT_EQ(fault(parameter("Outer Radius", "double", "0.1") + "\n" +
                  parameter("Outer Diameter", "double", "0.2")),
            "deck.xml:4: /s/a/Outer Diameter and Outer Radius are both given: give one of them.");
  EXPECT_EQ(fault(parameter("Outer Radius", "double", "0.1"), {"a/Outer Diameter=0.3"}),
            "--set a/Outer Diameter=0.3: /s/a/Outer Diameter and Outer Radius are both given: give "
            "one of them.");
}

TEST(Radius, NeitherIsAFaultWhereOneIsNeeded) {
  EXPECT_EQ(fault(""),
            "deck.xml:2: /s/a/Outer Radius is required but missing: write <Parameter name=\"Outer "
            "Radius\" type=\"double\" value=\"...\"/>, "
            "or give Outer Diameter. \"Outer Radius\": outer radius, m, > 0.");
}

TEST(Radius, OfADiameterOutOfRangeNamesTheDiameter) {
  EXPECT_EQ(
      fault(parameter("Outer Diameter", "double", "-1"))
          .find("deck.xml:3: /s/a/Outer Diameter: value=\"-1\" is out of range: it must be > 0."),
      0U);
}

TEST(Radius, StandsInTheTemplateAndTheDiameterBesideIt) {
  const std::string text = templateXml(tubes(), "t");
  EXPECT_NE(text.find("required; or give Outer Diameter -->"), std::string::npos) << text;
  EXPECT_EQ(text.find("name=\"Outer Diameter\""), std::string::npos) << text;
  EXPECT_NO_THROW(Deck::parse(uncommented(text), "t.xml", tubes()));
  EXPECT_NE(manualMarkdown(tubes()).find("| `Outer Diameter` | double | m |"), std::string::npos);
}

TEST(UnitBy, TakesTheUnitOfTheOtherParameter) {
  const std::string radius = parameter("Outer Radius", "double", "1");
  const auto value = [&](const std::string& component, const std::string& text) {
    return parsed(radius + parameter("Component", "string", component) +
                  parameter("Value", "string", text))
        .list()
        .sublist("a")
        .get<double>("Value");
  };
  EXPECT_EQ(value("u", "2 kN"), 2000.0);
  EXPECT_EQ(value("theta", "2 kN m"), 2000.0);
  EXPECT_DOUBLE_EQ(value("theta", "1 ft-lbf"), 1.3558179483314004);
  EXPECT_EQ(
      parsed(radius + parameter("Component", "string", "x") + parameter("Value", "double", "3"))
          .list()
          .sublist("a")
          .get<double>("Value"),
      3.0);
  EXPECT_EQ(parsed(radius + parameter("Component", "string", "u"), {"a/Value=1 klbf"})
                .list()
                .sublist("a")
                .get<double>("Value"),
            4448.2216152605);
}

TEST(UnitBy, RefusesTheUnitOfAnotherKind) {
  const std::string radius = parameter("Outer Radius", "double", "1") + "\n";
  const auto refusal = [&](const std::string& component, const std::string& text) {
    return fault(radius + parameter("Component", "string", component) + "\n" +
                 parameter("Value", "string", text));
  };
  EXPECT_EQ(refusal("u", "2 kN m")
                .find("deck.xml:5: /s/a/Value: value=\"2 kN m\" has the unit \"kN m\", which is "
                      "not a unit of the expected quantity (N)"),
            0U);
  EXPECT_EQ(refusal("theta", "2 kN")
                .find("deck.xml:5: /s/a/Value: value=\"2 kN\" has the unit \"kN\", which is not a "
                      "unit of the expected quantity (N m)"),
            0U);
  EXPECT_EQ(refusal("x", "2 kN"),
            "deck.xml:5: /s/a/Value: value=\"2 kN\" stands where a plain number is expected.");
}

}  // namespace AlternativesTest
