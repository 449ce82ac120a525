// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// From an unstable state of rest to the next one, with inertia-weighted implicit Euler steps in a
/// pseudo-time: along the unstable mode and then downhill, or sliding with friction.
#pragma once

#include <functional>

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

/// alpha with which a string that may buckle begins to slide [1/s2]: the square of twice the growth
/// rate, 1 to 5 1/s, of drill pipe.
constexpr double slidingAlpha = 100.0;

/// How a string slides to rest.
struct SlideRequest {
  Vector mass;  ///< diagonal of the mass matrix, 6 entries per node [kg, kg m2]
  double frictionScale = 1.0;
  double pull = 0.0;  ///< share of the attraction of open points to the wall
  double tolerance = 0.0;
  double alpha = slidingAlpha;  ///< of the first step; 0: Newton's method while it converges
  int mostIterations = 0;
  /// True for a displacement (6 entries per node) past which nothing is looked for.
  std::function<bool(const Vector& full)> stop;
};

/// What one string did.
struct Slide {
  bool rests = false;
  int iterations = 0;
  double residual = 0.0;  ///< scaled, of the static equilibrium
};

/// Moves x (free dofs) to a state of rest under all forces that the switches of `problem` name,
/// friction included, by the overdamped motion alpha diag(M) x' + r(x) = 0 in steps of one Newton
/// iteration each,
///
///     (alpha diag(M) + J(x_n)) (x_n+1 - x_n) = -r(x_n)
///
/// (pseudo-transient continuation; C. T. Kelley and D. E. Keyes, SIAM J. Numer. Anal. 35 (1998)
/// 508-523). alpha grows where a step is long beside the clearance and shrinks while steps become
/// shorter: a wave that grows keeps it above the square of its growth rate. Friction has no energy
/// that falls, so nothing guarantees that the motion ends.
Slide slideToRest(const StaticInput& input, const StaticProblem& problem, const SlideRequest& asked,
                  Vector& x);

}  // namespace tooljoint::equilibrium
