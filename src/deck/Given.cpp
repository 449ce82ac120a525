// SPDX-License-Identifier: BSD-3-Clause
#include "deck/Given.hpp"

#include <iomanip>
#include <sstream>

#include "common/Text.hpp"

namespace tooljoint::deck {

std::string Given::text(double si) const {
  std::ostringstream digits;
  digits << std::setprecision(9) << si / factor;
  return formatNumber(std::stod(digits.str())) + " " + unit;
}

}  // namespace tooljoint::deck
