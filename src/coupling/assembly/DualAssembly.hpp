// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Lagrange multipliers for the constraints of a model of parts that keep their own dofs.
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
/// Two multipliers for each constraint that `constraints` solved: halves of the force on the dof it
/// is solved for.
DualModel addMultipliers(const std::vector<AlignedPart>& alignedParts, const Labelled& labelled,
                         const Elimination& constraints);

}  // namespace tooljoint::coupling
