// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The result of a component mode synthesis in Python.
#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "Lists.hpp"
#include "Models.hpp"
#include "coupling/input/ResolvedCoupling.hpp"
#include "estimate/AdaptiveReduction.hpp"

namespace tooljoint::python {

using Parts = std::vector<PartPointer>;

/// Connections in addition to equal labels: none, a list Coupling, or the connections of a deck.
using Joining = std::variant<std::monostate, List, coupling::CouplingOptions>;

struct Synthesised {
  coupling::ResolvedCoupling unreduced;
  estimate::Outcome outcome;
  ModelPointer model;  ///< that of the coupling
};

}  // namespace tooljoint::python
