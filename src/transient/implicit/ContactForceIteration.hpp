// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Fast solution of an implicit step: relaxation of the point forces with a factor of S that many
/// steps share (ContactForceUpdate). Once per step it includes the phase correction and the points
/// that have only just touched. If correcting all points at once does not converge, they are
/// corrected in turns.
#pragma once

#include <vector>

#include "transient/Integrator.hpp"
#include "transient/contact/ContactForceUpdate.hpp"
#include "transient/implicit/MatrixDrift.hpp"
#include "transient/implicit/StepParts.hpp"
#include "transient/implicit/Turns.hpp"

namespace tooljoint::transient {

class ContactForceIteration {
 public:
  /// The referenced parts must outlive this.
  void bind(const StepParts& parts);
  /// False if the strategy is left out, or a point has too many coordinates.
  bool isPossible() const { return possible_; }
  /// The scheme or its step has changed.
  void prepare(const StepScheme& scheme);
  /// Starts from the q, a of a step with v = 0 at its end, and the predicted v. False, with `to`
  /// unchanged, if it does not converge.
  bool solve(State& to, const StepScheme& scheme, Counters& counters);
  /// Moves `to` from its initial values to the end of the iteration.
  void complete(State& to) const;

  void save(std::vector<double>& memory) const { points_.impacts().save(memory); }
  void restore(const double*& memory, const StepScheme& scheme);

 private:
  bool settle(const State& to, bool again);
  bool begin(const State& to);
  bool join(const State& to);
  double relaxOnce(const State& to, bool near);
  const Vector* otherForces();

  StepParts parts_;
  const StepScheme* scheme_ = nullptr;
  Counters* counters_ = nullptr;

  ContactForceUpdate points_;
  bool possible_ = false;
  long compliance_ = -1;  ///< number of the factor to which the compliance belongs
  Vector delta_, q_;      ///< delta, and q at the end of the step
  MatrixDrift drift_;
  Vector others_;  ///< forces besides linear residual and points
};

}  // namespace tooljoint::transient
