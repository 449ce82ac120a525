// SPDX-License-Identifier: BSD-3-Clause
// `--set PATH=VALUE`.
#include <Teuchos_Array.hpp>
#include <gtest/gtest.h>

#include "SmallScene.hpp"

namespace OverridesTest {

using namespace tooljoint;
using namespace tooljoint::deck;
using namespace tooljoint::deck::test;

const std::string base = deckWith(
    stiffness, endTime + parameter("Samples", "int", "5") + "<ParameterList name=\"NOX\">" +
                   parameter("Tolerance", "double", "1") + "</ParameterList>");

Teuchos::ParameterList listWith(const std::vector<std::string>& overrides) {
  return parseSmall(base, overrides).list();
}

struct Path {
  std::string text;
  friend std::ostream& operator<<(std::ostream& out, const Path& t) { return out << t.text; }
};
class OverridePath : public ::testing::TestWithParam<Path> {};

TEST_P(OverridePath, ReachesTheParameter) {
  EXPECT_EQ(listWith({GetParam().text}).sublist("Transient").get<double>("End Time"), 7.5);
}

INSTANTIATE_TEST_SUITE_P(
    Table, OverridePath,
    ::testing::Values(Path{"Transient/End Time=7.5"}, Path{"/Transient/End Time=7.5"},
                      Path{"well/Transient/End Time=7.5"}, Path{"/well/Transient/End Time=7.5"},
                      Path{"scene/Transient/End Time=7.5"}, Path{"Transient/End Time=7500 ms"},
                      Path{" Transient/End Time=7.5"}, Path{"Transient/End Time= 7.5 "},
                      Path{"Transient/End Time=+7.5"}));

TEST(Override, TakesItsTypeFromTheDescription) {
  const auto list = listWith({"Contact/Stiffness=2", "Contact/Smooth=false", "Contact/Law=Hertz",
                              "Transient/Samples=7", "Transient/Nodes={1, 2}",
                              "Transient/Fields={w}", "Transient/Weights={1}",
                              "Transient/Forces={1 kN, 2 N}", "Transient/Note=5", "Title=a = b"});
  EXPECT_EQ(list.sublist("Contact").get<double>("Stiffness"), 2.0);
  EXPECT_FALSE(list.sublist("Contact").get<bool>("Smooth"));
  EXPECT_EQ(list.sublist("Contact").get<std::string>("Law"), "Hertz");
  EXPECT_EQ(list.sublist("Transient").get<int>("Samples"), 7);
  EXPECT_EQ(list.sublist("Transient").get<Teuchos::Array<int>>("Nodes").toVector(),
            (std::vector<int>{1, 2}));
  EXPECT_EQ(list.sublist("Transient").get<Teuchos::Array<std::string>>("Fields").toVector(),
            (std::vector<std::string>{"w"}));
  EXPECT_EQ(list.sublist("Transient").get<Teuchos::Array<double>>("Weights").toVector(),
            (std::vector<double>{1.0}));
  EXPECT_EQ(list.sublist("Transient").get<Teuchos::Array<double>>("Forces").toVector(),
            (std::vector<double>{1000.0, 2.0}));
  EXPECT_EQ(list.sublist("Transient").get<std::string>("Note"), "5");
  EXPECT_EQ(list.get<std::string>("Title"), "a = b");
}

TEST(Override, CreatesADeclaredListWithItsDefaults) {
  const auto list = listWith({"Mud/Density=10 ppg"});
  EXPECT_NEAR(list.sublist("Mud").get<double>("Density"), 1198.2642731689663, 1e-9);
  EXPECT_EQ(list.sublist("Mud").name(), "/well/Mud");
}

TEST(Override, OfSeveralForOneParameterTheLastWins) {
  EXPECT_EQ(listWith({"Transient/Samples=3", "Transient/Samples=4"})
                .sublist("Transient")
                .get<int>("Samples"),
            4);
}

TEST(Override, MayReplaceAValueThatWouldBeRefused) {
  const Deck deck = parseSmall(deckWith(parameter("Stiffness", "double", "-1"), endTime),
                               {"Contact/Stiffness=1"});
  EXPECT_EQ(deck.list().sublist("Contact").get<double>("Stiffness"), 1.0);
}

TEST(Override, MaySupplyWhatIsRequired) {
  EXPECT_EQ(faultOf("<ParameterList name=\"x\"/>", {"Transient/End Time=1"}), "");
}

TEST(Override, EntersListsWithNamesOfOnesOwnThatAreThere) {
  const std::string interval =
      "<ParameterList name=\"Intervals\"><ParameterList name=\"upper part\">" +
      parameter("Depths", "Array(double)", "{0, 9}") + "</ParameterList></ParameterList>";
  const std::string text = deckWith(stiffness + interval, endTime);
  const Deck deck = parseSmall(text, {"Contact/Intervals/upper part/Friction=0.5"});
  EXPECT_EQ(deck.list()
                .sublist("Contact")
                .sublist("Intervals")
                .sublist("upper part")
                .get<double>("Friction"),
            0.5);
  EXPECT_EQ(faultOf(text, {"Contact/Intervals/uper part/Friction=0.5"}),
            "--set Contact/Intervals/uper part/Friction=0.5: /well/Contact/Intervals/uper part is "
            "not a list. The deck has "
            "\"upper part\" there. Did you mean \"upper part\"?");
}

/// A list with parameters of variants: of the chosen one, and of another.
ListSpec motor() {
  ListSpec spec("motor", "A motor.");
  spec.choice("Law", "Constant", {"Constant", "Ramp"}, "The form of the speed.")
      .list(ListSpec("Constant", "One speed.").real("Speed", "rad/s", 1.0, Range::any(), "It."))
      .list(ListSpec("Ramp", "A ramp.").real("Rate", "rad/s2", 1.0, Range::any(), "Its rate."));
  ListSpec scene("scene", "A scene.");
  scene.list(spec);
  return scene;
}

TEST(Override, OfAVariantThatIsNotChosenIsRefused) {
  const std::string text =
      "<ParameterList name=\"x\"><ParameterList name=\"motor\"><ParameterList name=\"Ramp\">" +
      parameter("Rate", "double", "2") + "</ParameterList></ParameterList></ParameterList>";
  const auto fault = [&](const std::vector<std::string>& overrides) -> std::string {
    try {
      Deck::parse(text, "deck.xml", motor(), overrides);
    } catch (const DeckError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(fault({}), "") << "a deck may hold what it does not choose";
  EXPECT_EQ(fault({"motor/Constant/Speed=3"}), "");
  EXPECT_EQ(fault({"motor/Ramp/Rate=3"}),
            "--set motor/Ramp/Rate=3: /x/motor/Ramp has no effect, since Law is \"Constant\". Set "
            "motor/Law=Ramp too, or a parameter of motor/Constant.");
  EXPECT_EQ(fault({"motor/Ramp/Rate=3", "motor/Law=Ramp"}), "");
  EXPECT_EQ(fault({"motor/Law=Ramp", "motor/Ramp/Rate=3", "motor/Law=Constant"}), "")
      << "superseded";
}

TEST(Override, KeepsTheTypeInPassThroughListsOrGuessesIt) {
  const auto nox =
      listWith({"Transient/NOX/Tolerance=2", "Transient/NOX/Max Iterations=5",
                "Transient/NOX/Relaxed=true", "Transient/NOX/Step=0.5",
                "Transient/NOX/Line Search/Method=Full Step", "Transient/NOX/Weights={1, 0.5}"})
          .sublist("Transient")
          .sublist("NOX");
  EXPECT_EQ(nox.get<double>("Tolerance"), 2.0);
  EXPECT_EQ(nox.get<int>("Max Iterations"), 5);
  EXPECT_TRUE(nox.get<bool>("Relaxed"));
  EXPECT_EQ(nox.get<double>("Step"), 0.5);
  EXPECT_EQ(nox.sublist("Line Search").get<std::string>("Method"), "Full Step");
  EXPECT_EQ(nox.get<Teuchos::Array<double>>("Weights").size(), 2);
}

struct BadSet {
  std::string set, message;
  friend std::ostream& operator<<(std::ostream& out, const BadSet& t) { return out << t.set; }
};
class BadOverride : public ::testing::TestWithParam<BadSet> {};

TEST_P(BadOverride, SpeaksOfTheCommandLine) {
  const std::string fault = faultOf(base, {GetParam().set});
  const bool usage = GetParam().message.compare(0, 10, "UsageError") == 0;
  EXPECT_EQ(fault, (usage ? "" : "--set " + GetParam().set + ": ") + GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Table, BadOverride,
    ::testing::Values(
        BadSet{"Transient/Stepp=1",
               "/well/Transient/Stepp is not a parameter. Did you mean \"Step\"? It is the time "
               "step, s, in (0, 1]."},
        BadSet{"Transent/Step=1",
               "/well/Transent is not a list. Did you mean \"Transient\"? It is the time "
               "integration."},
        BadSet{"Transient=1",
               "/well/Transient is not a parameter. It is a list: write <ParameterList "
               "name=\"Transient\">."},
        BadSet{
            "Step=1",
            "/well/Step is not a parameter. A parameter of that name stands in /well/Transient."},
        BadSet{"Transient/Step/Size=1",
               "/well/Transient/Step is not a list. It is a parameter: write <Parameter "
               "name=\"Step\" type=\"double\" "
               "value=\"...\"/>."},
        BadSet{"Transient/Step=2",
               "/well/Transient/Step: value=\"2\" is out of range: it must be in (0, 1]. It is the "
               "time step, s, in (0, 1]."},
        BadSet{"Transient/Step=abc",
               "/well/Transient/Step: value=\"abc\" does not begin with a number; expected is a "
               "number and a unit such as \"s\", "
               "\"ms\", \"us\", \"min\", \"h\"."},
        BadSet{"Transient/Step=",
               "/well/Transient/Step: value=\"\" is empty; a number is expected."},
        BadSet{"Transient/Step=1,5",
               "/well/Transient/Step: value=\"1,5\" has a decimal comma; write a decimal point."},
        BadSet{"Transient/Step=1 mm",
               "/well/Transient/Step: value=\"1 mm\" has the unit \"mm\", which is not a unit of "
               "the expected quantity (s); expected is a number and a unit such as \"s\", \"ms\", "
               "\"us\", \"min\", \"h\"."},
        BadSet{
            "Contact/Friction=0.5 m",
            "/well/Contact/Friction: value=\"0.5 m\" is not a number: this parameter has no unit."},
        BadSet{"Transient/Samples=2.5",
               "/well/Transient/Samples: value=\"2.5\" is not a whole number."},
        BadSet{"Contact/Smooth=yes",
               "/well/Contact/Smooth: value=\"yes\" is not a bool: write \"true\"."},
        BadSet{"Contact/Law=hertz",
               "/well/Contact/Law: value=\"hertz\" is not one of \"Linear\", \"Hertz\", "
               "\"Winkler\". Did you mean \"Hertz\"?"},
        BadSet{"Transient/Nodes=1, 2",
               "/well/Transient/Nodes: value=\"1, 2\" is not an array: write the entries in "
               "braces, \"{1, 2}\"."},
        BadSet{"Transient//Step=1", "the path has an empty name."},
        BadSet{"Transient/=1", "the path has an empty name."},
        BadSet{"Transient/Step",
               "UsageError: --set Transient/Step: write --set PATH=VALUE, for example --set "
               "\"Transient/End Time=20\"."},
        BadSet{"=1",
               "UsageError: --set =1: write --set PATH=VALUE, for example --set \"Transient/End "
               "Time=20\"."},
        BadSet{"",
               "UsageError: --set : write --set PATH=VALUE, for example --set \"Transient/End "
               "Time=20\"."}));

TEST(Override, FaultsOfDeckAndCommandLineComeTogetherTheDeckFirst) {
  EXPECT_EQ(faultOf(deckWith(stiffness + parameter("Friktion", "double", "1"), endTime),
                    {"Transient/Samples=0", "Transient/Stepp=1"}),
            "deck.xml:3: /well/Contact/Friktion is not a parameter. Did you mean \"Friction\"? It "
            "is the friction coefficient, in [0, "
            "1].\n"
            "--set Transient/Samples=0: /well/Transient/Samples: value=\"0\" is out of range: it "
            "must be >= 1. It is the number of "
            "samples, >= 1.\n"
            "--set Transient/Stepp=1: /well/Transient/Stepp is not a parameter. Did you mean "
            "\"Step\"? It is the time step, s, in (0, "
            "1].");
}

TEST(Override, IsWhereTheValueCameFrom) {
  const Deck deck = parseSmall(base, {"Mud/Density=900", "Transient/Samples=9"});
  EXPECT_EQ(deck.where("Transient/Samples"), "--set Transient/Samples=9: /well/Transient/Samples");
  EXPECT_EQ(deck.where("Mud"), "--set Mud/Density=900: /well/Mud");
  EXPECT_EQ(deck.where("Transient/End Time"), "deck.xml:6: /well/Transient/End Time");
  EXPECT_EQ(deck.overrides(), (std::vector<std::string>{"Mud/Density=900", "Transient/Samples=9"}));
}

/// If a list has the name of the scene, the path refers to the list, not to the scene.
TEST(Override, ADeclaredListWithTheScenesNameIsThatList) {
  const ListSpec spec = ListSpec("s", "S.")
                            .integer("A", 1, Range::any(), "A.")
                            .list(ListSpec("same", "S.").integer("A", 1, Range::any(), "A."));
  const Deck deck = Deck::parse("<ParameterList name=\"same\"/>", "x.xml", spec, {"same/A=5"});
  EXPECT_EQ(deck.list().get<int>("A"), 1);
  EXPECT_EQ(deck.list().sublist("same").get<int>("A"), 5);
}

}  // namespace OverridesTest
