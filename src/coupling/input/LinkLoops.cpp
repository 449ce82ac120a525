// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/input/LinkLoops.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "common/Error.hpp"
#include "common/Index.hpp"

namespace tooljoint::coupling {

namespace {

/// A loop counts as closed if its gap is below this fraction of its longest path.
constexpr double closed = 1e-6;

std::string text(const Vector3& v) { return fmt::format("({:g}, {:g}, {:g}) m", v[0], v[1], v[2]); }

}  // namespace

std::pair<LinkLoops::Node, Vector3> LinkLoops::rootOf(const Node& node) const {
  Node root = node;
  Vector3 way = Vector3::Zero();
  for (auto it = from_.find(root); it != from_.end(); it = from_.find(root)) {
    way += it->second.second;
    root = it->second.first;
  }
  return {root, way};
}

/// True if the nodes have rotations that displace the end of an arm of this length.
bool LinkLoops::turns(const Vector3& gap) const {
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    if (axes_.translation[at(a)] < 0) continue;
    if (axes_.rotation[at(b)] >= 0 && gap[c] != 0.0) return true;
    if (axes_.rotation[at(c)] >= 0 && gap[b] != 0.0) return true;
  }
  return false;
}

void LinkLoops::add(const Node& from, const Node& to, const Vector3& arm, const std::string& what) {
  const auto [first, toFrom] = rootOf(from);
  const auto [second, toTo] = rootOf(to);
  if (first != second) {
    from_[second] = {first, toFrom + arm - toTo};
    return;
  }
  const Vector3 known = toTo - toFrom, gap = arm - known;
  const double size = std::max({arm.norm(), toTo.norm(), toFrom.norm()});
  if (gap.norm() <= closed * size || !turns(gap)) return;
  throw ModelError(
      what + " leads along " + text(arm) + ", but " +
      (from == to ? std::string("its ends are one node: the joints put them in one place")
                  : "the other links between its nodes lead along " + text(known)) +
      ". Together they would hold the rotations of these nodes. Correct the arm, or leave the link "
      "out.");
}

}  // namespace tooljoint::coupling
