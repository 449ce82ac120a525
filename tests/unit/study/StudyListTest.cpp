// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The Study list: its meaning, refused lists, and its runs.
#include <gtest/gtest.h>
#include <string>

#include "common/Error.hpp"
#include "deck/Deck.hpp"
#include "study/Expansion.hpp"
#include "study/StudyParameters.hpp"
#include "study/reference/FittedReference.hpp"

namespace StudyListTest {

using namespace tooljoint;

study::StudySettings settingsOf(const std::string& body,
                                const std::vector<std::string>& overrides = {}) {
  deck::ListSpec scene("Scene", "A scene.");
  scene.list(study::parameters());
  const auto deck =
      deck::Deck::parse("<ParameterList name=\"scene\"><ParameterList name=\"Study\">" + body +
                            "</ParameterList></ParameterList>",
                        "deck.xml", scene, overrides);
  return study::readStudy(deck.list().sublist("Study"));
}

std::string text(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"string\" value=\"" + value + "\"/>";
}
std::string texts(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"Array(string)\" value=\"{" + value + "}\"/>";
}
std::string list(const std::string& name, const std::string& body) {
  return "<ParameterList name=\"" + name + "\">" + body + "</ParameterList>";
}
std::string dimension(const std::string& name, const std::string& parameter,
                      const std::string& values) {
  return list(name, text("Parameter", parameter) + texts("Values", values));
}

const std::string full = list(
    "Methods", list("explicit", text("Model", "Full") + texts("Set", "Transient/Integrator=RK4")));

void refuses(const std::string& body, const std::string& sentence) {
  try {
    settingsOf(body);
    FAIL() << "accepted; expected: " << sentence;
  } catch (const DeckError& error) {
    EXPECT_NE(std::string(error.what()).find(sentence), std::string::npos) << error.what();
  }
}

TEST(StudyList, AReferenceIsFittedToTheRunsUnlessTheDeckGivesOne) {
  const auto s = settingsOf(full);
  EXPECT_FALSE(s.window);
  EXPECT_EQ(s.repeats, 3);
  EXPECT_EQ(s.perturbation, 1e-10);
  EXPECT_TRUE(s.reference.empty());
  EXPECT_TRUE(s.check.empty());
  using Texts = std::vector<std::string>;
  auto explicitRuns = s;
  study::fitReference(explicitRuns, 0.0);
  EXPECT_EQ(explicitRuns.reference,
            (Texts{"!Transient/Step", "Transient/Integrator=RK4", "Transient/RK4/Safety=0.5"}));
  EXPECT_EQ(explicitRuns.check, Texts{"Transient/RK4/Safety=0.25"});
  auto implicitRuns = s;
  study::fitReference(implicitRuns, 2e-3);
  EXPECT_EQ(implicitRuns.reference.back(), "Transient/Step=5e-04");
  EXPECT_EQ(implicitRuns.check, Texts{"Transient/Step=0.00025"});
  EXPECT_EQ(settingsOf(full + list("Check", texts("Set", "Transient/RK4/Safety=0.1"))).reference,
            study::explicitReference());
  auto given = s;
  given.reference = Texts{"Transient/Step=1e-6"}, given.check = Texts{"Transient/Step=1e-7"};
  study::fitReference(given, 2e-3);
  EXPECT_EQ(given.reference, Texts{"Transient/Step=1e-6"});
  EXPECT_EQ(given.check, Texts{"Transient/Step=1e-7"});
  ASSERT_EQ(s.methods.size(), 1u);
  EXPECT_EQ(s.methods[0].label, "explicit");
  EXPECT_FALSE(s.methods[0].reduced);
}

TEST(StudyList, RefusesWhatMakesNoSense) {
  refuses(list("Methods", ""), "Study/Methods holds no method");
  refuses(list("Methods", list("a", text("Model", "Full") + list("Sweep", ""))),
          "Study/Methods/a/Sweep is empty");
  refuses(list("Methods", list("a", text("Model", "Full") +
                                        list("Sweep", dimension("step", "Transient/Step", "")))),
          "Study/Methods/a/Sweep/step/Values is empty");
  refuses(list("Methods", list("a", text("Model", "Full")) +
                              list("b", text("Model", "Reduced") + text("Label", "a"))),
          "Study/Methods/b has the label \"a\" of the method \"a\"");
  refuses(list("Methods", list("a", text("Model", "Full") + texts("Set", "Transient/Step"))),
          "which is no override");
  refuses(list("Methods", list("a", text("Model", "Full") + texts("Set", "!"))),
          "which is no override");
  refuses(list("Methods", list("a", text("Model", "Full") + texts("Set", "Output/CSV=false"))),
          "belongs to the whole study");
  refuses(list("Methods", list("a", text("Model", "Full") + texts("Set", "Transient/End Time=1"))),
          "all runs must be sampled at the same times");
  refuses(full + list("Reference", texts("Set", "Transient/Step=1e-5")), "Add a list Check");
  refuses(full + list("Check", texts("Set", "")), "changes nothing");
  refuses(
      full +
          list("Published",
               list("p", "<Parameter name=\"CPU Time\" type=\"Array(double)\" value=\"{1, 2}\"/>" +
                             texts("Points", "one"))),
      "has 1 entries, CPU Time has 2");
}

TEST(StudyList, SaysAllFaultsAtOnce) {
  try {
    settingsOf(list("Methods", list("a", text("Model", "Full") + texts("Set", "x, !Study"))));
    FAIL() << "accepted";
  } catch (const DeckError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("\"x\""), std::string::npos);
    EXPECT_NE(said.find("changes Study"), std::string::npos);
  }
}

