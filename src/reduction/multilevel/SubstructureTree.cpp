// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/multilevel/SubstructureTree.hpp"

#include <algorithm>
#include <utility>

#include "common/Parallel.hpp"
#include "linalg/factor/NestedDissection.hpp"
#include "reduction/project/Distribution.hpp"

namespace tooljoint::reduction {

namespace {

/// A subtree is divided further if the loads of the ranks differ by more than this factor.
constexpr double balanced = 1.15;
/// Largest number of subtrees per rank.
constexpr int mostSubtrees = 4;

linalg::Graph graphOf(const Sparse& K, const Sparse& M, const std::vector<int>& groups) {
  linalg::Graph graph;
  for (int g : groups) graph.weights.resize(std::max(graph.weights.size(), at(g) + 1), 0);
  for (int g : groups) ++graph.weights[at(g)];
  std::vector<std::vector<int>> neighbours(graph.weights.size());
  const auto join = [&](int row, int column, double value) {
    const int a = groups[at(row)], b = groups[at(column)];
    if (a == b || value == 0.0) return;
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}})
      if (auto& list = neighbours[at(from)]; list.empty() || list.back() != to) list.push_back(to);
  };
  forEachEntry(K, join);
  forEachEntry(M, join);
  graph.offsets.push_back(0);
  for (auto& list : neighbours) {
    makeUnique(list);
    graph.neighbours.insert(graph.neighbours.end(), list.begin(), list.end());
    graph.offsets.push_back(sizeOf(graph.neighbours));
    std::vector<int>().swap(list);
  }
  return graph;
}

/// The dissection as one list of numbers, for the communication between ranks.
std::vector<int> flat(const linalg::Dissection& cut) {
  std::vector<int> numbers{cut.pieces()};
  for (int i = 0; i < cut.pieces(); ++i) {
    numbers.insert(numbers.end(),
                   {cut.parent[at(i)], cut.leaf[at(i)], sizeOf(cut.vertices[at(i)])});
    numbers.insert(numbers.end(), cut.vertices[at(i)].begin(), cut.vertices[at(i)].end());
  }
  return numbers;
}

linalg::Dissection fromFlat(const std::vector<int>& numbers) {
  linalg::Dissection cut;
  auto next = numbers.begin() + 1;
  for (int i = 0; i < numbers.front(); ++i) {
    cut.parent.push_back(*next++);
    cut.leaf.push_back(static_cast<char>(*next++));
    const int count = *next++;
    cut.vertices.emplace_back(next, next + count);
    next += count;
  }
  return cut;
}

/// The tree without boundaries and owners.
SubstructureTree treeOf(const linalg::Dissection& cut, const std::vector<int>& groups) {
  SubstructureTree tree;
  tree.pieces.resize(at(cut.pieces()));
  std::vector<int> pieceOfGroup(groups.size(), -1);
  for (int i = 0; i < cut.pieces(); ++i) {
    for (int g : cut.vertices[at(i)]) pieceOfGroup[at(g)] = i;
    tree.pieces[at(i)].parent = cut.parent[at(i)];
    tree.pieces[at(i)].leaf = cut.leaf[at(i)] != 0;
    if (cut.parent[at(i)] >= 0) tree.pieces[at(cut.parent[at(i)])].children.push_back(i);
  }
  for (int d = 0; d < sizeOf(groups); ++d) {
    auto& dofs = tree.pieces[at(pieceOfGroup[at(groups[at(d)])])].dofs;
    tree.pieceOf.push_back(pieceOfGroup[at(groups[at(d)])]);
    tree.rowOf.push_back(sizeOf(dofs));
    dofs.push_back(d);
  }
  for (int i = cut.pieces() - 1; i >= 0; --i) {  // parents first
    auto& piece = tree.pieces[at(i)];
    if (piece.parent >= 0) piece.path = tree.pieces[at(piece.parent)].path;
    piece.path.push_back(i);
  }
  return tree;
}

