// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Conversion of quantities with a unit ("120 rpm", "5 in", "8.6 ppg", "2.5 kN s/m") to SI numbers.
/// Inside the program everything is SI.
///
/// A unit is a product of the symbols of unitSymbols(), each with an optional exponent; "/"
/// precedes divisors: "N m", "N*m", "ft-lbf", "ft.lbf", "kg/m3", "kg/m^3", "N s/m", "m/s2",
/// "deg/30m", "1/s". More than one factor below a "/" needs parentheses: "W/(m s)". Angles (rad)
/// and cycles (Hz) have their own dimensions, so that 1/s, rad/s and Hz are never confused. A few
/// symbols (t, lb, klb) denote both a mass and the weight of that mass under standard gravity: toSi
/// selects the meaning by the wanted quantity.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tooljoint::deck {

/// Exponents of metre, kilogram, second, radian, cycle.
using Dimension = std::array<int, 5>;

struct Unit {
  double factor = 1.0;  ///< value in SI = factor * value in this unit
  Dimension dimension{};
};

/// One symbol of the table with its quantity, for the manual. Symbols of a mass and of its weight
/// have one entry for each.
struct UnitSymbol {
  std::string symbol;
  std::vector<std::string> synonyms;  ///< other spellings: "inch", "inches"
  std::string quantity;
  std::string si;  ///< SI unit of the quantity: 1 symbol = unit.factor si
  Unit unit;
};

const std::vector<UnitSymbol>& unitSymbols();

/// Meaning of symbols that denote both a mass and a force.
enum class Reading { Mass, Force };

/// The unit, or none if the text is not a unit; `fault` (if given) then contains a clause with the
/// reason.
std::optional<Unit> parseUnit(std::string_view text, std::string* fault = nullptr,
                              Reading reading = Reading::Mass);

/// "120 rpm" -> SI value for a parameter with the SI unit `si` ("rad/s"). None if the text has no
/// number, no unit, an unknown unit or one of another quantity; `fault` then contains a full clause
/// for an error message.
std::optional<double> toSi(std::string_view text, const std::string& si, std::string& fault);

/// "in" for "5 in": the text after the number of a quantity, without surrounding blanks.
std::string unitText(const std::string& quantity);

/// Common units of the table that are accepted for `si`: {"m", "mm", "cm", "km", "ft", "in"}.
std::vector<std::string> unitsLike(const std::string& si);

}  // namespace tooljoint::deck
