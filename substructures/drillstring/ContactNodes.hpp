// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Nodes of a string that can touch the wall.
#pragma once

#include <string>
#include <vector>

#include "substructures/contact/ContactParameters.hpp"
#include "substructures/drillstring/DrillString.hpp"

namespace tooljoint::drillstring {

/// A contact point for every node whose u and v are not both held (`held` has 6 flags per node),
/// with the parameters of its depth; in order of the nodes.
contact::ContactPoints contactPoints(const contact::ContactSettings& settings,
                                     const DrillString& string, const std::vector<char>& held);

}  // namespace tooljoint::drillstring
