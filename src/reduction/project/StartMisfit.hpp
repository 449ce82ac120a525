// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What the bases of reduced parts do not represent of the start of a motion.
#pragma once

#include <vector>

#include "reduction/ReducedSubstructure.hpp"

namespace tooljoint::reduction {

/// Energy of what the bases do not represent of the start over the energy of the start; 0 for a
/// start at rest.
double startMisfit(const std::vector<ReducedSubstructure>& parts);

/// A warning where that is more than a hundredth.
void warnOfStart(const std::vector<ReducedSubstructure>& parts);

}  // namespace tooljoint::reduction
