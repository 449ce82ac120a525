// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A numbering of dofs that keeps coupled ones close.
#pragma once

#include <utility>
#include <vector>

namespace tooljoint::coupling {

/// Cuthill-McKee order of the groups 0 .. size-1 (E. Cuthill, J. McKee 1969) from a
/// pseudo-peripheral group (A. George, J. W. H. Liu 1979): order[k] is the k-th group.
/// Deterministic; a chain starts at its lower end group. \param edges  pairs of coupled groups, in
/// any order, repetitions allowed
std::vector<int> cuthillMcKee(int size, const std::vector<std::pair<int, int>>& edges);

}  // namespace tooljoint::coupling
