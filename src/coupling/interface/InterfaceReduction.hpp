// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Reduction of the joined dofs of a coupled model.
#pragma once

#include <vector>

#include "coupling/assembly/Assembler.hpp"
#include "reduction/methods/InterfaceBasis.hpp"

namespace tooljoint::coupling {

/// Replaces the joined dofs (but those with point laws, where the basis keeps them) by modes of the
/// interfaces, u = Psi xi + Psi_C u_C, in all matrices, loads, point rows, recovery and maps; a
/// start that is not in their span is fitted in least squares of mass. What was there before stays
/// as `wholeInterfaces`. A coupled model without joined dofs is not changed. ModelError for a model
/// with multipliers.
/// \param joinable  how many coordinates of each part, its first ones, may be joined; dofs that
/// join
///     the same parts are one interface. Empty: all of them. The others may depend on every joined
///     dof (DependentCoordinates).
void reduceInterfaces(Coupling& coupling, const reduction::InterfaceBasis& basis,
                      const std::vector<int>& joinable = {});

}  // namespace tooljoint::coupling
