// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "app/PartsDeck.hpp"
#include "app/PartsExport.hpp"
#include "app/PartsRecording.hpp"
#include "app/Report.hpp"
#include "app/ResultsWriter.hpp"
#include "app/RunFiles.hpp"
#include "app/RunSupport.hpp"
#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/Version.hpp"
#include "common/report/Log.hpp"
#include "coupling/input/ComponentAxes.hpp"
#include "estimate/AdaptiveReduction.hpp"

namespace tooljoint::app {

Vector restOf(const coupling::Coupling& whole) {
  return whole.model.recoveryOffset + whole.model.recovery * whole.model.initialDisplacement;
}

std::vector<int> measuredComponents(const model::ComponentNames& names) {
  std::vector<int> all, translations;
  for (std::size_t c = 0; c < names.size(); ++c) {
    all.push_back(static_cast<int>(c));
    if (coupling::kindOf(names[c]) == coupling::ComponentKind::Translation)
      translations.push_back(static_cast<int>(c));
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
    std::size_t width = 0;
    for (const auto& part : deck_.scene.parts)
      width = std::max(width, part.model.componentNames.size());
    files_.emplace(options_, deck_.deck, deck_.output,
                   expectedBytes(deck_.list(), deck_.output, deck_.scene.nodes.size(), width));
    files_->complete([this] { stages(); }, [] {});
  }

 private:
  const Teuchos::ParameterList& transientList() const { return deck_.list().sublist("Transient"); }

  void stages() {
    log::info("Tooljoint " + programVersion() + ": " + deck_.deck.name());
    whole_ = deck_.whole();
    log::info(describeParts(deck_, whole_));
    for (const auto& remark : whole_.remarks) log::warn(remark);
    warnOfOmitted();
    summarise(deck_, whole_, files_->summary());
    const Vector rest = restOf(whole_);
    parallel::agree([&] {
      writePartsModel(deck_, whole_.model, files_->results());
      files_->results().write(
          "/static/displacement", rest,
          {whole_.model.recoveryNodes.size(), whole_.model.componentNames.size()}, "m, rad",
          "Displacements at the start, in the common frame");
      files_->results().flush();
    });
    if (deck_.settings.atRest) files_->summary().set("static.converged", true);
    if (deck_.reduces()) reduce();
    if (!deck_.moves()) return;
    const auto& model = deck_.reduces() ? outcome_.synthesis.coupled.model : whole_.model;
    parallel::agree([&] { integrate(model); });
  }

  void warnOfOmitted() const {
    for (const auto& content : deck_.scene.contents)
      for (const auto& law : content.omitted)
        log::warn("Part \"" + content.part.name + "\" (" + content.file + ") had the point law \"" +
                  law + "\" where it came from; it is not in the file.");
  }

  void reduce() {
    const auto start = Clock::now();
    const auto& list = deck_.list().sublist("Reduction");
    outcome_ = estimate::synthesise(
        deck_.scene.parts, list,
        [this](const auto& synthesis, const auto& limit) { return probe(synthesis, limit); },
        deck_.scene.coupling);
    const auto& reduced = outcome_.synthesis.parts;
    const int dofs = outcome_.synthesis.coupled.model.size();
    const double wall = since(start);
    if (!outcome_.rounds.empty()) log::info(estimate::roundTable(outcome_.rounds));
    log::info(describeReduction(reduced, whole_.model.size(), dofs, wall));
    log::info(describeCoupling(outcome_.synthesis.coupled));
    if (!outcome_.frequencies.empty())
      log::info(estimate::frequencyTable(outcome_.frequencies, deck_.scene.parts));
    summarise(reduced, list.get<std::string>("Basis"), dofs, wall, files_->summary());
    summarise(outcome_.synthesis.coupled, files_->summary());
    summarise(outcome_, deck_.scene.parts, files_->summary());
    estimatesMotion_ =
        estimate::readEstimateOptions(list).motion || list.isParameter("Motion Tolerance");
    parallel::agree([&] {
      if (deck_.output.csv) stageBasisTable(reduced, files_->folder());
      if (deck_.output.reducedBases) writeBases(reduced, files_->results());
    });
    exportParts(deck_.scene.contents, reduced, deck_.output.exportFormat,
                (std::filesystem::path(files_->folder().folder()) / "parts").string());
  }

  estimate::MotionEstimate probe(const coupling::Synthesis& synthesis,
                                 const estimate::MotionLimit& limit) {
    estimate::MotionEstimator estimator(deck_.scene.parts, synthesis, restOf(whole_),
                                        motionOptions(whole_.model));
    return estimate::watchMotion(estimator, synthesis.coupled.model,
                                 transient::readOptions(transientList()), limit);
  }

  void integrate(const model::SecondOrderModel& model) {
    recorder_ = std::make_unique<PartsRecorder>(deck_, model, files_->results());
    const bool estimates = estimatesMotion_ && !files_->goesOn();
    if (estimatesMotion_ && files_->goesOn())
      log::warn(
          "The error of the motion is not estimated in a run that goes on from a checkpoint.");
    const auto report = estimates
                            ? integrateEstimating(model)
                            : files_->integrate(model, transientList(), *recorder_, *recorder_);
    summariseMotion(report);
    files_->requireComplete(report);
    if (deck_.output.csv) recorder_->stageTable(files_->folder());
  }

  transient::TransientReport integrateEstimating(const model::SecondOrderModel& model) {
    estimate::MotionEstimator estimator(deck_.scene.parts, outcome_.synthesis, restOf(whole_),
                                        motionOptions(whole_.model));
    Both both(*recorder_, estimator);
    const auto report = files_->integrate(model, transientList(), *recorder_, both);
    const auto error = estimator.result();
    log::info(describeMotionError(error));
    summarise(error, files_->summary());
    return report;
  }

  void summariseMotion(const transient::TransientReport& report) {
    summarise(report, deck_.reduces(), files_->summary());
    files_->summary().set("transient.max_displacement", recorder_->largestDisplacement());
    char text[100];
    std::snprintf(text, sizeof text, "            largest displacement %.4g",
                  recorder_->largestDisplacement());
    log::info(describeSteps(report) + text);
  }

  const RunOptions& options_;
  PartsDeck deck_;
  std::optional<RunFiles> files_;
  coupling::Coupling whole_;
  estimate::Outcome outcome_;
  bool estimatesMotion_ = false;
  std::unique_ptr<PartsRecorder> recorder_;
};

}  // namespace

void runParts(const RunOptions& options) { PartsRun(options, readPartsDeck(options)).go(); }

}  // namespace tooljoint::app
