// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Motion from an unstable static state to the next one, with inertia-weighted implicit Euler steps
/// in a pseudo-time: along the unstable mode and then downhill in energy, or by sliding with
/// friction.
#pragma once

#include <functional>

#include "model/NonlinearSolve.hpp"
#include "substructures/equilibrium/StaticProblem.hpp"

namespace tooljoint::equilibrium {

/// An unstable mode of a static state; vectors with 6 entries per node.
struct UnstableMode {
  Vector shape;             ///< scaled arbitrarily
  Vector mass;              ///< diagonal of the mass matrix [kg, kg m2]; 0 at held dofs
  double growthRate = 0.0;  ///< of the symmetric tangent [1/s]
};

/// Cost and result of one call of `settle`.
struct SettlingReport {
  int iterations = 0;
  double residual = 0.0;  ///< scaled, of the static equilibrium without friction
};

/// Moves x (free dofs) from an unstable state to a minimum of the energy of the string without
/// friction and with walls that only push. After a small displacement along the mode, the steps
///
///     r(x) + alpha diag(M) (x - x_n) = 0,   alpha = 4 growthRate^2,
///
/// are convex problems and each lowers the energy (R. T. Rockafellar, SIAM J. Control Optim. 14
/// (1976) 877-898). When the string rests, alpha is lowered to its final value. Uses the switches
/// of `problem` except friction and pull. ConvergenceError: the motion is not limited (no contact,
/// or a mode without lateral motion), or the string does not come to rest.
SettlingReport settle(const StaticInput& input, StaticProblem& problem, const UnstableMode& mode,
                      double tolerance, const model::NonlinearSolver& solve, Vector& x);

/// Initial alpha of a string that may buckle [1/s2]: the square of twice the growth rate of drill
/// pipe, 1 to 5 1/s.
constexpr double slidingAlpha = 100.0;

/// Input of slideToRest.
struct SlideRequest {
  Vector mass;  ///< diagonal of the mass matrix, 6 entries per node [kg, kg m2]
  double frictionScale = 1.0;
  double pull = 0.0;  ///< fraction of the attraction of open points to the wall
  double tolerance = 0.0;
  double alpha = slidingAlpha;  ///< of the first step; 0: Newton's method while it converges
  int mostIterations = 0;
  /// Returns true for a displacement (6 entries per node) at which the search ends.
  std::function<bool(const Vector& full)> stop;
};

/// Result of slideToRest.
struct Slide {
  bool rests = false;
  int iterations = 0;
  double residual = 0.0;  ///< scaled, of the static equilibrium
};

/// Moves x (free dofs) to a static state under all forces that are active in `problem`, friction
/// included, by the overdamped motion alpha diag(M) x' + r(x) = 0 in steps of one Newton iteration
/// each,
///
///     (alpha diag(M) + J(x_n)) (x_n+1 - x_n) = -r(x_n)
///
/// (pseudo-transient continuation; C. T. Kelley and D. E. Keyes, SIAM J. Numer. Anal. 35 (1998)
/// 508-523). alpha grows when a step is long relative to the clearance and shrinks while steps
/// become shorter; a growing wave keeps it above the square of its growth rate. Friction has no
/// potential energy that falls, so the motion need not end.
Slide slideToRest(const StaticInput& input, const StaticProblem& problem, const SlideRequest& asked,
                  Vector& x);

}  // namespace tooljoint::equilibrium
