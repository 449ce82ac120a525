// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Curvature and stress of a string twisted by many radians. A spin of a section about its own axis
/// does not bend the string, whatever its size and its change along the string: under a torque T at
/// the bit alone
///
///     theta_z' = T/(G J),  kappa = that of the well,  sigma^2 = (E kappa R)^2 + 3 (T R/J)^2
#include <cmath>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "io/TextFile.hpp"
#include "substructures/beam/NodalDofs.hpp"
#include "substructures/beam/VonMises.hpp"
#include "substructures/drillstring/figures/BendingElements.hpp"
#include "tests/support/Scenes.hpp"
#include "tests/support/SourceFolder.hpp"

namespace TwistedStringTest {

using namespace tooljoint;

constexpr double length = 1000.0;    // [m]
constexpr double twist = 20.0;       // [rad] over all of it
constexpr double negligible = 1e-6;  // [1/m], a bend of a thousandth of a radian in all
/// The hinged ends carry no moment; this disturbance decays by a factor of 0.27 per node.
constexpr std::size_t nearEnds = 12;

/// A thousand metres of pipe without weight, its nodes held on the axis of a well.
drillstring::Scene twisted(int elements, std::vector<std::string> well, double torque) {
  well.insert(well.end(), {"!Contact", "!Rotary Speed", "!Transient", "!Damping", "Loads/Gravity=0",
                           "Loads/Weight On Bit=0", "Loads/Torque On Bit=" + std::to_string(torque),
                           "Drillstring/Assembly={body}", "Drillstring/Components/body/Length=1000",
                           "Drillstring/Components/body/Elements=" + std::to_string(elements)});
  std::string held;
  for (int node = 2; node <= elements; ++node)
    held += "<ParameterList name=\"node" + std::to_string(node) +
            "\"><Parameter name=\"Node\" type=\"int\" value=\"" + std::to_string(node) +
            "\"/><Parameter name=\"Dofs\" type=\"string\" value=\"u v\"/></ParameterList>";
  const std::string file = testing_::sourceFolder() + "/xml/build_hold_1400m.xml";
  const std::string root = "<ParameterList name=\"build_hold_1400m\">";
  std::string text = io::readText(file);
  text.insert(text.find(root) + root.size(),
              "<ParameterList name=\"Supports\">" + held + "</ParameterList>");
  return drillstring::readScene(deck::Deck::parse(text, file, drillstring::sceneSpec(), well));
}

/// `curvature` of the well [1/m].
void expectTwisted(int elements, const std::vector<std::string>& well, double curvature) {
  const double stiffness =
      twisted(elements, well, 0.0).string.elements[0].section().torsionalRigidity();
  const double torque = stiffness * twist / length;
  const auto scene = twisted(elements, well, torque);
  const auto stage = drillstring::findEquilibrium(scene);
  const auto& D = stage.state.displacement;
  EXPECT_NEAR(std::abs(D[D.size() - 1]), twist, 1e-3 * twist);
  const auto bending = drillstring::bendingElements(scene.string, stage.path);
  for (std::size_t e = 0; e < bending.size(); ++e) {
    if (curvature > 0.0 && (e < nearEnds || e + nearEnds >= bending.size())) continue;
    const auto& section = scene.string.elements[e].section();
    const auto i = static_cast<Eigen::Index>(e);
    const double moment = drillstring::meanMoment(bending[e], e, D).norm();
    EXPECT_NEAR(moment / bending[e].rigidity, curvature, negligible) << e;
    EXPECT_NEAR(std::abs(stage.state.torque(i)), torque, 1e-3 * torque) << e;
    const double shear = torque * section.outerRadius() / section.torsion(),
                 axial = section.youngModulus() * curvature * section.outerRadius();
    const double stress = beam::vonMises(section, stage.state.axialForce(i), stage.state.torque(i),
                                         moment / bending[e].rigidity);
    EXPECT_NEAR(stress, std::sqrt(axial * axial + 3.0 * shear * shear), 1e-3 * stress) << e;
  }
}

TEST(TwistedString, StraightHasShearAlone) {
  for (const int elements : {5, 100})  // 4 rad from node to node, and a fifth
    expectTwisted(elements, {"Well/Arc/Kick-off Depth=1200"}, 0.0);
}

TEST(TwistedString, BentHasTheCurvatureOfTheWell) {
  for (const int elements : {50, 100})
    expectTwisted(elements,
                  {"Well/Arc/Kick-off Depth=0", "Well/Arc/Build Rate=2 deg/30m",
                   "Well/Arc/End Inclination=80 deg", "Well/Arc/Tangent Length=100"},
                  2.0 * constants::degree / 30.0);
}

std::vector<Eigen::Vector2d> moments(const drillstring::Scene& scene) {
  const auto stage = drillstring::findEquilibrium(scene);
  const auto bending = drillstring::bendingElements(scene.string, stage.path);
  std::vector<Eigen::Vector2d> found;
  for (std::size_t e = 0; e < bending.size(); ++e)
    found.push_back(drillstring::meanMoment(bending[e], e, stage.state.displacement));
  return found;
}

/// 1425 m of pipe with tool joints in a well that builds to 60 degrees, without friction.
drillstring::Scene jointed(const std::string& torque) {
  return drillstring::readScene(
      testing_::sourceFolder() + "/xml/build_hold_1400m.xml",
      {"!Contact/Friction", "!Rotary Speed", "!Transient", "Loads/Torque On Bit=" + torque});
}

TEST(TwistedString, TwistDoesNotBendToolJoints) {
  // Joints are straighter than the well: the axes of their ends are not its tangents. 4 kN m twist
  // the string by some seven radians.
  const auto plain = moments(jointed("0")), twistedToo = moments(jointed("4 kN m"));
  double largest = 0.0, changed = 0.0;
  for (std::size_t e = 0; e < plain.size(); ++e) {
    largest = std::max(largest, plain[e].norm());
    changed = std::max(changed, (twistedToo[e] - plain[e]).norm());
  }
  EXPECT_LT(changed, 0.05 * largest);
}

TEST(TwistedString, TheWeightDoesNotTwistAHelix) {
  // 900 m without friction: the surface bears the torque of the bit
  const auto scene = testing_::reference(
      {"!Contact/Friction", "!Rotary Speed", "!Transient", "!Reduction", "!Substructures",
       "Path/Pre-stress=Full tangent", "Well/Helix/Radius=150", "Well/Helix/Angle=4",
       "Well/Helix/Length=1000", "Drillstring/Assembly={90*pipe}"});
  EXPECT_NEAR(drillstring::findEquilibrium(scene).state.topTorque, -5000.0, 0.002 * 5000.0);
}

}  // namespace TwistedStringTest
