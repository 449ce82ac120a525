// SPDX-License-Identifier: BSD-3-Clause
#include "cases/nodes/NodeDofs.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Text.hpp"
#include "coupling/input/ComponentAxes.hpp"
#include "coupling/input/DofLookup.hpp"

namespace tooljoint::cases {

void declareNode(deck::ListSpec& list, const std::string& what) {
  list.text("Part", deck::Optional{},
            "Name of the part; needed where parts number their nodes on their own.")
      .integer("Node", deck::Required{}, deck::Range::atLeast(1),
               "Node " + what +
                   ": of a string counted from the surface, of a part as its file "
                   "numbers it.");
}

NodeDof readNode(const Teuchos::ParameterList& list) {
  NodeDof dof;
  dof.where = list.name();
  if (list.isParameter("Part")) dof.part = list.get<std::string>("Part");
  dof.node = list.get<int>("Node");
  if (list.isParameter("Component")) dof.component = list.get<std::string>("Component");
  return dof;
}

namespace {

/// Scene numbers of the nodes named in a deck: of one part, or of any part.
std::set<std::int64_t> numbersOf(const RestingCase& rest, const NodeDof& dof) {
  const auto parts = rest.parts().parts;
  const auto contents = rest.contents(parts);
  const auto names = coupling::namesOf(parts);
  std::set<std::int64_t> found;
  if (!dof.part.empty() && !contains(names, dof.part))
    throw DeckError(dof.where + coupling::noSuchPart(dof.part, names));
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (!dof.part.empty() && names[p] != dof.part) continue;
    const auto& theirs = contents[p].part.model.recoveryNodes;
    for (std::size_t i = 0; i < theirs.size(); ++i)
      if (theirs[i] == dof.node) found.insert(parts[p].model.recoveryNodes[i]);
  }
  return found;
}

/// At a released joint the recovery has the motion of the first part with the node.
void requireShown(const RestingCase& rest, const NodeDof& dof, std::int64_t number) {
  const auto joined = rest.parts();
  if (!joined.options.connections.releases(number, dof.component)) return;
  const auto names = coupling::namesOf(joined.parts);
  std::size_t first = 0;
  while (!contains(joined.parts[first].model.recoveryNodes, number)) ++first;
  if (dof.part == names[first]) return;
  throw DeckError(dof.where + " is " + dof.component + " of node " + std::to_string(dof.node) +
                  (dof.part.empty() ? "" : " of part " + inQuotes(dof.part)) +
                  ", which is released: results have it for part " + inQuotes(names[first]) +
                  " only. Name that part, or leave the nodes apart (without the joint and its "
                  "Releases) and join the other components by Coupling/Constraints.");
}

}  // namespace

NodeRow findRow(const RestingCase& rest, const model::SecondOrderModel& model, const NodeDof& dof) {
  const auto found = numbersOf(rest, dof);
  if (found.empty())
    throw DeckError(dof.where + "/Node is " + std::to_string(dof.node) + ", but " +
                    (dof.part.empty() ? "the scene" : "part " + inQuotes(dof.part)) +
                    " has no such node.");
  if (found.size() > 1)
    throw DeckError(dof.where + "/Node is " + std::to_string(dof.node) +
                    ", a number that several parts have. Name one of them with Part.");
  NodeRow row;
  row.number = *found.begin();
  const auto& names = model.componentNames;
  const auto it = std::find(names.begin(), names.end(), dof.component);
  if (it == names.end())
    throw DeckError(dof.where + "/Component is " + inQuotes(dof.component) +
                    ", but the nodes have the components " + quotedList(names) + ".");
  row.component = static_cast<int>(it - names.begin());
  requireShown(rest, dof, row.number);
  return row;
}

Vector coefficients(const model::SecondOrderModel& model, const NodeRow& row) {
  Vector c = Vector::Zero(model.size());
  const auto it = std::find(model.recoveryNodes.begin(), model.recoveryNodes.end(), row.number);
  if (it == model.recoveryNodes.end()) return c;
  const auto r = (it - model.recoveryNodes.begin()) *
                     static_cast<std::ptrdiff_t>(model.componentNames.size()) +
                 row.component;
  for (model::SharedSparse::InnerIterator entry(model.recovery, r); entry; ++entry)
    c[entry.col()] = entry.value();
  return c;
}

std::array<int, 2> lateralComponents(const model::SecondOrderModel& model,
                                     const std::string& axis) {
  const auto axes = coupling::componentAxes(model.componentNames).translation;
  const std::size_t along = axis == "x" ? 0 : axis == "y" ? 1 : 2;
  return {axes[(along + 1) % 3], axes[(along + 2) % 3]};
}

}  // namespace tooljoint::cases
