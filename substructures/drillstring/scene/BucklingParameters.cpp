// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/scene/BucklingParameters.hpp"

#include <Teuchos_ParameterList.hpp>
#include <string>

#include "common/Error.hpp"
#include "common/Text.hpp"

namespace tooljoint::drillstring {

deck::ListSpec bucklingParameters() {
  using deck::Optional;
  using deck::Range;
  deck::ListSpec list("Buckling",
                      "Static states of the string under a growing weight on bit, past buckling: "
                      "what `tooljoint buckling` computes.");
  list.real("Last Weight On Bit", "N", Optional{}, Range::positive(),
            "Where the path ends, which begins without weight on bit; Weight On Bit of Loads when "
            "absent.");
  list.real("Unload To", "N", Optional{}, Range::nonNegative(),
            "Weight on bit to which the path goes back after the last one; when absent it ends "
            "there. Shows how far down a helix stays that a growing weight would not yet make.");
  list.real("Crookedness", "", 0.02, Range{0.0, 0.5, false, false},
            "Amplitude of the stress-free shape of the string, a helix about its axis, as a part "
            "of the radial clearance: what makes it leave the straight state, and to one side. 0: "
            "a straight string, which passes its buckling load without a deflection.")
      .expert();
  list.real("Crookedness Pitch", "m", Optional{}, Range::positive(),
            "Length of a turn of that helix; when absent 2 pi sqrt(2 E I/F) at the compression F "
            "under which the straight string buckles.")
      .expert();
  list.choice("At A Limit", std::string("Jump"), {"Jump", "Follow"},
              "Where the states become unstable. \"Jump\": the string moves to the stable state it "
              "finds under that weight, and the path goes on from there. \"Follow\": the path "
              "goes on through unstable states, with less weight where it turns.")
      .expert();
  list.real("First Step", "", 0.01, Range::positive(),
            "Length of the first step of the path. The length is counted in clearances of lateral "
            "motion (root mean square along the string) and in shares of the last weight.")
      .expert();
  list.real("Largest Step", "", 0.05, Range::positive(), "Longest step.").expert();
  list.real("Smallest Step", "", 1e-8, Range::positive(),
            "Where a step of this length does not converge, the path ends.")
      .expert();
  list.integer("Max Steps", 2000, Range::atLeast(1),
               "Steps tried between two jumps, those halved included.")
      .expert();
  list.integer("Max Iterations", 12, Range::atLeast(2),
               "Newton iterations after which a step is halved.")
      .expert();
  return list;
}

BucklingSettings readBuckling(const Teuchos::ParameterList& list) {
  const auto optional = [&](const char* name) {
    return list.isParameter(name) ? std::optional(list.get<double>(name)) : std::nullopt;
  };
  BucklingSettings settings;
  settings.lastWeight = optional("Last Weight On Bit");
  settings.unloadTo = optional("Unload To");
  settings.crookedness = list.get<double>("Crookedness");
  settings.pitch = optional("Crookedness Pitch");
  settings.atLimit =
      list.get<std::string>("At A Limit") == "Jump" ? LimitRule::Jump : LimitRule::Follow;
  settings.firstStep = list.get<double>("First Step");
  settings.largestStep = list.get<double>("Largest Step");
  settings.smallestStep = list.get<double>("Smallest Step");
  settings.maxSteps = list.get<int>("Max Steps");
  settings.maxIterations = list.get<int>("Max Iterations");
  if (!(settings.smallestStep <= settings.firstStep && settings.firstStep <= settings.largestStep))
    throw DeckError("Buckling/First Step: is " + formatNumber(settings.firstStep) +
                    ", but has to lie between Smallest Step, " +
                    formatNumber(settings.smallestStep) + ", and Largest Step, " +
                    formatNumber(settings.largestStep) + ".");
  return settings;
}

}  // namespace tooljoint::drillstring
