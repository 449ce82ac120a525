// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// One step of the generalized-alpha scheme (equations in GeneralizedAlpha.cpp) from a state and
/// the history of the scheme. GeneralizedAlpha makes all decisions, both for the steps of a run and
/// for those repeated by StepError.
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
  /// Bind to the model of another step after its start(), and share its mass.
  void startLike(const AlphaStep& other);
  /// Prepares the data that depend only on the step length.
  void prepare(double h, double t) { equation_.prepare(scheme(h), t); }

  /// A step of length h from `from` to to.t; false if no solution of the equations is found (with
  /// `anyway` the last iterate is accepted if it is finite).
  bool take(const State& from, State& to, double h, bool anyway, Counters& counters);
  /// Accepts the last step: the next one starts at its end.
  void keep();
  /// Append the history of the next step beyond its state.
  void saveHistory(std::vector<double>& history) const;
  /// Start the next step, of length h, at a state of another object with steps twice as long and
  /// with its history. The parts of A, and of v from contact that rests as an impact, that are of
  /// the order of the step are halved.
  void startAgain(const double*& history, double h, State& from);

  /// Local error of the displacement in the last step, with or without the motion due to impacts.
  const Vector& localError(double h, bool impacts);
  const Vector& lastError() const { return error_; }
  /// Energy [J] that the scheme has dissipated in the last accepted step, of length h; 0 if it met
  /// walls as impacts, which the balance excludes.
  double dissipated(const State& from, const State& to, double h) const;
  /// Whether points met walls as impacts in both of the last two steps. Collective.
  bool restsOnImpacts() const;
  const ImplicitStep& equation() const { return equation_; }
  /// Valid after start().
  const MassFactor& mass() const { return *mass_; }
  /// Makes MassFactor::inverse() available.
  void invertMass() { mass_->invert(*model_); }
  CompiledModel& model() const { return *model_; }

  /// Integrator::carry(), takeUp(); the pointer moves past the numbers read.
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
  ImpactAccelerations impacts_, lastImpacts_;  ///< of the current step and the one before
  Vector error_;
  mutable Vector work_;
};

}  // namespace tooljoint::transient
