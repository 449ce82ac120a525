// SPDX-License-Identifier: BSD-3-Clause
#include "study/engine/StudyRunner.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>
#include <utility>

#include "cases/ListText.hpp"
#include "common/Error.hpp"
#include "common/Interrupt.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/ranks/RankGroups.hpp"
#include "common/report/Stopwatch.hpp"
#include "coupling/CoupledModes.hpp"

namespace tooljoint::study {

namespace {

/// A trial of this CPU time is long enough to predict the time of a motion [s]; a shorter one is
/// repeated over a longer time.
constexpr double enoughCpu = 0.05;
constexpr double trialGrowth = 4.0;

/// Rows of the recovery for the measured components of the measured nodes.
std::vector<Eigen::Index> measuredRows(const cases::Measures& measures,
                                       const model::SecondOrderModel& model) {
  std::map<std::int64_t, std::size_t> place;
  for (std::size_t i = 0; i < model.recoveryNodes.size(); ++i) place[model.recoveryNodes[i]] = i;
  std::vector<Eigen::Index> rows;
  for (auto node : measures.nodes) {
    const auto it = place.find(node);
    if (it == place.end())
      throw ModelError("Node " + std::to_string(node) +
                       " of the full model is not recovered by the reduced one, so their motions "
                       "cannot be compared.");
    for (int c : measures.components)
      rows.push_back(static_cast<Eigen::Index>(it->second * model.componentNames.size()) + c);
  }
  return rows;
}

/// Passes samples on and measures the time this takes.
class TimedSink : public transient::SampleSink {
 public:
  explicit TimedSink(transient::SampleSink& sink) : sink_(sink) {}
  void sample(double t, const Vector& q, const Vector& qDot, const Vector& qDDot) override {
    const Stopwatch watch;
    sink_.sample(t, q, qDot, qDDot);
    cpu_ += watch.cpu();
    wall_ += watch.wall();
  }
  void states(const Vector& x) override { sink_.states(x); }

  double cpu() const { return cpu_; }
  double wall() const { return wall_; }

 private:
  transient::SampleSink& sink_;
  double cpu_ = 0.0, wall_ = 0.0;
};

/// Recovers the measured displacements and the bit speed.
class HistoryRecorder : public transient::SampleSink {
 public:
  HistoryRecorder(const cases::Measures& measures, const model::SecondOrderModel& model,
                  const ExecutionOptions& options)
      : measures_(measures),
        model_(model),
        rows_(measuredRows(measures, model)),
        record_(options.record),
        sink_(options.sink) {
    history_.nodes = measures.nodes.size();
    history_.components = measures.components.size();
    history_.vibrating = measures.vibrating;
    if (measures.speedRow >= 0) bit_ = Vector(model.recovery.row(measures.speedRow).transpose());
  }

  void sample(double t, const Vector& q, const Vector& qDot, const Vector& qDDot) override {
    if (sink_ != nullptr) sink_->sample(t, q, qDot, qDDot);
    if (record_) {
      displacement_ = model_.recoveryOffset;
      displacement_.noalias() += model_.recovery * q;
      history_.time.push_back(t);
      if (bit_.size() > 0) history_.bitSpeed.push_back(measures_.turning(t) + bit_.dot(qDot));
      for (auto row : rows_) history_.displacement.push_back(displacement_(row));
    }
  }

  void states(const Vector& x) override {
    if (sink_ != nullptr) sink_->states(x);
  }

  RecordedHistory& history() { return history_; }

