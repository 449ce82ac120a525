// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a run says last.
#pragma once

#include <string>

#include "deck/Deck.hpp"

namespace tooljoint::texts {

/// The six numbers that matter of the run in `folder`, where its report is, and what to try next;
/// with log::verbose() also the times of the stages and the counters of the motion. Reads
/// summary.json; silent with log::quiet(). Rank 0 prints.
/// \param deck of the run, for the commands to try next
void lastScreen(const std::string& folder, const deck::Deck& deck);

}  // namespace tooljoint::texts
