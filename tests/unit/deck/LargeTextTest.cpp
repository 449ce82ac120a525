// SPDX-License-Identifier: BSD-3-Clause
// Very large decks: reading time is nearly linear, and messages stay short.
#include <ctime>
#include <gtest/gtest.h>

#include "SmallScene.hpp"

namespace LargeTextTest {

using namespace tooljoint;
using namespace tooljoint::deck;
using namespace tooljoint::deck::test;

/// Time until `count` of these in a row are refused [s]; CPU time, so that a loaded machine has no
/// effect.
template <class Item>
double secondsFor(int count, const Item& item) {
  std::string contact;
  for (int i = 0; i < count; ++i) contact += item(i);
  const std::clock_t start = std::clock();
  EXPECT_NE(faultOf(deckWith(contact, endTime)), "");
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

TEST(LargeText, AnElementOfManyAttributesIsRefusedBeforeItIsParsed) {
  std::string attributes;
  for (int i = 0; i < 100000; ++i) attributes += " a" + std::to_string(i) + "=\"1\"";
  const std::clock_t start = std::clock();
  EXPECT_EQ(faultOf(deckWith("<!-- < a=\"1\" -->\n<Parameter" + attributes + "/>", endTime)),
            "deck.xml:4: an element has more than 100 attributes; a parameter has three: name, "
            "type and value.");
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 2.0);
}

TEST(LargeText, SignsThatAreNoAttributesDoNotCount) {
  const std::string many(500, '=');
  EXPECT_EQ(faultOf(deckWith(stiffness + "<!-- " + many + " <a " + many + " -->", endTime)), "");
  EXPECT_EQ(faultOf(deckWith(stiffness, endTime + parameter("Note", "string", many))), "");
}

// Ten times as many parameters may take twenty times as long, not a hundred times.
TEST(LargeText, ReadingIsNearLinearInTheNumberOfParameters) {
  const auto distinct = [](int i) {
    return parameter("p" + std::to_string(i), "double", "1") + "\n";
  };
  const auto twice = [](int) { return parameter("Friction", "double", "0.1") + "\n"; };
  for (const bool same : {false, true}) {
    const auto seconds = [&](int count) {
      return same ? secondsFor(count, twice) : secondsFor(count, distinct);
    };
    const double few = seconds(5000), many = seconds(50000);
    EXPECT_LT(many, 20.0 * few + 0.5) << few;
    EXPECT_LT(many, 10.0);
  }
}

TEST(LargeText, MessagesQuoteLittleOfALongValue) {
  const std::string huge(1000000, 'x');
  for (const std::string& contact :
       {parameter("Stiffness", "double", huge), parameter("Stiffness", "string", huge),
        parameter("Stiffness", "string", "5 " + huge),
        parameter("Stiffness", "string", "5 m" + std::string(1000000, '9')),
        parameter("Stiffness", huge, "1"), parameter("Law", "string", huge),
        parameter(huge, "double", "1"), parameter("Smooth", "Array(double)", "{" + huge + "}"),
        parameter("Stiffness", "Array(string)", "{" + huge + "}"),
        "<Parameter name=\"Stiffness\" type=\"double\" value=\"1\" " + huge + "=\"1\"/>", huge}) {
    const std::string message = faultOf(deckWith(contact, endTime));
    EXPECT_NE(message, "") << contact.substr(0, 60);
    EXPECT_LT(message.size(), 2500U) << contact.substr(0, 60);
  }
  EXPECT_LT(faultOf(deckWith(stiffness, endTime), {"Contact/Stiffness=" + huge}).size(), 1000U);
  EXPECT_LT(faultOf(deckWith(stiffness, endTime), {"Contact/" + huge + "=1"}).size(), 1500U);
  EXPECT_LT(
      faultOf(deckWith(stiffness, endTime + parameter("Fields", "Array(string)", "{" + huge + "}")))
          .size(),
      1000U);
}

}  // namespace LargeTextTest
