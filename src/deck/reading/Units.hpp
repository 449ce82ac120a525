// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Quantities with a unit ("120 rpm", "5 in", "8.6 ppg", "2.5 kN s/m") into SI numbers. Inside the
/// program everything is SI.
///
/// A unit is a product of the symbols of unitSymbols(), each with an optional exponent, "/" before
/// those it divides by: "N m", "N*m", "ft-lbf", "ft.lbf", "kg/m3", "kg/m^3", "N s/m", "m/s2",
/// "deg/30m", "1/s". More than one factor below a "/" needs parentheses: "W/(m s)". Angles (rad)
/// and cycles (Hz) are dimensions of their own: 1/s, rad/s and Hz are never mistaken for each
/// other. A few symbols (t, lb, klb) stand for a mass and for the weight of that mass under
/// standard gravity: toSi takes the reading of the wanted quantity.
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

/// One symbol of the table with what it measures, for the manual. Symbols of a mass and of its
/// weight have an entry for each.
struct UnitSymbol {
  std::string symbol;
  std::vector<std::string> synonyms;  ///< other spellings: "inch", "inches"
  std::string quantity;
  std::string si;  ///< SI unit of the quantity: 1 symbol = unit.factor si
  Unit unit;
};

const std::vector<UnitSymbol>& unitSymbols();

/// How symbols are read that stand for a mass and for a force.
enum class Reading { Mass, Force };

/// The unit, or nothing when the text is none; `fault` (if given) then holds a clause that says
/// why.
std::optional<Unit> parseUnit(std::string_view text, std::string* fault = nullptr,
                              Reading reading = Reading::Mass);

/// "120 rpm" -> SI value for a parameter whose SI unit is `si` ("rad/s"); nothing when the text has
/// no number, no unit, an unknown unit or one of another quantity, and `fault` then holds a full
/// clause for an error message.
std::optional<double> toSi(std::string_view text, const std::string& si, std::string& fault);

/// "in" of "5 in": what follows the number of a quantity, without blanks around it.
std::string unitText(const std::string& quantity);

/// Units of the table that may stand where `si` is expected, the best known ones: {"m", "mm",
/// "cm", "km", "ft", "in"}.
std::vector<std::string> unitsLike(const std::string& si);

}  // namespace tooljoint::deck
