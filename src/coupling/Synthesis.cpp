// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/Synthesis.hpp"

#include "common/Error.hpp"
#include "common/Parallel.hpp"

namespace tooljoint::coupling {

Synthesis synthesise(const std::vector<model::Substructure>& parts, const reduction::Basis& basis,
                     const reduction::ReductionOptions& options) {
  Synthesis result;
  result.parts = reduction::reduceAll(parts, basis, options);
  result.coupled = coupleWithPositions(result.parts);
  constexpr int rounds = 10;
  for (int round = 0; round <= rounds; ++round) {
    std::vector<reduction::BasisResult> bases;
    for (const auto& part : result.parts) bases.push_back(part.basis);
    bool improved = false;
    parallel::agree([&] { improved = basis.improve(result.coupled.model, result.coupled.positions, parts, bases); });
    if (!improved) return result;
    parallel::agree([&] {
      for (std::size_t p = 0; p < parts.size(); ++p)
        result.parts[p] = reduction::reduce(parts[p], bases[p], options, static_cast<int>(p));
    });
    result.coupled = coupleWithPositions(result.parts);
  }
  throw ConvergenceError("The basis \"" + options.basis + "\" still changed after " + std::to_string(rounds) +
                         " rounds of improvement with the coupled model.");
}

Synthesis synthesise(const std::vector<model::Substructure>& parts, const Teuchos::ParameterList& reduction) {
  const auto options = reduction::readOptions(reduction, static_cast<int>(parts.size()));
  return synthesise(parts, *reduction::makeBasis(options.basis, reduction), options);
}

}  // namespace tooljoint::coupling
