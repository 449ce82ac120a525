// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Slow and robust solution of an implicit step: modified Newton with exact tangents. The factor is
/// renewed if convergence is slow, each update is backtracked on the scaled residual, and points
/// whose force jumps are solved separately (CoupledPointSolve).
#pragma once

#include "transient/Integrator.hpp"
#include "transient/contact/CoupledPointSolve.hpp"
#include "transient/implicit/StepParts.hpp"

namespace tooljoint::transient {

class NewtonIteration {
 public:
  /// The referenced parts must outlive this.
  void bind(const StepParts& parts);
  /// Starts from a state with its linear residual; false on failure.
  bool solve(State& to, const StepScheme& scheme, Counters& counters);

 private:
  bool isSlow(double rate) const;
  void findChange();
  bool backtrack(State& to);
  bool solveTroubledPoints(State& to, double before);
  void place(State& to, double fraction);

  StepParts parts_;
  const StepScheme* scheme_ = nullptr;
  Counters* counters_ = nullptr;

  bool fresh_ = false;  ///< the tangent in the factor is that of the current iterate
  CoupledPointSolve nodal_;
  int rescues_ = 0;                         ///< uses of nodal_ in this step
  Vector delta_, change_;                   ///< update, and its change of the linear residual
  Vector base_, otherDelta_, otherChange_;  ///< residual and update before the troubled points
  struct {
    Vector q, v, a, linear;
  } start_;  ///< start of the line search
};

}  // namespace tooljoint::transient
