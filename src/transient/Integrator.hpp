// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What every time integrator is: it carries a state from one accepted step to the next on a
/// compiled model. A new integrator is one new file that registers itself, in the tree or outside;
/// schemes/FixedStepIntegrator.hpp is the shorter way for steps of one length. Recording, the
/// energy ledger, checkpoints and the interrupt are the work of the run (Transient.hpp).
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <string>
#include <vector>

#include "common/Types.hpp"
#include "deck/Registry.hpp"
#include "transient/Strategies.hpp"
#include "transient/compiled/CompiledModel.hpp"

namespace tooljoint::transient {

/// Motion at one time; vectors in positions of the compiled model.
struct State {
  double t = 0;
  Vector q;     ///< displacement
  Vector v;     ///< velocity
  Vector a;     ///< acceleration
  Vector x;     ///< states of point laws, CompiledModel::stateSize()
  Vector xDot;  ///< their rates, 0 for held ones
  void resize(int n, int states = 0) {
    for (Vector* each : {&q, &v, &a}) each->setZero(n);
    for (Vector* each : {&x, &xDot}) each->setZero(states);
  }
  /// Append / take back, sizes as they are.
  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);
};

/// What was done, counted; nothing is hidden.
struct Counters {
  long steps = 0;             ///< accepted steps, sub-steps of a halved step counted one by one
  long rejected = 0;          ///< steps computed and thrown away by error control
  long halved = 0;            ///< times a step was halved because Newton failed
  long newtonIterations = 0;  ///< linear solves inside Newton
  long unconvergedSteps =
      0;  ///< steps kept although Newton had not converged (only when the deck accepts that)
  long factorisations = 0;  ///< of the mass matrix or the effective matrix
  long rightHandSides =
      0;  ///< evaluations of q'' = M^-1 (all forces); 0 for an integrator that makes none
  StrategyCounts strategies{};  ///< uses of each in implicit steps
  double minStep = 0;
  double maxStep = 0;
  void accept(double h);
};

/// Where the steps have to fit.
struct Window {
  double begin = 0;
  double end = 0;
  double sampling = 0;  ///< sampling interval, a whole number of which fixed steps divide; 0 = none
  double step = 0;      ///< step of the deck; 0 = the integrator's own default
};

/// What a motion goes on with, beyond State, that ranks divide otherwise.
struct CarriedMemory {
  std::vector<Vector> vectors;  ///< in positions of the compiled model; in checkpoints of its dofs
  std::vector<double> numbers;  ///< alike on all ranks
};

class Integrator {
 public:
  virtual ~Integrator() = default;
  /// True when the step is bounded by the largest frequency of the model.
  virtual bool isExplicit() const { return false; }

  /// Whether steps carry the states of point laws: `to.x` and `to.xDot` from those of `from`. A
  /// model with states is refused otherwise.
  virtual bool carriesPointStates() const { return false; }

  /// Whether steps are right on a CompiledModel that is one rank's share: sums, maxima and
  /// decisions are taken over CompiledModel::cut(). Other motions are computed by all ranks alike.
  virtual bool dividesAmongRanks() const { return false; }

  /// Whether loads that jump or pulse inside a step act as they do, by CompiledModel::setStepEnd()
  /// or setStage(). Of others the run judges whether the ends of steps see such laws.
  virtual bool followsCorners() const { return false; }
  /// And those of matrices, however large they are between two ends of steps.
  virtual bool followsCornersOfMatrices() const { return false; }

  /// Every how many steps the energy ledger has to look, for steps that are short beside what
  /// moves.
  virtual int ledgerStride() const { return 1; }

  /// What to change when a motion is wrong: "Reduce ...", without a full stop.
  virtual std::string advice() const = 0;

  /// The same when the step error is large, and what adds to it; whole sentences.
  virtual std::string stepAdvice() const { return advice() + "."; }

