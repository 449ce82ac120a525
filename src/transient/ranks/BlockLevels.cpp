// SPDX-License-Identifier: BSD-3-Clause
#include "transient/ranks/BlockLevels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/Index.hpp"

namespace tooljoint::transient {
namespace {

/// A cut may be displaced by this part of a rank's work to a level where fewer dofs are cut.
constexpr double slack = 0.05;

/// The blocks of a component, by their distance from `start`.
std::vector<std::vector<int>> levelsFrom(const BlockGraph& graph, int start) {
  std::vector<char> seen(graph.size(), 0);
  std::vector<std::vector<int>> levels{{start}};
  seen[at(start)] = 1;
  for (;;) {
    std::vector<int> next;
    for (int b : levels.back())
      for (int c : graph[at(b)])
        if (!seen[at(c)]) seen[at(c)] = 1, next.push_back(c);
    if (next.empty()) return levels;
    levels.push_back(std::move(next));
  }
}

/// Levels from one of the two ends farthest apart, the one with the smaller block number.
std::vector<std::vector<int>> levelsOf(const BlockGraph& graph, int anyBlock) {
  const auto least = [](const std::vector<int>& blocks) {
    return *std::min_element(blocks.begin(), blocks.end());
  };
  auto levels = levelsFrom(graph, anyBlock);
  for (;;) {
    auto others = levelsFrom(graph, least(levels.back()));
    if (others.size() > levels.size()) {
      levels = std::move(others);
      continue;
    }
    if (least(others.back()) > others.front().front()) return others;
    return levelsFrom(graph, least(others.back()));
  }
}

/// Levels of all components, one after the other.
std::vector<std::vector<int>> allLevels(const BlockGraph& graph) {
  std::vector<std::vector<int>> all;
  std::vector<char> done(graph.size(), 0);
  for (int b = 0; b < static_cast<int>(graph.size()); ++b) {
    if (done[at(b)]) continue;
    for (auto& level : levelsOf(graph, b)) {
      for (int c : level) done[at(c)] = 1;
      all.push_back(std::move(level));
    }
  }
  return all;
}

}  // namespace

BlockShares divide(const BlockGraph& graph, const std::vector<int>& width,
                   const std::vector<double>& work, int ranks) {
  const auto levels = allLevels(graph);
  const int count = static_cast<int>(levels.size());
  std::vector<int> levelOf(graph.size());
  for (int l = 0; l < count; ++l)
    for (int b : levels[at(l)]) levelOf[at(b)] = l;
  const auto isCut = [&](int b) {
    const auto& near = graph[at(b)];
    return std::any_of(near.begin(), near.end(),
                       [&](int c) { return levelOf[at(c)] > levelOf[at(b)]; });
  };
  std::vector<double> done{0.0};  // work of the levels before each level
  std::vector<int> cutWidth(at(count), 0);
  for (int l = 0; l < count; ++l) {
    done.push_back(done.back());
    for (int b : levels[at(l)]) {
      done.back() += work[at(b)];
      if (isCut(b)) cutWidth[at(l)] += width[at(b)];
    }
  }
  const double share = done.back() / ranks;
  std::vector<int> cuts;  // levels of the cuts
  for (int k = 1; k < ranks; ++k) {
    // the levels next to a cut belong to no cut
    const int first = cuts.empty() ? 1 : cuts.back() + 2, last = count - 2 * (ranks - k);
    int best = -1;
    double bestPrice = std::numeric_limits<double>::infinity();
    for (int l = first; l <= last; ++l) {
      const double off = std::abs(0.5 * (done[at(l)] + done[at(l + 1)]) - k * share) / share;
      const double price = (off <= slack ? 0.0 : 1e6 * off) + cutWidth[at(l)] + off;
      if (price < bestPrice) best = l, bestPrice = price;
    }
    if (best < 0) return {};
    cuts.push_back(best);
  }
  BlockShares shares;
  for (int b = 0; b < static_cast<int>(graph.size()); ++b) {
    const auto next = std::lower_bound(cuts.begin(), cuts.end(), levelOf[at(b)]);
    shares.rank.push_back(static_cast<int>(next - cuts.begin()));
    shares.cut.push_back(next != cuts.end() && *next == levelOf[at(b)] && isCut(b) ? 1 : 0);
  }
  return shares;
}

}  // namespace tooljoint::transient
