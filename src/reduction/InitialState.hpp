// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The state at t = 0 in reduced coordinates.
#pragma once

#include "reduction/Basis.hpp"

namespace tooljoint::reduction {

/// q with q_C = x_C and q_D the least-squares solution of phi_D q_D = x_I - phi_C x_C (Nguyen et al. 2020, (38)-(42)).
/// Exactly zero for x = 0.
Vector fitState(const BasisResult& basis, const Vector& x);

}  // namespace tooljoint::reduction
