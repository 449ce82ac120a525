// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What studies, maps and analyses say last.
#pragma once

#include <string>

#include "deck/Deck.hpp"

namespace tooljoint::texts {

/// The numbers that matter of an analysis ("study", "map", "torque_drag", "bha", "buckling",
/// "campbell", "response" or "modes") in `folder`, where its report is, and what to try next.
/// Reads summary.json; silent with log::quiet(). Rank 0 prints.
void analysisScreen(const std::string& analysis, const std::string& folder, const deck::Deck& deck);

}  // namespace tooljoint::texts
