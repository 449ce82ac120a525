// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What `tooljoint modes` prints and writes, whatever the parts came from.
#pragma once

#include <vector>

#include "app/Commands.hpp"
#include "estimate/AdaptiveReduction.hpp"

namespace tooljoint::app {

/// Undamped and damped modes of one model: of a scene without Reduction; as CSV into
/// options.output, if one is given.
void listFullModes(const model::SecondOrderModel& full, const RunOptions& options, double t);

/// Full and coupled modes side by side, undamped and with the matrices of time t; as CSV into
/// options.output, if one is given. \param maps of the full model where it was coupled from the
/// parts, see estimate::compareModes
void listComparedModes(const model::SecondOrderModel& full, const std::vector<Sparse>& maps,
                       const std::vector<model::Substructure>& parts,
                       const coupling::Synthesis& synthesis, const RunOptions& options, double t);

}  // namespace tooljoint::app
