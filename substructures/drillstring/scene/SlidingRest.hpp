// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The state of rest of a string that may buckle: it slides there from a slight helix while its
/// friction and the loads at the bit come in parts.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "model/NonlinearSolve.hpp"
#include "substructures/drillstring/DrillString.hpp"
#include "substructures/equilibrium/Equilibrium.hpp"

namespace tooljoint::drillstring {

/// The static problem with this share, 0 to 1, of the loads at the bit (w and theta_z of the last
/// node).
using SharedProblem = std::function<equilibrium::StaticInput(double share)>;

/// The displacement without friction, 6 per node. A string on the axis of a long level hole has
/// next to nothing that resists sideways: where the stages of the static state fail, it slides down
/// from there against viscous forces. ConvergenceError.
/// \param mass  diagonal of the mass matrix, 6 entries per node [kg, kg m2]
Vector withoutFriction(equilibrium::StaticInput input, const equilibrium::StaticOptions& options,
                       const model::NonlinearSolver& solver, const Vector& mass);

/// States of rest of one string under one problem, walls that only push.
class SlidingRest {
 public:
  struct Rest {
    equilibrium::StaticState state;
    int negativePivots;  ///< of the tangent; 0: stable but for friction
  };
  struct Found {
    std::optional<Rest> rest;
    int iterations = 0;     ///< of Newton's method, all together
    bool buckled = false;   ///< it slid to rest from a slight helix
    bool locksUp = false;   ///< why it found no buckled state
    bool driven = false;    ///< likewise: friction drives it round the hole
    std::string unsettled;  ///< the same as a sentence; empty where it found one, or needed none
    std::string advice;     ///< what may help then; a sentence, or empty
  };

  SlidingRest(const DrillString& string, const equilibrium::StaticOptions& options, Vector mass,
              SharedProblem problem);

  /// The state next to `start`, the displacement without friction; where that is unstable, or there
  /// is none, the one that the string slides to from a slight helix. InterruptedError.
  Found from(const Vector& start) const;

  /// The same state under all that the contact laws do, attraction of open points included. None:
  /// the string does not come to rest under it.
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
