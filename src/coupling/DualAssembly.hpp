// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Lagrange multipliers for the constraints of a model of parts that keep their own dofs.
#pragma once

#include <vector>

#include "coupling/Assembler.hpp"
#include "coupling/Elimination.hpp"
#include "coupling/LabelAssembly.hpp"
#include "coupling/Pieces.hpp"

namespace tooljoint::coupling {

/// Adds one multiplier for each solved row to the model: the force on the dof it is solved for. Fills model, multipliers and
/// `substitution`: coordinates of `labelled` from those of the result.
struct DualModel {
  model::SecondOrderModel model;
  std::vector<Multiplier> multipliers;
  Sparse map;
};
DualModel addMultipliers(const std::vector<Piece>& pieces, const Labelled& labelled, const Elimination& constraints);

}  // namespace tooljoint::coupling
