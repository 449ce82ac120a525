// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Headings of the columns of a table: a name and its unit.
#pragma once

#include <optional>
#include <string>

namespace tooljoint::deck {

/// "Hook Load [klbf]" or "Hook Load (klbf)": name and unit, each without surrounding blanks; "" for
/// no unit.
struct ColumnHeading {
  std::string name, unit;
};
ColumnHeading splitHeading(const std::string& cell);

/// Value in `si` of one `unit` in the spellings of measurement files: "klbf", "KLBF", "ft.lbf",
/// "rpm"; "g" is the standard gravity if an acceleration is expected, "1/min" and "c/min" are
/// revolutions per minute if a rotary speed is. Case matters only if several
/// units would match. None for a unit that is unknown or of another quantity.
std::optional<double> unitFactor(const std::string& unit, const std::string& si);

}  // namespace tooljoint::deck
