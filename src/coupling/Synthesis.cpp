// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/Synthesis.hpp"

#include <utility>

#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "coupling/assembly/DependentCoordinates.hpp"
#include "coupling/interface/InterfaceReduction.hpp"

namespace tooljoint::coupling {

namespace {

constexpr int rounds = 10;

}  // namespace

Synthesis synthesise(const std::vector<model::Substructure>& parts,
                     const reduction::ReductionMethod& basis,
                     const reduction::ReductionOptions& options, reduction::ReductionCache& cache,
                     const CouplingOptions& given) {
  CouplingOptions coupling = given;
  Synthesis result;
  result.parts = reduction::reduceAll(parts, basis, options, cache);
  for (const auto& part : result.parts)
    if (part.derivedInterface && part.derivedInterface->forces > 0)
      coupling.assembly = Assembly::Dual;
  result.coupled = coupleWithPositions(result.parts, coupling);
  for (int round = 0; round <= rounds; ++round) {
    std::vector<reduction::Basis> bases;
    for (const auto& part : result.parts) {
      bases.push_back(*part.basis);
      bases.back().rows = part.basisRows();
    }
    bool improved = false;
    parallel::agree([&] {
      improved = basis.augment(result.coupled.model, result.coupled.positions, cache.views, bases);
    });
    if (!improved) {
      parallel::agree([&] {
        condenseDependent(result.coupled,
                          basis.dependentCoordinates(result.coupled.model, result.coupled.maps,
                                                     cache.views, bases));
      });
      if (options.interface)
        parallel::agree([&] {
          std::vector<int> joinable;
          for (const auto& part : result.parts) joinable.push_back(part.interface);
          reduceInterfaces(result.coupled, *options.interface, joinable);
        });
      return result;
    }
    parallel::agree([&] {
      for (std::size_t p = 0; p < parts.size(); ++p)
        result.parts[p] = reduction::reduce(cache.views[p], bases[p], options, static_cast<int>(p));
    });
    result.coupled = coupleWithPositions(result.parts, coupling);
  }
  throw ConvergenceError("The basis \"" + options.basis + "\" did not converge after " +
                         std::to_string(rounds) +
                         " augmentation rounds with the coupled model. Choose another basis.");
}

Synthesis synthesise(const std::vector<model::Substructure>& parts,
                     const reduction::ReductionMethod& basis,
                     const reduction::ReductionOptions& options, const CouplingOptions& coupling) {
  reduction::ReductionCache none;
  none.remembers = false;
  return synthesise(parts, basis, options, none, coupling);
}

Synthesis synthesise(const std::vector<model::Substructure>& parts,
                     const Teuchos::ParameterList& reduction, const CouplingOptions& coupling) {
  const auto options = reduction::readOptions(reduction, static_cast<int>(parts.size()));
  return synthesise(parts, *reduction::makeBasis(options.basis, reduction), options, coupling);
}

}  // namespace tooljoint::coupling
