// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Bends, eccentric gauges and pads in the nodal frames of the bent string. Their sides are
/// measured from the scribe line of the string. The scribe line is at the tool face at the bit and
/// is carried up the string without twist, like the nodal frames. The twist of the static state
/// does not turn it.
#pragma once

#include <string>
#include <vector>

#include "substructures/contact/ContactPoints.hpp"
#include "substructures/drillstring/DrillString.hpp"
#include "substructures/drillstring/EquationBuilder.hpp"
#include "substructures/path/PathState.hpp"

namespace tooljoint::drillstring {

/// x, y components of the unit vector to a side of the string: h cos a + (t x h) sin a with the
/// high side h, the tangent t down the hole, and a = tool face plus `direction` [rad].
Eigen::Vector2d towardsSide(const DrillString& string, const path::PathState& path,
                            double direction);

/// Stress-free rotation of the upper end of each element relative to the nodal frames, 12 dofs per
/// element; empty without bends [rad].
std::vector<beam::Vector12> kinks(const DrillString& string, const path::PathState& path);

/// Offset of the gauge centre from the string centre for every contact point; empty if all are
/// concentric [m].
std::vector<Eigen::Vector2d> gaugeOffsets(const DrillString& string, const path::PathState& path,
                                          const contact::ContactPoints& points);

/// Adds the forces of pads on the string to the constant loads.
void addPads(const DrillString& string, const path::PathState& path, PathEquations& equations);

}  // namespace tooljoint::drillstring
