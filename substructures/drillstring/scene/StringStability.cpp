// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/scene/StringStability.hpp"

#include <fmt/format.h>

#include "common/Error.hpp"
#include "common/report/Log.hpp"
#include "deck/PrintedUnits.hpp"
#include "stability/StabilityText.hpp"

namespace tooljoint::drillstring {

std::string describeStability(const StaticStage& stage) {
  const auto& s = stage.stability;
  std::string place;
  if (const auto node = s.outline.node; node != 0)
    place = fmt::format(
        "node {} (s = {})", node,
        deck::printed(stage.path.arcLength[static_cast<std::size_t>(node - 1)], "m", 4));
  return stability::inWords(s, "the string leaves it", place);
}

void summariseStability(const StaticStage& stage, io::Summary& summary) {
  const auto& s = stage.stability;
  stability::summarise(s, summary);
  summary.set("static.perturbations", stage.perturbations);
  if (!s.stable()) summary.set("static.unstable_node", static_cast<int>(s.outline.node));
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
