// SPDX-License-Identifier: BSD-3-Clause
#include "transient/Transient.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <exception>
#include <iomanip>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

#include "common/Error.hpp"
#include "common/Interrupt.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/Version.hpp"
#include "common/report/EvaluationCounters.hpp"
#include "common/report/Log.hpp"
#include "common/report/Progress.hpp"
#include "model/DofNames.hpp"
#include "transient/ModelIdentity.hpp"
#include "transient/Sampler.hpp"
#include "transient/ranks/MotionShare.hpp"
#include "transient/verdict/CutOffEnergy.hpp"
#include "transient/verdict/EnergyVerdict.hpp"
#include "transient/verdict/LawVerdict.hpp"
#include "transient/verdict/StepError.hpp"
#include "transient/verdict/StepVerdict.hpp"

namespace tooljoint::transient {
namespace {

/// The run has diverged when a displacement, rotation or modal coordinate is above this.
constexpr double blowUp = 1e6;

double cpuSeconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Throws with time and dof if a value is not a number, infinite or absurdly large.
void checkFinite(const CompiledModel& model, const Integrator& integrator, const State& from,
                 const State& to) {
  if (to.x.size() > 0 && model.cut().any(!to.x.allFinite()))
    throw ConvergenceError("A state of a point law is not a number after the step from t = " +
                           formatNumber(from.t) + " s. " + integrator.advice() + ".");
  const double size = to.q.cwiseAbs().sum() + to.v.cwiseAbs().sum() * 1e-6;
  const bool good = std::isfinite(size) && (size < blowUp || to.q.cwiseAbs().maxCoeff() < blowUp);
  if (!model.cut().any(!good)) return;
  const int q = worstPosition(to.q);
  const int v = worstPosition(to.v);
  const bool velocity = std::isfinite(to.q[q]) && !std::isfinite(to.v[v]);
  const int worst = velocity ? v : q;
  const double reached = velocity ? to.v[worst] : to.q[worst];
  std::ostringstream where, text;
  where << model.dofName(worst) << " reached " << reached
        << (velocity ? " (m/s, rad/s)" : " (m, rad)");
  text << "The motion blew up in the step from t = " << from.t << " s to " << to.t
       << " s: " << model.cut().ofLargest(std::abs(reached), where.str()) << ". "
       << integrator.advice()
       << "; if it happens however small, the model itself is unstable there.";
  throw ConvergenceError(text.str());
}

long contactEvaluations(const CompiledModel& model) {
  long sum = 0;
  for (const auto& batch : model.points()) sum += batch.evaluations();
  return std::lround(model.cut().sum(static_cast<double>(sum)));
}

/// One run: the time loop with start, checkpoints and report.
class Run {
 public:
  Run(const model::SecondOrderModel& model, const TransientOptions& options, SampleSink& sink,
      const RunHooks& hooks)
      : options_(options),
        hooks_(hooks),
        whole_(model),
        integrator_(make()),
        share_(shareOf(model, options, *integrator_)),
        model_(share_ ? CompiledModel(*share_) : CompiledModel(model)),
        sampler_(model_, options, sink, hooks.resume != nullptr ? hooks.resume->samples : 0,
                 share_.get()),
        energy_(options_) {
    if (hooks.watcher != nullptr) {
      TransientOptions own = options;
      own.sampling = hooks.watchInterval;
      watcher_.emplace(model_, own, *hooks.watcher, 0, share_.get());
    }
    state_.resize(model_.size(), model_.states().size());
    next_.resize(model_.size(), model_.states().size());
  }

