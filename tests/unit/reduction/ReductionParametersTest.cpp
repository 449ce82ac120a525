// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The deck list "Reduction": every parameter has its documented effect.
#include "reduction/ReductionParameters.hpp"

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "reduction/Reduce.hpp"
#include "reduction/selection/ModeSelection.hpp"
#include "tests/support/ListDefaults.hpp"
#include "tests/support/SampleParts.hpp"

namespace ReductionParametersTest {

using namespace tooljoint;
using namespace tooljoint::reduction;

Teuchos::ParameterList defaults() { return test::defaultsOf(parameters()); }

std::string refusal(const Teuchos::ParameterList& list, int parts) {
  try {
    readOptions(list, parts);
  } catch (const DeckError& error) {
    return error.what();
  }
  return "accepted";
}

std::vector<int> modesOf(const std::vector<ReducedSubstructure>& parts) {
  std::vector<int> modes;
  for (const auto& part : parts) modes.push_back(part.modes);
  return modes;
}

std::vector<int> modesFor(const std::function<void(Teuchos::ParameterList&)>& change) {
  auto list = defaults();
  change(list.sublist("Mode Selection"));
  return modesOf(reduceAll(samples::loopFrame(6, false), list));
}

TEST(ReductionParameters, AreDescribed) {
  const deck::ListSpec spec = parameters();
  EXPECT_EQ(spec.name(), "Reduction");
  for (const auto& parameter : spec.parameters())
    EXPECT_FALSE(parameter.doc.empty()) << parameter.name;
  ASSERT_NE(spec.findParameter("Basis"), nullptr);
  EXPECT_EQ(spec.findParameter("Basis")->choices, MethodRegistry::instance().names());
  ASSERT_NE(spec.findList("Mode Selection"), nullptr);
  EXPECT_EQ(spec.findList("Mode Selection")->findParameter("Cut-off Frequency")->unit, "Hz");
  ASSERT_NE(spec.findList("Anasazi"), nullptr);
  EXPECT_TRUE(spec.findList("Anasazi")->passesThrough());
}

TEST(ReductionParameters, EveryModeCountWorks) {
  EXPECT_EQ(modesFor([](auto& list) { list.set("Modes", 2); }), (std::vector<int>{2, 2, 2, 2}));
  EXPECT_EQ(modesFor([](auto& list) {
              list.set("Modes by Substructure",
                       Teuchos::Array<int>(Teuchos::tuple<int>(1, 2, 3, 4)));
            }),
            (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(modesFor([](auto& list) { list.set("All Modes", true); }),
            (std::vector<int>{15, 15, 15, 18}));
  const auto total = modesFor([](auto& list) { list.set("Total Modes", 9); });
  EXPECT_EQ(total[0] + total[1] + total[2] + total[3], 9);
  const auto low = modesFor([](auto& list) { list.set("Cut-off Frequency", 100.0); });
  const auto high = modesFor([](auto& list) { list.set("Cut-off Frequency", 1000.0); });
  for (std::size_t p = 0; p < 4; ++p) EXPECT_LT(low[p], high[p]);
}

TEST(ReductionParameters, ExactlyOneModeSelection) {
  auto list = defaults();
  const std::string missing =
      "Reduction does not select modes. Give the list \"Mode Selection\" exactly one of \"Modes\", "
      "\"Cut-off Frequency\", \"Frequency Tolerance\", \"Motion Tolerance\", \"Modes by "
      "Substructure\", \"Total Modes\", \"All Modes\", \"Effective Interface Mass\", "
      "\"Interface Moment\".";
  EXPECT_EQ(refusal(list, 4), missing);
  auto& selection = list.sublist("Mode Selection");
  EXPECT_EQ(refusal(list, 4), missing);
  selection.set("All Modes", false);
  EXPECT_EQ(refusal(list, 4), missing);
  selection.set("Modes", 3);
  EXPECT_EQ(refusal(list, 4), "accepted");
  selection.set("Total Modes", 30);
  EXPECT_EQ(
      refusal(list, 4),
      "Reduction/Mode Selection gives \"Modes\", \"Total Modes\" together. Give exactly one.");
}

TEST(ReductionParameters, StaticCondensationNeedsNoSelection) {
  auto list = defaults();
  list.set("Basis", "Guyan");
  for (const auto& part : reduceAll(samples::loopFrame(6, false), list))
    EXPECT_EQ(part.retained + part.modes, 0) << part.name;
  list.sublist("Mode Selection").set("Modes", 3);
  const auto masters = reduceAll(samples::loopFrame(6, false), list);
  EXPECT_EQ(masters[0].retained, 3);
}

TEST(ReductionParameters, CriteriaAndTolerances) {
  auto list = defaults();
  auto& selection = list.sublist("Mode Selection");
  selection.set("Interface Moment", 0.9);
  EXPECT_EQ(readOptions(list, 4).modes.kind, ModeRule::Kind::InterfaceMoment);
  EXPECT_EQ(readOptions(list, 4).modes.fraction, 0.9);
  EXPECT_FALSE(selectsModesByTolerance(list));
  selection.set("Motion Tolerance", 0.02);
  EXPECT_EQ(
      refusal(list, 4),
      "Reduction/Mode Selection gives \"Motion Tolerance\", \"Interface Moment\" together. Give "
      "exactly one.");
  selection.remove("Interface Moment");
  selection.set("Frequency Tolerance", 1e-3);
  const auto rule = readOptions(list, 4).modes;
  EXPECT_EQ(rule.kind, ModeRule::Kind::Tolerance) << "both tolerances hold together";
  EXPECT_EQ(rule.frequencyTolerance, 1e-3);
  EXPECT_EQ(rule.motionTolerance, 0.02);
  EXPECT_TRUE(selectsModesByTolerance(list));
  EXPECT_THROW(reduceAll(samples::loopFrame(4, false), list), DeckError)
      << "no tolerance can be met part by part";
}

TEST(ReductionParameters, OneEntryForEachSubstructure) {
  auto list = defaults();
  list.sublist("Mode Selection").set("Modes by Substructure", Teuchos::Array<int>(3, 5));
  EXPECT_EQ(
      refusal(list, 4),
      "\"Modes by Substructure\" has 3 entries for 4 substructures. Give one number for each, "
      "or \"Modes\" for the same number everywhere.");
}

TEST(ReductionParameters, InitialStateAndChecks) {
  auto list = defaults();
  list.sublist("Mode Selection").set("Modes", 3);
  EXPECT_EQ(readOptions(list, 1).initialState, InitialState::KeepStatic);
  EXPECT_TRUE(readOptions(list, 1).checks);
  list.set("Initial State", "Least squares");
  list.set("Basis Checks", false);
  const auto options = readOptions(list, 1);
  EXPECT_EQ(options.initialState, InitialState::LeastSquares);
  EXPECT_FALSE(options.checks);
  EXPECT_FALSE(reduceAll(samples::loopFrame(4, false), list)[0].report.checked);
}

TEST(ReductionParameters, AnasaziReachesTheEigensolver) {
  auto list = defaults();
  list.sublist("Mode Selection").set("Modes", 4);
  auto part = samples::bar("long", 1, 400, 1.0, 1.0);
  samples::classify(part, {}, {1, 401});
  list.sublist("Anasazi").set("Block Size", 2);
  const auto reduced = reduceAll({part}, list);
  EXPECT_NE(reduced[0].report.method.find("Anasazi"), std::string::npos)
      << reduced[0].report.method;
  list.sublist("Anasazi").set("Maximum Restarts", 0).set("Num Blocks", 3);
  EXPECT_THROW(reduceAll({part}, list), ConvergenceError);
}

TEST(ReductionParameters, UnknownBasisListsTheKnownOnes) {
  auto list = defaults();
  list.sublist("Mode Selection").set("Modes", 4);
  list.set("Basis", "Craig");
  try {
    reduceAll(samples::loopFrame(4, false), list);
    FAIL();
  } catch (const DeckError& error) {
    EXPECT_NE(std::string(error.what()).find("\"Craig-Bampton\""), std::string::npos);
  }
}

}  // namespace ReductionParametersTest
