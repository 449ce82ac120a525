// SPDX-License-Identifier: BSD-3-Clause
#include "deck/ListSpec.hpp"

#include <gtest/gtest.h>
#include <stdexcept>

#include "SmallScene.hpp"
#include "deck/Describe.hpp"

namespace ListSpecTest {

using namespace tooljoint;
using namespace tooljoint::deck;

TEST(ListSpec, KeepsTheOrderOfDeclaration) {
  const ListSpec scene = test::smallScene();
  const ListSpec& transient = *scene.findList("Transient");
  EXPECT_EQ(transient.parameters().front().name, "End Time");
  EXPECT_EQ(transient.parameters().back().name, "Note");
  EXPECT_TRUE(transient.required());
  EXPECT_TRUE(transient.findList("NOX")->passesThrough());
  EXPECT_FALSE(scene.findList("Contact")->required());
  EXPECT_EQ(scene.findParameter("Nothing"), nullptr);
  EXPECT_EQ(scene.findList("Nothing"), nullptr);
}

TEST(ListSpec, WholeNumbersStandForRealDefaults) {
  const ListSpec list = ListSpec("a", "A.")
                            .real("Length", "m", 2, Range::any(), "L.")
                            .realArray("Lengths", "m", std::vector<int>{1, 2}, Range::any(), "L.");
  EXPECT_EQ(std::get<double>(list.findParameter("Length")->value), 2.0);
  EXPECT_EQ(std::get<std::vector<double>>(list.findParameter("Lengths")->value),
            (std::vector<double>{1.0, 2.0}));
  EXPECT_TRUE(list.inconsistencies().empty());
}

TEST(ListSpec, ATextDefaultIsNoBool) {
  const ListSpec list = ListSpec("a", "A.").text("Name", "x", "N.");
  EXPECT_EQ(std::get<std::string>(list.findParameter("Name")->value), "x");
}

TEST(ListSpec, APatternAnswersForNamesThatAreNotDeclared) {
  const ListSpec list =
      ListSpec("a", "A.").list(ListSpec("Declared", "D.")).namedLists(ListSpec("pattern", "P."));
  EXPECT_EQ(list.findList("Declared")->name(), "Declared");
  EXPECT_EQ(list.findList("anything")->name(), "pattern");
  EXPECT_EQ(list.pattern()->doc(), "P.");
}

TEST(ListSpec, MergeAddsWhatIsNotThere) {
  ListSpec common = ListSpec("Common", "C.")
                        .real("Step", "s", 1.0, Range::any(), "S.")
                        .list(ListSpec("Sub", "S.").integer("A", 1, Range::any(), "A."));
  common.merge(ListSpec("Other", "O.")
                   .real("Step", "s", 2.0, Range::any(), "T.")
                   .integer("N", 3, Range::any(), "N.")
                   .list(ListSpec("Sub", "S.").integer("B", 1, Range::any(), "B.")));
  EXPECT_EQ(std::get<double>(common.findParameter("Step")->value), 1.0);
  EXPECT_NE(common.findParameter("N"), nullptr);
  EXPECT_NE(common.findList("Sub")->findParameter("A"), nullptr);
  EXPECT_NE(common.findList("Sub")->findParameter("B"), nullptr);
  EXPECT_TRUE(common.inconsistencies().empty());
}

TEST(ListSpec, MergeRefusesAnotherKindUnderTheSameName) {
  ListSpec common = ListSpec("Common", "C.").real("Step", "s", 1.0, Range::any(), "S.");
  EXPECT_THROW(common.merge(ListSpec("Other", "O.").integer("Step", 1, Range::any(), "S.")),
               std::logic_error);
}

TEST(ListSpec, NamedKeepsAllButTheName) {
  const ListSpec list = ListSpec("a", "A.").integer("N", 3, Range::any(), "N.").named("b");
  EXPECT_EQ(list.name(), "b");
  EXPECT_NE(list.findParameter("N"), nullptr);
}

struct Contradiction {
  std::string fault;
  ListSpec list;
  friend std::ostream& operator<<(std::ostream& out, const Contradiction& t) {
    return out << t.fault;
  }
};
class Inconsistency : public ::testing::TestWithParam<Contradiction> {};

TEST_P(Inconsistency, IsFoundAndRefused) {
  EXPECT_EQ(GetParam().list.inconsistencies(), std::vector<std::string>{GetParam().fault});
  EXPECT_THROW(Deck::parse("<ParameterList name=\"x\"/>", "x.xml", GetParam().list),
               std::logic_error);
}

INSTANTIATE_TEST_SUITE_P(
    Table, Inconsistency,
    ::testing::Values(
        Contradiction{"/a/N is declared twice", ListSpec("a", "A.")
                                                    .integer("N", 1, Range::any(), "N.")
                                                    .integer("N", 2, Range::any(), "N.")},
        Contradiction{
            "/a/N is declared twice",
            ListSpec("a", "A.").integer("N", 1, Range::any(), "N.").list(ListSpec("N", "N."))},
        Contradiction{"/a/N has a default outside its range",
                      ListSpec("a", "A.").integer("N", 0, Range::atLeast(1), "N.")},
        Contradiction{"/a/x has a default outside its range",
                      ListSpec("a", "A.").realArray("x", "m", std::vector<double>{1.0, -1.0},
                                                    Range::positive(), "X.")},
        Contradiction{"/a/N has a default of another type than its own",
                      ListSpec("a", "A.").integer("N", 1.5, Range::any(), "N.")},
        Contradiction{"/a/L has a default that is not one of its choices",
                      ListSpec("a", "A.").choice("L", "z", {"x", "y"}, "L.")},
        Contradiction{"/a/old is declared twice", ListSpec("a", "A.")
                                                      .integer("N", 1, Range::any(), "N.")
                                                      .formerly("old")
                                                      .integer("old", 1, Range::any(), "O.")},
        Contradiction{"/a/N is required, so it cannot be for experts",
                      ListSpec("a", "A.").integer("N", Required{}, Range::any(), "N.").expert()},
        Contradiction{"/a/L has no choices", ListSpec("a", "A.").choice("L", Required{}, {}, "L.")},
        Contradiction{"/a/L has no sentence that documents it",
                      ListSpec("a", "A.").text("L", "x", "")},
        Contradiction{"/a/ L has an empty name, or blanks around it",
                      ListSpec("a", "A.").text(" L", "x", "L.")},
        Contradiction{"/a/<p>/N has a default outside its range",
                      ListSpec("a", "A.").namedLists(
                          ListSpec("p", "P.").integer("N", 0, Range::positive(), "N."))}));

TEST(Describe, RangesInWords) {
  EXPECT_EQ(describe(Range::any()), "");
  EXPECT_EQ(describe(Range::positive()), "> 0");
  EXPECT_EQ(describe(Range::nonNegative()), ">= 0");
  EXPECT_EQ(describe(Range::atLeast(1)), ">= 1");
  EXPECT_EQ(describe(Range::between(0, 0.5)), "in [0, 0.5]");
  EXPECT_EQ(describe(Range{0, 1, true, true}), "in (0, 1)");
  EXPECT_EQ(describe(Range{-std::numeric_limits<double>::infinity(), 3, false, true}), "< 3");
}

TEST(Describe, BoundsAreInOrOutAsDeclared) {
  EXPECT_FALSE(contains(Range::positive(), 0.0));
  EXPECT_TRUE(contains(Range::nonNegative(), 0.0));
  EXPECT_TRUE(contains(Range::between(0, 1), 1.0));
  EXPECT_FALSE(contains(Range{0, 1, true, true}, 1.0));
  EXPECT_TRUE(contains(Range::any(), -1e300));
}

TEST(Describe, IntroducesAParameterInASentence) {
  const ListSpec scene = test::smallScene();
  EXPECT_EQ(introduce(*scene.findList("Contact")->findParameter("Stiffness")),
            "It is the nominal contact stiffness, N/m, > 0.");
  const ListSpec other = ListSpec("a", "A.")
                             .integer("Modes", 1, Range::atLeast(0), "Number of modes kept.")
                             .real("W", "N", 1.0, Range::any(), "WOB at the bit.");
  EXPECT_EQ(introduce(other.parameters()[0]), "\"Modes\": number of modes kept, >= 0.");
  EXPECT_EQ(introduce(other.parameters()[1]), "\"W\": WOB at the bit, N.");
}

TEST(Describe, NamesOfPeopleKeepTheirCapitals) {
  const ListSpec list =
      ListSpec("a", "A.").real("E", "Pa", 1.0, Range::positive(), "Young's modulus.");
  EXPECT_EQ(introduce(list.parameters()[0]), "\"E\": Young's modulus, Pa, > 0.");
}

TEST(Describe, UnitAndRangeStandBehindTheFirstSentence) {
  const ListSpec list =
      ListSpec("a", "A.").real("Step", "s", 1.0, Range::positive(),
                               "The fixed step. By default 0.001 s for RK4. Not for others.");
  EXPECT_EQ(introduce(list.parameters()[0]),
            "It is the fixed step, s, > 0. By default 0.001 s for RK4. Not for others.");
}

TEST(Describe, ExamplesLieInRangeAndAmongTheChoices) {
  const std::vector<Range> ranges = {
      Range::any(),
      Range::positive(),
      Range::nonNegative(),
      Range::atLeast(5),
      Range::between(-3, -2),
      Range{2, 3, true, true},
      Range{0, 0.5, true, false},
      Range{-std::numeric_limits<double>::infinity(), -4, false, true},
      Range{7.5, std::numeric_limits<double>::infinity(), true, false}};
  for (const Range& range : ranges) {
    const ListSpec list = ListSpec("a", "A.").real("x", "m", Required{}, range, "X.");
    EXPECT_TRUE(contains(range, std::stod(exampleValue(list.parameters()[0])))) << describe(range);
  }
  EXPECT_EQ(
      exampleValue(ListSpec("a", "A.").choice("L", Required{}, {"x", "y"}, "L.").parameters()[0]),
      "x");
  EXPECT_EQ(exampleValue(ListSpec("a", "A.")
                             .integerArray("n", Required{}, Range::atLeast(3), "N.")
                             .parameters()[0]),
            "{3}");
}

}  // namespace ListSpecTest
