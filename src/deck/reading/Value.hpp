// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The strict lexical reading of one value: the whole text must be what its type says. (Teuchos
/// alone would read type="double" value="12abc" as 12, "1,5" as 1, "" as 0, and type="int"
/// value="3.7" as 3.)
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

/// The known type a person meant by `type` ("Double", "float", "integer", "Array(float)"), "" when
/// there is no good guess.
std::string meantType(const std::string& type);

/// The value, or nothing; `fault` then holds a clause such as `is not a number`, to stand after the
/// quoted value. Surrounding blanks and a leading "+" are accepted; decimal commas, other trailing
/// characters, nan and inf are not.
std::optional<Value> parseValue(const std::string& type, const std::string& text,
                                std::string& fault);

/// The type attribute that belongs to a value.
std::string typeOf(const Value& value);

}  // namespace tooljoint::deck
