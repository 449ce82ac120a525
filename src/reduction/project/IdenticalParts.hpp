// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Detection of identical parts, which are reduced once.
#pragma once

#include <vector>

#include "model/Substructure.hpp"
#include "reduction/selection/ModeChoice.hpp"

namespace tooljoint::reduction {

/// For each part the first part it is identical to (itself when there is none): same partition,
/// same law names, same request, and matrices in the part's own dofs (nodal frames, so the position
/// of the part does not matter) equal to |a_ij - b_ij| <= e sqrt(r_i r_j). Here r are the largest
/// entries of the rows of all terms of that law, and e = Substructure::rounding, which must be
/// equal too. Loads, labels, points and states may differ. A part is compared with the first part
/// of the previous one, then with parts with the same sum of magnitudes of stiffness entries. This
/// takes one pass over the matrices of a part with a representative, and avoids n^2 / 2 comparisons
/// of n different parts.
std::vector<int> findIdenticalParts(const std::vector<model::Substructure>& parts,
                                    const std::vector<ModeRequest>& requests);

}  // namespace tooljoint::reduction
