// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a coupled reduced model does not represent of the start of a motion.
#pragma once

#include "coupling/Synthesis.hpp"

namespace tooljoint::coupling {

/// Energy of what is lost of the start over the energy of the start; 0 for a start at rest. Lost is
/// what the bases do not represent, and what the coupling does not leave them: coordinates that
/// depend on others, modes of interfaces.
double startMisfit(const Synthesis& synthesis);

/// A warning where that is more than a hundredth.
void warnOfStart(const Synthesis& synthesis);

}  // namespace tooljoint::coupling
