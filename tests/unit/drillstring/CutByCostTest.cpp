// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Cuts between parts chosen for the least cost of a step of the reduced model.
#include "substructures/drillstring/scene/CutByCost.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "cases/ReducedCase.hpp"
#include "common/Error.hpp"
#include "substructures/drillstring/case/DrillstringCase.hpp"
#include "tests/support/SourceFolder.hpp"
#include "transient/CostModel.hpp"

namespace CutByCostTest {

using namespace tooljoint;

drillstring::DrillstringCase caseWith(cases::Overrides overrides) {
  overrides.insert(overrides.begin(), "Substructures/Rule=By cost");
  return drillstring::DrillstringCase(
      drillstring::readScene(testing_::sourceFolder() + "/xml/helical_170m.xml", overrides));
}

double workOfAStep(const cases::Case& one, const model::SecondOrderModel& model) {
  return transient::costModel(model, transient::readOptions(one.transient())).total();
}

TEST(CutByCost, TakesTheCheapestOfWhatItTries) {
  const auto one = caseWith({"!Substructures/Retained Gap", "!Substructures/Retained Nodes"});
  const auto rest = one.solveStatic();
  const auto reduced = cases::reduce(one, *rest, false);
  const double full = workOfAStep(one, rest->full().model);
  ASSERT_GE(reduced.tried.size(), 4u) << "two lengths, all nodes, runs of eight";
  for (const auto& cut : reduced.tried) {
    auto overrides = one.deck().overrides();
    overrides.insert(overrides.end(), cut.overrides.begin(), cut.overrides.end());
    const auto other = one.with(overrides);
    const auto same = cases::reduce(*other, *other->solveStatic(), false);
    EXPECT_TRUE(same.tried.empty());
    EXPECT_DOUBLE_EQ(cut.cost, workOfAStep(one, same.model()) / full);
    EXPECT_GE(cut.cost, 0.97 * reduced.cut.cost);
    if (cut.overrides == reduced.cut.overrides) {
      EXPECT_EQ(same.model().size(), reduced.model().size());
    }
  }
  EXPECT_LE(reduced.cut.cost, 1.01) << "nearly every node can touch: the string stays as it is";
}

TEST(CutByCost, LeavesWhatTheDeckGives) {
  const auto choices = caseWith({"Substructures/Minimum Reduced Run=3"}).openChoices();
  ASSERT_EQ(choices.size(), 1u) << "lengths alone: the deck has Retained Gap, too";
  EXPECT_EQ(choices[0][0][0], "Substructures/Rule=By length");
  EXPECT_TRUE(caseWith({"Substructures/Rule=By component"}).openChoices().empty());
}

std::string refusal(const std::string& deck, const cases::Overrides& overrides) {
  try {
    drillstring::readScene(testing_::sourceFolder() + deck, overrides);
  } catch (const DeckError& error) {
    return error.what();
  }
  return "";
}

TEST(CutByCost, RefusesWhatMakesLongPartsLessAccurateOrNamesParts) {
  const std::string rule = "Substructures/Rule=By cost", modes = "Reduction/Mode Selection/";
  EXPECT_NE(
      refusal("/xml/helical_170m.xml", {rule, "!" + modes + "Cut-off Frequency", modes + "Modes=4"})
          .find("less accurate"),
      std::string::npos);
  EXPECT_EQ(refusal("/xml/helical_170m.xml",
                    {rule, "!" + modes + "Cut-off Frequency", modes + "Frequency Tolerance=1e-3"}),
            "");
  EXPECT_NE(refusal("/tests/effects/coupling.xml", {rule}).find("Coupling speaks of"),
            std::string::npos);
  EXPECT_NE(refusal("/xml/helical_170m.xml", {rule, "!Transient"}).find("needs a motion"),
            std::string::npos);
}

TEST(CutByCost, LengthsDoubleFromOneComponentToHalfTheString) {
  const auto one = caseWith({});
  const auto lengths = drillstring::lengthsOfParts(one.scene().string);
  EXPECT_NEAR(lengths[0], 10.0, 1e-3) << "pipes and collars of 10 m";
  for (std::size_t i = 1; i < lengths.size(); ++i) EXPECT_DOUBLE_EQ(lengths[i], 2 * lengths[i - 1]);
  EXPECT_GT(2 * lengths.back(), 0.5 * 170.2);
  EXPECT_LE(lengths.back(), 0.5 * 170.2);
}

}  // namespace CutByCostTest
