// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Features that a deck does not request are not built, stored or evaluated; checked by counters.
#include <algorithm>
#include <gtest/gtest.h>

#include "common/report/EvaluationCounters.hpp"
#include "tests/support/Scenes.hpp"

namespace AbsentTest {

using namespace tooljoint;

/// A short motion of the full reference string without some lists; returns its model, and the
/// census contains the counts.
model::SecondOrderModel without(std::vector<std::string> overrides) {
  for (const char* override :
       {"!Reduction", "!Substructures", "Transient/End Time=0.02", "Transient/Progress=false"})
    overrides.emplace_back(override);
  resetEvaluationCounters();
  const auto scene = testing_::reference(overrides);
  auto model = drillstring::fullModel(drillstring::solveStatic(scene));
  testing_::move(scene, model);
  return model;
}

bool hasTerm(const std::vector<model::MatrixTerm>& terms, const std::string& part) {
  return std::any_of(terms.begin(), terms.end(),
                     [&](const auto& term) { return term.name.find(part) != std::string::npos; });
}

TEST(Absent, TheWholeSceneBuildsEverything) {
  const auto model = without({});
  EXPECT_EQ(counted("mud matrices"), 162);
  EXPECT_EQ(counted("gyroscopic matrices"), 162);
  EXPECT_GT(counted("contact evaluations"), 0);
  EXPECT_GT(counted("friction evaluations"), 0);
  EXPECT_GT(counted("geometric stiffness"), 0);
  EXPECT_TRUE(hasTerm(model.damping, "mud"));
  EXPECT_TRUE(hasTerm(model.damping, "gyroscopic"));
  EXPECT_TRUE(hasTerm(model.damping, "Rayleigh"));
}

TEST(Absent, MudCostsNothing) {
  const auto model = without({"!Mud"});
  EXPECT_EQ(counted("mud matrices"), 0);
  EXPECT_FALSE(hasTerm(model.damping, "mud"));
  EXPECT_FALSE(hasTerm(model.stiffness, "mud"));
}

TEST(Absent, ContactCostsNothing) {
  const auto model = without({"!Contact", "Static/Max Iterations=200"});
  EXPECT_EQ(counted("contact evaluations"), 0);
  EXPECT_EQ(counted("friction evaluations"), 0);
  EXPECT_TRUE(model.points.empty());
}

TEST(Absent, FrictionCostsNothing) {
  without({"!Contact/Friction"});
  EXPECT_GT(counted("contact evaluations"), 0);
  EXPECT_EQ(counted("friction evaluations"), 0);
}

TEST(Absent, RotationCostsNothing) {
  const auto model = without({"!Rotary Speed"});
  EXPECT_EQ(counted("gyroscopic matrices"), 0);
  EXPECT_FALSE(hasTerm(model.damping, "gyroscopic"));
  EXPECT_FALSE(hasTerm(model.stiffness, "spin-up"));
  EXPECT_EQ(model.laws.size(), 1u);  // nothing varies in time
}

TEST(Absent, DampingAndLoadsCostNothing) {
  const auto model = without({"!Damping", "!Loads"});
  EXPECT_FALSE(hasTerm(model.damping, "Rayleigh"));
  EXPECT_EQ(counted("unbalance loads"), 0);
  for (const auto& load : model.loads) EXPECT_NE(load.name, "weight");
}

TEST(Absent, AReductionThatIsNotThereComputesNoModes) {
  without({});
  EXPECT_EQ(counted("modes computed"), counted("modes of the static state"));
  EXPECT_EQ(counted("parts reduced"), 0);
}

TEST(Absent, AFamilyOfDofsThatIsNotModelledIsNotInTheModel) {
  const auto lateral =
      without({"Supports/Dofs=lateral", "Loads/Weight On Bit=0", "Loads/Torque On Bit=0"});
  for (const auto& dof : lateral.dofs)
    EXPECT_TRUE(dof.component != 2 && dof.component != 5) << dof.component;
  EXPECT_EQ(lateral.size(), 163 * 4 - 4);
}

}  // namespace AbsentTest
