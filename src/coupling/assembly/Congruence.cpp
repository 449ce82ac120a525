// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/assembly/Congruence.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "common/Index.hpp"
#include "coupling/assembly/Numbering.hpp"

namespace tooljoint::coupling {

namespace {

using model::DofLabel;

Sparse withoutZeros(Sparse A) {
  A.prune([](Eigen::Index, Eigen::Index, double value) { return value != 0.0; });
  return A;
}

DofLabel groupOf(const DofLabel& label) {
  if (label.kind == DofLabel::Kind::Physical) return DofLabel::physical(label.entity, 0);
  if (label.kind == DofLabel::Kind::Interface) return DofLabel::interfaceMode(label.entity, 0);
  return label;
}

}  // namespace

Sparse moveColumns(const Sparse& A, const std::vector<int>& column, Eigen::Index columns) {
  Triplets entries;
  for (int i = 0; i < A.outerSize(); ++i)
    for (Sparse::InnerIterator it(A, i); it; ++it)
      if (it.value() != 0.0)
        entries.emplace_back(i, column[at(static_cast<int>(it.col()))], it.value());
  Sparse moved(A.rows(), columns);
  moved.setFromTriplets(entries.begin(), entries.end());
  return moved;
}

void substitute(model::SecondOrderModel& model, const Substitution& substitution) {
  const Sparse& L = substitution.map;
  const Sparse transposed = L.transpose();
  const Vector& offset = substitution.offset;
  for (auto& load : model.loads) load.vector = transposed * load.vector;
  if (!offset.isZero(0.0))
    for (const auto& term : model.stiffness) {
      const Vector force = -(term.matrix * offset);
      if (!force.isZero(0.0))
        model.loads.push_back({"constraint values: " + term.name, transposed * force, term.law});
    }
  changeEachMatrix(model, [&](model::SharedSparse& A) {
    const Sparse right = A * L;
    A = withoutZeros(transposed * right);
  });
  for (auto& set : model.points) {
    set.offset += set.rows * offset;
    set.rows = withoutZeros(set.rows * L);
  }
  if (model.recovery.rows() > 0) {
    model.recoveryOffset += model.recovery * offset;
    model.recovery = withoutZeros(model.recovery * L);
  } else {
    model.recovery = Sparse(0, L.cols());
  }
  model.dofs = substitution.dofs;
  model.initialDisplacement = substitution.initialDisplacement;
  model.initialVelocity = substitution.initialVelocity;
}

std::vector<int> narrowNumbering(const model::SecondOrderModel& model) {
  std::map<DofLabel, int> number;
  for (const auto& label : model.dofs) number.emplace(groupOf(label), 0);
  int next = 0;
  for (auto& [label, group] : number) group = next++;
  std::vector<int> group(model.dofs.size());
  std::vector<std::vector<int>> members(at(next));
  for (std::size_t i = 0; i < model.dofs.size(); ++i) {
    group[i] = number.at(groupOf(model.dofs[i]));
    members[at(group[i])].push_back(static_cast<int>(i));
  }
  std::vector<std::pair<int, int>> edges;
  forEachMatrix(model, [&](const Sparse& A) {
    for (int i = 0; i < A.outerSize(); ++i)
      for (Sparse::InnerIterator it(A, i); it; ++it) {
        const int a = group[at(i)], b = group[at(static_cast<int>(it.col()))];
        if (it.value() != 0.0 && a != b) edges.emplace_back(std::min(a, b), std::max(a, b));
      }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  });
  std::vector<int> position(model.dofs.size());
  next = 0;
  for (int g : cuthillMcKee(static_cast<int>(members.size()), edges)) {
    auto& dofs = members[at(g)];
    std::sort(dofs.begin(), dofs.end(),
              [&](int a, int b) { return model.dofs[at(a)] < model.dofs[at(b)]; });
    for (int i : dofs) position[at(i)] = next++;
  }
  return position;
}

void renumber(model::SecondOrderModel& model, const std::vector<int>& position) {
  const auto n = static_cast<Eigen::Index>(position.size());
  changeEachMatrix(model, [&](model::SharedSparse& A) {
    Triplets entries;
    for (int i = 0; i < A.outerSize(); ++i)
      for (model::SharedSparse::InnerIterator it(A, i); it; ++it)
        if (it.value() != 0.0)
          entries.emplace_back(position[at(i)], position[at(static_cast<int>(it.col()))],
                               it.value());
    A = Sparse(n, n);
    A.setFromTriplets(entries.begin(), entries.end());
  });
  const auto move = [&](Vector& x) {
    Vector moved(n);
    for (int i = 0; i < n; ++i) moved[position[at(i)]] = x[i];
    x = moved;
  };
  for (auto& load : model.loads) move(load.vector);
  for (auto& set : model.points) set.rows = moveColumns(set.rows, position, n);
  model.recovery = moveColumns(model.recovery, position, n);
  move(model.initialDisplacement);
  move(model.initialVelocity);
  std::vector<DofLabel> dofs(model.dofs.size());
  for (std::size_t i = 0; i < dofs.size(); ++i) dofs[at(position[i])] = model.dofs[i];
  model.dofs = std::move(dofs);
}

std::vector<int> positionsOf(const Sparse& map) {
  std::vector<int> positions(at(static_cast<int>(map.rows())), -1);
  for (int i = 0; i < map.rows(); ++i) {
    int entries = 0;
    for (Sparse::InnerIterator it(map, i); it; ++it)
      if (it.value() != 0.0) {
        ++entries;
        positions[at(i)] = it.value() == 1.0 ? static_cast<int>(it.col()) : -1;
      }
    if (entries != 1) positions[at(i)] = -1;
  }
  return positions;
}

}  // namespace tooljoint::coupling
