// SPDX-License-Identifier: BSD-3-Clause
#include "app/StudyRunner.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

#include "common/Error.hpp"
#include "common/Interrupt.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "estimate/AdaptiveReduction.hpp"

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
  double wall() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count(); }

 private:
  double cpu_ = processSeconds();
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
};

/// Recovers u, v, w of all nodes and the bit speed, lets the estimator see the motion if there is one, and measures how long that takes.
class HistoryRecorder : public transient::SampleSink {
 public:
  HistoryRecorder(const Scene& scene, const model::SecondOrderModel& model, bool record, estimate::MotionEstimator* estimator)
      : scene_(scene), model_(model), record_(record), estimator_(estimator) {
    history_.nodes = static_cast<std::size_t>(scene.string.nodeCount());
    Vector unit = Vector::Zero(model.recovery.rows());
    unit(unit.size() - 1) = 1.0;  // theta_z of the last node
    bit_ = model.recovery.transpose() * unit;
  }

  void sample(double t, const Vector& q, const Vector& qDot, const Vector& qDDot) override {
    const Stopwatch watch;
    if (estimator_ != nullptr) estimator_->sample(t, q, qDot, qDDot);
    if (record_) {
      displacement_ = model_.recoveryOffset;
      displacement_.noalias() += model_.recovery * q;
      history_.time.push_back(t);
      history_.bitSpeed.push_back(scene_.rotary.speed(t) + bit_.dot(qDot));
      for (Eigen::Index n = 0; n < displacement_.size(); n += 6)
        for (Eigen::Index c = 0; c < 3; ++c) history_.displacement.push_back(displacement_(n + c));
    }
    cpu_ += watch.cpu();
    wall_ += watch.wall();
  }

  double cpu() const { return cpu_; }
  double wall() const { return wall_; }
  study::RecordedHistory& history() { return history_; }

 private:
  const Scene& scene_;
  const model::SecondOrderModel& model_;
  bool record_;
  estimate::MotionEstimator* estimator_;
  Vector bit_, displacement_;
  study::RecordedHistory history_;
  double cpu_ = 0.0, wall_ = 0.0;
};

/// Lateral dofs moved by at most `size`, each by another amount.
void perturb(model::SecondOrderModel& model, double size) {
  for (std::size_t i = 0; i < model.dofs.size(); ++i)
    if (model.dofs[i].component < 2) model.initialDisplacement(static_cast<Eigen::Index>(i)) += size * std::cos(1.7 * static_cast<double>(i));
}

void countContact(const Scene& scene, const model::SecondOrderModel& model, Execution& execution) {
  std::vector<char> watched(static_cast<std::size_t>(scene.string.nodeCount()), 0);
  for (const auto& set : model.points)
    if (set.name == kContactSet)
      for (auto entity : set.entities) watched[static_cast<std::size_t>(entity - 1)] = 1;
  const auto view = execution.history.view();
  for (int p = 0; p < scene.contactPoints.size(); ++p) {
    const auto node = static_cast<std::size_t>(scene.contactPoints.node[static_cast<std::size_t>(p)] - 1);
    double deepest = -scene.contactPoints.clearance[static_cast<std::size_t>(p)];
    for (std::size_t i = 0; i < view.samples; ++i)
      deepest = std::max(deepest, std::hypot(view.at(i, node, 0), view.at(i, node, 1)) - scene.contactPoints.clearance[static_cast<std::size_t>(p)]);
    execution.maxPenetration = std::max(execution.maxPenetration, deepest);
    if (deepest > 0.0 && watched[node] == 0) ++execution.missedNodes;
  }
}

/// Reduced model of the scene, with what it cost.
estimate::Outcome reduce(const Scene& scene, const StaticStage& stage, coupling::PlannedCoupling& planned, Execution& execution) {
  const Stopwatch watch;
  planned = plannedParts(scene, stage);
  const auto& parts = planned.parts;
  const auto& list = scene.list().sublist("Reduction");
  const auto probe = [&](const coupling::Synthesis& synthesis) {
    estimate::MotionEstimator estimator(parts, synthesis, stage.state.displacement);
    auto options = transient::readOptions(scene.list().sublist("Transient"));
    options.progress = false;
    transient::integrate(synthesis.coupled.model, options, estimator);
    return estimator.result();
  };
  auto outcome = estimate::synthesise(parts, list, probe, planned.options);
  execution.basis = list.get<std::string>("Basis");
  for (const auto& part : outcome.synthesis.parts) execution.modes += part.modes;
  execution.setupCpu = parallel::sum(watch.cpu());
  execution.setupWall = parallel::maximum(watch.wall());
  return outcome;
}

void integrate(const Scene& scene, model::SecondOrderModel& model, const ExecutionOptions& options, Execution& execution,
               estimate::MotionEstimator* estimator = nullptr) {
  if (options.perturbation > 0.0) perturb(model, options.perturbation);
  auto transientOptions = transient::readOptions(scene.list().sublist("Transient"));
  transientOptions.progress = !options.title.empty();
  transient::RunHooks hooks;
  hooks.title = options.title;
  HistoryRecorder recorder(scene, model, options.record, estimator);
  double cpu = 0.0, wall = 0.0;
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
    cpu = watch.cpu() - recorder.cpu();
    wall = watch.wall() - recorder.wall();
    if (execution.report.interrupted && !late) throw InterruptedError("Interrupted at " + formatNumber(execution.report.end) + " s.");
  });
  if (parallel::maximum(late ? 1.0 : 0.0) > 0.0)
    throw TimeLimitError("It was given up at " + formatNumber(execution.report.end) + " s, after " + formatNumber(*options.timeLimit) +
                         " s of CPU time (Study/Time Limit).");
  execution.cpu = parallel::sum(cpu);
  execution.wall = parallel::maximum(wall);
  execution.history = std::move(recorder.history());
  if (options.record) countContact(scene, model, execution);
}

}  // namespace

std::shared_ptr<const StaticStage> StudyRunner::statics(const Scene& scene) {
  auto list = scene.list();
  for (const char* name : {"Substructures", "Coupling", "Reduction", "Transient", "Output"}) list.remove(name, false);
  auto& stage = settled_[study::canonicalText(list)];
  if (!stage) stage = std::make_shared<const StaticStage>(settle(scene));
  return stage;
}

Execution StudyRunner::execute(const Scene& scene, const ExecutionOptions& options) {
  Execution execution;
  const auto stage = statics(scene);
  if (scene.reduces()) {
    coupling::PlannedCoupling planned;
    auto outcome = reduce(scene, *stage, planned, execution);
    std::optional<estimate::MotionEstimator> estimator;
    if (options.record && estimate::readEstimateOptions(scene.list().sublist("Reduction")).motion)
      estimator.emplace(planned.parts, outcome.synthesis, stage->state.displacement);
    integrate(scene, outcome.synthesis.coupled.model, options, execution, estimator ? &*estimator : nullptr);
    if (estimator) execution.estimatedDyn = estimator->result().error;
  } else {
    auto model = fullModel(scene, *stage);
    integrate(scene, model, options, execution);
  }
  return execution;
}

}  // namespace tooljoint::app
