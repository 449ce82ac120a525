// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Part of the initial state of a motion that a coupled reduced model does not represent.
#pragma once

#include "coupling/Synthesis.hpp"

namespace tooljoint::coupling {

/// Lost energy of the initial state over its total energy; 0 for a start at rest. Energy is lost if
/// the bases do not represent the state, or if the coupling removes coordinates: those that depend
/// on others, and interface dofs replaced by modes.
double startMisfit(const Synthesis& synthesis);

/// Warns if this exceeds a hundredth.
void warnOfStart(const Synthesis& synthesis);

}  // namespace tooljoint::coupling
