// SPDX-License-Identifier: BSD-3-Clause
#include "study/engine/Study.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <unistd.h>
#include <utility>
#include <vector>

#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Sha256.hpp"
#include "common/Text.hpp"
#include "common/Version.hpp"
#include "common/report/Log.hpp"
#include "common/report/Stopwatch.hpp"
#include "study/RowStore.hpp"
#include "study/engine/StudyComparison.hpp"
#include "study/engine/StudyFiles.hpp"
#include "study/engine/StudyPlan.hpp"
#include "study/engine/StudyProgress.hpp"
#include "study/engine/StudyRunner.hpp"

namespace tooljoint::study {

namespace {

constexpr int kStoreFormat = 3;  ///< raised when the meaning of a stored row changes

/// One study in one folder.
class Study {
 public:
  Study(const cases::Case& scene, const StudyOptions& options)
      : options_(options),
        scene_(scene),
        plan_(planStudy(scene)),
        result_{plan_, nullptr, {}, ""},
        timed_(plan_.runs.size(), 0),
        comparison_(plan_),
        progress_(plan_) {
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
    const auto& given = scene_.output().folder;
    if (!given.empty()) return given + "_study";
    return (std::filesystem::path("results") / std::filesystem::path(scene_.deck().file()).stem())
               .string() +
           "_study";
  }

  void open() {
    parallel::agree([&] {
      folder_.emplace(folderName());
      store_.emplace(folder_->folder());
      if (options_.fresh) store_->clear();
      result_.machine = machineName();
    });
    scene_.summarise(summary_);
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

  /// What decides a row: the deck of its run and that of the reference, the program, the machine
  /// and the ranks, and what is compared.
  void makeKeys() {
    keys_.assign(plan_.runs.size(), "");
    parallel::agree([&] {
      if (parallel::rank() != 0) return;
      const auto program = std::to_string(kStoreFormat) + "\n" + programStamp() + "\n" +
                           std::to_string(parallel::size()) + "\n";
      const auto reference = sha256(program + contentOf(*plan_.runs[0].scene));
      const auto common = reference + "\n" + result_.machine + "\n" +
                          formatNumber(plan_.windowEnd) + "\n" +
                          (plan_.hasStatistics() ? "statistics\n" : "\n");
      for (std::size_t i = 0; i < plan_.runs.size(); ++i) {
        const auto& run = plan_.runs[i];
        auto kind = kindName(run.plan.kind);
        if (run.plan.kind == RunKind::Sensitivity)
          kind += formatNumber(plan_.settings.perturbation);
        if (run.plan.reduced) kind += std::to_string(plan_.settings.frequencies);
        keys_[i] = sha256(common + kind + "\n" + contentOf(*run.scene));
      }
    });
  }

  void announce() {
    log::info("Tooljoint " + programVersion() + ": study of " + scene_.deck().name() + " on " +
              result_.machine);
    for (const auto& remark : scene_.remarks()) log::warn(remark);
    const auto methods = plan_.settings.methods.size();
    log::info("study       " + std::to_string(plan_.runs.size() - plan_.referenceRuns()) +
              " runs of " + std::to_string(methods) + " methods, " + formatNumber(plan_.start) +
              " to " + formatNumber(plan_.end) + " s, each timed " +
              std::to_string(plan_.settings.repeats) + " times; pointwise errors up to " +
              formatNumber(plan_.windowEnd) + " s");
    const auto known = completed();
    if (known > 0)
      log::info("            " + std::to_string(known) + " of " + std::to_string(timed_.size()) +
                " runs are known from before (--fresh forgets them)");
  }

  int wantedRepeats(std::size_t i) const {
    return plan_.runs[i].plan.kind == RunKind::Method ? plan_.settings.repeats : 1;
  }
  bool complete(std::size_t i) const { return timed_[i] < 0 || timed_[i] >= wantedRepeats(i); }
  std::size_t completed() const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < timed_.size(); ++i) count += complete(i) ? 1 : 0;
    return count;
  }

  /// The reference and its companions. A reference that fails ends the study.
  void reference() {
    try {
      moveReference();
    } catch (const Error& error) {
      for (auto passed :
           {ExitCode::Interrupted, ExitCode::Files, ExitCode::Internal, ExitCode::InvalidDeck})
        if (error.code() == passed) throw;
      result_.rows[0].status = "failed";
      result_.rows[0].reason = error.what();
      throw ConvergenceError(
          std::string("The reference run failed, so there is nothing to compare with. ") +
          error.what() + " Change the deck, or Study/Reference/Set.");
    }
    for (std::size_t i = 1; i < plan_.referenceRuns(); ++i)
      if (!complete(i)) run(i, result_.rows[i].plan.label);
    log::info(describeReference(result_));
  }

