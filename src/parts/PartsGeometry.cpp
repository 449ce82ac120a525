// SPDX-License-Identifier: BSD-3-Clause
#include "parts/PartsGeometry.hpp"

#include <algorithm>

#include "common/Index.hpp"

namespace tooljoint::parts {

namespace {

using Positions = std::map<std::int64_t, Vector3>;
using Links = std::set<std::pair<std::int64_t, std::int64_t>>;

/// Half of the 26 neighbours of a node in a grid of hexahedra.
constexpr std::size_t gridLinksPerNode = 13;

/// Nodes of each part by their numbers in the scene: axes A of the part times the position x in the
/// part.
std::vector<Positions> turned(const PartsScene& scene, const std::vector<ImportedPart>& imported) {
  std::vector<Positions> out(scene.contents.size());
  for (const auto& [number, names] : scene.nodes)
    for (const auto& name : names) {
      const auto& known = scene.contents[at(name.part)].positions;
      const auto found = known.find(name.node);
      if (found != known.end())
        out[at(name.part)].emplace(number, imported[at(name.part)].axes * found->second);
    }
  return out;
}

void addLinks(const model::SecondOrderModel& model, Links& to) {
  Links own;
  std::set<std::int64_t> nodes;
  const auto physical = [](const model::DofLabel& dof) {
    return dof.kind == model::DofLabel::Kind::Physical;
  };
  for (const auto& dof : model.dofs)
    if (physical(dof)) nodes.insert(dof.entity);
  const std::size_t most = gridLinksPerNode * nodes.size();
  for (const auto& term : model.stiffness)
    forEachEntry(term.matrix, [&](int row, int column, double value) {
      const auto &a = model.dofs[at(row)], &b = model.dofs[at(column)];
      if (value != 0.0 && physical(a) && physical(b) && a.entity < b.entity && own.size() <= most)
        own.emplace(a.entity, b.entity);
    });
  if (own.size() <= most) to.insert(own.begin(), own.end());
}

}  // namespace

std::map<std::int64_t, Vector3> nodePositions(const PartsScene& scene,
                                              const std::vector<ImportedPart>& imported) {
  auto left = turned(scene, imported);
  Positions out;
  const auto shared = [&](const Positions& part) {
    return std::find_if(part.begin(), part.end(),
                        [&](const auto& node) { return out.count(node.first) > 0; });
  };
  while (!left.empty()) {
    auto next = std::find_if(left.begin(), left.end(),
                             [&](const Positions& part) { return shared(part) != part.end(); });
    if (next == left.end()) next = left.begin();
    // x_common = x_shared + A (x - x_shared in the part)
    const auto joined = shared(*next);
    const Vector3 origin =
        joined == next->end() ? Vector3(Vector3::Zero()) : out.at(joined->first) - joined->second;
    for (const auto& [number, position] : *next) out.emplace(number, origin + position);
    left.erase(next);
  }
  return out;
}

std::set<std::pair<std::int64_t, std::int64_t>> nodeLinks(const PartsScene& scene) {
  Links out;
  for (const auto& part : scene.parts) addLinks(part.model, out);
  return out;
}

}  // namespace tooljoint::parts
