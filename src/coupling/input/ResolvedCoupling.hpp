// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Resolves the list `Coupling` into parts that can be reduced and the connections between them.
#pragma once

#include <vector>

#include "coupling/input/CouplingParameters.hpp"
#include "model/Substructure.hpp"

namespace tooljoint::coupling {

/// Parts with equal numbers for joined nodes and with retained dofs for all connections, and the
/// connections.
struct ResolvedCoupling {
  std::vector<model::Substructure> parts;
  CouplingOptions options;
};

/// Displacements in connections are relative to the reference states of the parts. A part
/// linearised about its static state therefore stays there: constraints hold, springs are relaxed
/// (or carry the force of a released dof). The joint of a released dof exerts the force
///
///     r = K D_s - F - f(D_s)
///
/// on the part in the reference state. The dof keeps this force, and the rest of the model its
/// opposite, both as constant loads, unless the list specifies otherwise or the part has no
/// reference state. A hinge between two nodes with the same number releases them first. DeckError
/// with the position in the deck for unknown parts and components; ModelError as in couple().
ResolvedCoupling resolve(const std::vector<model::Substructure>& parts, const CouplingInput& input);

}  // namespace tooljoint::coupling
