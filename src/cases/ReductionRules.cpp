// SPDX-License-Identifier: BSD-3-Clause
#include "cases/ReductionRules.hpp"

#include <Teuchos_ParameterList.hpp>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "reduction/Reduce.hpp"
#include "reduction/ReductionMethod.hpp"
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
          "is \"Dual\", whose multipliers have no mass, but the integrator " + integrator() +
              " needs a mass everywhere. Take \"Primal\", or an implicit integrator.");
    if (!deck_.isSublist("Reduction")) {
      if (dual_)
        add("Coupling/Assembly",
            "is \"Dual\", which has no effect without a Reduction list: the full model is primal. "
            "Add one, or take \"Primal\".");
      return faults_;
    }
    if (dual_ && choice("Interface Reduction") != "None")
      add("Reduction/Interface Reduction",
          "needs joined dofs, but Coupling/Assembly \"Dual\" leaves every part its own. Take "
          "\"Primal\", or \"None\".");
    estimates();
    basis();
    return std::move(faults_);
  }

 private:
  const Teuchos::ParameterList& reduction() const { return deck_.sublist("Reduction"); }
  bool has(const char* name) const { return reduction().isParameter(name); }
  std::string choice(const char* name) const { return reduction().get<std::string>(name); }
  std::string integrator() const {
    return inQuotes(deck_.sublist("Transient").get<std::string>("Integrator"));
  }
  bool estimatesMotion() const {
    const std::string estimated = choice("Error Estimate");
    return estimated == "Transient" || estimated == "Both" || has("Motion Tolerance");
  }
  void add(const std::string& path, const std::string& sentence) {
    faults_.push_back({path, sentence});
  }
  /// The parameter that asks for an estimate of errors.
  std::string estimate() const {
    for (const char* name : {"Motion Tolerance", "Frequency Tolerance"})
      if (has(name)) return std::string("Reduction/") + name;
    return "Reduction/Error Estimate";
  }

  void estimates() {
    if (moves_) return;
    if (has("Motion Tolerance"))
      add("Reduction/Motion Tolerance",
          "needs a motion, and the scene has no Transient list. Add one, or take \"Frequency "
          "Tolerance\".");
    const std::string estimated = choice("Error Estimate");
    if (estimated == "Transient" || estimated == "Both")
      add("Reduction/Error Estimate",
          "asks for the error of the motion, and the scene has no Transient list. Add one, or take "
          "\"Frequencies\".");
  }

  /// What the basis is asked for, and cannot give.
  void basis() {
    reduction::MethodTraits traits;
    try {
      traits = reduction::makeBasis(choice("Basis"), reduction())->traits();
    } catch (const DeckError&) {
      return;  // its own parameters are wrong, which its reader says
    }
    const std::string name = inQuotes(choice("Basis"));
    if (!traits.ownMass && explicit_)
      add("Reduction/Basis", "is " + name + ", whose mass is singular, but the integrator " +
                                 integrator() +
                                 " needs a mass everywhere. Take \"Rubin\", which has the same "
                                 "modes, or an implicit integrator.");
    const bool estimates =
        choice("Error Estimate") != "None" || has("Frequency Tolerance") || has("Motion Tolerance");
    if (!traits.ownMass && estimates)
      add(estimate(), "asks for errors of the basis " + name +
                          ", whose mass or interfaces are not those of the motions it can make, so "
                          "that residuals do "
                          "not tell the error. Take \"Rubin\", which has the same modes, or leave "
                          "the estimate out.");
    if (estimatesMotion() && moves_ && traits.ownMass && (dual_ || traits.dependent))
      add(estimate(),
          std::string("asks for the error of the motion, which is not estimated with ") +
              (dual_ ? "Coupling/Assembly \"Dual\""
                     : "coordinates that depend on others (\"Residual Coordinates\" = \"Tied\")") +
              ". Take \"Frequencies\", or another choice there.");
    if (dual_ && traits.dependent)
      add("Coupling/Assembly", "is \"Dual\", but the basis " + name +
                                   " needs the inverse of the coupled mass, which is singular "
                                   "then. Take \"Primal\", or set "
                                   "\"Residual Coordinates\" to \"Free\".");
    if (choice("Load Vectors") != "None" && !traits.ownMass)
      add("Reduction/Load Vectors",
          "are answers of the interior with its kept dofs held, and cannot be added to the basis " +
              name +
              ". Take a basis with fixed interface, such as \"Craig-Bampton\", or leave them out.");
    for (const char* criterion : {"Effective Interface Mass", "Interface Moment"})
      if (has(criterion) && !traits.selectable)
        add(std::string("Reduction/") + criterion,
            "chooses among modes with fixed interface, and the basis " + name +
                " has none that can be left out one by one. Give \"Modes\", or take "
                "\"Craig-Bampton\".");
    if (!traits.interfaceForces || !several_) return;
    if (choice("Interface Reduction") != "None")
      add("Reduction/Interface Reduction",
          "needs joined dofs, but the basis " + name +
              " joins parts by the forces between them. Take another basis, or \"None\".");
    if (deck_.isSublist("Output") &&
        deck_.sublist("Output").get<std::string>("Export Parts") != "None")
      add("Output/Export Parts", "cannot export parts of the basis " + name +
                                     ", whose coordinates do not contain the interface dofs. Take "
                                     "another basis, \"Craig-Bampton\" for instance.");
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