 private:
  const cases::Measures& measures_;
  const model::SecondOrderModel& model_;
  std::vector<Eigen::Index> rows_;
  bool record_;
  transient::SampleSink* sink_;
  Vector bit_, displacement_;
  RecordedHistory history_;
};

/// Changes the initial displacements of the vibration by at most `size`, differently for each dof.
model::SecondOrderModel perturbed(model::SecondOrderModel model, const cases::Measures& measures,
                                  double size) {
  const auto components = measures.vibration();
  for (std::size_t i = 0; i < model.dofs.size(); ++i)
    if (model.dofs[i].kind == model::DofLabel::Kind::Physical &&
        std::find(components.begin(), components.end(), model.dofs[i].component) !=
            components.end())
      model.initialDisplacement(static_cast<Eigen::Index>(i)) +=
          size * std::cos(1.7 * static_cast<double>(i));
  return model;
}

void countContact(const cases::Measures& measures, const model::SecondOrderModel& model,
                  Execution& execution) {
  std::set<std::int64_t> watched;
  for (const auto& set : model.points)
    if (set.name == measures.wall) watched.insert(set.entities.begin(), set.entities.end());
  const auto view = execution.history.view();
  for (std::size_t node = 0; node < measures.nodes.size(); ++node) {
    const double clearance = measures.clearance[node];
    if (!std::isfinite(clearance)) continue;
    double deepest = -clearance;
    for (std::size_t i = 0; i < view.samples; ++i)
      deepest = std::max(deepest, view.radius(i, node) - clearance);
    execution.maxPenetration = std::max(execution.maxPenetration, deepest);
    if (deepest > 0.0 && watched.count(measures.nodes[node]) == 0) ++execution.missedNodes;
  }
}

/// Reduces the case and records the cost.
void reduce(const cases::Case& scene, PreparedModel& prepared) {
  const Stopwatch watch;
  prepared.reduction = cases::reduce(scene, *prepared.rest, false);
  prepared.basis = scene.reduction().get<std::string>("Basis");
  for (const auto& part : prepared.reduction.parts()) prepared.modes += part.modes;
  prepared.setupCpu = parallel::sum(watch.cpu());
  prepared.setupWall = parallel::maximum(watch.wall());
}

Execution integrate(const cases::Case& scene, const cases::Measures& measures,
                    const model::SecondOrderModel& model, const ExecutionOptions& options,
                    estimate::MotionEstimator* estimator = nullptr, double watchInterval = 0.0) {
  auto transientOptions = transient::readOptions(scene.transient());
  transientOptions.progress = !options.title.empty();
  transient::RunHooks hooks;
  hooks.title = options.title;
  HistoryRecorder recorder(measures, model, options);
  TimedSink recording(recorder);
  std::optional<TimedSink> watching;
  if (estimator != nullptr) {
    hooks.watcher = &watching.emplace(*estimator);
    hooks.watchInterval = watchInterval;
  }
  Execution execution;
  double cpu = 0.0, wall = 0.0, setupCpu = 0.0, setupWall = 0.0;
  bool late = false;
  parallel::agree([&] {
    const Stopwatch watch;
    long looks = 0;
    hooks.stop = [&] {
      // reading the clock costs a few per cent of a short step; this also lets other groups of
      // ranks proceed
      if (++looks % 64 == 0) {
        parallel::progress();
        late = options.timeLimit && watch.cpu() > *options.timeLimit;
      }
      return late || interruptRequested();
    };
    execution.report = transient::integrate(model, transientOptions, recording, hooks);
    cpu = execution.report.cpu - recording.cpu() - (watching ? watching->cpu() : 0.0);
    wall = execution.report.wall - recording.wall() - (watching ? watching->wall() : 0.0);
    setupCpu = watch.cpu() - execution.report.cpu;
    setupWall = watch.wall() - execution.report.wall;
    if (execution.report.interrupted && !late)
      throw InterruptedError(fmt::format("Interrupted at {:g} s.", execution.report.end));
  });
  if (parallel::maximum(late ? 1.0 : 0.0) > 0.0)
    throw TimeLimitError(fmt::format("It was given up at {:g} s, after ", execution.report.end) +
                         formatNumber(*options.timeLimit) + " s of CPU time (Study/Time Limit).");
  execution.cpu = parallel::sum(cpu);
  execution.wall = parallel::maximum(wall);
  execution.setupCpu = parallel::sum(setupCpu);
  execution.setupWall = parallel::maximum(setupWall);
  execution.history = std::move(recorder.history());
  if (options.record) countContact(measures, model, execution);
  return execution;
}

}  // namespace

PreparedModel StudyRunner::prepare(const cases::Case& scene, int frequencies) {
  PreparedModel prepared;
  prepared.rest = scene.atRest();
  prepared.reduced = scene.reduces();
  if (!prepared.reduced) {
    prepared.full = prepared.rest->full();
    return prepared;
  }
  reduce(scene, prepared);
  try {
    if (frequencies > 0) prepared.modeErrors = compare(scene, prepared, frequencies);
  } catch (const Error& error) {
    if (error.code() != ExitCode::ModelNotBuilt && error.code() != ExitCode::NotConverged) throw;
    prepared.notCompared = std::string("The frequencies could not be compared. ") +
                           error.what();  // the motion can still be computed
  }
  return prepared;
}

ModeErrors StudyRunner::compare(const cases::Case& scene, const PreparedModel& prepared,
                                int frequencies) {
  auto lists = scene.list();
  for (const char* name : {"Reduction", "Transient", "Output"}) lists.remove(name, false);
  auto key = cases::canonicalText(lists);  // the static state depends on the start time too
  if (scene.moves()) key += formatNumber(scene.transient().get<double>("Start Time"));
  if (fullModes_.count(key) == 0) {
    FullModes fresh{prepared.rest->full(), {}};
    fresh.modes = estimate::modesToCompare(fresh.whole.model, frequencies);
    fullModes_.emplace(key, std::move(fresh));
  }
  const auto& known = fullModes_.at(key);
  ModeErrors errors;
  for (const auto& m : estimate::compareModes(
           known.whole.model, known.modes, frequencies, prepared.reduction.unreduced.parts,
           prepared.reduction.outcome.synthesis, known.whole.maps)) {
    errors.full.push_back(m.fullHz());
    errors.coupled.push_back(m.coupledHz());
    errors.mac.push_back(m.mac);
    errors.error.push_back(m.error);
    if (m.estimated) errors.estimate.push_back(m.estimate);
    errors.definite.push_back(m.definite ? 1.0 : 0.0);
  }
  return errors;
}

Execution StudyRunner::move(const cases::Case& scene, const PreparedModel& prepared,
                            const ExecutionOptions& options) const {
  const auto measures = prepared.rest->measures();
  if (options.perturbation > 0.0)
    return integrate(scene, measures, perturbed(prepared.model(), measures, options.perturbation),
                     options);
  const bool estimates =
      prepared.reduced && options.record && estimate::readEstimateOptions(scene.reduction()).motion;
  if (!estimates) return integrate(scene, measures, prepared.model(), options);
  const auto estimator = cases::motionEstimator(*prepared.rest, prepared.reduction);
  auto execution = integrate(scene, measures, prepared.model(), options, estimator.get(),
                             prepared.reduction.watchInterval(scene));
  execution.estimatedVibration = estimator->result().error;
  return execution;
}

std::optional<double> StudyRunner::predictedCpu(const cases::Case& scene,
                                                const PreparedModel& prepared) const {
  const auto& list = scene.transient();
  const double start = list.get<double>("Start Time");
  const double whole = list.get<double>("End Time") - start;
  double length = list.get<double>("Sampling Interval");
  for (;; length *= trialGrowth) {
    auto overrides = scene.deck().overrides();
    const bool last = length * trialGrowth >= whole;
    overrides.push_back("Transient/End Time=" + formatNumber(start + std::min(length, whole)));
    // no checks of accuracy for the first samples
    for (const char* judged : {"Step Error", "Energy Residual"})
      for (const char* when : {"Warning", "Limit"})
        overrides.push_back(std::string("Transient/") + judged + " " + when + "=1e30");
    try {
      const auto trial = move(*scene.with(overrides), prepared, {"", false, 0.0, std::nullopt});
      if (last || trial.cpu > enoughCpu) return trial.cpu * whole / std::min(length, whole);
    } catch (const Error& error) {
      if (error.code() == ExitCode::Interrupted) throw;
      return std::nullopt;  // the run itself reports the reason
    }
  }
}

}  // namespace tooljoint::study
