// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Remarks on scenes that are valid, but whose results are not realistic for a drillstring.
#pragma once

#include <string>

#include "substructures/drillstring/scene/Scene.hpp"

namespace tooljoint::drillstring {

/// A sentence if the deck uses the pre-stress "Axial and torque" in a well that bends; else "".
std::string prestressRemark(const Scene& scene);

/// A sentence if the friction of the bit falls with its speed and the damping of the string does
/// not rise with the frequency; else "".
std::string bitFrictionRemark(const Scene& scene);

/// A sentence if an unbalance turns with the set speed of a drive that does not hold that speed;
/// else "".
std::string unbalanceRemark(const Scene& scene);

/// A sentence if friction acts along the hole at nodes that a reduced model does not retain; else
/// "".
std::string axialFrictionRemark(const Scene& scene);

/// A sentence if a Torque On Bit of fixed direction drives a string that turns the other way; else
/// "".
std::string torqueOnBitRemark(const Scene& scene);

}  // namespace tooljoint::drillstring