  TransientReport go() {
    const auto wall = std::chrono::steady_clock::now();
    const double cpu = cpuSeconds();
    begin();
    const double from = state_.t;
    const bool interrupted = loop();
    TransientReport report;
    report.integrator = options_.integrator;
    report.size = model_.wholeSize();
    report.ranks = model_.cut().ranks();
    report.ownSize = static_cast<int>(model_.cut().largest(model_.size()));
    report.messages = model_.cut().messages();
    report.start = options_.start;
    report.end = state_.t;
    report.interrupted = interrupted;
    report.counters = integrator_->counters();
    for (std::size_t i = 0; i < strategyCount; ++i)
      if (strategyNames[i].ofPoint) {
        long& uses = report.counters.strategies[i];
        uses = std::lround(model_.cut().sum(static_cast<double>(uses)));
      }
    if (stepError_) report.stepError = judged_ ? *judged_ : stepError_->value();
    report.contactEvaluations = evaluationsBefore_ + contactEvaluations(model_);
    report.samples = sampler_.count();
    if (cutOffEnergy_) report.cutOffEnergy = cutOffEnergy_->share();
    if (missing_) report.missingEnergy = missing_->share();
    report.hasEnergy = options_.ledger;
    if (options_.ledger) report.energy = ledger_.account(model_, state_);
    report.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
    report.cpu = cpuSeconds() - cpu;
    report.realTimeFactor = report.wall > 0 ? (state_.t - from) / report.wall : 0.0;
    count("factorisations", report.counters.factorisations);
    if (report.counters.unconvergedSteps > 0)
      log::warn(std::to_string(report.counters.unconvergedSteps) + " of " +
                std::to_string(report.counters.steps) +
                " steps were kept although Newton had not converged "
                "(Transient/" +
                options_.integrator + "/Accept Unconverged is true).");
    return report;
  }

 private:
  std::unique_ptr<Integrator> make() const {
    return IntegratorRegistry::instance().make(options_.integrator, options_.own);
  }

  void begin() {
    startState(state_);
    const Checkpoint* point = hooks_.resume;
    if (point != nullptr) requireFitting(*point);
    const bool anew = point != nullptr && point->shares.size() != shares();
    if (anew) takeState(*point);
    if (options_.sampling > options_.end - options_.start)
      log::warn("Transient/Sampling Interval (" + formatNumber(options_.sampling) +
                " s) is longer than the motion: its start is the only sample.");
    const Window window{state_.t, options_.end, options_.sampling, options_.step};
    integrator_->prepare(model_, window, state_);
    if (anew) takeMemory(*point);
    if (!hooks_.cutOffs.empty()) cutOffEnergy_.emplace(model_, hooks_.cutOffs);
    if (!hooks_.missing.empty()) missing_.emplace(model_, hooks_.missing, state_);
    if (integrator_->equalStep() > 0)
      stepError_.emplace(model_, *integrator_, make(), window, state_);
    else
      laws_.emplace(model_.source());
    if (point != nullptr && !anew) return resume(*point);
    checkFinite(model_, *integrator_, state_, state_);
    if (options_.ledger) ledger_.start(model_, state_, integrator_->ledgerStride());
    if (anew) return countOn(*point);
    sampler_.first(state_);
    if (watcher_) watcher_->first(state_);
    if (!integrator_->goesOnFromAnywhere()) keepCheckpoint();
  }

  void startState(State& state) {
    state.t = options_.start;
    model_.toPositions(whole_.initialDisplacement, state.q);
    model_.toPositions(whole_.initialVelocity, state.v);
    model_.setTime(state.t);
    if (model_.states().size() == 0) return;
    if (!integrator_->carriesPointStates())
      throw ModelError("The integrator \"" + options_.integrator +
                       "\" does not carry the states of point laws, but the law of \"" +
                       firstWithStates() + "\" has states. Use \"Generalized-alpha\" or \"RK4\".");
    model_.states().initial(state.t, state.q.data(), state.v.data(), state.x.data());
  }

  std::string firstWithStates() const {
    for (const auto& batch : model_.points())
      if (batch.states() != nullptr && batch.states()->size() > 0) return batch.name();
    return "";
  }

  void requireFitting(const Checkpoint& point) {
    if (point.integrator != options_.integrator)
      throw DeckError("The checkpoint was written by the integrator \"" + point.integrator +
                      "\", the deck names \"" + options_.integrator +
                      "\". Restart with the same deck.");
    if (point.state.q.size() != model_.wholeSize() ||
        point.state.x.size() != model_.states().size() || !isOfThisModel(point))
      throw DeckError(
          "The model or the steps of the checkpoint differ from those of this deck. Restart with "
          "the same deck.");
  }

