// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The static state of the reference scene against the published one (Nguyen et al. 2020,
/// section 5.2); docs/validation.md explains the differences allowed by the tolerances.
#include <cmath>
#include <gtest/gtest.h>
#include <string>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "tests/support/Scenes.hpp"

namespace ReferenceStaticTest {

using namespace tooljoint;
using testing_::reference;

const drillstring::StaticStage& sourcePrestress() {
  static const drillstring::StaticStage stage = drillstring::solveStatic(reference());
  return stage;
}

TEST(ReferenceStatic, TouchesWhereThePaperSays) {
  const auto& state = sourcePrestress().state;
  EXPECT_EQ(state.contactNodes,
            81);  // 82 published; node 44 stays open by micrometres with this pre-stress
  EXPECT_NEAR(state.compressedElements, 15, 1);  // 15 published
  EXPECT_EQ(state.maxNormalForceNode, 86);       // "largest at the gauge"
  EXPECT_LT(state.gap(43), 0.0);
  EXPECT_GT(state.gap(43), -2e-5);
}

TEST(ReferenceStatic, TheLastElementCarriesTheBitLoads) {
  const auto& state = sourcePrestress().state;
  EXPECT_NEAR(state.lastElementAxialForce, -1e4,
              500.0);  // half an element of weight and the chord's inclination
  EXPECT_NEAR(state.lastElementTorque, -5e3, 10.0);
}

/// A string without bending stiffness on a helix (curvature kappa, constant inclination theta): its
/// effective tension decreases from the top by w cos(theta) per metre to the weight on bit, and it
/// presses on the wall with sqrt((F kappa)^2 + (w sin(theta))^2) per metre, since the normal of a
/// helix is horizontal. w is the weight in mud. Bending stiffness spreads the forces and does not
/// change both sums by more than a per cent.
TEST(ReferenceStatic, AgreesWithTheSoftString) {
  const auto scene = reference();
  const auto& state = sourcePrestress().state;
  constexpr double gravity = 9.81, mud = 1200, steel = 7900, weightOnBit = 1e4, radius = 85.1,
                   turned = 0.5 * constants::pi, length = 170.2;
  const double drop = std::sqrt(length * length - std::pow(radius * turned, 2)),
               pitch = drop / turned;
  const double curvature = radius / (radius * radius + pitch * pitch), down = drop / length,
               aside = std::sqrt(1 - down * down);
  double tension = -weightOnBit, pressed = 0, middle = 0;
  int compressed = 0;
  for (auto element = scene.string.elements.rbegin(); element != scene.string.elements.rend();
       ++element) {
    const auto& section = element->section();
    const double in = constants::pi * std::pow(section.innerRadius(), 2),
                 out = constants::pi * std::pow(section.outerRadius(), 2);
    const double weight = gravity * (steel * (out - in) - mud * out + mud * in);
    middle = tension + 0.5 * weight * down * element->length();
    compressed += middle < 0;
    pressed += std::hypot(middle * curvature, weight * aside) * element->length();
    tension += weight * down * element->length();
  }
  EXPECT_NEAR(state.topAxialForce, middle, 3e-3 * middle);
  EXPECT_NEAR(state.hookLoad, tension, 3e-3 * tension);
  EXPECT_NEAR(state.totalNormalForce, pressed, 2e-2 * pressed);
  EXPECT_EQ(state.compressedElements, compressed);
}

TEST(ReferenceStatic, BothRecipesFindTheSameState) {
  const auto state = [](const std::string& recipe) {
    return drillstring::solveStatic(
               reference({"Static/Tolerance=1e-12", "Static/Recipe=" + recipe}))
        .state.displacement;
  };
  const Vector expected = state("Continuation");
  EXPECT_LE((state("Source") - expected).norm(), 1e-11 * expected.norm());
}

TEST(ReferenceStatic, TheFullTangentBalancesTheTorque) {
  const auto full = drillstring::solveStatic(reference({"Path/Pre-stress=Full tangent"})).state;
  EXPECT_EQ(full.contactNodes, 82);
  // A rotation of the whole string about its curved axis must meet almost no resistance; K_a + K_g
  // alone resists with EI kappa^2 L.
  EXPECT_LT(std::abs(full.torqueBalanceDefect()), 0.005 * std::abs(full.topTorque));
  EXPECT_GT(std::abs(sourcePrestress().state.torqueBalanceDefect()),
            0.5 * std::abs(full.topTorque));
}

TEST(ReferenceStatic, ImposedNodesStrayFromTheAxisAndTouchElsewhere) {
  const auto stage = drillstring::solveStatic(reference({"Path/Mode=Imposed nodes"}));
  EXPECT_GT(stage.path.report.maxPositionError, 0.1);
  EXPECT_LT(stage.path.report.maxPositionError, 0.4);
  EXPECT_GE(stage.state.contactNodes, 73);
  EXPECT_LE(stage.state.contactNodes, 78);
}

}  // namespace ReferenceStaticTest
