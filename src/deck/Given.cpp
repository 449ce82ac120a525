// SPDX-License-Identifier: BSD-3-Clause
#include "deck/Given.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "common/Text.hpp"

namespace tooljoint::deck {

namespace {

double rounded(double value, int digits) {
  std::ostringstream text;
  text << std::setprecision(digits) << value;
  return std::stod(text.str());
}

}  // namespace

std::string Given::text(double si) const {
  constexpr int given = 9, derived = 5;  // significant digits
  constexpr double rounding = 1e-12;     // relative, of conversions between units
  const double value = si / factor, complete = rounded(value, given);
  const bool exact = std::abs(value - complete) <= rounding * std::abs(value);
  const int whole = value == 0.0 ? 1 : static_cast<int>(std::log10(std::abs(value))) + 1;
  return formatNumber(exact ? complete : rounded(value, std::max(derived, whole))) + " " + unit;
}

}  // namespace tooljoint::deck
