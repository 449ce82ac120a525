// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Strict lexical reading of one value: the whole text must match its type. (Teuchos alone would
/// read type="double" value="12abc" as 12, "1,5" as 1, "" as 0, and type="int" value="3.7" as 3.)
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace tooljoint::deck {

using Value = std::variant<bool, int, double, std::string, std::vector<int>, std::vector<double>,
                           std::vector<std::string>>;

/// Type attributes a deck may use: "double", "int", "bool", "string", "Array(double)",
/// "Array(int)", "Array(string)".
const std::vector<std::string>& typeNames();

/// The type most similar to `type` ("Double", "float", "integer", "Array(float)"), "" if there is
/// no good match.
std::string meantType(const std::string& type);

/// The value, or none; `fault` then contains a clause such as `is not a number` for use after the
/// quoted value. Surrounding blanks and a leading "+" are accepted; decimal commas, other trailing
/// characters, nan and inf are not.
std::optional<Value> parseValue(const std::string& type, const std::string& text,
                                std::string& fault);

/// The type attribute that belongs to a value.
std::string typeOf(const Value& value);

}  // namespace tooljoint::deck
