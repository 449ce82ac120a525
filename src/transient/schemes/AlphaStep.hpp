// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// One step of the generalized-alpha scheme (its equations stand in GeneralizedAlpha.cpp) from a
/// state and what the scheme remembers of the steps before. It chooses nothing: GeneralizedAlpha
/// does, once for the steps of a run and once for those that StepError takes again.
#pragma once

#include <memory>
#include <vector>

#include "transient/Integrator.hpp"
#include "transient/compiled/MassFactor.hpp"
#include "transient/schemes/AlphaCoefficients.hpp"
#include "transient/schemes/ImpactAccelerations.hpp"
#include "transient/schemes/ImplicitStep.hpp"

namespace tooljoint::transient {

class AlphaStep {
 public:
  struct Parameters {
    double radius = 1.0;  ///< spectral radius at infinite frequency
    bool phaseCorrection = true;
    ImplicitStep::Options equations;
  };
  explicit AlphaStep(const Parameters& parameters);
  const Parameters& parameters() const { return parameters_; }

  /// Bind to a model and complete state.a from state.{t, q, v}, for a first step of length h;
  /// counts a factorisation.
  void start(CompiledModel& model, double h, State& state, Counters& counters);
  /// Bind to the model of another step that has started, and share its mass.
  void startLike(const AlphaStep& other);
  /// What depends on the length alone.
  void prepare(double h, double t) { equation_.prepare(scheme(h), t); }

  /// A step of length h from `from` to to.t; false when the equations have no solution that can be
  /// found (with `anyway` their last iterate is taken, if it is made of numbers).
  bool take(const State& from, State& to, double h, bool anyway, Counters& counters);
  /// The step just taken counts: the next one starts where it ends.
  void keep();
  /// Append what the next step depends on beyond its state.
  void saveHistory(std::vector<double>& history) const;
  /// Start the next step, one of length h, at a state of another object whose steps are twice as
  /// long, with its history: A and what contact that lasts as an impact leaves in v are halved as
  /// far as they are of the order of the step.
  void startAgain(const double*& history, double h, State& from);

  /// Local error of the displacement in the step just taken, with or without what impacts have
  /// moved.
  const Vector& localError(double h, bool impacts);
  const Vector& lastError() const { return error_; }
  /// Energy [J] that the scheme has taken in the step kept last, of length h; 0 where it met walls
  /// as impacts, which the balance leaves out.
  double dissipated(const State& from, const State& to, double h) const;
  /// Whether points met walls as impacts in both of the last two steps. Collective.
  bool restsOnImpacts() const;
  const ImplicitStep& equation() const { return equation_; }
  /// After start().
  const MassFactor& mass() const { return *mass_; }
  /// MassFactor::inverse() is there from now on.
  void invertMass() { mass_->invert(*model_); }
  CompiledModel& model() const { return *model_; }

  /// Integrator::carry(), takeUp(); the numbers read are passed over.
  void carry(CarriedMemory& memory) const;
  void takeUp(const std::vector<Vector>& vectors, const double*& numbers);
  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  void bind(const Vector& a);
  StepScheme scheme(double h) const;
  void predict(const State& from, State& to, double h);
  void bindStates(const State& from, double h);
  void completeStates(const State& from, State& to);
  void complete(const State& from, State& to, double h);
  void restoreHistory(const double*& history);

  Parameters parameters_;
  AlphaCoefficients alpha_;
  CompiledModel* model_ = nullptr;
  ImplicitStep equation_;
  std::shared_ptr<MassFactor> mass_;
  Vector A_, nextA_;         ///< algorithmic acceleration at t_n, t_{n+1}
  Vector X_, nextX_, base_;  ///< the same for states of point laws; x_{n+1} without x'_{n+1}
  ImpactAccelerations impacts_, lastImpacts_;  ///< of the step under way and of the one before
  Vector error_;
  mutable Vector work_;
};

}  // namespace tooljoint::transient
