// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Headings of the columns of a table: a name and its unit.
#pragma once

#include <optional>
#include <string>

namespace tooljoint::deck {

/// "Hook Load [klbf]" or "Hook Load (klbf)": name and unit, each without blanks around it; no unit
/// is "".
struct ColumnHeading {
  std::string name, unit;
};
ColumnHeading splitHeading(const std::string& cell);

/// Value in `si` of one `unit` as files of measurements write it: "klbf", "KLBF", "ft.lbf", "rpm";
/// "g" is the standard gravity where an acceleration is expected. Upper and lower case count only
/// where more than one unit would fit. Nothing for a unit that is unknown or measures something
/// else.
std::optional<double> unitFactor(const std::string& unit, const std::string& si);

}  // namespace tooljoint::deck
