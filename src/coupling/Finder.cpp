// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/Finder.hpp"

#include <algorithm>

#include "common/Error.hpp"
#include "common/Text.hpp"

namespace tooljoint::coupling {

using model::DofLabel;

std::string describe(const PartDof& dof) {
  return dof.component + " of node " + std::to_string(dof.node) +
         (dof.part.empty() ? "" : " of part \"" + dof.part + "\"");
}

Finder::Finder(const std::vector<Piece>& pieces) : pieces_(pieces) {}

int Finder::partNumber(const std::string& name, const std::string& who) const {
  std::vector<std::string> names;
  for (const auto& piece : pieces_) names.push_back(piece.name);
  const auto it = std::find(names.begin(), names.end(), name);
  if (it != names.end()) return static_cast<int>(it - names.begin());
  const auto meant = closest(name, names);
  throw ModelError(who + " names part \"" + name + "\", but there is no such part." +
                   (meant.empty() ? " The parts are " + quotedList(names) + "."
                                  : " Did you mean \"" + meant + "\"?"));
}

int Finder::component(const std::string& name, const std::string& who) const {
  const auto it = std::find(names().begin(), names().end(), name);
  if (it != names().end()) return static_cast<int>(it - names().begin());
  throw ModelError(who + " names the component \"" + name +
                   "\", but the components of a node are " + quotedList(names()) + ".");
}

bool Finder::hasNode(int part, std::int64_t node) const {
  const auto& m = *pieces_[static_cast<std::size_t>(part)].model;
  return std::find(m.recoveryNodes.begin(), m.recoveryNodes.end(), node) != m.recoveryNodes.end() ||
         std::any_of(m.dofs.begin(), m.dofs.end(), [&](const DofLabel& label) {
           return label.kind == DofLabel::Kind::Physical && label.entity == node;
         });
}

std::vector<Place> Finder::find(const PartDof& dof, const std::string& who) const {
  const auto label = DofLabel::physical(dof.node, component(dof.component, who));
  std::vector<int> parts;
  if (!dof.part.empty())
    parts.push_back(partNumber(dof.part, who));
  else
    for (std::size_t p = 0; p < pieces_.size(); ++p) parts.push_back(static_cast<int>(p));
  std::vector<Place> places;
  bool nodeKnown = false;
  for (int p : parts) {
    const Piece& piece = pieces_[static_cast<std::size_t>(p)];
    nodeKnown = nodeKnown || hasNode(p, dof.node);
    const auto& dofs = piece.model->dofs;
    const auto it = std::find(dofs.begin(), dofs.end(), label);
    if (it == dofs.end()) continue;
    if (piece.unturned.count(label) > 0)
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
