// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Parts reduced, by Craig and Bampton unless another basis is named, and coupled.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <string>
#include <vector>

#include "coupling/assembly/Assembler.hpp"
#include "tests/support/SampleParts.hpp"

namespace tooljoint::estimate {

/// `modes` modes of each part.
inline coupling::Synthesis reduced(const std::vector<model::Substructure>& parts, int modes,
                                   const std::string& basis = "Craig-Bampton",
                                   const coupling::CouplingOptions& coupling = {}) {
  reduction::ReductionOptions options;
  options.modes.kind = reduction::ModeRule::Kind::PerPart;
  options.modes.counts = {modes};
  return coupling::synthesise(parts, *reduction::makeBasis(basis, Teuchos::ParameterList()),
                              options, coupling);
}

}  // namespace tooljoint::estimate
