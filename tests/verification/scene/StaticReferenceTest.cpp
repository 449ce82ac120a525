// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The static state from nodes of the unloaded string and from nodes of the hanging one: equal
/// forces if the string moves little, and both start the motion in equilibrium.
#include <cmath>
#include <gtest/gtest.h>

#include "substructures/beam/NodalDofs.hpp"
#include "tests/support/Scenes.hpp"
#include "tests/support/SourceFolder.hpp"

namespace StaticReferenceTest {

using namespace tooljoint;
using namespace beam::nodal;

drillstring::Scene scene(const std::string& reference, std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.begin(),
                   {"Well/Arc/Kick-off Depth=0", "Well/Arc/Start Inclination=50 deg",
                    "Well/Arc/Build Rate=3 deg/30m", "Drillstring/Assembly={4*stand}",
                    "Static/Reference=" + reference});
  return drillstring::readScene(testing_::sourceFolder() + "/xml/build_hold_1400m.xml", overrides);
}

/// K D - F - F_c at the start of the motion over the largest load, the largest of all dofs.
double unbalance(const drillstring::StaticStage& stage) {
  const auto model = drillstring::fullModel(stage);
  const Vector& D = model.initialDisplacement;
  const Vector still = Vector::Zero(model.size());
  Vector r = model.stiffnessAt(0.0) * D - model.pointForce(0.0, D, still);
  double largest = 0.0;
  for (const auto& load : model.loads) {
    const Vector force = load.vector * model.laws[static_cast<std::size_t>(load.law)].value(0.0);
    largest = std::max(largest, force.cwiseAbs().maxCoeff());
    r -= force;
  }
  return r.cwiseAbs().maxCoeff() / largest;
}

TEST(StaticReference, BothStartTheMotionInBalance) {
  for (const char* reference : {"Unloaded", "Hanging"})
    EXPECT_LT(unbalance(drillstring::findEquilibrium(scene(reference))), 1e-7) << reference;
}

/// 38 m of string stretch by a tenth of a millimetre: the forces agree, and the nodes of the
/// hanging string contain its stretch.
TEST(StaticReference, ChangesWhereDisplacementsCountFrom) {
  const auto unloaded = drillstring::findEquilibrium(scene("Unloaded"));
  const auto hanging = drillstring::findEquilibrium(scene("Hanging"));
  const auto &from = unloaded.state, &to = hanging.state;
  const double tension = from.axialForce.cwiseAbs().maxCoeff();
  EXPECT_LT((from.axialForce - to.axialForce).cwiseAbs().maxCoeff(), 1e-4 * tension);
  EXPECT_NEAR(from.totalNormalForce, to.totalNormalForce, 1e-4 * from.totalNormalForce);
  EXPECT_NEAR(from.topTorque, to.topTorque, 1e-4 * std::abs(from.topTorque));
  EXPECT_LE(to.relativeTorqueDefect(), 1e-3);

  // of the string under weight and weight on bit, along the well
  const auto& elements = scene("Unloaded").string.elements;
  double stretch = 0.0;
  for (std::size_t e = 0; e < elements.size(); ++e)
    stretch += from.axialForce(static_cast<Eigen::Index>(e)) * elements[e].length() /
               elements[e].section().axialRigidity();
  const auto bit = from.displacement.size() - perNode + w;
  EXPECT_NEAR(from.displacement(bit) - to.displacement(bit), stretch, 0.01 * std::abs(stretch));
}

}  // namespace StaticReferenceTest
