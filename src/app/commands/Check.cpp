// SPDX-License-Identifier: BSD-3-Clause
#include "app/commands/Command.hpp"
#include "cases/CaseCheck.hpp"
#include "substructures/drillstring/analyses/Calibration.hpp"
#include "substructures/drillstring/analyses/bottom_hole/BottomHole.hpp"
#include "substructures/drillstring/buckling/BucklingPath.hpp"

namespace tooljoint::app {

namespace {

struct CheckOptions : DeckOptions {
  bool cost = false;
};

/// Reads the lists of analyses of a string as their commands do. DeckError for an inconsistent
/// list.
void checkAnalyses(const drillstring::Scene& scene) {
  const auto& deck = scene.list();
  if (deck.isSublist("Torque and Drag"))
    drillstring::measurementsOf(scene, drillstring::torqueDragSettings(scene));
  if (deck.isSublist("Bottom-Hole Assembly")) drillstring::bottomHoleSettings(scene);
  if (deck.isSublist("Buckling")) drillstring::bucklingSettings(scene);
}

void check(const CheckOptions& options) {
  const auto one = readCase(options);
  if (const auto* string = dynamic_cast<const drillstring::DrillstringCase*>(one.get()))
    checkAnalyses(string->scene());
  cases::check(*one, options.cost);
}

Action prepareCheck(CLI::App& line) {
  auto options = std::make_shared<CheckOptions>();
  addDeckOptions(line, *options, Output::None);
  line.add_flag("--cost", options->cost,
                "compute static state and reduction too, and predict which model is faster");
  return [options] { check(*options); };
}

const bool checkRegistered =
    addCommand({Group::Runs, "check", "validate a deck and say what will be modelled; run nothing",
                prepareCheck});

}  // namespace

}  // namespace tooljoint::app
