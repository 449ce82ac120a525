// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Which nodes stay physical.
#include "substructures/drillstring/Partition.hpp"

#include <gtest/gtest.h>
#include <limits>

#include "tests/unit/drillstring/Decks.hpp"

namespace PartitionTest {

using namespace tooljoint;
using namespace tooljoint::drillstring;
using namespace tooljoint::drillstring::testing;

/// Four components of five elements, 1 m each: nodes 0 to 20 at depths 0 to 20 m.
DrillString string() {
  return build(list("Components", tube("pipe", 5.0, 5, 0.06, 0.05)) + array("Assembly", "4*pipe"));
}

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

TEST(Partition, KeepsEveryNodeBelowADepth) {
  const DrillString s = string();
  PartitionRules rules;
  rules.keepFullBelow = 17.0;
  EXPECT_EQ(wholeNodes(retainedDofs(s, rules, far(s))), (std::vector<int>{17, 18, 19, 20}));
  rules.keepFullBelow = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(retainedDofs(s, rules, far(s)).empty());
}

// Ends of parts at nodes 0, 5, 10, 15, 20; node 7 is near the wall: runs 1-4, 6, 8-9, 11-14, 16-19.
TEST(Partition, KeepsShortRunsBetweenKeptNodes) {
  const DrillString s = string();
  PartitionRules rules;
  auto state = far(s);
  state.gap[7] = 1e-3;
  rules.minimumReducedRun = 2;
  EXPECT_EQ(wholeNodes(retainedDofs(s, rules, state)), (std::vector<int>{6, 7}));
  rules.minimumReducedRun = 3;
  EXPECT_EQ(wholeNodes(retainedDofs(s, rules, state)), (std::vector<int>{6, 7, 8, 9}));
  rules.minimumReducedRun = 5;
  EXPECT_EQ(wholeNodes(retainedDofs(s, rules, state)),
            (std::vector<int>{1, 2, 3, 4, 6, 7, 8, 9, 11, 12, 13, 14, 16, 17, 18, 19}));
}

// Nodes kept by each rule of Retained Nodes: gaps of 3 mm, -1 mm and 20 mm at nodes 3, 7 and 12;
// node 9 carries a gauge.
TEST(Partition, RetainsNodesByTheirGapTheirContactOrTheirGauge) {
  DrillString s = string();
  s.nodes[9].gauge = true;
  NodeState state = far(s);
  state.gap[3] = 3e-3;
  state.gap[7] = -1e-3;
  state.gap[12] = 0.02;
  state.gap[15] = 1e-3;
  state.candidate[15] = 0;  // held on the axis
  PartitionRules rules;
  rules.keepFullBelow = std::numeric_limits<double>::infinity();
  const auto kept = [&](const std::string& rule) {
    rules.retainedNodes = rule;
    return wholeNodes(retainedDofs(s, rules, state));
  };
  rules.retainedGap = 0.01;
  EXPECT_EQ(kept("Gap"), (std::vector<int>{3, 7}));
  rules.retainedGap = 0.03;
  EXPECT_EQ(kept("Gap"), (std::vector<int>{3, 7, 12}));
  EXPECT_EQ(kept("Static contacts"), (std::vector<int>{7}));
  EXPECT_EQ(kept("Gauges"), (std::vector<int>{9}));
  EXPECT_EQ(kept("All").size(), 20u);
  rules.nodeList = {5, 3, 5};
  EXPECT_EQ(kept("List"), (std::vector<int>{2, 4}));
}

TEST(Partition, RetainsTheComponentsAskedForAndLoadedDofs) {
  const DrillString s = string();
  NodeState state = far(s);
  state.gap[7] = -1e-3;
  state.loadedDofs = {6 * 4 + 1};
  PartitionRules rules;
  rules.keepFullBelow = std::numeric_limits<double>::infinity();
  rules.retainedNodes = "Static contacts";
  rules.retain = Retain::Contact;
  EXPECT_EQ(retainedDofs(s, rules, state), (std::vector<int>{25, 42, 43, 47}));
  rules.axialContact = true;
  EXPECT_EQ(retainedDofs(s, rules, state), (std::vector<int>{25, 42, 43, 44, 47}));
  rules.retain = Retain::Translations;
  EXPECT_EQ(retainedDofs(s, rules, state), (std::vector<int>{25, 42, 43, 44}));
  rules.axialContact = false;
  EXPECT_EQ(retainedDofs(s, rules, state), (std::vector<int>{25, 42, 43}));
}

// Elements count from 0: a cut at node 6 (1-based) ends element 4.
TEST(Partition, CutsAtNodesComponentsOrLengths) {
  const DrillString s = string();
  PartitionRules rules;
  const auto ranges = [&] {
    std::vector<std::pair<int, int>> out;
    for (const auto& part : cutParts(s, rules))
      out.emplace_back(part.firstElement, part.lastElement);
    return out;
  };
  using Ranges = std::vector<std::pair<int, int>>;
  rules.rule = "Single";
  EXPECT_EQ(ranges(), (Ranges{{0, 19}}));
  rules.rule = "By component";
  EXPECT_EQ(ranges(), (Ranges{{0, 4}, {5, 9}, {10, 14}, {15, 19}}));
  rules.rule = "By nodes";
  rules.cutNodes = {6, 14};
  EXPECT_EQ(ranges(), (Ranges{{0, 4}, {5, 12}, {13, 19}}));
  rules.rule = "By length";
  rules.length = 8.0;
  EXPECT_EQ(ranges(), (Ranges{{0, 9}, {10, 19}}));
  rules.length = 12.0;
  EXPECT_EQ(ranges(), (Ranges{{0, 19}})) << "a short rest joins the last part";
}

}  // namespace PartitionTest
