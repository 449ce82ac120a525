// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/factor/NestedDissection.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <numeric>
#include <scotch.h>
#include <string>
#include <utility>

#include "common/Error.hpp"
#include "common/Index.hpp"

namespace tooljoint::linalg {

namespace {

/// Allowed deviation of the parts of a cut from half of the weight.
constexpr double imbalance = 0.1;

/// Two sides and their separator, as vertices of the whole graph.
struct Cut {
  std::vector<int> left, right, separator;
};

void require(int status, const char* call) {
  if (status != 0)
    throw Error(ExitCode::Internal, std::string("Scotch could not cut a graph: ") + call +
                                        " returned " + std::to_string(status) + ".");
}

int weightOf(const Graph& graph, const std::vector<int>& vertices) {
  int sum = 0;
  for (int v : vertices) sum += graph.weights[at(v)];
  return sum;
}

/// The subgraph of these vertices (increasing).
Graph induced(const Graph& graph, const std::vector<int>& vertices) {
  std::vector<int> number(at(graph.size()), -1);
  for (int i = 0; i < sizeOf(vertices); ++i) number[at(vertices[at(i)])] = i;
  Graph part;
  part.offsets.push_back(0);
  for (int v : vertices) {
    for (int k = graph.offsets[at(v)]; k < graph.offsets[at(v + 1)]; ++k)
      if (const int w = number[at(graph.neighbours[at(k)])]; w >= 0) part.neighbours.push_back(w);
    part.offsets.push_back(sizeOf(part.neighbours));
    part.weights.push_back(graph.weights[at(v)]);
  }
  return part;
}

/// Connected component of each vertex.
std::vector<int> components(const Graph& graph, int& count) {
  std::vector<int> component(at(graph.size()), -1), open;
  count = 0;
  for (int start = 0; start < graph.size(); ++start) {
    if (component[at(start)] >= 0) continue;
    component[at(start)] = count;
    open.assign(1, start);
    while (!open.empty()) {
      const int v = open.back();
      open.pop_back();
      for (int k = graph.offsets[at(v)]; k < graph.offsets[at(v + 1)]; ++k)
        if (int& of = component[at(graph.neighbours[at(k)])]; of < 0) {
          of = count;
          open.push_back(graph.neighbours[at(k)]);
        }
    }
    ++count;
  }
  return component;
}

/// One level of nested dissection of a connected graph: 0 and 1 are the sides, 2 the separator.
std::vector<int> bisect(Graph& graph) {
  const int n = graph.size();
  SCOTCH_Context context;
  SCOTCH_Graph whole, bound;
  SCOTCH_Strat strategy;
  require(SCOTCH_contextInit(&context), "contextInit");
  SCOTCH_contextRandomReset(&context);
  require(SCOTCH_contextOptionSetNum(&context, SCOTCH_OPTIONNUMDETERMINISTIC, 1), "option");
  require(SCOTCH_contextThreadSpawn(&context, 1, nullptr), "contextThreadSpawn");
  require(SCOTCH_graphInit(&whole), "graphInit");
  require(SCOTCH_graphInit(&bound), "graphInit");
  require(SCOTCH_graphBuild(&whole, 0, n, graph.offsets.data(), nullptr, graph.weights.data(),
                            nullptr, sizeOf(graph.neighbours), graph.neighbours.data(), nullptr),
          "graphBuild");
  require(SCOTCH_contextBindGraph(&context, &whole, &bound), "contextBindGraph");
  require(SCOTCH_stratInit(&strategy), "stratInit");
  require(SCOTCH_stratGraphOrderBuild(&strategy,
                                      SCOTCH_STRATLEVELMAX | SCOTCH_STRATLEVELMIN |
                                          SCOTCH_STRATLEAFSIMPLE | SCOTCH_STRATSEPASIMPLE,
                                      1, imbalance),
          "stratGraphOrderBuild");
  std::vector<SCOTCH_Num> permutation(at(n)), inverse(at(n)), first(at(n + 1)), above(at(n));
  SCOTCH_Num blocks = 0;
  require(SCOTCH_graphOrder(&bound, &strategy, permutation.data(), inverse.data(), &blocks,
                            first.data(), above.data()),
          "graphOrder");
  SCOTCH_stratExit(&strategy);
  SCOTCH_graphExit(&bound);
  SCOTCH_graphExit(&whole);
  SCOTCH_contextExit(&context);

  // The last block is the root; the blocks below it go to the lighter side.
  std::vector<int> side(at(n), 2);
  int load[2] = {0, 0};
  for (SCOTCH_Num b = 0; b + 1 < blocks; ++b) {
    const int to = load[0] <= load[1] ? 0 : 1;
    for (SCOTCH_Num i = first[at(b)]; i < first[at(b + 1)]; ++i) {
      side[at(inverse[at(i)])] = to;
      load[to] += graph.weights[at(inverse[at(i)])];
    }
  }
  return side;
}

/// Distributes the components of a disconnected graph, heaviest first, to the lighter side.
std::vector<int> dealComponents(const Graph& graph, const std::vector<int>& component, int count) {
  std::vector<int> weight(at(count), 0), side(at(count), 0), result(at(graph.size()));
  for (int v = 0; v < graph.size(); ++v) weight[at(component[at(v)])] += graph.weights[at(v)];
  std::vector<int> order = range(count);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return weight[at(a)] > weight[at(b)]; });
  int load[2] = {0, 0};
  for (int c : order) {
    side[at(c)] = load[0] <= load[1] ? 0 : 1;
    load[side[at(c)]] += weight[at(c)];
  }
  for (int v = 0; v < graph.size(); ++v) result[at(v)] = side[at(component[at(v)])];
  return result;
}

