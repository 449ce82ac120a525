// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What is said of scenes that are valid, but whose results are not those of a drillstring.
#pragma once

#include <string>

#include "substructures/drillstring/scene/Scene.hpp"

namespace tooljoint::drillstring {

/// A sentence when the deck takes the pre-stress "Axial and torque" in a well that bends; else "".
std::string prestressRemark(const Scene& scene);

/// A sentence when the friction of the bit falls with its speed in a string whose damping does not
/// rise with the frequency; else "".
std::string bitFrictionRemark(const Scene& scene);

/// A sentence when an unbalance turns with the set speed of a drive that does not hold it; else "".
std::string unbalanceRemark(const Scene& scene);

/// A sentence when friction acts along the hole at nodes that a reduced model does not keep; else
/// "".
std::string axialFrictionRemark(const Scene& scene);

}  // namespace tooljoint::drillstring
