// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What the lists Reduction, Coupling, Transient and Output ask of each other in any case: found
/// from the deck alone, before any part is made.
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

/// Choices that cannot stand together. `deck` is the root list with all defaults; `parts` is the
/// number of substructures.
std::vector<RuleFault> reductionFaults(const Teuchos::ParameterList& deck,
                                       coupling::Assembly assembly, int parts);

}  // namespace tooljoint::cases
