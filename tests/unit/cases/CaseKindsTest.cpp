// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The kind of case for a deck, and data shared by cases made from one another.
#include "cases/CaseKinds.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>

#include "cases/imported/ImportedCase.hpp"
#include "common/Error.hpp"
#include "io/TextFile.hpp"
#include "substructures/drillstring/case/DrillstringCase.hpp"
#include "tests/support/ErrorText.hpp"
#include "tests/support/SourceFolder.hpp"

namespace CaseKindsTest {

using namespace tooljoint;

const std::string source = testing_::sourceFolder();
const std::string ofString = source + "/tests/effects/scene.xml";
const std::string ofParts = source + "/xml/frame.xml";

template <class Kind>
bool is(const std::unique_ptr<cases::Case>& one) {
  return dynamic_cast<const Kind*>(one.get()) != nullptr;
}

TEST(CaseKinds, ListsOfTheDeckDecide) {
  EXPECT_TRUE(is<drillstring::DrillstringCase>(cases::readCase(ofString, {})));
  EXPECT_TRUE(is<cases::ImportedCase>(cases::readCase(ofParts, {})));
}

/// The message with which a deck is refused.
std::string refusal(const std::string& file, const std::vector<std::string>& overrides) {
  return errorText([&] { cases::readCase(file, overrides); });
}

TEST(CaseKinds, DeckWithoutAnyOfTheirListsIsReadAsAString) {
  EXPECT_NE(refusal(ofParts, {"!Parts"}).find("Well"), std::string::npos);
}

TEST(CaseKinds, DeckOfALibraryThatIsNotLinkedNamesTheLibrary) {
  cases::CaseKinds toolkit;
  toolkit.add({{"Parts"}, 0, {}, {}});
  EXPECT_EQ(toolkit.of({"Parts", "Transient"}).lists, std::vector<std::string>{"Parts"});
  for (const auto& lists : {std::vector<std::string>{"Well", "Transient"}, {"Parts", "Well"}})
    EXPECT_EQ(errorText([&] { toolkit.of(lists); }),
              "The list \"Well\" is read by Tooljoint::drillstring, which this program is not "
              "linked to: target_link_libraries(<program> PRIVATE Tooljoint::drillstring "
              "Tooljoint::toolkit).");
}

TEST(CaseKinds, OverridesThatTakeListsOutCount) {
  const auto without = refusal(ofString, {"!Drillstring"});
  EXPECT_NE(without.find("Drillstring"), std::string::npos) << without;
}

TEST(CaseKinds, DescriptionIsChosenByTheListsOfTheFile) {
  std::vector<std::string> seen;
  int asked = 0;
  const auto deck = deck::Deck::read(ofParts,
                                     [&](const std::vector<std::string>& lists) {
                                       seen = lists;
                                       ++asked;
                                       return cases::importedSpec();
                                     },
                                     {"!Reduction"});
  EXPECT_EQ(asked, 1);
  EXPECT_NE(std::find(seen.begin(), seen.end(), "Parts"), seen.end());
  EXPECT_EQ(std::find(seen.begin(), seen.end(), "Reduction"), seen.end());
  EXPECT_EQ(deck.name(), "frame");
}

TEST(CaseKinds, VariantsOfACaseDoNotReadTheFileAgain) {
  const auto file = std::filesystem::temp_directory_path() / "tooljoint_variant.xml";
  std::ofstream(file) << io::readText(ofString);
  const auto one = cases::readCase(file, {});
  std::filesystem::remove(file);
  const auto other = one->with({"!Transient", "!Reduction", "!Substructures"});
  EXPECT_FALSE(other->moves());
  EXPECT_EQ(other->nodes(), one->nodes());
}

TEST(CaseKinds, ADeckInMemoryIsThatOfItsFile) {
  const auto text = io::readText(ofParts);
  const auto file = cases::readCase(ofParts, {"!Reduction"});
  const auto memory = cases::parseCase(text, ofParts, {"!Reduction"});  // its part files beside it
  EXPECT_TRUE(is<cases::ImportedCase>(memory));
  EXPECT_EQ(memory->freeDofs(), file->freeDofs());
  EXPECT_EQ(memory->deck().sha256(), file->deck().sha256());
  EXPECT_FALSE(memory->reduces());
  const auto refused = errorText([&] { cases::parseCase("<ParameterList", "mine.xml", {}); });
  EXPECT_EQ(refused.rfind("mine.xml:1", 0), 0U) << refused;
}

TEST(CaseKinds, APartWithoutMassOrStiffnessIsRemarkedOn) {
  const auto folder = std::filesystem::temp_directory_path() / "tooljoint_zero_part";
  std::filesystem::create_directory(folder);
  const auto remarksOf = [&](const std::string& mass, const std::string& stiffness) {
    std::ofstream(folder / "p.json")
        << R"({"format": "tooljoint part 1", "components": ["u"], "dofs": [[1, "u"]], "mass": [[)"
        << mass << R"(]], "stiffness": [[)" << stiffness << "]]}";
    return cases::parseCase(R"(<ParameterList name="zero"><ParameterList name="Parts">
        <ParameterList name="Imported"><ParameterList name="p">
        <Parameter name="File" type="string" value="p.json"/>
        </ParameterList></ParameterList></ParameterList></ParameterList>)",
                            (folder / "deck.xml").string(), {})
        ->remarks();
  };
  EXPECT_TRUE(remarksOf("2", "3").empty());
  for (const bool mass : {true, false}) {
    const auto remarks = mass ? remarksOf("0", "3") : remarksOf("2", "0");
    ASSERT_EQ(remarks.size(), 1U);
    EXPECT_NE(remarks[0].find(mass ? "has no mass: its mass matrix is zero"
                                   : "has no stiffness: its stiffness matrix is zero"),
              std::string::npos)
        << remarks[0];
  }
  std::filesystem::remove_all(folder);
}

