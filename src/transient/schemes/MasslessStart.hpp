// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Start of a motion with massless degrees of freedom.
#pragma once

#include "transient/Integrator.hpp"
#include "transient/compiled/MassFactor.hpp"

namespace tooljoint::transient {

/// Balances motions s without mass and damping with the other motions m:
///
///     K_ss q_s = F_s - K_sm q_m + f_s(q, v),   (K_ss - f_d) v_s = -K_sm v_m
///
/// by Newton's method with M + tau (C - f_v) + tau^2 (K - f_d). tau is far below the shortest
/// period, so dofs with mass or damping do not move. Dofs with damping only get the rate that
/// balances them, C_dd v_d = F_d + f_d(q + h v, v) - K (q + h v) - C v_m for the first step h.
/// Motions s follow the others at every instant; from any other start they would jump in the first
/// step and release energy that the motion does not have. If it fails, the state is unchanged and a
/// warning is given. Collective; the model must be at the time of the state, with its states of
/// laws bound.
void balanceMassless(CompiledModel& model, const MassFactor& mass, double h, State& state);

/// a := q'' of M q'' = a for a mass matrix that is singular in motions of several dofs, for a state
/// in balance: q''_s follows the others as in balanceMassless(). False on failure.
bool solveSingularMass(CompiledModel& model, const MassFactor& mass, State& state);

}  // namespace tooljoint::transient
