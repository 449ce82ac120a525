// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a run computes, as text: two runs with the same text compute the same numbers, and a
/// checkpoint goes on only with its own.
#pragma once

#include <string>

#include "deck/Deck.hpp"

namespace tooljoint::cases {

/// A line "PATH = VALUE" for each parameter of the deck (overrides and defaults included) that
/// changes the numbers or what is recorded of them, and a line for the content of each file the
/// deck names. Left out: lists of analyses (Study), Transient/Progress, what Output writes beside
/// the samples, and Transient/Checkpoint Interval for integrators that go on from anywhere.
/// Collective. FileError when a file cannot be read.
std::string runIdentity(const deck::Deck& deck);

/// "Transient/End Time was 40 and is 50; ...", up to three differences of two such texts; empty
/// when there are none.
std::string identityDifferences(const std::string& then, const std::string& now);

}  // namespace tooljoint::cases
