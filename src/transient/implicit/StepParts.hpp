// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "transient/implicit/StepEquations.hpp"
#include "transient/implicit/StepFactor.hpp"

namespace tooljoint::transient {

/// Parts shared by the iterations of an implicit step, and the iteration limit.
struct StepParts {
  CompiledModel* model = nullptr;
  StepEquations* equations = nullptr;
  StepFactor* factor = nullptr;
  Strategies* strategies = nullptr;
  int maxIterations = 0;
};

}  // namespace tooljoint::transient
