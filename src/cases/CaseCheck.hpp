// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The command `tooljoint check` for any case.
#pragma once

#include "cases/Case.hpp"

namespace tooljoint::cases {

/// Logs what will and what will not be modelled and computed, and why; rejects every case that a
/// run would reject. \param cost  also solves for the state at rest and reduces, to compare the
/// cost of a step of the
///              full and of the reduced model. DeckError, ModelError, ConvergenceError. Collective.
void check(const Case& one, bool cost);

}  // namespace tooljoint::cases
