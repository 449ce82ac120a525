// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Memory from one solve to the next for problems on one pattern: the order and the fill of
/// factors.
#pragma once

#include <memory>

#include "linalg/chains/DividedChain.hpp"
#include "linalg/trilinos/DirectSolver.hpp"

namespace tooljoint::statics {

struct NewtonMemory {
  linalg::DofNamer name;  ///< of the unknowns of the current problem
  std::unique_ptr<linalg::DirectSolver> factors;
  std::unique_ptr<linalg::DividedChain> chain;  ///< of a divided problem
  Sparse pattern;                               ///< of `chain`
};

}  // namespace tooljoint::statics
