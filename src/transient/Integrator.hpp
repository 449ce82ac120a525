// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Interface of all time integrators. An integrator advances a compiled model from one accepted
/// step to the next. A new integrator is one new file that registers itself, in the tree or
/// outside; schemes/FixedStepIntegrator.hpp is the shorter way for steps of one length. The run
/// handles recording, the energy ledger, checkpoints and interrupts (Transient.hpp).
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <string>
#include <vector>

#include "common/Types.hpp"
#include "deck/Registry.hpp"
#include "transient/Strategies.hpp"
#include "transient/compiled/CompiledModel.hpp"

namespace tooljoint::transient {

/// Motion at one time; vectors are in positions of the compiled model.
struct State {
  double t = 0;
  Vector q;     ///< displacement
  Vector v;     ///< velocity
  Vector a;     ///< acceleration
  Vector x;     ///< states of point laws, ModelStates::size()
  Vector xDot;  ///< their rates, 0 for held ones
  void resize(int n, int states = 0) {
    for (Vector* each : {&q, &v, &a}) each->setZero(n);
    for (Vector* each : {&x, &xDot}) each->setZero(states);
  }
  /// Append / restore; sizes do not change.
  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);
};

/// Counts of the work done.
struct Counters {
  long steps = 0;             ///< accepted steps, sub-steps of a halved step counted one by one
  long rejected = 0;          ///< steps computed and thrown away by error control
  long halved = 0;            ///< times a step was halved because Newton failed
  long newtonIterations = 0;  ///< linear solves inside Newton
  long unconvergedSteps =
      0;  ///< steps kept without convergence of Newton (only if the deck accepts that)
  long factorisations = 0;  ///< of the mass matrix or the effective matrix
  long rightHandSides =
      0;  ///< evaluations of q'' = M^-1 (all forces); 0 if the integrator makes none
  StrategyCounts strategies{};  ///< uses of each strategy in implicit steps
  double minStep = 0;
  double maxStep = 0;
  void accept(double h);
};

/// Time span of the steps.
struct Window {
  double begin = 0;
  double end = 0;
  double sampling = 0;  ///< sampling interval, which fixed steps divide (fittedStep()); 0: none
  double step = 0;      ///< step of the deck; 0: the integrator's own default
};

/// Memory beyond State that a motion continues with and that ranks divide in another way.
struct CarriedMemory {
  std::vector<Vector> vectors;  ///< in positions of the compiled model; in checkpoints of its dofs
  std::vector<double> numbers;  ///< the same on all ranks
};

class Integrator {
 public:
  virtual ~Integrator() = default;
  /// True if the largest frequency of the model bounds the step.
  virtual bool isExplicit() const { return false; }

  /// Whether steps integrate the states of point laws: `to.x` and `to.xDot` from those of `from`.
  /// Otherwise a model with states is refused.
  virtual bool carriesPointStates() const { return false; }

  /// Whether steps work on a CompiledModel that is one rank's share: sums, maxima and decisions are
  /// taken over CompiledModel::cut(). Otherwise all ranks compute the same motion.
  virtual bool dividesAmongRanks() const { return false; }

  /// Whether jumps and pulses of loads inside a step are integrated with their moments, by
  /// CompiledModel::setStepEnd() or setStage(). Otherwise the run judges whether the ends of the
  /// steps resolve such laws.
  virtual bool followsCorners() const { return false; }
  /// The same for laws of matrices, however large they are between two ends of steps.
  virtual bool followsCornersOfMatrices() const { return false; }

  /// Number of steps between two bookings of the energy ledger; above 1 for steps that are short
  /// compared with the motion.
  virtual int ledgerStride() const { return 1; }

  /// What to change if a motion is wrong: "Reduce ...", without a full stop.
  virtual std::string advice() const = 0;

  /// Advice for a large step error, with what adds to it; whole sentences.
  virtual std::string stepAdvice() const { return advice() + "."; }

