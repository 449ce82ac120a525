// SPDX-License-Identifier: BSD-3-Clause
#include "app/Commands.hpp"
#include "app/ModesReport.hpp"
#include "app/PartsDeck.hpp"
#include "app/Report.hpp"
#include "app/Scene.hpp"
#include "app/Stages.hpp"
#include "common/report/Log.hpp"
#include "estimate/AdaptiveReduction.hpp"

namespace tooljoint::app {

namespace {

/// When the laws of time are looked at: the end of the motion, unless the command line says
/// otherwise.
double timeOf(const RunOptions& options, const Scene& scene) {
  if (options.modeTime) return *options.modeTime;
  return scene.moves() ? scene.list().sublist("Transient").get<double>("End Time") : 0.0;
}

}  // namespace

void modes(const RunOptions& options) {
  if (isPartsDeck(options)) {
    partsModes(options);
    return;
  }
  const auto scene = readScene(options.deck, options.overrides);
  log::info(describeScene(scene));
  const auto stage = settle(scene);
  log::info(describeStatic(stage));
  const auto planned = resolvedParts(scene, stage);
  const auto whole = scene.coupling ? joinUnreduced(planned) : coupling::Coupling();
  const auto full = scene.coupling ? whole.model : fullModel(stage);
  const double t = timeOf(options, scene);
  if (!scene.reduces()) {
    listFullModes(full, options, t);
    return;
  }
  const auto& parts = planned.parts;
  const auto outcome = estimate::synthesise(
      parts, scene.list().sublist("Reduction"),
      [&](const coupling::Synthesis& synthesis, const estimate::MotionLimit& limit) {
        estimate::MotionEstimator estimator(parts, synthesis, stage.state.displacement);
        return estimate::watchMotion(estimator, synthesis.coupled.model,
                                     transient::readOptions(scene.list().sublist("Transient")),
                                     limit);
      },
      planned.options);
  for (const auto& part : outcome.synthesis.parts) log::info(part.report.table());
  log::info(reduction::summaryTable(outcome.synthesis.parts));
  log::info(describeCoupling(outcome.synthesis.coupled));
  if (!outcome.rounds.empty()) log::info(estimate::roundTable(outcome.rounds));
  listComparedModes(full, whole.maps, parts, outcome.synthesis, options, t);
}

}  // namespace tooljoint::app
