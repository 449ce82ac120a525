// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Dofs without mass whose motion or damping a basis does not hold.
#pragma once

#include "model/Substructure.hpp"

namespace tooljoint::reduction {

/// Interior dofs without mass are what the others make them, x_m = -K_mm^-1 K_mr x_r. A basis has
/// this of the symmetric part of K.
void warnOfUnsymmetricMassless(const model::Substructure& part);

/// Interior dofs without mass follow the others through springs and dampers, a motion of first
/// order that modes of mass and stiffness do not hold; where C = alpha K in the rows of all of
/// them, their static answer is exact.
void warnOfDampedMassless(const model::Substructure& part);

/// The flexibility of dofs without mass is in no mode; bases whose residual coordinates have no
/// damping lose what damps them.
void warnOfDampedMasslessBoundary(const model::Substructure& part);

}  // namespace tooljoint::reduction
