// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include "app/PartsDeck.hpp"
#include "app/PartsExport.hpp"
#include "app/PartsRecording.hpp"
#include "app/Report.hpp"
#include "app/ResultsWriter.hpp"
#include "app/RunSupport.hpp"
#include "common/Error.hpp"
#include "common/Log.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/Version.hpp"
#include "coupling/ComponentAxes.hpp"
#include "estimate/AdaptiveReduction.hpp"

namespace tooljoint::app {

Vector restOf(const coupling::Coupling& whole) {
  return whole.model.recoveryOffset + whole.model.recovery * whole.model.initialDisplacement;
}

std::vector<int> measuredComponents(const model::ComponentNames& names) {
  std::vector<int> all, translations;
  for (std::size_t c = 0; c < names.size(); ++c) {
    all.push_back(static_cast<int>(c));
    if (coupling::kindOf(names[c]) == coupling::ComponentKind::Translation) translations.push_back(static_cast<int>(c));
  }
  return translations.empty() ? all : translations;
}

estimate::MotionOptions motionOptions(const model::SecondOrderModel& model) {
  estimate::MotionOptions options;
  options.components = measuredComponents(model.componentNames);
  return options;
}

void summarise(const PartsDeck& deck, const coupling::Coupling& whole, io::Summary& summary) {
  summary.set("deck.file", deck.deck.file());
  summary.set("deck.sha256", deck.deck.sha256());
  summary.set("model.nodes", static_cast<long>(whole.model.recoveryNodes.size()));
  summary.set("model.free_dofs", whole.model.size());
}

namespace {

/// One run of one deck of parts into one folder.
class PartsRun {
 public:
  PartsRun(const RunOptions& options, PartsDeck deck) : options_(options), deck_(std::move(deck)) {}

  void go() {
    parallel::agree([&] {
      folder_.emplace(resultsFolder(options_, deck_.output.folder));
      if (!options_.restart.empty()) readRestart();
      file_ = std::make_unique<io::ResultsFile>(
          folder_->file("results.h5"),
          provenance(deck_.deck),
          io::ResultsOptions{deck_.output.compression});
    });
    try {
      stages();
      finish();
    } catch (const Error& error) {
      leave(error);
      throw;
    }
  }

 private:
  const Teuchos::ParameterList& transientList() const { return deck_.list().sublist("Transient"); }

  void stages() {
    log::info("Tooljoint " + programVersion() + ": " + deck_.deck.name());
    whole_ = deck_.whole();
    log::info(describeParts(deck_, whole_));
    for (const auto& remark : whole_.remarks) log::warn(remark);
    warnOfOmitted();
    summarise(deck_, whole_, summary_);
    const Vector rest = restOf(whole_);
    parallel::agree([&] {
      writePartsModel(deck_, whole_.model, *file_);
      file_->write("/static/displacement", rest, {whole_.model.recoveryNodes.size(), whole_.model.componentNames.size()},
                   "m, rad", "Displacements at the start, in the common frame");
      file_->flush();
    });
    if (deck_.settings.atRest) summary_.set("static.converged", true);
    if (deck_.reduces()) reduce();
    if (!deck_.moves()) return;
    const auto& model = deck_.reduces() ? outcome_.synthesis.coupled.model : whole_.model;
    parallel::agree([&] { integrate(model); });
  }

  void warnOfOmitted() const {
    for (const auto& content : deck_.scene.contents)
      for (const auto& law : content.omitted)
        log::warn("Part \"" + content.part.name + "\" (" + content.file + ") had the point law \"" + law +
                  "\" where it came from; it is not in the file.");
  }

  void reduce() {
    const auto start = Clock::now();
    const auto& list = deck_.list().sublist("Reduction");
    outcome_ = estimate::synthesise(
        deck_.scene.parts, list, [this](const auto& synthesis, const auto& limit) { return probe(synthesis, limit); }, deck_.scene.coupling);
    const auto& reduced = outcome_.synthesis.parts;
    const int dofs = outcome_.synthesis.coupled.model.size();
    const double wall = since(start);
    if (!outcome_.rounds.empty()) log::info(estimate::roundTable(outcome_.rounds));
    log::info(describeReduction(reduced, whole_.model.size(), dofs, wall));
    log::info(describeCoupling(outcome_.synthesis.coupled));
    if (!outcome_.frequencies.empty()) log::info(estimate::frequencyTable(outcome_.frequencies, deck_.scene.parts));
    summarise(reduced, list.get<std::string>("Basis"), dofs, wall, summary_);
    summarise(outcome_.synthesis.coupled, summary_);
    summarise(outcome_, deck_.scene.parts, summary_);
    estimatesMotion_ = estimate::readEstimateOptions(list).motion || list.isParameter("Motion Tolerance");
    parallel::agree([&] {
      if (deck_.output.csv) stageBasisTable(reduced, *folder_);
      if (deck_.output.reducedBases) writeBases(reduced, *file_);
    });
    exportParts(deck_.scene.contents, reduced, deck_.output.exportFormat,
                (std::filesystem::path(folder_->folder()) / "parts").string());
  }

  estimate::MotionEstimate probe(const coupling::Synthesis& synthesis, const estimate::MotionLimit& limit) {
    estimate::MotionEstimator estimator(deck_.scene.parts, synthesis, restOf(whole_), motionOptions(whole_.model));
    return estimate::watchMotion(estimator, synthesis.coupled.model, transient::readOptions(transientList()), limit);
  }

