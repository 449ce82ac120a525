// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Measured logs against time, from CSV files with units in their header or from LAS files.
#pragma once

#include <string>
#include <vector>

namespace tooljoint::deck {

/// A column that is wanted of a log.
struct WantedColumn {
  std::string name;  ///< in the header; of the time "": the column "Time", of a LAS file the index
  std::string si;    ///< SI unit of what it measures
  std::string unit;  ///< of the deck; "": that of the header
};

/// A measured signal; what was not measured is left out.
struct LogSignal {
  std::vector<double> time;   ///< [s], increasing
  std::vector<double> value;  ///< SI
};

/// The signals of the wanted columns, in their order. A CSV file begins with a header, units in
/// brackets or in a row below; separators and decimal commas as in surveys, an empty cell is a gap.
/// A LAS file is recognised by its first section; NULL is a gap. Times of day (ClockTime.hpp) count
/// from the first one and have no unit. DeckError, a line for each fault, with file, line, what was
/// found and what is expected: columns missing or twice, units missing, unknown, of another
/// quantity or other than the deck's, cells that are no finite number, times that do not increase,
/// rows of other lengths, fewer than two values of a column.
std::vector<LogSignal> readLog(const std::string& file, const WantedColumn& time,
                               const std::vector<WantedColumn>& wanted);

}  // namespace tooljoint::deck
