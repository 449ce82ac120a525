// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Consistency of the lists Reduction, Coupling, Transient and Output in any case, checked with the
/// deck alone, before any part is built.
#pragma once

#include <string>
#include <vector>

#include "coupling/input/Connections.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::cases {

/// A sentence about the parameter at `path` of a deck.
struct RuleFault {
  std::string path;
  std::string sentence;  ///< continues the path: "is \"Dual\", but ..."
};

/// Choices that exclude each other. `deck` is the root list with all defaults; `parts` is the
/// number of substructures.
std::vector<RuleFault> reductionFaults(const Teuchos::ParameterList& deck,
                                       coupling::Assembly assembly, int parts);

}  // namespace tooljoint::cases