/// Neither side is empty, or there is no cut.
Cut cut(const Graph& graph, const std::vector<int>& vertices) {
  Graph part = induced(graph, vertices);
  int count = 0;
  const auto component = components(part, count);
  const auto side = count > 1 ? dealComponents(part, component, count) : bisect(part);
  Cut result;
  for (int i = 0; i < sizeOf(vertices); ++i)
    (side[at(i)] == 0   ? result.left
     : side[at(i)] == 1 ? result.right
                        : result.separator)
        .push_back(vertices[at(i)]);
  return result;
}

struct Piece {
  std::vector<int> vertices;
  int left = -1, right = -1;
  bool whole = false;  ///< cannot be cut
};

}  // namespace

Dissection dissect(const Graph& graph, int parts) {
  std::vector<Piece> pieces(1);
  pieces[0].vertices = range(graph.size());
  for (int leaves = 1; leaves < parts; ++leaves) {
    int heaviest = -1, most = 0;
    for (int i = 0; i < sizeOf(pieces); ++i) {
      const Piece& piece = pieces[at(i)];
      if (piece.left >= 0 || piece.whole) continue;
      const int weight = weightOf(graph, piece.vertices);
      if (weight > most) heaviest = i, most = weight;
    }
    if (heaviest < 0) break;
    Cut found = cut(graph, pieces[at(heaviest)].vertices);
    if (found.left.empty() || found.right.empty()) {
      pieces[at(heaviest)].whole = true;
      --leaves;
      continue;
    }
    pieces[at(heaviest)].vertices = std::move(found.separator);
    pieces[at(heaviest)].left = sizeOf(pieces);
    pieces.emplace_back().vertices = std::move(found.left);
    pieces[at(heaviest)].right = sizeOf(pieces);
    pieces.emplace_back().vertices = std::move(found.right);
  }

  Dissection result;
  const std::function<int(int)> place = [&](int i) {
    const bool leaf = pieces[at(i)].left < 0;
    const int left = leaf ? -1 : place(pieces[at(i)].left);
    const int right = leaf ? -1 : place(pieces[at(i)].right);
    const int number = result.pieces();
    result.vertices.push_back(std::move(pieces[at(i)].vertices));
    result.parent.push_back(-1);
    result.leaf.push_back(leaf ? 1 : 0);
    for (int child : {left, right})
      if (child >= 0) result.parent[at(child)] = number;
    return number;
  };
  place(0);
  return result;
}

}  // namespace tooljoint::linalg
