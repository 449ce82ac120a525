// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include "app/PartsDeck.hpp"
#include "app/PartsExport.hpp"
#include "app/Report.hpp"
#include "app/Stages.hpp"
#include "common/Error.hpp"
#include "common/report/Log.hpp"
#include "estimate/AdaptiveReduction.hpp"
#include "parts/ReducedPart.hpp"

namespace tooljoint::app {

namespace {

io::ExportFormat format(const std::string& name) {
  return name == "mtx" ? io::ExportFormat::MatrixMarket : io::ExportFormat::Hdf5;
}

std::string folderOf(const RunOptions& options) {
  return options.output.empty() ? (std::filesystem::path("results") /
                                   std::filesystem::path(options.deck).stem() / "parts")
                                      .string()
                                : options.output;
}

void requireReduction(const deck::Deck& deck) {
  if (!deck.list().isSublist("Reduction"))
    throw DeckError(deck.file() + ": /" + deck.name() +
                    " has no Reduction list, so there is no reduced part to export. Add one.");
}

/// A motion tolerance needs the motion of the scene; an export has none to show, so the estimate is
/// made on the side.
template <class Deck, class Estimator>
estimate::MotionProbe probe(const Deck& deck, const Estimator& make) {
  return [&deck, make](const coupling::Synthesis& synthesis, const estimate::MotionLimit& limit) {
    const auto estimator = make(synthesis);
    return estimate::watchMotion(*estimator, synthesis.coupled.model,
                                 transient::readOptions(deck.list().sublist("Transient")), limit);
  };
}

void exportOfParts(const RunOptions& options) {
  const auto deck = readPartsDeck(options);
  requireReduction(deck.deck);
  const auto whole = deck.whole();
  log::info(describeParts(deck, whole));
  const auto& parts = deck.scene.parts;
  const auto outcome =
      estimate::synthesise(parts, deck.list().sublist("Reduction"),
                           probe(deck,
                                 [&](const coupling::Synthesis& synthesis) {
                                   return std::make_unique<estimate::MotionEstimator>(
                                       parts, synthesis, restOf(whole), motionOptions(whole.model));
                                 }),
                           deck.scene.coupling);
  log::info(reduction::summaryTable(outcome.synthesis.parts));
  exportParts(deck.scene.contents, outcome.synthesis.parts, format(options.format),
              folderOf(options));
}

}  // namespace

void exportReduced(const RunOptions& options) {
  if (isPartsDeck(options)) {
    exportOfParts(options);
    return;
  }
  const auto scene = readScene(options.deck, options.overrides);
  requireReduction(scene.deck);
  log::info(describeScene(scene));
  const auto stage = settle(scene);
  log::info(describeStatic(stage));
  const auto planned = resolvedParts(scene, stage);
  const auto outcome =
      estimate::synthesise(planned.parts, scene.list().sublist("Reduction"),
                           probe(scene,
                                 [&](const coupling::Synthesis& synthesis) {
                                   return std::make_unique<estimate::MotionEstimator>(
                                       planned.parts, synthesis, stage.state.displacement);
                                 }),
                           planned.options);
  log::info(reduction::summaryTable(outcome.synthesis.parts));
  std::vector<parts::PartContent> originals;
  for (const auto& part : planned.parts) originals.push_back(parts::contentOf(part));
  exportParts(originals, outcome.synthesis.parts, format(options.format), folderOf(options));
}

}  // namespace tooljoint::app
