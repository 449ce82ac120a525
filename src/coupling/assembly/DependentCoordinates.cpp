// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/assembly/DependentCoordinates.hpp"

#include <Eigen/Dense>
#include <utility>

#include "common/Error.hpp"
#include "coupling/assembly/Congruence.hpp"

namespace tooljoint::coupling {

namespace {

/// z of the state q: its entries where the dependent coordinates agree, else (S' M S) z = S' M q.
Vector fit(const Sparse& M, const Sparse& S, const Vector& q, const std::vector<int>& others) {
  Vector z(static_cast<Eigen::Index>(others.size()));
  for (std::size_t j = 0; j < others.size(); ++j) z[static_cast<Eigen::Index>(j)] = q[others[j]];
  if ((S * z - q).cwiseAbs().maxCoeff() <= 1e-12 * q.cwiseAbs().maxCoeff()) return z;
  const Sparse weighted = M * S;
  return Matrix(S.transpose() * weighted).ldlt().solve(weighted.transpose() * q);
}

}  // namespace

void condenseDependent(Coupling& coupling, const reduction::DependentCoordinates& dependent) {
  if (dependent.dofs.empty()) return;
  coupling.dependent = static_cast<int>(dependent.dofs.size());
  model::SecondOrderModel& model = coupling.model;
  if (!coupling.multipliers.empty())
    throw ModelError(
        "Coordinates that follow the others need joined dofs, but dual assembly leaves every part "
        "its own. Set the assembly to Primal, or give the "
        "basis coordinates of its own (\"Residual Coordinates\" = \"Free\").");
  std::vector<int> column(static_cast<std::size_t>(model.size()), 0);
  for (int i : dependent.dofs) column[static_cast<std::size_t>(i)] = -1;
  std::vector<int> others;
  Triplets entries;
  Substitution s;
  for (int i = 0; i < model.size(); ++i) {
    if (column[static_cast<std::size_t>(i)] < 0) continue;
    column[static_cast<std::size_t>(i)] = static_cast<int>(others.size());
    entries.emplace_back(i, static_cast<int>(others.size()), 1.0);
    s.dofs.push_back(model.dofs[static_cast<std::size_t>(i)]);
    others.push_back(i);
  }
  for (std::size_t f = 0; f < dependent.dofs.size(); ++f)
    for (Eigen::Index j = 0; j < dependent.rows.cols(); ++j)
      if (dependent.rows(static_cast<Eigen::Index>(f), j) != 0.0)
        entries.emplace_back(dependent.dofs[f], static_cast<int>(j),
                             dependent.rows(static_cast<Eigen::Index>(f), j));
  s.map = Sparse(model.size(), static_cast<Eigen::Index>(others.size()));
  s.map.setFromTriplets(entries.begin(), entries.end());
  s.offset = Vector::Zero(model.size());
  s.initialDisplacement = fit(model.mass, s.map, model.initialDisplacement, others);
  s.initialVelocity = fit(model.mass, s.map, model.initialVelocity, others);
  substitute(model, s);
  for (std::size_t p = 0; p < coupling.maps.size(); ++p) {
    coupling.maps[p] = Sparse(coupling.maps[p] * s.map);
    coupling.positions[p] = positionsOf(coupling.maps[p]);
  }
  std::vector<int> interface;
  for (int i : coupling.interface)
    if (column[static_cast<std::size_t>(i)] >= 0)
      interface.push_back(column[static_cast<std::size_t>(i)]);
  coupling.interface = std::move(interface);
  coupling.remarks.push_back(std::to_string(dependent.dofs.size()) +
                             " coordinates follow the others; the coupled matrices are full");
}

}  // namespace tooljoint::coupling
