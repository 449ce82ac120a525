// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Bends, eccentric gauges and pads in the nodal frames of the bent string. They point to sides of
/// the string counted from its scribe line, which stands at the tool face at the bit and is carried
/// up the string without twist, as the nodal frames are. The twist of the static state does not
/// turn it.
#pragma once

#include <string>
#include <vector>

#include "substructures/contact/ContactPoints.hpp"
#include "substructures/drillstring/DrillString.hpp"
#include "substructures/drillstring/EquationBuilder.hpp"
#include "substructures/path/PathState.hpp"

namespace tooljoint::drillstring {

/// x, y components of the unit vector to a side of the string: h cos a + (t x h) sin a with the
/// high side h, the tangent t down the hole, and a the tool face plus `direction` [rad].
Eigen::Vector2d towardsSide(const DrillString& string, const path::PathState& path,
                            double direction);

/// What turns an element at its upper end against the nodal frames without stress, 12 dofs of every
/// element; empty without bends [rad].
std::vector<beam::Vector12> kinks(const DrillString& string, const path::PathState& path);

/// Centre of the gauge from that of the string for every contact point; empty where all are
/// concentric [m].
std::vector<Eigen::Vector2d> gaugeOffsets(const DrillString& string, const path::PathState& path,
                                          const contact::ContactPoints& points);

/// Adds the forces of pads on the string to the loads that are constant in time.
void addPads(const DrillString& string, const path::PathState& path, PathEquations& equations);

}  // namespace tooljoint::drillstring
