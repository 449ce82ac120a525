// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Results of the static state of a bottom-hole assembly.
#pragma once

#include <optional>

#include "substructures/drillstring/analyses/bottom_hole/BottomHole.hpp"
#include "substructures/drillstring/scene/Stages.hpp"

namespace tooljoint::drillstring {

/// Forces, tilt, sag, bending and balance of a static state without friction.
/// \param surveyTool  distance of the survey tool from the bit [m]
BottomHoleState bottomHoleState(const Scene& part, const StaticStage& stage,
                                std::optional<double> surveyTool);

/// Adds a state with the same stations to a sum; keeps the largest stresses, defects and tangency
/// point.
void addState(const BottomHoleState& one, BottomHoleState& sum);
void divideState(double count, BottomHoleState& sum);

}  // namespace tooljoint::drillstring
