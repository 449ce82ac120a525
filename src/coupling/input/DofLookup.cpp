// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/input/DofLookup.hpp"

#include <algorithm>

#include "common/Error.hpp"
#include "common/Text.hpp"

namespace tooljoint::coupling {

using model::DofLabel;

std::string describe(const PartDof& dof) {
  return dof.component + " of node " + std::to_string(dof.node) +
         (dof.part.empty() ? "" : " of part \"" + dof.part + "\"");
}

DofLookup::DofLookup(const std::vector<AlignedPart>& alignedParts) : alignedParts_(alignedParts) {}

int DofLookup::partNumber(const std::string& name, const std::string& who) const {
  std::vector<std::string> names;
  for (const auto& alignedPart : alignedParts_) names.push_back(alignedPart.name);
  const auto it = std::find(names.begin(), names.end(), name);
  if (it != names.end()) return static_cast<int>(it - names.begin());
  const auto meant = closest(name, names);
  throw ModelError(who + " names part \"" + name + "\", but there is no such part." +
                   (meant.empty() ? " The parts are " + quotedList(names) + "."
                                  : " Did you mean \"" + meant + "\"?"));
}

int DofLookup::component(const std::string& name, const std::string& who) const {
  const auto it = std::find(names().begin(), names().end(), name);
  if (it != names().end()) return static_cast<int>(it - names().begin());
  throw ModelError(who + " names the component \"" + name +
                   "\", but the components of a node are " + quotedList(names()) + ".");
}

bool DofLookup::hasNode(int part, std::int64_t node) const {
  const auto& m = *alignedParts_[static_cast<std::size_t>(part)].model;
  return std::find(m.recoveryNodes.begin(), m.recoveryNodes.end(), node) != m.recoveryNodes.end() ||
         std::any_of(m.dofs.begin(), m.dofs.end(), [&](const DofLabel& label) {
           return label.kind == DofLabel::Kind::Physical && label.entity == node;
         });
}

std::vector<DofPosition> DofLookup::find(const PartDof& dof, const std::string& who) const {
  const auto label = DofLabel::physical(dof.node, component(dof.component, who));
  std::vector<int> parts;
  if (!dof.part.empty())
    parts.push_back(partNumber(dof.part, who));
  else
    for (std::size_t p = 0; p < alignedParts_.size(); ++p) parts.push_back(static_cast<int>(p));
  std::vector<DofPosition> places;
  bool nodeKnown = false;
  for (int p : parts) {
    const AlignedPart& alignedPart = alignedParts_[static_cast<std::size_t>(p)];
    nodeKnown = nodeKnown || hasNode(p, dof.node);
    const auto& dofs = alignedPart.model->dofs;
    const auto it = std::find(dofs.begin(), dofs.end(), label);
    if (it == dofs.end()) continue;
    if (alignedPart.unturned.count(label) > 0)
      throw ModelError(
          who + " names " + coupling::describe(dof) +
          ", which the frame of that node mixes with dofs the part does not have there. Retain "
          "all components of the node, or give it no frame.");
    places.push_back({p, static_cast<int>(it - dofs.begin())});
  }
  if (!places.empty()) return places;
  const std::string where = dof.part.empty() ? "no part" : "part \"" + dof.part + "\"";
  if (nodeKnown)
    throw ModelError(
        who + " names " + coupling::describe(dof) +
        ", but it is held there, or an inner dof that the reduction has taken away. Retain that "
        "node, or name another dof.");
  throw ModelError(who + " names node " + std::to_string(dof.node) + ", but " + where + " has " +
                   (dof.part.empty() ? "such a node." : "no such node."));
}

}  // namespace tooljoint::coupling
