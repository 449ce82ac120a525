// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/input/Connections.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Text.hpp"
#include "coupling/input/ComponentAxes.hpp"
#include "coupling/input/DofLookup.hpp"

namespace tooljoint::coupling {

namespace {

std::string nodeName(const PartNode& n) {
  return "node " + std::to_string(n.node) + (n.part.empty() ? "" : " of part \"" + n.part + "\"");
}

void needTranslations(const ComponentAxes& axes, const model::ComponentNames& names,
                      const std::string& what) {
  if (std::all_of(axes.translation.begin(), axes.translation.end(), [](int c) { return c < 0; }))
    throw ModelError(what + " needs translations, but none of the components " + quotedList(names) +
                     " is a translation. Name them u, v, w (and theta_x, theta_y, theta_z).");
}

}  // namespace

Constraint tie(const PartDof& a, const PartDof& b) {
  const auto text = [](const PartDof& d) {
    return d.component + " of " + nodeName({d.part, d.node});
  };
  return {text(a) + " = " + text(b), {{a, 1.0}, {b, -1.0}}, 0.0, true};
}

std::vector<Constraint> rigidLink(const PartNode& from, const PartNode& to, const Vector3& arm,
                                  const model::ComponentNames& names) {
  const ComponentAxes axes = componentAxes(names);
  needTranslations(axes, names, "A rigid link");
  const std::string title = "rigid link from " + nodeName(from) + " to " + nodeName(to) + ", ";
  std::vector<Constraint> link;
  const auto dof = [&](const PartNode& n, int c) { return PartDof{n.part, n.node, names[at(c)]}; };
  for (int a = 0; a < 3; ++a) {
    const int c = axes.translation[at(a)];
    if (c < 0) continue;
    // u_to = u_from + theta x arm: component a is theta_b arm_c - theta_c arm_b
    Constraint one{title + names[at(c)], {{dof(to, c), 1.0}, {dof(from, c), -1.0}}, 0.0, false};
    const int b = (a + 1) % 3, d = (a + 2) % 3;
    if (axes.rotation[at(b)] >= 0 && arm[d] != 0.0)
      one.terms.push_back({dof(from, axes.rotation[at(b)]), -arm[d]});
    if (axes.rotation[at(d)] >= 0 && arm[b] != 0.0)
      one.terms.push_back({dof(from, axes.rotation[at(d)]), arm[b]});
    link.push_back(one);
  }
  for (int a = 0; a < 3; ++a)
    if (const int c = axes.rotation[at(a)]; c >= 0)
      link.push_back({title + names[at(c)], {{dof(to, c), 1.0}, {dof(from, c), -1.0}}, 0.0, false});
  return link;
}

std::vector<Constraint> hinge(const PartNode& a, const PartNode& b, const Vector3& axis,
                              const model::ComponentNames& names) {
  const ComponentAxes axes = componentAxes(names);
  needTranslations(axes, names, "A hinge");
  if (!(axis.norm() > 0) || !axis.allFinite())
    throw ModelError("The hinge between " + nodeName(a) + " and " + nodeName(b) +
                     " has a zero axis. Give a nonzero vector.");
  const std::string title = "hinge between " + nodeName(a) + " and " + nodeName(b) + ", ";
  const auto dof = [&](const PartNode& n, int c) { return PartDof{n.part, n.node, names[at(c)]}; };
  std::vector<Constraint> rows;
  for (int c : axes.translation)
    if (c >= 0)
      rows.push_back({title + names[at(c)], {{dof(b, c), 1.0}, {dof(a, c), -1.0}}, 0.0, false});
  const Vector3 e = axis.normalized();
  const Vector3 first = e.unitOrthogonal();
  for (const Vector3& across : {first, Vector3(e.cross(first))}) {
    Constraint row{title + "rotation across the axis", {}, 0.0, false};
    for (int i = 0; i < 3; ++i)
      if (axes.rotation[at(i)] >= 0 && std::abs(across[i]) > 1e-14) {
        row.terms.push_back({dof(b, axes.rotation[at(i)]), across[i]});
        row.terms.push_back({dof(a, axes.rotation[at(i)]), -across[i]});
      }
    if (!row.terms.empty()) rows.push_back(row);
  }
  return rows;
}

std::vector<Term> separation(const PartNode& a, const PartNode& b, const Vector3& direction,
                             const model::ComponentNames& names) {
  const ComponentAxes axes = componentAxes(names);
  needTranslations(axes, names, "A separation");
  if (!(direction.norm() > 0) || !direction.allFinite())
    throw ModelError("The separation of " + nodeName(a) + " and " + nodeName(b) +
                     " has a zero direction. Give a nonzero vector.");
  const Vector3 e = direction.normalized();
  std::vector<Term> row;
  for (int i = 0; i < 3; ++i)
    if (const int c = axes.translation[at(i)]; c >= 0 && e[i] != 0.0) {
      row.push_back({{b.part, b.node, names[at(c)]}, e[i]});
      row.push_back({{a.part, a.node, names[at(c)]}, -e[i]});
    }
  return row;
}

namespace {

/// Assigns numbers to the nodes of parts with their own numbering.
class Numberer {
 public:
  explicit Numberer(const std::vector<model::Substructure>& parts) : parts_(parts) {
    std::int64_t largest = 0;
    for (const auto& part : parts_) {
      nodes_.emplace_back();
      for (const auto& label : part.model.dofs) nodes_.back().emplace(label.entity, 0);
      for (auto node : part.model.recoveryNodes) nodes_.back().emplace(node, 0);
      for (const auto& [node, number] : nodes_.back()) largest = std::max(largest, node);
    }
    std::int64_t stride = 10;
    while (stride <= largest) stride *= 10;
    for (std::size_t p = 0; p < nodes_.size(); ++p)
      for (auto& [node, number] : nodes_[p])
        number = (static_cast<std::int64_t>(p) + 1) * stride + node;
  }

