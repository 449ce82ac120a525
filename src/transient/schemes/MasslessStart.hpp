// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Start of a motion where degrees of freedom have no mass.
#pragma once

#include "transient/Integrator.hpp"
#include "transient/compiled/MassFactor.hpp"

namespace tooljoint::transient {

/// Put dofs s without mass, damping and points in balance with the others, m:
///
///     K_ss q_s = F_s - K_sm q_m,   K_ss v_s = -K_sm v_m
///
/// They follow the others at every instant; any other start would be left in the first step, with
/// energy that the motion does not have. Where K_ss is singular the state stays as it is.
/// Collective; the model is at the time of the state.
void balanceMassless(CompiledModel& model, const MassFactor& mass, State& state);

}  // namespace tooljoint::transient