  void integrate(const model::SecondOrderModel& model) {
    recorder_ = std::make_unique<PartsRecorder>(deck_, model, *file_);
    transient::RunHooks hooks;
    std::optional<transient::Checkpoint> resume;
    if (restartFile_) {
      resume = transient::Checkpoint::read((std::filesystem::path(options_.restart) / kCheckpoint).string());
      recorder_->replay(*restartFile_, static_cast<std::size_t>(resume->samples));
      hooks.resume = &*resume;
    }
    hooks.keep = [this](const transient::Checkpoint& checkpoint) {
      file_->flush();
      if (parallel::rank() == 0) checkpoint.write(checkpointFile());
    };
    const bool estimates = estimatesMotion_ && !restartFile_;
    if (estimatesMotion_ && restartFile_)
      log::warn("The error of the motion is not estimated in a run that goes on from a checkpoint.");
    const auto report =
        estimates ? integrateEstimating(model, hooks) : transient::integrate(model, transientList(), *recorder_, hooks);
    summariseMotion(report);
    if (report.interrupted)
      throw InterruptedError("Interrupted at " + formatNumber(report.end) + " s. What was computed so far is in " +
                             folder_->folder() + "; go on with: tooljoint run " + options_.deck + " --restart " +
                             folder_->folder());
    if (deck_.output.csv) recorder_->stageTable(*folder_);
  }

  transient::TransientReport integrateEstimating(const model::SecondOrderModel& model, const transient::RunHooks& hooks) {
    estimate::MotionEstimator estimator(deck_.scene.parts, outcome_.synthesis, restOf(whole_), motionOptions(whole_.model));
    Both both(*recorder_, estimator);
    const auto report = transient::integrate(model, transientList(), both, hooks);
    const auto error = estimator.result();
    log::info(describeMotionError(error));
    summarise(error, summary_);
    return report;
  }

  void summariseMotion(const transient::TransientReport& report) {
    summarise(report, deck_.reduces(), summary_);
    summary_.set("transient.max_displacement", recorder_->largestDisplacement());
    char text[100];
    std::snprintf(text, sizeof text, "            largest displacement %.4g", recorder_->largestDisplacement());
    log::info(describeSteps(report) + text);
  }

  void finish() {
    stamp("finished", "");
    parallel::agree([&] {
      file_->finish();
      summary_.set("files", folder_->files());
      summary_.stage(folder_->file("summary.json"));
      folder_->publish();
      if (parallel::rank() == 0) std::filesystem::remove(checkpointFile());
    });
    log::info("results     " + folder_->folder() + ": " + join(folder_->files(), ", "));
  }

  /// The run ends early: what is there stays readable, and the summary says what happened.
  void leave(const Error& error) {
    stamp(error.code() == ExitCode::Interrupted ? "interrupted" : "failed", error.what());
    try {
      file_->close();
      summary_.set("files", folder_->files());
      summary_.stage(folder_->file("summary.json"));
      folder_->publishUnfinished();
    } catch (const Error& second) {
      log::warn(std::string("The results so far could not be kept: ") + second.what());
    }
  }

  void stamp(const std::string& status, const std::string& message) {
    summary_.set("status", status);
    if (!message.empty()) summary_.set("message", message);
    summary_.set("wall_s", since(start_));
    summary_.set("peak_memory_mb", peakMemory());
    summary_.set("warnings", log::warnings());
  }

  /// The old samples are read whole before the new run writes a file of the same name.
  void readRestart() {
    const auto folder = std::filesystem::path(options_.restart);
    if (!std::filesystem::exists(folder / kCheckpoint))
      throw FileError("\"" + options_.restart + "\" holds no " + kCheckpoint +
                      ". --restart goes on from the folder of an interrupted run.");
    for (const char* name : {"results.h5.part", "results.h5"}) {
      const auto file = (folder / name).string();
      if (restartFile_ || !std::filesystem::exists(file)) continue;
      std::vector<std::string> series;
      for (const char* field : {"displacement", "velocity", "acceleration"})
        if (deck_.output.hasField(field)) series.push_back(std::string("/transient/") + field);
      if (deck_.output.hasField("normal_force") && !deck_.scene.coupling.connections.connectors.empty())
        throw FileError(
            "A run with point laws between parts goes on only without \"normal_force\" in Output/Fields; start it anew.");
      restartFile_ = std::make_unique<RecordedParts>(file, series);
    }
    if (!restartFile_) throw FileError("\"" + options_.restart + "\" holds no results to go on from.");
  }

  std::string checkpointFile() const { return (std::filesystem::path(folder_->folder()) / kCheckpoint).string(); }

  const RunOptions& options_;
  PartsDeck deck_;
  Clock::time_point start_ = Clock::now();
  std::optional<io::OutputFolder> folder_;
  std::unique_ptr<io::ResultsFile> file_;
  std::unique_ptr<RecordedParts> restartFile_;
  io::Summary summary_;
  coupling::Coupling whole_;
  estimate::Outcome outcome_;
  bool estimatesMotion_ = false;
  std::unique_ptr<PartsRecorder> recorder_;
};

}  // namespace

void runParts(const RunOptions& options) { PartsRun(options, readPartsDeck(options)).go(); }

}  // namespace tooljoint::app
