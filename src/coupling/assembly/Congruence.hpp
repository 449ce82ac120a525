// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Coordinate transformation of a second-order model, and the numbering of a coupled model.
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
/// are transformed in the same way.
void substitute(model::SecondOrderModel& model, const Substitution& substitution);

/// Fills `s` with the kept coordinates, keep[i] != 0, unchanged, followed by `more` new ones, whose
/// dofs the caller adds. `entries` define the other coordinates: row and column are coordinates of
/// the model, or the number of coordinates and above for the new ones. Returns the new number of
/// every coordinate, -1 for those not kept.
std::vector<int> keepOnly(const model::SecondOrderModel& model, const std::vector<char>& keep,
                          Triplets entries, int more, Substitution& s);

/// Position of every dof in a numbering by a Cuthill-McKee walk over groups. A group is: the dofs
/// of a node with the forces on them; the modes of an interface; a single mode of a part.
std::vector<int> narrowNumbering(const model::SecondOrderModel& model);

/// Moves dof i to position[i].
void renumber(model::SecondOrderModel& model, const std::vector<int>& position);

/// Moves columns: out(i, column[j]) = A(i, j); exact zeros are omitted.
Sparse moveColumns(const Sparse& A, const std::vector<int>& column, Eigen::Index columns);

/// For each row of a map the column it equals, -1 if it is not a single column.
std::vector<int> positionsOf(const Sparse& map);

/// Visits every matrix of the model: mass, damping and stiffness terms.
template <class Visit>
void forEachMatrix(const model::SecondOrderModel& model, const Visit& visit) {
  visit(model.mass);
  for (const auto& term : model.damping) visit(term.matrix);
  for (const auto& term : model.stiffness) visit(term.matrix);
}

/// The same with write access.
template <class Change>
void changeEachMatrix(model::SecondOrderModel& model, const Change& change) {
  change(model.mass);
  for (auto& term : model.damping.own()) change(term.matrix);
  for (auto& term : model.stiffness.own()) change(term.matrix);
}

}  // namespace tooljoint::coupling
