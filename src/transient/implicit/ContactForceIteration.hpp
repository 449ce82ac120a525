// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The fast way through an implicit step: relaxation of the point forces with a factor of S that
/// many steps share (ContactForceUpdate). Once in a step it takes the phase correction and the
/// points that have only just touched into account; where all points at once do not get there, they
/// take turns.
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
  /// What the parts are must outlive this.
  void bind(const StepParts& parts);
  /// Not where it is left out, or a point has too many coordinates.
  bool isPossible() const { return possible_; }
  /// The scheme or its step changed.
  void prepare(const StepScheme& scheme);
  /// From the q, a of a step that would end at rest, and the predicted v. False, with `to` as it
  /// was, when it does not get there.
  bool solve(State& to, const StepScheme& scheme, Counters& counters);
  /// From `to` as it was to where the iteration stopped.
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
  long compliance_ = -1;  ///< number of the factor whose compliance the points have
  Vector delta_, q_;      ///< and q at its end
  MatrixDrift drift_;
  Vector others_;  ///< forces beside the linear residual and the points
};

}  // namespace tooljoint::transient
