// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Which nodes stay physical.
#include "substructures/string/Partition.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/string/Decks.hpp"

using namespace tooljoint;
using namespace tooljoint::string_;
using namespace tooljoint::string_::testing;

namespace {

/// Four components of five elements, 1 m each: nodes 0 to 20 at depths 0 to 20 m.
DrillString string() { return build(list("Components", tube("pipe", 5.0, 5, 0.06, 0.05)) + array("Assembly", "4*pipe")); }

NodeState far(const DrillString& string) {
  NodeState state;
  state.gap.assign(static_cast<std::size_t>(string.nodeCount()), 1.0);
  state.candidate.assign(static_cast<std::size_t>(string.nodeCount()), 1);
  return state;
}

std::vector<int> wholeNodes(const std::vector<int>& dofs) {
  std::vector<int> nodes;
  for (std::size_t i = 0; i < dofs.size(); i += 6) {
    EXPECT_EQ(dofs[i] % 6, 0);
    EXPECT_EQ(dofs[i + 5], dofs[i] + 5);
    nodes.push_back(dofs[i] / 6);
  }
  return nodes;
}

}  // namespace

TEST(Partition, KeepsEveryNodeBelowADepth) {
  const DrillString s = string();
  PartitionRules rules;
  rules.wholeBelow = 17.0;
  EXPECT_EQ(wholeNodes(retainedDofs(s, rules, far(s))), (std::vector<int>{17, 18, 19, 20}));
  rules.wholeBelow = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(retainedDofs(s, rules, far(s)).empty());
}

// Ends of parts at nodes 0, 5, 10, 15, 20; node 7 is near the wall: runs 1-4, 6, 8-9, 11-14, 16-19.
TEST(Partition, KeepsShortRunsBetweenKeptNodes) {
  const DrillString s = string();
  PartitionRules rules;
  auto state = far(s);
  state.gap[7] = 1e-3;
  rules.shortestRun = 2;
  EXPECT_EQ(wholeNodes(retainedDofs(s, rules, state)), (std::vector<int>{6, 7}));
  rules.shortestRun = 3;
  EXPECT_EQ(wholeNodes(retainedDofs(s, rules, state)), (std::vector<int>{6, 7, 8, 9}));
  rules.shortestRun = 5;
  EXPECT_EQ(wholeNodes(retainedDofs(s, rules, state)), (std::vector<int>{1, 2, 3, 4, 6, 7, 8, 9, 11, 12, 13, 14, 16, 17, 18, 19}));
}
