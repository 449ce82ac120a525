// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Lagrange multipliers for the constraints of a model whose parts keep their own dofs.
#pragma once

#include <vector>

#include "coupling/assembly/AlignedParts.hpp"
#include "coupling/assembly/Assembler.hpp"
#include "coupling/assembly/Elimination.hpp"
#include "coupling/assembly/LabelAssembly.hpp"

namespace tooljoint::coupling {

/// A model with multipliers.
struct DualModel {
  model::SecondOrderModel model;
  std::vector<Multiplier> multipliers;
  Sparse map;  ///< coordinates of `labelled` from those of the model
};
/// Adds two multipliers for each constraint that `constraints` solved: each half of the force on
/// the dof that the constraint is solved for.
DualModel addMultipliers(const std::vector<AlignedPart>& alignedParts, const Labelled& labelled,
                         const Elimination& constraints);

}  // namespace tooljoint::coupling
