// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Joins parts into one model by equal labels of their interface dofs. Knows nothing of where the parts came from: any graph of
/// parts (chain, branch, loop) couples.
#pragma once

#include <vector>

#include "model/Substructure.hpp"
#include "reduction/ReducedSubstructure.hpp"

namespace tooljoint::coupling {

/// A coupled model and where the dofs of the parts went.
struct Coupling {
  model::SecondOrderModel model;
  std::vector<std::vector<int>> positions;  ///< positions[p][i]: dof of the coupled model that is dof i of part p
};

/// Primal assembly: A' = sum_p L_p' A_p L_p, L_p the Boolean map of part p, for mass, damping, stiffness and loads. Terms of one
/// name and one law become one term, laws are merged by name, every part keeps its own point sets, recovery rows of a node that
/// several parts have are taken from the first. Dofs are numbered by a Cuthill-McKee walk over nodes and modes, so a chain is
/// narrow. Throws ModelError: labels that join nothing, stand twice in a part or mean an inner dof of another part, different
/// component names, reference or initial states that differ at a shared dof by more than 1e-9 of the largest, recovery rows
/// of a node that disagree.
Coupling coupleWithPositions(const std::vector<reduction::ReducedSubstructure>& parts);
Coupling coupleWithPositions(const std::vector<model::Substructure>& parts);

model::SecondOrderModel couple(const std::vector<reduction::ReducedSubstructure>& parts);
/// Unreduced parts: the full model put together again.
model::SecondOrderModel couple(const std::vector<model::Substructure>& parts);

/// max |i - j| over the entries of mass, damping and stiffness.
int halfBandwidth(const model::SecondOrderModel& model);

}  // namespace tooljoint::coupling
