// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How a deck gives a quantity, so that messages can give it as the deck does.
#pragma once

#include <string>

namespace tooljoint::deck {

struct Given {
  std::string name;     ///< of the parameter: "Gauge Diameter" where that gives a Gauge Radius
  std::string unit;     ///< "in"; the SI unit where the deck gives none
  double factor = 1.0;  ///< SI value for one unit; half of it for a radius given by its diameter

  /// "12.125 in": an SI value as the deck would give it, with nine digits at most.
  std::string text(double si) const;
};

}  // namespace tooljoint::deck
