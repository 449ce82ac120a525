// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Elements below partly released joints, whose strain is in no result.
#include <gtest/gtest.h>

#include "substructures/drillstring/figures/BendingElements.hpp"
#include "substructures/drillstring/scene/Stages.hpp"
#include "tests/support/Scenes.hpp"
#include "tests/support/SourceFolder.hpp"

namespace ReleasedJointsTest {

using namespace tooljoint;

TEST(ReleasedJoints, HaveTheBendingOfTheNextElementBelow) {
  // a hinge at node 5 and a slide at node 9
  const auto scene =
      drillstring::readScene(testing_::sourceFolder() + "/tests/effects/coupling.xml", {});
  const auto stage = drillstring::findEquilibrium(scene);
  const auto below = drillstring::elementsBelowReleases(scene, stage);
  EXPECT_EQ(below, (std::vector<int>{4, 8}));
  const auto places = drillstring::bendingPlaces(scene.string, stage.path, below);
  for (const std::size_t e : {std::size_t{4}, std::size_t{8}}) {
    EXPECT_LT(places[e].depth, places[e + 1].depth);
    for (std::size_t axis : {0, 1})
      EXPECT_EQ(places[e].moment[axis].front().node, places[e + 1].moment[axis].front().node);
  }
  EXPECT_NE(places[3].moment[0].front().node, places[4].moment[0].front().node);
}

}  // namespace ReleasedJointsTest
