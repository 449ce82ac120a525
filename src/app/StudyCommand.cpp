// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <unistd.h>

#include "app/Commands.hpp"
#include "app/PartsDeck.hpp"
#include "app/ResultsWriter.hpp"
#include "app/StudyFiles.hpp"
#include "app/StudyPlan.hpp"
#include "app/StudyRunner.hpp"
#include "common/Error.hpp"
#include "common/Log.hpp"
#include "common/Parallel.hpp"
#include "common/Sha256.hpp"
#include "common/Text.hpp"
#include "common/Version.hpp"
#include "io/ResultsFile.hpp"
#include "study/Metrics.hpp"
#include "study/RowStore.hpp"

namespace tooljoint::app {

namespace {

using study::RunKind;
using study::StudyRow;

constexpr int kStoreFormat = 2;           ///< raised when the meaning of a stored row changes
constexpr std::size_t kCurvePoints = 2000;  ///< of a thinned curve

/// Every so many-th value, so that at most kCurvePoints + 1 are left.
template <class Values>
std::vector<double> thinned(const Values& values) {
  const std::size_t stride = (values.size() + kCurvePoints - 1) / kCurvePoints;
  std::vector<double> out;
  for (std::size_t i = 0; i < values.size(); i += std::max<std::size_t>(stride, 1)) out.push_back(values[i]);
  return out;
}

std::string duration(double seconds) {
  char text[32];
  if (seconds < 90.0) std::snprintf(text, sizeof text, "%.0f s", seconds);
  else if (seconds < 5400.0) std::snprintf(text, sizeof text, "%.0f min", seconds / 60.0);
  else std::snprintf(text, sizeof text, "%.1f h", seconds / 3600.0);
  return text;
}

/// Where a run stands on the axis of accuracy: the tolerance that is swept, else the tolerance of an integrator whose steps varied, else the step.
std::optional<double> stepOrTolerance(const StudyRun& run, const transient::Counters& counters) {
  const auto& list = run.scene.list().sublist("Transient");
  const auto numberAt = [&](const std::string& path) -> std::optional<double> {
    const Teuchos::ParameterList* at = &run.scene.list();
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
  const auto own = "Transient/" + list.get<std::string>("Integrator") + "/";
  const bool varied = counters.halved == 0 && counters.minStep < 0.5 * counters.maxStep;
  for (const char* name : {"Step Tolerance", "Relative Tolerance", "Tolerance"})
    if (const auto tolerance = varied ? numberAt(own + name) : std::nullopt) return tolerance;
  return counters.maxStep > 0.0 ? std::optional<double>(counters.maxStep) : std::nullopt;
}

/// One study in one folder.
class Study {
 public:
  Study(const RunOptions& options, const Scene& scene)
      : options_(options), scene_(scene), plan_(planStudy(scene)), result_{plan_, nullptr, {}, ""}, timed_(plan_.runs.size(), 0) {
    for (const auto& run : plan_.runs) {
      StudyRow row;
      row.plan = run.plan;
      result_.rows.push_back(row);
    }
  }

  void go() {
    open();
    try {
      announce();
      reference();
      const int passes = plan_.settings.repeats;
      for (int pass = 0; pass < passes; ++pass) repeat(pass);
      finish();
    } catch (const Error& error) {
      leave(error);
      if (error.code() == ExitCode::Interrupted) throw InterruptedError(interruptedSentence());
      throw;
    }
  }

 private:
  std::string folderName() const {
    if (!options_.output.empty()) return options_.output;
    // beside the folder of `tooljoint run`, whose files would be replaced otherwise
    if (!scene_.output.folder.empty()) return scene_.output.folder + "_study";
    return (std::filesystem::path("results") / std::filesystem::path(options_.deck).stem()).string() + "_study";
  }

  void open() {
    parallel::agree([&] {
      folder_.emplace(folderName());
      store_.emplace(folder_->folder());
      if (options_.fresh) store_->clear();
      result_.machine = study::machineName();
    });
    summarise(scene_, summary_);
    makeKeys();
    // what rank 0 finds decides for all
    std::vector<int> found;
    for (std::size_t i = 0; i < plan_.runs.size(); ++i) {
      auto& row = result_.rows[i];
      const bool known = store_->restore(keys_[i], row);
      const auto limit = plan_.settings.timeLimit;
      if (known && row.givenUpAfter > 0.0 && (!limit || *limit > row.givenUpAfter)) forget(row);
      found.push_back(row.status == "failed" ? -1 : static_cast<int>(row.cpu.size()));
    }
    history_ = store_->restoreHistory(keys_[0]);
    if (!history_) found[0] = 0;
    if (found[0] == 0 && parallel::rank() == 0) forget(result_.rows[0]);
    parallel::broadcast(found);
    timed_ = found;
  }

  static void forget(StudyRow& row) {
    const auto plan = row.plan;
    row = StudyRow();
    row.plan = plan;
  }

  /// What decides a row: the deck of its run and that of the reference, the program, the machine and the ranks, and what is compared.
  void makeKeys() {
    keys_.assign(plan_.runs.size(), "");
    parallel::agree([&] {
      if (parallel::rank() != 0) return;
      const auto program = std::to_string(kStoreFormat) + "\n" + study::programStamp() + "\n" + std::to_string(parallel::size()) + "\n";
      const auto reference = sha256(program + contentOf(plan_.runs[0].scene));
      const auto common = reference + "\n" + result_.machine + "\n" + formatNumber(plan_.windowEnd) + "\n" + (plan_.hasStatistics() ? "statistics\n" : "\n");
      for (std::size_t i = 0; i < plan_.runs.size(); ++i) {
        const auto& run = plan_.runs[i];
        const auto kind = study::kindName(run.plan.kind) + (run.plan.kind == RunKind::Sensitivity ? formatNumber(plan_.settings.perturbation) : "");
        keys_[i] = sha256(common + kind + "\n" + contentOf(run.scene));
      }
    });
  }

  void announce() {
    log::info("Tooljoint " + programVersion() + ": study of " + scene_.deck.name() + " on " + result_.machine);
    const auto methods = plan_.settings.methods.size();
    log::info("study       " + std::to_string(plan_.runs.size() - plan_.referenceRuns()) + " runs of " + std::to_string(methods) + " methods, " +
              formatNumber(plan_.start) + " to " + formatNumber(plan_.end) + " s, each timed " + std::to_string(plan_.settings.repeats) +
              " times; pointwise errors up to " + formatNumber(plan_.windowEnd) + " s");
    std::size_t known = 0;
    for (std::size_t i = 0; i < timed_.size(); ++i) known += complete(i) ? 1 : 0;
    if (known > 0) log::info("            " + std::to_string(known) + " of " + std::to_string(timed_.size()) + " runs are known from before (--fresh forgets them)");
  }

  int wantedRepeats(std::size_t i) const { return plan_.runs[i].plan.kind == RunKind::Method ? plan_.settings.repeats : 1; }
  bool complete(std::size_t i) const { return timed_[i] < 0 || timed_[i] >= wantedRepeats(i); }

  /// The reference and its companions. A reference that fails ends the study.
  void reference() {
    try {
      stage_ = runner_.statics(plan_.runs[0].scene);
      result_.stage = stage_.get();
      if (timed_[0] <= 0) {
        auto execution = runner_.execute(plan_.runs[0].scene, {"reference", true, 0.0, std::nullopt});
        parallel::agree([&] {
          if (parallel::rank() != 0) return;
          history_ = std::move(execution.history);
          requireMotion();
          store_->keepHistory(keys_[0], *history_);
          book(0, execution, *history_);
        });
        timed_[0] = 1;
      }
    } catch (const Error& error) {
      if (error.code() == ExitCode::Interrupted || error.code() == ExitCode::Files || error.code() == ExitCode::Internal) throw;
      result_.rows[0].status = "failed";
      result_.rows[0].reason = error.what();
      throw ConvergenceError(std::string("The reference run failed, so there is nothing to compare with. ") + error.what() +
                             " Change the deck, or Study/Reference/Set.");
    }
    if (parallel::rank() == 0 && plan_.hasStatistics()) referenceStatistics_ = statisticsOf(*history_);
    for (std::size_t i = 1; i < plan_.referenceRuns(); ++i)
      if (!complete(i)) run(i, result_.rows[i].plan.label);
    log::info(describeReference(result_));
  }

  std::vector<double> staticTranslations() const {
    std::vector<double> out;
    const auto& d = stage_->state.displacement;
    for (Eigen::Index n = 0; n < d.size(); n += 6) out.insert(out.end(), {d(n), d(n + 1), d(n + 2)});
    return out;
  }

  study::Window window() const { return {plan_.start, plan_.windowEnd}; }

  /// dyn divides by the motion of the reference.
  void requireMotion() const {
    try {
      study::vibrationError(history_->view(), history_->view(), staticTranslations(), window());
    } catch (const Error& error) {
      throw ConvergenceError(std::string(error.what()) + " The window ends at " + formatNumber(plan_.windowEnd) + " s (Study/Window).");
    }
  }

  /// All methods once; those that failed before, or have been timed often enough, are left out.
  void repeat(int pass) {
    for (std::size_t i = plan_.referenceRuns(); i < plan_.runs.size(); ++i) {
      if (timed_[i] >= 0 && timed_[i] <= pass && isFirst(i)) run(i, isatty(STDERR_FILENO) == 1 ? result_.rows[i].plan.label : "");
      if (!isFirst(i)) copyTwin(i);
    }
  }

  /// Not the same deck as an earlier run.
  bool isFirst(std::size_t i) const { return plan_.runs[i].twin == i; }
  void copyTwin(std::size_t i) {
    const auto plan = result_.rows[i].plan;
    result_.rows[i] = result_.rows[plan_.runs[i].twin];
    result_.rows[i].plan = plan;
    timed_[i] = timed_[plan_.runs[i].twin];
  }

  void run(std::size_t i, const std::string& title) {
    const bool first = timed_[i] == 0;
    const auto start = std::chrono::steady_clock::now();
    const auto kind = plan_.runs[i].plan.kind;
    const double perturbation = kind == RunKind::Sensitivity ? plan_.settings.perturbation : 0.0;
    const auto limit = kind == RunKind::Method ? plan_.settings.timeLimit : std::nullopt;
    try {
      const auto execution = runner_.execute(plan_.runs[i].scene, {title, first, perturbation, limit});
      parallel::agree([&] {
        if (parallel::rank() != 0) return;
        if (first) book(i, execution, execution.history);
        else again(i, execution);
      });
      ++timed_[i];
    } catch (const TimeLimitError& error) {
      fail(i, error.what(), plan_.settings.timeLimit.value_or(0.0));
    } catch (const Error& error) {
      const auto code = error.code();
      if (code != ExitCode::InvalidDeck && code != ExitCode::ModelNotBuilt && code != ExitCode::NotConverged) throw;
      fail(i, error.what(), 0.0);
    }
    parallel::agree([&] {
      if (parallel::rank() == 0) store_->keep(keys_[i], result_.rows[i]);
      stageStudyTable(result_, *folder_);
    });
    report(i, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }

  void fail(std::size_t i, const std::string& reason, double givenUpAfter) {
    auto& row = result_.rows[i];
    forget(row);
    row.status = "failed";
    row.reason = reason;
    row.givenUpAfter = givenUpAfter;
    timed_[i] = -1;
  }

  void again(std::size_t i, const Execution& execution) {
    auto& row = result_.rows[i];
    row.cpu.push_back(execution.cpu);
    row.wall.push_back(execution.wall);
    row.setupCpu = std::min(row.setupCpu, execution.setupCpu);
    row.setupWall = std::min(row.setupWall, execution.setupWall);
  }

  study::MotionStatistics statisticsOf(const study::RecordedHistory& history) const {
    std::vector<double> clearance(history.nodes, std::numeric_limits<double>::infinity());
    const auto& points = plan_.runs[0].scene.contactPoints;
    for (int p = 0; p < points.size(); ++p)
      clearance[static_cast<std::size_t>(points.node[static_cast<std::size_t>(p)] - 1)] = points.clearance[static_cast<std::size_t>(p)];
    const study::Window beyond{plan_.windowEnd + 1e-6, plan_.end};
    return study::statisticsOf(history.view(), history.bitSpeed, clearance, beyond);
  }

  /// Everything a first run says goes into its row.
  void book(std::size_t i, const Execution& execution, const study::RecordedHistory& history) {
    auto& row = result_.rows[i];
    const auto& report = execution.report;
    const auto& c = report.counters;
    forget(row);
    row.status = "done";
    row.basis = execution.basis;
    row.modes = execution.modes;
    row.dofs = report.size;
    row.integrator = report.integrator;
    row.stepOrTolerance = stepOrTolerance(plan_.runs[i], c);
    row.simulated = report.end - report.start;
    row.cpu = {execution.cpu};
    row.wall = {execution.wall};
    row.setupCpu = execution.setupCpu;
    row.setupWall = execution.setupWall;
    row.steps = c.steps, row.rejected = c.rejected, row.halved = c.halved, row.unconverged = c.unconvergedSteps;
    row.newtonIterations = c.newtonIterations, row.factorisations = c.factorisations, row.rightHandSides = c.rightHandSides;
    row.minStep = c.minStep, row.maxStep = c.maxStep;
    if (report.hasEnergy) row.energyResidual = report.energy.residual();
    row.estimatedDyn = execution.estimatedDyn;
    row.maxPenetration = execution.maxPenetration;
    row.missedNodes = execution.missedNodes;
    curves(row, history);
    if (row.plan.kind != RunKind::Reference) compare(row, history);
    if (i == 0) store_->keep(keys_[0], row);
  }

  void curves(StudyRow& row, const study::RecordedHistory& history) const {
    auto& c = row.curves;
    c.bitTime = thinned(history.time);
    c.bitSpeed = thinned(history.bitSpeed);
    const auto view = history.view();
    for (std::size_t n = 0; n < view.nodes; ++n) c.initial.push_back(std::hypot(view.at(0, n, 0), view.at(0, n, 1)));
    if (plan_.hasStatistics()) c.statistics = statisticsOf(history);
  }

  void compare(StudyRow& row, const study::RecordedHistory& history) const {
    const auto mine = history.view();
    const auto theirs = history_->view();
    const auto overTime = study::errorOverTime(mine, theirs, window());
    row.errors = study::PointwiseErrors{overTime.max(), overTime.mean(), study::errorOverNodes(mine, theirs, window()).max(),
                                        study::vibrationError(mine, theirs, staticTranslations(), window())};
    row.curves.errorTime = overTime.at;
    row.curves.errorOverTime = overTime.value;
    if (referenceStatistics_) row.statistics = study::difference(row.curves.statistics, *referenceStatistics_);
    if (row.plan.kind == RunKind::Method) return;
    std::vector<double> growth;
    for (std::size_t i = 0; i < std::min(mine.samples, theirs.samples); ++i) {
      double farthest = 0.0;
      for (std::size_t n = 0; n < mine.nodes; ++n)
        farthest = std::max(farthest, std::hypot(mine.at(i, n, 0) - theirs.at(i, n, 0), mine.at(i, n, 1) - theirs.at(i, n, 1)));
      growth.push_back(farthest);
    }
    row.curves.growthTime = thinned(history.time);
    row.curves.growth = thinned(growth);
  }

  /// "run 3 of 40, ...: what it gave; about 2 min left"
  void report(std::size_t i, double wall) {
    const auto& row = result_.rows[i];
    if (row.plan.kind != RunKind::Method) return;
    spent_ += wall;
    ++executed_;
    wall_.resize(plan_.runs.size(), 0.0);
    wall_[i] = wall;
    std::size_t done = 0, all = 0;
    double left = 0.0;
    for (std::size_t k = plan_.referenceRuns(); k < plan_.runs.size(); ++k) {
      if (!isFirst(k)) continue;
      const auto wanted = static_cast<std::size_t>(plan_.settings.repeats);
      const auto had = timed_[k] < 0 ? wanted : static_cast<std::size_t>(timed_[k]);
      all += wanted;
      done += std::min(had, wanted);
      // a run not seen yet is taken to cost what the others did on average
      left += static_cast<double>(wanted - std::min(had, wanted)) * (wall_[k] > 0.0 ? wall_[k] : spent_ / executed_);
    }
    char line[512];
    if (row.status == "failed")
      std::snprintf(line, sizeof line, "failed: %.360s", row.reason.c_str());
    else if (parallel::rank() == 0)
      std::snprintf(line, sizeof line, "%.3g s CPU, dyn %.2e", row.cpu.back(), row.errors->dyn);
    log::info("run " + std::to_string(done) + " of " + std::to_string(all) + "  " + row.plan.label + ": " + line +
              (done < all ? "; about " + duration(left) + " left" : ""));
  }

  void finish() {
    const auto ratios = study::ratios(result_.rows, plan_.settings.baseline);
    log::info(study::printedTable(result_.rows, ratios));
    log::info(describeReference(result_));
    stamp("finished", "");
    parallel::agree([&] {
      stageAll();
      folder_->publish();
    });
    log::info("results     " + folder_->folder() + ": " + join(folder_->files(), ", "));
    if (plan_.settings.pictures) parallel::agree([&] { drawStudy(folder_->folder()); });
  }

  void stageAll() {
    stageStudyTable(result_, *folder_);
    stageStudyFile(result_, plan_.runs[0].scene, *folder_);
    summarise(result_, summary_);
    summary_.set("files", folder_->files());
    summary_.stage(folder_->file("summary.json"));
  }

  /// The study ends early: rows so far stay readable, and the summary says what happened.
  void leave(const Error& error) {
    stamp(error.code() == ExitCode::Interrupted ? "interrupted" : "failed", error.what());
    try {
      stageAll();
      folder_->publishUnfinished();
    } catch (const Error& second) {
      log::warn(std::string("The rows so far could not be written: ") + second.what());
    }
  }

  void stamp(const std::string& status, const std::string& message) {
    summary_.set("status", status);
    if (!message.empty()) summary_.set("message", message);
    summary_.set("wall_s", std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count());
    summary_.set("warnings", log::warnings());
  }

  std::string interruptedSentence() const {
    std::size_t done = 0;
    for (std::size_t i = 0; i < timed_.size(); ++i) done += complete(i) ? 1 : 0;
    return "Interrupted with " + std::to_string(done) + " of " + std::to_string(timed_.size()) + " runs done. They are kept in " + folder_->folder() +
           "; the same command goes on from there.";
  }

  const RunOptions& options_;
  const Scene& scene_;
  StudyPlan plan_;
  StudyResult result_;
  std::vector<int> timed_;  ///< repeats done of each run, -1 for one that failed; the same on every rank
  std::vector<std::string> keys_;  ///< rank 0
  StudyRunner runner_;
  std::shared_ptr<const StaticStage> stage_;
  std::optional<study::RecordedHistory> history_;  ///< of the reference, rank 0
  std::optional<study::MotionStatistics> referenceStatistics_;
  std::optional<io::OutputFolder> folder_;
  std::optional<study::RowStore> store_;
  io::Summary summary_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::vector<double> wall_;  ///< last time of each run [s]
  double spent_ = 0.0;
  double executed_ = 0.0;
};

}  // namespace

void study(const RunOptions& options) {
  if (isPartsDeck(options))
    throw DeckError(options.deck + " is a deck of parts, and a study compares motions of a string. Compare runs of parts by their summary.json and motion.csv.");
  const auto scene = readScene(options.deck, options.overrides);
  Study(options, scene).go();
}

}  // namespace tooljoint::app
