// SPDX-License-Identifier: BSD-3-Clause
#include "model/NodalFrequency.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include "common/Index.hpp"
#include "linalg/DenseDecompositions.hpp"

namespace tooljoint::model {
namespace {

/// Dofs with mass and stiffness, those of a node together.
std::vector<std::vector<int>> nodesOf(const SecondOrderModel& model, const Vector& mass,
                                      const Vector& stiffness) {
  std::vector<std::vector<int>> groups;
  std::map<std::tuple<std::int64_t, std::int32_t>, std::size_t> ofNode;
  for (int i = 0; i < model.size(); ++i) {
    if (!(mass[i] > 0.0) || stiffness[i] == 0.0) continue;
    const DofLabel& dof = model.dofs[at(i)];
    if (dof.kind == DofLabel::Kind::Physical && dof.force == 0) {
      const auto [place, added] = ofNode.try_emplace({dof.entity, dof.part}, groups.size());
      if (!added) {
        groups[place->second].push_back(i);
        continue;
      }
    }
    groups.push_back({i});
  }
  return groups;
}

/// Largest 1 / lambda of K_D^-1/2 M K_D^-1/2 of these dofs, without lambda = 0.
double fastest(const std::vector<int>& dofs, const Sparse& mass, const Vector& stiffness) {
  const auto n = static_cast<Eigen::Index>(dofs.size());
  Matrix A(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      A(i, j) = mass.coeff(dofs[at(i)], dofs[at(j)]) /
                std::sqrt(stiffness[dofs[at(i)]] * stiffness[dofs[at(j)]]);
  const Vector values = linalg::symmetricValues(A);
  for (Eigen::Index k = 0; k < n; ++k)
    if (values[k] > roundingOfMass * values[n - 1]) return 1.0 / values[k];
  return 0.0;
}

}  // namespace

double fastestNode(const SecondOrderModel& model, double t) {
  const Sparse& M = model.mass;
  const Vector mass = M.diagonal(), stiffness = model.stiffnessAt(t).diagonal().cwiseAbs();
  double most = 0.0;
  for (const auto& dofs : nodesOf(model, mass, stiffness))
    most = std::max(most, fastest(dofs, M, stiffness));
  return most;
}

}  // namespace tooljoint::model