TEST(Expansion, IsTheProductWithTheLastDimensionAlongALine) {
  const auto s = settingsOf(list(
      "Methods",
      list("cb",
           text("Model", "Reduced") + text("Label", "CB") + texts("Set", "Transient/Step=1e-3") +
               list("Sweep",
                    dimension("state", "Reduction/Initial State", "Keep static, Least squares") +
                        dimension("modes", "Reduction/Mode Selection/Modes", "0, 4, 8")))));
  const auto runs = study::expand(s);
  ASSERT_EQ(runs.size(), 6u);
  EXPECT_EQ(runs[1].label, "CB, Keep static, Modes 4");
  EXPECT_EQ(runs[1].line, "CB, Keep static");
  EXPECT_EQ(runs[5].label, "CB, Least squares, Modes 8");
  EXPECT_TRUE(runs[5].reduced);
  ASSERT_EQ(runs[5].overrides.size(), 3u);
  EXPECT_EQ(runs[5].overrides[0].text, "Transient/Step=1e-3");
  EXPECT_EQ(runs[5].overrides[0].source, "Study/Methods/cb/Set");
  EXPECT_EQ(runs[5].overrides[2].text, "Reduction/Mode Selection/Modes=8");
  EXPECT_EQ(runs[5].overrides[2].source, "Study/Methods/cb/Sweep/modes");
}

TEST(Expansion, AFullModelLosesItsReduction) {
  const auto runs = study::expand(settingsOf(full));
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_EQ(runs[0].overrides[0].text, "!Substructures");
  EXPECT_EQ(runs[0].overrides[1].text, "!Reduction");
  EXPECT_EQ(runs[0].label, "explicit");
  EXPECT_EQ(runs[0].line, "explicit");
}

TEST(Expansion, AFullModelLosesTheListsItIsSaidToHave) {
  const auto runs = study::expand(settingsOf(full), {"Reduction"});
  ASSERT_FALSE(runs.empty());
  EXPECT_EQ(runs[0].overrides[0].text, "!Reduction");
  for (const auto& item : runs[0].overrides) EXPECT_NE(item.text, "!Substructures");
  auto s = settingsOf(full);
  study::fitReference(s, 0.0);
  EXPECT_EQ(study::references(s, {"Reduction"})[0].overrides[0].text, "!Reduction");
}

TEST(Expansion, TheCheckIsTheReferenceWithFurtherOverrides) {
  auto s = settingsOf(full);
  study::fitReference(s, 0.0);
  const auto runs = study::references(s);
  ASSERT_EQ(runs.size(), 3u);
  EXPECT_EQ(runs[0].kind, study::RunKind::Reference);
  EXPECT_EQ(runs[1].overrides.size(), runs[0].overrides.size() + 1);
  EXPECT_EQ(runs[1].overrides.back().text, "Transient/RK4/Safety=0.25");
  EXPECT_EQ(runs[2].kind, study::RunKind::Sensitivity);
  auto still = settingsOf(full, {"Study/Perturbation=0"});
  study::fitReference(still, 0.0);
  EXPECT_EQ(study::references(still).size(), 2u);
}

}  // namespace StudyListTest
