// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Krylov vectors of the interior driven by the boundary dofs: quasi-static modes (W.-H. Shyu,
/// Z.-D. Ma, G. M. Hulbert, A new component mode synthesis method: quasi-static mode compensation,
/// Finite Elements in Analysis and Design 24 (1997) 271-281) and, for damped parts, second-order
/// Krylov vectors (Z. Bai, Y. Su, SOAR: A second-order Arnoldi method for the solution of the
/// quadratic eigenvalue problem, SIAM J. Matrix Anal. Appl. 26 (2005) 640-659; Dimension reduction
/// of large-scale second-order dynamical systems via a second-order Arnoldi method, SIAM J. Sci.
/// Comput. 26 (2005) 1692-1709).
#pragma once

#include "reduction/part/PartView.hpp"
#include "reduction/vectors/InteriorVectors.hpp"

namespace tooljoint::reduction {

struct KrylovOptions {
  double frequency;  ///< expansion point [Hz]; with damping s0 = 2 pi f on the real axis
  bool damped;
  double time;  ///< of the laws of the damping matrices [s]
};

/// Ritz vectors of the Krylov space of every interior block; blocks that touch no boundary dof keep
/// their lowest modes. With a cut-off frequency there are as many vectors as fixed-interface
/// modes below it. ModelError when the expansion point is a natural frequency.
InteriorVectors krylovVectors(const PartView& part, const ModeRequest& request,
                              const KrylovOptions& options);

}  // namespace tooljoint::reduction