  /// Equal digest; between numbers of ranks figures equal up to rounding, since sums of the static
  /// state have another order.
  bool isOfThisModel(const Checkpoint& point) {
    return point.model == identity().digest ||
           (point.ranks != parallel::size() && agree(point.figures, identity().figures));
  }

  /// Number of ranks with their own memory.
  std::size_t shares() const { return share_ ? static_cast<std::size_t>(model_.cut().ranks()) : 0; }

  /// Takes the state of a motion that was divided in another way. The ledger and the step error
  /// restart there, because their memory and that of the points belong to the ranks that wrote it.
  void takeState(const Checkpoint& point) {
    const auto text = [](std::size_t n) {
      return n == 0 ? std::string("undivided") : "divided among " + std::to_string(n) + " ranks";
    };
    log::warn("The motion of the checkpoint is " + text(point.shares.size()) + ", this one is " +
              text(shares()) +
              ". Energy and step error count from t = " + formatNumber(point.state.t) + " s on.");
    setState(point.state);
    model_.setTime(state_.t);
  }

  /// Restores the acceleration, which prepare() has overwritten, and the carried memory.
  void takeMemory(const Checkpoint& point) {
    setState(point.state);
    CarriedMemory carried = point.carried;
    for (std::size_t k = 0; k < carried.vectors.size(); ++k)
      model_.toPositions(point.carried.vectors[k], carried.vectors[k]);
    integrator_->takeUp(carried);
  }

  void resume(const Checkpoint& point) {
    setState(point.state);
    energy_.wrongSamples = point.runawaySamples;
    const double* first = point.memory.data();
    const double* end = first + point.memory.size();
    if (share_) {
      const auto rank = static_cast<std::size_t>(parallel::rank());
      for (std::size_t r = 0; r < rank; ++r) first += point.shares[r];
      end = first + point.shares[rank];
    }
    const double* memory = first;
    model_.timed().restore(memory);
    for (auto& batch : model_.points()) batch.restore(memory);
    integrator_->restore(memory);
    if (options_.ledger) ledger_.restore(model_, integrator_->ledgerStride(), memory);
    if (stepError_) stepError_->restore(memory);
    if (cutOffEnergy_) cutOffEnergy_->restore(memory);
    if (missing_) missing_->restore(memory);
    if (memory != end)
      throw FileError(
          "The checkpoint holds another amount of memory than this program reads. Go on with the "
          "program that wrote it.");
    memory = first;
    model_.timed().restore(memory);  // the other restores have set other times
    countOn(point);
  }

  /// Excludes work that was repeated to resume.
  void countOn(const Checkpoint& point) {
    integrator_->counters() = point.counters;
    evaluationsBefore_ = point.contactEvaluations - contactEvaluations(model_);
  }

  /// From dofs of the model to positions.
  void setState(const State& dofs) {
    state_ = dofs;
    model_.toPositions(dofs.q, state_.q);
    model_.toPositions(dofs.v, state_.v);
    model_.toPositions(dofs.a, state_.a);
    for (Vector* states : {&state_.x, &state_.xDot}) model_.states().keepOwn(*states);
  }
  State stateInDofs() const {
    State dofs = state_;
    model_.toDofs(state_.q, dofs.q);
    model_.toDofs(state_.v, dofs.v);
    model_.toDofs(state_.a, dofs.a);
    for (Vector* states : {&dofs.x, &dofs.xDot}) model_.states().join(*states);
    return dofs;
  }

  const ModelIdentity& identity() {
    if (!identity_) identity_ = identityOf(whole_, options_);
    return *identity_;
  }

  /// Passes a checkpoint to its keeper.
  void keepCheckpoint() {
    if (!hooks_.keep) return;
    const auto point = checkpoint();
    if (!share_) return hooks_.keep(point);
    try {
      hooks_.keep(point);
    } catch (...) {
      failure_ = std::current_exception();
    }
  }

