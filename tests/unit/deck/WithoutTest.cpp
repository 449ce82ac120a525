// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// `--without LIST`: taking a list out of a deck from the command line.
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "deck/Deck.hpp"

namespace WithoutTest {

using namespace tooljoint;

deck::ListSpec scene() {
  deck::ListSpec mud("Mud", "Mud.");
  mud.real("Density", "kg/m3", 1000.0, deck::Range::positive(), "Density.")
      .list(deck::ListSpec("Flow", "Flow."));
  return deck::ListSpec("Scene", "A scene.").list(mud).list(deck::ListSpec("Loads", "Loads."));
}

const char* const text = R"(<ParameterList name="well">
  <ParameterList name="Mud"><ParameterList name="Flow"/></ParameterList>
  <ParameterList name="Loads"/>
</ParameterList>)";

deck::Deck without(const std::string& path) {
  return deck::Deck::parse(text, "deck.xml", scene(), {"!" + path});
}

TEST(Without, TakesAListOutAndLeavesTheOthers) {
  const auto deck = without("Mud");
  EXPECT_FALSE(deck.list().isSublist("Mud"));
  EXPECT_TRUE(deck.list().isSublist("Loads"));
}

TEST(Without, TakesANestedListOut) {
  const auto deck = without("/well/Mud/Flow");
  ASSERT_TRUE(deck.list().isSublist("Mud"));
  EXPECT_FALSE(deck.list().sublist("Mud").isSublist("Flow"));
}

TEST(Without, AListThatIsNotThereIsNoFault) {
  const auto deck =
      deck::Deck::parse("<ParameterList name=\"well\"/>", "deck.xml", scene(), {"!Mud", "!Loads"});
  EXPECT_FALSE(deck.list().isSublist("Mud"));
}

TEST(Without, APathThroughAnAbsentListTouchesNothingElse) {
  const auto deck = deck::Deck::parse(
      "<ParameterList name=\"well\"><ParameterList name=\"Loads\"/></ParameterList>", "deck.xml",
      scene(), {"!Mud/Loads"});
  EXPECT_TRUE(deck.list().isSublist("Loads"));
}

TEST(Without, AnUnknownListIsNamedWithASuggestion) {
  try {
    without("Mudd");
    FAIL() << "accepted";
  } catch (const DeckError& error) {
    const std::string sentence = error.what();
    EXPECT_NE(sentence.find("--without Mudd"), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("Did you mean \"Mud\""), std::string::npos) << sentence;
  }
}

TEST(Without, TakesAParameterOutSoThatItsDefaultReturns) {
  const char* const heavy = R"(<ParameterList name="well"><ParameterList name="Mud">
    <Parameter name="Density" type="double" value="1500"/></ParameterList></ParameterList>)";
  const auto deck = deck::Deck::parse(heavy, "deck.xml", scene(), {"!Mud/Density"});
  EXPECT_EQ(deck.list().sublist("Mud").get<double>("Density"), 1000.0);
  EXPECT_FALSE(deck.gives("Mud/Density"));
  EXPECT_NO_THROW(without("Mud/Density"));  // not given: no fault
}

TEST(Without, NeedsAPath) { EXPECT_THROW(without(""), UsageError); }

}  // namespace WithoutTest
