// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/case/StringOutline.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "common/Constants.hpp"
#include "common/Text.hpp"
#include "deck/Defaults.hpp"
#include "deck/PrintedUnits.hpp"
#include "substructures/drillstring/scene/BottomHoleParameters.hpp"
#include "substructures/drillstring/scene/BucklingParameters.hpp"
#include "substructures/drillstring/scene/Stages.hpp"
#include "substructures/softstring/TorqueDragParameters.hpp"

namespace tooljoint::drillstring {

namespace {

std::string families(const SupportSettings& supports) {
  std::vector<std::string> names;
  if (supports.lateral) names.push_back("lateral");
  if (supports.axial) names.push_back("axial");
  if (supports.torsional) names.push_back("torsional");
  return join(names, ", ");
}

std::vector<cases::OutlineItem> physics(const Scene& scene) {
  const bool turns = scene.rotary.present();
  const bool friction = scene.contact && scene.contact->friction;
  const auto resting = staticFriction(scene);
  std::vector<cases::OutlineItem> items{
      {true, "motions", families(scene.supports) + " dofs"},
      {scene.mud != nullptr, "mud",
       scene.mud ? scene.list().sublist("Mud").get<std::string>("Model") + " in every element"
                 : "no Mud list"},
      {scene.contact.has_value(), "contact",
       scene.contact ? scene.contact->lawName + " law at " +
                           std::to_string(scene.contactPoints.size()) + " nodes"
                     : "no Contact list"},
      {friction, "friction",
       !friction                      ? "no Friction in Contact"
       : scene.contact->axialFriction ? "smoothed Coulomb, around and along the hole"
                                      : "smoothed Coulomb"},
      {resting.sliding.any(), "static friction", resting.why},
      {turns, "gyroscopics", turns ? "matrices times the rotary speed" : "no Rotary Speed list"},
      {scene.statics.geometricStiffness, "geometric stiffness",
       scene.statics.geometricStiffness ? "of the static axial force and torque"
                                        : "switched off in Static"},
      {scene.damping.present(), "Rayleigh damping",
       scene.damping.present()
           ? formatNumber(scene.damping.massCoefficient) + " 1/s of the mass, " +
                 formatNumber(scene.damping.stiffnessCoefficient) + " s of the stiffness"
           : "no Damping list"}};
  items.push_back({scene.bit.has_value(), "rock at the bit",
                   scene.bit ? scene.bit->name + ": " + scene.bit->law->describe()
                             : "no Bit list: constant weight and torque"});
  const bool drive = scene.list().isSublist("Top Drive");
  items.push_back({drive, "top drive",
                   drive ? drilling::describe(scene.topDrive)
                         : "no Top Drive list: it turns with the rotary speed"});
  const auto waves = drilling::describeWaves(scene.topDrive);
  if (!waves.empty()) items.push_back({true, "torsional waves", waves});
  const double toolFace = scene.string.toolFace / constants::degree;
  const auto sided = [&](const std::vector<SidedNode>& nodes, const char* what) {
    if (!nodes.empty())
      items.push_back({true, what,
                       std::to_string(nodes.size()) + ", tool face " +
                           formatNumber(std::round(1e3 * toolFace) / 1e3) + " deg"});
  };
  sided(scene.string.bends, "bends");
  sided(scene.string.eccentricGauges, "eccentric gauges");
  sided(scene.string.pads, "pads");
  if (scene.loads.empty()) items.push_back({false, "loads", "no Loads list"});
  for (const auto& load : scene.loads)
    for (const auto& remark : load->describe(scene.rotary))
      items.push_back({remark.acts, remark.load, remark.text});
  return items;
}

/// Summaries of `tooljoint torque-drag`, `bha` and `buckling`, from their lists or, where the deck
/// needs none, by default.
std::vector<std::string> analyses(const Scene& scene) {
  const auto counted = [](std::size_t count, const std::string& what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
  };
  std::vector<std::string> found;
  const auto read = [&](const deck::ListSpec& spec, bool possible, const auto& describe) {
    const bool given = scene.list().isSublist(spec.name());
    if (!given && !possible) return;
    deck::withDefaults(
        spec, given ? scene.list().sublist(spec.name()) : Teuchos::ParameterList(),
        [&](const auto& list) { found.push_back(describe(list, given ? "" : " by default")); });
  };
  const bool pressed = scene.contact.has_value() && loads::acceleration(scene.loads).norm() > 0.0;
  const bool rubs = pressed && scene.contact->friction;
  read(softstring::torqueDragParameters(), rubs, [&](const auto& list, const std::string& how) {
    using softstring::StiffDepths;
    const auto own = softstring::readTorqueDrag(list);
    const auto depths =
        own.depths.empty() ? static_cast<std::size_t>(own.count) : own.depths.size();
    return "  torque and drag" + how + ": " + counted(depths, "depth") + ", " +
           counted(own.operations.size(), "operation") + ", the stiff string at " +
           (own.stiff == StiffDepths::None      ? "none of them"
            : own.stiff == StiffDepths::Deepest ? "the deepest"
                                                : "all of them") +
           (own.measured ? ", calibration to " + *own.measured : "") + " (tooljoint torque-drag)";
  });
  read(bottomHoleParameters(), pressed, [&](const auto& list, const std::string& how) {
    const auto own = readBottomHole(list);
    const auto atLeastOne = [](std::size_t count) { return count == 0 ? std::size_t{1} : count; };
    return "  bottom-hole assembly" + how + ": " +
           counted(atLeastOne(own.inclinations.size()), "hole") + ", " +
           counted(atLeastOne(own.weights.size()), "weight") + " on bit, " +
           counted(atLeastOne(own.toolFaces.size()), "tool face") + " (tooljoint bha)";
  });
  read(bucklingParameters(), pressed && scene.weightOnBit() > 0.0,
       [&](const auto& list, const std::string& how) {
         const auto own = readBuckling(list);
         const double last = own.lastWeight.value_or(scene.weightOnBit());
         return "  buckling" + how + ": up to " + deck::printed(last, "kN", 6) + " on the bit" +
                (own.unloadTo ? ", back to " + deck::printed(*own.unloadTo, "kN", 6) : "") +
                ", crookedness " + formatNumber(own.crookedness) + " of the clearance, " +
                (own.atLimit == LimitRule::Jump ? "jumps where states become unstable"
                                                : "through unstable states") +
                " (tooljoint buckling)";
       });
  return found;
}

}  // namespace

cases::CaseOutline outlineOf(const Scene& scene) {
  cases::CaseOutline out;
  out.modelled = physics(scene);
  out.rest = {true, "path and static state", std::to_string(scene.freeDofs()) + " dofs"};
  if (scene.reduces()) {
    const auto& rules = scene.partition;
    out.reduction =
        (rules.rule == "By cost" ? "parts of the length with which a step costs least"
                                 : std::to_string(cutParts(scene.string, rules).size()) +
                                       " parts (" + rules.rule + ")") +
        ", retained nodes: " + rules.retainedNodes + ", chosen when the static state is known";
  }
  out.coupling = {scene.coupling.has_value(), "coupling",
                  scene.coupling ? coupling::describe(*scene.coupling)
                                 : "no Coupling list: equal node numbers join the parts"};
  out.notes = analyses(scene);
  if (!scene.coupling) return out;
  std::vector<std::string> names;
  for (const auto& part : cutParts(scene.string, scene.partition))
    names.push_back(part.name + " (" + std::to_string(part.firstElement + 1) + " to " +
                    std::to_string(part.lastElement + 2) + ")");
  out.notes.insert(out.notes.begin(), "  parts and their nodes: " + join(names, ", "));
  return out;
}

}  // namespace tooljoint::drillstring
