// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A table of numbers as a CSV file and as a group of an HDF5 file.
#pragma once

#include <string>
#include <vector>

#include "io/OutputFolder.hpp"
#include "io/ResultsFile.hpp"

namespace tooljoint::response {

struct Columns {
  struct Column {
    std::string name, unit, longName;  ///< unit "1" for a dimensionless number
    std::vector<double> values;        ///< of the same length in all columns
  };
  std::vector<Column> columns;

  /// Stages NAME.csv and writes the group /NAME, a dataset for each column; nothing for a table
  /// without rows. Error(Internal) for a number that is not finite.
  void write(const std::string& name, io::OutputFolder& folder, io::ResultsFile& file) const;
  /// Writes only the group.
  void writeGroup(const std::string& name, io::ResultsFile& file) const;
};

/// Values value(row) of all rows.
template <class Rows, class Value>
std::vector<double> collect(const Rows& rows, const Value& value) {
  std::vector<double> values;
  for (const auto& row : rows) values.push_back(value(row));
  return values;
}

}  // namespace tooljoint::response
