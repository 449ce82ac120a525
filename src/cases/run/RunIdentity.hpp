// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Identity of a run as text: two runs with the same text compute the same numbers, and a
/// checkpoint continues only a run with the same text.
#pragma once

#include <string>

#include "deck/Deck.hpp"

namespace tooljoint::cases {

/// A line "PATH = VALUE" for each parameter of the deck (overrides and defaults included) that
/// affects the numbers or their recording, and a line for the content of each file named in the
/// deck. Excluded: lists of analyses (Study), Transient/Progress, output of Output other than
/// samples, and Transient/Checkpoint Interval for integrators that can continue from any step.
/// Collective. FileError when a file cannot be read.
std::string runIdentity(const deck::Deck& deck);

/// "Transient/End Time was 40 and is 50; ...", up to three differences of two such texts; empty
/// when there are none.
std::string identityDifferences(const std::string& then, const std::string& now);

}  // namespace tooljoint::cases
