// SPDX-License-Identifier: BSD-3-Clause
#include "parts/ReducedPart.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "common/Error.hpp"

namespace tooljoint::parts {

using model::DofLabel;

PartContent contentOf(const model::Substructure& part) {
  PartContent content;
  content.part = part;
  std::map<std::int64_t, std::size_t> sets;
  for (int i : part.interface) {
    const auto node = part.model.dofs[static_cast<std::size_t>(i)].entity;
    if (sets.emplace(node, content.interfaces.size()).second)
      content.interfaces.push_back({std::to_string(node), {}, {node}});
    content.interfaces[sets.at(node)].dofs.push_back(i);
  }
  return content;
}

namespace {

/// Labels of the coordinates: boundary dofs keep their labels, modes are numbered.
std::vector<DofLabel> coordinateLabels(const PartContent& original,
                                       const reduction::ReducedSubstructure& reduced) {
  std::vector<DofLabel> labels;
  int modes = 0;
  for (int i : reduced.basis->partition.boundary) {
    const auto& label = original.part.model.dofs[static_cast<std::size_t>(i)];
    labels.push_back(label.kind == DofLabel::Kind::Modal ? DofLabel::modal(0, modes++) : label);
  }
  for (int k = 0; k < reduced.modes; ++k) labels.push_back(DofLabel::modal(0, modes++));
  return labels;
}

}  // namespace

PartContent reducedContent(const PartContent& original,
                           const reduction::ReducedSubstructure& reduced) {
  if (reduced.derivedInterface)
    throw ModelError("Part \"" + reduced.name + "\" cannot be exported: its basis \"" +
                     reduced.report.basis +
                     "\" has no interface dofs among its coordinates. Choose another basis, for "
                     "example \"Craig-Bampton\".");
  const auto& kept = reduced.basis->partition.boundary;
  if (reduced.basis->vectors.rows() != original.part.model.size())
    throw Error(ExitCode::Internal, "The basis of an exported part has other dofs than the part.");
  PartContent out;
  out.part.name = reduced.name;
  auto& m = out.part.model;
  m = reduced.model;
  m.dofs = coordinateLabels(original, reduced);
  m.points.clear();
  out.omitted = original.omitted;
  for (const auto& set : reduced.model.points) out.omitted.push_back(set.name);

  // coordinates q + s: K_i s is added to the loads with the law of K_i
  Vector s = Vector::Zero(m.size());
  for (std::size_t k = 0; k < kept.size() && reduced.offset.size() > 0; ++k)
    s[static_cast<Eigen::Index>(k)] = reduced.offset[kept[k]];
  if (!s.isZero(0.0)) {
    for (const auto& term : m.stiffness)
      m.loads.push_back(
          {"reference state of boundary dofs: " + term.name, Vector(term.matrix * s), term.law});
    m.initialDisplacement += s;
    if (m.recovery.rows() > 0) m.recoveryOffset -= m.recovery * s;
  }
  // springs and stops keep the reference of the original, unless the scene computes its equilibrium
  if (original.part.reference.size() > 0) {
    Vector reference = Vector::Zero(m.size());
    for (std::size_t k = 0; k < kept.size(); ++k)
      reference[static_cast<Eigen::Index>(k)] = original.part.reference[kept[k]];
    if (!reference.isZero(0.0)) out.part.reference = reference;
  }

  const Vector offset =
      reduced.offset.size() > 0 ? reduced.offset : Vector(Vector::Zero(original.part.model.size()));
  out.basis.dofs = original.part.model.dofs;
  out.basis.vectors = reduced.basis->vectors;
  out.basis.offset = offset - reduced.basis->vectors * s;
  if (!original.basis.empty()) {
    out.basis.dofs = original.basis.dofs;
    out.basis.offset = original.basis.offset + original.basis.vectors * out.basis.offset;
    out.basis.vectors = original.basis.vectors * reduced.basis->vectors;
  }

  std::map<int, int> coordinate;
  for (std::size_t k = 0; k < kept.size(); ++k) coordinate[kept[k]] = static_cast<int>(k);
  std::vector<char> inSet(kept.size(), 0);
  for (const auto& set : original.interfaces) {
    InterfaceSet moved{set.name, {}, {}};
    for (int i : set.dofs) {
      const auto it = coordinate.find(i);
      if (it == coordinate.end()) continue;
      moved.dofs.push_back(it->second);
      inSet[static_cast<std::size_t>(it->second)] = 1;
      const auto node = original.part.model.dofs[static_cast<std::size_t>(i)].entity;
      if (std::find(moved.nodes.begin(), moved.nodes.end(), node) == moved.nodes.end())
        moved.nodes.push_back(node);
    }
    if (!moved.dofs.empty()) out.interfaces.push_back(std::move(moved));
  }
  for (std::size_t k = 0; k < kept.size(); ++k)
    (inSet[k] ? out.part.interface : out.part.retained).push_back(static_cast<int>(k));
  const auto known = nodesOf(out);
  for (const auto& [node, position] : original.positions)
    if (known.count(node) > 0)
      out.positions.emplace(node, position);  // a fixed node is no longer part of the model
  return out;
}

}  // namespace tooljoint::parts
