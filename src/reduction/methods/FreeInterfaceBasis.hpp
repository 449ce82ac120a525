// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The space that Rubin, Craig and Chang, and MacNeal share: free-interface modes and the residual
/// flexibility of the others.
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

/// The span of the kept free-interface modes Phi, rigid-body ones always among them, and of the
/// residual attachment modes
///
///     Psi = A G A' B - Phi_e Lambda_e^-1 Phi_e' B,     A = I - Phi_r Phi_r' M,
///
/// B the unit forces on all boundary dofs, G any generalised inverse of K. It is computed in other
/// vectors of the same space, which need no generalised inverse and no difference of flexibilities:
/// constraint modes and what the modes add to them with the boundary dofs held
/// (freeInterfaceVectors). Constraint modes are those of the full K, so the part answers loads on
/// boundary dofs exactly, whatever torque or circulatory forces are in K. Coordinates: boundary
/// dofs, and the Ritz modes of the space with boundary dofs held. With all modes the space is
/// everything.
FreeInterfaceBasis freeInterfaceBasis(const PartView& part, const ModeRequest& request);

/// Changes the coordinates of `free` to (boundary dofs, amplitudes p = Phi' M D of the
/// free-interface modes), the columns of the boundary dofs then being residual attachment modes, D
/// = Psi Psi_b^-1 (u_b
/// - Phi_b p) + Phi p. That is possible as far as there is residual flexibility: combinations of
/// modes whose share in motions with held boundary dofs is below 0.1 in the mass norm (the last
/// modes of a part) are not coordinates, and Ritz modes stay in their place. Returns the amplitudes
/// p as rows over the new coordinates, modes x coordinates.
Matrix toModeAmplitudes(const PartView& part, FreeInterfaceBasis& free);

}  // namespace tooljoint::reduction
