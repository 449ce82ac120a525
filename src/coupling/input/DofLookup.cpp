// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/input/DofLookup.hpp"

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Text.hpp"

namespace tooljoint::coupling {

using model::DofLabel;

std::string describe(const PartDof& dof) {
  return dof.component + " of node " + std::to_string(dof.node) +
         (dof.part.empty() ? "" : " of part \"" + dof.part + "\"");
}

DofLookup::DofLookup(const std::vector<AlignedPart>& alignedParts) : alignedParts_(alignedParts) {}

std::string noSuchPart(const std::string& name, const std::vector<std::string>& names) {
  const auto meant = closest(name, names);
  return " names part \"" + name + "\", but no part has this name." +
         (meant.empty() ? " The parts are " + quotedList(names) + "."
                        : " Did you mean \"" + meant + "\"?");
}

int partNumber(const std::vector<std::string>& names, const std::string& name,
               const std::string& who) {
  const auto it = std::find(names.begin(), names.end(), name);
  if (it == names.end()) throw ModelError(who + noSuchPart(name, names));
  return static_cast<int>(it - names.begin());
}

int DofLookup::component(const std::string& name, const std::string& who) const {
  const auto it = std::find(names().begin(), names().end(), name);
  if (it != names().end()) return static_cast<int>(it - names().begin());
  throw ModelError(who + " names the component \"" + name +
                   "\", but the components of a node are " + quotedList(names()) + ".");
}

bool DofLookup::hasNode(int part, std::int64_t node) const {
  const auto& m = *alignedParts_[at(part)].model;
  return contains(m.recoveryNodes, node) ||
         std::any_of(m.dofs.begin(), m.dofs.end(), [&](const DofLabel& label) {
           return label.kind == DofLabel::Kind::Physical && label.entity == node;
         });
}

std::string DofLookup::describe(const PartDof& dof) const {
  const auto& nodeName = alignedParts_.front().model->nodeName;
  if (!nodeName) return coupling::describe(dof);
  auto label = DofLabel::physical(dof.node, 0);
  if (!dof.part.empty()) label = label.of(partNumber(namesOf(alignedParts_), dof.part, "A dof"));
  return dof.component + " of " + nodeName(label);
}

std::vector<DofPosition> DofLookup::find(const PartDof& dof, const std::string& who) const {
  const auto label = DofLabel::physical(dof.node, component(dof.component, who));
  std::vector<int> parts = range(sizeOf(alignedParts_));
  if (!dof.part.empty()) parts = {partNumber(namesOf(alignedParts_), dof.part, who)};
  std::vector<DofPosition> places;
  bool nodeKnown = false;
  for (int p : parts) {
    const AlignedPart& alignedPart = alignedParts_[at(p)];
    nodeKnown = nodeKnown || hasNode(p, dof.node);
    const auto& dofs = alignedPart.model->dofs;
    const auto it = std::find(dofs.begin(), dofs.end(), label);
    if (it == dofs.end()) continue;
    if (alignedPart.unturned.count(label) > 0)
      throw ModelError(who + " names " + describe(dof) +
                       ", but the frame of this node combines it with dofs that the part does not "
                       "have. Retain all components of the node, or remove its frame.");
    places.push_back({p, static_cast<int>(it - dofs.begin())});
  }
  if (!places.empty()) return places;
  const std::string where = dof.part.empty() ? "no part" : "part \"" + dof.part + "\"";
  if (nodeKnown)
    throw ModelError(
        who + " names " + describe(dof) +
        ", but this dof is fixed or a reduced interior dof. Retain the node, or name another dof.");
  throw ModelError(who + " names node " + std::to_string(dof.node) + ", but " + where + " has " +
                   (dof.part.empty() ? "such a node." : "no such node."));
}

}  // namespace tooljoint::coupling
