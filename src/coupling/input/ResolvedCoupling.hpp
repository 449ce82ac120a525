// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Resolves the list `Coupling` into parts that can be reduced and the connections between them.
#pragma once

#include <vector>

#include "coupling/input/CouplingParameters.hpp"
#include "model/Substructure.hpp"

namespace tooljoint::coupling {

/// Parts with equal numbers for joined nodes and with all dofs of connections retained, and the
/// connections.
struct ResolvedCoupling {
  std::vector<model::Substructure> parts;
  CouplingOptions options;
};

/// Displacements in connections are relative to the reference states of the parts, so that a part
/// linearised about its static state stays there: constraints hold, springs are relaxed (or carry
/// the force of a released dof). A released dof keeps the
/// force
///
///     r = K D_s - F - f(D_s)
///
/// that its joint exerts on the part in the reference state, and the rest of the model its
/// opposite, both as constant loads, unless the list says otherwise or the part has no reference
/// state. A hinge between two nodes of one number releases them first. DeckError for parts and
/// components that do not exist, with the place in the deck; ModelError as in couple().
ResolvedCoupling resolve(const std::vector<model::Substructure>& parts, const CouplingInput& input);

}  // namespace tooljoint::coupling
