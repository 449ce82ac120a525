// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Nonlinear equations of one implicit step. From the q, a of a step with v = 0 at its end,
///
///     M (a + ca delta) + cv C delta + K (q + delta) = F + R' f(q + delta, cv delta, t)
///
/// (with M replaced by M - k M (I - s ca (s ca M + K)^-1 M) if the scheme has a phase correction,
/// see AlphaCoefficients::setPhaseCorrection) is solved for delta = v / cv. The first method is
/// relaxation of the point forces with the effective matrix S = ca M + cv C + K - R'PR factored
/// once (ContactForceIteration). If this is slow, modified Newton with exact tangents follows
/// (NewtonIteration).
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "transient/Integrator.hpp"
#include "transient/compiled/CompiledModel.hpp"
#include "transient/implicit/ContactForceIteration.hpp"
#include "transient/implicit/NewtonIteration.hpp"

namespace tooljoint::transient {

class ImplicitStep {
 public:
  struct Options {
    double tolerance = 0;  ///< on max |w R| over the largest scaled force
    int maxIterations = 25;
    StrategySet without;  ///< strategies not to use
  };

  ImplicitStep() = default;
  ImplicitStep(const ImplicitStep&) = delete;  // its parts refer to each other
  ImplicitStep& operator=(const ImplicitStep&) = delete;

  void bind(CompiledModel& model, const Options& options);

  /// Prepares the data that depend only on the scheme; solve() calls it for a new scheme.
  void prepare(const StepScheme& scheme, double t);
  /// Completes `to`, the end of a step from the time `begin`. On entry it has q and a for v = 0,
  /// and the predicted v. False if no iteration converged (`to` then holds the last iterate).
  bool solve(double begin, State& to, const StepScheme& scheme, Counters& counters);

  /// Whether the iterate left by a failed solve() is finite.
  bool isFinite() const { return std::isfinite(equations_.merit()); }
  /// max |w R| over the largest scaled force, and its location, at the end of the last solve().
  double relativeError() const { return equations_.relativeError(); }
  std::string worstName() const { return equations_.worstName(); }

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  bool relax(State& to, Counters& counters);
  bool finish(State& to, Counters& counters);
  void predict(State& to) const;

  CompiledModel* model_ = nullptr;
  StepScheme scheme_;
  Strategies strategies_;
  StepEquations equations_;
  StepFactor factor_;
  ContactForceIteration relaxation_;
  NewtonIteration newton_;
  State predicted_;  ///< for restoring
};

}  // namespace tooljoint::transient
