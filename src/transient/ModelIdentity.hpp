// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Is this the model, and are these the steps, that a checkpoint came from?
#pragma once

#include <string>

#include "model/SecondOrderModel.hpp"
#include "transient/TransientParameters.hpp"

namespace tooljoint::transient {

/// SHA-256 over everything a motion depends on: dofs, matrices, loads, laws of time (at 33 times of
/// the window), point laws (their forces at the start and beyond their clearance in each
/// direction), initial state, and the options but for progress and, where the integrator can go on
/// from anywhere, the checkpoint interval. 64 hexadecimal digits.
std::string modelIdentity(const model::SecondOrderModel& model, const TransientOptions& options);

}  // namespace tooljoint::transient
