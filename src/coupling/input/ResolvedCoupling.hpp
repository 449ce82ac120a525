// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// From the plan of a deck to parts that can be reduced and the connections that join them.
#pragma once

#include <vector>

#include "coupling/input/CouplingParameters.hpp"
#include "model/Substructure.hpp"

namespace tooljoint::coupling {

/// Parts with node numbers that say what is joined, with all dofs retained that connections name,
/// and what joins them.
struct ResolvedCoupling {
  std::vector<model::Substructure> parts;
  CouplingOptions options;
};

/// Displacements that connections see are measured from the reference states of the parts, so that
/// a part that has been linearised about its static state stays there: constraints hold as they
/// are, springs are relaxed (or hold what a released dof has carried). A released dof keeps the
/// force
///
///     r = K D_s - F - f(D_s)
///
/// that its joint exerts on the part in the reference state, and the rest of the model its
/// opposite, both as constant loads, unless the plan says otherwise or the part has no reference
/// state. A hinge between two nodes of one number releases them first. DeckError for parts and
/// components that do not exist, with the place in the deck; ModelError as in couple().
ResolvedCoupling resolve(const std::vector<model::Substructure>& parts, const CouplingInput& input);

}  // namespace tooljoint::coupling
