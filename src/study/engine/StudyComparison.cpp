// SPDX-License-Identifier: BSD-3-Clause
#include "study/engine/StudyComparison.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "common/Error.hpp"
#include "common/Text.hpp"

namespace tooljoint::study {

namespace {

constexpr std::size_t kCurvePoints = 2000;  ///< of a thinned curve

/// Every n-th value, such that at most kCurvePoints + 1 remain.
template <class Values>
std::vector<double> thinned(const Values& values) {
  const std::size_t stride = (values.size() + kCurvePoints - 1) / kCurvePoints;
  std::vector<double> out;
  for (std::size_t i = 0; i < values.size(); i += std::max<std::size_t>(stride, 1))
    out.push_back(values[i]);
  return out;
}

/// Coordinate of a run on the axis of accuracy: the swept tolerance, otherwise the tolerance of an
/// integrator with variable steps, otherwise the step.
std::optional<double> stepOrTolerance(const StudyRun& run, const transient::Counters& counters) {
  const auto& lists = run.scene->list();
  const auto numberAt = [&](const std::string& path) -> std::optional<double> {
    const Teuchos::ParameterList* at = &lists;
    const auto names = split(path[0] == '/' ? path.substr(1) : path, '/');
    for (std::size_t i = 0; i + 1 < names.size(); ++i) {
      if (!at->isSublist(names[i])) return std::nullopt;
      at = &at->sublist(names[i]);
    }
    if (!at->isType<double>(names.back())) return std::nullopt;
    return at->get<double>(names.back());
  };
  for (const auto& [parameter, value] : run.plan.sweep)
    if (parameter.find("Tolerance") != std::string::npos)
      if (const auto number = numberAt(parameter)) return number;
  const auto own = "Transient/" + lists.sublist("Transient").get<std::string>("Integrator") + "/";
  const bool varied = counters.halved == 0 && counters.minStep < 0.5 * counters.maxStep;
  for (const char* name : {"Step Tolerance", "Relative Tolerance", "Tolerance"})
    if (const auto tolerance = varied ? numberAt(own + name) : std::nullopt) return tolerance;
  return counters.maxStep > 0.0 ? std::optional<double>(counters.maxStep) : std::nullopt;
}

}  // namespace

void forget(StudyRow& row) {
  const auto plan = row.plan;
  row = StudyRow();
  row.plan = plan;
}

void bookModel(const PreparedModel& prepared, StudyRow& row) {
  row.basis = prepared.basis;
  row.modes = prepared.modes;
  row.dofs = prepared.model().size();
  row.modeErrors = prepared.modeErrors;
  row.reason = prepared.notCompared;
}

void StudyComparison::setReference(const cases::RestingCase& resting, RecordedHistory history) {
  const auto measures = resting.measures();
  const Vector rest = resting.rest();
  const auto width = rest.size() / static_cast<Eigen::Index>(measures.nodes.size());
  rest_.clear();
  for (std::size_t n = 0; n < measures.nodes.size(); ++n)
    for (int c : measures.components)
      rest_.push_back(rest(static_cast<Eigen::Index>(n) * width + c));
  clearance_ = measures.clearance;
  reference_ = std::move(history);
  try {
    vibrationError(reference_->view(), reference_->view(), rest_, window());
  } catch (const Error& error) {
    throw ConvergenceError(std::string(error.what()) + " The window ends at " +
                           formatNumber(plan_.windowEnd) + " s (Study/Window).");
  }
  if (plan_.hasStatistics()) statistics_ = statisticsOf(*reference_);
}

MotionStatistics StudyComparison::statisticsOf(const RecordedHistory& history) const {
  return study::statisticsOf(history.view(), history.bitSpeed, clearance_,
                             {plan_.windowEnd + 1e-6, plan_.end});
}

void StudyComparison::book(const StudyRun& run, const PreparedModel& prepared,
                           const Execution& execution, StudyRow& row) const {
  const auto& report = execution.report;
  forget(row);
  bookModel(prepared, row);
  row.status = "done";
  row.integrator = report.integrator;
  row.stepOrTolerance = stepOrTolerance(run, report.counters);
  row.simulated = report.end - report.start;
  row.cpu = {execution.cpu};
  row.wall = {execution.wall};
  row.setupCpu = prepared.setupCpu + execution.setupCpu;
  row.setupWall = prepared.setupWall + execution.setupWall;
  row.counters = report.counters;
  if (report.hasEnergy) row.energyResidual = report.energy.residual();
  row.estimatedVibration = execution.estimatedVibration;
  row.maxPenetration = execution.maxPenetration;
  row.missedNodes = execution.missedNodes;
  const auto& history = row.plan.kind == RunKind::Reference ? *reference_ : execution.history;
  curves(row, history);
  if (row.plan.kind != RunKind::Reference) compare(row, history);
}

void StudyComparison::curves(StudyRow& row, const RecordedHistory& history) const {
  auto& c = row.curves;
  if (!history.bitSpeed.empty()) {
    c.bitTime = thinned(history.time);
    c.bitSpeed = thinned(history.bitSpeed);
  }
  const auto view = history.view();
  for (std::size_t n = 0; n < view.nodes; ++n) c.initial.push_back(view.radius(0, n));
  if (plan_.hasStatistics()) c.statistics = statisticsOf(history);
}

void StudyComparison::compare(StudyRow& row, const RecordedHistory& history) const {
  const auto mine = history.view();
  const auto theirs = reference_->view();
  const auto overTime = errorOverTime(mine, theirs, window());
  row.errors =
      PointwiseErrors{overTime.max(), overTime.mean(), errorOverNodes(mine, theirs, window()).max(),
                      vibrationError(mine, theirs, rest_, window())};
  row.curves.errorTime = overTime.at;
  row.curves.errorOverTime = overTime.value;
  if (statistics_) row.statistics = difference(row.curves.statistics, *statistics_);
  if (row.plan.kind == RunKind::Method) return;
  std::vector<double> growth;
  for (std::size_t i = 0; i < std::min(mine.samples, theirs.samples); ++i) {
    double farthest = 0.0;
    for (std::size_t n = 0; n < mine.nodes; ++n) {
      double square = 0.0;
      for (std::size_t c = 0; c < mine.vibrating; ++c)
        square += std::pow(mine.at(i, n, c) - theirs.at(i, n, c), 2);
      farthest = std::max(farthest, std::sqrt(square));
    }
    growth.push_back(farthest);
  }
  row.curves.growthTime = thinned(history.time);
  row.curves.growth = thinned(growth);
}

}  // namespace tooljoint::study
