// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Usual values in drilling. A number without a unit is in SI units, so "2000" for a flow in l/min
/// is a valid deck with the flow of a river. Unusual values cause a remark.
#pragma once

#include <string>
#include <vector>

#include "deck/Deck.hpp"

namespace tooljoint::drillstring {

struct UsualRange {
  std::string path;     ///< path in sceneSpec() of a number or of an array of numbers
  double low, high;     ///< of the magnitude, in SI; 0 is usual everywhere
  double highInSi = 0;  ///< `high` of a value in the SI unit, the unit of a bare number; 0: the
                        ///< same
};

/// Covers laboratory rigs up to the largest rigs.
const std::vector<UsualRange>& usualRanges();

/// For each unusual value in the deck a sentence with its position, and with units in which the
/// same number would be usual.
std::vector<std::string> unusualValues(const deck::Deck& scene);

}  // namespace tooljoint::drillstring
