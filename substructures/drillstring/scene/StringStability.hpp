// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Messages and actions for the stability of the static state of a string.
#pragma once

#include <string>

#include "io/summary/Summary.hpp"
#include "substructures/drillstring/scene/Stages.hpp"

namespace tooljoint::drillstring {

/// Stability of the state in words: verdict, mode and growth rate.
std::string describeStability(const StaticStage& stage);

/// The keys static.stable, .stability_without, .negative_pivots, .growth_rate, .growth_hz,
/// .unstable_node, .unstable_half_waves and .perturbations.
void summariseStability(const StaticStage& stage, io::Summary& summary);

/// For an unstable static state a warning, or a ConvergenceError if Static/Unstable State is
/// "Refuse".
void judgeStability(const Scene& scene, const StaticStage& stage);

}  // namespace tooljoint::drillstring
