// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/assembly/DependentCoordinates.hpp"

#include <Eigen/Dense>
#include <utility>
#include <vector>

#include "common/Error.hpp"
#include "coupling/assembly/Congruence.hpp"

namespace tooljoint::coupling {

namespace {

/// z of the state q. If the dependent coordinates agree, the entries of q; otherwise those of the
/// physical dofs P, and for the others (S_m' M S_m) z_m = S_m' M (q - S_P z_P).
Vector fit(const model::SecondOrderModel& model, const Sparse& S, const Vector& q,
           const std::vector<int>& others) {
  Vector z = q(others);
  if ((S * z - q).cwiseAbs().maxCoeff() <= 1e-12 * q.cwiseAbs().maxCoeff()) return z;
  std::vector<int> modal;
  for (int j = 0; j < sizeOf(others); ++j)
    if (model.dofs[at(others[at(j)])].kind != model::DofLabel::Kind::Physical) modal.push_back(j);
  if (modal.empty()) return z;
  z(modal).setZero();
  const Matrix columns = Matrix(S)(Eigen::all, modal), weighted = model.mass * columns;
  const Vector rest = q - S * z;
  const Vector fitted =
      Matrix(columns.transpose() * weighted).ldlt().solve(weighted.transpose() * rest);
  z(modal) = fitted;
  return z;
}

}  // namespace

void changeCoordinates(Coupling& coupling, const Sparse& map) {
  for (std::size_t p = 0; p < coupling.maps.size(); ++p) {
    coupling.maps[p] = Sparse(coupling.maps[p] * map);
    coupling.positions[p] = positionsOf(coupling.maps[p]);
  }
}

void condenseDependent(Coupling& coupling, const reduction::DependentCoordinates& dependent) {
  if (dependent.dofs.empty()) return;
  coupling.dependent = static_cast<int>(dependent.dofs.size());
  model::SecondOrderModel& model = coupling.model;
  if (!coupling.multipliers.empty())
    throw ModelError(
        "Dependent coordinates need joined dofs, but with dual assembly every part keeps its own "
        "dofs. Set Coupling/Assembly to \"Primal\", or \"Residual Coordinates\" to \"Free\".");
  std::vector<char> keep(at(model.size()), 1);
  for (int i : dependent.dofs) keep[at(i)] = 0;
  std::vector<int> others;
  for (int i = 0; i < model.size(); ++i)
    if (keep[at(i)]) others.push_back(i);
  Triplets entries;
  for (int f = 0; f < sizeOf(dependent.dofs); ++f)
    for (int j = 0; j < sizeOf(others); ++j)
      if (dependent.rows(f, j) != 0.0)
        entries.emplace_back(dependent.dofs[at(f)], others[at(j)], dependent.rows(f, j));
  Substitution s;
  const std::vector<int> column = keepOnly(model, keep, entries, 0, s);
  s.initialDisplacement = fit(model, s.map, model.initialDisplacement, others);
  s.initialVelocity = fit(model, s.map, model.initialVelocity, others);
  substitute(model, s);
  changeCoordinates(coupling, s.map);
  std::vector<int> interface;
  for (int i : coupling.interface)
    if (keep[at(i)]) interface.push_back(column[at(i)]);
  coupling.interface = std::move(interface);
  coupling.remarks.push_back(std::to_string(dependent.dofs.size()) +
                             " coordinates depend on the others; the coupled matrices are full");
}

}  // namespace tooljoint::coupling