  void join(const std::vector<PartNode>& joint) {
    std::vector<std::int64_t> numbers;
    for (const auto& n : joint) numbers.push_back(nodes_[part(n)].at(n.node));
    const std::int64_t first = numbers.empty() ? 0 : numbers.front();
    for (auto& nodes : nodes_)
      for (auto& [node, number] : nodes)
        if (contains(numbers, number)) number = first;
    for (std::size_t p = 0; p < nodes_.size(); ++p) {
      std::int64_t before = -1;
      for (const auto& [node, number] : nodes_[p]) {
        if (number != first) continue;
        if (before >= 0)
          throw ModelError("A joint puts node " + std::to_string(before) + " and node " +
                           std::to_string(node) + " of part \"" + parts_[p].name +
                           "\" at the same place. Use constraints instead.");
        before = node;
      }
    }
  }

  std::vector<model::Substructure> result() const {
    std::vector<model::Substructure> out = parts_;
    std::map<model::DofLabel, int> owners;  // parts that have the dof of a joint
    for (std::size_t p = 0; p < out.size(); ++p) {
      auto& m = out[p].model;
      for (auto& label : m.dofs) {
        label.entity = nodes_[p].at(label.entity);
        ++owners[label];
      }
      for (auto& node : m.recoveryNodes.own()) node = nodes_[p].at(node);
      for (auto& set : m.points)
        for (auto& node : set.entities)
          if (const auto it = nodes_[p].find(node); it != nodes_[p].end()) node = it->second;
    }
    for (auto& part : out) {
      for (int i = 0; i < part.model.size(); ++i) {
        const auto& label = part.model.dofs[at(i)];
        if (owners.at(label) < 2 || contains(part.interface, i)) continue;
        part.interface.insert(std::lower_bound(part.interface.begin(), part.interface.end(), i), i);
        part.retained.erase(std::remove(part.retained.begin(), part.retained.end(), i),
                            part.retained.end());
      }
    }
    return out;
  }

 private:
  std::size_t part(const PartNode& n) const {
    const std::size_t p = at(partNumber(namesOf(parts_), n.part, "A joint"));
    if (nodes_[p].count(n.node) == 0)
      throw ModelError("A joint names " + nodeName(n) + ", but the part has no such node.");
    return p;
  }

  const std::vector<model::Substructure>& parts_;
  std::vector<std::map<std::int64_t, std::int64_t>> nodes_;  ///< number of each node
};

}  // namespace

std::vector<model::Substructure> numberTogether(const std::vector<model::Substructure>& parts,
                                                const std::vector<std::vector<PartNode>>& joints) {
  Numberer numberer(parts);
  for (const auto& joint : joints) numberer.join(joint);
  return numberer.result();
}

}  // namespace tooljoint::coupling
