// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The static state of the reference scene against the published one (Nguyen et al. 2020, section 5.2); docs/validation.md
/// explains the differences the tolerances allow for.
#include <cmath>
#include <gtest/gtest.h>

#include "tests/support/Scenes.hpp"

namespace {

using namespace tooljoint;
using testing_::reference;

const app::StaticStage& sourcePrestress() {
  static const app::StaticStage stage = app::settle(reference());
  return stage;
}

TEST(ReferenceStatic, TouchesWhereThePaperSays) {
  const auto& state = sourcePrestress().state;
  EXPECT_EQ(state.contactNodes, 81);             // 82 published; node 44 stays open by micrometres with this pre-stress
  EXPECT_NEAR(state.compressedElements, 15, 1);  // 15 published
  EXPECT_EQ(state.maxNormalForceNode, 86);       // "largest at the gauge"
  EXPECT_LT(state.gap(43), 0.0);
  EXPECT_GT(state.gap(43), -2e-5);
}

TEST(ReferenceStatic, TheLastElementCarriesTheBitLoads) {
  const auto& state = sourcePrestress().state;
  EXPECT_NEAR(state.lastElementAxialForce, -1e4, 500.0);  // half an element of weight and the chord's inclination
  EXPECT_NEAR(state.lastElementTorque, -5e3, 10.0);
}

TEST(ReferenceStatic, BothRecipesFindTheSameState) {
  const auto state = [](const std::string& recipe) {
    return app::settle(reference({"Static/Tolerance=1e-12", "Static/Recipe=" + recipe})).state.displacement;
  };
  const Vector expected = state("Continuation");
  EXPECT_LE((state("Source") - expected).norm(), 1e-11 * expected.norm());
}

TEST(ReferenceStatic, TheFullTangentBalancesTheTorque) {
  const auto full = app::settle(reference({"Path/Pre-stress=Full tangent"})).state;
  EXPECT_EQ(full.contactNodes, 82);
  // Turning the whole string about its curved axis must cost next to nothing; K_a + K_g alone resists like EI kappa^2 L.
  EXPECT_LT(std::abs(full.torqueBalanceDefect()), 0.005 * std::abs(full.topTorque));
  EXPECT_GT(std::abs(sourcePrestress().state.torqueBalanceDefect()), 0.5 * std::abs(full.topTorque));
}

TEST(ReferenceStatic, ImposedNodesStrayFromTheAxisAndTouchElsewhere) {
  const auto stage = app::settle(reference({"Path/Mode=Imposed nodes"}));
  EXPECT_GT(stage.path.report.maxPositionError, 0.1);
  EXPECT_LT(stage.path.report.maxPositionError, 0.4);
  EXPECT_GE(stage.state.contactNodes, 73);
  EXPECT_LE(stage.state.contactNodes, 78);
}

}  // namespace
