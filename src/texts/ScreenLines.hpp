// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Lines of the last screens: names, values and remarks in columns, numbers of summary.json.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace tooljoint::texts::screen {

using Json = nlohmann::json;

/// A number with so many decimals; none of them "-0".
std::string fixed(double value, int decimals);
/// A number with so many significant digits.
std::string brief(double value, int digits);
/// An SI value in the unit it is printed in, `usual` or that of the field.
std::string quantity(double si, const char* usual, int decimals);
/// A text filled to the width of a column.
std::string padded(const std::string& text);
/// A number of the summary by its JSON pointer; none where a stage did not run.
std::optional<double> number(const Json& summary, const char* path);
/// Prints a name in bold, a value and a remark.
void line(const std::string& name, const std::string& value, const std::string& remark = "");
/// Times of the stages, counters of the motion and memory, of --verbose.
void details(const Json& summary);
/// Says where the report is and what to try next, a command each.
void openAndNext(const std::string& folder, const std::vector<std::string>& commands);

}  // namespace tooljoint::texts::screen
