// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/scene/CutByCost.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string>

#include "common/Index.hpp"
#include "reduction/selection/ModeSelection.hpp"

namespace tooljoint::drillstring {
namespace {

bool isCutByCost(const Scene& scene) {
  return scene.reduces() && scene.partition.rule == "By cost";
}

}  // namespace

void checkCutByCost(const Scene& scene, cases::Faults& faults) {
  if (!isCutByCost(scene)) return;
  const auto refuse = [&](const std::string& sentence) {
    faults.add("Substructures/Rule", "\"By cost\" " + sentence);
  };
  if (!scene.moves()) refuse("needs a motion. Add a Transient list, or cut by component.");
  if (scene.coupling)
    refuse("chooses the parts that Coupling speaks of. Cut by component or by length.");
  const auto& reduction = scene.list().sublist("Reduction");
  if (reduction.isSublist("User Vectors"))
    refuse("chooses the parts that User Vectors are for. Cut by component or by length.");
  if (!reduction::selectsModesBy(reduction, "Cut-off Frequency") &&
      !reduction::selectsModesByTolerance(reduction))
    refuse(
        "compares parts of other lengths, whose modes must end at one frequency or by one "
        "tolerance: with a number of modes longer parts are cheaper because they are less "
        "accurate. Give Reduction/Mode Selection a Cut-off Frequency, a Frequency Tolerance or a "
        "Motion Tolerance, or cut by component.");
}

std::vector<double> lengthsOfParts(const DrillString& drillString) {
  std::vector<double> lengths;
  for (const auto& instance : drillString.instances) {
    lengths.push_back(0.0);
    for (int e = instance.firstElement; e <= instance.lastElement; ++e)
      lengths.back() += drillString.elements[at(e)].length();
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  constexpr double rounded = 1e-3;  // rounded down, so that a component of that length is long
                                    // enough
  std::vector<double> tried{rounded * std::floor(*middle / rounded)};
  while (2.0 * tried.back() <= 0.5 * drillString.length()) tried.push_back(2.0 * tried.back());
  return tried;
}

/// Lengths in metres, whatever units are printed: a length rounded up would need two components.
std::vector<std::vector<cases::Overrides>> cutsByCost(const Scene& scene) {
  if (!isCutByCost(scene)) return {};
  const auto open = [&scene](const std::string& name) {
    return !scene.deck.gives("Substructures/" + name);
  };
  std::vector<std::vector<cases::Overrides>> choices(1);
  for (const double length : lengthsOfParts(scene.string))
    choices[0].push_back(
        {"Substructures/Rule=By length", fmt::format("Substructures/Length={} m", length)});
  if (open("Retained Nodes") && open("Retained Gap"))
    choices.push_back({{"Substructures/Retained Nodes=All"}});
  if (open("Minimum Reduced Run")) choices.push_back({{"Substructures/Minimum Reduced Run=8"}});
  return choices;
}

}  // namespace tooljoint::drillstring
