// SPDX-License-Identifier: BSD-3-Clause
#include "transient/compiled/ModelPattern.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "common/Index.hpp"

namespace tooljoint::transient {
namespace {

/// Coupling of dofs by the tangents of each point: its first dof with all others, and one dof per
/// entity with one of every other entity. This is all that the partition into blocks needs.
Sparse pointCoupling(const model::PointSet& set, const std::vector<int>& group) {
  const int width = set.law->width();
  const auto n = static_cast<Eigen::Index>(group.size());
  Triplets triplets;
  std::map<int, int> dofOfGroup;
  for (int p = 0; p < set.law->size(); ++p) {
    dofOfGroup.clear();
    int first = -1;
    for (int r = p * width; r < (p + 1) * width; ++r)
      for (Sparse::InnerIterator it(set.rows, r); it; ++it) {
        if (it.value() == 0.0) continue;
        const int dof = static_cast<int>(it.col());
        if (first < 0) first = dof;
        triplets.emplace_back(first, dof, 1.0);
        dofOfGroup.emplace(group[at(dof)], dof);
      }
    for (const auto& [groupA, a] : dofOfGroup)
      for (const auto& [groupB, b] : dofOfGroup) triplets.emplace_back(a, b, 1.0);
  }
  Sparse coupling(n, n);
  coupling.setFromTriplets(triplets.begin(), triplets.end());
  return coupling;
}

/// Group and kind of each dof. The dofs of a node are one group. The modes of a part form one group
/// per family; neither matrices nor point laws couple different families: lateral modes of one run
/// between two kept nodes, torsional ones, ...
struct Groups {
  std::vector<int> group, kind;
};

Groups groupDofs(const model::SecondOrderModel& model) {
  const int n = model.size();
  std::vector<int> parent(at(n));
  for (int i = 0; i < n; ++i) parent[at(i)] = i;
  const auto root = [&](int i) {
    while (parent[at(i)] != i) i = parent[at(i)] = parent[at(parent[at(i)])];
    return i;
  };
  const auto isModal = [&](int i) {
    return model.dofs[at(i)].kind == model::DofLabel::Kind::Modal;
  };
  const auto join = [&](int i, int j) {
    if (model.dofs[at(i)].entity != model.dofs[at(j)].entity) return;
    const int a = root(i), b = root(j);
    parent[at(std::max(a, b))] = std::min(a, b);
  };
  const auto joinModes = [&](const Sparse& matrix) {
    for (int i = 0; i < n; ++i)
      if (isModal(i))
        for (Sparse::InnerIterator it(matrix, i); it; ++it)
          if (it.value() != 0.0 && isModal(static_cast<int>(it.col())))
            join(i, static_cast<int>(it.col()));
  };
  joinModes(model.mass);
  for (const auto* terms : {&model.damping, &model.stiffness})
    for (const auto& term : *terms) joinModes(term.matrix);
  std::map<std::int64_t, int> first;  // per part: the first of its modes that moves the point
  for (const auto& set : model.points)
    for (int p = 0; p < set.law->size(); ++p) {
      first.clear();
      for (int r = p * set.law->width(); r < (p + 1) * set.law->width(); ++r)
        for (Sparse::InnerIterator it(set.rows, r); it; ++it) {
          const int dof = static_cast<int>(it.col());
          if (it.value() != 0.0 && isModal(dof))
            join(first.emplace(model.dofs[at(dof)].entity, dof).first->second, dof);
        }
    }
  Groups groups;
  std::map<std::tuple<int, std::int64_t, int>, int> entities;
  for (int i = 0; i < n; ++i) {
    const auto& label = model.dofs[at(i)];
    groups.kind.push_back(static_cast<int>(label.kind));
    const auto key = std::make_tuple(groups.kind.back(), label.entity, isModal(i) ? root(i) : 0);
    groups.group.push_back(entities.emplace(key, static_cast<int>(entities.size())).first->second);
  }
  return groups;
}

/// build(matrices) with all matrices of the pattern, including tangents of points.
template <class Build>
linalg::BlockPattern withMatrices(const model::SecondOrderModel& model,
                                  const std::vector<int>& group, const Build& build) {
  std::vector<Sparse> couplings;
  for (const auto& set : model.points) couplings.push_back(pointCoupling(set, group));
  std::vector<const Sparse*> matrices{&model.mass.sparse()};
  for (const auto& term : model.damping) matrices.push_back(&term.matrix.sparse());
  for (const auto& term : model.stiffness) matrices.push_back(&term.matrix.sparse());
  for (const auto& coupling : couplings) matrices.push_back(&coupling);
  return build(matrices);
}

}  // namespace

linalg::BlockPattern modelPattern(const model::SecondOrderModel& model) {
  const auto dofs = groupDofs(model);
  return withMatrices(model, dofs.group, [&](const std::vector<const Sparse*>& matrices) {
    return linalg::BlockPattern(linalg::partitionDofs(matrices, dofs.group, dofs.kind), matrices);
  });
}

linalg::BlockPattern modelPattern(const model::SecondOrderModel& model,
                                  const linalg::BlockPartition& partition) {
  std::vector<int> block(at(model.size()));
  for (int b = 0; b < partition.blocks(); ++b)
    for (int p = partition.start[at(b)]; p < partition.start[at(b + 1)]; ++p)
      block[at(partition.dof[at(p)])] = b;
  return withMatrices(model, block, [&](const std::vector<const Sparse*>& matrices) {
    return linalg::BlockPattern(partition, matrices);
  });
}

}  // namespace tooljoint::transient
