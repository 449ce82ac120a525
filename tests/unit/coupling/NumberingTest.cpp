// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Cuthill-McKee numbering.
#include "coupling/assembly/Numbering.hpp"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>

namespace NumberingTest {

using tooljoint::coupling::cuthillMcKee;
using Edges = std::vector<std::pair<int, int>>;

int width(const std::vector<int>& order, const Edges& edges) {
  std::vector<int> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    place[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
  int widest = 0;
  for (const auto& [a, b] : edges)
    widest = std::max(
        widest, std::abs(place[static_cast<std::size_t>(a)] - place[static_cast<std::size_t>(b)]));
  return widest;
}

TEST(CuthillMcKee, ChainFromItsLowerEnd) {
  EXPECT_EQ(cuthillMcKee(5, {{0, 1}, {1, 2}, {2, 3}, {3, 4}}), (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(cuthillMcKee(5, {{3, 0}, {0, 4}, {4, 1}, {1, 2}}), (std::vector<int>{2, 1, 4, 0, 3}));
}

TEST(CuthillMcKee, ScrambledGridIsNarrow) {
  // 30 x 3 grid with scrambled numbers.
  const int rows = 30, columns = 3, n = rows * columns;
  const auto id = [&](int r, int c) { return (37 * (r * columns + c) + 11) % n; };
  Edges edges;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      if (r + 1 < rows) edges.emplace_back(id(r, c), id(r + 1, c));
      if (c + 1 < columns) edges.emplace_back(id(r, c), id(r, c + 1));
    }
  auto order = cuthillMcKee(n, edges);
  EXPECT_LE(width(order, edges), columns + 1);
  std::sort(order.begin(), order.end());
  for (int i = 0; i < n; ++i)
    EXPECT_EQ(order[static_cast<std::size_t>(i)], i) << "every group once";
}

TEST(CuthillMcKee, SeparateGroupsFollowEachOther) {
  EXPECT_EQ(cuthillMcKee(4, {{2, 3}}), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_TRUE(cuthillMcKee(0, {}).empty());
}

}  // namespace NumberingTest
