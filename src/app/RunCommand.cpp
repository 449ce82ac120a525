// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <filesystem>
#include <optional>

#include "app/Commands.hpp"
#include "app/PartsDeck.hpp"
#include "app/PartsExport.hpp"
#include "app/Recording.hpp"
#include "app/Report.hpp"
#include "app/ResultsWriter.hpp"
#include "app/RunSupport.hpp"
#include "app/Scene.hpp"
#include "app/Stages.hpp"
#include "common/Error.hpp"
#include "common/Log.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/Version.hpp"
#include "estimate/AdaptiveReduction.hpp"
#include "io/ResultsReader.hpp"
#include "parts/ReducedPart.hpp"

namespace tooljoint::app {

namespace {

/// One run of one scene into one folder.
class Run {
 public:
  Run(const RunOptions& options, Scene scene) : options_(options), scene_(std::move(scene)) {}

  void go() {
    const auto folderName = resultsFolder(options_, scene_.output.folder);
    if (!options_.restart.empty()) readRestart();
    parallel::agree([&] {
      folder_.emplace(folderName);
      folder_->requireSpace(expectedBytes());
      file_ = std::make_unique<io::ResultsFile>(folder_->file("results.h5"), provenance(scene_.deck),
                                                io::ResultsOptions{scene_.output.compression});
    });
    summarise(scene_, summary_);
    try {
      stages();
      finish();
    } catch (const Error& error) {
      leave(error);
      throw;
    }
  }

 private:
  void stages() {
    log::info("Tooljoint " + programVersion() + ": " + scene_.deck.name());
    log::info(describeScene(scene_));
    stage_ = solveStatic(scene_);
    log::info(describeStatic(stage_));
    summarise(stage_, summary_);
    parallel::agree([&] {
      writeModel(scene_, stage_, *file_);
      writePath(stage_, *file_);
      writeStatic(scene_, stage_, *file_);
      if (scene_.output.csv) stageStaticTables(scene_, stage_, *folder_);
      file_->flush();
    });
    judgeTorqueBalance(scene_, stage_);
    if (!scene_.moves()) return;
    if (scene_.reduces()) {
      reduce();
      parallel::agree([&] { integrate(outcome_.synthesis.coupled.model); });
    } else {
      const auto model = fullModel(scene_, stage_);
      parallel::agree([&] { integrate(model); });
    }
  }

  void reduce() {
    const auto start = Clock::now();
    auto planned = plannedParts(scene_, stage_);
    parts_ = std::move(planned.parts);
    const auto& list = scene_.list().sublist("Reduction");
    outcome_ = estimate::synthesise(
        parts_, list, [this](const auto& synthesis, const auto& limit) { return probe(synthesis, limit); }, planned.options);
    const auto& reduced = outcome_.synthesis.parts;
    const int dofs = outcome_.synthesis.coupled.model.size();
    const double wall = since(start);
    if (!outcome_.rounds.empty()) log::info(estimate::roundTable(outcome_.rounds));
    log::info(describeReduction(reduced, scene_.freeDofs(), dofs, wall));
    log::info(describeCoupling(outcome_.synthesis.coupled));
    for (const auto& remark : outcome_.synthesis.coupled.remarks) log::warn(remark);
    if (!outcome_.frequencies.empty()) log::info(estimate::frequencyTable(outcome_.frequencies, parts_));
    summarise(reduced, list.get<std::string>("Basis"), dofs, wall, summary_);
    predictCost();
    summarise(outcome_.synthesis.coupled, summary_);
    summarise(outcome_, parts_, summary_);
    exportReducedParts();
    estimatesMotion_ = estimate::readEstimateOptions(list).motion || list.isParameter("Motion Tolerance");
    if (!estimatesMotion_) parts_.clear();
    parallel::agree([&] {
      if (scene_.output.csv) stageBasisTable(reduced, *folder_);
      if (scene_.output.reducedBases) writeBases(reduced, *file_);
    });
  }

  void predictCost() {
    const auto full = fullStepCost(scene_, stage_);
    const auto reduced =
        transient::stepCost(outcome_.synthesis.coupled.model, transient::readOptions(scene_.list().sublist("Transient")));
    log::info(describeCost(full, reduced));
    summary_.set("reduction.cost_ratio", reduced.total() / full.total());
  }

  void exportReducedParts() const {
    if (scene_.output.exportFormat == io::ExportFormat::None) return;
    std::vector<parts::PartContent> originals;
    for (const auto& part : parts_) originals.push_back(parts::contentOf(part));
    exportParts(originals, outcome_.synthesis.parts, scene_.output.exportFormat,
                (std::filesystem::path(folder_->folder()) / "parts").string());
  }

