// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/selection/ModeSelection.hpp"

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <string>
#include <vector>

#include "common/Error.hpp"
#include "common/Text.hpp"

namespace tooljoint::reduction {

namespace {

const std::string listName = "Mode Selection";
const std::string frequencyTolerance = "Frequency Tolerance";
const std::string motionTolerance = "Motion Tolerance";

/// Name of a choice in an earlier version: a parameter of the list "Reduction".
std::string inReduction(const std::string& name) { return "../" + name; }

/// Names of the choices made in `selection`. A switch that is off does not count.
std::vector<std::string> given(const Teuchos::ParameterList& selection,
                               const std::vector<std::string>& choices) {
  std::vector<std::string> names;
  for (const std::string& name : choices)
    if (selection.isParameter(name) && (!selection.isType<bool>(name) || selection.get<bool>(name)))
      names.push_back(name);
  return names;
}

}  // namespace

deck::ListSpec modeSelection() {
  using deck::Optional;
  using deck::Range;
  const auto fraction = Range{0.0, 1.0, true, false};
  const auto tolerance = Range{0.0, 0.5, true, false};
  deck::ListSpec list(listName,
                      "Number of modes kept. Give exactly one parameter; only the two tolerances "
                      "may stand together. A close pair of modes is never cut: the number is "
                      "rounded up.");
  list.integer("Modes", Optional{}, Range::atLeast(0),
               "Number of modes of every substructure; 0 is static condensation.")
      .formerly(inReduction("Modes"));
  list.real("Cut-off Frequency", "Hz", Optional{}, Range::nonNegative(),
            "All modes of each substructure at or below this frequency.")
      .formerly(inReduction("Cut-off Frequency"));
  list.real(frequencyTolerance, "", Optional{}, tolerance,
            "As many modes of each substructure as the estimated relative errors of the coupled "
            "frequencies need to stay below this; which frequencies: \"Estimated Frequencies\" or "
            "\"Estimated Below\".")
      .formerly(inReduction(frequencyTolerance));
  list.real(motionTolerance, "", Optional{}, tolerance,
            "As many modes as the estimated vibration error of the transient needs to stay below "
            "this, alone or with \"Frequency Tolerance\". Every round runs the transient until the "
            "estimate exceeds the tolerance. A part that would keep nearly all of its modes is not "
            "reduced.")
      .formerly(inReduction(motionTolerance));
  list.integerArray("Modes by Substructure", Optional{}, Range::atLeast(0),
                    "Number of modes of each substructure, in their order.")
      .expert()
      .formerly(inReduction("Modes by Substructure"));
  list.integer("Total Modes", Optional{}, Range::atLeast(0),
               "Number of modes over all substructures: those of the lowest frequencies.")
      .expert()
      .formerly(inReduction("Total Modes"));
  list.boolean("All Modes", Optional{},
               "Every mode of every substructure: the reduced model is the full one in other "
               "coordinates.")
      .expert()
      .formerly(inReduction("All Modes"));
  list.real("Effective Interface Mass", "", Optional{}, fraction,
            "The modes of each substructure that couple most to its boundary dofs, up to this "
            "fraction of the coupling mass (Kammer and Triller 1996).")
      .expert()
      .formerly(inReduction("Effective Interface Mass"));
  list.real("Interface Moment", "", Optional{}, fraction,
            "The same with the first moment of the coupling, which weighs low frequencies more "
            "(Liao, Bai and Gao 2007).")
      .expert()
      .formerly(inReduction("Interface Moment"));
  return list;
}

bool selectsModesBy(const Teuchos::ParameterList& reduction, const std::string& name) {
  return reduction.isSublist(listName) && reduction.sublist(listName).isParameter(name);
}

double toleranceOf(const Teuchos::ParameterList& reduction, const std::string& name) {
  return selectsModesBy(reduction, name) ? reduction.sublist(listName).get<double>(name) : 0.0;
}

bool selectsModesByTolerance(const Teuchos::ParameterList& reduction) {
  return selectsModesBy(reduction, frequencyTolerance) ||
         selectsModesBy(reduction, motionTolerance);
}

ModeRule readModeSelection(const Teuchos::ParameterList& reduction, int parts, bool needed) {
  const deck::ListSpec spec = modeSelection();
  std::vector<std::string> choices;
  for (const auto& parameter : spec.parameters()) choices.push_back(parameter.name);
  const Teuchos::ParameterList none;
  const auto& list = reduction.isSublist(listName) ? reduction.sublist(listName) : none;
  auto names = given(list, choices);
  if (names == std::vector<std::string>{frequencyTolerance, motionTolerance}) names.pop_back();
  if (names.empty() && !needed) {
    ModeRule noModes;
    noModes.kind = ModeRule::Kind::PerPart;
    noModes.counts = {0};
    return noModes;
  }
  if (names.empty())
    throw DeckError(
        "Reduction does not select modes. Give the list \"Mode Selection\" exactly one of " +
        quotedList(choices) + ".");
  if (names.size() > 1)
    throw DeckError("Reduction/Mode Selection gives " + quotedList(names) +
                    " together. Give exactly one.");

  ModeRule rule;
  const std::string& choice = names.front();
  if (choice == "Modes") {
    rule.kind = ModeRule::Kind::PerPart;
    rule.counts = {list.get<int>(choice)};
  } else if (choice == "Modes by Substructure") {
    rule.kind = ModeRule::Kind::PerPart;
    rule.counts = list.get<Teuchos::Array<int>>(choice).toVector();
    if (static_cast<int>(rule.counts.size()) != parts)
      throw DeckError("\"Modes by Substructure\" has " + std::to_string(rule.counts.size()) +
                      " entries for " + std::to_string(parts) +
                      " substructures. Give one number for each, or \"Modes\" for the same number "
                      "everywhere.");
  } else if (choice == "Total Modes") {
    rule.kind = ModeRule::Kind::Total;
    rule.total = list.get<int>(choice);
  } else if (choice == "Cut-off Frequency") {
    rule.kind = ModeRule::Kind::CutOff;
    rule.cutOffHz = list.get<double>(choice);
  } else if (choice == "All Modes") {
    rule.kind = ModeRule::Kind::All;
  } else if (choice == frequencyTolerance || choice == motionTolerance) {
    rule.kind = ModeRule::Kind::Tolerance;
    rule.frequencyTolerance = toleranceOf(reduction, frequencyTolerance);
    rule.motionTolerance = toleranceOf(reduction, motionTolerance);
  } else {
    rule.kind = choice == "Interface Moment" ? ModeRule::Kind::InterfaceMoment
                                             : ModeRule::Kind::InterfaceMass;
    rule.fraction = list.get<double>(choice);
  }
  return rule;
}

}  // namespace tooljoint::reduction
