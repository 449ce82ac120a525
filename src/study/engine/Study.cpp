// SPDX-License-Identifier: BSD-3-Clause
#include "study/engine/Study.hpp"

#include <algorithm>
#include <optional>
#include <unistd.h>
#include <vector>

#include "cases/run/AnalysisFiles.hpp"
#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/Version.hpp"
#include "common/ranks/RankGroups.hpp"
#include "common/report/Log.hpp"
#include "common/report/Stopwatch.hpp"
#include "study/engine/StudyFiles.hpp"
#include "study/engine/StudyProgress.hpp"
#include "study/engine/StudyRows.hpp"

namespace tooljoint::study {

namespace {

/// Largest number of rows named in a sentence; the others are counted.
constexpr std::size_t mostNamed = 10;

/// Number of repeats of a run that are complete after the job.
struct Job {
  std::size_t run;
  int repeats;
};

/// A single group times all runs once, then all again. With several groups each job does all
/// repeats of a run, the companions of the reference included, and long runs come first: full
/// models, then short steps.
std::vector<Job> jobsOf(const StudyPlan& plan, const StudyRows& rows, bool apart) {
  std::vector<Job> jobs;
  if (apart)
    for (std::size_t i = 1; i < plan.referenceRuns(); ++i)
      if (!rows.isComplete(i)) jobs.push_back({i, 1});
  const int repeats = plan.settings.repeats;
  for (int pass = apart ? repeats : 1; pass <= repeats; ++pass)
    for (std::size_t i = plan.referenceRuns(); i < plan.runs.size(); ++i)
      if (rows.isFirst(i) && rows.timed()[i] >= 0 && rows.timed()[i] < pass)
        jobs.push_back({i, pass});
  const auto step = [&](const Job& job) {
    const auto& transient = plan.runs[job.run].scene->transient();
    return transient.isType<double>("Step") ? transient.get<double>("Step") : 0.0;
  };
  const auto longer = [&](const Job& a, const Job& b) {
    const bool fullA = !plan.runs[a.run].plan.reduced, fullB = !plan.runs[b.run].plan.reduced;
    return fullA != fullB ? fullA : step(a) < step(b);
  };
  if (apart) std::stable_sort(jobs.begin(), jobs.end(), longer);
  return jobs;
}

/// One study in one folder.
class Study {
 public:
  Study(const cases::Case& scene, const StudyOptions& options)
      : options_(options),
        scene_(scene),
        plan_(planStudy(scene)),
        groups_(options.ranksPerRow),
        progress_(plan_, groups_.count()) {
    timing_.ranks = parallel::size() / groups_.count();
    timing_.beside = groups_.beside();
  }

  void go() {
    if (groups_.beside() > 0 && !options_.sharedTiming)
      throw UsageError(std::to_string(groups_.beside() + 1) +
                       " rows would run on one machine at the same time, so their CPU times would "
                       "not be those of a single run. Accept that with --timing shared, or give "
                       "each group of ranks a machine.");
    open();
    try {
      groups_.apart([&] { first(); });
      if (groups_.count() > 1) groups_.apart([&] { follow(); });
      groups_.apart([&] { deal(); });
      gather();
      finish();
    } catch (const Error& error) {
      leave(error);
      if (error.code() == ExitCode::Interrupted) throw InterruptedError(interruptedSentence());
      throw;
    }
  }

  /// \param ranks  number of ranks that computed the rows
  void collectRows(int ranks) {
    timing_.ranks = ranks;
    timing_.anyMachine = true;
    open();
    rows_.emplace(plan_, folder_->folder(), timing_);
    rows_->takeReference();
    rows_->copyRepeatedRows();
    nameMissing();
    finish();
  }

 private:
  void open() {
    parallel::agree([&] {
      folder_.emplace(cases::analysisFolder(scene_, options_.output, "study"));
      if (options_.fresh) RowStore(folder_->folder()).clear();
    });
    scene_.summarise(summary_);
  }

  /// The first group computes the reference, and the others read it. A single group also computes
  /// the companions of the reference.
  void first() {
    if (groups_.mine() != 0) return;
    rows_.emplace(plan_, folder_->folder(), timing_);
    announce();
    rows_->computeReference();
    if (groups_.count() > 1) return;
    rows_->computeCompanions();
    log::info(describeReference(rows_->result()));
  }

  void follow() {
    if (groups_.mine() == 0) return;
    rows_.emplace(plan_, folder_->folder(), timing_);
    rows_->takeReference();
  }

