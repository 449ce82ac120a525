// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/Synthesis.hpp"

#include <utility>

#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "coupling/assembly/DependentCoordinates.hpp"
#include "coupling/interface/InterfaceReduction.hpp"

namespace tooljoint::coupling {

namespace {

/// Couples reduced parts and lets the basis improve them.
Synthesis join(const std::vector<model::Substructure>& parts,
               const reduction::ReductionMethod& basis, const reduction::ReductionOptions& options,
               CouplingOptions coupling, std::vector<reduction::ReducedSubstructure> reduced) {
  Synthesis result;
  result.parts = std::move(reduced);
  for (const auto& part : result.parts)
    if (part.boundary && part.boundary->forces > 0) coupling.assembly = Assembly::Dual;
  result.coupled = coupleWithPositions(result.parts, coupling);
  constexpr int rounds = 10;
  for (int round = 0; round <= rounds; ++round) {
    std::vector<reduction::Basis> bases;
    for (const auto& part : result.parts) {
      bases.push_back(*part.basis);
      bases.back().rows = part.basisRows();
    }
    bool improved = false;
    parallel::agree([&] {
      improved = basis.augment(result.coupled.model, result.coupled.positions, parts, bases);
    });
    if (!improved) {
      parallel::agree([&] {
        condenseDependent(
            result.coupled,
            basis.dependentCoordinates(result.coupled.model, result.coupled.maps, parts, bases));
      });
      if (options.interface)
        parallel::agree([&] { reduceInterfaces(result.coupled, *options.interface); });
      return result;
    }
    parallel::agree([&] {
      for (std::size_t p = 0; p < parts.size(); ++p)
        result.parts[p] = reduction::reduce(parts[p], bases[p], options, static_cast<int>(p));
    });
    result.coupled = coupleWithPositions(result.parts, coupling);
  }
  throw ConvergenceError("The basis \"" + options.basis + "\" still changed after " +
                         std::to_string(rounds) + " rounds of improvement with the coupled model.");
}

}  // namespace

Synthesis synthesise(const std::vector<model::Substructure>& parts,
                     const reduction::ReductionMethod& basis,
                     const reduction::ReductionOptions& options, const CouplingOptions& coupling) {
  return join(parts, basis, options, coupling, reduction::reduceAll(parts, basis, options));
}

Synthesis synthesise(const std::vector<model::Substructure>& parts,
                     const reduction::ReductionMethod& basis,
                     const reduction::ReductionOptions& options, reduction::ReductionCache& cache,
                     const CouplingOptions& coupling) {
  return join(parts, basis, options, coupling, reduction::reduceAll(parts, basis, options, cache));
}

Synthesis synthesise(const std::vector<model::Substructure>& parts,
                     const Teuchos::ParameterList& reduction, const CouplingOptions& coupling) {
  const auto options = reduction::readOptions(reduction, static_cast<int>(parts.size()));
  return synthesise(parts, *reduction::makeBasis(options.basis, reduction), options, coupling);
}

}  // namespace tooljoint::coupling
