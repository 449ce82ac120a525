// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/ReductionParameters.hpp"

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <memory>
#include <string>
#include <vector>

#include "common/Text.hpp"
#include "deck/Variants.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "reduction/Reduce.hpp"
#include "reduction/methods/InterfaceBasis.hpp"
#include "reduction/selection/ModeSelection.hpp"

namespace tooljoint::reduction {

namespace {

void declareEstimates(deck::ListSpec& list) {
  using deck::Range;
  list.choice("Error Estimate", std::string("None"), {"None", "Frequencies", "Transient", "Both"},
              "A-posteriori error estimates from residuals: of the coupled frequencies about the "
              "static state, of the vibration error during the transient, or of both. That of the "
              "transient does not see motion within the Sampling Interval, and is too small where "
              "truncated modes vibrate faster.");
  list.integer("Estimated Frequencies", 20, Range::atLeast(1),
               "Number of the lowest coupled frequencies in estimates and tolerances.")
      .expert();
  list.real("Estimated Below", "Hz", deck::Optional{}, Range::positive(),
            "Include all coupled frequencies below this instead.")
      .expert();
}

}  // namespace

deck::ListSpec parameters() {
  using deck::Range;
  deck::ListSpec list("Reduction",
                      "Component mode synthesis of the substructures; without this list the full "
                      "model runs. The list \"Mode Selection\" says how many modes are kept.");
  list.removed({"Pair Tolerance", "Tolerance Safety"},
               "one value holds for every case; it is a constant. Leave it out.");
  list.list(modeSelection());
  deck::declareVariants<ReductionMethod, const Teuchos::ParameterList&>(
      list, "Basis", std::string("Craig-Bampton"), "Family of the reduction basis.");
  declareEstimates(list);
  declareLoadVectors(list);
  list.choice("Initial State", std::string("Keep static"), {"Keep static", "Least squares"},
              "\"Keep static\" reduces about the static state, which is then exact; \"Least "
              "squares\" projects it on the basis "
              "(Nguyen et al. 2020, (42)).");
  deck::declareVariants<InterfaceBasis, const Teuchos::ParameterList&>(
      list, "Interface Reduction", std::string("None"),
      "Reduction of the joined dofs after coupling.");
  list.boolean("Basis Checks", true,
               "Check rank, static exactness, zero-energy modes and the largest frequency of every "
               "basis.")
      .expert();
  list.passThrough("Anasazi", "Parameters passed to the eigensolver Anasazi unchanged.");
  return list;
}

ReductionOptions readOptions(const Teuchos::ParameterList& list, int parts) {
  ReductionOptions options;
  options.basis = list.get<std::string>("Basis");
  options.initialState = list.get<std::string>("Initial State") == "Keep static"
                             ? InitialState::KeepStatic
                             : InitialState::LeastSquares;
  options.checks = list.get<bool>("Basis Checks");
  options.loadVectors = readLoadVectors(list);
  options.loadVectors.keepStatic = options.initialState == InitialState::KeepStatic;
  if (list.isParameter("Interface Reduction")) {
    const auto& name = list.get<std::string>("Interface Reduction");
    options.interface = InterfaceRegistry::instance().make(
        name, list.isSublist(name) ? list.sublist(name) : Teuchos::ParameterList(name));
  }
  const auto method = makeBasis(options.basis, list);  // reports the faults of its own list now
  options.modes = readModeSelection(list, parts, method->traits().needsModes);
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
