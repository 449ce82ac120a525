// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Deck list `Buckling`: range and control of the growing weight on bit.
#pragma once

#include <optional>

#include "deck/ListSpec.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::drillstring {

/// Continuation at a limit, where a growing weight on bit leaves no stable state nearby.
enum class LimitRule {
  Jump,   ///< the string moves to the stable state that it reaches under this weight
  Follow  ///< the path continues through unstable states
};

struct BucklingSettings {
  std::optional<double> lastWeight;  ///< on bit [N]; none: that of the list Loads
  std::optional<double> unloadTo;    ///< weight to which the path goes back [N]; none: it ends
  double crookedness = 0.0;          ///< amplitude, as a fraction of the clearance
  std::optional<double> pitch;       ///< of the crookedness [m]; none: pitch of the first buckling
  LimitRule atLimit = LimitRule::Jump;
  double firstStep = 0.0, largestStep = 0.0, smallestStep = 0.0;  ///< of the path
  int maxSteps = 0, maxIterations = 0;
};

/// Description of the list.
deck::ListSpec bucklingParameters();

/// From the validated list. DeckError: inconsistent steps or weights.
BucklingSettings readBuckling(const Teuchos::ParameterList& list);

}  // namespace tooljoint::drillstring
