// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Modal columns from any vectors of the interior: the Rayleigh-Ritz modes of their span with fixed
/// boundary dofs.
#pragma once

#include <string>
#include <vector>

#include "reduction/ReductionMethod.hpp"
#include "reduction/part/InteriorStatics.hpp"

namespace tooljoint::reduction {

/// Vectors that are nonzero only on some interior dofs.
struct VectorGroup {
  std::vector<int> positions;  ///< of the part, increasing
  Matrix columns;              ///< positions x vectors; of any length, may be dependent
};

/// Completes `basis` from the constraint modes and the space of `groups`: Phi = [I 0; phi_C W],
/// where W are the Ritz modes of each group, W' M_II W = I, W' sym(K)_II W = diag(omega^2), sorted
/// by omega^2. Vectors that depend on the others to 1e-10 in the mass norm are omitted. Mass and
/// stiffness must not couple the groups. These coordinates give the same reduced model for any
/// vectors that span the space, with the structure of Craig and Bampton's. Sets vectors,
/// eigenvalues, modeKind, orthonormal, orthogonality. M_II may be singular if K is symmetric:
/// massless vectors are omitted, and static responses come from the constraint modes. Otherwise
/// ModelError, also if M_II is indefinite.
void completeWithRitzModes(const PartView& part, const ConstraintModes& constraint,
                           const std::vector<VectorGroup>& groups, const std::string& kind,
                           Basis& basis);

/// Additions of the kept free-interface modes to the constraint modes, with the boundary dofs held.
/// From K phi = omega^2 M phi + S phi, with the skew part S of K, and phi_C = -K_II^-1 K_IC:
///
///     y = phi_I - phi_C phi_b = K_II^-1 (omega^2 M phi + S phi)_I
///     for a rigid-body mode   y = K_II^-1 (M phi)_I,
///
/// without a difference of nearly equal vectors, and with the inertia-relief response to rigid-body
/// acceleration as the limit omega -> 0. One group for each free block; it includes the mechanisms
/// of the interior. Rigid-body modes and elastic modes can be omitted.
std::vector<VectorGroup> freeInterfaceVectors(const PartView& part, const InteriorVectors& modes,
                                              const InteriorStatics& statics, bool rigid = true,
                                              bool elastic = true);

}  // namespace tooljoint::reduction
