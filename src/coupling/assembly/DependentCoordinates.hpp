// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Condenses the dependent coordinates of a coupled model.
#pragma once

#include "coupling/assembly/Assembler.hpp"
#include "reduction/ReductionMethod.hpp"

namespace tooljoint::coupling {

/// q = [1; rows] z in all matrices, loads, point rows, recovery and maps, z the other coordinates;
/// a start that is not in their span is fitted in least squares of mass. Nothing happens without
/// dependent coordinates. ModelError for a model with multipliers.
void condenseDependent(Coupling& coupling, const reduction::DependentCoordinates& dependent);

/// Coordinates of the parts after old coupled dofs = map * new ones.
void changeCoordinates(Coupling& coupling, const Sparse& map);

}  // namespace tooljoint::coupling
