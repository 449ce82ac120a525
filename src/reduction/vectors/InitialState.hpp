// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The state at t = 0 in reduced coordinates.
#pragma once

#include "reduction/ReductionMethod.hpp"

namespace tooljoint::reduction {

/// q with q_C = x_C and q_D the least-squares solution of phi_D q_D = x_I - phi_C x_C (Nguyen et
/// al. 2020, (38)-(42)). Exactly zero for x = 0.
Vector fitState(const Basis& basis, const Vector& x);

/// The same with q_D that minimises (x - Phi q)' M (x - Phi q), the kinetic energy of the lost part
/// of a velocity, whatever the units of the dofs:
///
///     phi_D' M phi_D (q_D - p) = phi_D' M (x - phi_C x_C - phi_D p),
///
/// with p from fitState(basis, x), which applies where vectors have no mass.
Vector fitState(const Basis& basis, const Sparse& mass, const Vector& x);

/// D(0) = offset + Phi displacement, D'(0) = Phi velocity.
struct StartState {
  Vector offset;        ///< dofs of the part
  Vector displacement;  ///< reduced coordinates
  Vector velocity;      ///< reduced coordinates
  Vector forces;        ///< on the interface in the static state, one for each of Basis::forceDofs
};

/// With `keepStatic`, offset = D_s, the reference state of the part (zero without one), and the
/// deviation from it is fitted in the mass norm; otherwise offset = 0, and D(0) is fitted dof by
/// dof as in the source. Velocities are fitted in the mass norm. Coordinates that are interface
/// forces are changes relative to the static state, forces = (K D_s - F - R' f(D_s))_b at t = 0,
/// which remain as loads on the part.
StartState startState(const model::Substructure& part, const Basis& basis, bool keepStatic);

}  // namespace tooljoint::reduction
