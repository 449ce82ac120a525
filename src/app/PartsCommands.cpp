// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>

#include "app/ModesReport.hpp"
#include "app/PartsDeck.hpp"
#include "app/Report.hpp"
#include "app/StudyPlan.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"

namespace tooljoint::app {

namespace {

void item(bool modelled, const std::string& what, const std::string& why) {
  char line[512];
  std::snprintf(line, sizeof line, "  %-3s %-24s %s", modelled ? "yes" : "no", what.c_str(),
                why.c_str());
  log::info(line);
}

void listParts(const PartsDeck& deck) {
  log::info("modelled:");
  for (std::size_t p = 0; p < deck.scene.parts.size(); ++p) {
    const auto& content = deck.scene.contents[p];
    const auto& part = deck.scene.parts[p];
    std::vector<std::string> sets;
    for (const auto& set : content.interfaces) sets.push_back(set.name);
    item(true, part.name,
         content.file + ": " + std::to_string(part.model.size()) + " dofs, " +
             std::to_string(part.interface.size()) + " joined, " +
             std::to_string(part.retained.size()) + " retained" +
             (sets.empty() ? "" : "; sets " + quotedList(sets)));
    for (const auto& law : content.omitted)
      log::warn("Part \"" + part.name + "\" (" + content.file + ") had the point law \"" + law +
                "\" where it came from; it is not in the file.");
  }
  item(!deck.settings.joints.empty(), "joints",
       deck.settings.joints.empty() ? "no Joints in Parts" : join(deck.settings.joints, ", "));
  item(deck.list().isSublist("Coupling"), "coupling",
       deck.list().isSublist("Coupling") ? coupling::describe(deck.input) : "no Coupling list");
  item(!deck.settings.loads.empty(), "loads",
       std::to_string(deck.settings.loads.size()) + " beside those of the files");
}

void listWork(const PartsDeck& deck) {
  log::info("computed:");
  item(deck.settings.atRest, "equilibrium",
       deck.settings.atRest ? "of the loads of the start time" : "Initial State is \"From files\"");
  item(deck.reduces(), "reduction",
       deck.reduces() ? deck.list().sublist("Reduction").get<std::string>("Basis")
                      : "no Reduction list: the full model runs");
  if (!deck.moves()) {
    item(false, "transient", "no Transient list");
    return;
  }
  const auto& list = deck.list().sublist("Transient");
  item(true, "transient",
       list.get<std::string>("Integrator") + " over " +
           formatNumber(list.get<double>("End Time") - list.get<double>("Start Time")) + " s");
}

}  // namespace

void checkParts(const RunOptions& options) {
  const auto deck = readPartsDeck(options);
  const auto whole = deck.whole();
  checkStart(deck);
  log::info(deck.deck.file() + " is a valid deck.");
  log::info(describeParts(deck, whole));
  for (const auto& remark : whole.remarks) log::info(remark);
  listParts(deck);
  listWork(deck);
  if (deck.list().isSublist("Study"))
    item(true, "study", describe(planStudy(*readPartsStudy(options))));
}

void partsModes(const RunOptions& options) {
  const auto deck = readPartsDeck(options);
  const auto whole = deck.whole();
  log::info(describeParts(deck, whole));
  const double end = deck.moves() ? deck.list().sublist("Transient").get<double>("End Time") : 0.0;
  const double t = options.modeTime.value_or(end);
  if (!deck.reduces()) {
    listFullModes(whole.model, options, t);
    return;
  }
  const auto& parts = deck.scene.parts;
  const auto outcome = estimate::synthesise(
      parts, deck.list().sublist("Reduction"),
      [&](const coupling::Synthesis& synthesis, const estimate::MotionLimit& limit) {
        estimate::MotionEstimator estimator(parts, synthesis, restOf(whole),
                                            motionOptions(whole.model));
        return estimate::watchMotion(estimator, synthesis.coupled.model,
                                     transient::readOptions(deck.list().sublist("Transient")),
                                     limit);
      },
      deck.scene.coupling);
  for (const auto& part : outcome.synthesis.parts) log::info(part.report.table());
  log::info(reduction::summaryTable(outcome.synthesis.parts));
  log::info(describeCoupling(outcome.synthesis.coupled));
  if (!outcome.rounds.empty()) log::info(estimate::roundTable(outcome.rounds));
  listComparedModes(whole.model, whole.maps, parts, outcome.synthesis, options, t);
}

}  // namespace tooljoint::app