  /// An error that one rank meets outside the steps is thrown on all ranks.
  void throwFailures() const {
    if (!share_) return;
    auto failure = failure_ ? failure_ : sampler_.failure();
    if (!failure && watcher_) failure = watcher_->failure();
    if (!model_.cut().any(failure != nullptr)) return;
    parallel::agree([&failure] {
      if (failure) std::rethrow_exception(failure);
    });
  }

  bool isStopped() const {
    return model_.cut().any(hooks_.stop ? hooks_.stop() : interruptRequested());
  }

  Checkpoint checkpoint() {
    Checkpoint point;
    point.program = programVersion() + " " + gitHash();
    point.integrator = options_.integrator;
    point.model = identity().digest;
    point.ranks = parallel::size();
    point.figures = identity().figures;
    point.state = stateInDofs();
    point.counters = integrator_->counters();
    point.contactEvaluations = evaluationsBefore_ + contactEvaluations(model_);
    point.samples = sampler_.count();
    point.runawaySamples = energy_.wrongSamples;
    model_.timed().save(point.memory);
    for (const auto& batch : model_.points()) batch.save(point.memory);
    integrator_->save(point.memory);
    integrator_->carry(point.carried);
    for (auto& vector : point.carried.vectors) {
      const Vector positions = vector;
      model_.toDofs(positions, vector);
    }
    if (options_.ledger) ledger_.save(point.memory);
    if (stepError_) stepError_->save(point.memory);
    if (cutOffEnergy_) cutOffEnergy_->save(point.memory);
    if (missing_) missing_->save(point.memory);
    if (share_) {
      const auto mine = std::move(point.memory);
      RankShare::gatherArrays(mine, point.memory, point.shares);
    }
    return point;
  }

  /// True if stopped before the end.
  bool loop() {
    std::unique_ptr<Progress> bar;
    if (options_.progress)
      bar = std::make_unique<Progress>(hooks_.title, options_.end, options_.start);
    long intervals = checkpointIntervals(state_.t);
    while (state_.t < options_.end) {
      throwFailures();
      if (isStopped()) return stopHere();
      if (stepError_) stepError_->before(*integrator_, state_);
      integrator_->advance(state_, next_);
      checkFinite(model_, *integrator_, state_, next_);
      if (stepError_) stepError_->after(state_, next_);
      if (options_.ledger) ledger_.book(model_, next_);
      const long before = sampler_.count();
      sampler_.step(state_, next_);
      if (watcher_) watcher_->step(state_, next_);
      if (laws_) laws_->look(state_.t, next_.t);
      const bool sampled = sampler_.count() > before;
      if (missing_) missing_->step(state_, next_);
      if (sampled && cutOffEnergy_) cutOffEnergy_->look(next_);
      if (sampled && missing_) missing_->look(next_);
      const bool refused = options_.ledger && sampled && ledger_.isDue() &&
                           energy_.refuses(ledger_.look(model_, next_));
      std::swap(state_, next_);
      if (refused) energy_.refuse(ledger_.account(model_, state_), state_.t, integrator_->advice());
      if (state_.t < options_.end && checkpointIntervals(state_.t) > intervals) {
        intervals = checkpointIntervals(state_.t);
        integrator_->forgetHistory();
        keepCheckpoint();
      }
      if (bar && bar->due()) bar->update(state_.t, suffix(bar->rate(state_.t)));
    }
    throwFailures();
    if (bar) bar->finish();
    if (options_.ledger)
      energy_.judge(ledger_.account(model_, state_), state_.t, integrator_->advice());
    if (!judgeSteps()) return stopHere();
    judgeLaws(model_.source(), *integrator_, {options_.start, state_.t, options_.stepErrorLimit});
    if (laws_) laws_->judge(*integrator_, options_.stepErrorLimit);
    integrator_->judge();
    return false;
  }

  bool stopHere() {
    if (integrator_->goesOnFromAnywhere()) keepCheckpoint();
    throwFailures();
    return true;
  }

  /// For integrators that do not judge their own steps. False if stopped early.
  bool judgeSteps() try {
    if (integrator_->judgesSteps()) return true;
    if (!stepError_) {
      log::info("accuracy    not known: the integrator \"" + options_.integrator +
                "\" does not measure its steps. Compare with a run of half the step.");
      return true;
    }
    judged_ =
        transient::judgeSteps(*integrator_, *stepError_, options_,
                              [this](const State& from, double span) { return again(from, span); });
    return true;
  } catch (const InterruptedError&) {
    return false;
  }

