// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Decision whether ranks divide a motion.
#pragma once

#include <memory>

#include "transient/Integrator.hpp"
#include "transient/TransientParameters.hpp"
#include "transient/ranks/RankShare.hpp"

namespace tooljoint::transient {

/// The share of this rank; null if all ranks compute the same (with a warning if the deck requests
/// otherwise). Collective.
std::unique_ptr<RankShare> shareOf(const model::SecondOrderModel& model,
                                   const TransientOptions& options, const Integrator& integrator);

}  // namespace tooljoint::transient
