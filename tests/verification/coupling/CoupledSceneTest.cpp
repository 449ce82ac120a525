// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A string with every kind of connection of the list Coupling: reduced with all modes it is the
/// full model with the same connections, with any assembly, and without loads it stays at rest.
#include <gtest/gtest.h>

#include "coupling/CoupledModes.hpp"
#include "coupling/Synthesis.hpp"
#include "estimate/ModeComparison.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "substructures/drillstring/scene/Stages.hpp"
#include "tests/support/SourceFolder.hpp"

namespace CoupledSceneTest {

using namespace tooljoint;

drillstring::Scene sceneWith(const std::vector<std::string>& overrides) {
  return drillstring::readScene(testing_::sourceFolder() + "/tests/effects/coupling.xml",
                                overrides);
}

class CoupledScene : public testing::TestWithParam<const char*> {};

TEST_P(CoupledScene, WithAllModesIsTheFullModel) {
  const auto scene =
      sceneWith({"!Reduction/Mode Selection", "Reduction/Mode Selection/All Modes=true",
                 std::string("Coupling/Assembly=") + GetParam()});
  const auto stage = drillstring::solveStatic(scene);
  const auto resolved = drillstring::resolvedParts(scene, stage);
  const auto whole = drillstring::joinUnreduced(resolved);
  const auto reduced =
      coupling::synthesise(resolved.parts, scene.list().sublist("Reduction"), resolved.options);
  EXPECT_EQ(reduced.coupled.multipliers.empty(), std::string(GetParam()) == "Primal");
  const int count = 40;
  const Vector exact = coupling::lowestModes(whole.model, whole.model.size()).values,
               found = coupling::lowestModes(reduced.coupled.model, count).values;
  for (int i = 0; i < count; ++i)
    EXPECT_LE(std::abs(found[i] - exact[i]),
              1e-9 * std::abs(exact[i]) + 1e-15 * exact[exact.size() - 1])
        << "mode " << i + 1;
  // and the shapes, through the maps of both models
  for (const auto& mode :
       estimate::compareModes(whole.model, resolved.parts, reduced, 12, whole.maps))
    EXPECT_GT(mode.mac, 1 - 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Assemblies, CoupledScene, testing::Values("Primal", "Dual"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST(CoupledScene, StaysAtRestWhereTheStringWas) {
  // Friction and rotation start with the motion, stops are pressed together.
  const std::vector<std::string> quiet{"!Loads/Forces",      "!Loads/Unbalance",
                                       "!Rotary Speed",      "!Contact/Friction",
                                       "!Contact/Intervals", "!Coupling/Stops"};
  const auto residual = [](const model::SecondOrderModel& m) {
    const Vector zero = Vector::Zero(m.size());
    return Vector(m.stiffnessAt(0) * m.initialDisplacement - m.loadAt(0) -
                  m.pointForce(0, m.initialDisplacement, zero))
        .cwiseAbs()
        .maxCoeff();
  };
  const auto run = [&](std::vector<std::string> more) {
    more.insert(more.end(), quiet.begin(), quiet.end());
    const auto scene = sceneWith(more);
    return residual(drillstring::fullModel(scene, drillstring::solveStatic(scene)));
  };
  const double kept = run({}), jump = run({"Coupling/Keep Static Forces=false"});
  EXPECT_LT(kept, 1e-3) << "N, where the string weighs 50 kN";
  EXPECT_GT(jump, 1e3) << "the slide carries the axial force of the string";
}

}  // namespace CoupledSceneTest
