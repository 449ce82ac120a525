// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/ReductionParameters.hpp"

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <string>
#include <vector>

#include "common/Text.hpp"
#include "deck/Variants.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "reduction/Reduce.hpp"
#include "reduction/methods/InterfaceBasis.hpp"

namespace tooljoint::reduction {

namespace {

const std::vector<std::string> modeCounts{
    "Modes",           "Modes by Substructure",    "Total Modes",      "Cut-off Frequency",
    "All Modes",       "Effective Interface Mass", "Interface Moment", "Frequency Tolerance",
    "Motion Tolerance"};

/// The share of a criterion, or the tolerances; false when `choice` is none of them.
bool readCriterion(const Teuchos::ParameterList& list, const std::string& choice, ModeRule& rule) {
  if (choice == "Effective Interface Mass" || choice == "Interface Moment") {
    rule.kind = choice == "Interface Moment" ? ModeRule::Kind::InterfaceMoment
                                             : ModeRule::Kind::InterfaceMass;
    rule.fraction = list.get<double>(choice);
    return true;
  }
  if (choice != "Frequency Tolerance" && choice != "Motion Tolerance") return false;
  rule.kind = ModeRule::Kind::Tolerance;
  if (list.isParameter("Frequency Tolerance"))
    rule.frequencyTolerance = list.get<double>("Frequency Tolerance");
  if (list.isParameter("Motion Tolerance"))
    rule.motionTolerance = list.get<double>("Motion Tolerance");
  rule.safety = list.get<double>("Tolerance Safety");
  return true;
}

void declareCriteria(deck::ListSpec& list) {
  using deck::Range;
  const auto fraction = Range{0.0, 1.0, true, false};
  const auto tolerance = Range{0.0, 0.5, true, false};
  list.real("Effective Interface Mass", "", deck::Optional{}, fraction,
            "The modes of each substructure that couple most to its boundary dofs, until they hold "
            "this fraction of the coupling mass (Kammer and "
            "Triller 1996).")
      .expert();
  list.real("Interface Moment", "", deck::Optional{}, fraction,
            "The same with the first moment of the coupling, which weighs low frequencies more "
            "(Liao, Bai and Gao 2007).")
      .expert();
  list.real("Frequency Tolerance", "", deck::Optional{}, tolerance,
            "As many modes of each substructure as the estimated relative errors of the coupled "
            "frequencies need to stay below this; which "
            "frequencies: \"Estimated Frequencies\" or \"Estimated Below\".");
  list.real(
      "Motion Tolerance", "", deck::Optional{}, tolerance,
      "As many modes as the estimated vibration error of the transient needs to stay below this, "
      "alone or with \"Frequency Tolerance\"; the "
      "transient is run once for every round of the choice, up to where it fails. A part "
      "that would get nearly all of its modes is kept whole.");
  list.real("Tolerance Safety", "", 1.5, Range::atLeast(1.0),
            "What an estimate is multiplied by before it is compared with a tolerance; that of the "
            "motion, which is less sharp, by twice "
            "this.")
      .expert();
  list.choice("Error Estimate", std::string("None"), {"None", "Frequencies", "Transient", "Both"},
              "Errors that are estimated a posteriori, from residuals: of the coupled frequencies "
              "about the static state, of the motion "
              "(its vibration error, while it is computed), or of both.");
  list.integer("Estimated Frequencies", 20, Range::atLeast(1),
               "How many of the lowest coupled frequencies estimates and tolerances look at.")
      .expert();
  list.real("Estimated Below", "Hz", deck::Optional{}, Range::positive(),
            "Look at all coupled frequencies below this instead.")
      .expert();
}

}  // namespace

deck::ListSpec parameters() {
  using deck::Range;
  deck::ListSpec list("Reduction",
                      "Component mode synthesis of the substructures; without this list the full "
                      "model runs. Exactly one answer to how many modes are "
                      "kept must be given: \"Modes\", \"Modes by Substructure\", \"Total Modes\", "
                      "\"Cut-off Frequency\", \"All Modes\", \"Effective Interface "
                      "Mass\", \"Interface Moment\", or a tolerance; none of them cuts a close "
                      "pair of modes: the number is rounded up.");
  deck::declareVariants<ReductionMethod, const Teuchos::ParameterList&>(
      list, "Basis", std::string("Craig-Bampton"), "Family of the reduction basis.");
  list.integer("Modes", deck::Optional{}, Range::atLeast(0),
               "Number of modes of every substructure; 0 is static condensation.");
  list.integerArray("Modes by Substructure", deck::Optional{}, Range::atLeast(0),
                    "Number of modes of each substructure, in their order.")
      .expert();
  list.integer("Total Modes", deck::Optional{}, Range::atLeast(0),
               "The lowest so many modes over all substructures together.")
      .expert();
  list.real("Cut-off Frequency", "Hz", deck::Optional{}, Range::nonNegative(),
            "All modes of each substructure at or below this frequency.");
  list.boolean("All Modes", false,
               "Every mode of every substructure: the reduced model is the full one in other "
               "coordinates.")
      .expert();
  declareCriteria(list);
  list.real("Pair Tolerance", "", defaultPairTolerance, Range::between(0.0, 0.2),
            "Relative difference in frequency up to which two neighbouring modes count as a pair "
            "that is never cut; 0 keeps only "
            "equal frequencies together.")
      .expert();
  declareLoadVectors(list);
  list.choice("Initial State", std::string("Keep static"), {"Keep static", "Least squares"},
              "\"Keep static\" reduces about the static state, which is then exact; \"Least "
              "squares\" projects it on the basis "
              "(Nguyen et al. 2020, (42)).");
  deck::declareVariants<InterfaceBasis, const Teuchos::ParameterList&>(
      list, "Interface Reduction", std::string("None"),
      "Reduction of the dofs at which substructures are joined, after they were coupled.");
  list.boolean("Basis Checks", true,
               "Check rank, static exactness, zero-energy modes and the largest frequency of every "
               "basis.")
      .expert();
  list.passThrough("Anasazi", "Parameters of the Anasazi eigensolver, handed on as they are.");
  return list;
}

ReductionOptions readOptions(const Teuchos::ParameterList& list, int parts) {
  std::vector<std::string> given;
  for (const auto& name : modeCounts)
    if (list.isParameter(name) && (name != "All Modes" || list.get<bool>(name)))
      given.push_back(name);
  if (given.empty())
    throw DeckError("Reduction does not say how many modes to keep: give exactly one of " +
                    quotedList(modeCounts) + ".");
  if (given == std::vector<std::string>{"Frequency Tolerance", "Motion Tolerance"})
    given.pop_back();  // both hold
  if (given.size() > 1)
    throw DeckError(
        "Reduction gives " + quotedList(given) +
        " together: they are different answers to how many modes to keep. Give exactly one.");

  ReductionOptions options;
  options.basis = list.get<std::string>("Basis");
  options.initialState = list.get<std::string>("Initial State") == "Keep static"
                             ? InitialState::KeepStatic
                             : InitialState::LeastSquares;
  options.checks = list.get<bool>("Basis Checks");
  options.loadVectors = readLoadVectors(list);
  options.modes.pairTolerance = list.get<double>("Pair Tolerance");
  const std::string& choice = given.front();
  if (choice == "Modes") {
    options.modes.kind = ModeRule::Kind::PerPart;
    options.modes.counts = {list.get<int>(choice)};
  } else if (choice == "Modes by Substructure") {
    options.modes.kind = ModeRule::Kind::PerPart;
    options.modes.counts = list.get<Teuchos::Array<int>>(choice).toVector();
    if (static_cast<int>(options.modes.counts.size()) != parts)
      throw DeckError(
          "\"Modes by Substructure\" has " + std::to_string(options.modes.counts.size()) +
          " entries for " + std::to_string(parts) +
          " substructures; give one number for each, or \"Modes\" for the same number everywhere.");
  } else if (choice == "Total Modes") {
    options.modes.kind = ModeRule::Kind::Total;
    options.modes.total = list.get<int>(choice);
  } else if (choice == "Cut-off Frequency") {
    options.modes.kind = ModeRule::Kind::CutOff;
    options.modes.cutOffHz = list.get<double>(choice);
  } else if (!readCriterion(list, choice, options.modes)) {
    options.modes.kind = ModeRule::Kind::All;
  }
  if (list.isParameter("Interface Reduction")) {
    const auto& name = list.get<std::string>("Interface Reduction");
    options.interface = InterfaceRegistry::instance().make(
        name, list.isSublist(name) ? list.sublist(name) : Teuchos::ParameterList(name));
  }
  makeBasis(options.basis, list);  // finds what is wrong with its own list now
  if (list.isSublist("Anasazi")) {
    auto eigen = std::make_shared<linalg::EigenOptions>();
    eigen->anasazi = &list.sublist("Anasazi");
    options.eigen = eigen;
  }
  return options;
}

std::unique_ptr<ReductionMethod> makeBasis(const std::string& name,
                                           const Teuchos::ParameterList& reduction) {
  const Teuchos::ParameterList none;
  return MethodRegistry::instance().make(
      name, reduction.isSublist(name) ? reduction.sublist(name) : none);
}

std::vector<ReducedSubstructure> reduceAll(const std::vector<model::Substructure>& parts,
                                           const Teuchos::ParameterList& reduction) {
  const ReductionOptions options = readOptions(reduction, static_cast<int>(parts.size()));
  return reduceAll(parts, *makeBasis(options.basis, reduction), options);
}

}  // namespace tooljoint::reduction
