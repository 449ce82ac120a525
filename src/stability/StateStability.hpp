// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Stability of a state at rest: negative pivots of its symmetric tangent and, for unsymmetric
/// equations, the rightmost damped eigenvalue.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "estimate/ModeComparison.hpp"
#include "linalg/DynamicStiffness.hpp"
#include "model/SecondOrderModel.hpp"

namespace tooljoint::stability {

/// Position of the largest displacement of a shape, and its sign changes along the nodes in the
/// direction of that displacement. Uses translations, or rotations for a torsional mode; nodes are
/// in the order of their labels.
struct ShapeOutline {
  std::int64_t node = 0;  ///< label of the node that moves most; 0 without motion
  std::string component;  ///< component that moves most there
  int halfWaves = 0;
};

/// Result of the assessment of q(0) of a model.
struct StateStability {
  /// Eigenvalues of the symmetric tangent (symmetric part of K, closed contacts linear, no
  /// friction) below -slowestGrowth^2. Negative pivots alone decide only for symmetric equations:
  /// gyroscopic and skew terms can stabilise such a state.
  int negativePivots = 0;
  double staticGrowthRate = 0.0;  ///< sqrt(-lambda_min) of the symmetric tangent [1/s]; 0 without
                                  ///< negative pivots
  /// Growth rate [1/s]: real part of the mode with the lowest frequency among the damped modes that
  /// grow nearly as fast as the fastest one. 0 if no damped modes were needed: without negative
  /// pivots only friction and skew stiffness can make a motion grow.
  double growthRate = 0.0;
  double frequency = 0.0;  ///< its imaginary part, Hz; 0 if the state is left without vibration
  bool refined = true;     ///< false: s is a Ritz value, not confirmed by the whole equations
  int examined = 0;      ///< modes in the projection of the damped equations; 0 if none were needed
  Vector shape;          ///< growing mode, dofs of the model, largest entry 1; empty if stable
  ShapeOutline outline;  ///< outline of `shape`
  /// Point sets whose laws have moving states (a delay line, the integral of a controller). The
  /// assessment holds these states as they are at rest, so growth due to them is not detected.
  std::vector<std::string> held;

  bool stable() const { return shape.size() == 0; }
  /// The state is left without vibration: another state of rest exists.
  bool diverges() const { return !stable() && frequency == 0.0; }
};

/// Limitation of a verdict on these modes, as a sentence after a blank; empty without such sets.
std::string withoutStates(const std::vector<std::string>& held);
/// Warns if the damped modes of a model at t [s] neglect moving states of point laws.
void warnOfHeldStates(const model::SecondOrderModel& model, double t);

/// Follows a damped mode of the equations with held states of point laws to moving states. Returns
/// the mode itself if the states do not move, if a law does not define how they do, or if the mode
/// is not found.
linalg::DampedMode followed(const model::SecondOrderModel& model, double t,
                            const estimate::Linearised& held, const linalg::DampedMode& mode);

/// Growth rates below this are not reported [1/s]: a disturbance takes more than a quarter of an
/// hour to grow by e.
constexpr double slowestGrowth = 1e-3;

/// Assesses q(0) with the matrices, laws and point laws of time t. The negative pivots are counted
/// by Sylvester's law of inertia. If there are some, or if friction or skew stiffness can make a
/// motion grow without them, the damped equations are projected on the lowest modes of the
/// symmetric tangent and on those of the components that point laws drive (friction that decreases
/// with speed). A growing mode found there is refined with the whole equations. If the refinement
/// does not converge, the nearest modes of the whole equations decide; if these are not found, the
/// projected mode is kept (`refined` false). Growth that needs motions beyond these modes, or the
/// states of point laws, is not detected (`tooljoint modes` lists more modes). The cost is linear
/// in the number of dofs. ModelError, ConvergenceError: the pivots could not be counted or the
/// modes not found.
StateStability assess(const model::SecondOrderModel& model, double t);

}  // namespace tooljoint::stability
