// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Whether ranks divide a motion.
#pragma once

#include <memory>

#include "transient/Integrator.hpp"
#include "transient/TransientParameters.hpp"
#include "transient/ranks/RankShare.hpp"

namespace tooljoint::transient {

/// The share of this rank; null where all ranks do the same, which a warning says if the deck wants
/// for something else. Collective.
std::unique_ptr<RankShare> shareOf(const model::SecondOrderModel& model,
                                   const TransientOptions& options, const Integrator& integrator);

}  // namespace tooljoint::transient