TEST(CaseKinds, PartsThatAreSharedAreCheckedForEachReduction) {
  const auto one = cases::readCase(ofParts, {});
  EXPECT_NO_THROW(one->with({"Reduction/Load Vectors=None"}));
  EXPECT_THROW(one->with({"Reduction/Load Vectors=Points", "Reduction/Load Vector Nodes={9999}"}),
               Error);
}

/// The string starts from rest: friction at rest is mu_s at 0 s, and less at the speed of 0.5 s.
TEST(CaseKinds, StaticStatesOfDifferentStartTimesAreNotShared) {
  const auto at = [](const cases::Case& one, const char* start) {
    return one.with({"!Reduction", "!Substructures", "Transient/Step=0.002",
                     std::string("Transient/Start Time=") + start, "Transient/End Time=1"});
  };
  const auto first = cases::readCase(ofString, {});
  const Vector atRest = at(*first, "0")->atRest()->rest();
  const Vector turning = at(*first, "0.5")->atRest()->rest();
  const auto alone =
      cases::readCase(ofString, {"Transient/Start Time=0.5", "Transient/End Time=1"});
  EXPECT_EQ((turning - alone->atRest()->rest()).norm(), 0.0);
  EXPECT_GT((turning - atRest).norm(), 1e-3 * atRest.norm());
  EXPECT_EQ((at(*first, "0")->atRest()->rest() - atRest).norm(), 0.0);
}

TEST(CaseKinds, RecorderMeasuresTranslationsOfParts) {
  const auto rest = cases::readCase(ofParts, {})->atRest();
  const auto measures = rest->measures();
  EXPECT_EQ(measures.components, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(measures.vibration(), measures.components);
  const auto string = cases::readCase(ofString, {})->atRest()->measures();
  EXPECT_EQ(string.vibration(), (std::vector<int>{0, 1}));
}

}  // namespace CaseKindsTest
