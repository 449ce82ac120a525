// SPDX-License-Identifier: BSD-3-Clause
#include "stability/StabilityText.hpp"

#include <fmt/format.h>

namespace tooljoint::stability {

namespace {

/// Added to a growth rate that is known only from the lowest modes.
constexpr const char* unrefined =
    " The growth rate is that of the lowest modes alone: its refinement with all dofs did not "
    "converge.";

std::string counted(int count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/// "3 half waves, largest in u of node 13"
std::string modeText(const ShapeOutline& mode, const std::string& place) {
  if (mode.node == 0) return "no node moves along";
  return fmt::format("{}, largest in {} of {}", counted(mode.halfWaves, "half wave"),
                     mode.component, place);
}

}  // namespace

std::string inWords(const StateStability& found, const std::string& leaver,
                    const std::string& place) {
  const std::string text =
      counted(found.negativePivots, "negative pivot") + " of the symmetric tangent";
  if (found.stable()) {
    const std::string modes =
        "no damped motion in the space of its " + counted(found.examined, "lowest mode") + " grows";
    const std::string reason = found.examined == 0        ? "the symmetric tangent is definite"
                               : found.negativePivots > 0 ? text + ", " + modes
                                                          : modes;
    return "stable: " + reason + "." + withoutStates(found.held);
  }
  const std::string motion =
      found.diverges() ? leaver : fmt::format("a vibration of {:.4g} Hz grows", found.frequency);
  return fmt::format("unstable: {} as exp({:.4g} t) ({}); {}.{}", motion, found.growthRate,
                     modeText(found.outline, place), text, found.refined ? "" : unrefined) +
         withoutStates(found.held);
}

void summarise(const StateStability& found, io::Summary& summary) {
  summary.set("static.negative_pivots", found.negativePivots);
  summary.set("static.stable", found.stable());
  summary.set("static.stability_without", found.held);
  if (found.stable()) return;
  summary.set("static.growth_rate", found.growthRate);
  summary.set("static.growth_hz", found.frequency);
  summary.set("static.unstable_half_waves", found.outline.halfWaves);
}

}  // namespace tooljoint::stability
