// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Texts about the stability of a state at rest.
#pragma once

#include <string>

#include "io/summary/Summary.hpp"
#include "stability/StateStability.hpp"

namespace tooljoint::stability {

/// Verdict, mode and growth rate in words.
/// \param leaver what leaves the state without vibration, with its verb: "the string leaves it"
/// \param place name of the node ShapeOutline::node; not used if no node moves
std::string inWords(const StateStability& found, const std::string& leaver,
                    const std::string& place);

/// The keys static.stable, .stability_without, .negative_pivots, .growth_rate, .growth_hz and
/// .unstable_half_waves.
void summarise(const StateStability& found, io::Summary& summary);

}  // namespace tooljoint::stability
