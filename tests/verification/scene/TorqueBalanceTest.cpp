// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A spin of a section about its own axis causes no elastic force, however the string bends: the
/// torque at the top is the sum of the torques of bit and friction, on every mesh, at rest and in
/// motion.
#include <cmath>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/report/Log.hpp"
#include "tests/support/Scenes.hpp"
#include "tests/support/SourceFolder.hpp"

namespace TorqueBalanceTest {

using namespace tooljoint;

drillstring::Scene buildAndHold(const std::vector<std::string>& overrides) {
  return drillstring::readScene(testing_::sourceFolder() + "/xml/build_hold_1400m.xml", overrides);
}

/// A well with its share of curvature, tension and compression.
struct WellCase {
  const char* name;
  std::vector<std::string> overrides;
};
const WellCase wells[] = {
    {"3 deg/30 m to 60 deg", {}},
    {"4 deg/30 m to 80 deg, 2500 m, no bit torque",
     {"Well/Arc/Kick-off Depth=600", "Well/Arc/Build Rate=4 deg/30m",
      "Well/Arc/End Inclination=80 deg", "Well/Arc/Tangent Length=1500",
      "Drillstring/Assembly={260*stand}", "Loads/Torque On Bit=0"}},
    {"10 deg/30 m to 88 deg, 570 m, off bottom",
     {"Well/Arc/Kick-off Depth=100", "Well/Arc/Build Rate=10 deg/30m",
      "Well/Arc/End Inclination=88 deg", "Well/Arc/Tangent Length=300",
      "Drillstring/Assembly={60*stand}", "Loads/Torque On Bit=0", "Loads/Weight On Bit=0"}},
};

class TorqueBalance : public testing::TestWithParam<WellCase> {
 protected:
  static equilibrium::StaticState state(int elements) {
    auto overrides = GetParam().overrides;
    overrides.push_back("!Transient");
    overrides.push_back("Drillstring/Components/body/Elements=" + std::to_string(elements));
    return drillstring::solveStatic(buildAndHold(overrides)).state;
  }
};

/// A straight inclined hole has no torque, and rounding is not reported as torque.
TEST(TorqueOfAStraightHole, IsNone) {
  for (const char* azimuth : {"0 deg", "37 deg", "200 deg"}) {
    const auto scene = drillstring::readScene(
        testing_::sourceFolder() + "/xml/vertical_1000m.xml",
        {"!Transient", "!Reduction", "!Substructures", "!Study", "!Rotary Speed",
         "!Loads/Unbalance", "!Contact/Friction", "!Well/Arc", "Well/Trajectory=Vertical",
         "Well/Vertical/Length=1100", "Well/Vertical/Inclination=50 deg",
         std::string("Well/Vertical/Azimuth=") + azimuth, "Loads/Torque On Bit=0"});
    const auto stage = drillstring::solveStatic(scene);
    EXPECT_LT(stage.state.relativeTorqueDefect(), 1e-3) << azimuth;
  }
}

TEST_P(TorqueBalance, HoldsWithOneElementPerBody) {
  const auto coarse = state(1);
  EXPECT_GT(std::abs(coarse.totalFrictionTorque), 1e3);
  EXPECT_NEAR(coarse.topTorque, coarse.topTorqueEquilibrium(),
              0.01 * std::abs(coarse.topTorqueEquilibrium()));
  EXPECT_LT(coarse.relativeTorqueDefect(), 0.005);
}

TEST_P(TorqueBalance, HoldsBetterWithFive) {
  const auto fine = state(5);
  EXPECT_NEAR(fine.topTorque, fine.topTorqueEquilibrium(),
              0.002 * std::abs(fine.topTorqueEquilibrium()));
}

INSTANTIATE_TEST_SUITE_P(Wells, TorqueBalance, testing::ValuesIn(wells), [](const auto& instance) {
  return "well" + std::to_string(instance.index);
});

/// Every scene of strings except the published case, which uses the paper's pre-stress.
TEST(TorqueOfTheDecks, BalancesWithinHalfAPerCent) {
  for (const char* deck :
       {"xml/build_hold_1400m.xml", "xml/cms_variants.xml", "xml/inclined_1000m.xml",
        "xml/stress_170m.xml", "xml/study_helical_170m.xml", "xml/vertical_1000m.xml",
        "examples/01_vertical_string/deck.xml", "examples/03_survey_well/deck.xml",
        "tests/effects/scene.xml", "tests/study/study.xml"}) {
    const auto scene = drillstring::readScene(testing_::sourceFolder() + "/" + deck, {});
    EXPECT_EQ(scene.path.prestress, path::Prestress::FullTangent) << deck;
    const auto state = drillstring::findEquilibrium(scene).state;
    EXPECT_LT(state.relativeTorqueDefect(), 0.005)
        << deck << ": " << state.torqueBalanceDefect() << " N m of " << state.torqueScale;
  }
}

/// Soft string (Johancsik, Friesen and Dawson 1984) from the bit up: q = |T kappa n + w (g - (g.t)
/// t)| per length is the load on the wall. A rotating string climbs until normal force and friction
/// together carry it, N sqrt(1 + mu^2) = q; its friction torque is mu N r with r of the joints,
/// where it is in contact. Excluded are the bit, which a support holds, and the ends of the bend.
TEST(TorqueOfTheWell, IsThatOfTheSoftString) {
  const auto scene = buildAndHold({"!Transient"});
  const auto state = drillstring::solveStatic(scene).state;
  double tension = -50e3, torque = 0.0;
  const auto& elements = scene.string.elements;
  const double mu =
      std::abs(scene.contactPoints.slidingAt(120.0 * constants::pi / 30.0).muStatic.front());
  double s = scene.string.length();
  for (auto element = elements.rbegin(); element != elements.rend(); ++element) {
    const int pieces = 20;
    // weight of body and joint spread over the stand
    const double weight =
        9.81 * 7850.0 * (9.0 * elements[0].section().area() + 0.5 * elements[1].section().area()) /
        9.5;
    for (int piece = 0; piece < pieces; ++piece) {
      const double ds = element->length() / pieces;
      const auto well = scene.well.trajectory().at(s - 0.5 * ds);
      const Vector3 g(0.0, 0.0, 1.0);
      torque +=
          mu / std::sqrt(1.0 + mu * mu) * 0.084 *
          (tension * well.curvature + weight * (g - g.dot(well.tangent) * well.tangent)).norm() *
          ds;
      tension += weight * g.dot(well.tangent) * ds;
      s -= ds;
    }
  }
  EXPECT_NEAR(-state.topTorqueEquilibrium(), 4e3 + torque, 0.01 * (4e3 + torque));
  EXPECT_NEAR(state.topAxialForce, tension, 0.01 * tension);
}

TEST(TorqueInMotion, AStringThatTurnsAtConstantSpeedStaysAtRest) {
  const auto scene = buildAndHold({"Transient/End Time=0.2", "Transient/Progress=false"});
  const auto stage = drillstring::solveStatic(scene);
  const auto motion = testing_::move(scene, drillstring::fullModel(stage));
  ASSERT_GT(motion.size(), 30U);
  for (const auto& sample : motion)
    EXPECT_LT((sample - stage.state.displacement).cwiseAbs().maxCoeff(),
              1e-6);  // the twist of the string is 2 rad, its sag centimetres
}

TEST(TorqueInMotion, ThePeakCoefficientWouldStartAJump) {
  const auto scene =
      buildAndHold({"Transient/End Time=0.2", "Transient/Progress=false", "Static/Friction=Peak"});
  const auto stage = drillstring::solveStatic(scene);
  const auto motion = testing_::move(scene, drillstring::fullModel(stage));
  EXPECT_GT((motion.back() - stage.state.displacement).cwiseAbs().maxCoeff(), 1e-3);
}

/// A static state with a torque imbalance at the top, as a fraction of the scale.
drillstring::StaticStage unbalanced(double share) {
  drillstring::StaticStage stage;
  stage.state.torqueScale = 1e4;
  stage.state.appliedTorque = -8e3;
  stage.state.topTorque = -8e3 + share * 1e4;
  return stage;
}

TEST(TorqueJudgement, WarnsAboveTwoPerCentAndRefusesAboveTen) {
  const auto scene = buildAndHold({});
  const auto warnings = [&](double share, const drillstring::Scene& of) {
    log::clearWarnings();
    drillstring::judgeTorqueBalance(of, unbalanced(share));
    return log::warnings().size();
  };
  EXPECT_EQ(warnings(0.019, scene), 0U);
  EXPECT_EQ(warnings(0.021, scene), 1U);
  EXPECT_EQ(warnings(-0.099, scene), 1U);
  EXPECT_THROW(drillstring::judgeTorqueBalance(scene, unbalanced(0.101)), ConvergenceError);
  EXPECT_THROW(drillstring::judgeTorqueBalance(scene, unbalanced(-0.101)), ConvergenceError);
  EXPECT_EQ(warnings(0.5, buildAndHold({"Path/Pre-stress=Axial and torque"})), 1U);
  log::clearWarnings();
}

}  // namespace TorqueBalanceTest