  void deal() {
    const bool apart = groups_.count() > 1;
    const auto jobs = jobsOf(plan_, *rows_, apart);
    auto timed = rows_->timed();  // of all groups, as far as known on this rank
    std::size_t before = 0;
    for (int n = groups_.next(); n >= 0 && n < static_cast<int>(jobs.size()); n = groups_.next()) {
      const auto [i, repeats] = jobs[static_cast<std::size_t>(n)];
      for (; apart && before < static_cast<std::size_t>(n); ++before)
        timed[jobs[before].run] = jobs[before].repeats;
      while (rows_->timed()[i] >= 0 && rows_->timed()[i] < repeats) {
        const Stopwatch watch;
        rows_->run(i, !apart && isatty(STDERR_FILENO) == 1 ? plan_.runs[i].plan.label : "");
        timed[i] = rows_->timed()[i];
        if (!apart) stageTable();
        progress_.report(i, rows_->result().rows[i], timed, watch.wall());
      }
    }
    rows_->copyRepeatedRows();
  }

  /// Reads the rows of all groups from the folder.
  void gather() {
    if (groups_.count() == 1) return;
    rows_.emplace(plan_, folder_->folder(), timing_);
    if (rows_->timed()[0] > 0) rows_->takeReference();
    rows_->copyRepeatedRows();
  }

  void stageTable() {
    rows_->copyRepeatedRows();
    parallel::agree([&] { stageStudyTable(rows_->result(), *folder_); });
  }

  void announce() {
    log::info("Tooljoint " + programVersion() + ": study of " + scene_.deck().name() + " on " +
              rows_->result().machine);
    for (const auto& remark : scene_.remarks()) log::warn(remark);
    const auto methods = plan_.settings.methods.size();
    log::info(
        "study       " + std::to_string(plan_.runs.size() - plan_.referenceRuns()) + " runs of " +
        std::to_string(methods) + " methods, " + formatNumber(plan_.start) + " to " +
        formatNumber(plan_.end) + " s, each timed " +
        (plan_.settings.repeats == 1 ? "once" : std::to_string(plan_.settings.repeats) + " times") +
        "; pointwise errors up to " + formatNumber(plan_.windowEnd) + " s");
    if (groups_.count() > 1)
      log::info("            " + std::to_string(groups_.count()) + " at a time, on " +
                std::to_string(timing_.ranks) + (timing_.ranks == 1 ? " rank" : " ranks") +
                " each");
    const auto known = rows_->completed();
    if (known > 0)
      log::info("            " + std::to_string(known) + " of " +
                std::to_string(plan_.runs.size()) +
                " runs are known from before (--fresh forgets them)");
  }

  void nameMissing() {
    std::vector<std::string> missing;
    for (std::size_t i = 0; i < plan_.runs.size(); ++i)
      if (!rows_->isComplete(i)) missing.push_back(inQuotes(plan_.runs[i].plan.label));
    if (missing.empty()) return;
    const auto count = missing.size();
    missing.resize(std::min(count, mostNamed));
    log::warn(std::to_string(count) + " of " + std::to_string(plan_.runs.size()) +
              " runs are missing or have fewer timings than requested: " + join(missing, ", ") +
              (count > mostNamed ? " ..." : "") + ".");
  }

  void finish() {
    const auto speedUps = ratios(rows_->result().rows, plan_.settings.baseline);
    log::info(printedTable(rows_->result().rows, speedUps));
    log::info(describeReference(rows_->result()));
    for (const auto& sentence : stepLimits(rows_->result())) log::info("limit       " + sentence);
    stamp("finished", "");
    parallel::agree([&] {
      stageAll();
      folder_->publish();
    });
    log::info("results     " + folder_->folder() + ": " + join(folder_->files(), ", "));
    if (plan_.settings.pictures) parallel::agree([&] { drawStudy(folder_->folder()); });
  }

  void stageAll() {
    if (rows_) {
      stageStudyTable(rows_->result(), *folder_);
      stageStudyFile(rows_->result(), *folder_);
      summarise(rows_->result(), summary_);
    }
    summary_.set("files", folder_->files());
    summary_.stage(folder_->file("summary.json"));
  }

  /// After an error the rows so far remain readable, and the summary describes the error.
  void leave(const Error& error) {
    parallel::meetFailing(error.code(), error.what());
    stamp(error.code() == ExitCode::Interrupted ? "interrupted" : "failed", error.what());
    try {
      gather();
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
    return "Interrupted with " + std::to_string(rows_ ? rows_->completed() : 0) + " of " +
           std::to_string(plan_.runs.size()) + " runs done. They are kept in " + folder_->folder() +
           "; the same command goes on from there.";
  }

  const StudyOptions& options_;
  const cases::Case& scene_;
  StudyPlan plan_;
  parallel::RankGroups groups_;
  Timing timing_;
  StudyProgress progress_;
  std::optional<StudyRows> rows_;
  std::optional<io::OutputFolder> folder_;
  io::Summary summary_;
  Stopwatch watch_;
};

}  // namespace

void run(const cases::Case& one, const StudyOptions& options) { Study(one, options).go(); }

void collect(const cases::Case& one, const StudyOptions& options) {
  auto alone = options;
  alone.ranksPerRow = 0;
  Study(one, alone).collectRows(std::max(options.ranksPerRow, 1));
}

}  // namespace tooljoint::study
