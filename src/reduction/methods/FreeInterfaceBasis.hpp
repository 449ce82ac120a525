// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The space of Rubin, Craig and Chang, and MacNeal: free-interface modes and the residual
/// flexibility of the other modes.
#pragma once

#include <memory>

#include "reduction/vectors/RitzModes.hpp"

namespace tooljoint::reduction {

struct FreeInterfaceBasis {
  Basis basis;
  InteriorVectors modes;
  std::unique_ptr<InteriorStatics> statics;  ///< of the interior of basis.partition
  Matrix shapes;                             ///< kept free-interface modes, dofs x modes
};

/// The span of the kept free-interface modes Phi, always with the rigid-body modes, and of the
/// residual attachment modes
///
///     Psi = A G A' B - Phi_e Lambda_e^-1 Phi_e' B,     A = I - Phi_r Phi_r' M,
///
/// with the unit forces B on all boundary dofs and any generalised inverse G of K. It is computed
/// from other vectors of the same space, which need no generalised inverse and no difference of
/// flexibilities: constraint modes, and the additions of the modes with the boundary dofs held
/// (freeInterfaceVectors). Constraint modes use the full K, so the response to loads on boundary
/// dofs is exact with any torque or circulatory forces in K. Coordinates: boundary dofs, and the
/// Ritz modes of the space with boundary dofs held. With all modes this is the whole space.
FreeInterfaceBasis freeInterfaceBasis(const PartView& part, const ModeRequest& request);

/// Changes the coordinates of `free` to (boundary dofs, amplitudes p = Phi' M D of the
/// free-interface modes). The columns of the boundary dofs are then residual attachment modes, D =
/// Psi Psi_b^-1 (u_b - Phi_b p) + Phi p. This needs residual flexibility: combinations of modes
/// whose share in motions with held boundary dofs is below 0.1 in the mass norm (the last modes of
/// a part) do not become coordinates, and Ritz modes remain in their place. Returns the amplitudes
/// p as rows over the new coordinates, modes x coordinates.
Matrix toModeAmplitudes(const PartView& part, FreeInterfaceBasis& free);

}  // namespace tooljoint::reduction
