// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Coupling of a fixed-interface mode to the boundary of its part.
#pragma once

#include <vector>

#include "reduction/ReductionMethod.hpp"
#include "reduction/selection/ModeChoice.hpp"

namespace tooljoint::reduction {

/// Share of every modal column of `basis` in the coupling of the part's interior to its boundary
/// dofs, in [0, 1]; the shares of all modes of the part add up to 1. With the inertia L = M_IC +
/// M_II psi, the constraint modes psi, and L_k = phi_k' L, the condensed dynamic stiffness is K_0 -
/// omega^2 M_0 - sum_k omega^4 L_k' L_k / (omega_k^2 - omega^2). The share of mode k is the mean
/// over the boundary dofs j of
///
///     InterfaceMass:    L_kj^2 / (L' M_II^-1 L)_jj
///         D. C. Kammer and M. J. Triller, J. Vib. Acoust. 118 (1996) 264-270
///     InterfaceMoment:  (L_kj^2 / omega_k^2) / (L' K_II^-1 L)_jj
///         B.-S. Liao, Z. Bai and W. Gao, Int. J. Numer. Meth. Engng 70 (2007) 1581-1597: the first
///         moment of the sum at omega = 0
///
/// Each dof is normalised by its own total, so units do not mix; dofs without coupling to modes are
/// ignored. Modes with omega_k^2 <= 0 count fully. Needs mass-orthonormal fixed-interface modes
/// (basis.orthonormal); ModelError when M_II or K_II is singular.
Vector interfaceShares(const PartView& part, const Basis& basis, ModeRule::Kind kind);

/// Selects the modes for a given fraction: by decreasing share until their sum reaches it; modes
/// with omega^2 <= 0 always, close pairs completely. 1 for a kept mode. Empty when the shares do
/// not reach the fraction, so that more modes are needed.
std::vector<char> keepByShare(const Vector& shares, const Vector& eigenvalues, double fraction,
                              double pairTolerance);

}  // namespace tooljoint::reduction