  void moveReference() {
    const auto& first = plan_.runs[0];
    result_.rest = first.scene->atRest();
    if (timed_[0] > 0) {
      parallel::agree([&] {
        if (parallel::rank() == 0) comparison_.setReference(*result_.rest, std::move(*history_));
      });
      return;
    }
    const auto prepared = runner_.prepare(*first.scene, 0);
    auto execution = runner_.move(*first.scene, prepared, {"reference", true, 0.0, std::nullopt});
    parallel::agree([&] {
      if (parallel::rank() != 0) return;
      comparison_.setReference(*result_.rest, std::move(execution.history));
      store_->keepHistory(keys_[0], comparison_.reference());
      comparison_.book(first, prepared, execution, result_.rows[0]);
      store_->keep(keys_[0], result_.rows[0]);
    });
    timed_[0] = 1;
  }

  /// All methods once; those that failed before, or have been timed often enough, are left out.
  void repeat(int pass) {
    for (std::size_t i = plan_.referenceRuns(); i < plan_.runs.size(); ++i) {
      if (timed_[i] >= 0 && timed_[i] <= pass && isFirst(i))
        run(i, isatty(STDERR_FILENO) == 1 ? result_.rows[i].plan.label : "");
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
    const Stopwatch watch;
    try {
      execute(i, title);
      ++timed_[i];
    } catch (const TimeLimitError& error) {
      fail(i, error.what(), plan_.settings.timeLimit.value_or(0.0));
    } catch (const Error& error) {
      const auto code = error.code();
      if (code != ExitCode::InvalidDeck && code != ExitCode::ModelNotBuilt &&
          code != ExitCode::NotConverged)
        throw;
      fail(i, error.what(), 0.0);
    }
    parallel::agree([&] {
      if (parallel::rank() == 0) store_->keep(keys_[i], result_.rows[i]);
      stageStudyTable(result_, *folder_);
    });
    progress_.report(i, result_.rows[i], timed_, watch.wall());
  }

  void execute(std::size_t i, const std::string& title) {
    const auto& one = plan_.runs[i];
    const bool first = timed_[i] == 0;
    const double perturbation =
        one.plan.kind == RunKind::Sensitivity ? plan_.settings.perturbation : 0.0;
    const auto limit = one.plan.kind == RunKind::Method ? plan_.settings.timeLimit : std::nullopt;
    const auto prepared = runner_.prepare(*one.scene, first ? plan_.settings.frequencies : 0);
    if (first) bookModel(prepared, result_.rows[i]);
    const auto execution = runner_.move(*one.scene, prepared, {title, first, perturbation, limit});
    parallel::agree([&] {
      if (parallel::rank() != 0) return;
      if (first)
        comparison_.book(one, prepared, execution, result_.rows[i]);
      else
        again(result_.rows[i], prepared, execution);
    });
  }

  /// What was known before the motion is kept.
  void fail(std::size_t i, const std::string& reason, double givenUpAfter) {
    StudyRow row;
    auto& old = result_.rows[i];
    row.plan = old.plan, row.basis = old.basis, row.modes = old.modes, row.dofs = old.dofs,
    row.modeErrors = old.modeErrors;
    row.status = "failed";
    row.reason = reason;
    row.givenUpAfter = givenUpAfter;
    old = row;
    timed_[i] = -1;
  }

  static void again(StudyRow& row, const PreparedModel& prepared, const Execution& execution) {
    row.cpu.push_back(execution.cpu);
    row.wall.push_back(execution.wall);
    row.setupCpu = std::min(row.setupCpu, prepared.setupCpu + execution.setupCpu);
    row.setupWall = std::min(row.setupWall, prepared.setupWall + execution.setupWall);
  }

  void finish() {
    const auto speedUps = ratios(result_.rows, plan_.settings.baseline);
    log::info(printedTable(result_.rows, speedUps));
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
    stageStudyFile(result_, *folder_);
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
    summary_.set("wall_s", watch_.wall());
    summary_.set("warnings", log::warnings());
  }

  std::string interruptedSentence() const {
    return "Interrupted with " + std::to_string(completed()) + " of " +
           std::to_string(timed_.size()) + " runs done. They are kept in " + folder_->folder() +
           "; the same command goes on from there.";
  }

  const StudyOptions& options_;
  const cases::Case& scene_;
  StudyPlan plan_;
  StudyResult result_;
  std::vector<int>
      timed_;  ///< repeats done of each run, -1 for one that failed; the same on every rank
  std::vector<std::string> keys_;  ///< rank 0
  StudyRunner runner_;
  StudyComparison comparison_;
  StudyProgress progress_;
  std::optional<RecordedHistory> history_;  ///< of a reference known from before, rank 0
  std::optional<io::OutputFolder> folder_;
  std::optional<RowStore> store_;
  io::Summary summary_;
  Stopwatch watch_;
};

}  // namespace

void run(const cases::Case& one, const StudyOptions& options) { Study(one, options).go(); }

}  // namespace tooljoint::study