  /// The motion of a candidate of the reduction, for its error only.
  estimate::MotionEstimate probe(const coupling::Synthesis& synthesis, const estimate::MotionLimit& limit) {
    estimate::MotionEstimator estimator(parts_, synthesis, stage_.state.displacement);
    return estimate::watchMotion(estimator, synthesis.coupled.model, transient::readOptions(scene_.list().sublist("Transient")),
                                 limit);
  }

  transient::TransientReport integrateEstimating(const model::SecondOrderModel& model, const transient::RunHooks& hooks) {
    estimate::MotionEstimator estimator(parts_, outcome_.synthesis, stage_.state.displacement);
    Both both(*recorder_, estimator);
    const auto report = transient::integrate(model, scene_.list().sublist("Transient"), both, hooks);
    const auto error = estimator.result();
    log::info(describeMotionError(error));
    summarise(error, summary_);
    return report;
  }

  void integrate(const model::SecondOrderModel& model) {
    recorder_ = std::make_unique<MotionRecorder>(scene_, stage_, model, *file_);
    transient::RunHooks hooks;
    std::optional<transient::Checkpoint> resume;
    if (restart_) {
      resume = transient::Checkpoint::read((std::filesystem::path(options_.restart) / kCheckpoint).string());
      recorder_->replay(*restart_, static_cast<std::size_t>(resume->samples));
      hooks.resume = &*resume;
    }
    hooks.keep = [this](const transient::Checkpoint& checkpoint) {
      file_->flush();
      if (parallel::rank() == 0) checkpoint.write(checkpointFile());
    };
    if (estimatesMotion_ && restart_)
      log::warn("The error of the motion is not estimated in a run that goes on from a checkpoint.");
    const auto report = estimatesMotion_ && !restart_
                            ? integrateEstimating(model, hooks)
                            : transient::integrate(model, scene_.list().sublist("Transient"), *recorder_, hooks);
    summarise(report, recorder_->figures(), scene_.reduces(), summary_);
    if (report.interrupted)
      throw InterruptedError("Interrupted at " + formatNumber(report.end) + " s. What was computed so far is in " +
                             folder_->folder() + "; go on with: tooljoint run " + options_.deck + " --restart " +
                             folder_->folder());
    log::info(describeTransient(report, recorder_->figures()));
    warnOfMissedNodes();
    if (scene_.output.csv) recorder_->stageTable(*folder_);
  }

  void warnOfMissedNodes() const {
    const auto& missed = recorder_->figures().missed;
    if (missed.empty()) return;
    log::warn(std::to_string(missed.size()) +
              " nodes reached the wall although contact is evaluated at retained nodes only (node " +
              std::to_string(missed.front()) + " first). Retain more nodes, or set Substructures/Contact Nodes to \"All\".");
  }

  void finish() {
    stamp("finished", "");
    parallel::agree([&] {
      if (recorder_ && recorder_->pictures()) recorder_->stagePictures(*folder_);
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

  void readRestart() {
    const auto folder = std::filesystem::path(options_.restart);
    parallel::agree([&] {
      if (!std::filesystem::exists(folder / kCheckpoint))
        throw FileError("\"" + options_.restart + "\" holds no " + kCheckpoint +
                        ". --restart goes on from the folder of an interrupted run.");
      // The old samples are read whole before the new run writes a file of the same name.
      for (const char* name : {"results.h5.part", "results.h5"})
        if (!restart_ && std::filesystem::exists(folder / name))
          restart_ = std::make_unique<RecordedMotion>((folder / name).string());
      if (!restart_) throw FileError("\"" + options_.restart + "\" holds no results to go on from.");
    });
  }

  std::string checkpointFile() const { return (std::filesystem::path(folder_->folder()) / kCheckpoint).string(); }

  /// Rough size of the results: 8 bytes for every recorded number.
  double expectedBytes() const {
    if (!scene_.moves()) return 1e6;
    const auto& list = scene_.list().sublist("Transient");
    const double samples =
        (list.get<double>("End Time") - list.get<double>("Start Time")) / list.get<double>("Sampling Interval");
    return 1e6 + 8.0 * samples * scene_.string.nodeCount() * (6.0 * static_cast<double>(scene_.output.fields.size()));
  }

  const RunOptions& options_;
  Scene scene_;
  Clock::time_point start_ = Clock::now();
  std::optional<io::OutputFolder> folder_;
  std::unique_ptr<io::ResultsFile> file_;
  std::unique_ptr<RecordedMotion> restart_;
  io::Summary summary_;
  StaticStage stage_;
  std::vector<model::Substructure> parts_;  ///< kept while the motion is estimated
  estimate::Outcome outcome_;
  bool estimatesMotion_ = false;
  std::unique_ptr<MotionRecorder> recorder_;
};

}  // namespace

void run(const RunOptions& options) {
  if (isPartsDeck(options)) {
    runParts(options);
    return;
  }
  Run(options, readScene(options.deck, options.overrides)).go();
}

}  // namespace tooljoint::app
