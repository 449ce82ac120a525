// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/project/Distribution.hpp"

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>

#include "common/Index.hpp"
#include "common/Message.hpp"

namespace tooljoint::model {

template <class Archive>
void save(Archive& archive, const SharedSparse& A) {
  archive(A.sparse());
}

template <class Archive>
void load(Archive& archive, SharedSparse& A) {
  Sparse matrix;
  archive(matrix);
  A = std::move(matrix);
}

template <class Archive, class T>
void save(Archive& archive, const SharedList<T>& list) {
  archive(static_cast<const std::vector<T>&>(list));
}

template <class Archive, class T>
void load(Archive& archive, SharedList<T>& list) {
  archive(list.own());
}

template <class Archive>
void serialize(Archive& archive, MatrixTerm& term) {
  archive(term.name, term.matrix, term.law);
}

}  // namespace tooljoint::model

namespace tooljoint::reduction {

template <class Archive>
void serialize(Archive& archive, BasisRow& row) {
  archive(row.kind, row.name, row.eigenvalue, row.residual, row.kept, row.why);
}

template <class Archive>
void serialize(Archive& archive, Partition& p) {
  archive(p.size, p.interface, p.retained, p.boundary, p.interior, p.blocks, p.touched);
}

template <class Archive>
void serialize(Archive& archive, Basis& b) {
  archive(b.partition, b.vectors, b.modeKind, b.eigenvalues, b.candidates, b.complete,
          b.orthonormal, b.removable, b.inertial, b.forceDofs, b.rows, b.orthogonality, b.method,
          b.remarks);
}

template <class Archive>
void serialize(Archive& archive, ProjectedMatrices& m) {
  archive(m.mass, m.damping, m.stiffness, m.constantStiffness, m.massDefect, m.stiffnessDefect,
          m.structureEnforced);
}

template <class Archive>
void serialize(Archive& archive, BasisReport& r) {
  archive(r.part, r.basis, r.method, r.sharedWith, r.interface, r.retained, r.interior, r.modes,
          r.negativeModes, r.rank, r.zeroEnergyFull, r.zeroEnergyReduced, r.orthogonality,
          r.massDefect, r.stiffnessDefect, r.conditioning, r.staticDefect, r.largestOmega,
          r.explicitStep, r.startEnergy, r.startMisfit, r.structureEnforced, r.checked, r.remarks);
  std::vector<BasisRow> rows = *r.rows;
  archive(rows);
  if constexpr (Archive::is_loading::value)
    r.rows = std::make_shared<const std::vector<BasisRow>>(std::move(rows));
}

template <class Archive>
void serialize(Archive& archive, ReducedCore& core) {
  archive(core.basis, core.matrices, core.report);
}

std::vector<int> assignOwners(const std::vector<int>& weights, int ranks) {
  std::vector<int> order = range(sizeOf(weights));
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return weights[at(a)] > weights[at(b)]; });
  std::vector<double> load(at(ranks), 0.0);
  std::vector<int> owner(weights.size(), 0);
  for (int part : order) {
    const auto least = std::min_element(load.begin(), load.end());
    owner[at(part)] = static_cast<int>(least - load.begin());
    *least += 1.0 + weights[at(part)];
  }
  return owner;
}

std::vector<char> dividedParts(const std::vector<int>& weights, int ranks) {
  constexpr double fewDofs = 20000.0;
  const double share = std::accumulate(weights.begin(), weights.end(), 0.0) / ranks;
  std::vector<char> divided;
  for (const int weight : weights)
    divided.push_back(ranks > 1 && weight > std::max(fewDofs, share) ? 1 : 0);
  return divided;
}

std::string pack(const ReducedCore& core) { return toBytes(core); }

ReducedCore unpack(const std::string& bytes) {
  ReducedCore core;
  fromBytes(bytes, core);
  return core;
}

}  // namespace tooljoint::reduction
