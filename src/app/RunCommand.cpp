// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <optional>

#include "app/Commands.hpp"
#include "app/PartsDeck.hpp"
#include "app/PartsExport.hpp"
#include "app/Recording.hpp"
#include "app/Report.hpp"
#include "app/ResultsWriter.hpp"
#include "app/RunFiles.hpp"
#include "app/RunSupport.hpp"
#include "app/Scene.hpp"
#include "app/Stages.hpp"
#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/Version.hpp"
#include "common/report/Log.hpp"
#include "estimate/AdaptiveReduction.hpp"
#include "parts/ReducedPart.hpp"

namespace tooljoint::app {

namespace {

/// One run of one scene into one folder.
class Run {
 public:
  Run(const RunOptions& options, Scene scene) : options_(options), scene_(std::move(scene)) {}

  void go() {
    constexpr std::size_t width = 6;  // dofs of a node
    files_.emplace(options_, scene_.deck, scene_.output,
                   expectedBytes(scene_.list(), scene_.output,
                                 static_cast<std::size_t>(scene_.string.nodeCount()), width));
    summarise(scene_, files_->summary());
    files_->complete([this] { stages(); }, [this] { tables(); });
  }

 private:
  void stages() {
    log::info("Tooljoint " + programVersion() + ": " + scene_.deck.name());
    log::info(describeScene(scene_));
    stage_ = solveStatic(scene_);
    log::info(describeStatic(stage_));
    summarise(stage_, files_->summary());
    parallel::agree([&] {
      writeModel(scene_, stage_, files_->results());
      writePath(stage_, files_->results());
      writeStatic(scene_, stage_, files_->results());
      if (scene_.output.csv) stageStaticTables(scene_, stage_, files_->folder());
      files_->results().flush();
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
    auto resolved = resolvedParts(scene_, stage_);
    parts_ = std::move(resolved.parts);
    const auto& list = scene_.list().sublist("Reduction");
    outcome_ = estimate::synthesise(
        parts_, list,
        [this](const auto& synthesis, const auto& limit) { return probe(synthesis, limit); },
        resolved.options);
    const auto& reduced = outcome_.synthesis.parts;
    const int dofs = outcome_.synthesis.coupled.model.size();
    const double wall = since(start);
    if (!outcome_.rounds.empty()) log::info(estimate::roundTable(outcome_.rounds));
    log::info(describeReduction(reduced, scene_.freeDofs(), dofs, wall));
    log::info(describeCoupling(outcome_.synthesis.coupled));
    for (const auto& remark : outcome_.synthesis.coupled.remarks) log::warn(remark);
    if (!outcome_.frequencies.empty())
      log::info(estimate::frequencyTable(outcome_.frequencies, parts_));
    summarise(reduced, list.get<std::string>("Basis"), dofs, wall, files_->summary());
    predictCost();
    summarise(outcome_.synthesis.coupled, files_->summary());
    summarise(outcome_, parts_, files_->summary());
    exportReducedParts();
    estimatesMotion_ =
        estimate::readEstimateOptions(list).motion || list.isParameter("Motion Tolerance");
    if (!estimatesMotion_) parts_.clear();
    parallel::agree([&] {
      if (scene_.output.csv) stageBasisTable(reduced, files_->folder());
      if (scene_.output.reducedBases) writeBases(reduced, files_->results());
    });
  }

  void predictCost() {
    const auto full = fullCostModel(scene_, stage_);
    const auto reduced =
        transient::costModel(outcome_.synthesis.coupled.model,
                             transient::readOptions(scene_.list().sublist("Transient")));
    log::info(describeCost(full, reduced));
    files_->summary().set("reduction.cost_ratio", reduced.total() / full.total());
  }

  void exportReducedParts() {
    if (scene_.output.exportFormat == io::ExportFormat::None) return;
    std::vector<parts::PartContent> originals;
    for (const auto& part : parts_) originals.push_back(parts::contentOf(part));
    exportParts(originals, outcome_.synthesis.parts, scene_.output.exportFormat,
                (std::filesystem::path(files_->folder().folder()) / "parts").string());
  }

  /// The motion of a candidate of the reduction, for its error only.
  estimate::MotionEstimate probe(const coupling::Synthesis& synthesis,
                                 const estimate::MotionLimit& limit) {
    estimate::MotionEstimator estimator(parts_, synthesis, stage_.state.displacement);
    return estimate::watchMotion(estimator, synthesis.coupled.model,
                                 transient::readOptions(scene_.list().sublist("Transient")), limit);
  }

  transient::TransientReport integrateEstimating(const model::SecondOrderModel& model) {
    estimate::MotionEstimator estimator(parts_, outcome_.synthesis, stage_.state.displacement);
    Both both(*recorder_, estimator);
    const auto report =
        files_->integrate(model, scene_.list().sublist("Transient"), *recorder_, both);
    const auto error = estimator.result();
    log::info(describeMotionError(error));
    summarise(error, files_->summary());
    return report;
  }

  void integrate(const model::SecondOrderModel& model) {
    recorder_ = std::make_unique<MotionRecorder>(scene_, stage_, model, files_->results());
    if (estimatesMotion_ && files_->goesOn())
      log::warn(
          "The error of the motion is not estimated in a run that goes on from a checkpoint.");
    const auto report =
        estimatesMotion_ && !files_->goesOn()
            ? integrateEstimating(model)
            : files_->integrate(model, scene_.list().sublist("Transient"), *recorder_, *recorder_);
    summarise(report, recorder_->figures(), scene_.reduces(), files_->summary());
    files_->requireComplete(report);
    log::info(describeTransient(report, recorder_->figures()));
    warnOfMissedNodes();
    if (scene_.output.csv) recorder_->stageTable(files_->folder());
  }

  void warnOfMissedNodes() const {
    const auto& missed = recorder_->figures().missed;
    if (missed.empty()) return;
    log::warn(
        std::to_string(missed.size()) +
        " nodes reached the wall although contact is evaluated at retained nodes only (node " +
        std::to_string(missed.front()) +
        " first). Retain more nodes, or set Substructures/Contact Nodes to \"All\".");
  }

  void tables() {
    if (recorder_ && recorder_->pictures()) recorder_->stagePictures(files_->folder());
  }

  const RunOptions& options_;
  Scene scene_;
  std::optional<RunFiles> files_;
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
