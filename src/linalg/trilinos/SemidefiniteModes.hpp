// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Modes of pencils with singular mass: massless dofs, Lagrange multipliers.
#pragma once

#include <string>

#include "common/Error.hpp"
#include "linalg/trilinos/EigenSolver.hpp"

namespace tooljoint::linalg {

/// K and M are singular together: some motion has neither mass nor stiffness.
struct SingularPencil : ModelError {
  explicit SingularPencil(const std::string& mostMoved)
      : ModelError(
            "Stiffness and mass are singular together, most strongly in " + mostMoved +
            ": some dof has neither mass nor stiffness, or the model has the same constraint "
            "twice."),
        dof(mostMoved) {}
  std::string dof;  ///< dof that moves most
};

/// The `count` lowest finite modes (all of them if there are fewer, or for count < 0) of K phi =
/// lambda M phi with K symmetric of any inertia and M symmetric positive semi-definite, phi' M phi
/// = 1. Dense: with M = W W' and a shift sigma,
///
///     W' (K - sigma M)^-1 W y = y / (lambda - sigma),   phi = (K - sigma M)^-1 W y,
///
/// where zero eigenvalues are the infinite ones of the pencil; lambda is then the Rayleigh quotient
/// of phi. ModelError: sizes differ, K or M unsymmetric or not finite, M indefinite (dof named).
/// SingularPencil: K and M singular together. ConvergenceError: residuals above options.tolerance.
EigenPairs semidefiniteModes(const Sparse& K, const Sparse& M, int count,
                             const EigenOptions& options = {});

/// Whether M, scaled to unit diagonal, has a pivot that is rounding: massless dofs, multipliers,
/// residual flexibility without mass.
bool hasSingularMass(const Sparse& M);

/// Whether a dof has no mass or, for a matrix that is not large, a motion of several dofs has none.
bool hasMasslessMotion(const Sparse& M);

/// lowestModes, or semidefiniteModes if some motion has no mass: at most `count`, all finite ones
/// if there are fewer.
EigenPairs lowestFiniteModes(const Sparse& K, const Sparse& M, int count,
                             const EigenOptions& options = {});

}  // namespace tooljoint::linalg
