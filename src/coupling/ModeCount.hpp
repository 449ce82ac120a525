// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Number of eigenvalues of the full model below a bound, from its parts and their coupled model.
#pragma once

#include <vector>

#include "coupling/Synthesis.hpp"

namespace tooljoint::coupling {

/// Number of eigenvalues of the undamped full model, K phi = lambda M phi, below `bound`
/// [rad^2/s^2], by Sylvester's law of inertia. With A = K - bound M of a part, its vectors Phi, the
/// modal columns W on the interior and r = (A Phi)_I, the interior outside the basis is the space Z
/// with W' A_II Z = 0, and
///
///     n(full) = n(A_c - sum_p L_p' r_p' F_p r_p L_p) + sum_p [ n(A_II) - n(W' A_II W) ] - 2 m
///     F_p = A_II^-1 - W (W' A_II W)^-1 W'
///
/// where n is the number of negative eigenvalues, A_c that of the coupled model, L_p takes its
/// coordinates to those of the part and m counts the multipliers of dual assembly (two coordinates
/// each). Compare W. H. Wittrick and F. W. Williams, Q. J. Mech. Appl. Math. 24 (1971) 263-284.
/// Interfaces are those of the coupled model: if they were reduced, the count is that of the full
/// parts on the reduced interfaces. Two factorisations for each part with missing modes.
///
/// For bases with their own mass only (MethodTraits::ownMass). ConvergenceError if `bound` is an
/// eigenvalue of the model or of the interior of a part. Collective; every rank gets the same.
int fullEigenvaluesBelow(const std::vector<model::Substructure>& parts, const Synthesis& synthesis,
                         double bound);

}  // namespace tooljoint::coupling