/// Boundary of each piece: its neighbours and the boundaries of its children, without its own dofs.
void findBoundaries(const Sparse& K, const Sparse& M, SubstructureTree& tree) {
  std::vector<int> seen(at(tree.dofs()), -1);
  for (int i = 0; i < sizeOf(tree.pieces); ++i) {
    auto& piece = tree.pieces[at(i)];
    const auto add = [&](int dof) {
      if (tree.pieceOf[at(dof)] <= i || seen[at(dof)] == i) return;
      seen[at(dof)] = i;
      piece.boundary.push_back(dof);
    };
    for (int d : piece.dofs)
      for (const Sparse* A : {&K, &M})
        forEachInRow(*A, d, [&](int column, double value) {
          if (value != 0.0) add(column);
        });
    for (int child : piece.children)
      for (int dof : tree.pieces[at(child)].boundary) add(dof);
    std::sort(piece.boundary.begin(), piece.boundary.end(), [&](int a, int b) {
      return std::pair(tree.pieceOf[at(a)], a) < std::pair(tree.pieceOf[at(b)], b);
    });
  }
}

void shareOut(SubstructureTree& tree, int ranks) {
  const int count = sizeOf(tree.pieces);
  std::vector<int> weight(at(count), 0);
  for (int i = 0; i < count; ++i) {
    weight[at(i)] += sizeOf(tree.pieces[at(i)].dofs);
    if (tree.pieces[at(i)].parent >= 0) weight[at(tree.pieces[at(i)].parent)] += weight[at(i)];
  }
  std::vector<int> roots{count - 1}, owners;
  for (;;) {
    std::vector<int> weights;
    for (int r : roots) weights.push_back(weight[at(r)]);
    owners = assignOwners(weights, ranks);
    std::vector<double> load(at(ranks), 0.0);
    for (int k = 0; k < sizeOf(roots); ++k) load[at(owners[at(k)])] += weights[at(k)];
    const double most = *std::max_element(load.begin(), load.end());
    if (most * ranks <= balanced * weight.back() || sizeOf(roots) >= mostSubtrees * ranks) break;
    int heaviest = -1;
    for (int k = 0; k < sizeOf(roots); ++k)
      if (!tree.pieces[at(roots[at(k)])].leaf &&
          (heaviest < 0 || weights[at(k)] > weights[at(heaviest)]))
        heaviest = k;
    if (heaviest < 0) break;
    const auto& children = tree.pieces[at(roots[at(heaviest)])].children;
    roots.erase(roots.begin() + heaviest);
    roots.insert(roots.end(), children.begin(), children.end());
  }
  for (auto& piece : tree.pieces) piece.owner = SubstructureTree::everyRank;
  for (int k = 0; k < sizeOf(roots); ++k) tree.pieces[at(roots[at(k)])].owner = owners[at(k)];
  for (int i = count - 1; i >= 0; --i) {  // assigns whole subtrees
    auto& piece = tree.pieces[at(i)];
    if (piece.parent >= 0 && tree.pieces[at(piece.parent)].owner != SubstructureTree::everyRank)
      piece.owner = tree.pieces[at(piece.parent)].owner;
  }
}

}  // namespace

int SubstructureTree::leaves() const {
  return static_cast<int>(
      std::count_if(pieces.begin(), pieces.end(), [](const auto& piece) { return piece.leaf; }));
}

int SubstructureTree::separatorDofs() const {
  int sum = 0;
  for (const auto& piece : pieces) sum += piece.leaf ? 0 : sizeOf(piece.dofs);
  return sum;
}

bool SubstructureTree::mine(int piece) const {
  const int owner = pieces[at(piece)].owner;
  return owner == everyRank || owner == parallel::rank();
}

SubstructureTree cutIntoTree(const Sparse& K, const Sparse& M, const std::vector<int>& groups,
                             int parts) {
  std::vector<int> numbers;
  parallel::agree([&] {
    if (parallel::rank() == 0) numbers = flat(linalg::dissect(graphOf(K, M, groups), parts));
  });
  parallel::broadcast(numbers);
  SubstructureTree tree = treeOf(fromFlat(numbers), groups);
  findBoundaries(K, M, tree);
  shareOut(tree, parallel::size());
  return tree;
}

}  // namespace tooljoint::reduction
