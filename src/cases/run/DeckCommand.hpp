// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Options of commands for the deck of a case, in shell syntax.
#pragma once

#include <string>

#include "deck/Deck.hpp"

namespace tooljoint::cases {

/// The overrides of a deck except those of `unread`, a list that the command does not read: "
/// --without Mud --set 'Transient/Step=1 ms'"; "" for none.
std::string overrideSwitches(const deck::Deck& deck, const std::string& unread = "");

/// The options that make the full model of a deck that reduces: they remove its Reduction list and
/// everything that has no effect, or is rejected, without it; the other overrides remain.
std::string fullModelSwitches(const deck::Deck& deck);

}  // namespace tooljoint::cases
