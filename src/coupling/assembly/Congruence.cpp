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

DofLabel groupOf(const DofLabel& label) {
  if (label.kind == DofLabel::Kind::Physical) return DofLabel::physical(label.entity, 0);
  if (label.kind == DofLabel::Kind::Interface) return DofLabel::interfaceMode(label.entity, 0);
  return label;
}

}  // namespace

Sparse moveColumns(const Sparse& A, const std::vector<int>& column, Eigen::Index columns) {
  Triplets entries;
  forEachEntry(A, [&](int i, int j, double value) {
    if (value != 0.0) entries.emplace_back(i, column[at(j)], value);
  });
  return sparse(A.rows(), columns, entries);
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
    forEachEntry(A, [&](int i, int j, double value) {
      const int a = group[at(i)], b = group[at(j)];
      if (value != 0.0 && a != b) edges.emplace_back(std::min(a, b), std::max(a, b));
    });
    makeUnique(edges);
  });
  std::vector<int> position(model.dofs.size());
  next = 0;
  for (int g : cuthillMcKee(sizeOf(members), edges)) {
    auto& dofs = members[at(g)];
    std::sort(dofs.begin(), dofs.end(),
              [&](int a, int b) { return model.dofs[at(a)] < model.dofs[at(b)]; });
    for (int i : dofs) position[at(i)] = next++;
  }
  return position;
}

void renumber(model::SecondOrderModel& model, const std::vector<int>& position) {
  const int n = sizeOf(position);
  changeEachMatrix(model, [&](model::SharedSparse& A) {
    Triplets entries;
    forEachEntry(A, [&](int i, int j, double value) {
      if (value != 0.0) entries.emplace_back(position[at(i)], position[at(j)], value);
    });
    A = sparse(n, n, entries);
  });
  const auto move = [&](Vector& x) {
    Vector moved(n);
    moved(position) = x;
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
  std::vector<int> positions(at(map.rows()), -1);
  for (int i = 0; i < map.rows(); ++i) {
    int entries = 0;
    forEachInRow(map, i, [&](int column, double value) {
      if (value == 0.0) return;
      ++entries;
      positions[at(i)] = value == 1.0 ? column : -1;
    });
    if (entries != 1) positions[at(i)] = -1;
  }
  return positions;
}

std::vector<int> keepOnly(const model::SecondOrderModel& model, const std::vector<char>& keep,
                          Triplets entries, int more, Substitution& s) {
  std::vector<int> column(keep.size() + at(more), -1), kept;
  for (int i = 0; i < sizeOf(keep); ++i)
    if (keep[at(i)]) {
      column[at(i)] = sizeOf(kept);
      kept.push_back(i);
      s.dofs.push_back(model.dofs[at(i)]);
    }
  for (int k = 0; k < more; ++k) column[keep.size() + at(k)] = sizeOf(kept) + k;
  for (auto& entry : entries) entry = {entry.row(), column[at(entry.col())], entry.value()};
  for (int j = 0; j < sizeOf(kept); ++j) entries.emplace_back(kept[at(j)], j, 1.0);
  s.map = sparse(sizeOf(keep), sizeOf(kept) + more, entries);
  s.offset = Vector::Zero(sizeOf(keep));
  s.initialDisplacement = s.initialVelocity = Vector::Zero(s.map.cols());
  s.initialDisplacement.head(sizeOf(kept)) = model.initialDisplacement(kept);
  s.initialVelocity.head(sizeOf(kept)) = model.initialVelocity(kept);
  return column;
}

}  // namespace tooljoint::coupling
