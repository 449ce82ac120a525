// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The state at t = 0 in reduced coordinates.
#pragma once

#include "reduction/ReductionMethod.hpp"

namespace tooljoint::reduction {

/// q with q_C = x_C and q_D the least-squares solution of phi_D q_D = x_I - phi_C x_C (Nguyen et
/// al. 2020, (38)-(42)). Exactly zero for x = 0.
Vector fitState(const Basis& basis, const Vector& x);

/// D(0) = offset + Phi displacement, D'(0) = Phi velocity.
struct StartState {
  Vector offset;        ///< dofs of the part
  Vector displacement;  ///< reduced coordinates
  Vector velocity;      ///< reduced coordinates
  Vector forces;        ///< on the interface in the static state, one for each of Basis::forceDofs
};

/// With `keepStatic`, offset = D_s, the reference state of the part (zero without one), else 0.
/// Where interface forces are coordinates, these are the changes of the forces from those of the
/// static state, forces = (K D_s - F - R' f(D_s))_b at t = 0, which load the part from then on.
StartState startState(const model::Substructure& part, const Basis& basis, bool keepStatic);

}  // namespace tooljoint::reduction
