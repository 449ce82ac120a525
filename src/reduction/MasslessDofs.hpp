// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Massless dofs whose motion or damping a basis does not represent.
#pragma once

#include "model/Substructure.hpp"

namespace tooljoint::reduction {

/// Interior dofs without mass depend on the others, x_m = -K_mm^-1 K_mr x_r. A basis uses the
/// symmetric part of K for this.
void warnOfUnsymmetricMassless(const model::Substructure& part);

/// Interior dofs without mass are driven by the others through springs and dampers. This is a
/// first-order motion that modes of mass and stiffness do not represent. If C = alpha K in all
/// their rows, their static response is exact.
void warnOfDampedMassless(const model::Substructure& part);

/// No mode contains the flexibility of dofs without mass; bases whose residual coordinates have no
/// damping lose their damping.
void warnOfDampedMasslessBoundary(const model::Substructure& part);

}  // namespace tooljoint::reduction
