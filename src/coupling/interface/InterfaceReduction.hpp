// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Reduction of the joined dofs of a coupled model.
#pragma once

#include "coupling/assembly/Assembler.hpp"
#include "reduction/methods/InterfaceBasis.hpp"

namespace tooljoint::coupling {

/// Replaces the joined dofs (but those with point laws, where the basis keeps them) by modes of the
/// interfaces, u = Psi xi + Psi_C u_C, in all matrices, loads, point rows, recovery and maps; a
/// start that is not in their span is fitted in least squares of mass. What was there before stays
/// as `wholeInterfaces`. A coupled model without joined dofs is not changed. ModelError for a model
/// with multipliers.
void reduceInterfaces(Coupling& coupling, const reduction::InterfaceBasis& basis);

}  // namespace tooljoint::coupling
