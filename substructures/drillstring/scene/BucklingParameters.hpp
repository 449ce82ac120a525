// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Deck list `Buckling`: how far and how the weight on bit of a string grows.
#pragma once

#include <optional>

#include "deck/ListSpec.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::drillstring {

/// Where a growing weight on bit leaves no stable state near the last one.
enum class LimitRule {
  Jump,   ///< the string moves to the stable state it finds under this weight
  Follow  ///< the path goes on through unstable states
};

struct BucklingSettings {
  std::optional<double> lastWeight;  ///< on bit [N]; none: that of the list Loads
  std::optional<double> unloadTo;    ///< weight to which the path goes back [N]; none: it ends
  double crookedness = 0.0;          ///< amplitude, as a part of the clearance
  std::optional<double> pitch;       ///< of the crookedness [m]; none: that of the first buckling
  LimitRule atLimit = LimitRule::Jump;
  double firstStep = 0.0, largestStep = 0.0, smallestStep = 0.0;  ///< of the path
  int maxSteps = 0, maxIterations = 0;
};

/// Description of the list.
deck::ListSpec bucklingParameters();

/// From the validated list. DeckError: steps or weights do not fit each other.
BucklingSettings readBuckling(const Teuchos::ParameterList& list);

}  // namespace tooljoint::drillstring
