// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The static state of a string that may buckle: the string slides there from a slight helix while
/// its friction and the loads at the bit grow in increments.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "model/NonlinearSolve.hpp"
#include "substructures/drillstring/DrillString.hpp"
#include "substructures/equilibrium/Equilibrium.hpp"

namespace tooljoint::drillstring {

/// The static problem with this fraction, 0 to 1, of the loads at the bit (w and theta_z of the
/// last node).
using SharedProblem = std::function<equilibrium::StaticInput(double share)>;

/// The displacement without friction, 6 per node. A string on the axis of a long level hole has
/// almost no lateral stiffness: if the stages of the static solution fail, it slides down from the
/// axis against viscous forces. ConvergenceError. \param mass  diagonal of the mass matrix, 6
/// entries per node [kg, kg m2]
Vector withoutFriction(equilibrium::StaticInput input, const equilibrium::StaticOptions& options,
                       const model::NonlinearSolver& solver, const Vector& mass);

/// Static states of one string under one problem, with walls that only push.
class SlidingRest {
 public:
  struct Rest {
    equilibrium::StaticState state;
    int negativePivots;  ///< of the tangent; 0: stable apart from friction
  };
  struct Found {
    std::optional<Rest> rest;
    int iterations = 0;     ///< Newton iterations, in total
    bool buckled = false;   ///< reached by sliding from a slight helix
    bool locksUp = false;   ///< reason why no buckled state was found
    bool driven = false;    ///< likewise: friction drives the string round the hole
    std::string unsettled;  ///< the reason as a sentence; empty if a state was found, or none was
                            ///< needed
    std::string advice;     ///< possible remedy, a sentence; may be empty
  };

  SlidingRest(const DrillString& string, const equilibrium::StaticOptions& options, Vector mass,
              SharedProblem problem);

  /// The state nearest to `start`, the displacement without friction. If it is unstable or does not
  /// exist, the state that the string reaches by sliding from a slight helix. InterruptedError.
  Found from(const Vector& start) const;

  /// The same state under the full contact laws, including the attraction of open points. None: the
  /// string does not come to rest under it.
  std::optional<equilibrium::StaticState> withPull(const equilibrium::StaticState& state) const;

 private:
  std::optional<Rest> near(double share, const Vector& start, double tolerance, double alpha,
                           int& iterations) const;
  std::optional<Rest> slide(const Vector& start, Found& why) const;
  equilibrium::SlideRequest request(double share, double tolerance) const;
  std::string tooLong(const Vector& axialForce) const;
  bool compressed(const equilibrium::StaticProblem& problem, const Vector& x) const;
  Vector withHelix(const equilibrium::StaticInput& input, const Vector& displacement) const;

  const DrillString& string_;
  equilibrium::StaticOptions options_;
  Vector mass_;
  SharedProblem problem_;
};

}  // namespace tooljoint::drillstring