  /// Comparison over `span` [s] of the motion from a state on.
  StepComparison again(const State& from, double span) {
    return {model_,
            [this] { return make(); },
            Window{from.t, options_.end, options_.sampling, integrator_->equalStep()},
            span,
            from,
            [this] { return isStopped(); }};
  }

  /// Whole checkpoint intervals up to t: the same number in a run and in one restarted from its
  /// checkpoint.
  long checkpointIntervals(double t) const {
    if (!(options_.checkpointInterval > 0)) return 0;
    return static_cast<long>(
        std::floor((t - options_.start) / options_.checkpointInterval * (1 + 1e-12) + 1e-9));
  }

  /// \param rate simulated time over wall time
  std::string suffix(double rate) const {
    const Counters& c = integrator_->counters();
    std::ostringstream begin;
    begin << c.steps << " steps, " << std::setprecision(2) << rate << " x real time";
    std::string text = begin.str();
    if (c.rejected > 0) text += ", " + std::to_string(c.rejected) + " rejected";
    if (c.halved > 0) text += ", " + std::to_string(c.halved) + " halved";
    if (c.unconvergedSteps > 0) text += ", " + std::to_string(c.unconvergedSteps) + " unconverged";
    return text;
  }

  TransientOptions options_;
  const RunHooks& hooks_;
  const model::SecondOrderModel& whole_;
  std::unique_ptr<Integrator> integrator_;
  std::unique_ptr<RankShare> share_;  ///< null: all ranks compute the same
  CompiledModel model_;
  Sampler sampler_;
  std::optional<Sampler> watcher_;
  EnergyLedger ledger_;
  EnergyVerdict energy_;
  std::optional<StepError> stepError_;  ///< for equal steps
  std::optional<LawWatch> laws_;        ///< for other steps
  std::optional<CutOffEnergy> cutOffEnergy_;
  std::optional<MissingModes> missing_;
  std::optional<double> judged_;  ///< step error at the end
  State state_, next_;
  long evaluationsBefore_ = 0;
  std::optional<ModelIdentity> identity_;  ///< computed on demand
  std::exception_ptr failure_;             ///< of a checkpoint on this rank
};

/// An interface force has the stiffness -flexibility: with a mass, omega^2 < 0.
void refuseForcesWithMass(const model::SecondOrderModel& model) {
  const Vector mass = model.mass.diagonal();
  for (std::size_t i = 0; i < model.dofs.size(); ++i)
    if (model.dofs[i].force != 0 && mass[static_cast<Eigen::Index>(i)] != 0.0)
      throw ModelError(
          "The motion of the model is unbounded: " +
          model::dofName(model, static_cast<Eigen::Index>(i)) +
          " has the mass of the residual flexibility of the dual Craig-Bampton basis, which gives "
          "a negative eigenvalue. Such a model serves for frequencies only. For motion set "
          "\"Residual Mass\" of \"Dual Craig-Bampton\" to false, or choose \"Rubin\".");
}

void refuseLoadsOnNothing(const model::SecondOrderModel& model) {
  const auto found = model.loadsOnNothing();
  if (found.empty()) return;
  throw ModelError("A load acts on " + model::dofName(model, found.front()) +
                   ", which has neither mass, damping nor stiffness: nothing determines its "
                   "motion. Give it one of these, fix it, or remove the load.");
}

}  // namespace

TransientReport integrate(const model::SecondOrderModel& model, const TransientOptions& options,
                          SampleSink& sink, const RunHooks& hooks) {
  refuseForcesWithMass(model);
  refuseLoadsOnNothing(model);
  return Run(model, options, sink, hooks).go();
}

TransientReport integrate(const model::SecondOrderModel& model,
                          const Teuchos::ParameterList& transient, SampleSink& sink,
                          const RunHooks& hooks) {
  return integrate(model, readOptions(transient), sink, hooks);
}

}  // namespace tooljoint::transient
