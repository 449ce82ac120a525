// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Parts reduced by Craig and Bampton and coupled.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <vector>

#include "coupling/assembly/Assembler.hpp"
#include "tests/support/SampleParts.hpp"

namespace tooljoint::estimate {

/// `modes` fixed-interface modes of each part.
inline coupling::Synthesis reduced(const std::vector<model::Substructure>& parts, int modes) {
  reduction::ReductionOptions options;
  options.modes.kind = reduction::ModeRule::Kind::PerPart;
  options.modes.counts = {modes};
  return coupling::synthesise(
      parts, *reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList()), options);
}

}  // namespace tooljoint::estimate
