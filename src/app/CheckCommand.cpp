// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>

#include "app/Commands.hpp"
#include "app/PartsDeck.hpp"
#include "app/Report.hpp"
#include "app/Scene.hpp"
#include "app/Stages.hpp"
#include "app/StudyPlan.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "estimate/AdaptiveReduction.hpp"

namespace tooljoint::app {

namespace {

/// "modelled" and "not modelled" lines, aligned.
void item(bool modelled, const std::string& what, const std::string& why) {
  char line[512];
  std::snprintf(line, sizeof line, "  %-3s %-24s %s", modelled ? "yes" : "no", what.c_str(),
                why.c_str());
  log::info(line);
}

std::string families(const drillstring::SupportSettings& supports) {
  std::vector<std::string> names;
  if (supports.lateral) names.push_back("lateral");
  if (supports.axial) names.push_back("axial");
  if (supports.torsional) names.push_back("torsional");
  return join(names, ", ");
}

void listPhysics(const Scene& scene) {
  const bool turns = scene.rotary.present();
  log::info("modelled:");
  item(true, "motions", families(scene.supports) + " dofs");
  item(scene.loads.gravity != 0.0, "weight",
       scene.loads.gravity != 0.0 ? "g = " + formatNumber(scene.loads.gravity) + " m/s2"
                                  : "no gravity in Loads");
  item(scene.mud.has_value(), "mud",
       scene.mud ? "added mass, damping and buoyancy in every element" : "no Mud list");
  item(scene.contact.has_value(), "contact",
       scene.contact ? scene.contact->lawName + " law at " +
                           std::to_string(scene.contactPoints.size()) + " nodes"
                     : "no Contact list");
  const bool friction = scene.contact && scene.contact->friction;
  item(friction, "friction", friction ? "smoothed Coulomb" : "no Friction in Contact");
  const auto resting = staticFriction(scene);
  item(resting.direction != 0.0, "static friction", resting.why);
  item(turns, "gyroscopics", turns ? "matrices times the rotary speed" : "no Rotary Speed list");
  item(scene.statics.geometricStiffness, "geometric stiffness",
       scene.statics.geometricStiffness ? "of the static axial force and torque"
                                        : "switched off in Static");
  item(scene.damping.present(), "Rayleigh damping",
       scene.damping.present() ? "" : "no Damping list");
  item(scene.loads.weightOnBit != 0.0, "weight on bit",
       formatNumber(scene.loads.weightOnBit) + " N");
  item(scene.loads.torqueOnBit != 0.0, "torque on bit",
       formatNumber(scene.loads.torqueOnBit) + " N m");
  const bool unbalance = !scene.loads.unbalances.empty() && turns;
  item(unbalance, "mass unbalance",
       std::to_string(scene.loads.unbalances.size()) +
           (turns ? " places" : " places, but nothing turns"));
}

/// How the modes are chosen when a tolerance does it, and which errors are estimated.
void listEstimates(const Teuchos::ParameterList& reduction) {
  std::vector<std::string> tolerances;
  for (const char* name : {"Frequency Tolerance", "Motion Tolerance"})
    if (reduction.isParameter(name))
      tolerances.push_back(std::string(name) + " " + formatNumber(reduction.get<double>(name)));
  if (!tolerances.empty())
    item(true, "modes by tolerance",
         join(tolerances, ", ") + ": in rounds" +
             (reduction.isParameter("Motion Tolerance") ? ", each with a transient" : ""));
  const auto estimated = reduction.get<std::string>("Error Estimate");
  item(estimated != "None", "error estimate",
       estimated == "None" ? "Error Estimate is None" : "a posteriori, \"" + estimated + "\"");
}

/// What happens to the joined dofs.
void listInterfaces(const Teuchos::ParameterList& reduction) {
  const auto name = reduction.get<std::string>("Interface Reduction");
  item(name != "None", "interface reduction",
       name == "None" ? "all joined dofs are kept"
                      : "characteristic constraint modes, \"" + name + "\"");
}

void listCoupling(const Scene& scene) {
  item(scene.coupling.has_value(), "coupling",
       scene.coupling ? coupling::describe(*scene.coupling)
                      : "no Coupling list: equal node numbers join the parts");
  if (!scene.coupling) return;
  std::vector<std::string> names;
  for (const auto& part : drillstring::cutParts(scene.string, scene.partition))
    names.push_back(part.name + " (" + std::to_string(part.firstElement + 1) + " to " +
                    std::to_string(part.lastElement + 2) + ")");
  log::info("  parts and their nodes: " + join(names, ", "));
}

void listWork(const Scene& scene) {
  log::info("computed:");
  item(true, "path and static state", std::to_string(scene.freeDofs()) + " dofs");
  if (scene.reduces()) {
    const auto parts = drillstring::cutParts(scene.string, scene.partition);
    item(true, "reduction",
         std::to_string(parts.size()) + " parts (" + scene.partition.rule + "), retained nodes: " +
             scene.partition.retainedNodes + ", chosen when the static state is known");
    listEstimates(scene.list().sublist("Reduction"));
    listInterfaces(scene.list().sublist("Reduction"));
  } else {
    item(false, "reduction", "no Reduction list: the full model runs");
  }
  listCoupling(scene);
  if (!scene.moves()) {
    item(false, "transient", "no Transient list: the run stops at the static state");
    return;
  }
  const auto& list = scene.list().sublist("Transient");
  const double duration = list.get<double>("End Time") - list.get<double>("Start Time");
  const double samples = std::floor(duration / list.get<double>("Sampling Interval")) + 1.0;
  std::string what = list.get<std::string>("Integrator") + " over " + formatNumber(duration) + " s";
  if (list.isParameter("Step"))
    what += ", about " + countText(std::ceil(duration / list.get<double>("Step"))) + " steps";
  item(true, "transient", what);
  const double recorded =
      8.0 * samples * scene.string.nodeCount() *
      (6.0 * (scene.output.hasField("displacement") + scene.output.hasField("velocity") +
              scene.output.hasField("acceleration")) +
       scene.output.hasField("normal_force"));
  item(true, "results.h5",
       countText(samples) + " samples, about " + countText(std::ceil(recorded / 1e6)) + " MB");
}

/// Settles and reduces the scene to know both models.
void predictCost(const Scene& scene) {
  if (!scene.reduces() || !scene.moves()) {
    log::info("cost        nothing to compare: the deck has " +
              std::string(scene.moves() ? "no Reduction list" : "no Transient list"));
    return;
  }
  const auto stage = settle(scene);
  log::info(describeStatic(stage));
  const auto resolved = resolvedParts(scene, stage);
  auto options = transient::readOptions(scene.list().sublist("Transient"));
  const auto probe = [&](const coupling::Synthesis& synthesis, const estimate::MotionLimit& limit) {
    estimate::MotionEstimator estimator(resolved.parts, synthesis, stage.state.displacement);
    return estimate::watchMotion(estimator, synthesis.coupled.model, options, limit);
  };
  const auto outcome = estimate::synthesise(resolved.parts, scene.list().sublist("Reduction"),
                                            probe, resolved.options);
  log::info(describeCost(fullCostModel(scene, stage),
                         transient::costModel(outcome.synthesis.coupled.model, options)));
}

}  // namespace

void check(const RunOptions& options) {
  if (isPartsDeck(options)) {
    checkParts(options);
    return;
  }
  const auto scene = readScene(options.deck, options.overrides);
  if (!freeDirections(scene).empty())
    settle(scene);  // only the static state tells whether the string floats
  log::info(scene.deck.file() + " is a valid deck.");
  log::info(describeScene(scene));
  warnOfPrestress(scene);
  listPhysics(scene);
  listWork(scene);
  if (scene.list().isSublist("Study"))
    item(true, "study", describe(planStudy(*readStringStudy(options))));
  if (options.cost) predictCost(scene);
}

}  // namespace tooljoint::app
