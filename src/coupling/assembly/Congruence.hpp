// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A second-order model in other coordinates, and the numbering of a coupled model.
#pragma once

#include <vector>

#include "common/Index.hpp"
#include "model/SecondOrderModel.hpp"

namespace tooljoint::coupling {

/// y = map z + offset.
struct Substitution {
  Sparse map;
  Vector offset;
  std::vector<model::DofLabel> dofs;  ///< of z
  Vector initialDisplacement;         ///< of z
  Vector initialVelocity;
};

/// Mass, damping, stiffness and loads become L' A L and L' (F - K offset); point rows and recovery
/// are transformed alike.
void substitute(model::SecondOrderModel& model, const Substitution& substitution);

/// Fills `s` with the coordinates that stay, keep[i] != 0, as they are, and `more` new ones behind
/// them, whose dofs are for the caller to add. `entries` say what the others are: row and column
/// are coordinates of the model, or the number of coordinates and more for the new ones. Returns
/// the new number of every coordinate, -1 for those that do not stay.
std::vector<int> keepOnly(const model::SecondOrderModel& model, const std::vector<char>& keep,
                          Triplets entries, int more, Substitution& s);

/// Position of every dof in a numbering by a Cuthill-McKee walk over groups: the dofs of a node
/// together, with the forces on them; the modes of an interface together; every mode of a part by
/// itself.
std::vector<int> narrowNumbering(const model::SecondOrderModel& model);

/// Puts dof i at position[i].
void renumber(model::SecondOrderModel& model, const std::vector<int>& position);

/// Entries at other columns: out(i, column[j]) = A(i, j); exact zeros are left out.
Sparse moveColumns(const Sparse& A, const std::vector<int>& column, Eigen::Index columns);

/// Per row of a map the column it is the same as, -1 where it is not just one.
std::vector<int> positionsOf(const Sparse& map);

/// Every matrix of the model: mass, damping and stiffness terms.
template <class Visit>
void forEachMatrix(const model::SecondOrderModel& model, const Visit& visit) {
  visit(model.mass);
  for (const auto& term : model.damping) visit(term.matrix);
  for (const auto& term : model.stiffness) visit(term.matrix);
}

/// The same, for writing.
template <class Change>
void changeEachMatrix(model::SecondOrderModel& model, const Change& change) {
  change(model.mass);
  for (auto& term : model.damping.own()) change(term.matrix);
  for (auto& term : model.stiffness.own()) change(term.matrix);
}

}  // namespace tooljoint::coupling
