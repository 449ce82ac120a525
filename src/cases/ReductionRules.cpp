// SPDX-License-Identifier: BSD-3-Clause
#include "cases/ReductionRules.hpp"

#include <Teuchos_ParameterList.hpp>
#include <utility>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "reduction/Reduce.hpp"
#include "reduction/ReductionMethod.hpp"
#include "reduction/selection/ModeSelection.hpp"
#include "transient/TransientParameters.hpp"

namespace tooljoint::cases {

namespace {

class Rules {
 public:
  Rules(const Teuchos::ParameterList& deck, coupling::Assembly assembly, int parts)
      : deck_(deck),
        dual_(assembly == coupling::Assembly::Dual),
        several_(parts > 1),
        moves_(deck.isSublist("Transient")),
        explicit_(moves_ && transient::isExplicit(deck.sublist("Transient"))) {}

  std::vector<RuleFault> find() {
    if (dual_ && explicit_)
      add("Coupling/Assembly",
          "is \"Dual\", but its multipliers have no mass and the integrator " + integrator() +
              " needs a nonsingular mass matrix. Choose \"Primal\" or an implicit integrator.");
    if (!deck_.isSublist("Reduction")) {
      if (dual_)
        add("Coupling/Assembly",
            "is \"Dual\", which has no effect without a Reduction list. Add this list, or choose "
            "\"Primal\".");
      return faults_;
    }
    if (dual_ && choice("Interface Reduction") != "None")
      add("Reduction/Interface Reduction",
          "needs joined dofs, but with Coupling/Assembly \"Dual\" every part keeps its own dofs. "
          "Choose \"Primal\", or \"None\" here.");
    estimates();
    basis();
    return std::move(faults_);
  }

 private:
  const Teuchos::ParameterList& reduction() const { return deck_.sublist("Reduction"); }
  bool selects(const char* name) const { return reduction::selectsModesBy(reduction(), name); }
  std::string choice(const char* name) const { return reduction().get<std::string>(name); }
  std::string integrator() const {
    return inQuotes(deck_.sublist("Transient").get<std::string>("Integrator"));
  }
  bool estimatesMotion() const {
    const std::string estimated = choice("Error Estimate");
    return estimated == "Transient" || estimated == "Both" || selects("Motion Tolerance");
  }
  void add(const std::string& path, const std::string& sentence) {
    faults_.push_back({path, sentence});
  }
  /// The parameter that requests an error estimate.
  std::string estimate() const {
    for (const char* name : {"Motion Tolerance", "Frequency Tolerance"})
      if (selects(name)) return std::string("Reduction/Mode Selection/") + name;
    return "Reduction/Error Estimate";
  }

  void estimates() {
    if (moves_) return;
    if (selects("Motion Tolerance"))
      add("Reduction/Mode Selection/Motion Tolerance",
          "needs a motion, but the deck has no Transient list. Add one, or give \"Frequency "
          "Tolerance\".");
    const std::string estimated = choice("Error Estimate");
    if (estimated == "Transient" || estimated == "Both")
      add("Reduction/Error Estimate",
          "estimates the error of the motion, but the deck has no Transient list. Add one, or "
          "choose \"Frequencies\".");
  }

  /// Requests that the basis cannot satisfy.
  void basis() {
    reduction::MethodTraits traits;
    try {
      traits = reduction::makeBasis(choice("Basis"), reduction())->traits();
    } catch (const DeckError&) {
      return;  // reported by the reader of its parameters
    }
    const std::string name = inQuotes(choice("Basis"));
    if (!traits.ownMass && explicit_)
      add("Reduction/Basis",
          "is " + name + ", which has a singular mass matrix, but the integrator " + integrator() +
              " needs a nonsingular one. Choose \"Rubin\", which has the same modes, or an "
              "implicit integrator.");
    const bool estimates =
        choice("Error Estimate") != "None" || reduction::selectsModesByTolerance(reduction());
    if (!traits.ownMass && estimates)
      add(estimate(), "needs an error estimate, but the basis " + name +
                          " has none: its mass or interface is approximate. Choose \"Rubin\", "
                          "which has the same modes, or remove the estimate.");
    if (estimatesMotion() && moves_ && traits.ownMass && (dual_ || traits.dependent))
      add(estimate(),
          std::string("estimates the error of the motion, which is not available with ") +
              (dual_ ? "Coupling/Assembly \"Dual\""
                     : "dependent coordinates (\"Residual Coordinates\" = \"Tied\")") +
              ". Choose \"Frequencies\", or change that parameter.");
    if (dual_ && traits.dependent)
      add("Coupling/Assembly",
          "is \"Dual\", but the basis " + name +
              " needs the inverse of the coupled mass, which is then singular. Choose \"Primal\", "
              "or set \"Residual Coordinates\" to \"Free\".");
    if (choice("Load Vectors") != "None" && !traits.ownMass)
      add("Reduction/Load Vectors",
          "need modes with fixed boundary dofs and cannot be added to the basis " + name +
              ". Choose a fixed-interface basis such as \"Craig-Bampton\", or \"None\".");
    if (deck_.sublist("Reduction").get<bool>("Start State Vectors") && !traits.ownMass)
      add("Reduction/Start State Vectors",
          "need modes with fixed boundary dofs and cannot be added to the basis " + name +
              ". Choose a fixed-interface basis such as \"Craig-Bampton\", or remove them.");
    for (const char* criterion : {"Effective Interface Mass", "Interface Moment"})
      if (selects(criterion) && !traits.selectable)
        add(std::string("Reduction/Mode Selection/") + criterion,
            "selects fixed-interface modes one by one, but the basis " + name +
                " has none to select. Give \"Modes\", or choose \"Craig-Bampton\".");
    if (!traits.ownMass && several_ && choice("Interface Reduction") != "None")
      add("Reduction/Interface Reduction",
          "needs joined dofs with a mass, but the basis " + name +
              (traits.interfaceForces ? " joins parts by interface forces."
                                      : " leaves them none.") +
              " Choose another basis, or \"None\".");
    if (!traits.interfaceForces || !several_) return;
    if (deck_.isSublist("Output") &&
        deck_.sublist("Output").get<std::string>("Export Parts") != "None")
      add("Output/Export Parts", "cannot export parts of the basis " + name +
                                     ", because their coordinates do not contain the interface "
                                     "dofs. Choose another basis, for example \"Craig-Bampton\".");
  }

  const Teuchos::ParameterList& deck_;
  bool dual_, several_, moves_, explicit_;
  std::vector<RuleFault> faults_;
};

}  // namespace

std::vector<RuleFault> reductionFaults(const Teuchos::ParameterList& deck,
                                       coupling::Assembly assembly, int parts) {
  return Rules(deck, assembly, parts).find();
}

}  // namespace tooljoint::cases
