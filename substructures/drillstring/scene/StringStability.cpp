// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/scene/StringStability.hpp"

#include <fmt/format.h>

#include "common/Error.hpp"
#include "common/report/Log.hpp"
#include "deck/PrintedUnits.hpp"

namespace tooljoint::drillstring {

namespace {

/// What is said of a growth rate that stands for the lowest modes alone.
constexpr const char* unrefined =
    " The growth rate is that of the lowest modes alone: its refinement with all dofs did not "
    "converge.";

std::string counted(int count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/// "3 half waves, largest in u of node 13 (s = 6 m)".
std::string modeText(const StaticStage& stage) {
  const auto& mode = stage.stability.outline;
  if (mode.node == 0) return "no node moves along";
  return fmt::format(
      "{}, largest in {} of node {} (s = {})", counted(mode.halfWaves, "half wave"), mode.component,
      mode.node,
      deck::printed(stage.path.arcLength[static_cast<std::size_t>(mode.node - 1)], "m", 4));
}

}  // namespace

std::string describeStability(const StaticStage& stage) {
  const auto& s = stage.stability;
  std::string text = counted(s.negativePivots, "negative pivot") + " of the symmetric tangent";
  if (s.stable()) {
    if (s.examined > 0)
      text +=
          ", no damped motion in the space of its " + counted(s.examined, "lowest mode") + " grows";
    return "stable: " + text + "." + stability::withoutStates(s.held);
  }
  const std::string motion = s.diverges()
                                 ? "the string leaves it"
                                 : fmt::format("a vibration of {:.4g} Hz grows", s.frequency);
  return fmt::format("unstable: {} as exp({:.4g} t) ({}); {}.{}", motion, s.growthRate,
                     modeText(stage), text, s.refined ? "" : unrefined) +
         stability::withoutStates(s.held);
}

void summariseStability(const StaticStage& stage, io::Summary& summary) {
  const auto& s = stage.stability;
  summary.set("static.negative_pivots", s.negativePivots);
  summary.set("static.perturbations", stage.perturbations);
  summary.set("static.stable", s.stable());
  summary.set("static.stability_without", s.held);
  if (s.stable()) return;
  summary.set("static.growth_rate", s.growthRate);
  summary.set("static.growth_hz", s.frequency);
  summary.set("static.unstable_node", static_cast<int>(s.outline.node));
  summary.set("static.unstable_half_waves", s.outline.halfWaves);
}

void judgeStability(const Scene& scene, const StaticStage& stage) {
  const auto& s = stage.stability;
  if (s.stable()) return;
  const std::string found = "The static state is " + describeStability(stage);
  if (scene.statics.unstable == equilibrium::UnstableRule::Refuse)
    throw ConvergenceError(found + " Reduce the loads, or set Static/Unstable State to \"Warn\"" +
                           (s.diverges() ? " or \"Perturb\"." : "."));
  log::warn(found + (s.diverges()
                         ? " Set Static/Unstable State to \"Perturb\" to find the state on the "
                           "wall, or to \"Refuse\"."
                         : " A small disturbance grows into a vibration without an excitation."));
}

}  // namespace tooljoint::drillstring
