// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/assembly/Numbering.hpp"

#include <algorithm>

#include "common/Index.hpp"

namespace tooljoint::coupling {

namespace {

using Graph = std::vector<std::vector<int>>;

/// Distance of every group from `root`, -1 if it is not reached; and the reached groups in the
/// order of the walk.
struct Walk {
  std::vector<int> distance;
  std::vector<int> order;
};

Walk walk(const Graph& graph, int root) {
  Walk w;
  w.distance.assign(graph.size(), -1);
  w.distance[at(root)] = 0;
  w.order.push_back(root);
  for (std::size_t k = 0; k < w.order.size(); ++k)
    for (int next : graph[at(w.order[k])])
      if (w.distance[at(next)] < 0) {
        w.distance[at(next)] = w.distance[at(w.order[k])] + 1;
        w.order.push_back(next);
      }
  return w;
}

/// Group farthest from the root of `w`; among several the one with the fewest neighbours, then the
/// lowest.
int farthest(const Graph& graph, const Walk& w) {
  const int depth = w.distance[at(w.order.back())];
  int best = -1;
  for (int group : w.order) {
    if (w.distance[at(group)] != depth) continue;
    if (best < 0 || graph[at(group)].size() < graph[at(best)].size() ||
        (graph[at(group)].size() == graph[at(best)].size() && group < best))
      best = group;
  }
  return best;
}

int peripheral(const Graph& graph, int root) {
  Walk here = walk(graph, root);
  for (;;) {
    const int other = farthest(graph, here);
    const Walk there = walk(graph, other);
    const int depthHere = here.distance[at(here.order.back())];
    const int depthThere = there.distance[at(there.order.back())];
    if (depthThere <= depthHere) return std::min(root, other);
    root = other;
    here = there;
  }
}

}  // namespace

std::vector<int> cuthillMcKee(int size, const std::vector<std::pair<int, int>>& edges) {
  Graph graph(at(size));
  for (const auto& [a, b] : edges) {
    if (a == b) continue;
    graph[at(a)].push_back(b);
    graph[at(b)].push_back(a);
  }
  for (auto& neighbours : graph) makeUnique(neighbours);
  for (auto& neighbours : graph)
    std::stable_sort(neighbours.begin(), neighbours.end(),
                     [&](int a, int b) { return graph[at(a)].size() < graph[at(b)].size(); });

  std::vector<int> order;
  std::vector<char> done(at(size), 0);
  for (int root = 0; root < size; ++root) {
    if (done[at(root)]) continue;
    const Walk w = walk(graph, peripheral(graph, root));
    for (int group : w.order) done[at(group)] = 1;
    order.insert(order.end(), w.order.begin(), w.order.end());
  }
  return order;
}

}  // namespace tooljoint::coupling
