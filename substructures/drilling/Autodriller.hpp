// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A controller that holds the weight on bit by the speed of the block. It measures the weight by
/// the hook load. Deck list `Top Drive/Autodriller`.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <optional>

#include "deck/ListSpec.hpp"
#include "substructures/drilling/PointOnString.hpp"

namespace tooljoint::drilling {

struct Autodriller {
  double weight = 0.0;            ///< set point [N]
  double proportionalGain = 0.0;  ///< k_p [m/(N s)]
  double integralGain = 0.0;      ///< k_i [m/(N s2)]
  std::optional<double> fastest;  ///< speed of the block [m/s]
  double lineStiffness = 0.0;     ///< of the lines that carry the block [N/m]
  double blockMass = 0.0;         ///< moves with the top of the string [kg]
};

/// Description of the list `Autodriller`.
deck::ListSpec autodrillerParameters();
Autodriller readAutodriller(const Teuchos::ParameterList& list);

/// The lines act on w of the first node, in the frame that advances at the set speed `feed` [m/s].
/// `staticForce` [N] is their force in the static state, downwards positive. `staticWeight` [N] is
/// the weight on bit there; the hook load is tared with it. Channels measured_weight and
/// block_speed. Throws ModelError for a feed above the fastest speed.
PointOnString autodrillerOnString(const Autodriller& settings, double feed, double staticForce,
                                  double staticWeight);

}  // namespace tooljoint::drilling
