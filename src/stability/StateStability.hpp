// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Whether a state at rest is stable: negative pivots of its symmetric tangent and, where the
/// equations are not symmetric, the rightmost damped eigenvalue.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "estimate/ModeComparison.hpp"
#include "linalg/DynamicStiffness.hpp"
#include "model/SecondOrderModel.hpp"

namespace tooljoint::stability {

/// Where a shape is largest, and how often it changes sign in the direction it has there, by its
/// translations, of a torsional mode by its rotations; nodes in the order of their labels.
struct ShapeOutline {
  std::int64_t node = 0;  ///< label of the node that moves most; 0 where nothing moves
  std::string component;  ///< component that moves most there
  int halfWaves = 0;
};

/// What is known of the stability of q(0) of a model.
struct StateStability {
  /// Eigenvalues of the symmetric tangent (symmetric part of K, closed contacts linear, no
  /// friction) below -slowestGrowth^2. A negative pivot alone decides for symmetric equations only:
  /// gyroscopic and skew terms can stabilise such a state.
  int negativePivots = 0;
  double staticGrowthRate = 0.0;  ///< sqrt(-lambda_min) of the symmetric tangent [1/s]; 0 without
                                  ///< negative pivots
  /// Of the damped modes found that grow nearly as fast as the fastest one, the real part of that
  /// of lowest frequency [1/s]; 0 where none was needed: without negative pivots only friction and
  /// skew stiffness can make a motion grow.
  double growthRate = 0.0;
  double frequency = 0.0;  ///< its imaginary part, Hz; 0 for a state that is left without vibration
  bool refined = true;  ///< false: s is a Ritz value of the projection, which the whole equations
                        ///< did not confirm
  int examined = 0;     ///< modes the damped equations were projected on; 0 where none was needed
  Vector shape;  ///< of the growing mode, dofs of the model, largest entry 1; empty when stable
  ShapeOutline outline;  ///< of that
  /// Point sets whose laws have states that follow a motion (a delay line, the integral of a
  /// controller), which the assessment leaves as they are at rest: what grows by them is not seen.
  std::vector<std::string> held;

  bool stable() const { return shape.size() == 0; }
  /// The state is left without vibration: another state of rest exists.
  bool diverges() const { return !stable() && frequency == 0.0; }
};

/// What a verdict on these modes leaves out, as a sentence after a blank; empty without such sets.
std::string withoutStates(const std::vector<std::string>& held);
/// Warns of it where the damped modes of a model at t [s] leave out states of point laws.
void warnOfHeldStates(const model::SecondOrderModel& model, double t);

/// What a damped mode of the equations with held states of point laws becomes when they follow it.
/// The mode itself where they do not move, where a law does not say how they do, and where that is
/// not found.
linalg::DampedMode followed(const model::SecondOrderModel& model, double t,
                            const estimate::Linearised& held, const linalg::DampedMode& mode);

/// Growth rates below this are not reported [1/s]: a disturbance takes more than a quarter of an
/// hour to grow by e.
constexpr double slowestGrowth = 1e-3;

/// Assesses q(0) with the matrices, laws and point laws of time t. The negative pivots are counted
/// by Sylvester's law of inertia. Where there are some, or where friction or skew stiffness can
/// make a motion grow without them, the damped equations are projected on the lowest modes of the
/// symmetric tangent and on those of the components that point laws drive (friction that falls with
/// the speed), and a growing mode found there is refined with the whole equations; where the
/// refinement does not converge, those of their modes that are nearest decide, and where they are
/// not found, the projected mode is kept (`refined` false). Growth that needs
/// motions beyond these modes, or the states of point laws, is not seen (`tooljoint modes` lists
/// more modes). The cost is linear in the
/// number of dofs. ModelError, ConvergenceError: the pivots could not be counted or the modes not
/// be found.
StateStability assess(const model::SecondOrderModel& model, double t);

}  // namespace tooljoint::stability