  /// What can be said without a model about the parameters together and with Transient/Step (0 when
  /// the deck gives none). Throws DeckError.
  virtual void checkParameters(double /*step*/) const {}

  /// Bind to a model and complete state.a (and state.xDot) from state.{t, q, v, x}. The model must
  /// outlive the integrator. Throws ModelError for a model this integrator cannot treat (a singular
  /// mass matrix for an explicit one).
  virtual void prepare(CompiledModel& model, const Window& window, State& state) = 0;

  /// One accepted step: writes `to` (all vectors sized already). Allocates nothing. Throws
  /// ConvergenceError.
  virtual void advance(const State& from, State& to) = 0;

  // Accuracy of the steps. An integrator bounds its errors itself, or lets the run measure those of
  // equal steps by taking some again in halves (accuracy/StepError.hpp); of others the run says
  // that their accuracy is not known.
  /// By error control or by the limit of stability.
  virtual bool judgesSteps() const { return false; }
  /// Length of equal steps that a second object can take again [s], known after prepare(); 0: none.
  virtual double equalStep() const { return 0; }
  /// Whether the phase of vibration is right to a higher order than the second in the step, of a
  /// model with gyroscopic terms that matter or of one without; false: errors are sought in
  /// longer windows.
  virtual bool followsPhase(bool /*gyroscopic*/) const { return false; }
  /// Append what the motion of the next steps depends on beyond State: no factors.
  virtual void saveHistory(std::vector<double>& /*history*/) const {}
  /// prepare() of a second object with half the step; `run` is an object of the same class made
  /// from the same parameters, and prepared.
  virtual void prepareRetaking(const Integrator& run, CompiledModel& model, const Window& window,
                               const State& start);
  /// Called on a second object: its next step starts at `from`, a state of the run, whose velocity
  /// and acceleration it may change, with what saveHistory() of the run appended there.
  virtual void startAgain(const double* /*history*/, State& /*from*/) {}

  /// Called before prepare() on an object whose motion that of a run is compared with: no numerical
  /// damping, iterations that end later, impacts in steps of half the length.
  virtual void sharpen() {}

  /// Called when the motion has ended: warns of what its own steps were too long for. Collective.
  virtual void judge() {}

  /// Append / take back everything beyond State that the next steps depend on, so that a run goes
  /// on with the same numbers.
  virtual void save(std::vector<double>& memory) const = 0;
  virtual void restore(const double*& memory) = 0;

  /// Append / take back, after prepare() at the state, the part of it that a motion divided among
  /// other ranks goes on with; without it that motion begins anew.
  virtual void carry(CarriedMemory& /*memory*/) const {}
  virtual void takeUp(const CarriedMemory& /*memory*/) {}

  /// False when a part of what the next steps depend on cannot be saved. A run then goes on from
  /// where forgetHistory() was called only.
  virtual bool goesOnFromAnywhere() const { return true; }
  /// Called at each checkpoint, before save(): what cannot be saved is given up by the run that
  /// writes the checkpoint too, so that both take the same steps from there.
  virtual void forgetHistory() {}

  const Counters& counters() const { return counters_; }
  Counters& counters() { return counters_; }

 protected:
  Counters counters_;
};

/// Arguments: the sublist named after the integrator (defaults filled in by ownParameters()).
using IntegratorRegistry = deck::Registry<Integrator, const Teuchos::ParameterList&>;

/// The fixed step that divides the sampling interval: interval / ceil(interval / asked), or, for
/// steps above the interval, the one that divides the whole duration.
double fittedStep(const Window& window, double asked);

/// A copy of `given` with the defaults of `spec` filled in where it is silent.
Teuchos::ParameterList withDefaults(const Teuchos::ParameterList& given,
                                    const deck::ListSpec& spec);

/// Position of the entry of largest size, or of the first that is not a finite number.
int worstPosition(const Vector& x);

}  // namespace tooljoint::transient