  /// Check the parameters together and against Transient/Step (0 if the deck gives none), without a
  /// model. Throws DeckError.
  virtual void checkParameters(double /*step*/) const {}

  /// Bind to a model and complete state.a (and state.xDot) from state.{t, q, v, x}. The model must
  /// outlive the integrator. Throws ModelError for a model that this integrator cannot treat (a
  /// singular mass matrix for an explicit one).
  virtual void prepare(CompiledModel& model, const Window& window, State& state) = 0;

  /// One accepted step: writes `to` (all vectors already sized). Does not allocate. Throws
  /// ConvergenceError.
  virtual void advance(const State& from, State& to) = 0;

  // Accuracy of the steps. An integrator either bounds its errors itself or lets the run measure
  // the errors of equal steps by taking some again in halves (verdict/StepError.hpp). Otherwise the
  // run reports that the accuracy is not known.
  /// Whether error control or the stability limit bounds the error.
  virtual bool judgesSteps() const { return false; }
  /// Length of equal steps that a second object can repeat [s], known after prepare(); 0: none.
  virtual double equalStep() const { return 0; }
  /// Whether the phase of vibration is accurate beyond second order in the step, for a model with
  /// or without significant gyroscopic terms. If false, the step error is measured in longer
  /// windows.
  virtual bool followsPhase(bool /*gyroscopic*/) const { return false; }
  /// Append the history beyond State that the next steps depend on, without factors.
  virtual void saveHistory(std::vector<double>& /*history*/) const {}
  /// prepare() of a second object with half the step. `run` is a prepared object of the same class
  /// with the same parameters.
  virtual void prepareRetaking(const Integrator& run, CompiledModel& model, const Window& window,
                               const State& start);
  /// Called on a second object: its next step starts at `from`, a state of the run, with the data
  /// that saveHistory() of the run appended there. It may change velocity and acceleration of
  /// `from`.
  virtual void startAgain(const double* /*history*/, State& /*from*/) {}

  /// Called before prepare() on an object whose motion is the reference for a run: no numerical
  /// damping, tighter iterations, half the step in impacts.
  virtual void sharpen() {}

  /// Called at the end of the motion: warns of effects that its steps did not resolve. Collective.
  virtual void judge() {}

  /// Append / restore everything beyond State that the next steps depend on, so that a restarted
  /// run computes the same numbers.
  virtual void save(std::vector<double>& memory) const = 0;
  virtual void restore(const double*& memory) = 0;

  /// Append / restore, after prepare() at the state, the part of this memory with which a motion
  /// divided in another way among ranks continues. Without it that motion begins anew.
  virtual void carry(CarriedMemory& /*memory*/) const {}
  virtual void takeUp(const CarriedMemory& /*memory*/) {}

  /// False if part of the memory of the next steps cannot be saved. A run then continues only from
  /// states where forgetHistory() was called.
  virtual bool goesOnFromAnywhere() const { return true; }
  /// Called at each checkpoint, before save(). The run that writes the checkpoint also drops what
  /// cannot be saved, so that it takes the same steps as a run restarted from there.
  virtual void forgetHistory() {}

  const Counters& counters() const { return counters_; }
  Counters& counters() { return counters_; }

 protected:
  Counters counters_;
};

/// Arguments: the sublist named after the integrator (defaults filled in by withDefaults()).
using IntegratorRegistry = deck::Registry<Integrator, const Teuchos::ParameterList&>;

/// The fixed step that divides the sampling interval: interval / ceil(interval / asked). For steps
/// above the interval it divides the whole duration.
double fittedStep(const Window& window, double asked);

/// A copy of `given`, completed with the defaults of `spec`.
Teuchos::ParameterList withDefaults(const Teuchos::ParameterList& given,
                                    const deck::ListSpec& spec);

/// Position of the largest entry in absolute value, or of the first that is not finite.
int worstPosition(const Vector& x);

}  // namespace tooljoint::transient
