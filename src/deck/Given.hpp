// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Name and unit with which a deck gives a quantity, for messages in the same form.
#pragma once

#include <string>

namespace tooljoint::deck {

struct Given {
  std::string name;     ///< of the parameter: "Gauge Diameter" if it gives a Gauge Radius
  std::string unit;     ///< "in"; the SI unit if the deck gives none
  double factor = 1.0;  ///< SI value for one unit; half of it for a radius given by its diameter

  /// "12.125 in": an SI value in the unit of the deck. A number of at most nine digits, as of a
  /// parameter, is complete; a computed one has five digits, and all before the point.
  std::string text(double si) const;
};

}  // namespace tooljoint::deck
