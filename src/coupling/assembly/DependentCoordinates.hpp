// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Condenses the dependent coordinates of a coupled model.
#pragma once

#include "coupling/assembly/Assembler.hpp"
#include "reduction/ReductionMethod.hpp"

namespace tooljoint::coupling {

/// Inserts q = [1; rows] z into all matrices, loads, point rows, recovery and maps; z are the other
/// coordinates. A start outside their span is fitted by least squares in the mass norm. No effect
/// without dependent coordinates. ModelError for a model with multipliers.
void condenseDependent(Coupling& coupling, const reduction::DependentCoordinates& dependent);

/// Replaces the old coupled dofs in the maps of the parts: old = map * new.
void changeCoordinates(Coupling& coupling, const Sparse& map);

}  // namespace tooljoint::coupling
