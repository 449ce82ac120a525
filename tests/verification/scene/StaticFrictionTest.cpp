// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Friction of the static state, determined by Static/Friction and by the rotation at the start of
/// the motion.
#include <cmath>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "tests/support/Scenes.hpp"
#include "tests/support/SourceFolder.hpp"

namespace StaticFrictionTest {

using namespace tooljoint;

using constants::rpm;

drillstring::Scene scene(std::vector<std::string> overrides) {
  overrides.insert(overrides.begin(),
                   {"Well/Arc/Kick-off Depth=0", "Well/Arc/Start Inclination=50 deg",
                    "Well/Arc/Build Rate=3 deg/30m", "Drillstring/Assembly={4*stand}"});
  return drillstring::readScene(testing_::sourceFolder() + "/xml/build_hold_1400m.xml", overrides);
}

const std::vector<std::string> fromRestLater{"Rotary Speed/Law=Table",
                                             "Rotary Speed/Table/Times={0, 100, 101}",
                                             "Rotary Speed/Table/Speeds={0, 0, -5}"};

TEST(StaticFriction, FollowsTheSpeedWithWhichTheMotionStarts) {
  const auto turning = drillstring::staticFriction(scene({}));
  EXPECT_EQ(turning.direction, 1.0);
  EXPECT_NEAR(turning.speed, 120.0 * rpm, 1e-12);

  const auto backwards =
      drillstring::staticFriction(scene({"Rotary Speed/Constant/Speed=-60 rpm"}));
  EXPECT_EQ(backwards.direction, -1.0);
  EXPECT_NEAR(backwards.speed, 60.0 * rpm, 1e-12);

  const auto laterStart = drillstring::staticFriction(
      scene({"Rotary Speed/Law=Table", "Rotary Speed/Table/Times={0, 1, 2}",
             "Rotary Speed/Table/Speeds={0, 3, 3}", "Transient/Start Time=1.5"}));
  EXPECT_NEAR(laterStart.speed, 3.0, 1e-12);
}

TEST(StaticFriction, IsThePeakFromRestInTheSenseOfTheFirstRotation) {
  const auto later = drillstring::staticFriction(scene(fromRestLater));
  EXPECT_EQ(later.direction, -1.0);
  EXPECT_EQ(later.speed, 0.0);
}

TEST(StaticFriction, PeakAndNoneAreTaken) {
  const auto peak = drillstring::staticFriction(scene({"Static/Friction=Peak"}));
  EXPECT_EQ(peak.direction, 1.0);
  EXPECT_EQ(peak.speed, 0.0);
  EXPECT_EQ(drillstring::staticFriction(scene({"Static/Friction=None"})).direction, 0.0);
}

TEST(StaticFriction, IsNoneWithoutRotation) {
  EXPECT_EQ(drillstring::staticFriction(scene({"!Rotary Speed"})).direction, 0.0);
  EXPECT_EQ(drillstring::staticFriction(scene({"Rotary Speed/Constant/Speed=0"})).direction, 0.0);
}

TEST(StaticFriction, OfAPointLawBeginsWithTheMotion) {
  const auto resting = drillstring::staticFriction(
      scene({"!Contact/Friction", "Contact/Law=Maxwell", "Contact/Maxwell/Stiffness=1e6",
             "Contact/Maxwell/Damping=1e4"}));
  EXPECT_EQ(resting.direction, 0.0);
  EXPECT_EQ(resting.why, "none: the friction of Maxwell begins with the motion");
}

/// The friction torque of the state is that of the coefficient, at every contact.
TEST(StaticFriction, ActsWithItsCoefficient) {
  const auto coefficient = [](const std::vector<std::string>& overrides) {
    const auto given = scene(overrides);
    const auto state = drillstring::solveStatic(given).state;
    EXPECT_GT(state.totalNormalForce, 1e3);
    return -state.totalFrictionTorque / (0.084 * state.totalNormalForce);  // contact is at the
                                                                           // joints
  };
  // eq. (9) of Nguyen et al. 2020 at v = Omega R_c = 4 pi 0.084 m/s, v_r = 0.1 m/s, mu_s = 0.3,
  // mu_d = 0.25
  const double v = 4.0 * constants::pi * 0.084, xi = std::sqrt(1.0 - 0.25 / 0.3),
               c = (1.0 - xi) / (2.0 * 0.1 * 0.25), q = 1.0 / (1.0 + c * v);
  const double sliding = v / 0.2 * ((1.0 - xi) * q + (1.0 + xi) * q * q);
  EXPECT_NEAR(sliding, 0.27, 0.02);
  EXPECT_NEAR(coefficient({}), sliding, 1e-9);
  EXPECT_NEAR(coefficient({"Rotary Speed/Constant/Speed=-120 rpm"}), -sliding, 1e-9);
  EXPECT_NEAR(coefficient({"Static/Friction=Peak"}), 0.3, 1e-9);
  EXPECT_NEAR(coefficient(fromRestLater), -0.3, 1e-9);
  EXPECT_EQ(coefficient({"Static/Friction=None"}), 0.0);
  EXPECT_EQ(coefficient({"!Rotary Speed"}), 0.0);
}

/// With friction along the hole the state is that of a string moved by its block.
TEST(StaticFriction, ActsAgainstTheBlockToo) {
  const auto moving = [](std::vector<std::string> overrides) {
    overrides.insert(overrides.end(),
                     {"Contact/Friction/Axial=true", "Top Drive/Block Speed=-0.2"});
    return scene(std::move(overrides));
  };
  const auto turning = drillstring::staticFriction(moving({}));
  EXPECT_EQ(turning.sliding.axialSpeed, -0.2);
  EXPECT_NEAR(turning.sliding.rotarySpeed, 120.0 * rpm, 1e-12);
  EXPECT_TRUE(turning.ofSlidingSpeed);
  const auto later = drillstring::staticFriction(moving(fromRestLater));
  EXPECT_EQ(later.direction, 0.0) << "it slides before it turns";
  EXPECT_EQ(later.sliding.rotarySpeed, 0.0);
  EXPECT_FALSE(drillstring::staticFriction(moving({"Static/Friction=None"})).sliding.any());
  EXPECT_EQ(drillstring::staticFriction(scene({"Contact/Friction/Axial=true"})).sliding.axialSpeed,
            0.0);

  const auto drag = [&](const std::vector<std::string>& overrides) {
    const auto state = drillstring::solveStatic(moving(overrides)).state;
    return state.axialFriction.sum() / state.totalNormalForce;
  };
  // mu_s, divided in the direction of sliding
  const double around = 4.0 * constants::pi * 0.084;
  EXPECT_NEAR(drag({"Static/Friction=Peak"}), 0.3 * 0.2 / std::hypot(0.2, around), 1e-9);
  EXPECT_NEAR(drag({"Static/Friction=Peak", "!Rotary Speed"}), 0.3, 1e-9);
  // eq. (9) of Nguyen et al. 2020 at 0.2 m/s, v_r = 0.1 m/s, mu_s = 0.3, mu_d = 0.25
  const double xi = std::sqrt(1.0 - 0.25 / 0.3), c = (1.0 - xi) / (2.0 * 0.1 * 0.25),
               q = 1.0 / (1.0 + c * 0.2);
  EXPECT_NEAR(drag({"!Rotary Speed"}), (1.0 - xi) * q + (1.0 + xi) * q * q, 1e-9);
  EXPECT_NEAR(drag(fromRestLater), (1.0 - xi) * q + (1.0 + xi) * q * q, 1e-9);
}

}  // namespace StaticFrictionTest
