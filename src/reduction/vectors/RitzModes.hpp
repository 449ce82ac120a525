// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Modal columns from any vectors of the interior: the Rayleigh-Ritz modes of the space they span,
/// boundary dofs fixed.
#pragma once

#include <string>
#include <vector>

#include "reduction/ReductionMethod.hpp"
#include "reduction/part/InteriorStatics.hpp"

namespace tooljoint::reduction {

/// Vectors that live on some interior dofs.
struct VectorGroup {
  std::vector<int> positions;  ///< of the part, increasing
  Matrix columns;              ///< positions x vectors; of any length, not necessarily independent
};

/// Completes `basis` from the constraint modes and the space of `groups`: Phi = [I 0; phi_C W],
/// where W are the Ritz modes of each group, W' M_II W = I, W' sym(K)_II W = diag(omega^2), sorted
/// by omega^2. Vectors that depend on the others to 1e-10 in the mass norm are left out. The groups
/// must not be joined by mass or stiffness. Whatever vectors span the space, these coordinates give
/// the same reduced model, with the structure of Craig and Bampton's. Sets vectors, eigenvalues,
/// modeKind, orthonormal, orthogonality. M_II may be singular where K is symmetric: vectors that
/// move no mass are left out, static answers are those of the constraint modes. ModelError
/// otherwise, and where M_II is indefinite.
void completeWithRitzModes(const PartView& part, const ConstraintModes& constraint,
                           const std::vector<VectorGroup>& groups, const std::string& kind,
                           Basis& basis);

/// What the kept free-interface modes add to the constraint modes, with the boundary dofs held.
/// From K phi = omega^2 M phi + S phi, S the skew part of K, and phi_C = -K_II^-1 K_IC:
///
///     y = phi_I - phi_C phi_b = K_II^-1 (omega^2 M phi + S phi)_I,     of a rigid-body mode   y =
///     K_II^-1 (M phi)_I,
///
/// without the difference of nearly equal vectors, and with the inertia-relief answer to rigid-body
/// acceleration as the limit omega -> 0. One group for each free block; mechanisms of the interior
/// are among its vectors. Rigid-body modes and elastic ones can be left out.
std::vector<VectorGroup> freeInterfaceVectors(const PartView& part, const InteriorVectors& modes,
                                              const InteriorStatics& statics, bool rigid = true,
                                              bool elastic = true);

}  // namespace tooljoint::reduction
