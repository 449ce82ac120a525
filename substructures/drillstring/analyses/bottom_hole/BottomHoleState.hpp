// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The static state of a bottom-hole assembly: figures.
#pragma once

#include <optional>

#include "substructures/drillstring/analyses/bottom_hole/BottomHole.hpp"
#include "substructures/drillstring/scene/Stages.hpp"

namespace tooljoint::drillstring {

/// Forces, tilt, sag, bending and balance of a static state without friction.
/// \param surveyTool  its distance from the bit [m]
BottomHoleState bottomHoleState(const Scene& part, const StaticStage& stage,
                                std::optional<double> surveyTool);

/// Sums of states with the same stations; of stresses, defects and tangency points the largest.
void addState(const BottomHoleState& one, BottomHoleState& sum);
void divideState(double count, BottomHoleState& sum);

}  // namespace tooljoint::drillstring
