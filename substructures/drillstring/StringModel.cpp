// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/StringModel.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "common/Error.hpp"
#include "substructures/contact/BoreholeContact.hpp"

namespace tooljoint::drillstring {

namespace {

/// Free dofs of a run of nodes, numbered node by node.
struct FreeDofs {
  int firstNode = 0;
  std::vector<int> index;      ///< per dof of the run: its number, or -1 when held
  std::vector<int> positions;  ///< 6 node + component of each free dof in the whole string

  FreeDofs(const StringModel& string, int first, int last) : firstNode(first) {
    for (int dof = kNodeDofs * first; dof < kNodeDofs * (last + 1); ++dof) {
      const bool held = string.held[static_cast<std::size_t>(dof)] != 0;
      index.push_back(held ? -1 : static_cast<int>(positions.size()));
      if (!held) positions.push_back(dof);
    }
  }
  int size() const { return static_cast<int>(positions.size()); }
  int of(int dof) const { return index[static_cast<std::size_t>(dof - kNodeDofs * firstNode)]; }
};

/// Sum of element matrices over the free dofs. The pattern is that of the chain; an entry that is
/// exactly zero is included only if another term of the element is not zero there.
Sparse assembleMatrices(const std::vector<beam::Matrix12>& matrices, const FreeDofs& dofs,
                        int firstElement, int lastElement) {
  Triplets triplets;
  for (int e = firstElement; e <= lastElement; ++e) {
    const auto& matrix = matrices[static_cast<std::size_t>(e)];
    for (int row = 0; row < 2 * kNodeDofs; ++row) {
      const int i = dofs.of(kNodeDofs * e + row);
      if (i < 0) continue;
      for (int column = 0; column < 2 * kNodeDofs; ++column) {
        const int j = dofs.of(kNodeDofs * e + column);
        if (j >= 0 && matrix(row, column) != 0.0) triplets.emplace_back(i, j, matrix(row, column));
      }
    }
  }
  Sparse sum(dofs.size(), dofs.size());
  sum.setFromTriplets(triplets.begin(), triplets.end());
  return sum;
}

/// Contact points of the nodes for which `take` is true; an empty row for a held coordinate.
void addContact(const StringModel& string, const FreeDofs& dofs,
                const std::function<bool(int)>& take, model::SecondOrderModel& model) {
  std::vector<int> points;
  std::vector<int> nodes;
  for (std::size_t i = 0; i < string.contact.nodes.size(); ++i) {
    if (!take(string.contact.nodes[i])) continue;
    points.push_back(static_cast<int>(i));
    nodes.push_back(string.contact.nodes[i]);
  }
  if (points.empty()) return;
  model::PointSet set;
  set.name = kContactSet;
  const bool all = points.size() == string.contact.nodes.size();
  set.law = all ? string.contact.law : string.contact.law->subset(points);
  const auto components = contact::contactComponents(set.law->width());
  const int width = static_cast<int>(components.size());
  Triplets triplets;
  for (std::size_t p = 0; p < nodes.size(); ++p) {
    set.entities.push_back(nodes[p] + 1);
    for (int c = 0; c < width; ++c) {
      const int dof = dofs.of(kNodeDofs * nodes[p] + components[static_cast<std::size_t>(c)]);
      if (dof >= 0) triplets.emplace_back(width * static_cast<int>(p) + c, dof, 1.0);
    }
  }
  set.rows.resize(width * static_cast<int>(nodes.size()), dofs.size());
  set.rows.setFromTriplets(triplets.begin(), triplets.end());
  set.offset = Vector::Zero(set.rows.rows());
  model.points.push_back(std::move(set));
}

/// Laws of bit and top drive at the nodes selected by `owns`; an empty row for a held dof.
void addDrilling(const StringModel& string, const FreeDofs& dofs,
                 const std::function<bool(int)>& owns, model::SecondOrderModel& model) {
  for (const auto& one : string.drilling) {
    if (!owns(one.node)) continue;
    const auto width = static_cast<int>(one.components.size());
    model::PointSet set{
        one.name, one.law, {one.node + 1}, Sparse(width, dofs.size()), Vector::Zero(width)};
    for (int c = 0; c < width; ++c) {
      const int dof = dofs.of(kNodeDofs * one.node + one.components[static_cast<std::size_t>(c)]);
      if (dof >= 0) set.rows.insert(c, dof) = 1.0;
    }
    set.rows.makeCompressed();
    model.points.push_back(std::move(set));
  }
}

/// Matrices, labels, initial state and recovery of a run of elements; loads and contact of the
/// nodes selected by `owns`.
model::SecondOrderModel assembleRun(const StringModel& string, int firstElement, int lastElement,
                                    const std::function<bool(int)>& owns,
                                    const std::function<bool(int)>& touches) {
  const FreeDofs dofs(string, firstElement, lastElement + 1);
  model::SecondOrderModel model;
  model.componentNames = componentNames();
  model.laws = string.laws;
  model.mass = assembleMatrices(string.mass, dofs, firstElement, lastElement);
  for (const auto& term : string.damping)
    model.damping.push_back(
        {term.name, assembleMatrices(term.matrices, dofs, firstElement, lastElement), term.law});
  for (const auto& term : string.stiffness)
    model.stiffness.push_back(
        {term.name, assembleMatrices(term.matrices, dofs, firstElement, lastElement), term.law});
  for (const auto& load : string.loads) {
    Vector vector = Vector::Zero(dofs.size());
    for (int i = 0; i < dofs.size(); ++i) {
      const int dof = dofs.positions[static_cast<std::size_t>(i)];
      if (owns(dof / kNodeDofs)) vector(i) = load.vector(dof);
    }
    if (vector.any()) model.loads.push_back({load.name, vector, load.law});
  }
  model.initialDisplacement.resize(dofs.size());
  model.initialVelocity = Vector::Zero(dofs.size());
  Triplets recovery;
  for (int i = 0; i < dofs.size(); ++i) {
    const int dof = dofs.positions[static_cast<std::size_t>(i)];
    model.dofs.push_back(model::DofLabel::physical(dof / kNodeDofs + 1, dof % kNodeDofs));
    model.initialDisplacement(i) = string.state(dof);
    recovery.emplace_back(dof - kNodeDofs * firstElement, i, 1.0);
  }
  for (int node = firstElement; node <= lastElement + 1; ++node)
    model.recoveryNodes.push_back(node + 1);
  model.recovery.resize(kNodeDofs * static_cast<int>(model.recoveryNodes.size()), dofs.size());
  model.recovery.setFromTriplets(recovery.begin(), recovery.end());
  model.recoveryOffset = Vector::Zero(model.recovery.rows());
  if (string.contact.law) addContact(string, dofs, touches, model);
  addDrilling(string, dofs, owns, model);
  return model;
}

/// Relative tolerance below which two parts count as equal. Positions of some kilometres are
/// rounded to u = 5e-13 m. On an element of length l this is a strain u / l and a tension E A u /
/// l, which changes its bending stiffness 12 E I / l^3 by (A l^2 / 10 I) u / l: 3e-10 for 10 m of
/// pipe, less on a finer mesh. The softest motion of a chain of n elements changes by n^2 times the
/// change of its entries, so the tolerance shrinks with n^2 as well; the error of the lowest
/// frequency is below 1e-8.
double roundingOfPlaces(int dofs) {
  const double few = 90.0 / std::max(1, dofs);
  return std::min(1e-9, 5e-11 * std::max(1.0, few * few));
}

}  // namespace

int StringModel::freeDofs() const {
  return static_cast<int>(std::count(held.begin(), held.end(), char{0}));
}

int StringModel::lawIndex(const model::ScalarLaw& law) {
  for (std::size_t i = 0; i < laws.size(); ++i)
    if (laws[i].name == law.name) return static_cast<int>(i);
  laws.push_back(law);
  return static_cast<int>(laws.size()) - 1;
}

const model::ComponentNames& componentNames() {
  static const model::ComponentNames names{"u", "v", "w", "theta_x", "theta_y", "theta_z"};
  return names;
}

model::SecondOrderModel assemble(const StringModel& string) {
  const auto every = [](int) { return true; };
  return assembleRun(string, 0, string.elements() - 1, every, every);
}

model::Substructure assemblePart(const StringModel& string, const PartRange& range,
                                 const std::vector<int>& retained,
                                 const std::vector<int>* contactAt) {
  const int firstNode = range.firstElement;
  const int lastNode = range.lastElement + 1;
  const auto owns = [&](int node) {
    return node == 0 ? firstNode == 0 : node > firstNode && node <= lastNode;
  };
  const auto touches = [&](int node) {
    return owns(node) &&
           (contactAt == nullptr || std::binary_search(contactAt->begin(), contactAt->end(), node));
  };
  model::Substructure part;
  part.name = range.name;
  part.model = assembleRun(string, range.firstElement, range.lastElement, owns, touches);
  const FreeDofs dofs(string, firstNode, lastNode);
  part.rounding = roundingOfPlaces(dofs.size());
  part.reference.resize(dofs.size());
  for (int i = 0; i < dofs.size(); ++i) {
    const int dof = dofs.positions[static_cast<std::size_t>(i)];
    const int node = dof / kNodeDofs;
    part.reference(i) = string.state(dof);
    const bool shared =
        (node == firstNode && firstNode > 0) || (node == lastNode && lastNode < string.nodes - 1);
    if (shared)
      part.interface.push_back(i);
    else if (std::binary_search(retained.begin(), retained.end(), dof))
      part.retained.push_back(i);
  }
  return part;
}

}  // namespace tooljoint::drillstring
