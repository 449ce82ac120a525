// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Measured logs against time, from CSV files with units in their header or from LAS files.
#pragma once

#include <string>
#include <vector>

namespace tooljoint::deck {

/// A wanted column of a log.
struct WantedColumn {
  std::string name;  ///< in the header; "" for the time: the column "Time", or the index of a LAS
                     ///< file
  std::string si;    ///< SI unit of what it measures
  std::string unit;  ///< given in the deck; "": that of the header
};

/// A measured signal; gaps are omitted.
struct LogSignal {
  std::vector<double> time;   ///< [s], increasing
  std::vector<double> value;  ///< SI
};

/// The signals of the wanted columns, in their order. A CSV file has a header, with units in
/// brackets or in the row below or above it; other lines above it are ignored. Separators and
/// decimal commas as in surveys; an empty cell, "NaN", "null", "N/A", "-" and the usual null
/// numbers are gaps. A LAS file is recognised by its first section; NULL is a gap. Times of day
/// (ClockTime.hpp) count from the first one and have no unit. DeckError, a line for each fault,
/// with file, line, text found and text expected: missing or duplicate columns; units that are
/// missing, unknown, of another quantity or different from the deck's; cells that are not finite
/// numbers; times that do not increase; rows of different length; fewer than two values in a
/// column.
std::vector<LogSignal> readLog(const std::string& file, const WantedColumn& time,
                               const std::vector<WantedColumn>& wanted);

}  // namespace tooljoint::deck
