// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What `tooljoint check` does with any case.
#pragma once

#include "cases/Case.hpp"

namespace tooljoint::cases {

/// Logs what will and what will not be modelled and computed, and why; refuses what a run would
/// refuse. \param cost also solves for the state at rest and reduces, to compare the cost of a step
/// of the full and of the reduced model. DeckError, ModelError, ConvergenceError. Collective.
void check(const Case& one, bool cost);

}  // namespace tooljoint::cases
