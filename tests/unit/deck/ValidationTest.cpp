// SPDX-License-Identifier: BSD-3-Clause
// Phase 2: names, types, units, ranges, choices, required parameters, defaults.
#include <Teuchos_Array.hpp>
#include <cmath>
#include <gtest/gtest.h>

#include "SmallScene.hpp"
#include "common/Constants.hpp"

namespace ValidationTest {

using namespace tooljoint;
using namespace tooljoint::deck;
using namespace tooljoint::deck::test;
TEST(Validation, AGoodDeckHoldsItsValuesInSi) {
  const Deck deck = parseSmall(deckWith(
      parameter("Stiffness", "string", "2 MN/m") + parameter("Law", "string", "Hertz") +
          parameter("Smooth", "bool", "false"),
      parameter("End Time", "string", "0.5 min") + parameter("Speed", "string", "120 rpm") +
          parameter("Angle", "string", "90 deg") + parameter("Nodes", "Array(int)", "{1, 5}") +
          parameter("Fields", "Array(string)", "{w}") +
          parameter("Forces", "Array(string)", "{1 kN, 10 lbf}") +
          parameter("Weights", "Array(double)", "{0.5, 2}")));
  const auto& contact = deck.list().sublist("Contact");
  EXPECT_EQ(contact.get<double>("Stiffness"), 2e6);
  EXPECT_EQ(contact.get<std::string>("Law"), "Hertz");
  EXPECT_FALSE(contact.get<bool>("Smooth"));
  const auto& transient = deck.list().sublist("Transient");
  EXPECT_EQ(transient.get<double>("End Time"), 30.0);
  EXPECT_NEAR(transient.get<double>("Speed"), 4.0 * constants::pi, 1e-14);
  EXPECT_NEAR(transient.get<double>("Angle"), 0.5 * constants::pi, 1e-15);
  EXPECT_EQ(transient.get<Teuchos::Array<int>>("Nodes").toVector(), (std::vector<int>{1, 5}));
  EXPECT_EQ(transient.get<Teuchos::Array<std::string>>("Fields").toVector(),
            (std::vector<std::string>{"w"}));
  EXPECT_NEAR(transient.get<Teuchos::Array<double>>("Forces")[1], 44.482216152605, 1e-13);
  EXPECT_EQ(transient.get<Teuchos::Array<double>>("Weights").toVector(),
            (std::vector<double>{0.5, 2.0}));
}

TEST(Validation, DefaultsAreFilledInListsThatArePresent) {
  const Deck deck = parseSmall(deckWith(stiffness, endTime));
  EXPECT_EQ(deck.list().get<std::string>("Title"), "none");
  EXPECT_EQ(deck.list().sublist("Contact").get<double>("Friction"), 0.2);
  EXPECT_TRUE(deck.list().sublist("Contact").get<bool>("Smooth"));
  EXPECT_EQ(deck.list().sublist("Transient").get<int>("Samples"), 100);
  EXPECT_EQ(deck.list().sublist("Transient").get<Teuchos::Array<double>>("Weights").toVector(),
            (std::vector<double>{1.0}));
}

TEST(Validation, OptionalParametersAndListsStayAbsent) {
  const Deck deck = parseSmall(deckWith(stiffness, endTime));
  EXPECT_FALSE(deck.list().sublist("Transient").isParameter("Angle"));
  EXPECT_FALSE(deck.list().sublist("Transient").isParameter("Nodes"));
  EXPECT_FALSE(deck.list().isSublist("Mud"));
  EXPECT_FALSE(deck.list().sublist("Contact").isSublist("Intervals"));
}

TEST(Validation, AnEmptyOptionalListGetsItsDefaults) {
  const Deck deck = parseSmall(
      "<ParameterList name=\"x\"><ParameterList name=\"Mud\"/><ParameterList name=\"Transient\">" +
      endTime + "</ParameterList></ParameterList>");
  EXPECT_EQ(deck.list().sublist("Mud").get<double>("Density"), 1000.0);
}

TEST(Validation, ListsKnowTheirPath) {
  const Deck deck = parseSmall(deckWith(stiffness, endTime));
  EXPECT_EQ(deck.list().name(), "/well");
  EXPECT_EQ(deck.list().sublist("Transient").name(), "/well/Transient");
  EXPECT_EQ(deck.name(), "well");
}

TEST(Validation, PassThroughListsArriveAsTheyAre) {
  const Deck deck = parseSmall(deckWith(stiffness, endTime + "<ParameterList name=\"NOX\">" +
                                                       parameter("Max Iterations", "int", "7") +
                                                       "<ParameterList name=\"Direction\">" +
                                                       parameter("Method", "string", "Newton") +
                                                       "</ParameterList></ParameterList>"));
  const auto& nox = deck.list().sublist("Transient").sublist("NOX");
  EXPECT_EQ(nox.get<int>("Max Iterations"), 7);
  EXPECT_EQ(nox.sublist("Direction").get<std::string>("Method"), "Newton");
  EXPECT_EQ(nox.numParams(), 2);
}

TEST(Validation, ListsWithNamesOfOnesOwn) {
  const std::string intervals =
      "<ParameterList name=\"Intervals\"><ParameterList name=\"upper part\">" +
      parameter("Depths", "Array(string)", "{0 m, 300 ft}") +
      "</ParameterList><ParameterList name=\"lower\">" +
      parameter("Depths", "Array(double)", "{100, 170}") + parameter("Friction", "double", "0.4") +
      "</ParameterList></ParameterList>";
  const Deck deck = parseSmall(deckWith(stiffness + intervals, endTime));
  const auto& list = deck.list().sublist("Contact").sublist("Intervals");
  EXPECT_DOUBLE_EQ(list.sublist("upper part").get<Teuchos::Array<double>>("Depths")[1], 91.44);
  EXPECT_FALSE(list.sublist("upper part").isParameter("Friction"));
  EXPECT_EQ(list.sublist("lower").get<double>("Friction"), 0.4);
}

TEST(Validation, AListMayHaveDeclaredSublistsAndOnesOwn) {
  ListSpec library =
      ListSpec("library", "L.")
          .list(ListSpec("Materials", "M.")
                    .real("Density", "kg/m3", 7850.0, Range::positive(), "The density."));
  library.namedLists(ListSpec("component", "C.")
                         .real("Length", "m", Required{}, Range::positive(), "The length."));
  const std::string text =
      "<ParameterList name=\"lib\">\n<ParameterList name=\"Materials\"/>\n<ParameterList "
      "name=\"pipe\">" +
      parameter("Length", "double", "9") + "</ParameterList>\n<ParameterList name=\"collar\">" +
      parameter("Lenght", "double", "9") + "</ParameterList></ParameterList>";
  EXPECT_EQ(messageOf([&] { Deck::parse(text, "lib.xml", library); }),
            "lib.xml:4: /lib/collar/Lenght is not a parameter. Did you mean \"Length\"? It is the "
            "length, m, > 0.\n"
            "lib.xml:4: /lib/collar/Length is required but missing: write <Parameter "
            "name=\"Length\" type=\"double\" "
            "value=\"...\"/>. It is the length, m, > 0.");
}

TEST(Validation, AFormerNameIsRefusedWithTheNewOne) {
  const ListSpec steps = ListSpec("steps", "S.")
                             .integer("Max Halvings", 10, Range::atLeast(0), "The halvings.")
                             .formerly("Halvings");
  EXPECT_EQ(messageOf([&] {
              Deck::parse("<ParameterList name=\"run\">\n" + parameter("Halvings", "int", "3") +
                              "</ParameterList>",
                          "run.xml", steps);
            }),
            "run.xml:2: /run/Halvings is now called \"Max Halvings\". It is the halvings, >= 0.");
}

TEST(Validation, ARemovedNameIsRefusedWithWhatHoldsInstead) {
  ListSpec run("run", "R.");
  ListSpec variant("variant", "V.");
  variant.removed({"Halvings", "Sweeps"}, "a step is halved ten times. Leave it out.");
  run.merge(variant);
  EXPECT_EQ(messageOf([&] {
              Deck::parse("<ParameterList name=\"run\">\n" + parameter("Sweeps", "int", "3") +
                              "</ParameterList>",
                          "run.xml", run);
            }),
            "run.xml:2: /run/Sweeps was removed: a step is halved ten times. Leave it out.");
}

TEST(Validation, AFormerNameOfAnotherListIsRefusedWithTheNewPath) {
  ListSpec run("run", "R.");
  run.list(ListSpec("Steps", "S.")
               .integer("Max Halvings", 10, Range::atLeast(0), "The halvings.")
               .formerly("../Halvings"));
  EXPECT_EQ(
      messageOf([&] {
        Deck::parse("<ParameterList name=\"run\">\n" + parameter("Halvings", "int", "3") +
                        "</ParameterList>",
                    "run.xml", run);
      }),
      "run.xml:2: /run/Halvings is now called \"Steps/Max Halvings\". It is the halvings, >= 0.");
}

struct Row {
  std::string contact, transient, message;
  friend std::ostream& operator<<(std::ostream& out, const Row& t) {
    return out << t.contact << t.transient;
  }
};
class SecondPhase : public ::testing::TestWithParam<Row> {};

TEST_P(SecondPhase, FaultIsReportedWithLinePathAndHelp) {
  const Row& row = GetParam();
  const std::string fault = faultOf(deckWith(row.contact.empty() ? stiffness : row.contact,
                                             row.transient.empty() ? endTime : row.transient));
  EXPECT_EQ(fault.substr(0, row.message.size()), row.message) << fault;
}

const std::string s = stiffness + "\n";  // the fault then stands in line 4
const std::string e = endTime + "\n";    // the fault then stands in line 7

INSTANTIATE_TEST_SUITE_P(
    Names, SecondPhase,
    ::testing::Values(
        Row{parameter("Stiffnes", "double", "1") + "\n" + stiffness, "",
            "deck.xml:3: /well/Contact/Stiffnes is not a parameter. Did you mean \"Stiffness\"? It "
            "is the nominal contact "
            "stiffness, N/m, > 0."},
        Row{s + parameter("friction", "double", "0.1"), "",
            "deck.xml:4: /well/Contact/friction is not a parameter. Did you mean \"Friction\"? It "
            "is the friction coefficient, "
            "in [0, 1]."},
        Row{s + parameter("Viscosity", "double", "1"), "",
            "deck.xml:4: /well/Contact/Viscosity is not a parameter. Available: the parameters "
            "\"Stiffness\", \"Friction\", "
            "\"Law\", \"Smooth\" and the lists "
            "\"Intervals\"."},
        Row{s + parameter("Density", "double", "1"), "",
            "deck.xml:4: /well/Contact/Density is not a parameter. A parameter of that name stands "
            "in /well/Mud."},
        Row{s + parameter("Intervals", "double", "1"), "",
            "deck.xml:4: /well/Contact/Intervals is not a parameter. It is a list: write "
            "<ParameterList name=\"Intervals\">."},
        Row{s + parameter("Interval", "double", "1"), "",
            "deck.xml:4: /well/Contact/Interval is not a parameter. Did you mean the list "
            "\"Intervals\"? It is the depth "
            "intervals with laws of their own."},
        Row{s + "<ParameterList name=\"Intervalls\"/>", "",
            "deck.xml:4: /well/Contact/Intervalls is not a list. Did you mean \"Intervals\"? It is "
            "the depth intervals with laws "
            "of their own."},
        Row{s + "<ParameterList name=\"Friction\"/>", "",
            "deck.xml:4: /well/Contact/Friction is not a list. It is a parameter: write <Parameter "
            "name=\"Friction\" "
            "type=\"double\" value=\"...\"/>."},
        Row{s + "<ParameterList name=\"Frictio\"/>", "",
            "deck.xml:4: /well/Contact/Frictio is not a list. Did you mean the parameter "
            "\"Friction\"? It is the friction "
            "coefficient, in [0, 1]."},
        Row{s + "<ParameterList name=\"Mud\"/>", "",
            "deck.xml:4: /well/Contact/Mud is not a list. A list of that name stands in /well."},
        Row{s + "<ParameterList name=\"NOX\"/>", "",
            "deck.xml:4: /well/Contact/NOX is not a list. A list of that name stands in "
            "/well/Transient."},
        Row{parameter("Friction", "double", "0.1"), "",
            "deck.xml:2: /well/Contact/Stiffness is required but missing: write <Parameter "
            "name=\"Stiffness\" type=\"double\" "
            "value=\"...\"/>. It is the nominal contact "
            "stiffness, N/m, > 0."}));

INSTANTIATE_TEST_SUITE_P(
    Types, SecondPhase,
    ::testing::Values(
        Row{parameter("Stiffness", "int", "1"), "",
            "deck.xml:3: /well/Contact/Stiffness must be type=\"double\", not type=\"int\": write "
            "type=\"double\" value=\"1\". "
            "It is the nominal contact stiffness, N/m, > 0."},
        Row{parameter("Stiffness", "bool", "true"), "",
            "deck.xml:3: /well/Contact/Stiffness must be type=\"double\", not type=\"bool\". It is "
            "the nominal contact "
            "stiffness, N/m, > 0."},
        Row{parameter("Stiffness", "string", "5"), "",
            "deck.xml:3: /well/Contact/Stiffness: value=\"5\" has no unit; expected is a number "
            "and a unit such as \"N/m\", "
            "\"kN/m\", \"MN/m\"."},
        Row{parameter("Stiffness", "string", "stiff"), "",
            "deck.xml:3: /well/Contact/Stiffness: value=\"stiff\" does not begin with a number; "
            "expected is a number and a unit "
            "such as \"N/m\", \"kN/m\", \"MN/m\"."},
        Row{parameter("Stiffness", "string", "5 kN"), "",
            "deck.xml:3: /well/Contact/Stiffness: value=\"5 kN\" has the unit \"kN\", which is not "
            "a unit of the expected quantity (N/m); expected is a number and a unit such as "
            "\"N/m\", \"kN/m\", \"MN/m\"."},
        Row{s + parameter("Friction", "string", "0.3"), "",
            "deck.xml:4: /well/Contact/Friction must be type=\"double\", not type=\"string\": "
            "write type=\"double\" "
            "value=\"0.3\". It is the friction coefficient, in [0, 1]."},
        Row{s + parameter("Law", "int", "1"), "",
            "deck.xml:4: /well/Contact/Law must be type=\"string\", not type=\"int\": write "
            "type=\"string\" value=\"1\". It is "
            "the contact law, one of \"Linear\", \"Hertz\", "
            "\"Winkler\"."},
        Row{s + parameter("Smooth", "string", "true"), "",
            "deck.xml:4: /well/Contact/Smooth must be type=\"bool\", not type=\"string\": write "
            "type=\"bool\" value=\"true\". "
            "\"Smooth\": whether the law is rounded"},
        Row{s + parameter("Smooth", "int", "1"), "",
            "deck.xml:4: /well/Contact/Smooth must be type=\"bool\", not type=\"int\". \"Smooth\": "
            "whether the law is rounded"},
        Row{"", e + parameter("Samples", "double", "5"),
            "deck.xml:7: /well/Transient/Samples must be type=\"int\", not type=\"double\": write "
            "type=\"int\" value=\"5\". It "
            "is the number of samples, >= 1."},
        Row{"", e + parameter("Samples", "double", "5.0"),
            "deck.xml:7: /well/Transient/Samples must be type=\"int\", not type=\"double\": write "
            "type=\"int\" value=\"5\". It "
            "is the number of samples, >= 1."},
        Row{"", e + parameter("Samples", "double", "2.5"),
            "deck.xml:7: /well/Transient/Samples must be type=\"int\", not type=\"double\". It is "
            "the number of samples, >= 1."},
        Row{"", e + parameter("Nodes", "int", "5"),
            "deck.xml:7: /well/Transient/Nodes must be type=\"Array(int)\", not type=\"int\": "
            "write type=\"Array(int)\" "
            "value=\"{5}\". It is the recorded nodes, from 1, >= 1."},
        Row{"", e + parameter("Weights", "Array(int)", "{1, 2}"),
            "deck.xml:7: /well/Transient/Weights must be type=\"Array(double)\", not "
            "type=\"Array(int)\": write "
            "type=\"Array(double)\" value=\"{1, 2}\". It is the weights, >= 0."},
        Row{"", e + parameter("Weights", "Array(string)", "{1 m}"),
            "deck.xml:7: /well/Transient/Weights must be type=\"Array(double)\", not "
            "type=\"Array(string)\". It is the weights, "
            ">= 0."},
        Row{"", e + parameter("Fields", "string", "u, v"),
            "deck.xml:7: /well/Transient/Fields must be type=\"Array(string)\", not "
            "type=\"string\": write "
            "type=\"Array(string)\" value=\"{u, v}\". It is the recorded fields, one of "
            "\"u\", \"v\", \"w\"."},
        Row{"", e + parameter("Forces", "Array(string)", "{1 kN, 5}"),
            "deck.xml:7: /well/Transient/Forces: the entry \"5\" (number 2) has no unit; expected "
            "is a number and a unit such as "
            "\"N\", \"daN\", \"kN\", \"MN\", \"lbf\", \"klbf\", \"tf\", \"t\", \"lb\", "
            "\"klb\", \"kdaN\"."},
        Row{"", e + parameter("Note", "double", "5"),
            "deck.xml:7: /well/Transient/Note must be type=\"string\", not type=\"double\": write "
            "type=\"string\" value=\"5\". "
            "It is a remark."},
        Row{"", e + parameter("Speed", "string", "2 Hz"),
            "deck.xml:7: /well/Transient/Speed: value=\"2 Hz\" has the unit \"Hz\", which is not a "
            "unit of the expected quantity (rad/s); expected is a number and a unit such as "
            "\"rpm\", \"rad/s\", \"deg/s\"."}));

INSTANTIATE_TEST_SUITE_P(
    RangesAndChoices, SecondPhase,
    ::testing::Values(Row{parameter("Stiffness", "double", "0"), "",
                          "deck.xml:3: /well/Contact/Stiffness: value=\"0\" is out of range: it "
                          "must be > 0. It is the nominal contact "
                          "stiffness, N/m, > 0."},
                      Row{parameter("Stiffness", "string", "-5 kN/m"), "",
                          "deck.xml:3: /well/Contact/Stiffness: value=\"-5 kN/m\" (-5000 N/m) is "
                          "out of range: it must be > 0. It is the "
                          "nominal contact stiffness, N/m, > 0."},
                      Row{s + parameter("Friction", "double", "1.5"), "",
                          "deck.xml:4: /well/Contact/Friction: value=\"1.5\" is out of range: it "
                          "must be in [0, 1]. It is the friction "
                          "coefficient, in [0, 1]."},
                      Row{s + parameter("Law", "string", "hertz"), "",
                          "deck.xml:4: /well/Contact/Law: value=\"hertz\" is not one of "
                          "\"Linear\", \"Hertz\", \"Winkler\". Did you mean "
                          "\"Hertz\"?"},
                      Row{s + parameter("Law", "string", "Cubic"), "",
                          "deck.xml:4: /well/Contact/Law: value=\"Cubic\" is not one of "
                          "\"Linear\", \"Hertz\", \"Winkler\"."},
                      Row{s + parameter("Law", "string", ""), "",
                          "deck.xml:4: /well/Contact/Law: value=\"\" is not one of \"Linear\", "
                          "\"Hertz\", \"Winkler\"."},
                      Row{"", e + parameter("Samples", "int", "0"),
                          "deck.xml:7: /well/Transient/Samples: value=\"0\" is out of range: it "
                          "must be >= 1. It is the number of samples, >= "
                          "1."},
                      Row{"", e + parameter("Step", "double", "0"),
                          "deck.xml:7: /well/Transient/Step: value=\"0\" is out of range: it must "
                          "be in (0, 1]. It is the time step, s, in (0, "
                          "1]."},
                      Row{"", e + parameter("Nodes", "Array(int)", "{3, 0}"),
                          "deck.xml:7: /well/Transient/Nodes: entry number 2, 0, is out of range: "
                          "it must be >= 1. It is the recorded nodes, "
                          "from 1, >= 1."},
                      Row{"", e + parameter("Weights", "Array(double)", "{-1}"),
                          "deck.xml:7: /well/Transient/Weights: entry number 1, -1, is out of "
                          "range: it must be >= 0. It is the weights, >= "
                          "0."},
                      Row{"", e + parameter("Fields", "Array(string)", "{u, W}"),
                          "deck.xml:7: /well/Transient/Fields: the entry \"W\" is not one of "
                          "\"u\", \"v\", \"w\". Did you mean \"w\"?"}));

TEST(SecondPhase, ARequiredListThatIsMissing) {
  EXPECT_EQ(faultOf("<ParameterList name=\"x\">\n</ParameterList>"),
            "deck.xml:1: /x/Transient is required but missing: write <ParameterList "
            "name=\"Transient\">...</ParameterList>. It "
            "is the time integration.");
}

TEST(SecondPhase, AnUnknownListSaysNothingAboutWhatIsInside) {
  EXPECT_EQ(faultOf("<ParameterList name=\"x\">\n<ParameterList name=\"Transent\">\n" +
                    parameter("End Time", "int", "1") + "</ParameterList>\n</ParameterList>"),
            "deck.xml:1: /x/Transient is required but missing: write <ParameterList "
            "name=\"Transient\">...</ParameterList>. It "
            "is the time integration.\n"
            "deck.xml:2: /x/Transent is not a list. Did you mean \"Transient\"? It is the time "
            "integration.");
}

TEST(SecondPhase, AllFaultsComeTogetherSortedByLine) {
  const std::string fault = faultOf(
      deckWith(parameter("Law", "string", "Herz") + "\n" + parameter("Frction", "double", "1"),
               parameter("Step", "double", "2") + "\n" + parameter("Samples", "double", "1")));
  std::vector<std::string> starts;
  std::size_t at = 0;
  while (at != std::string::npos) {
    starts.push_back(fault.substr(at, fault.find(' ', at) - at));
    at = fault.find('\n', at);
    if (at != std::string::npos) ++at;
  }
  EXPECT_EQ(starts, (std::vector<std::string>{"deck.xml:2:", "deck.xml:3:", "deck.xml:4:",
                                              "deck.xml:6:", "deck.xml:7:", "deck.xml:8:"}))
      << fault;
}

TEST(SecondPhase, EndsWithExitCodeTwo) {
  try {
    parseSmall(deckWith("", endTime));
    ADD_FAILURE() << "a deck without a required parameter was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::InvalidDeck);
  }
}

}  // namespace ValidationTest
