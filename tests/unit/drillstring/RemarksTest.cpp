// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Remarks on valid scenes whose results are not those of a drillstring.
#include "substructures/drillstring/scene/Remarks.hpp"

#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "tests/support/SourceFolder.hpp"

namespace RemarksTest {

using namespace tooljoint;
using namespace tooljoint::drillstring;

Scene scene(const std::string& deck, const std::vector<std::string>& overrides) {
  return readScene(testing_::sourceFolder() + "/xml/" + deck, overrides);
}

TEST(Remarks, BitFrictionThatFallsWantsDampingThatRises) {
  const std::string deck = "stick_slip_2500m.xml", undamped = "Damping/Stiffness Coefficient=0";
  EXPECT_EQ(bitFrictionRemark(scene(deck, {})), "");
  EXPECT_NE(bitFrictionRemark(scene(deck, {undamped})).find("Give Damping/Stiffness Coefficient"),
            std::string::npos);
  EXPECT_EQ(bitFrictionRemark(scene(deck, {undamped, "Bit/Stribeck/Static Coefficient=0.5",
                                           "Bit/Stribeck/Dynamic Coefficient=0.5"})),
            "")
      << "friction that does not fall";
  EXPECT_EQ(bitFrictionRemark(scene("helical_170m.xml", {})), "") << "no law of the bit";
}

TEST(Remarks, UnbalanceTurnsWithTheSetSpeed) {
  const std::string deck = "first_run.xml";  // with unbalances
  EXPECT_EQ(unbalanceRemark(scene(deck, {})), "");
  EXPECT_NE(unbalanceRemark(scene(deck, {"Supports/Top=u v w", "Top Drive/Control=Torque",
                                         "Top Drive/Inertia=100", "Top Drive/Torque=1e4"}))
                .find("turns with Rotary Speed"),
            std::string::npos);
}

TEST(Remarks, ATorqueOnBitDrivesAStringThatTurnsTheOtherWay) {
  const std::string deck = "build_hold_1400m.xml", back = "Rotary Speed/Constant/Speed=-90 rpm";
  EXPECT_EQ(torqueOnBitRemark(scene(deck, {})), "");
  EXPECT_NE(torqueOnBitRemark(scene(deck, {back})).find("4 kN m, has a fixed direction and drives"),
            std::string::npos);
  EXPECT_EQ(torqueOnBitRemark(scene(deck, {back, "Loads/Torque On Bit=-4 kN m"})), "");
  EXPECT_EQ(torqueOnBitRemark(scene(deck, {back, "Loads/Torque On Bit=0"})), "");
  const std::string reverses = "Rotary Speed/Exponential/Final Speed=-60 rpm";
  EXPECT_NE(torqueOnBitRemark(scene("helical_170m.xml", {reverses})), "") << "during the motion";
}

TEST(Remarks, ThePublishedPreStressIsWrongInBends) {
  EXPECT_NE(prestressRemark(scene("helical_170m.xml", {})), "");
  EXPECT_EQ(prestressRemark(scene("helical_170m.xml", {"Path/Pre-stress=Full tangent"})), "");
}

}  // namespace RemarksTest
