// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Component mode synthesis in one call: reduce, couple, and augment the bases with the coupled
/// model.
#pragma once

#include <vector>

#include "coupling/assembly/Assembler.hpp"
#include "reduction/Reduce.hpp"

namespace tooljoint::coupling {

/// Reduced parts and their coupled model.
struct Synthesis {
  std::vector<reduction::ReducedSubstructure> parts;
  Coupling coupled;
};

/// reduceAll, couple, then ReductionMethod::augment until nothing changes (at most ten rounds, else
/// ConvergenceError), then the interface reduction of the options. Bases with interface forces as
/// coordinates are always assembled dual, whatever `coupling` specifies. Collective.
Synthesis synthesise(const std::vector<model::Substructure>& parts,
                     const reduction::ReductionMethod& basis,
                     const reduction::ReductionOptions& options,
                     const CouplingOptions& coupling = {});

/// The same in several rounds over the same parts; reductions are cached between rounds.
Synthesis synthesise(const std::vector<model::Substructure>& parts,
                     const reduction::ReductionMethod& basis,
                     const reduction::ReductionOptions& options, reduction::ReductionCache& cache,
                     const CouplingOptions& coupling = {});

/// The same from the deck list "Reduction".
Synthesis synthesise(const std::vector<model::Substructure>& parts,
                     const Teuchos::ParameterList& reduction, const CouplingOptions& coupling = {});

}  // namespace tooljoint::coupling
