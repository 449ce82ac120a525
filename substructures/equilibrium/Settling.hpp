// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// From an unstable state of rest to the next one: along the unstable mode and then downhill, with
/// inertia-weighted implicit Euler steps in a pseudo-time.
#pragma once

#include "model/NonlinearSolve.hpp"
#include "substructures/equilibrium/StaticProblem.hpp"

namespace tooljoint::equilibrium {

/// An unstable mode of a state of rest; vectors with 6 entries per node.
struct UnstableMode {
  Vector shape;             ///< of any size
  Vector mass;              ///< diagonal of the mass matrix [kg, kg m2]; 0 at held dofs
  double growthRate = 0.0;  ///< of the symmetric tangent [1/s]
};

/// What one solve of `settle` took.
struct SettlingReport {
  int iterations = 0;
  double residual = 0.0;  ///< scaled, of the static equilibrium without friction
};

/// Moves x (free dofs) from an unstable state to a minimum of the energy of the string without
/// friction and with walls that only push: a small displacement along the mode, then steps of
///
///     r(x) + alpha diag(M) (x - x_n) = 0,   alpha = 4 growthRate^2,
///
/// each of which is a convex problem and lowers the energy (R. T. Rockafellar, SIAM J. Control
/// Optim. 14 (1976) 877-898), until the string rests; then alpha is lowered to the end. Uses the
/// switches of `problem` but for friction and pull. ConvergenceError: nothing limits the motion
/// (no contact, or a mode that does not move sideways), or the string does not come to rest.
SettlingReport settle(const StaticInput& input, StaticProblem& problem, const UnstableMode& mode,
                      double tolerance, const model::NonlinearSolver& solve, Vector& x);

}  // namespace tooljoint::equilibrium
