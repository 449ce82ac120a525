// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Torque and drag of a string with bending stiffness, clearance and contact: its static state with
/// the friction of an operation.
#pragma once

#include <string>
#include <vector>

#include "substructures/drillstring/EquationBuilder.hpp"
#include "substructures/drillstring/figures/BendingFigures.hpp"
#include "substructures/drillstring/scene/Scene.hpp"
#include "substructures/drillstring/scene/SlidingRest.hpp"
#include "substructures/equilibrium/Equilibrium.hpp"
#include "substructures/path/PathState.hpp"
#include "substructures/softstring/SoftString.hpp"

namespace tooljoint::drillstring {

/// The smallest ratio of allowed to present load, and its position.
struct Margin {
  double factor = 0.0;  ///< infinite if the string is not loaded
  double depth = 0.0;   ///< measured depth [m]
};

/// Loads of the stiff string in one operation. Forces and torques as those of softstring::Loads.
struct StiffLoads {
  std::string failure;                         ///< why there is no equilibrium; empty if there is
                                               ///< one
  bool locksUp = false;                        ///< the reason is lock-up
  std::string unsettled;                       ///< why no buckled state was found; may be empty
  std::string advice;                          ///< possible remedy, a sentence; may be empty
  double hookLoad = 0.0, surfaceTorque = 0.0;  ///< without block weight [N, N m]
  double twist = 0.0;                          ///< of the surface relative to the bit [rad]
  double stretch = 0.0;                        ///< by effective tension [m]
  double torqueDefect = 0.0;                   ///< StaticState::relativeTorqueDefect()
  int iterations = 0;                          ///< Newton iterations, in total
  bool buckled = false;  ///< reached by sliding from an unstable state, or, by torqueDrag(), wound
                         ///< into a helix beyond the helical limit
  double turns = 0.0;    ///< of a compressed stretch that lies on the wall, about the hole
  int negativePivots = 0;                       ///< of the tangent; 0: stable apart from friction
  std::vector<double> depth;                    ///< of the nodes, from the surface [m]
  std::vector<double> contactForce;             ///< of each node [N]
  std::vector<double> tension, torque, moment;  ///< of each element, at its middle [N, N m]
  std::vector<double> vonMises;                 ///< of each element, by torqueDrag() [Pa]
  Margin yield;                                 ///< at the middle of an element, by torqueDrag()
  Margin sinusoidal, helical;                   ///< to buckling, likewise
  Margin joint;  ///< largest contact force of a joint of pipe [N] and its middle, likewise

  bool found() const { return failure.empty(); }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(failure, locksUp, unsettled, advice, buckled, turns, hookLoad, surfaceTorque, twist,
            stretch, torqueDefect, iterations, negativePivots, depth, contactForce, tension, torque,
            moment);
  }
};

/// The string with its bit at one depth. The nodes have the positions of the loaded string that
/// hangs without friction, so displacements are due to drag, weight on bit and contact only.
/// (Relative to the unloaded string, kilometres of string would move by metres along a well that
/// turns.)
class StiffString {
 public:
  /// Bends the string into the well and computes its equilibrium without friction. DeckError if it
  /// does not fit into the hole; ConvergenceError.
  StiffString(const Scene& scene, double bit);

  /// The static state with the sliding of the operation and the `Dynamic` friction coefficient. If
  /// the state close to the frictionless one is unstable or does not exist, the state that the
  /// string reaches by sliding from a slight helix. A missing equilibrium is marked in the result.
  StiffLoads under(const softstring::Operation& operation) const;

 private:
  equilibrium::StaticInput input(const softstring::Operation& operation) const;

  Scene scene_;
  path::PathState path_;
  PathEquations equations_;
  std::vector<BendingElement> bending_;
  contact::ContactPoints points_;
  Vector mass_;          ///< diagonal of the mass matrix, 6 entries per node
  Vector frictionless_;  ///< displacement of the string that hangs without friction
};

}  // namespace tooljoint::drillstring
