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

/// The least of a ratio of allowed to present load, and where it stands.
struct Margin {
  double factor = 0.0;  ///< infinite where nothing loads the string
  double depth = 0.0;   ///< measured depth [m]
};

/// Loads of the stiff string in one operation. Forces and torques as those of softstring::Loads.
struct StiffLoads {
  std::string failure;                          ///< why there is no equilibrium; empty: there is
  bool locksUp = false;                         ///< that is why
  std::string unsettled;                        ///< why no buckled state was found
  std::string advice;                           ///< what may help then; a sentence, or empty
  double hookLoad = 0.0, surfaceTorque = 0.0;   ///< without block weight [N, N m]
  double twist = 0.0;                           ///< of the surface ahead of the bit [rad]
  double stretch = 0.0;                         ///< by effective tension [m]
  double torqueDefect = 0.0;                    ///< StaticState::relativeTorqueDefect()
  int iterations = 0;                           ///< of Newton's method, all together
  bool buckled = false;                         ///< it slid to rest from an unstable state
  int negativePivots = 0;                       ///< of the tangent; 0: stable but for friction
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
    archive(failure, locksUp, unsettled, advice, buckled, hookLoad, surfaceTorque, twist, stretch,
            torqueDefect, iterations, negativePivots, depth, contactForce, tension, torque, moment);
  }
};

/// The string with its bit at one depth. The nodes stand where they are in the loaded string, the
/// hanging one without friction: displacements are those by drag, weight on bit and contact alone.
/// (From nodes of the unloaded string, kilometres of it would move by metres along a well that
/// turns.)
class StiffString {
 public:
  /// Bends the string into the well and finds its equilibrium without friction. DeckError where it
  /// does not fit into the hole; ConvergenceError.
  StiffString(const Scene& scene, double bit);

  /// The static state that slides as the operation says, with the `Dynamic` friction coefficient.
  /// Where the one near the string without friction is unstable, or there is none, the one that the
  /// string slides to from a slight helix. An equilibrium that is not found is marked in the
  /// result.
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
