// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Words of commands for the deck of a case, as a shell reads them.
#pragma once

#include <string>

#include "deck/Deck.hpp"

namespace tooljoint::cases {

/// The overrides of a deck but for those of `unread`, a list that the command does not read:
/// " --without Mud --set 'Transient/Step=1 ms'"; "" for none.
std::string overrideSwitches(const deck::Deck& deck, const std::string& unread = "");

/// The switches that make the full model of a deck that reduces: what has no effect, or is refused,
/// without its Reduction list goes with that list; the other overrides stay.
std::string fullModelSwitches(const deck::Deck& deck);

}  // namespace tooljoint::cases
