// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What is usual in drilling. A number without a unit is in SI units, so that "2000" for a flow in
/// l/min is a valid deck of a river: such values are remarked on.
#pragma once

#include <string>
#include <vector>

#include "deck/Deck.hpp"

namespace tooljoint::drillstring {

struct UsualRange {
  std::string path;     ///< of a number, or of an array of them, of sceneSpec()
  double low, high;     ///< of its size, in its SI unit; 0 is usual everywhere
  double highInSi = 0;  ///< `high` of a value in the SI unit, which a bare number has; 0: the same
};

/// From the laboratory to the largest rigs.
const std::vector<UsualRange>& usualRanges();

/// A sentence with the place for each value that the deck gives outside its usual range, with units
/// in which the same number would be inside.
std::vector<std::string> unusualValues(const deck::Deck& scene);

}  // namespace tooljoint::drillstring
