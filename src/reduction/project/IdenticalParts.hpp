// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Which parts are identical: they are reduced once.
#pragma once

#include <vector>

#include "model/Substructure.hpp"
#include "reduction/selection/ModeChoice.hpp"

namespace tooljoint::reduction {

/// For each part the first part it is identical to (itself when there is none): same partition,
/// same law names, same request, and matrices in the part's own dofs (nodal frames: where the part
/// lies does not matter) equal to |a_ij - b_ij| <= e sqrt(r_i r_j), r the largest entries of the
/// rows of all terms of that law, e = Substructure::rounding, which is the same too. Loads, labels,
/// points and states may differ. A part is compared with the first part of the one before it, then
/// with those whose stiffness entries have the same sum of sizes: one pass over its matrices where
/// it has a representative, and n different parts are not compared n^2 / 2 times.
std::vector<int> findIdenticalParts(const std::vector<model::Substructure>& parts,
                                    const std::vector<ModeRequest>& requests);

}  // namespace tooljoint::reduction
