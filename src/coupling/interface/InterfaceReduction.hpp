// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Reduction of the joined dofs of a coupled model.
#pragma once

#include <vector>

#include "coupling/assembly/Assembler.hpp"
#include "reduction/methods/InterfaceBasis.hpp"

namespace tooljoint::coupling {

/// Replaces the joined dofs (except those with point laws, if the basis keeps them) by modes of the
/// interfaces, u = Psi xi + Psi_C u_C, in all matrices, loads, point rows, recovery and maps. A
/// start outside their span is fitted by least squares in the mass norm. The previous model is kept
/// as `wholeInterfaces`. A coupled model without joined dofs is not changed. ModelError for a model
/// with multipliers.
/// \param joinable  number of leading coordinates of each part that may be joined; dofs that join
/// the
///                  same parts form one interface. Empty: all of them. The others may depend on
///                  every joined dof (DependentCoordinates).
void reduceInterfaces(Coupling& coupling, const reduction::InterfaceBasis& basis,
                      const std::vector<int>& joinable = {});

}  // namespace tooljoint::coupling
