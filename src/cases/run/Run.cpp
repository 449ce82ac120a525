// SPDX-License-Identifier: BSD-3-Clause
#include "cases/run/Run.hpp"

#include <filesystem>
#include <memory>
#include <vector>

#include "cases/PartsExport.hpp"
#include "cases/ReducedCase.hpp"
#include "cases/measured/LogReport.hpp"
#include "cases/measured/MeasuredLog.hpp"
#include "cases/recording/RecordedNodes.hpp"
#include "cases/run/DeckCommand.hpp"
#include "cases/run/Report.hpp"
#include "cases/run/ResultsWriter.hpp"
#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Version.hpp"
#include "common/report/Log.hpp"
#include "common/report/Stopwatch.hpp"
#include "coupling/StartMisfit.hpp"

namespace tooljoint::cases {

namespace {

/// One run of one case into one folder.
class Run {
 public:
  Run(const Case& one, const RunOptions& options) : case_(one), files_(options, one) {}

  std::string go() {
    case_.summarise(files_.summary());
    files_.complete([this] { stages(); },
                    [this] {
                      if (recorder_) recorder_->stagePictures(files_.folder());
                    });
    return files_.folder().folder();
  }

 private:
  void stages() {
    log::info("Tooljoint " + programVersion() + ": " + case_.deck().name());
    announce(case_);
    log_ = loadMeasuredLog(case_);
    comeToRest();
    if (case_.reduces() && (case_.moves() || case_.reducesWithoutMotion())) reduce();
    if (!case_.moves()) return;
    if (case_.reduces()) {
      parallel::agree([&] { integrate(reduced_.model()); });
    } else {
      const auto full = rest_->full().model;
      parallel::agree([&] { integrate(full); });
    }
  }

  void comeToRest() {
    rest_ = case_.solveStatic();
    const auto text = rest_->describe();
    if (!text.empty()) log::info(text);
    rest_->summarise(files_.summary());
    parallel::agree([&] {
      rest_->write(files_.results());
      if (case_.output().csv) rest_->stageTables(files_.folder());
      files_.results().flush();
    });
    rest_->judge();
  }

  void reduce() {
    const Stopwatch watch;
    reduced_ = cases::reduce(case_, *rest_);
    const double wall = watch.wall();
    const auto& outcome = reduced_.outcome;
    const auto& parts = reduced_.unreduced.parts;
    const int dofs = reduced_.model().size();
    if (!outcome.rounds.empty()) log::info(estimate::roundTable(outcome.rounds));
    if (!reduced_.tried.empty()) log::info(describeCuts(reduced_));
    log::info(describeReduction(reduced_.parts(), case_.freeDofs(), dofs, wall));
    log::info(describeCoupling(reduced_.coupled()));
    for (const auto& remark : reduced_.coupled().remarks) log::warn(remark);
    if (!outcome.frequencies.empty())
      log::info(estimate::frequencyTable(outcome.frequencies, parts));
    if (case_.moves()) coupling::warnOfStart(outcome.synthesis);
    auto& summary = files_.summary();
    summarise(reduced_, case_.reduction().get<std::string>("Basis"), wall, summary);
    if (case_.moves()) {
      double ratio = 0.0;
      log::info(predictCost(case_, rest_->full().model, reduced_.model(), &ratio));
      summary.set("reduction.cost_ratio", ratio);
    }
    if (case_.output().exportFormat != io::ExportFormat::None)
      exportParts(rest_->contents(parts), reduced_.parts(), case_.output().exportFormat,
                  (std::filesystem::path(files_.folder().folder()) / "parts").string(),
                  loadTimes(case_));
    if (case_.moves()) missing_ = missingModes(case_, reduced_);
    estimates_ = estimatesMotion(case_);
    if (!estimates_) reduced_.unreduced.parts.clear();
    parallel::agree([&] {
      if (case_.output().csv) stageBasisTable(reduced_.parts(), files_.folder());
      if (case_.output().reducedBases) writeBases(reduced_.parts(), files_.results());
    });
  }

  void integrate(const model::SecondOrderModel& model) {
    const auto& list = case_.transient();
    recorder_ = std::make_unique<Recorder>(
        rest_->record(model), model, Recorded{case_.output(), recordedNodes(case_)},
        TimeSpan{list.get<double>("Start Time"), list.get<double>("End Time")}, files_.results());
    if (log_.isCompared()) compareWithLog();
    if (estimates_ && files_.goesOn())
      log::warn("The error of the motion is not estimated in a run restarted from a checkpoint.");
    const bool estimating = estimates_ && !files_.goesOn();
    const auto report = estimating ? integrateEstimating(model)
                                   : files_.integrate(model, list, *recorder_, *recorder_, hooks());
    if (!estimating)
      for (const auto& remark : remarks(report)) log::warn(remark);
    summarise(report, case_.reduces(), files_.summary());
    recorder_->record().summarise(files_.summary());
    files_.requireComplete(report);
    log::info(describeTransient(report, recorder_->record()));
    for (const auto& warning : recorder_->record().warnings()) log::warn(warning);
    recorder_->record().write(files_.results());
    if (log_.isCompared()) reportLog();
    if (!case_.output().csv) return;
    recorder_->stageTable(files_.folder());
    recorder_->record().stageTables(files_.folder());
  }

  void compareWithLog() {
    try {
      recorder_->compareWith(log_, *rest_);
    } catch (const DeckError& fault) {
      throw DeckError(case_.deck().located(fault.what()));
    }
  }

  void reportLog() {
    const auto columns = recorder_->comparisons();
    const ComparedLog compared{log_, columns};
    log::info(describe(compared));
    summarise(compared, files_.summary());
    write(compared, files_.results());
    if (case_.output().csv) stageTables(compared, files_.folder());
  }

  transient::RunHooks hooks() const {
    transient::RunHooks out;
    out.cutOffs = reduced_.cutOffs();
    out.missing = missing_;
    return out;
  }

  transient::TransientReport integrateEstimating(const model::SecondOrderModel& model) {
    const auto estimator = motionEstimator(*rest_, reduced_);
    auto watching = hooks();
    watching.watcher = estimator.get();
    watching.watchInterval = reduced_.watchInterval(case_);
    auto report = files_.integrate(model, case_.transient(), *recorder_, *recorder_, watching);
    const auto error = estimator->result();
    log::info(describeMotionError(error));
    for (const auto& remark : remarks(error)) log::warn(remark);
    for (const auto& remark : remarksBesideEstimate(report)) log::warn(remark);
    summarise(error, files_.summary());
    return report;
  }

  const Case& case_;
  RunFiles files_;
  std::shared_ptr<const RestingCase> rest_;
  ReducedCase reduced_;
  std::vector<transient::MissingMode> missing_;
  MeasuredLog log_;
  bool estimates_ = false;
  std::unique_ptr<Recorder> recorder_;
};

}  // namespace

void announce(const Case& one) {
  log::info(one.describe());
  for (const auto& remark : one.remarks()) log::warn(remark);
}

std::string predictCost(const Case& one, const model::SecondOrderModel& full,
                        const model::SecondOrderModel& reduced, double* ratio) {
  const auto options = transient::readOptions(one.transient());
  const auto costOfFull = transient::costModel(full, options);
  const auto costOfReduced = transient::costModel(reduced, options);
  if (ratio != nullptr) *ratio = costOfReduced.total() / costOfFull.total();
  return describeCost(costOfFull, costOfReduced, fullModelSwitches(one.deck()));
}

std::string run(const Case& one, const RunOptions& options) { return Run(one, options).go(); }

}  // namespace tooljoint::cases
