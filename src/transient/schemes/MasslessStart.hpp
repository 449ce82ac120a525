// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Start of a motion where degrees of freedom have no mass.
#pragma once

#include "transient/Integrator.hpp"
#include "transient/compiled/MassFactor.hpp"

namespace tooljoint::transient {

/// Put motions s without mass and damping in balance with the others, m:
///
///     K_ss q_s = F_s - K_sm q_m + f_s(q, v),   (K_ss - f_d) v_s = -K_sm v_m
///
/// by Newton's method with M + tau (C - f_v) + tau^2 (K - f_d), tau far below the shortest period:
/// what has mass or damping stays. What has damping alone gets the rate that brings it into
/// balance, C_dd v_d = F_d + f_d(q + h v, v) - K (q + h v) - C v_m for the first step h. Motions
/// s follow the others at every instant; any other start would be left in the first step, with
/// energy that the motion does not have. Where that does not succeed the state stays as it is,
/// which is warned of. Collective; the model is at the time of the state, its states of laws are
/// bound.
void balanceMassless(CompiledModel& model, const MassFactor& mass, double h, State& state);

/// a := q'' of M q'' = a for a mass matrix that is singular in motions of several dofs, of a state
/// in balance: q''_s follows the others as in balanceMassless(). False where that does not succeed.
bool solveSingularMass(CompiledModel& model, const MassFactor& mass, State& state);

}  // namespace tooljoint::transient
