// SPDX-License-Identifier: BSD-3-Clause
#include "app/StudyRunner.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <set>

#include "app/Stages.hpp"
#include "common/Error.hpp"
#include "common/Interrupt.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "coupling/CoupledModes.hpp"

namespace tooljoint::app {

namespace {

/// CPU seconds of all threads of this process.
double processSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

class Stopwatch {
 public:
  double cpu() const { return processSeconds() - cpu_; }
  double wall() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count();
  }

 private:
  double cpu_ = processSeconds();
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
};

/// Rows of the recovery for the measured components of the measured nodes.
std::vector<Eigen::Index> measuredRows(const Measures& measures,
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

/// Recovers the measured displacements and the bit speed, lets the estimator see the motion if
/// there is one, and measures how long that takes.
class HistoryRecorder : public transient::SampleSink {
 public:
  HistoryRecorder(const Measures& measures, const model::SecondOrderModel& model, bool record,
                  estimate::MotionEstimator* estimator)
      : measures_(measures),
        model_(model),
        rows_(measuredRows(measures, model)),
        record_(record),
        estimator_(estimator) {
    history_.nodes = measures.nodes.size();
    history_.components = measures.components.size();
    history_.vibrating = measures.vibrating;
    if (measures.speedRow >= 0) bit_ = Vector(model.recovery.row(measures.speedRow).transpose());
  }

  void sample(double t, const Vector& q, const Vector& qDot, const Vector& qDDot) override {
    const Stopwatch watch;
    if (estimator_ != nullptr) estimator_->sample(t, q, qDot, qDDot);
    if (record_) {
      displacement_ = model_.recoveryOffset;
      displacement_.noalias() += model_.recovery * q;
      history_.time.push_back(t);
      if (bit_.size() > 0) history_.bitSpeed.push_back(measures_.turning(t) + bit_.dot(qDot));
      for (auto row : rows_) history_.displacement.push_back(displacement_(row));
    }
    cpu_ += watch.cpu();
    wall_ += watch.wall();
  }

  double cpu() const { return cpu_; }
  double wall() const { return wall_; }
  study::RecordedHistory& history() { return history_; }

 private:
  const Measures& measures_;
  const model::SecondOrderModel& model_;
  std::vector<Eigen::Index> rows_;
  bool record_;
  estimate::MotionEstimator* estimator_;
  Vector bit_, displacement_;
  study::RecordedHistory history_;
  double cpu_ = 0.0, wall_ = 0.0;
};

std::vector<int> vibrating(const Measures& measures) {
  return {measures.components.begin(),
          measures.components.begin() + static_cast<std::ptrdiff_t>(measures.vibrating)};
}

/// Dofs of the vibration moved by at most `size`, each by another amount.
model::SecondOrderModel perturbed(model::SecondOrderModel model, const Measures& measures,
                                  double size) {
  const auto components = vibrating(measures);
  for (std::size_t i = 0; i < model.dofs.size(); ++i)
    if (model.dofs[i].kind == model::DofLabel::Kind::Physical &&
        std::find(components.begin(), components.end(), model.dofs[i].component) !=
            components.end())
      model.initialDisplacement(static_cast<Eigen::Index>(i)) +=
          size * std::cos(1.7 * static_cast<double>(i));
  return model;
}

void countContact(const Measures& measures, const model::SecondOrderModel& model,
                  Execution& execution) {
  std::set<std::int64_t> watched;
  for (const auto& set : model.points)
    if (set.name == kContactSet) watched.insert(set.entities.begin(), set.entities.end());
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

estimate::MotionOptions estimated(const Measures& measures) {
  estimate::MotionOptions options;
  options.components = vibrating(measures);
  return options;
}

/// Reduced model of the scene, with what it cost.
void reduce(const StudyScene& scene, PreparedModel& prepared) {
  const Stopwatch watch;
  prepared.planned = scene.parts();
  const auto& parts = prepared.planned.parts;
  const auto& list = scene.list().sublist("Reduction");
  const auto probe = [&](const coupling::Synthesis& synthesis, const estimate::MotionLimit& limit) {
    estimate::MotionEstimator estimator(parts, synthesis, scene.rest(),
                                        estimated(scene.measures()));
    auto options = transient::readOptions(scene.list().sublist("Transient"));
    options.progress = false;
    return estimate::watchMotion(estimator, synthesis.coupled.model, options, limit);
  };
  prepared.outcome = estimate::synthesise(parts, list, probe, prepared.planned.options);
  prepared.basis = list.get<std::string>("Basis");
  for (const auto& part : prepared.outcome.synthesis.parts) prepared.modes += part.modes;
  prepared.setupCpu = parallel::sum(watch.cpu());
  prepared.setupWall = parallel::maximum(watch.wall());
}

Execution integrate(const StudyScene& scene, const Measures& measures,
                    const model::SecondOrderModel& model, const ExecutionOptions& options,
                    estimate::MotionEstimator* estimator) {
  auto transientOptions = transient::readOptions(scene.list().sublist("Transient"));
  transientOptions.progress = !options.title.empty();
  transient::RunHooks hooks;
  hooks.title = options.title;
  HistoryRecorder recorder(measures, model, options.record, estimator);
  Execution execution;
  double cpu = 0.0, wall = 0.0, setupCpu = 0.0, setupWall = 0.0;
  bool late = false;
  parallel::agree([&] {
    const Stopwatch watch;
    long looks = 0;
    hooks.stop = [&] {
      // the clock costs as much as a few per cent of a short step
      if (options.timeLimit && ++looks % 64 == 0) late = watch.cpu() > *options.timeLimit;
      return late || interruptRequested();
    };
    execution.report = transient::integrate(model, transientOptions, recorder, hooks);
    cpu = execution.report.cpu - recorder.cpu();
    wall = execution.report.wall - recorder.wall();
    setupCpu = watch.cpu() - execution.report.cpu;
    setupWall = watch.wall() - execution.report.wall;
    if (execution.report.interrupted && !late)
      throw InterruptedError("Interrupted at " + formatNumber(execution.report.end) + " s.");
  });
  if (parallel::maximum(late ? 1.0 : 0.0) > 0.0)
    throw TimeLimitError("It was given up at " + formatNumber(execution.report.end) + " s, after " +
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

PreparedModel StudyRunner::prepare(StudyScene& scene, int frequencies) {
  PreparedModel prepared;
  scene.settle();
  prepared.reduced = scene.reduces();
  if (!prepared.reduced) {
    prepared.full = scene.full();
    return prepared;
  }
  reduce(scene, prepared);
  try {
    if (frequencies > 0) prepared.modeErrors = compare(scene, prepared, frequencies);
  } catch (const Error& error) {
    if (error.code() != ExitCode::ModelNotBuilt && error.code() != ExitCode::NotConverged) throw;
    prepared.notCompared = std::string("The frequencies could not be compared. ") +
                           error.what();  // the model may move all the same
  }
  return prepared;
}

study::ModeErrors StudyRunner::compare(const StudyScene& scene, const PreparedModel& prepared,
                                       int frequencies) {
  auto lists = scene.list();
  for (const char* name : {"Reduction", "Transient", "Output"}) lists.remove(name, false);
  const auto key = study::canonicalText(lists);
  if (fullModes_.count(key) == 0) {
    FullModes fresh{scene.full(), {}};
    fresh.modes = estimate::modesToCompare(fresh.whole.model, frequencies);
    fullModes_.emplace(key, std::move(fresh));
  }
  const auto& known = fullModes_.at(key);
  study::ModeErrors errors;
  for (const auto& m :
       estimate::compareModes(known.whole.model, known.modes, frequencies, prepared.planned.parts,
                              prepared.outcome.synthesis, known.whole.maps)) {
    errors.full.push_back(m.fullHz());
    errors.coupled.push_back(m.coupledHz());
    errors.mac.push_back(m.mac);
    errors.error.push_back(m.error);
    if (m.estimated) errors.estimate.push_back(m.estimate);
    errors.definite.push_back(m.definite ? 1.0 : 0.0);
  }
  return errors;
}

Execution StudyRunner::move(const StudyScene& scene, const PreparedModel& prepared,
                            const ExecutionOptions& options) const {
  const auto measures = scene.measures();
  if (options.perturbation > 0.0)
    return integrate(scene, measures, perturbed(prepared.model(), measures, options.perturbation),
                     options, nullptr);
  const bool estimates = prepared.reduced && options.record &&
                         estimate::readEstimateOptions(scene.list().sublist("Reduction")).motion;
  if (!estimates) return integrate(scene, measures, prepared.model(), options, nullptr);
  estimate::MotionEstimator estimator(prepared.planned.parts, prepared.outcome.synthesis,
                                      scene.rest(), estimated(measures));
  auto execution = integrate(scene, measures, prepared.model(), options, &estimator);
  execution.estimatedDyn = estimator.result().error;
  return execution;
}

}  // namespace tooljoint::app
